#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/program.h>
#include <cli/query_comparisons.h>
#include <cli/text_rows.h>
#include <explain/query_sentence.h>
#include <explain/trace_comparison.h>
#include <scene/answer.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

/// What a check of all queries has come to.
struct CheckTotals {
    int answers = 0, traces = 0, failed = 0;
    std::int64_t events = 0;
};

/// The event of one side, or null where it has none.
void write_side(JsonWriter& json, const char* name, const mobb::Trace& trace, int step) {
    json.key(name);
    step < trace.size() ? write_event(json, trace, step) : json.null();
}

void write_check(JsonWriter& json, std::size_t index, const QueryCheck& checked) {
    json.begin_object();
    json.members("query", index, "a", checked.query.a.name, "b", checked.query.b.name);
    json.member("answer_agrees", checked.query.expect ? std::optional(!checked.disagrees) : std::nullopt);
    json.key("trace");
    if (!checked.trace) {
        json.null();
    } else {
        const TraceCheck& trace = *checked.trace;
        json.begin_object();
        json.members("agrees", trace.agrees(), "stored", trace.stored_events, "present", trace.present_events,
                     "compared", trace.compared, "rounding", trace.rounding);
        json.key("difference");
        if (!trace.difference) {
            json.null();
        } else {
            json.begin_object();
            json.member("step", trace.difference->step);
            json.values("members", trace.difference->members);
            write_side(json, "stored", *checked.query.trace, trace.difference->step);
            write_side(json, "present", *checked.answer.trace, trace.difference->step);
            json.end_object();
        }
        json.end_object();
    }
    json.member("disagreement", checked.complaint());
    json.end_object();
}

/// What was not captured says nothing of the answers.
void refuse_altered_clips(const Scene& scene, const std::filesystem::path& file) {
    for (const SceneClip& clip : scene.clips) {
        const auto altered = std::ranges::find(clip.facts.warnings, kDigest, &ImportWarning::option);
        if (altered != clip.facts.warnings.end())
            throw InputError(file, "/clips/" + clip.name + "/digest",
                             altered->text + "; check the file as it was captured");
    }
}

std::string totals_words(const CheckTotals& totals, std::size_t queries) {
    if (totals.answers + totals.traces == 0)
        return "Nothing was compared: no query has an expected answer or a stored trace.";
    std::string out = "Compared " + counted(totals.answers, "answer", "answers") + " and " +
                      counted(totals.traces, "trace", "traces") + " (" + counted(totals.events, "event", "events") +
                      ") of " + counted(queries, "query", "queries") + ": ";
    if (totals.failed == 0) return out + "all agree.";
    return out + counted(totals.failed, "query disagrees.", "queries disagree.");
}

void write_decision(JsonWriter& json, const Decision& decision) {
    json.row("step", decision.step, "depth", decision.depth, "gap",
             decision.is_boxes ? std::optional(decision.gap) : std::nullopt, "tests", decision.tests);
}

void write_comparison(JsonWriter& json, std::size_t index, const SceneQuery& query, const RecordedQuery& first,
                      const FitComparison& other, const std::array<mobb::FitOptions, 2>& fits) {
    const std::array both{&first, &other.recorded};
    json.begin_object();
    json.members("query", index, "a", query.a.name, "b", query.b.name);
    json.begin_array("sides");
    for (std::size_t side = 0; side < 2; ++side) {
        const RecordedQuery& recorded = *both[side];
        json.begin_object();
        json.key("fit");
        write_fit(json, fits[side]);
        json.begin_object("tests", JsonWriter::Layout::row);
        for (const mobb::TestKind test : mobb::kTestKinds) json.member(mobb::name(test), recorded.tests[test]);
        json.end_object();
        if (recorded.trace.stopped())
            json.members("recorded", recorded.trace.size(), "events", recorded.trace.events());
        json.end_object();
    }
    json.end_array();
    json.begin_object("difference", JsonWriter::Layout::row);
    for (const mobb::TestKind test : mobb::kTestKinds)
        json.member(mobb::name(test), other.recorded.tests[test] - first.tests[test]);
    json.end_object();
    json.begin_array("times");
    for (const ComparedTime& time : other.traversals.times) {
        json.begin_object();
        json.members("t0", time.t0, "t1", time.t1, "earlier", time.earlier);
        json.begin_array("sides");
        for (std::size_t side = 0; side < 2; ++side) write_decision(json, other.traversals.decision(time, side));
        json.end_array();
        json.end_object();
    }
    json.end_array();
    json.end_object();
}

