#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/query_comparisons.h>
#include <cli/text_rows.h>
#include <explain/avoidable.h>
#include <explain/body_words.h>
#include <explain/certificate_file.h>
#include <explain/event_values.h>
#include <explain/proof_words.h>
#include <explain/query_sentence.h>
#include <scene/answer.h>
#include <scene/drawn_agent.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::cli {

namespace {

struct QueryCommandArguments : FittedArguments {
    Details details;
    bool proof = false;                 ///< in words
    std::filesystem::path certificate;  ///< to be written; empty: none
    std::optional<std::string> where;   ///< filter of the trace's events
    bool check = false;                 ///< against what the file expects and has stored
    bool bodies = false;                ///< whether their bones touch
    double bone_radius = kBoneRadius;
    std::optional<std::string> compare;  ///< another fit, as text
};

/// A test in the words of its picture, behind its number, which `render --step` takes.
void print_event(std::ostream& out, int step, std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    const std::string number = std::to_string(step);
    out << std::string(8 - std::min<std::size_t>(number.size(), 7), ' ') << number << "  "
        << std::string(2 * static_cast<std::size_t>(event.depth), ' ') << node_name(sides[0], event.a) << " against "
        << node_name(sides[1], event.b) << "  " << mobb::name(event.test) << ": " << outcome_text(sides, event) << '\n';
}

/// An answer proven, and how far it may be pushed.
struct Proven {
    std::vector<TraversalEnd> ends;
    Certificate proof;
    std::optional<Margins> margins;  ///< of a miss in common time
    std::string doubt;               ///< see doubt_words
};

Proven prove(const FittedScene& fitted, const SceneQuery& query) {
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    const RecordedQuery recorded = record(fitted, query);
    Proven out{traversal_ends(a, b, recorded.trace), certify(a, b, recorded), {}, {}};
    out.doubt = doubt_words(cleaned(query.a.name), a.placed_clip(), cleaned(query.b.name), b.placed_clip());
    out.margins = margins_of(a.placed_clip(), b.placed_clip(), out.proof);
    return out;
}

/// Calls `tell` with the bodies of a query and the distances of their bones, or with why there are none.
template <class Tell, class TellWhy>
void measure_bodies(const FittedScene& fitted, const SceneQuery& query, double bone_radius, const Tell& tell,
                    const TellWhy& tell_why) {
    if (const std::string why = why_no_bodies(fitted.scene(), query); !why.empty()) return tell_why(why);
    const auto skeleton = [&](const PlacedAgent& who) -> const Skeleton& {
        return *fitted.scene().clips[static_cast<std::size_t>(who.clip)].skeleton;
    };
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    const PlacedBody body_a(a.placed_clip(), skeleton(query.a)), body_b(b.placed_clip(), skeleton(query.b));
    const Clearance clearance = clearance_over_time(a.placed_clip(), b.placed_clip());
    tell(body_a, body_b, body_distances(body_a, body_b, clearance, bone_radius));
}

void print_bodies(std::ostream& out, const FittedScene& fitted, const SceneQuery& query, double bone_radius) {
    measure_bodies(
        fitted, query, bone_radius,
        [&](const PlacedBody& a, const PlacedBody& b, const BodyDistances& distances) {
            for (const std::string& sentence :
                 body_sentences(a, cleaned(query.a.name), b, cleaned(query.b.name), distances))
                out << "   " << cleaned(sentence) << '\n';
        },
        [&](const std::string& why) { out << "   No bodies: " << cleaned(why) << ".\n"; });
}

void write_bodies_of(JsonWriter& json, const FittedScene& fitted, const SceneQuery& query, double bone_radius) {
    json.key("bodies");
    measure_bodies(
        fitted, query, bone_radius,
        [&](const PlacedBody& a, const PlacedBody& b, const BodyDistances& distances) {
            write_bodies(json, a, b, distances);
        },
        [&](const std::string& why) {
            json.null();
            json.member("no_bodies", why);
        });
}

/// There must be somebody with a body.
void check_bodies(const FittedScene& fitted, const std::filesystem::path& file) {
    std::string why;
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        why = why_no_bodies(fitted.scene(), fitted.queries()[index]);
        if (why.empty()) return;
    }
    throw InputError(file.string(), "", "no query is between two bodies: " + why);
}

/// A sentence, the proof, the counts, and what else was asked for. Events of a trace take rows.
void print_answer(std::ostream& out, std::size_t index, const FittedScene& fitted, const SceneQuery& query,
                  const Answer& answer, const std::optional<Proven>& proven, TextRows& rows) {
    out << index << ": " << sentence(query, answer.contact) << '\n';
    if (proven) out << "   " << proof_words(proven->proof, proven->ends) << '\n';
    if (proven && proven->margins) out << "   " << margin_words(*proven->margins, cleaned(query.b.name)) << '\n';
    if (proven && !proven->doubt.empty()) out << "   Not proven: " << proven->doubt << ".\n";
    out << "   Tests: " << answer.tests[mobb::TestKind::time] << " of time";
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
        out << "   Trace";
        const std::array<DrawnAgent, 2> sides = named_sides(fitted, query);
        std::size_t left_out = 0;
        const auto print = [&](int step) {
            rows.take() ? print_event(out, step, sides, (*answer.trace)[step]) : static_cast<void>(++left_out);
        };
        if (!answer.steps) {
            out << ":\n";
            for (int step = 0; step < answer.trace->size(); ++step) print(step);
        } else {
            out << ", " << answer.steps->size() << " of " << counted(answer.trace->size(), "event", "events") << ":\n";
            std::ranges::for_each(*answer.steps, print);
        }
        tell_left_out(out, left_out, "   ");
        if (answer.trace->stopped()) out << "   Here " << recording_words(*answer.trace) << ".\n";
    }
}

