#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cases/case_file.h>
#include <cases/case_report.h>
#include <cases/case_result.h>
#include <cases/result_line.h>
#include <cli/command_line.h>
#include <cli/golden_updates.h>
#include <cli/options.h>
#include <cli/program.h>
#include <picture_tests/reference.h>
#include <picture_tests/reports.h>
#include <picture_tests/run_cases.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <render/pictures/sheet.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace mobbscope::cli {

namespace {

using picture_tests::CaseFile;
using picture_tests::CaseResult;
using picture_tests::RunFacts;

struct TestCommandArguments {
    std::filesystem::path folder;
    std::vector<std::string> names;  ///< exact or with wildcards; none: all
    bool list = false;
    Backend backend = Backend::automatic;
    bool update = false;
    bool update_all = false;                ///< of those that are run
    std::vector<std::string> update_names;  ///< neither: ask
    bool new_reference = false;             ///< with update_all, of all cases
    std::filesystem::path accept;           ///< the report to take goldens from; empty: none
    bool strict = false;                    ///< an orphaned golden is a failure
    std::filesystem::path output = "mobbscope-test";
    bool json = false;
    bool json_lines = false;
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
    return chosen(all, patterns);
}

// --- what is written

/// Throws InputError if a report would replace a golden or has a name that its kind does not, or if the pictures would
/// go where the goldens are; MachineError if they cannot go where they are to.
void check_reports(const TestCommandArguments& arguments, const std::vector<CaseFile>& all) {
    const bool reports = !arguments.junit.empty() || !arguments.html.empty() || !arguments.contact_sheet.empty();
    if (arguments.json_lines && (arguments.update || arguments.strict || !arguments.accept.empty() || reports)) {
        throw InputError("--json-lines: nothing else is written then; leave out --update, --strict and the reports");
    }
    if (!arguments.accept.empty() && (arguments.update || arguments.strict || arguments.json || reports)) {
        throw InputError(
            "--accept: nothing is drawn and nothing else written then; leave out --update and the reports");
    }
    if (arguments.columns && arguments.contact_sheet.empty()) {
        throw InputError("--columns: they are the contact sheet's; give --contact-sheet too");
    }
    check_extension(arguments.junit, ".xml", "the report for CI servers is written as .xml; rename it");
    check_extension(arguments.html, ".html", "the report as a page is written as .html; rename it");
    check_extension(arguments.contact_sheet, ".png", "the contact sheet is written as .png; rename it");
    for (const CaseFile& file : all) {
        for (const auto& read :
             {file.file, file.golden(), file.plain(), file.draw(), file.plain_draw(), file.plain_state()})
            note_read(read);
    }
    for (const std::filesystem::path& report : {arguments.junit, arguments.html, arguments.contact_sheet})
        check_not_read(report);
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.output, arguments.folder, ignored)) {
        throw InputError("--output: " + in_quotes(arguments.output.string()) +
                         " is where the goldens are; give another folder");
    }
    if (std::filesystem::exists(arguments.output, ignored) && !std::filesystem::is_directory(arguments.output)) {
        throw MachineError(arguments.output.string() + ": pictures cannot be written there: it is no folder");
    }
}

using WriteReport = void (*)(std::ostream& out, const RunFacts& facts, std::span<const CaseResult> results);

/// Into a file, whose folder is made if need be.
void write_report(const std::filesystem::path& file, WriteReport write, const RunFacts& facts,
                  std::span<const CaseResult> results) {
    if (file.empty()) return;
    check_not_read(file);  // again: scenes and masks are known now
    std::ostringstream text;
    write(text, facts, results);
    picture_tests::make_folder_of(file);
    write_file(file, text.str());
}

/// The theme of a sheet that suits a picture: by its corner, where seldom anything is drawn.
Theme theme_around(const Image& picture) {
    const std::uint8_t* corner = picture.at(0, 0);
    return corner[0] + corner[1] + corner[2] > 3 * 127 ? Theme::light : Theme::dark;
}

