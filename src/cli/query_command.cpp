#include <base/error.h>
#include <cli/command_line.h>
#include <cli/commands.h>
#include <cli/options.h>
#include <cli/print_answer.h>
#include <cli/program.h>

#include <cstddef>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct QueryCommandArguments {
    std::filesystem::path file;
    bool json = false;
    Details details;
    FitArguments fit;
    ImportOptions import_options;
};

/// Answers every query in order; returns the sentences of those that disagree with what the file expects.
std::vector<std::string> answer_all(const FittedScene& fitted, const QueryCommandArguments& arguments) {
    std::vector<std::string> complaints;
    JsonWriter json(std::cout);
    if (arguments.json) {
        json.begin_object();
        json.key("results");
        json.begin_array();
    }
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        const SceneQuery query = fitted.queries()[index];
        const Answer found = answer(fitted, query, arguments.details);
        arguments.json ? write_answer(json, index, query, found) : print_answer(std::cout, index, query, found);
        if (const auto complaint = disagreement(query, found)) {
            complaints.push_back("query " + std::to_string(index) + ": " + *complaint);
        }
    }
    if (arguments.json) {
        json.end_array();
        json.end_object();
    }
    return complaints;
}

void run_query(QueryCommandArguments& arguments, int& status) {
    Scene scene = load(arguments.file, arguments.import_options);
    const mobb::FitOptions options = arguments.fit.over(scene.fit);
    const FittedScene fitted(std::move(scene), options);
    if (fitted.queries().empty()) {
        if (fitted.scene().crowd)
            throw InputError(arguments.file.string(), "",
                             "a run asks nothing; mobbscope conflicts finds who collides in it");
        throw InputError(arguments.file.string(), "", "there is nothing to ask; add queries, or two agents at least");
    }
    arguments.details.search = arguments.fit.brute ? Search::direct : Search::trees;
    const std::vector<std::string> complaints = answer_all(fitted, arguments);
    flush_results();
    for (const std::string& complaint : complaints) complain(arguments.file.string() + ": " + complaint);
    if (!complaints.empty()) status = kFailed;
}

}  // namespace

void add_query_command(Command& program, int& status) {
    Command& command = program.add_subcommand(
        "query",
        "Answer the scene's queries: do two clips ever collide? Status 1 if an answer is not the expected one");
    const auto arguments = std::make_shared<QueryCommandArguments>();
    add_scene_file(command, arguments->file);
    command.add_flag("--json", arguments->json, "Answers as JSON");
    command.add_flag("--trace", arguments->details.trace, "Every test that was made");
    command.add_flag("--all-contacts", arguments->details.all_contacts, "All intervals of contact, not only the first");
    add_fit_options(command, arguments->fit, Brute::allowed);
    add_import_options(command, arguments->import_options);
    command.callback([arguments, &status] { run_query(*arguments, status); });
}

}  // namespace mobbscope::cli