std::vector<int> steps_to_tell(const FittedScene& fitted, const SceneQuery& query, const mobb::Trace& trace,
                               const AvoidableOverlaps& avoidable, const EventFilter& filter) {
    const mobb::PlacedTree a = fitted.placed(query.a);
    const mobb::PlacedTree b = fitted.placed(query.b);
    Recursion recursion = recursion_of(trace, a, b, 0);
    recursion.avoidable = avoidable;
    return steps_that_pass(EventValues(trace, recursion, a, b), filter);
}

/// An answer, and which of its overlaps were avoidable: of trees, with a trace.
Answer judged_answer(const FittedScene& fitted, const SceneQuery& query, const QueryCommandArguments& arguments,
                     AvoidableOverlaps& avoidable, BlameInScene& blame) {
    Answer out = answer(fitted, query, arguments.details);
    if (out.trace && arguments.details.search == Search::trees) {
        avoidable = avoidable_overlaps(*out.trace, fitted.placed(query.a), fitted.placed(query.b));
        blame.add(fitted, query, *out.trace, avoidable);
        out.avoidable = avoidable.events;
    }
    return out;
}

/// The nodes that are to blame, those of the most overlaps first.
void write_blame(JsonWriter& json, const FittedScene& fitted, const BlameInScene& blame) {
    struct Entry {
        int clip, node;
        std::int64_t overlaps;
    };
    std::vector<Entry> entries;
    for (std::size_t clip = 0; clip < blame.of_clip.size(); ++clip) {
        for (std::size_t node = 0; node < blame.of_clip[clip].size(); ++node) {
            if (const std::int64_t overlaps = blame.of_clip[clip][node]; overlaps > 0)
                entries.push_back({static_cast<int>(clip), static_cast<int>(node), overlaps});
        }
    }
    std::ranges::stable_sort(entries, std::greater<>(), &Entry::overlaps);
    json.begin_array("blame");
    for (const Entry& entry : entries) {
        json.begin_object(JsonWriter::Layout::row);
        json.members("clip", fitted.scene().clips[static_cast<std::size_t>(entry.clip)].name, "node", entry.node,
                     "level", fitted.tree(entry.clip).level(entry.node), "overlaps", entry.overlaps);
        json.end_object();
    }
    json.end_array();
}

/// Answers every query in order and writes their proofs, if that is asked for; returns the sentences of those that
/// disagree with what the file expects.
std::vector<std::string> answer_all(const FittedScene& fitted, const QueryCommandArguments& arguments,
                                    const std::optional<EventFilter>& where) {
    std::vector<std::string> complaints;
    BlameInScene blame(fitted);
    JsonWriter json(std::cout);
    if (arguments.json) {
        json.begin_object();
        json.begin_array("results");
    }
    std::vector<QueryCertificate> proofs;
    TextRows rows;
    std::size_t listed = 0;
    // Of those that are not listed an answer may be expected, but not of all pairs of agents.
    const bool needs_all = !arguments.certificate.empty() || !fitted.scene().queries.empty();
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        const bool is_listed = arguments.json || rows.take();
        if (is_listed) ++listed;
        if (!is_listed && !needs_all) break;
        const SceneQuery query = fitted.queries()[index];
        if (!is_listed && !query.expect && arguments.certificate.empty()) continue;
        AvoidableOverlaps avoidable;
        Answer found = judged_answer(fitted, query, arguments, avoidable, blame);
        if (where) found.steps = steps_to_tell(fitted, query, *found.trace, avoidable, *where);
        std::optional<Proven> proven;
        if (arguments.proof || !arguments.certificate.empty()) proven = prove(fitted, query);
        if (arguments.json) {
            json.begin_object();
            write_answer(json, index, query, found);
            if (arguments.bodies) write_bodies_of(json, fitted, query, arguments.bone_radius);
            json.end_object();
        } else if (is_listed) {
            print_answer(std::cout, index, fitted, query, found, arguments.proof ? proven : std::nullopt, rows);
            if (arguments.bodies) print_bodies(std::cout, fitted, query, arguments.bone_radius);
        }
        if (!arguments.certificate.empty()) proofs.push_back({static_cast<int>(index), proven->proof});
        if (const auto complaint = disagreement(query, found)) {
            complaints.push_back("query " + std::to_string(index) + ": " + *complaint);
        }
    }
    if (arguments.json) {
        json.end_array();
        if (arguments.details.trace && arguments.details.search == Search::trees) write_blame(json, fitted, blame);
        json.end_object();
    }
    tell_left_out(std::cout, fitted.queries().size() - listed);
    flush_results();
    if (!arguments.certificate.empty()) write_file(arguments.certificate, certificate_text(fitted, proofs));
    return complaints;
}

