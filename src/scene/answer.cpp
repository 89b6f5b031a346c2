#include <base/sentences.h>
#include <base/text.h>
#include <scene/answer.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

// A capture may come from a program that computes in another order; this is far above rounding, far below meaning.
constexpr double kAgreement = 1e-9;

bool agrees(double expected, double found) {
    return std::abs(expected - found) <= kAgreement * std::max(1.0, std::abs(expected));
}

bool agrees(const mobb::Contact& expected, const mobb::Contact& found) {
    return expected.a_sample == found.a_sample && expected.b_sample == found.b_sample &&
           agrees(expected.time, found.time) && agrees(expected.distance, found.distance) &&
           agrees(expected.radii, found.radii);
}

std::string metres_text(double value) { return figure(value); }

/// Adds what of two contacts differs and is not seen in their sentences.
void add_differences(std::string& out, const mobb::Contact& expected, const mobb::Contact& found) {
    const auto add = [&](const char* what, double one, double other, const char* unit, std::string (*usual)(double)) {
        if (agrees(one, other)) return;
        const auto [before, now] = told_apart(one, other, usual);
        if (out.ends_with('.')) out.pop_back();
        out += std::string("; ") + what + ": expected " + before + unit + ", now " + now + unit;
    };
    const bool is_seen = to_thousandth(expected.time) != to_thousandth(found.time);
    if (!is_seen) add("time", expected.time, found.time, " s", to_thousandth);
    add("distance", expected.distance, found.distance, " m", metres_text);
    add("sum of radii", expected.radii, found.radii, " m", metres_text);
}

/// Of collision and contact.
std::optional<std::string> other_answer(const SceneQuery& query, const Answer& answer) {
    const Expectation& expect = *query.expect;
    if (!expect.collides) return std::nullopt;
    const bool same =
        *expect.collides == answer.contact.has_value() && (!expect.contact || agrees(*expect.contact, *answer.contact));
    if (same) return std::nullopt;
    if (!*expect.collides) return "expected no collision, but " + sentence(query, answer.contact);
    if (!expect.contact) return "expected a collision, but " + sentence(query, answer.contact);
    std::string out = "expected contact at " + to_thousandth(expect.contact->time) + " s between samples " +
                      std::to_string(expect.contact->a_sample) + " and " + std::to_string(expect.contact->b_sample) +
                      ", but " + sentence(query, answer.contact);
    if (answer.contact) add_differences(out, *expect.contact, *answer.contact);
    return out;
}

/// Of all members of bodies.
std::vector<mobb::Interval> contacts_of(const FittedScene& fitted, const SceneQuery& query, Search search) {
    std::vector<mobb::Interval> out;
    const std::vector<PlacedAgent> of_b = members_of(fitted.scene(), query.b);
    for (const PlacedAgent& member_a : members_of(fitted.scene(), query.a)) {
        const mobb::PlacedTree a = fitted.placed(member_a);
        for (const PlacedAgent& member_b : of_b) {
            const mobb::PlacedTree b = fitted.placed(member_b);
            const auto found = search == Search::direct
                                   ? mobb::direct_contact_intervals(a.placed_clip(), b.placed_clip())
                                   : mobb::contact_intervals(a, b);
            out.insert(out.end(), found.begin(), found.end());
        }
    }
    return mobb::joined(std::move(out));
}

}  // namespace

Answer answer(const FittedScene& fitted, const SceneQuery& query, const Details& details) {
    Answer answer;
    answer.search = details.search;
    if (details.trace) {
        RecordedQuery recorded = record(fitted, query, details.search);
        answer.contact = recorded.contact;
        answer.tests = recorded.tests;
        answer.trace = std::move(recorded.trace);
    } else {
        mobb::Statistics statistics;
        answer.contact = ask(fitted, query, details.search, statistics);
        answer.tests = statistics.tests;
    }
    if (details.all_contacts) answer.contacts = contacts_of(fitted, query, details.search);
    return answer;
}

void write_answer(JsonWriter& out, std::size_t index, const SceneQuery& query, const Answer& answer) {
    out.member("query", index);
    out.member("a", query.a.name);
    out.member("b", query.b.name);
    if (query.a.member >= 0 || query.b.member >= 0) {
        out.key("members");
        out.tuple(std::max(query.a.member, 0), std::max(query.b.member, 0));
    }
    out.member("collides", answer.contact.has_value());
    out.key("contact");
    write_contact(out, answer.contact);
    out.begin_object("tests", JsonWriter::Layout::row);
    for (const mobb::TestKind test : mobb::kTestKinds) out.member(mobb::name(test), answer.tests[test]);
    out.end_object();
    if (answer.avoidable) out.member("avoidable", answer.avoidable->size());
    if (answer.contacts) {
        out.list("contacts", *answer.contacts,
                 [&](const mobb::Interval& interval) { out.tuple(interval.t0, interval.t1); });
    }
    if (answer.trace) {
        if (answer.trace->stopped()) out.members("recorded", answer.trace->size(), "events", answer.trace->events());
        out.key("trace");
        const std::vector<int> avoidable = answer.avoidable.value_or(std::vector<int>());
        answer.steps ? write_events(out, *answer.trace, *answer.steps, avoidable)
                     : write_trace(out, *answer.trace, avoidable);
    }
}

std::string sentence(const SceneQuery& query, const std::optional<mobb::Contact>& contact) {
    const std::string a = cleaned(query.a.name);
    const std::string b = cleaned(query.b.name);
    if (!contact) return a + " and " + b + " never collide.";
    // Two that hardly touch need more digits.
    const auto [distance, radii] = told_apart(contact->distance, contact->radii, metres_text);
    return a + " and " + b + " collide at " + to_thousandth(contact->time) + " s: sample " +
           std::to_string(contact->a_sample) + " of " + a + disk_words(query.a) + " and sample " +
           std::to_string(contact->b_sample) + " of " + b + disk_words(query.b) + " are " + distance +
           " m apart, their radii add up to " + radii + " m.";
}

bool expects_tests(const SceneQuery& query) {
    return query.expect &&
           std::ranges::any_of(query.expect->tests, [](const auto& tests) { return tests.has_value(); });
}

std::optional<std::string> disagreement(const SceneQuery& query, const Answer& answer) {
    if (!query.expect) return std::nullopt;
    std::optional<std::string> out = other_answer(query, answer);
    if (answer.search == Search::direct) return out;
    for (const mobb::TestKind test : mobb::kTestKinds) {
        const std::optional<std::int64_t>& expected = query.expect->tests[test.index()];
        if (!expected || *expected == answer.tests[test]) continue;
        const std::string words = "expected " + counted(*expected, "test", "tests") + " of " +
                                  std::string(mobb::name(test)) + ", but there " +
                                  (answer.tests[test] == 1 ? "is " : "are ") + std::to_string(answer.tests[test]);
        if (!out) {
            out = words;
            continue;
        }
        // A sentence that ends the line may end with a stop.
        if (out->ends_with('.')) out->pop_back();
        out->append("; ").append(words);
    }
    return out;
}

}  // namespace mobbscope