/// All pictures of the run with their names.
void write_contact_sheet(const TestCommandArguments& arguments, std::span<const CaseResult> results,
                         Renderer& renderer) {
    std::vector<SheetCell> cells;
    PictureSize all{1, 0};
    for (const CaseResult& result : results) {
        if (result.actual.rgba.empty()) continue;
        cells.push_back({result.file.name, result.actual});
        all.width = std::max(all.width, result.actual.width);
        all.height = std::max(all.height, result.actual.height);
    }
    if (cells.empty()) {
        warn("there is no picture for a contact sheet");
        return;
    }
    const int count = static_cast<int>(cells.size());
    const int square = static_cast<int>(std::lround(std::sqrt(count)));
    const int columns = std::min(count, arguments.columns.value_or(square));
    // Letters grow with the whole, which is looked at smaller than its pictures are.
    all = {all.width * columns, all.height * ((count + columns - 1) / columns)};
    const Palette& colors = palette(theme_around(cells.front().image));
    const Image sheet = at_place(arguments.contact_sheet.string(), "", [&] {
        return make_sheet(cells, columns, colors, colors.background, metrics_of(all), renderer);
    });
    check_not_read(arguments.contact_sheet);
    picture_tests::make_folder_of(arguments.contact_sheet);
    write_png(arguments.contact_sheet, sheet);
}

// --- the run

/// The context, or why there is none.
struct Drawer {
    std::unique_ptr<picture_tests::PictureMaker> maker;
    std::string no_opengl;
    RunFacts facts;
};

Drawer open(const TestCommandArguments& arguments) {
    Drawer out;
    out.facts.folder = arguments.folder.string();
    out.facts.page = arguments.html.string();
    out.facts.strict = arguments.strict;
    try {
        out.maker = std::make_unique<picture_tests::PictureMaker>(arguments.backend);
        out.facts.backend = out.maker->backend();
        out.facts.renderer = out.maker->renderer().device();
    } catch (const MachineError& error) {
        out.no_opengl = error.what();
    }
    return out;
}

/// The pictures of what did not pass, and all of it as a report; whether there are any.
bool keep_all(const TestCommandArguments& arguments, const RunFacts& facts, std::span<const CaseResult> results) {
    bool kept = false;
    for (const CaseResult& result : results) kept = !keep_pictures(result, arguments.output).empty() || kept;
    const std::filesystem::path file = arguments.output / picture_tests::kReportFile;
    if (picture_tests::summary(results).ok()) {
        // Where only some are run, it may still tell of the others.
        std::error_code ignored;
        if (arguments.names.empty() && arguments.update_names.empty()) std::filesystem::remove(file, ignored);
        return kept;
    }
    std::ostringstream report;
    write_case_report(report, results, {facts.backend, facts.renderer});
    picture_tests::make_folder_of(file);
    check_stays_in_folder(file);
    write_file(file, report.str());
    return kept;
}

/// What goes to standard output when it is all done.
void print_results(const TestCommandArguments& arguments, const RunFacts& facts, std::span<const CaseResult> results,
                   bool kept) {
    if (arguments.json) {
        write_json(std::cout, facts, results);
    } else {
        write_text(std::cout, facts, results);
        if (kept) std::cout << "Pictures of what did not pass: " << cleaned(arguments.output.string()) << '\n';
    }
    flush_results();
}

/// Each result goes as soon as it is told; the exit status.
int tell_lines(const std::vector<CaseFile>& cases, const Drawer& drawer) {
    picture_tests::Summary sum;
    for (const CaseFile& file : cases) {
        const CaseResult result = run_case(file, drawer.maker.get(), drawer.no_opengl);
        ++sum[result.outcome];
        write_result_line(std::cout, result, {drawer.facts.backend, drawer.facts.renderer});
        flush_results();
    }
    if (!drawer.maker) throw MachineError(drawer.no_opengl);
    return sum.ok() ? kDone : kFailed;
}

