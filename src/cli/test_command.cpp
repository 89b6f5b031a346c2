#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/text.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cases/case_result.h>
#include <cases/drawing_child.h>
#include <cases/golden_change.h>
#include <cases/result_line.h>
#include <cases/weak_cases.h>
#include <cli/asked_cases.h>
#include <cli/command_line.h>
#include <cli/golden_updates.h>
#include <cli/options.h>
#include <cli/program.h>
#include <picture_tests/contact_sheet.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/reports.h>
#include <picture_tests/run_cases.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <render/pictures/draw_a_little.h>
#include <scene/scene_json.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

using picture_tests::CaseFile;
using picture_tests::CaseResult;
using picture_tests::Held;
using picture_tests::RunFacts;

/// Every `count`-th case, from this one, from 1.
struct Shard {
    int index = 1, count = 1;
    bool is_all() const { return count == 1; }
};

struct TestCommandArguments {
    std::filesystem::path folder;
    std::vector<std::string> names;  ///< exact or with wildcards; none: all
    bool list = false;
    std::string backend = "auto";
    bool update = false;
    bool update_all = false;                ///< of those that are run
    std::vector<std::string> update_names;  ///< neither: ask
    std::filesystem::path accept;           ///< the report to take goldens from; empty: none
    bool strict = false;                    ///< orphaned goldens and weak cases are failures
    std::filesystem::path output = "mobbscope-test";
    bool json = false;
    bool json_lines = false;
    bool requests = false;  ///< draw what standard input asks for
    bool asked = false;     ///< answer the tests of a program, which ask on standard input
    int jobs = 0;           ///< 0: as many as there are processors
    Shard shard;
    std::filesystem::path junit, html, contact_sheet;  ///< empty: none
    std::optional<int> columns;                        ///< of the contact sheet
};

// --- which cases

/// The cases that the patterns name; without patterns all. Throws InputError for a pattern that names none.
std::vector<CaseFile> chosen(const std::vector<CaseFile>& cases, const std::vector<std::string>& patterns) {
    if (patterns.empty()) return cases;
    std::vector<std::string> names;
    for (const CaseFile& file : cases) names.push_back(file.name);
    for (const std::string& pattern : patterns) {
        const auto is_named = [&](const std::string& name) { return matches_any({pattern}, name); };
        if (std::none_of(names.begin(), names.end(), is_named)) {
            throw InputError("there is no case " + in_quotes(pattern) + did_you_mean(pattern, names));
        }
    }
    std::vector<CaseFile> out;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
                 [&](const CaseFile& file) { return matches_any(patterns, file.name); });
    return out;
}

/// Those of all that are run.
std::vector<CaseFile> cases_of(const TestCommandArguments& arguments, const std::vector<CaseFile>& all) {
    std::vector<std::string> patterns = arguments.names;
    patterns.insert(patterns.end(), arguments.update_names.begin(), arguments.update_names.end());
    const std::vector<CaseFile> named = chosen(all, patterns);
    std::vector<CaseFile> out;
    const Shard& shard = arguments.shard;
    for (std::size_t i = static_cast<std::size_t>(shard.index - 1); i < named.size();
         i += static_cast<std::size_t>(shard.count)) {
        out.push_back(named[i]);
    }
    return out;
}

/// Whether nothing is said of other cases than those that are run.
bool is_part(const TestCommandArguments& arguments) {
    return !arguments.names.empty() || !arguments.update_names.empty() || !arguments.shard.is_all();
}

/// "2/3".
Shard parse_shard(const std::string& text) {
    constexpr int kMostShards = 10'000;
    const std::size_t slash = text.find('/');
    const std::optional<int> index = parse_int(text.substr(0, slash));
    const std::optional<int> count = slash == text.npos ? std::nullopt : parse_int(text.substr(slash + 1));
    if (!index || !count || *index < 1 || *index > *count || *count > kMostShards) {
        throw std::invalid_argument(in_quotes(text) + " is not a shard; give K/N, such as 2/3");
    }
    return {*index, *count};
}