void print_comparison(std::ostream& out, std::size_t index, const SceneQuery& query, const RecordedQuery& first,
                      const FitComparison& other) {
    const std::array<std::string, 2>& names = other.names;
    out << index << ": " << sentence(query, first.contact) << '\n';
    const auto line = [&](std::string_view label, const auto& one, const auto& two, const auto& difference) {
        out << "   " << std::left << std::setw(16) << label << std::right;
        out << std::setw(std::max(8, static_cast<int>(names[0].size()) + 2)) << one;
        out << std::setw(std::max(8, static_cast<int>(names[1].size()) + 2)) << two;
        out << std::setw(12) << difference << '\n';
    };
    line("tests", names[0], names[1], "difference");
    for (const mobb::TestKind test : mobb::kTestKinds) {
        const std::int64_t one = first.tests[test], two = other.recorded.tests[test];
        if (one != 0 || two != 0) line(mobb::name(test), one, two, two - one);
    }
    out << "   " << comparison_words(other.traversals, other.names) << ".\n";
    for (std::size_t side = 0; side < 2; ++side) {
        const mobb::Trace& trace = (side == 0 ? first : other.recorded).trace;
        if (trace.stopped()) out << "   Of " << names[side] << ' ' << recording_words(trace) << ".\n";
    }
    for (const ComparedTime& time : other.traversals.times) {
        out << "   " << to_thousandth(time.t0) << " to " << to_thousandth(time.t1)
            << " s: " << earlier_words(time.earlier, names) << '\n';
        for (std::size_t side = 0; side < 2; ++side) {
            out << "      " << names[side] << ": " << decision_words(other.traversals.decision(time, side)) << '\n';
        }
    }
}

}  // namespace

int check_queries(const FittedScene& fitted, const std::filesystem::path& file, bool json) {
    refuse_altered_clips(fitted.scene(), file);
    CheckTotals totals;
    std::vector<std::string> complaints;
    JsonWriter out(std::cout);
    if (json) {
        out.begin_object();
        out.begin_array("checks");
    }
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        const SceneQuery query = fitted.queries()[index];
        if (!query.expect && !query.trace) continue;
        const QueryCheck checked = check_query(fitted, query);
        if (query.expect) ++totals.answers;
        if (checked.trace) {
            ++totals.traces;
            totals.events += checked.trace->compared;
        }
        const std::optional<std::string> complaint = checked.complaint();
        if (complaint) {
            ++totals.failed;
            complaints.push_back("query " + std::to_string(index) + ": " + *complaint);
        }
        if (json) {
            write_check(out, index, checked);
        } else if (!complaint) {
            std::cout << index << ": " << (query.expect ? "as expected, " : "")
                      << sentence(query, checked.answer.contact) << '\n';
            if (checked.trace)
                std::cout << "   " << check_words(*checked.trace, checked.sides, *query.trace, *checked.answer.trace)
                          << ".\n";
        }
    }
    if (json) {
        out.end_array();
        out.key("compared");
        out.row("answers", totals.answers, "traces", totals.traces, "events", totals.events);
        out.member("agrees", totals.failed == 0);
        out.end_object();
    } else {
        std::cout << totals_words(totals, fitted.queries().size()) << '\n';
    }
    flush_results();
    for (const std::string& complaint : complaints) complain(shown_name(file) + ": " + complaint);
    return totals.failed == 0 ? kDone : kFailed;
}

int compare_queries(const FittedScene& fitted, const mobb::FitOptions& other, bool json) {
    const FittedScene second(fitted.scene(), other, &fitted);
    const std::array fits{fitted.options(), other};
    JsonWriter out(std::cout);
    if (json) {
        out.begin_object();
        out.begin_array("comparisons");
    }
    TextRows rows;
    for (std::size_t index = 0; index < fitted.queries().size(); ++index) {
        if (!json && !rows.take()) {
            tell_left_out(std::cout, fitted.queries().size() - index);
            break;
        }
        const SceneQuery query = fitted.queries()[index];
        const RecordedQuery recorded = record(fitted, query);
        const FitComparison compared = compare_fits(fitted.placed(query.a), fitted.placed(query.b), recorded,
                                                    {second.shared_tree(query.a), second.shared_tree(query.b)});
        if (json) {
            write_comparison(out, index, query, recorded, compared, fits);
        } else {
            print_comparison(std::cout, index, query, recorded, compared);
        }
    }
    if (json) {
        out.end_array();
        out.end_object();
    }
    flush_results();
    return kDone;
}

}  // namespace mobbscope::cli
