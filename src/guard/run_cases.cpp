#include <guard/run_cases.h>

#include <import/error.h>
#include <import/file.h>
#include <render/diff_sentence.h>
#include <render/draw_list_json.h>
#include <render/png.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace mobbscope::guard {

namespace {

/// Holds the picture against the golden.
void compare_pictures(CaseResult& result) {
    const std::filesystem::path file = result.file.golden();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        result.outcome = Outcome::missing_golden;
        result.message = "there is no golden " + file.string();
        return;
    }
    try {
        result.golden = read_png(file);
    } catch (const InputError& error) {
        result.outcome = Outcome::different;
        result.message = std::string("the golden cannot be read: ") + error.what();
        return;
    }
    result.image = diff(result.actual, result.golden, diff_options(result.tolerance));
    if (result.image->same) return;
    result.outcome = Outcome::different;
    result.message = what_differs(*result.image);
}

/// Holds what is drawn against NAME.draw.json, if there is one.
void compare_draw_lists(CaseResult& result, const Shot& shot, PictureMaker& maker) {
    const std::filesystem::path file = result.file.draw();
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return;
    if (shot.window) {
        throw InputError(result.file.file.string(), "",
                         "a picture of the window has no draw list; remove " + file.filename().string());
    }
    result.draw_lists = maker.draw_lists(shot);
    std::string why;
    try {
        const std::string golden = read_file(file);
        const std::optional<std::string> found =
            golden.empty() ? "it is empty"
                           : first_difference(result.draw_lists, "the draw list", golden, file.string());
        if (!found) return;
        why = file.filename().string() + ": " + *found;
    } catch (const InputError& error) {
        why = error.what();
    }
    result.draws_the_same = false;
    if (result.outcome == Outcome::passed) result.outcome = Outcome::different;
    result.message += (result.message.empty() ? "" : "; ") + why;
}

/// Reads and draws it, and compares.
void run(CaseResult& result, PictureMaker& maker) {
    const Case tested = read_case(result.file.file);
    result.tolerance = tested.tolerance;
    if (tested.skip) {
        result.outcome = Outcome::skipped;
        result.message = *tested.skip;
        return;
    }
    result.actual = maker.make(tested.shot);
    compare_pictures(result);
    compare_draw_lists(result, tested.shot, maker);
    if (result.outcome != Outcome::passed) return;
    // A run may have hundreds of cases: of those that passed one picture is enough.
    result.golden = {};
    result.image->heat = {};
}

}  // namespace

std::string_view name(Outcome outcome) {
    switch (outcome) {
        case Outcome::passed:
            return "passed";
        case Outcome::different:
            return "different";
        case Outcome::missing_golden:
            return "missing golden";
        case Outcome::failed:
            return "failed";
        case Outcome::skipped:
            return "skipped";
    }
    return "";
}

CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl) {
    CaseResult result;
    result.file = file;
    if (!maker) {
        result.outcome = Outcome::skipped;
        result.message = no_opengl;
        return result;
    }
    const auto begin = std::chrono::steady_clock::now();
    try {
        run(result, *maker);
    } catch (const std::exception& error) {
        result.outcome = Outcome::failed;
        result.message = error.what();
        result.actual = {};
        result.golden = {};
        result.image.reset();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

bool can_be_taken(const CaseResult& result) {
    return result.outcome == Outcome::different || result.outcome == Outcome::missing_golden;
}

Summary summary(std::span<const CaseResult> results) {
    Summary sum;
    for (const CaseResult& result : results) {
        switch (result.outcome) {
            case Outcome::passed:
                ++sum.passed;
                break;
            case Outcome::different:
                ++sum.different;
                break;
            case Outcome::missing_golden:
                ++sum.missing;
                break;
            case Outcome::failed:
                ++sum.failed;
                break;
            case Outcome::skipped:
                ++sum.skipped;
                break;
        }
    }
    return sum;
}

}  // namespace mobbscope::guard