std::string text_of(const Shard& shard) { return std::to_string(shard.index) + '/' + std::to_string(shard.count); }

int parse_jobs(const std::string& text) {
    constexpr int kMostJobs = 256;
    const std::optional<int> jobs = parse_int(text);
    if (!jobs || *jobs < 1 || *jobs > kMostJobs) {
        throw std::invalid_argument(in_quotes(text) + " is not a number of processes from 1 to " +
                                    std::to_string(kMostJobs));
    }
    return *jobs;
}

// --- what is written

/// Throws InputError if the pictures would go where the goldens are, MachineError if they cannot go where they are to.
void check_output_folder(const TestCommandArguments& arguments) {
    if (is_same_file(arguments.output, arguments.folder)) {
        throw InputError("--output: " + in_quotes(arguments.output.string()) +
                         " is where the goldens are; give another folder");
    }
    std::error_code ignored;
    if (std::filesystem::exists(arguments.output, ignored) && !std::filesystem::is_directory(arguments.output)) {
        throw MachineError(arguments.output.string() + ": pictures cannot be written there: it is not a folder");
    }
}

void check_report_files(const TestCommandArguments& arguments) {
    for (const std::filesystem::path& report : {arguments.junit, arguments.html, arguments.contact_sheet})
        if (!report.empty()) check_not_read(report);
}

/// Throws InputError if a report would replace a golden or has a name that its kind does not, or as check_output_folder
/// does.
void check_reports(const TestCommandArguments& arguments, const std::vector<CaseFile>& all) {
    const bool reports = !arguments.junit.empty() || !arguments.html.empty() || !arguments.contact_sheet.empty();
    if (arguments.json_lines && (arguments.update || arguments.strict || !arguments.accept.empty() || reports)) {
        throw InputError("--json-lines writes nothing else; leave out --update, --strict and the reports");
    }
    if (!arguments.accept.empty() && !arguments.shard.is_all()) {
        throw InputError("--accept takes all cases, or those that are named; leave out --shard");
    }
    if (!arguments.accept.empty() && (arguments.update || arguments.strict || arguments.json || reports)) {
        throw InputError("--accept draws nothing and writes nothing else; leave out --update and the reports");
    }
    if (arguments.columns && arguments.contact_sheet.empty()) {
        throw InputError("--columns needs --contact-sheet");
    }
    check_extension(arguments.junit, ".xml", "the report for CI servers is written as .xml; rename it");
    check_extension(arguments.html, ".html", "the report as a page is written as .html; rename it");
    check_extension(arguments.contact_sheet, ".png", "the contact sheet is written as .png; rename it");
    for (const CaseFile& file : all) {
        for (const auto& read : {file.file, file.golden(), file.state(), file.golden_of(Held::answers),
                                 file.golden_of(Held::trace), file.golden_of(Held::fit)})
            note_read(read);
    }
    check_report_files(arguments);
    check_output_folder(arguments);
}

/// Throws InputError if anything of what is left beside goldens would replace what was read. Scenes and masks are
/// known when all is drawn.
void check_left(const TestCommandArguments& arguments, std::span<const CaseResult> results) {
    check_report_files(arguments);
    check_not_read(arguments.output / picture_tests::kReportFile);
    for (const CaseResult& result : results) check_kept(result, arguments.output);
}

using WriteReport = void (*)(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);

/// Into a file, whose folder is made if need be.
void write_report(const std::filesystem::path& file, WriteReport write, const RunFacts& facts,
                  std::span<const CaseResult> results) {
    if (file.empty()) return;
    std::ostringstream text;
    write(text, facts, results);
    picture_tests::make_folder_of(file);
    write_file(file, std::move(text).str());
}

