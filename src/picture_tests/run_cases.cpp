#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/text.h>
#include <picture_tests/held_answers.h>
#include <picture_tests/picture_state.h>
#include <picture_tests/run_cases.h>
#include <picture_tests/test_case.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <scene/clip_import.h>
#include <scene/scene.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

/// What a golden would be now; nothing if it would not be, or that was not found out.
std::optional<std::string> fresh_bytes(const CaseResult& result, const std::filesystem::path& golden) {
    const auto found = std::ranges::find(result.fresh, golden, &GoldenChange::file);
    return found == result.fresh.end() ? std::nullopt : found->bytes;
}

/// Lines of what differs in one golden: a report is read, not searched.
constexpr std::size_t kMostWords = 12;

/// All goldens of a case but its picture, whether it holds them or not.
std::array<std::filesystem::path, 4> number_goldens(const CaseFile& file) {
    return {file.state(), file.golden_of(Held::answers), file.golden_of(Held::trace), file.golden_of(Held::fit)};
}

bool is_there(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::exists(file, ignored);
}

void add_finding(CaseResult& result, CaseOutcome outcome, Finding finding) {
    // What differs says more than what is not there.
    if (result.outcome != CaseOutcome::different) result.outcome = outcome;
    result.findings.push_back(std::move(finding));
    result.message = message_of(result.findings);
}

void add_missing(CaseResult& result, const std::filesystem::path& file) {
    add_finding(result, CaseOutcome::missing_golden, {file, "there is no golden " + file.string(), {}});
}

/// Compares the pixels with the golden's. Whether that can be done; if not, the result says why.
bool compare_pixels(CaseResult& result, const Image& actual, const CaseTerms& terms) {
    const std::filesystem::path file = result.file.golden();
    std::optional<Image> mask;
    if (terms.mask) mask = read_mask(*terms.mask, {actual.width, actual.height}, result.file.file);
    result.mask = terms.mask;
    result.actual = png_bytes(actual);
    if (!is_there(file)) {
        add_missing(result, file);
        return false;
    }
    try {
        std::string bytes = read_file(file);
        const PictureSize size = png_size(bytes, file.string());
        // Of two sizes nothing is compared: what a header says may be very large.
        if (size != PictureSize{actual.width, actual.height}) {
            result.image = diff_of_sizes({actual.width, actual.height}, size, terms.diff);
            add_finding(result, CaseOutcome::different, {file, what_differs(*result.image), {}});
            return false;
        }
        // Who looks at the heat map makes it anew (compared_again).
        result.image =
            diff(actual, read_png_bytes(bytes, file.string()), terms.diff, mask ? &*mask : nullptr, HeatMap::left_out);
        result.golden = std::move(bytes);
        return true;
    } catch (const InputError& error) {
        add_finding(result, CaseOutcome::different,
                    {file, std::string("the golden cannot be read: ") + error.what(), {}});
        return false;
    }
}

/// At most so many lines that a person reads them.
void shorten(std::vector<std::string>& lines, std::size_t count) {
    if (count <= kMostWords) return;
    lines.resize(kMostWords);
    lines.push_back("and " + std::to_string(count - kMostWords) + " more");
}

/// Lines of what differs, of one golden, as one finding. `of` stands before them.
void add_differences(CaseResult& result, const std::filesystem::path& golden, const std::string& of,
                     std::vector<std::string> lines) {
    const std::size_t count = lines.size();
    const std::string more = count > 1 ? "; and " + std::to_string(count - 1) + " more" : "";
    std::string message = of + (of.empty() ? "" : ": ") + lines.front() + more;
    shorten(lines, count);
    add_finding(result, CaseOutcome::different, {golden, std::move(message), std::move(lines)});
}

/// What the scene itself expects, of every query.
void check_expectations(CaseResult& result, const Shot& shot, bool asked) {
    std::vector<std::string> lines = unexpected_answers(shot);
    if (lines.empty()) return;
    const std::string file = shot.scene_file.string();
    for (std::string& line : lines) line.insert(0, file + ": ");
    add_differences(result, {}, "", std::move(lines));
    result.findings.back().words.push_back("if the answer is right, correct `expect` in " +
                                           (asked && file == result.file.file ? "the test" : file));
}

/// "A and B collide at 2.43 s: 18 tests of time, 12 of obb2d": a line for each query of a golden of answers.
std::vector<std::string> answers_in(const std::string& golden) {
    const std::string name = "the answers";
    const JsonText text = parse_json(golden, name);
    const JsonPlace root(text, name);
    std::vector<std::string> out;
    root.require("answers").each([&](const JsonPlace& one) {
        std::string line = one.require("a").string() + " and " + one.require("b").string();
        const JsonPlace contact = one.require("contact");
        line += contact.is_null() ? " do not collide" : " collide at " + brief(contact.require("time").number()) + " s";
        const JsonPlace tests = one.require("tests");
        const char* before = ": ";
        for (int i = 0; i < tests.members(); ++i) {
            const JsonPlace count = tests.member(i);
            if (count.number() == 0) continue;
            line.append(before).append(brief(count.number())).append(*before == ':' ? " tests of " : " of ");
            line.append(count.key());
            before = ", ";
        }
        out.push_back(std::move(line));
    });
    return out;
}

