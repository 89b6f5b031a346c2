#include <cli/answer.h>
#include <cli/messages.h>
#include <scene/trace_json.h>

#include <cmath>
#include <ostream>
#include <string_view>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

// A capture may come from a program that computes in another order; this is far above rounding, far below meaning.
constexpr double kAgreement = 1e-9;

/// Runs the query, by trees or directly, under an observer.
template <class Observer>
std::optional<mobb::Contact> ask(const FittedScene& fitted, const SceneQuery& query, bool brute, Observer& observer) {
    const mobb::PlacedTree a = fitted.placed(query.a);
    const mobb::PlacedTree b = fitted.placed(query.b);
    return brute ? mobb::direct_search(a.placed_clip(), b.placed_clip(), observer) : mobb::query(a, b, observer);
}

bool agrees(double expected, double found) {
    return std::abs(expected - found) <= kAgreement * std::max(1.0, std::abs(expected));
}

bool agrees(const mobb::Contact& expected, const mobb::Contact& found) {
    return expected.a_sample == found.a_sample && expected.b_sample == found.b_sample &&
           agrees(expected.time, found.time) && agrees(expected.distance, found.distance) &&
           agrees(expected.radii, found.radii);
}

std::string sentence(const SceneQuery& query, const std::optional<mobb::Contact>& contact) {
    if (!contact) return query.a.name + " and " + query.b.name + " never collide.";
    return query.a.name + " and " + query.b.name + " collide at " + brief(contact->time) + " s: sample " +
           std::to_string(contact->a_sample) + " of " + query.a.name + " and sample " +
           std::to_string(contact->b_sample) + " of " + query.b.name + " are " + brief(contact->distance) +
           " m apart, their radii add up to " + brief(contact->radii) + " m.";
}

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
    if (event.test == mobb::Test::samples) {
        out << " (" << counted(static_cast<long long>(event.pairs.size()), "pair", "pairs") << " measured";
        if (event.outcome == mobb::Outcome::hit) {
            const mobb::MeasuredPair& pair = event.pairs.back();
            out << ", samples " << pair.i << " and " << pair.j << " at " << brief(pair.distance) << " m";
        }
        out << ')';
    }
    out << '\n';
}

}  // namespace

Answer answer(const FittedScene& fitted, const SceneQuery& query, const Details& details) {
    Answer answer;
    if (details.trace) {
        mobb::TraceRecorder recorder;
        answer.contact = ask(fitted, query, details.brute, recorder);
        answer.trace = recorder.take();
        answer.tests = answer.trace->counts();
    } else {
        mobb::Statistics statistics;
        answer.contact = ask(fitted, query, details.brute, statistics);
        answer.tests = statistics.tests;
    }
    if (details.all_contacts) {
        const mobb::PlacedTree a = fitted.placed(query.a);
        const mobb::PlacedTree b = fitted.placed(query.b);
        answer.contacts = details.brute ? mobb::direct_contact_intervals(a.placed_clip(), b.placed_clip())
                                        : mobb::contact_intervals(a, b);
    }
    return answer;
}

void write_answer(JsonWriter& out, int index, const SceneQuery& query, const Answer& answer) {
    out.begin_object();
    out.member("query", index);
    out.member("a", query.a.name);
    out.member("b", query.b.name);
    out.member("collides", answer.contact.has_value());
    out.key("contact");
    write_contact(out, answer.contact);
    out.key("tests");
    out.begin_object(Layout::row);
    out.member("time", answer.tests.time);
    out.member("obb2d", answer.tests.obb2d);
    out.member("obb3d", answer.tests.obb3d);
    out.member("moving", 0);
    out.member("aabb", 0);
    out.member("samples", answer.tests.samples);
    out.end_object();
    if (answer.contacts) {
        out.key("contacts");
        out.begin_array();
        for (const mobb::Interval& interval : *answer.contacts) out.numbers({interval.t0, interval.t1});
        out.end_array();
    }
    if (answer.trace) {
        out.key("trace");
        write_trace(out, *answer.trace);
    }
    out.end_object();
}

void print_answer(std::ostream& out, int index, const SceneQuery& query, const Answer& answer) {
    out << index << ": " << sentence(query, answer.contact) << '\n'
        << "   Tests: " << answer.tests.time << " of time, " << answer.tests.obb2d << " of 2D boxes, "
        << answer.tests.obb3d << " of 3D boxes; " << counted(answer.tests.samples, "pair", "pairs")
        << " of samples measured.\n";
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
        out << "   Trace (node of " << query.a.name << " x node of " << query.b.name << "):\n";
        for (int step = 0; step < answer.trace->size(); ++step) print_event(out, step, (*answer.trace)[step]);
    }
}

std::optional<std::string> disagreement(const SceneQuery& query, const Answer& answer) {
    if (!query.expect) return std::nullopt;
    const bool same = query.expect->collides == answer.contact.has_value() &&
                      (!query.expect->contact || agrees(*query.expect->contact, *answer.contact));
    if (same) return std::nullopt;
    if (!query.expect->collides) return "expected no collision, but " + sentence(query, answer.contact);
    if (!query.expect->contact) return "expected a collision, but " + sentence(query, answer.contact);
    const mobb::Contact& expected = *query.expect->contact;
    return "expected contact at " + brief(expected.time) + " s between samples " + std::to_string(expected.a_sample) +
           " and " + std::to_string(expected.b_sample) + ", but " + sentence(query, answer.contact);
}

}  // namespace mobbscope::cli