void write_contact_sheet(const TestCommandArguments& arguments, const picture_tests::ContactSheet& sheet,
                         std::span<const CaseResult> results) {
    if (arguments.contact_sheet.empty()) return;
    // Its words are drawn with OpenGL, which this process does without else.
    Renderer renderer(*backend_from_name(arguments.backend));
    const std::optional<Image> drawn = at_place(arguments.contact_sheet.string(), "",
                                                [&] { return sheet.draw(results, arguments.columns, renderer); });
    if (!drawn) return warn("there is no case for a contact sheet");
    picture_tests::make_folder_of(arguments.contact_sheet);
    write_png(arguments.contact_sheet, *drawn);
}

// --- the run

/// The signal that asked for the end of the run; 0: none.
volatile std::sig_atomic_t asked_to_end = 0;

/// While this lives, a signal that would end the program is noted; a second one ends it.
class EndIsNoted {
  public:
    EndIsNoted() {
        for (std::size_t i = 0; i < kSignals.size(); ++i) {
            before_[i] = std::signal(kSignals[i], note);
            if (before_[i] == SIG_IGN) std::signal(kSignals[i], SIG_IGN);
        }
    }
    ~EndIsNoted() {
        for (std::size_t i = 0; i < kSignals.size(); ++i) std::signal(kSignals[i], before_[i]);
    }
    EndIsNoted(const EndIsNoted&) = delete;
    EndIsNoted& operator=(const EndIsNoted&) = delete;

  private:
    static constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};
    static void note(int signal) {
        if (asked_to_end != 0) {
            remove_unfinished_files();
            std::signal(signal, SIG_DFL);
            std::raise(signal);
        }
        asked_to_end = signal;
    }
    std::array<void (*)(int), kSignals.size()> before_{};
};

/// The results in the order of the cases, whatever the order in which they come.
class OrderedResults {
  public:
    explicit OrderedResults(const std::vector<CaseFile>& cases) : results_(cases.size()), is_there_(cases.size()) {
        for (std::size_t i = 0; i < cases.size(); ++i) places_.emplace(cases[i].name, i);
    }
    void add(CaseResult result) {
        const std::size_t place = places_.at(result.file.name);
        results_[place] = std::move(result);
        is_there_[place] = true;
    }
    /// The next in order, if it is there; once.
    CaseResult* next() {
        if (next_ == results_.size() || !is_there_[next_]) return nullptr;
        return &results_[next_++];
    }
    /// Those that are there.
    std::vector<CaseResult> take() {
        std::vector<CaseResult> out;
        for (std::size_t i = 0; i < results_.size(); ++i) {
            if (is_there_[i]) out.push_back(std::move(results_[i]));
        }
        return out;
    }

  private:
    std::map<std::string, std::size_t> places_;
    std::vector<CaseResult> results_;
    std::vector<bool> is_there_;
    std::size_t next_ = 0;
};

void drop_pictures(CaseResult& result) {
    result.actual.clear();
    result.golden.clear();
    result.fresh.clear();
}

/// What is to be said of all results; why a picture could not be drawn, or empty.
std::string add_facts(RunFacts& facts, std::span<const CaseResult> results) {
    std::string no_opengl;
    for (const CaseResult& result : results) {
        if (facts.backend.empty() && !draws_nothing(result)) {
            facts.backend = result.drawn_by.backend;
            facts.renderer = result.drawn_by.renderer;
        }
        if (no_opengl.empty()) no_opengl = result.not_drawn;
    }
    return no_opengl;
}

/// What of all that did not pass goes into the report of the output folder.
void keep_report(const TestCommandArguments& arguments, std::span<const CaseResult> results, bool is_whole) {
    using picture_tests::Cases;
    const std::string replaced =
        add_to_case_report(arguments.output, arguments.folder, results, is_whole ? Cases::all : Cases::some);
    if (!replaced.empty()) warn(replaced);
}