/// Answers, trace or fit against its golden.
void compare_held(CaseResult& result, const HeldAnswers& held, Held what) {
    const std::filesystem::path golden = result.file.golden_of(what);
    if (!is_there(golden)) {
        add_missing(result, golden);
        if (what != Held::answers) return;
        std::vector<std::string> words = answers_in(held.golden(what));
        shorten(words, words.size());
        words.insert(words.begin(), result.findings.back().message);
        result.findings.back().words = std::move(words);
        return;
    }
    try {
        std::vector<std::string> lines = held.differences(what, read_file(golden), golden.string());
        if (!lines.empty()) add_differences(result, golden, golden.filename().string(), std::move(lines));
    } catch (const InputError& error) {
        add_finding(result, CaseOutcome::different,
                    {golden, std::string("the golden cannot be read: ") + error.what(), {}});
    }
}

/// The verdict on a picture that was compared with its golden. `state`: what it shows; null: that is not held.
void judge(CaseResult& result, const std::string* state, const std::string& drawn_with) {
    const std::filesystem::path file = result.file.state();
    const std::string file_name = file.filename().string();
    const bool is_held = state && is_there(file);
    StateDifferences found;
    std::string unreadable;
    try {
        if (is_held) found = compare_states(*state, read_file(file), file.string());
    } catch (const InputError& error) {
        unreadable = error.what();
    }
    const bool is_same = is_held && unreadable.empty() && found.lines.empty();
    const std::string pixels = what_differs(*result.image);
    if (result.image->passes) {
        if (!result.image->same) result.remarks.push_back(pixels);
    } else if (is_same && !found.other_imgui.empty()) {
        result.remarks.push_back(pixels + "; Dear ImGui is " + found.other_imgui + ", so " + file_name +
                                 " decides, which is the same");
    } else {
        add_finding(result, CaseOutcome::different, {result.file.golden(), pixels, {}});
        if (is_same)
            result.remarks.push_back(file_name + " is the same, only the pixels differ; drawn with " + drawn_with);
    }
    if (state && !is_held) add_missing(result, file);
    if (!unreadable.empty()) {
        add_finding(result, CaseOutcome::different, {file, "the golden cannot be read: " + unreadable, {}});
    } else if (!found.lines.empty()) {
        add_differences(result, file, file_name, std::move(found.lines));
    }
}

void add_golden(std::vector<GoldenChange>& to, const std::filesystem::path& golden, std::optional<std::string> bytes) {
    std::optional<std::string> before = golden_bytes(golden);
    if (bytes || before) to.push_back({golden, std::move(bytes), std::move(before)});
}

/// The goldens of all that is held, of one whose goldens are asked for: `pictures` and those of numbers.
void add_fresh(CaseResult& result, const CaseTerms& terms, const HeldAnswers* held, std::vector<GoldenChange> pictures,
               const RunOptions& options) {
    // What a scene expects no golden mends.
    const bool passed = result.findings.size() == unmended(result).size();
    if (options.asked) add_golden(result.fresh, result.file.file, options.asked);
    result.fresh.insert(result.fresh.end(), std::make_move_iterator(pictures.begin()),
                        std::make_move_iterator(pictures.end()));
    for (const Held what : terms.hold) {
        if (what != Held::picture) add_golden(result.fresh, result.file.golden_of(what), held->golden(what));
    }
    if (!passed || options.fresh != FreshGoldens::missing) return;
    const bool lacks = std::ranges::any_of(result.fresh, [](const GoldenChange& one) { return !one.replaces; });
    std::erase_if(result.fresh, [&](const GoldenChange& one) { return !lacks || (one.bytes && one.replaces); });
}

/// Whether there is a golden to take, or all are asked for.
bool wants_fresh(const CaseResult& result, const RunOptions& options) {
    return result.findings.size() > unmended(result).size() || options.fresh != FreshGoldens::of_failed;
}