/// Throws InputError if the mask of a case does not fit its golden.
void check_masks(const std::vector<CaseFile>& cases) {
    for (const CaseFile& file : cases) {
        std::optional<std::filesystem::path> mask;
        std::optional<Image> golden;
        try {
            const picture_tests::CaseTerms terms = picture_tests::read_terms(file);
            if (!terms.skip) mask = terms.mask;
            if (mask) golden = read_png(file.golden());
        } catch (const InputError&) {
            // What is wrong with a case or a golden, or that there is none, is told where the case is drawn.
        }
        if (golden) read_mask(*mask, {golden->width, golden->height}, file.golden());
    }
}

/// Named cases are taken whatever they are; of all those that are no golden yet.
picture_tests::RunOptions run_options(const TestCommandArguments& arguments, const CaseFile& file) {
    using picture_tests::FreshGoldens, picture_tests::GoldenSource;
    if (arguments.new_reference) return {GoldenSource::here, FreshGoldens::of_all};
    if (matches_any(arguments.update_names, file.name)) return {GoldenSource::reference, FreshGoldens::of_all};
    return {GoldenSource::reference, arguments.update_all ? FreshGoldens::missing : FreshGoldens::of_failed};
}

std::vector<std::string> orphans_of(const TestCommandArguments& arguments, const std::vector<CaseFile>& all) {
    const auto whole = [](const std::filesystem::path& file) {
        return std::filesystem::absolute(file).lexically_normal();
    };
    const std::filesystem::path output = whole(arguments.output / "");
    std::vector<std::string> out;
    for (const std::filesystem::path& file : picture_tests::orphaned_goldens(arguments.folder, all)) {
        // The contact sheet and pictures of an earlier run may stand there.
        const bool is_sheet = !arguments.contact_sheet.empty() && whole(file) == whole(arguments.contact_sheet);
        if (!is_sheet && !whole(file).string().starts_with(output.string())) out.push_back(file.string());
    }
    return out;
}

int run_test(const TestCommandArguments& arguments) {
    const std::vector<CaseFile> all = picture_tests::find_cases(arguments.folder);
    const std::vector<CaseFile> cases = cases_of(arguments, all);
    if (arguments.list) {
        for (const CaseFile& file : cases) std::cout << cleaned(file.name) << '\n';
        flush_results();
        return kDone;
    }
    check_reports(arguments, all);
    if (!arguments.accept.empty()) {
        const bool taken = take_report(arguments.accept, all, arguments.names, std::cout);
        flush_results();
        return taken ? kDone : kFailed;
    }
    // A mask that fits what is drawn now may wait for a golden of that size.
    if (!arguments.json_lines && !arguments.update) check_masks(cases);
    const bool asks = arguments.update && !arguments.update_all && arguments.update_names.empty();
    if (asks && ::isatty(STDIN_FILENO) == 0) {
        throw InputError("--update: there is no terminal to ask at; name the cases whose pictures to take, or all");
    }

    Drawer drawer = open(arguments);
    const bool renews = arguments.new_reference && drawer.maker;
    if (arguments.update && drawer.maker && !renews) {
        check_references(arguments.folder, cases, picture_tests::reference_of(drawer.maker->renderer()));
    }
    if (arguments.json_lines) return tell_lines(cases, drawer);
    if (arguments.names.empty()) drawer.facts.orphans = orphans_of(arguments, all);
    std::vector<CaseResult> results;
    for (const CaseFile& file : cases) {
        results.push_back(run_case(file, drawer.maker.get(), drawer.no_opengl, run_options(arguments, file)));
    }
    // Where standard output is a report, the rest goes beside it.
    std::ostream& say = arguments.json ? std::cerr : std::cout;
    if (renews) {
        take_as_reference(results, cases, picture_tests::reference_of(drawer.maker->renderer()), say);
    } else if (asks) {
        take_asked(results, arguments.output, say);
    } else if (arguments.update) {
        take_named(results, arguments.update_names, say);
    }
    const bool kept = keep_all(arguments, drawer.facts, results);
    write_report(arguments.junit, picture_tests::write_junit, drawer.facts, results);
    write_report(arguments.html, picture_tests::write_html, drawer.facts, results);
    print_results(arguments, drawer.facts, results, kept);
    if (!drawer.maker) throw MachineError(drawer.no_opengl);
    if (!arguments.contact_sheet.empty()) write_contact_sheet(arguments, results, drawer.maker->renderer());
    return is_ok(drawer.facts, results) ? kDone : kFailed;
}