/// What goes to standard output when it is all done.
void print_results(const TestCommandArguments& arguments, const RunFacts& facts, std::span<const CaseResult> results) {
    if (arguments.json) {
        write_json(std::cout, facts, results);
    } else {
        write_text(std::cout, facts, results);
        const bool pictures = std::ranges::any_of(results, [](const CaseResult& one) {
            return one.outcome != picture_tests::CaseOutcome::passed && !one.actual.empty();
        });
        if (!picture_tests::summary(results).ok()) {
            std::cout << (pictures ? "Pictures of what" : "What")
                      << " did not pass: " << cleaned(arguments.output.string()) << '\n';
        }
    }
    flush_results();
}

/// Draws what standard input asks for, a case a line, and answers each.
int answer_requests(const TestCommandArguments& arguments) {
    std::unique_ptr<picture_tests::PictureMaker> maker;
    std::string no_opengl;
    try {
        maker = std::make_unique<picture_tests::PictureMaker>(*backend_from_name(arguments.backend));
        // A driver that crashes over its first shaders must do so before a case is asked for, which would be blamed.
        draw_a_little(maker->renderer());
    } catch (const MachineError& error) {
        no_opengl = error.what();
    }
    std::cout << '\n';  // it can draw
    flush_results();
    for (std::string line; std::getline(std::cin, line);) {
        const picture_tests::CaseRequest request = picture_tests::read_request_line(line);
        const CaseFile file = picture_tests::case_named(arguments.folder, request.name);
        write_result_line(std::cout, run_case(file, maker.get(), no_opengl, request.options));
        flush_results();
    }
    return kDone;
}

/// Throws InputError if the mask of a case does not fit its golden, or the state of its picture has an old name.
void check_goldens(const std::vector<CaseFile>& cases) {
    for (const CaseFile& file : cases) {
        std::optional<std::filesystem::path> mask;
        std::optional<PictureSize> golden;
        std::optional<JsonText> state;
        const std::string state_file = file.state().string();
        try {
            const picture_tests::CaseTerms terms = picture_tests::read_terms(file);
            if (terms.skip) continue;
            if (std::filesystem::exists(state_file)) state = parse_json(read_file(state_file), state_file);
            mask = terms.mask;
            if (mask) golden = png_size(read_file(file.golden()), file.golden().string());
        } catch (const InputError&) {
            // What is wrong with a case or a golden, or that there is none, is told where the case is drawn.
        }
        if (state) refuse_old_tree_names(JsonPlace(*state, state_file));
        if (golden) read_mask(*mask, *golden, file.golden());
    }
}

std::vector<std::string> orphans_of(const TestCommandArguments& arguments, const std::vector<CaseFile>& all) {
    const std::filesystem::path output = whole_path(arguments.output) / "";
    std::vector<std::string> out;
    for (const std::filesystem::path& file : picture_tests::orphaned_goldens(arguments.folder, all)) {
        // The contact sheet and pictures of an earlier run may stand there.
        const bool is_sheet =
            !arguments.contact_sheet.empty() && whole_path(file) == whole_path(arguments.contact_sheet);
        if (!is_sheet && !whole_path(file).string().starts_with(output.string())) out.push_back(file.string());
    }
    return out;
}

/// "NAME: why" for each way in which one of the cases sees hardly anything.
std::vector<std::string> weak_cases(const std::vector<CaseFile>& cases) {
    std::vector<std::string> out;
    for (const CaseFile& file : cases) {
        try {
            for (const std::string& how : weaknesses(file, picture_tests::read_terms(file)))
                out.push_back(file.name + ": " + how);
        } catch (const InputError&) {
            // What is wrong with a case is told where it is drawn.
        }
    }
    return out;
}

/// Whether a person is asked which pictures to take.
bool asks(const TestCommandArguments& arguments) {
    return arguments.update && !arguments.update_all && arguments.update_names.empty();
}

void take(const TestCommandArguments& arguments, std::vector<CaseResult>& results) {
    if (!arguments.update) return;
    // Where standard output is a report, the rest goes beside it.
    std::ostream& say = arguments.json ? std::cerr : std::cout;
    if (asks(arguments)) {
        take_asked(results, arguments.output, say);
    } else {
        take_named(results, arguments.update_names, say);
    }
}

