#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/text.h>
#include <picture_tests/held_answers.h>
#include <picture_tests/reference.h>
#include <picture_tests/run_cases.h>
#include <picture_tests/test_case.h>
#include <render/compare/draw_list_compare.h>
#include <render/compare/json_values.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <render/image/ssim.h>
#include <scene/clip_import.h>
#include <scene/scene.h>

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

/// What a case draws; each part is made when it is first asked for.
class DrawnCase {
  public:
    DrawnCase(const Case& tested, PictureMaker& maker) : shot_(tested.shot), maker_(maker) {
        if (!shot_.window) lists_ = panel_lists(shot_);
        picture_ = shot_.window ? maker.make(shot_) : maker.make(shot_, lists_);
    }

    const Image& picture() const { return picture_; }
    const std::string& draw_list() {
        if (!draw_list_) draw_list_ = maker_.draw_lists(lists_);
        return *draw_list_;
    }
    /// Without text, and coarse.
    const Image& plain() {
        if (!plain_ && shot_.window) {
            make_window();
        } else if (!plain_) {
            plain_ = coarse_picture(maker_.make(without_text(shot_)));
        }
        return *plain_;
    }
    /// Of a window.
    const std::string& state() {
        if (!state_) make_window();
        return *state_;
    }

  private:
    void make_window() {
        PictureMaker::Window window = maker_.window_without_text(shot_);
        plain_ = coarse_picture(window.picture);
        state_ = std::move(window.state);
    }

    const Shot& shot_;
    PictureMaker& maker_;
    std::vector<DrawList> lists_;  ///< of its panels; none of a window
    Image picture_;
    std::optional<std::string> draw_list_, state_;
    std::optional<Image> plain_;
};

/// A picture held against its golden.
struct HeldPicture {
    Image golden;
    std::optional<ImageDiff> diff;          ///< where there is a golden that can be read
    std::optional<std::string> unreadable;  ///< why

    bool passes() const { return diff && diff->passes; }
};

HeldPicture hold(const Image& actual, const std::filesystem::path& file, const DiffOptions& options,
                 const Image* mask) {
    HeldPicture out;
    if (!is_there(file)) return out;
    try {
        const std::string bytes = read_file(file);
        const PictureSize size = png_size(bytes, file.string());
        // Of two sizes nothing is compared: what a header says may be very large.
        if (size != PictureSize{actual.width, actual.height}) {
            out.diff = diff_of_sizes({actual.width, actual.height}, size, options);
            return out;
        }
        out.golden = read_png_bytes(bytes, file.string());
    } catch (const InputError& error) {
        out.unreadable = error.what();
        return out;
    }
    const bool fits = mask && mask->width == actual.width && mask->height == actual.height;
    // Who looks at the heat map makes it anew (compared_again).
    out.diff = diff(actual, out.golden, options, fits ? mask : nullptr, HeatMap::left_out);
    return out;
}

/// What a result shows, until it is packed.
struct ShownPictures {
    const Image* actual = nullptr;  ///< of the drawn case
    Image golden;
};

/// The result shows this picture.
void show(CaseResult& result, ShownPictures& shown, const Image& actual, HeldPicture held,
          const std::filesystem::path& file) {
    result.shown = file;
    shown.actual = &actual;
    shown.golden = std::move(held.golden);
    result.image = std::move(held.diff);
}