/// A reference is that of all goldens of a folder.
void check_new_reference(const TestCommandArguments& arguments) {
    if (!arguments.new_reference || (arguments.update_all && arguments.names.empty())) return;
    throw InputError("--new-reference: goldens are from one place; take all of them, with --update all and no NAME");
}

/// "all" alone stands for all cases that are run.
void read_update(TestCommandArguments& arguments) {
    arguments.update = true;
    std::vector<std::string>& names = arguments.update_names;
    std::erase(names, "");
    if (std::find(names.begin(), names.end(), "all") == names.end()) return;
    if (names.size() > 1) throw InputError("--update: all are more than the others that are named; leave those out");
    arguments.update_all = true;
    names.clear();
}

}  // namespace

void add_test_command(Command& program, int& status) {
    program.add_subcommand(
        "test", "Draw picture tests and hold them against their goldens", [&status](Command& command) {
            const auto arguments = std::make_shared<TestCommandArguments>();
            command.add_option("DIR", arguments->folder, "The folder of the cases, NAME.case.json").required();
            command.add_option("NAME", arguments->names, "Only these cases; * and ? stand for anything");
            command.add_flag("--list", arguments->list, "Only print the names of the cases");
            add_parsed(command, "--backend", arguments->backend, one_of(backend_from_name, "auto, osmesa, egl"),
                       "OpenGL without a display: auto, osmesa or egl", "NAME");
            command
                .add_option(
                    "--update", arguments->update_names,
                    "Take the present pictures as goldens: of these cases, whatever differs, or of all that do not "
                    "pass; without names, ask for each",
                    "NAME")
                .any_number();
            command.add_flag("--new-reference", arguments->new_reference,
                             "With --update all: say in reference.json what the goldens are drawn with, where they "
                             "must be the very same");
            add_parsed(command, "--accept", arguments->accept, parse_file_name,
                       "Draw nothing: take the goldens of a report, the folder of --output or the page of --html, byte "
                       "by byte, on any system",
                       "REPORT");
            command.add_flag("--strict", arguments->strict, "Exit with 1 if there is a golden that no case has");
            add_parsed(command, "--output", arguments->output, parse_file_name,
                       "Where the pictures of what did not pass go (mobbscope-test)", "FOLDER");
            const Option json = command.add_flag("--json", arguments->json, "The report as JSON on standard output");
            Option json_lines =
                command.add_flag("--json-lines", arguments->json_lines,
                                 "Each result as a line of JSON as soon as it is there, with its pictures, for "
                                 "other programs; nothing else is written");
            json_lines.excludes(json);
            add_parsed(command, "--junit", arguments->junit, parse_file_name, "The report for CI servers", "OUT.xml");
            add_parsed(command, "--html", arguments->html, parse_file_name, "The report as one page, with all pictures",
                       "OUT.html");
            add_parsed(command, "--contact-sheet", arguments->contact_sheet, parse_file_name,
                       "All pictures of the run in one", "OUT.png");
            add_parsed(
                command, "--columns", arguments->columns,
                [](const std::string& text) {
                    const std::optional<int> columns = parse_int(text);
                    if (!columns || *columns < 1)
                        throw std::invalid_argument(in_quotes(text) + " is no number of columns");
                    return *columns;
                },
                "Of the contact sheet", "N");
            command.callback([&command, arguments, &status] {
                if (command.is_given("--update")) read_update(*arguments);
                check_new_reference(*arguments);
                status = run_test(*arguments);
            });
        });
}

}  // namespace mobbscope::cli