/// Draws the cases; of each the result goes where it is wanted as soon as it is there. Returns what else went wrong.
/// Stops where the end is asked for.
std::vector<std::string> draw_all(const TestCommandArguments& arguments, const std::vector<CaseFile>& cases,
                                  OrderedResults& results, picture_tests::ContactSheet& sheet) {
    std::vector<picture_tests::CaseOrder> orders;
    for (const CaseFile& file : cases)
        orders.push_back({file, run_options(file.name, arguments.update_names, arguments.update_all)});
    const auto take_in = [&](CaseResult result) {
        if (!arguments.contact_sheet.empty()) sheet.add(result);
        for (const std::filesystem::path& file : std::exchange(result.read, {})) note_read(file);
        // A run may have thousands, and of those that passed only a page shows pictures, or goldens are taken.
        const bool passed = result.outcome == picture_tests::CaseOutcome::passed;
        if (passed && arguments.html.empty() && !arguments.json_lines && !arguments.update) result.actual.clear();
        results.add(std::move(result));
        while (CaseResult* next = arguments.json_lines ? results.next() : nullptr) {
            write_result_line(std::cout, *next);
            flush_results();
            drop_pictures(*next);
        }
    };
    const picture_tests::CaseDrawer drawer{.backend = arguments.backend, .jobs = arguments.jobs};
    struct Ended {};
    try {
        return draw_cases(drawer, arguments.folder, orders, take_in, [] {
            if (asked_to_end != 0) throw Ended();
        });
    } catch (const Ended&) {
        return {};
    }
}

/// What is written of a run. What the machine does not take is said, and the rest written all the same: the verdicts
/// are wanted all the more. True if all was written.
bool write_all(const TestCommandArguments& arguments, const RunFacts& facts, std::vector<CaseResult>& results) {
    std::vector<std::string> faults;
    const auto attempt = [&](const auto& work) {
        try {
            work();
            return true;
        } catch (const MachineError& error) {
            if (std::ranges::find(faults, error.what()) == faults.end()) faults.emplace_back(error.what());
            return false;
        }
    };
    const bool is_whole = facts.ended.empty();
    if (is_whole) attempt([&] { take(arguments, results); });
    attempt([&] {
        for (const CaseResult& result : results) keep_pictures(result, arguments.output);
    });
    attempt([&] { keep_report(arguments, results, is_whole && !is_part(arguments)); });
    attempt([&] { write_report(arguments.junit, picture_tests::write_junit, facts, results); });
    attempt([&] { write_report(arguments.html, picture_tests::write_html, facts, results); });
    const bool printed = attempt([&] { print_results(arguments, facts, results); });
    for (const std::string& fault : faults) complain(fault);
    if (!printed) {
        std::string said = sum_of(picture_tests::summary(results));
        const char* separator = ": ";
        for (const CaseResult& result : results) {
            if (result.outcome == picture_tests::CaseOutcome::passed) continue;
            said.append(separator).append(result.file.name).append(" (").append(name(result.outcome)).append(")");
            separator = ", ";
        }
        complain(said);
    }
    return faults.empty();
}

/// Answers the tests of another program, a case a line.
int answer_tests(const TestCommandArguments& arguments) {
    check_output_folder(arguments);
    AskedCases asked({.folder = arguments.folder,
                      .output = arguments.output,
                      .backend = arguments.backend,
                      .update_names = arguments.update_names,
                      .update_all = arguments.update_all});
    try {
        for (std::string line; std::getline(std::cin, line);) {
            std::cout << asked.answer(line) << '\n';
            flush_results();
        }
    } catch (const MachineError&) {
        // Who asked has ended meanwhile, or the disk is full: the report is wanted all the more.
        asked.keep_report();
        throw;
    }
    asked.keep_report();
    return kDone;
}

