#include <base/error.h>
#include <base/file.h>
#include <picture_tests/reference.h>
#include <picture_tests/run_cases.h>
#include <picture_tests/test_case.h>
#include <render/drawlist/draw_list_compare.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

/// What was found of one golden is added to what was found of those before.
void add_finding(CaseResult& result, CaseOutcome outcome, Finding finding, GoldenChange fresh) {
    if (result.outcome == CaseOutcome::passed) result.outcome = outcome;
    result.message += (result.message.empty() ? "" : "; ") + finding.message;
    result.findings.push_back(std::move(finding));
    result.fresh.push_back(std::move(fresh));
}

void add_missing(CaseResult& result, const std::filesystem::path& file, std::string bytes) {
    add_finding(result, CaseOutcome::missing_golden, {file, "there is no golden " + file.string(), {}},
                {file, std::move(bytes)});
}

bool is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

/// Holds a picture against a golden. The result shows the first that is not its golden's, else the first. `which`
/// stands before what differs.
void compare_pictures(CaseResult& result, const Image& actual, const std::filesystem::path& file, Tolerance tolerance,
                      const std::string& which = "") {
    const bool shows_another = std::any_of(result.fresh.begin(), result.fresh.end(),
                                           [](const GoldenChange& fresh) { return fresh.file.extension() == ".png"; });
    const auto show = [&](Image golden, std::optional<ImageDiff> image) {
        if (shows_another) return;
        result.actual = actual;
        result.golden = std::move(golden);
        result.image = std::move(image);
        result.tolerance = tolerance;
    };
    if (!is_there(file)) {
        show({}, {});
        return add_missing(result, file, png_bytes(actual));
    }
    std::optional<std::string> before;
    Image golden;
    try {
        before = golden_bytes(file);
        golden = read_png(file);
    } catch (const InputError& error) {
        show({}, {});
        return add_finding(result, CaseOutcome::different,
                           {file, which + "the golden cannot be read: " + error.what(), {}},
                           {file, png_bytes(actual), before});
    }
    ImageDiff image = diff(actual, golden, diff_options(tolerance));
    if (image.same && result.image) return;
    if (image.same) return show(std::move(golden), std::move(image));
    const std::string why = which + what_differs(image);
    show(std::move(golden), std::move(image));
    add_finding(result, CaseOutcome::different, {file, why, {}}, {file, png_bytes(actual), before});
}

/// Holds numbers, as JSON, against a golden that is there. `what` stands for them in messages.
void compare_numbers(CaseResult& result, const std::string& actual, const std::string& what,
                     const std::filesystem::path& file) {
    std::string golden;
    std::string why;
    std::vector<std::string> words;
    try {
        golden = read_file(file);
        if (golden.empty()) {
            why = file.filename().string() + ": it is empty";
        } else {
            DrawListComparison found = compare_draw_lists(actual, what, golden, file.string());
            if (found.same()) return;
            words = std::move(found.differences);
            why = file.filename().string() + ": " + words.front();
            if (found.count > 1) why += "; and " + std::to_string(found.count - 1) + " more";
        }
    } catch (const InputError& error) {
        why = error.what();
    }
    add_finding(result, CaseOutcome::different, {file, why, std::move(words)}, {file, actual, golden});
}

/// The same with one that must be there.
void require_numbers(CaseResult& result, const std::string& actual, const std::string& what,
                     const std::filesystem::path& file) {
    if (is_there(file)) return compare_numbers(result, actual, what, file);
    add_missing(result, file, actual);
}

/// Holds the picture, and what is drawn where there is a NAME.draw.json, against the goldens.
void compare_in_full(CaseResult& result, const Case& tested, const Image& picture, PictureMaker& maker) {
    compare_pictures(result, picture, result.file.golden(), tested.tolerance);
    if (is_there(result.file.draw())) {
        compare_numbers(result, maker.draw_lists(tested.shot), "the draw list", result.file.draw());
    }
}

/// The same without text: NAME.plain.*.
void compare_without_text(CaseResult& result, const Shot& shot, PictureMaker& maker) {
    const std::string which = "without text: ";
    if (shot.window) {
        const PictureMaker::Window window = maker.window_without_text(shot);
        compare_pictures(result, coarse_picture(window.picture), result.file.plain(), Tolerance::loose, which);
        require_numbers(result, window.state, "the window's state", result.file.plain_state());
        return;
    }
    const Shot plain = without_text(shot);
    compare_pictures(result, coarse_picture(maker.make(plain)), result.file.plain(), Tolerance::loose, which);
    if (is_there(result.file.draw())) {
        require_numbers(result, maker.draw_lists(plain), "the draw list", result.file.plain_draw());
    }
}

/// Reads and draws it, and compares.
void run(CaseResult& result, PictureMaker& maker, GoldenSource source) {
    const Case tested = read_case(result.file.file);
    result.tolerance = tested.tolerance;
    if (tested.skip) {
        result.outcome = CaseOutcome::skipped;
        result.message = *tested.skip;
        return;
    }
    if (tested.shot.window && is_there(result.file.draw())) {
        throw InputError(result.file.file.string(), "",
                         "a picture of the window has no draw list; remove " + result.file.draw().filename().string());
    }
    const Reference here = reference_of(maker.renderer());
    const std::optional<Reference> reference =
        source == GoldenSource::here ? here : read_reference(result.file.file.parent_path());
    if (reference && result.file.name.ends_with(".plain")) {
        throw InputError(result.file.file.string(), "",
                         "names that end in .plain are those of goldens without text; rename the case");
    }
    if (reference) result.other_here = what_is_other(here, *reference);

    Image picture = maker.make(tested.shot);
    if (result.other_here.empty()) compare_in_full(result, tested, picture, maker);
    if (reference) compare_without_text(result, tested.shot, maker);
    if (result.outcome != CaseOutcome::passed) return;
    // A run may have hundreds of cases: of those that passed one picture is enough.
    result.actual = std::move(picture);
    result.golden = {};
    result.image->heat = {};
}

}  // namespace

CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl, GoldenSource source) {
    CaseResult result;
    result.file = file;
    if (!maker) {
        result.outcome = CaseOutcome::skipped;
        result.message = no_opengl;
        return result;
    }
    const auto begin = std::chrono::steady_clock::now();
    try {
        run(result, *maker, source);
    } catch (const std::exception& error) {
        result.outcome = CaseOutcome::failed;
        result.message = error.what();
        result.actual = {};
        result.golden = {};
        result.image.reset();
        result.findings.clear();
        result.fresh.clear();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

void make_folder_of(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    if (folder.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw MachineError(folder.string() + ": cannot be made: " + error.message());
}

std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder) {
    const std::filesystem::path stem = folder / result.file.name;
    if (result.outcome != CaseOutcome::passed && !result.actual.rgba.empty()) make_folder_of(stem);
    std::vector<std::filesystem::path> written;
    const auto keep = [&](const char* what, const Image* image) {
        const std::filesystem::path file = stem.string() + "." + what + ".png";
        if (result.outcome == CaseOutcome::passed || !image || image->rgba.empty()) {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
            return;
        }
        write_png(file, *image);
        written.push_back(file);
    };
    keep("actual", &result.actual);
    keep("golden", &result.golden);
    keep("heat", result.image ? &result.image->heat : nullptr);
    return written;
}

}  // namespace mobbscope::picture_tests
