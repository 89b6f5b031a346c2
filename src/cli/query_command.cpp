#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/certificate_file.h>
#include <explain/event_values.h>
#include <explain/query_sentence.h>
#include <scene/answer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

struct QueryCommandArguments : FittedArguments {
    Details details;
    std::filesystem::path certificate;  ///< to be written; empty: none
    std::optional<std::string> where;   ///< filter of the trace's events
};

void print_event(std::ostream& out, int step, const mobb::Trace::Event& event) {
    // A step's number leads each line, so that it can be given to `render --step`.
    const std::string number = std::to_string(step);
    out << std::string(8 - std::min<std::size_t>(number.size(), 7), ' ') << number << "  "
        << std::string(2 * static_cast<std::size_t>(event.depth), ' ') << event.a << " x " << event.b << "  "
        << mobb::name(event.test) << ": ";
    // In the order of the outcomes.
    constexpr std::array kWords{"apart in time", "separated", "overlap", "hit", "no hit"};
    static_assert(kWords.size() == static_cast<std::size_t>(mobb::Outcome::no_hit) + 1);
    out << kWords[static_cast<std::size_t>(event.outcome)];
    if (event.outcome == mobb::Outcome::separated) {
        out << " along axis " << event.axis << " by " << brief(event.gap) << " m";
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
        out << "   Trace (node of " << cleaned(query.a.name) << " x node of " << cleaned(query.b.name) << ")";
        if (!answer.steps) {
            out << ":\n";
            for (int step = 0; step < answer.trace->size(); ++step) print_event(out, step, (*answer.trace)[step]);
        } else {
            out << ", " << answer.steps->size() << " of " << counted(answer.trace->size(), "event", "events") << ":\n";
            for (const int step : *answer.steps) print_event(out, step, (*answer.trace)[step]);
        }
        if (answer.trace->stopped()) out << "   Here " << recording_words(*answer.trace) << ".\n";
    }
}

std::vector<int> steps_to_tell(const FittedScene& fitted, const SceneQuery& query, const mobb::Trace& trace,
                               const EventFilter& filter) {
    const mobb::PlacedTree a = fitted.placed(query.a);
    const mobb::PlacedTree b = fitted.placed(query.b);
    const Recursion recursion = recursion_of(trace, a, b);
    return steps_that_pass(EventValues(trace, recursion, a, b), filter);
}

/// Answers every query in order; returns the sentences of those that disagree with what the file expects.
std::vector<std::string> answer_all(const FittedScene& fitted, const QueryCommandArguments& arguments,
                                    const std::optional<EventFilter>& where) {
    std::vector<std::string> complaints;
    JsonWriter json(std::cout);
    if (arguments.json) {
        json.begin_object();
        json.begin_array("results");
    }
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        const SceneQuery query = fitted.queries()[index];
        Answer found = answer(fitted, query, arguments.details);
        if (where) found.steps = steps_to_tell(fitted, query, *found.trace, *where);
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

void write_certificates(const FittedScene& scene, const std::filesystem::path& file) {
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.member("mobbscope_certificate", 1);
    json.begin_array("queries");
    for (std::size_t index = 0; index < scene.queries().size(); ++index) {
        const SceneQuery query = scene.queries()[index];
        write_certificate(json, scene, {static_cast<int>(index), certify(scene, query, record(scene, query))});
    }
    json.end_array();
    json.end_object();
    write_file(file, std::move(text).str());
}

/// Says what is wrong in one line, behind the text with a caret.
EventFilter parse_filter(const std::string& text) {
    try {
        return EventFilter(text);
    } catch (const FilterError& error) {
        std::cerr << with_caret(text, error) << '\n';
        throw UsageError(std::string("--where: ") + error.what());
    }
}

int run_query(QueryCommandArguments& arguments) {
    std::optional<EventFilter> where;
    if (arguments.where) where = parse_filter(*arguments.where);
    const FittedScene scene = fitted(load(arguments.file, arguments.import_options), arguments.fit);
    if (scene.queries().empty()) {
        if (scene.scene().crowd)
            throw InputError(arguments.file, "a run asks nothing; mobbscope conflicts finds who collides in it");
        throw InputError(arguments.file, "there is nothing to ask; add queries, or two agents at least");
    }
    if (!arguments.certificate.empty()) check_output(arguments.certificate);
    if (where && arguments.fit.brute)
        throw UsageError("--where filters the tests of trees, and brute makes none; choose another --tree");
    arguments.details.trace |= where.has_value();
    arguments.details.search = arguments.fit.brute ? Search::direct : Search::trees;
    const std::vector<std::string> complaints = answer_all(scene, arguments, where);
    flush_results();
    if (!arguments.certificate.empty()) write_certificates(scene, arguments.certificate);
    for (const std::string& complaint : complaints) complain(shown_name(arguments.file) + ": " + complaint);
    return complaints.empty() ? kDone : kFailed;
}

void add_query_options(Command& command, QueryCommandArguments& arguments) {
    add_fitted_options(command, arguments, "Answers as JSON", Brute::allowed);
    command.add_flag("--trace", arguments.details.trace, "Every test that was made");
    command.add_option("--where", arguments.where,
                       "Only the tests that pass a filter, such as 'gap < 0.05 and level(a) >= 3'", "EXPR");
    add_parsed(command, "--certificate", arguments.certificate, parse_file_name,
               "Also write proofs of the answers, which mobbscope verify checks", "OUT.json");
    command.add_flag("--all-contacts", arguments.details.all_contacts, "All intervals of contact, not only the first");
}

}  // namespace

void add_query_command(Command& program) {
    program.add_subcommand(
        "query", "Answer the scene's queries: do two clips ever collide? Status 1 if an answer is not the expected one",
        add_query_options, run_query);
}

}  // namespace mobbscope::cli