/// The verdict on a picture by its pixels. `which` stands before what differs.
void judge_pixels(CaseResult& result, const HeldPicture& held, const std::filesystem::path& file,
                  const std::string& which) {
    if (held.unreadable) {
        add_finding(result, CaseOutcome::different,
                    {file, which + "the golden cannot be read: " + *held.unreadable, {}});
    } else if (!held.diff) {
        add_missing(result, file);
    } else if (!held.diff->passes) {
        add_finding(result, CaseOutcome::different, {file, which + what_differs(*held.diff), {}});
    } else if (!held.diff->same && which.empty()) {
        result.remarks.push_back(what_differs(*held.diff));
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

/// Holds numbers, as JSON, against a golden. `what` stands for them in messages.
void compare_numbers(CaseResult& result, const std::string& actual, const std::string& what,
                     const std::filesystem::path& file, bool other_fonts) {
    try {
        const std::string golden = read_file(file);
        if (golden.empty()) {
            return add_finding(result, CaseOutcome::different, {file, file.filename().string() + ": it is empty", {}});
        }
        DrawListComparison found =
            compare_draw_lists(actual, what, golden, file.string(), {.other_fonts = other_fonts, .most = kMostWords});
        for (const std::string& line : found.pixels) {
            result.remarks.push_back(file.filename().string() + ": " + line);
        }
        if (found.same()) return;
        const std::size_t more = found.count - 1;
        const std::string why = file.filename().string() + ": " + found.differences.front() +
                                (more > 0 ? "; and " + std::to_string(more) + " more" : "");
        shorten(found.differences, static_cast<std::size_t>(found.count));
        add_finding(result, CaseOutcome::different, {file, why, std::move(found.differences)});
    } catch (const InputError& error) {
        add_finding(result, CaseOutcome::different, {file, error.what(), {}});
    }
}

/// Of a window, what its panels are made from.
void compare_state(CaseResult& result, DrawnCase& drawn) {
    const std::filesystem::path state = result.file.plain_state();
    if (!is_there(state)) return add_missing(result, state);
    compare_numbers(result, drawn.state(), "the window's state", state, false);
}

/// Holds the picture without text, and of a window its state.
void compare_without_text(CaseResult& result, ShownPictures& shown, const Case& tested, DrawnCase& drawn,
                          const Image* mask) {
    const std::filesystem::path file = result.file.plain();
    const PictureSize size{drawn.plain().width, drawn.plain().height};
    std::optional<Image> small_mask;
    if (mask && !tested.shot.window) small_mask = shrunk_mask(*mask, 2, size);
    HeldPicture held = hold(drawn.plain(), file, diff_options(Tolerance::loose), small_mask ? &*small_mask : nullptr);
    judge_pixels(result, held, file, "without text: ");
    // The case's own picture is shown if that is why it does not pass.
    const bool shows_another = result.decided_by == DecidedBy::pixels && !(result.image && result.image->passes);
    if (!held.passes() && !shows_another) {
        show(result, shown, drawn.plain(), std::move(held), file);
        result.mask.reset();
        result.tolerance = Tolerance::loose;
    }
    if (tested.shot.window) compare_state(result, drawn);
}

/// Whether the case is held by the numbers of what it draws.
bool has_draw_list(const CaseFile& file, const Case& tested) { return tested.terms.draw_list && is_there(file.draw()); }

/// Where the goldens are from.
void compare_on_reference(CaseResult& result, ShownPictures& shown, const Case& tested, DrawnCase& drawn,
                          bool has_reference, const Image* mask) {
    const std::filesystem::path golden = result.file.golden();
    HeldPicture held = hold(drawn.picture(), golden, tested.terms.diff, mask);
    judge_pixels(result, held, golden, "");
    const bool same_size = !held.diff || held.diff->same_size;
    show(result, shown, drawn.picture(), std::move(held), golden);
    // In a picture of another size everything is elsewhere.
    if (!same_size) return;
    if (has_draw_list(result.file, tested)) {
        compare_numbers(result, drawn.draw_list(), "the draw list", result.file.draw(), false);
    } else if (has_reference && (tested.shot.window || is_there(result.file.plain()))) {
        compare_without_text(result, shown, tested, drawn, mask);
    } else if (has_reference) {
        // Else nothing would hold the case elsewhere.
        add_missing(result, tested.terms.draw_list ? result.file.draw() : result.file.plain());
    }
}

/// By structural similarity.
void judge_similarity(CaseResult& result, const ShownPictures& shown, const Image* mask, double most) {
    const double loss = similarity_loss(*shown.actual, shown.golden, mask);
    const std::string said = "the largest loss of structural similarity is " + brief(loss);
    if (loss > most) {
        add_finding(result, CaseOutcome::different, {result.shown, said + ", allowed: " + brief(most), {}});
    } else {
        result.remarks.push_back(said + ", allowed: " + brief(most));
    }
}

/// Where something is other than where the goldens are from.
void compare_elsewhere(CaseResult& result, ShownPictures& shown, const Case& tested, DrawnCase& drawn, bool same_words,
                       const Image* mask) {
    const std::filesystem::path golden = result.file.golden();
    HeldPicture held = hold(drawn.picture(), golden, tested.terms.diff, mask);
    const bool passes = held.passes();
    const std::size_t found_before = result.findings.size();
    const bool comparable = held.diff && held.diff->same_size;
    if (passes || !comparable) {
        judge_pixels(result, held, golden, "");
    } else {
        result.remarks.push_back(what_differs(*held.diff));
    }
    show(result, shown, drawn.picture(), std::move(held), golden);
    if (!comparable) return;
    if (has_draw_list(result.file, tested)) {
        // With other fonts words lie elsewhere; pixels that agree say more then.
        if (passes && !same_words) return;
        compare_numbers(result, drawn.draw_list(), "the draw list", result.file.draw(), !same_words);
        if (!passes || result.findings.size() > found_before) result.decided_by = DecidedBy::draw_list;
        if (!passes && same_words) judge_similarity(result, shown, mask, kMostLossWithDrawList);
    } else if (passes) {
        return;
    } else if (same_words) {
        result.decided_by = DecidedBy::ssim;
        judge_similarity(result, shown, mask, kMostLoss);
        if (tested.shot.window) compare_state(result, drawn);
    } else {
        result.decided_by = DecidedBy::without_text;
        compare_without_text(result, shown, tested, drawn, mask);
    }
}

void add_golden(std::vector<GoldenChange>& to, const std::filesystem::path& golden, std::optional<std::string> bytes) {
    std::optional<std::string> before = golden_bytes(golden);
    if (bytes || before) to.push_back({golden, std::move(bytes), std::move(before)});
}

/// All goldens of a case's picture as they would be now, and those that go, as others take their place.
std::vector<GoldenChange> goldens_of(const CaseFile& file, const Case& tested, DrawnCase& drawn, bool has_reference) {
    std::vector<GoldenChange> out;
    const auto add = [&out](const std::filesystem::path& golden, std::optional<std::string> bytes) {
        add_golden(out, golden, std::move(bytes));
    };
    const auto if_wanted = [](bool wanted, const auto& make) {
        return wanted ? std::optional<std::string>(make()) : std::nullopt;
    };
    const bool numbers = tested.terms.draw_list && !tested.shot.window;
    add(file.golden(), png_bytes(drawn.picture()));
    add(file.draw(), if_wanted(numbers, [&] { return drawn.draw_list(); }));
    // Elsewhere NAME.plain may be a case of its own.
    if (!has_reference) return out;
    add(file.plain(), if_wanted(!numbers, [&] { return png_bytes(drawn.plain()); }));
    add(file.plain_draw(), std::nullopt);
    add(file.plain_state(), if_wanted(tested.shot.window.has_value(), [&] { return drawn.state(); }));
    return out;
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
    if (tested.shot.window && is_there(result.file.draw())) {
        throw InputError(result.file.file.string(), "",
                         "a picture of the window has no draw list; remove " + result.file.draw().filename().string());
    }
    const Reference here = reference_of(maker.renderer());
    const std::optional<Reference> reference =
        options.source == GoldenSource::here ? here : read_reference(result.file.file.parent_path());
    if (reference && result.file.name.ends_with(".plain")) {
        throw InputError(result.file.file.string(), "",
                         "names that end in .plain are those of goldens without text; rename the case");
    }
    if (reference) result.other_here = what_is_other(here, *reference);

    DrawnCase drawn(tested, maker);
    ShownPictures shown;
    std::optional<Image> mask;
    if (tested.terms.mask) {
        mask = read_mask(*tested.terms.mask, {drawn.picture().width, drawn.picture().height}, result.file.file);
        result.mask = tested.terms.mask;
    }
    if (result.other_here.empty()) {
        compare_on_reference(result, shown, tested, drawn, reference.has_value(), mask ? &*mask : nullptr);
    } else {
        const bool same_words = same_text(here, *reference, tested.shot.window.has_value());
        compare_elsewhere(result, shown, tested, drawn, same_words, mask ? &*mask : nullptr);
    }
    if (wants_fresh(result, options))
        add_fresh(result, tested.terms, held, goldens_of(result.file, tested, drawn, reference.has_value()), options);
    const std::optional<std::string> packed = fresh_bytes(result, result.shown);
    result.actual = packed ? *packed : png_bytes(*shown.actual);
    // Of a case that passed one picture is enough.
    if (result.outcome != CaseOutcome::passed && !shown.golden.rgba.empty()) result.golden = png_bytes(shown.golden);
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
            std::error_code ignored;
            if (!std::filesystem::equivalent(golden, input, ignored)) continue;
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
            const JsonText before = parse_json(read_file(file), file.string()), now = parse_json(asked, "the test");
            if (compare::first_unlike(&now.root(), &before.root(), compare::kExactly))
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

double similarity_loss(const Image& actual, const Image& golden, const Image* mask) {
    constexpr int kSide = 4;
    if (!mask) return largest_ssim_loss(shrunk(actual, kSide), shrunk(golden, kSide));
    Image seen = actual;
    for (int y = 0; y < seen.height; ++y) {
        for (int x = 0; x < seen.width; ++x) {
            if (!is_compared(mask, x, y)) std::copy_n(golden.at(x, y), 4, seen.at(x, y));
        }
    }
    return largest_ssim_loss(shrunk(seen, kSide), shrunk(golden, kSide));
}

CaseResult run_case(const CaseFile& file, PictureMaker* maker, std::string_view no_opengl, const RunOptions& options) {
    CaseResult result;
    result.file = file;
    const auto begin = std::chrono::steady_clock::now();
    if (maker) {
        const Renderer& renderer = maker->renderer();
        result.drawn_by = {std::string(maker->backend()), renderer.context().device(), reference_of(renderer)};
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
    // There is nothing else to remark on where nothing was drawn.
    if (lacks_opengl(result)) {
        for (const std::string& remark : result.remarks) out << "  " << cleaned(remark) << '\n';
    }
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
        const std::string ending = result.file.ending_of(result.shown);
        out << "  actual:  " << cleaned(stem + ".actual" + ending) << '\n';
        if (!result.golden.empty()) out << "  golden:  " << cleaned(whole_path(result.shown).string()) << '\n';
        if (result.image && result.image->same_size) out << "  differs: " << cleaned(stem + ".heat" + ending) << '\n';
    }
    if (can_be_taken(result)) {
        out << "  if it is right: mobbscope test " << shell_word(whole_path(result.file.folder()).string()) << ' '
            << shell_word(result.file.name) << " --accept " << shell_word(whole_path(folder).string()) << '\n';
    } else if (!result.other_here.empty()) {
        out << "  the goldens are from elsewhere: here are " << cleaned(result.other_here) << '\n';
    }
    return std::move(out).str();
}

std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder) {
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
    for (const CaseFile::Golden golden : {&CaseFile::golden, &CaseFile::plain}) {
        const std::filesystem::path file = (result.file.*golden)();
        const std::string ending = result.file.ending_of(file);
        const bool shown = file == result.shown;
        // What accepting writes, to the byte.
        const std::optional<std::string> fresh = fresh_bytes(result, file);
        keep("actual" + ending, !keeps ? std::nullopt : shown && !fresh ? png(result.actual) : fresh);
        keep("golden" + ending, shown && keeps ? png(result.golden) : std::nullopt);
        const std::optional<Image> heat = shown && keeps ? heat_map(result) : std::nullopt;
        keep("heat" + ending, heat ? std::optional(png_bytes(*heat)) : std::nullopt);
    }
    for (const std::filesystem::path& file :
         {result.file.draw(), result.file.plain_state(), result.file.golden_of(Held::answers),
          result.file.golden_of(Held::trace), result.file.golden_of(Held::fit)}) {
        keep("actual" + result.file.ending_of(file), keeps ? fresh_bytes(result, file) : std::nullopt);
    }
    return written;
}

}  // namespace mobbscope::picture_tests