/// Draws it and compares. `held`: what else is held; null: nothing.
void run_picture(CaseResult& result, const Case& tested, const HeldAnswers* held, PictureMaker& maker,
                 const RunOptions& options) {
    const PictureMaker::Made made = maker.make(tested.shot);
    const GlContext& context = maker.renderer().context();
    if (compare_pixels(result, made.picture, tested.terms)) {
        judge(result, tested.terms.state ? &made.state : nullptr,
              "OpenGL " + context.version() + ", " + context.device());
    }
    if (wants_fresh(result, options)) {
        std::vector<GoldenChange> goldens;
        add_golden(goldens, result.file.golden(), result.actual);
        add_golden(goldens, result.file.state(), tested.terms.state ? std::optional(made.state) : std::nullopt);
        add_fresh(result, tested.terms, held, std::move(goldens), options);
    }
    // Of a case that passed one picture is enough.
    if (result.outcome == CaseOutcome::passed) result.golden.clear();
}

/// Throws InputError if a golden would take the place of something that the case is made from. `read`: those files.
void check_replaces_no_input(const CaseFile& file, const Case& tested, bool asked,
                             std::vector<std::filesystem::path> read) {
    // Another case may have read these before.
    const Scene& scene = tested.shot.panels.front().fitted->scene();
    if (tested.shot.scene_file != file.file) read.push_back(tested.shot.scene_file);
    for (const SceneClip& clip : scene.clips) {
        if (clip.source) read.push_back(source_path(scene, clip));
    }
    if (tested.terms.mask) read.push_back(*tested.terms.mask);
    std::vector<std::filesystem::path> written = file.goldens(tested.terms.hold);
    if (asked) written.push_back(file.file);
    for (const std::filesystem::path& golden : written) {
        for (const std::filesystem::path& input : read) {
            if (!is_same_file(golden, input)) continue;
            const std::string name = golden.filename().string();
            throw InputError(file.file.string(), "",
                             "the case reads " + name + ", where its golden goes; rename the case or that file");
        }
    }
}

/// The case that a test asks for must be that of its file: others run that.
void check_case_file(CaseResult& result, const CaseTerms& terms, const std::string& asked) {
    const std::filesystem::path& file = result.file.file;
    if (is_there(file)) {
        const std::string name = file.filename().string();
        const auto differs = [&](const std::string& how) {
            add_finding(result, CaseOutcome::different, {file, name + how, {}});
        };
        try {
            const std::string before = read_file(file);
            parse_json(before, file.string());
            if (nlohmann::json::parse(asked) != nlohmann::json::parse(before))
                differs(" is not what the test asks for");
        } catch (const InputError& error) {
            differs(std::string(" cannot be read: ") + error.what());
        }
        return;
    }
    // Without its case a golden would be held by nothing but the test that asks.
    const auto has_golden = [&](Held what) { return is_there(result.file.golden_of(what)); };
    if (std::ranges::any_of(terms.hold, has_golden)) add_missing(result, file);
}

/// Those that were read since; they are the result's, too.
std::vector<std::filesystem::path> add_files_read(CaseResult& result) {
    std::vector<std::filesystem::path> files = take_files_read();
    result.read.insert(result.read.end(), files.begin(), files.end());
    return files;
}

/// Of a case whose picture cannot be drawn: it is skipped, unless something else is wrong with it.
void leave_picture_out(CaseResult& result, const CaseTerms& terms, std::string_view no_opengl) {
    result.not_drawn = no_opengl;
    const std::string not_drawn = "the picture was not drawn: " + result.not_drawn;
    if (!result.findings.empty()) {
        result.remarks.push_back(not_drawn);
        return;
    }
    std::vector<std::string_view> held;
    for (const Held what : terms.hold) {
        if (what != Held::picture) held.push_back(name(what));
    }
    result.outcome = CaseOutcome::skipped;
    result.message = held.empty() ? result.not_drawn : "as in the goldens: " + listed(held) + "; " + not_drawn;
}

/// Reads it and compares all that it holds.
void run(CaseResult& result, PictureMaker* maker, std::string_view no_opengl, const RunOptions& options) {
    add_files_read(result);
    const Case tested = read_case(result.file.file, options.asked);
    std::vector<std::filesystem::path> inputs = add_files_read(result);
    std::erase(inputs, whole_path(options.asked ? std::filesystem::path() : result.file.file));
    result.tolerance = tested.terms.tolerance;
    const bool draws = tested.terms.holds(Held::picture);
    if (!draws) result.drawn_by = {std::string(kDrawsNothing), {}};
    if (tested.terms.skip) {
        result.outcome = CaseOutcome::skipped;
        result.message = *tested.terms.skip;
        return;
    }
    check_replaces_no_input(result.file, tested, options.asked.has_value(), std::move(inputs));
    check_expectations(result, tested.shot, options.asked.has_value());
    std::optional<HeldAnswers> held;
    if (tested.terms.hold != std::vector{Held::picture}) held.emplace(tested.shot, tested.terms);
    for (const Held what : tested.terms.hold) {
        if (what != Held::picture) compare_held(result, *held, what);
    }
    // Of a picture alone nothing can be taken without OpenGL, and no case is written that has no golden.
    if (options.asked && (maker || held)) check_case_file(result, tested.terms, *options.asked);
    if (draws && maker) {
        run_picture(result, tested, held ? &*held : nullptr, *maker, options);
    } else if (held && wants_fresh(result, options)) {
        add_fresh(result, tested.terms, &*held, {}, options);
    }
    if (draws && !maker) leave_picture_out(result, tested.terms, no_opengl);
}

}  // namespace

CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl, const RunOptions& options) {
    CaseResult result;
    result.file = file;
    const auto begin = std::chrono::steady_clock::now();
    if (maker) {
        const Renderer& renderer = maker->renderer();
        result.drawn_by = {std::string(maker->backend()), renderer.context().device()};
    }
    try {
        run(result, maker, no_opengl, options);
    } catch (const std::exception& error) {
        result.outcome = CaseOutcome::failed;
        result.message = error.what();
        result.actual.clear();
        result.golden.clear();
        result.image.reset();
        result.remarks.clear();
        result.findings.clear();
        result.fresh.clear();
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    add_files_read(result);
    return result;
}

std::string words_on(const CaseResult& result, const std::filesystem::path& folder) {
    if (result.outcome == CaseOutcome::passed) return {};
    std::ostringstream out;
    out << name(result.outcome) << ": " << cleaned(result.file.name);
    const std::vector<std::string> lines = lines_of(result);
    if (result.findings.empty()) out << ": " << cleaned(result.message);
    out << '\n';
    if (!result.findings.empty()) {
        for (const std::string& line : lines) out << "  " << cleaned(line) << '\n';
    }
    for (const std::string& remark : result.remarks) out << "  " << cleaned(remark) << '\n';
    const std::string stem = (whole_path(folder) / result.file.name).string();
    constexpr std::array kNumbers{Held::answers, Held::trace, Held::fit};
    for (const Finding& finding : result.findings) {
        const bool told =
            std::ranges::any_of(kNumbers, [&](Held held) { return finding.golden == result.file.golden_of(held); });
        if (!told || !fresh_bytes(result, finding.golden)) continue;
        out << "  actual:  " << cleaned(stem + ".actual" + result.file.ending_of(finding.golden)) << '\n';
        if (is_there(finding.golden)) out << "  golden:  " << cleaned(whole_path(finding.golden).string()) << '\n';
    }
    if (!result.actual.empty()) {
        out << "  actual:  " << cleaned(stem + ".actual.png") << '\n';
        if (!result.golden.empty()) out << "  golden:  " << cleaned(whole_path(result.file.golden()).string()) << '\n';
        if (result.image && result.image->same_size) out << "  differs: " << cleaned(stem + ".heat.png") << '\n';
    }
    if (can_be_taken(result)) {
        out << "  if it is right: mobbscope test " << shell_word(whole_path(result.file.folder()).string()) << ' '
            << shell_word(result.file.name) << " --accept " << shell_word(whole_path(folder).string()) << '\n';
    }
    return std::move(out).str();
}

void check_kept(const CaseResult& result, const std::filesystem::path& folder) {
    const std::string stem = (folder / result.file.name).string();
    for (const std::string_view what : {".txt", ".actual.png", ".golden.png", ".heat.png"})
        check_not_read(stem + std::string(what));
    for (const std::filesystem::path& file : number_goldens(result.file))
        check_not_read(stem + ".actual" + result.file.ending_of(file));
}

std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder) {
    check_kept(result, folder);
    const std::filesystem::path stem = folder / result.file.name;
    const bool passed = result.outcome == CaseOutcome::passed;
    if (!passed) make_folder_of(stem);
    const bool keeps = !passed && (!result.actual.empty() || !result.fresh.empty());
    std::vector<std::filesystem::path> written;
    const auto keep = [&](const std::string& what, const std::optional<std::string>& bytes) {
        const std::filesystem::path file = stem.string() + '.' + what;
        if (!bytes) {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
            return;
        }
        check_stays_in_folder(file);
        write_file(file, *bytes);
        written.push_back(file);
    };
    keep("txt", passed ? std::nullopt : std::optional(words_on(result, folder)));
    written.clear();
    const auto png = [](const std::string& bytes) { return bytes.empty() ? std::nullopt : std::optional(bytes); };
    const std::optional<Image> heat = keeps ? heat_map(result) : std::nullopt;
    keep("actual.png", keeps ? png(result.actual) : std::nullopt);
    keep("golden.png", keeps ? png(result.golden) : std::nullopt);
    keep("heat.png", heat ? std::optional(png_bytes(*heat)) : std::nullopt);
    for (const std::filesystem::path& file : number_goldens(result.file)) {
        keep("actual" + result.file.ending_of(file), keeps ? fresh_bytes(result, file) : std::nullopt);
    }
    return written;
}

}  // namespace mobbscope::picture_tests