/// Says what is wrong in one line, behind the text with a caret and what could stand there.
EventFilter parse_filter(const std::string& text) {
    try {
        return EventFilter(text);
    } catch (const FilterError& error) {
        std::cerr << with_caret(text, error) << '\n';
        const std::vector<std::string_view> expected(error.expected().begin(), error.expected().end());
        if (!expected.empty())
            std::cerr << (expected.size() == 1 ? "expected " : "expected one of: ") << listed(expected) << '\n';
        throw UsageError(std::string("--where: ") + error.what());
    }
}

bool expects_tests(const FittedScene& scene) {
    return std::ranges::any_of(scene.scene().queries, [](const SceneQuery& query) { return expects_tests(query); });
}

/// The fit to compare with: what the text does not say is as in the fit of the scene.
mobb::FitOptions other_fit(const std::string& text, const FittedScene& scene) {
    try {
        return parse_fit(text, scene.options());
    } catch (const std::invalid_argument& error) {
        throw UsageError(std::string("--compare: ") + error.what());
    }
}

int run_query(QueryCommandArguments& arguments) {
    std::optional<EventFilter> where;
    if (arguments.where) where = parse_filter(*arguments.where);
    const FittedScene scene = fitted(load(arguments.file, arguments.import_options), arguments.fit);
    check_asks(scene, arguments.file);
    if (arguments.bodies) check_bodies(scene, arguments.file);
    if (arguments.proof || !arguments.certificate.empty()) refuse_bodies(scene.scene(), "a proof");
    if (!arguments.certificate.empty()) check_output(arguments.certificate);
    for (const auto& [given, option] :
         {std::pair(where.has_value(), "--where filters"), std::pair(arguments.check, "--check compares"),
          std::pair(arguments.compare.has_value(), "--compare compares")}) {
        if (given && arguments.fit.brute)
            throw UsageError(std::string(option) + " the tests of trees, and brute makes none; choose another --tree");
    }
    if (arguments.check) return check_queries(scene, arguments.file, arguments.json);
    if (arguments.compare) return compare_queries(scene, other_fit(*arguments.compare, scene), arguments.json);
    arguments.details.trace |= where.has_value();
    arguments.details.search = arguments.fit.brute ? Search::direct : Search::trees;
    if (arguments.fit.brute && expects_tests(scene))
        warn(shown_name(arguments.file) +
             ": brute makes no tests of trees; expected numbers of tests are not compared");
    const std::vector<std::string> complaints = answer_all(scene, arguments, where);
    for (const std::string& complaint : complaints) complain(shown_name(arguments.file) + ": " + complaint);
    return complaints.empty() ? kDone : kFailed;
}

void add_query_options(Command& command, QueryCommandArguments& arguments) {
    const Option json = add_fitted_options(command, arguments, "Answers as JSON", Brute::allowed);
    const Option trace = command.add_flag("--trace", arguments.details.trace, "Every test that was made");
    const Option proof = command.add_flag("--proof", arguments.proof,
                                          "Also say how few lines prove an answer, and how far it may be pushed");
    Option(proof).excludes(json);
    const Option where =
        command.add_option("--where", arguments.where,
                           "Only the tests that pass a filter, such as 'gap < 0.05 and level(a) >= 3'", "EXPR");
    const Option certificate =
        add_parsed(command, "--certificate", arguments.certificate, parse_output_name,
                   "Also write proofs of the answers, which mobbscope verify checks", "OUT.json");
    const Option contacts = command.add_flag("--all-contacts", arguments.details.all_contacts,
                                             "All intervals of contact, not only the first");
    const Option bodies =
        command.add_flag("--bodies", arguments.bodies,
                         "Also say which bones touch, if any, of clips with skeletons; with --json at every moment");
    add_parsed(command, "--bone-radius", arguments.bone_radius, number_within(0, kMostBoneRadius),
               "Metres of the capsule around each bone (0.05)", "M")
        .needs(bodies);
    Option check = command.add_flag("--check", arguments.check,
                                    "Compare expected answers and stored traces with fresh ones; status 1 if one "
                                    "disagrees");
    Option compare =
        command.add_option("--compare", arguments.compare,
                           "Compare with another fit, such as 'umobb,leaf=20': who decided earlier", "FIT");
    compare.excludes(check);
    for (const Option& other : {trace, proof, where, certificate, contacts, bodies}) {
        check.excludes(other);
        compare.excludes(other);
    }
}

}  // namespace

void add_query_command(Command& program) {
    program.add_subcommand(
        "query", "Answer the scene's queries: do two clips ever collide? Status 1 if an answer is not the expected one",
        add_query_options, run_query);
}

}  // namespace mobbscope::cli