int draw_and_hold(const TestCommandArguments& arguments) {
    if (arguments.requests) return answer_requests(arguments);
    if (arguments.asked) return answer_tests(arguments);
    // What a report brings may be the first.
    const std::vector<CaseFile> all = arguments.accept.empty() ? picture_tests::find_cases(arguments.folder)
                                                               : picture_tests::cases_there(arguments.folder);
    if (!arguments.accept.empty()) {
        check_reports(arguments, all);
        const bool taken = take_report(arguments.accept, arguments.folder, all, arguments.names, std::cout);
        flush_results();
        return taken ? kDone : kFailed;
    }
    const std::vector<CaseFile> cases = cases_of(arguments, all);
    if (arguments.list) {
        for (const CaseFile& file : cases) std::cout << cleaned(file.name) << '\n';
        flush_results();
        return kDone;
    }
    check_reports(arguments, all);
    // A mask that fits what is drawn now may wait for a golden of that size.
    if (!arguments.json_lines && !arguments.update) check_goldens(cases);
    if (asks(arguments) && ::isatty(STDIN_FILENO) == 0) {
        throw InputError("--update: there is no terminal to ask at; name the cases whose pictures to take, or all");
    }
    RunFacts facts{.folder = arguments.folder.string(), .backend = {}, .renderer = {}, .page = arguments.html.string()};
    facts.strict = arguments.strict;
    if (arguments.strict) facts.weak = weak_cases(cases);
    if (!arguments.shard.is_all()) facts.shard = text_of(arguments.shard);
    if (!arguments.json_lines && arguments.names.empty()) facts.orphans = orphans_of(arguments, all);

    OrderedResults ordered(cases);
    picture_tests::ContactSheet sheet(cases.size());
    std::optional<EndIsNoted> noted;
    if (!arguments.json_lines) noted.emplace();  // its lines are written already
    const std::vector<std::string> complaints = draw_all(arguments, cases, ordered, sheet);
    for (const std::string& complaint : complaints) warn(complaint);
    std::vector<CaseResult> results = ordered.take();
    if (asked_to_end != 0)
        facts.ended = "ended after " + std::to_string(results.size()) + " of " + counted(cases.size(), "case", "cases");
    const std::string not_drawn = add_facts(facts, results);
    if (!arguments.json_lines) check_left(arguments, results);
    bool is_written = arguments.json_lines || write_all(arguments, facts, results);
    if (!facts.ended.empty()) {
        noted.reset();
        std::raise(asked_to_end);
    }
    const bool ok = is_ok(facts, results) && complaints.empty();
    // What differs weighs more.
    if (!not_drawn.empty()) ok ? complain(not_drawn) : warn(not_drawn);
    try {
        if (!ok || not_drawn.empty() || !facts.backend.empty()) write_contact_sheet(arguments, sheet, results);
    } catch (const MachineError& error) {
        const std::string message = arguments.contact_sheet.string() + ": not written: " + error.what();
        ok ? complain(message) : warn(message);
        is_written = false;
    }
    if (!ok) return kFailed;
    if (!not_drawn.empty()) return facts.backend.empty() ? kNoMachine : kNotJudged;
    return is_written ? kDone : kNoMachine;
}

/// Throws InputError for an option that says nothing where standard input says which cases are drawn.
void check_requests(const Command& command, const std::string& from, const std::vector<std::string>& also) {
    for (const GivenOption& option : command.given()) {
        if (option.name == "DIR" || option.name == "--backend" || option.name == from) continue;
        if (std::ranges::find(also, option.name) != also.end()) continue;
        throw InputError(from + ": standard input says what is drawn, and nothing else is done; leave out " +
                         option.name);
    }
}

/// "all" alone stands for all cases that are run.
void read_update(TestCommandArguments& arguments) {
    arguments.update = true;
    std::vector<std::string>& names = arguments.update_names;
    std::erase(names, "");
    if (std::find(names.begin(), names.end(), "all") == names.end()) return;
    if (names.size() > 1) throw InputError("--update: all includes the other names; leave those out");
    arguments.update_all = true;
    names.clear();
}

