#include <cli/commands.h>
#include <cli/exit_status.h>
#include <cli/messages.h>
#include <cli/options.h>
#include <guard/goldens.h>
#include <guard/run_cases.h>
#include <import/error.h>
#include <import/text.h>

#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

struct Arguments {
    std::filesystem::path folder;
    std::vector<std::string> names;  ///< exact or with wildcards; none: all
    Backend backend = Backend::automatic;
    bool update = false;
    std::vector<std::string> update_names;
    std::filesystem::path output = "mobbscope-test";
    bool list = false;
};

bool matches(const std::string& pattern, const std::string& name) {
    return pattern == name || ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

bool matches_any(const std::vector<std::string>& patterns, const std::string& name) {
    return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& p) { return matches(p, name); });
}

/// The cases that the patterns name. Throws InputError for a pattern that names none.
std::vector<guard::CaseFile> chosen(const std::vector<guard::CaseFile>& cases,
                                    const std::vector<std::string>& patterns) {
    std::vector<std::string> names;
    for (const guard::CaseFile& file : cases) names.push_back(file.name);
    for (const std::string& pattern : patterns) {
        if (std::any_of(names.begin(), names.end(), [&](const std::string& name) { return matches(pattern, name); }))
            continue;
        throw InputError("there is no case " + in_quotes(pattern) + did_you_mean(pattern, names));
    }
    std::vector<guard::CaseFile> out;
    std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
                 [&](const guard::CaseFile& file) { return matches_any(patterns, file.name); });
    return out;
}

/// What is answered to "take it?".
enum class Answer { yes, no, all, quit };

Answer ask(const guard::CaseResult& result, const std::vector<std::filesystem::path>& pictures) {
    std::cout << result.file.name << ": " << name(result.outcome) << ": " << cleaned(result.message) << '\n';
    for (const std::filesystem::path& picture : pictures) std::cout << "  " << picture.string() << '\n';
    std::cout << "take it? [y/N/a/q] " << std::flush;
    std::string line;
    if (!std::getline(std::cin, line)) return Answer::quit;
    if (line == "y") return Answer::yes;
    if (line == "a") return Answer::all;
    return line == "q" ? Answer::quit : Answer::no;
}

/// Takes the present pictures as goldens: those named, or those that the person says.
void update(std::vector<guard::CaseResult>& results, const Arguments& arguments) {
    bool all = !arguments.update_names.empty();
    for (guard::CaseResult& result : results) {
        if (!can_be_taken(result)) continue;
        if (!all) {
            const Answer answer = ask(result, keep_pictures(result, arguments.output));
            if (answer == Answer::quit) return;
            if (answer == Answer::no) continue;
            all = answer == Answer::all;
        }
        for (const std::filesystem::path& file : take(result)) std::cout << "wrote " << file.string() << '\n';
    }
}

int run(const Arguments& arguments) {
    const std::vector<guard::CaseFile> there = guard::find_cases(arguments.folder);
    std::vector<std::string> patterns = arguments.names;
    patterns.insert(patterns.end(), arguments.update_names.begin(), arguments.update_names.end());
    std::replace(patterns.begin(), patterns.end(), std::string("all"), std::string("*"));
    const std::vector<guard::CaseFile> cases = patterns.empty() ? there : chosen(there, patterns);
    if (arguments.list) {
        for (const guard::CaseFile& file : cases) std::cout << file.name << '\n';
        flush_results();
        return kDone;
    }
    if (arguments.update && arguments.update_names.empty() && ::isatty(STDIN_FILENO) == 0) {
        throw InputError("--update: there is no terminal to ask at; name the cases whose pictures to take, or all");
    }
    std::unique_ptr<guard::PictureMaker> maker;
    std::string no_opengl;
    try {
        maker = std::make_unique<guard::PictureMaker>(arguments.backend);
    } catch (const MachineError& error) {
        no_opengl = error.what();
    }
    std::vector<guard::CaseResult> results;
    for (const guard::CaseFile& file : cases) results.push_back(run_case(file, maker.get(), no_opengl));
    if (arguments.update) update(results, arguments);
    for (const guard::CaseResult& result : results) {
        if (result.outcome == guard::Outcome::passed) continue;
        std::cout << result.file.name << ": " << name(result.outcome) << ": " << cleaned(result.message) << '\n';
        if (result.outcome == guard::Outcome::skipped) continue;
        for (const std::filesystem::path& picture : keep_pictures(result, arguments.output)) {
            std::cout << "  " << picture.string() << '\n';
        }
    }
    const guard::Summary sum = guard::summary(results);
    std::cout << sum.passed << " passed, " << sum.different << " different, " << sum.missing << " without golden, "
              << sum.failed << " failed, " << sum.skipped << " skipped\n";
    flush_results();
    if (!maker) return kNoMachine;
    return sum.ok() ? kDone : kFailed;
}

}  // namespace

void add_test_command(CLI::App& program, int& status) {
    CLI::App* command = program.add_subcommand("test", "Draw picture tests and hold them against their goldens");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("DIR", arguments->folder, "The folder of the cases, NAME.case.json")->required();
    command->add_option("NAME", arguments->names, "Only these cases; * and ? stand for anything");
    command->add_flag("--list", arguments->list, "Only print the names of the cases");
    add_parsed(
        *command, "--backend", arguments->backend,
        [](const std::string& text) {
            const auto backend = backend_from_name(text);
            if (!backend) throw std::invalid_argument(in_quotes(text) + " is not one of auto, osmesa, egl");
            return *backend;
        },
        "OpenGL without a display: auto, osmesa or egl", "NAME");
    CLI::Option* update = command->add_option("--update", arguments->update_names,
                                              "Take the present pictures of these cases (or all) as goldens; without "
                                              "names, ask for each");
    update->expected(0, -1)->type_name("NAME...");
    command->add_option("--output", arguments->output, "Where pictures of what did not pass go (mobbscope-test)")
        ->type_name("FOLDER");
    command->callback([arguments, update, &status] {
        arguments->update = update->count() > 0;
        std::erase(arguments->update_names, "");
        status = run(*arguments);
    });
}

}  // namespace mobbscope::cli
