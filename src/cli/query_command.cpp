#include <base/error.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <scene/answer.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <ostream>
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

void print_event(std::ostream& out, int step, const mobb::Trace::Event& event) {
    // A step's number leads each line, so that it can be given to `render --step`.
    const std::string number = std::to_string(step);
    out << std::string(8 - std::min<std::size_t>(number.size(), 7), ' ') << number << "  "
        << std::string(2 * static_cast<std::size_t>(event.depth), ' ') << event.a << " x " << event.b << "  "
        << mobb::name(event.test) << ": ";
    switch (event.outcome) {
        case mobb::Outcome::disjoint_in_time:
            out << "apart in time";
            break;
        case mobb::Outcome::separated:
            out << "separated along axis " << event.axis << " by " << brief(event.gap) << " m";
            break;
        case mobb::Outcome::overlap:
            out << "overlap";
            break;
        case mobb::Outcome::hit:
            out << "hit";
            break;
        case mobb::Outcome::no_hit:
            out << "no hit";
            break;
    }
    if (event.test == mobb::TestKind::samples) {
        out << " (" << counted(event.pairs.size(), "pair", "pairs") << " measured";
        if (event.outcome == mobb::Outcome::hit) {
            const mobb::MeasuredPair& pair = event.pairs.back();
            out << ", samples " << pair.i << " and " << pair.j << " at " << brief(pair.distance) << " m";
        }
        out << ')';
    }
    out << '\n';
}

/// A sentence, the counts, and what else was asked for.
void print_answer(std::ostream& out, std::size_t index, const SceneQuery& query, const Answer& answer) {
    out << index << ": " << sentence(query, answer.contact) << '\n'
        << "   Tests: " << answer.tests[mobb::TestKind::time] << " of time";
    for (const mobb::BoxKind kind : mobb::kBoxKinds) {
        if (mobb::info(kind).in_paper || answer.tests[kind] > 0) {
            out << ", " << answer.tests[kind] << " of " << mobb::info(kind).plural;
        }
    }
    out << "; " << counted(answer.tests[mobb::TestKind::samples], "pair", "pairs") << " of samples measured.\n";
    if (answer.contacts) {
        out << "   In contact:";
        if (answer.contacts->empty()) out << " never";
        const char* separator = " ";
        for (const mobb::Interval& interval : *answer.contacts) {
            out << separator << brief(interval.t0) << " to " << brief(interval.t1) << " s";
            separator = ", ";
        }
        out << ".\n";
    }
    if (answer.trace) {
        out << "   Trace (node of " << cleaned(query.a.name) << " x node of " << cleaned(query.b.name) << "):\n";
        for (int step = 0; step < answer.trace->size(); ++step) print_event(out, step, (*answer.trace)[step]);
    }
}

/// Answers every query in order; returns the sentences of those that disagree with what the file expects.
std::vector<std::string> answer_all(const FittedScene& fitted, const QueryCommandArguments& arguments) {
    std::vector<std::string> complaints;
    JsonWriter json(std::cout);
    if (arguments.json) {
        json.begin_object();
        json.begin_array("results");
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