int run_test(const Command& command, TestCommandArguments& arguments) {
    if (arguments.requests) check_requests(command, "--requests", {});
    if (arguments.asked) check_requests(command, "--asked", {"--output", "--update"});
    if (command.is_given("--update")) read_update(arguments);
    if (arguments.asked && asks(arguments)) {
        throw InputError("--update: standard input already names cases; name those whose pictures to take, or all");
    }
    try {
        return draw_and_hold(arguments);
    } catch (const ReaderGone&) {
        // The status that is promised to programs that read lines.
        if (!arguments.json_lines) throw;
        return kNoMachine;
    }
}

void add_test_options(Command& command, TestCommandArguments& arguments) {
    command.add_option("DIR", arguments.folder, "The folder of the cases, NAME.case.json").required();
    command.add_option("NAME", arguments.names, "Only these cases; * and ? stand for anything");
    command.add_flag("--list", arguments.list, "Only print the names of the cases");
    add_backend_name(command, arguments.backend, "OpenGL without a display: auto, osmesa or egl");
    add_parsed(command, "--jobs", arguments.jobs, parse_jobs,
               "Processes that draw at a time; default: as many as there are processors, at most 8", "N");
    add_parsed(command, "--shard", arguments.shard, parse_shard,
               "Only every N-th case, from the K-th: all shards together are all cases", "K/N");
    command
        .add_option("--update", arguments.update_names,
                    "Take the present pictures as goldens: of these cases, whatever differs, or of all that do not "
                    "pass; without names, ask for each",
                    "NAME")
        .any_number();
    add_parsed(command, "--accept", arguments.accept, parse_file_name,
               "Draw nothing: take the goldens of a report, the folder of --output or the page of --html, byte "
               "by byte, on any system",
               "REPORT");
    command.add_flag(
        "--strict", arguments.strict,
        "Exit with 1 if there is a golden that no case has, or a case that sees hardly anything: one that "
        "is skipped, or lets over a tenth of its pixels, or 64 of 255 levels, differ, or whose mask leaves "
        "under 1 % of it");
    add_parsed(command, "--output", arguments.output, parse_output_name,
               "Where the pictures of what did not pass go (mobbscope-test)", "FOLDER");
    const Option json = command.add_flag("--json", arguments.json, "The report as JSON on standard output");
    Option json_lines = command.add_flag("--json-lines", arguments.json_lines,
                                         "Each result as a line of JSON as soon as it is there, with its pictures, for "
                                         "other programs; nothing else is written");
    json_lines.excludes(json);
    command.add_flag("--requests", arguments.requests,
                     "Draw the cases that standard input asks for, a line of JSON each, and answer with lines "
                     "of JSON: so does each of the processes that draw");
    command.add_flag("--asked", arguments.asked,
                     "Draw what tests of another program ask for on standard input, a line of JSON each, compare it "
                     "with the goldens, and answer in words; only goldens are read from DIR");
    add_parsed(command, "--junit", arguments.junit, parse_output_name, "The report for CI servers", "OUT.xml");
    add_parsed(command, "--html", arguments.html, parse_output_name, "The report as one page, with all pictures",
               "OUT.html");
    add_parsed(command, "--contact-sheet", arguments.contact_sheet, parse_output_name, "All pictures of the run in one",
               "OUT.png");
    add_parsed(
        command, "--columns", arguments.columns,
        [](const std::string& text) {
            const std::optional<int> columns = parse_int(text);
            if (!columns || *columns < 1) throw std::invalid_argument(in_quotes(text) + " is not a number of columns");
            return *columns;
        },
        "Of the contact sheet", "N");
}

}  // namespace

void add_test_command(Command& program) {
    program.add_subcommand("test", "Draw picture tests and compare them with their goldens", add_test_options,
                           run_test);
}

}  // namespace mobbscope::cli
