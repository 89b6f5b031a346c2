// Two records of one query: event by event, and by time.
#include <explain/query_sentence.h>
#include <explain/trace_comparison.h>
#include <scene/fit_text.h>

#include "proven_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

void expect_tiles(const std::vector<Decision>& decisions, double begin, double end) {
    EXPECT_EQ(decisions.empty(), !(begin < end));
    if (decisions.empty()) return;
    EXPECT_EQ(decisions.back().t1, end);
    for (std::size_t i = 0; i < decisions.size(); ++i) {
        EXPECT_LT(decisions[i].t0, decisions[i].t1);
        EXPECT_EQ(decisions[i].t0, i > 0 ? decisions[i - 1].t1 : begin);
    }
}

TEST(TraversalComparison, BothSidesTileTheCommonTimeExactly) {
    mobb::test::Random random(37);
    int different = 0;
    for (int i = 0; i < certificate_budget(); ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery query = random_proven_query(random);
        const mobb::PlacedTree a = query.a(), b = query.b();
        const mobb::FitOptions other = mobb::test::random_any_fit(random);
        const FitComparison compared =
            compare_fits(a, b, query.recorded,
                         {std::make_shared<const mobb::Tree>(a.tree().shared_clip(), other),
                          std::make_shared<const mobb::Tree>(b.tree().shared_clip(), other)});
        const TraversalComparison& traversals = compared.traversals;
        const double begin = std::max(a.placed_clip().time(0), b.placed_clip().time(0));
        double end =
            std::min(a.placed_clip().time(a.placed_clip().count()), b.placed_clip().time(b.placed_clip().count()));
        if (end - begin <= mobb::kMinOverlap) continue;
        if (query.recorded.contact) end = std::min(end, query.recorded.contact->time);
        for (const auto& side : traversals.decisions) expect_tiles(side, begin, end);
        if (traversals.times.empty()) {
            EXPECT_FALSE(begin < end);
            continue;
        }
        EXPECT_EQ(traversals.times.back().t1, end);
        for (std::size_t k = 0; k < traversals.times.size(); ++k) {
            const ComparedTime& time = traversals.times[k];
            EXPECT_LT(time.t0, time.t1);
            EXPECT_EQ(time.t0, k > 0 ? traversals.times[k - 1].t1 : begin);
            for (std::size_t side = 0; side < 2; ++side) {
                EXPECT_LE(traversals.decision(time, side).t0, time.t0);
                EXPECT_GE(traversals.decision(time, side).t1, time.t1);
            }
            EXPECT_EQ(time.earlier, traversals.decision(time, 1).tests - traversals.decision(time, 0).tests);
            EXPECT_EQ(traversals.at(time.t0), &time);
            if (time.earlier != 0) ++different;
        }
    }
    EXPECT_GT(different, 100);
}

TEST(TraversalComparison, AStepHasItsMatchInTheOtherTraversal) {
    mobb::test::Random random(39);
    int decided = 0, went_on = 0;
    for (int i = 0; i < certificate_budget() / 3; ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery query = random_proven_query(random);
        const mobb::PlacedTree a = query.a(), b = query.b();
        const mobb::FitOptions other = mobb::test::random_any_fit(random);
        const FitComparison compared =
            compare_fits(a, b, query.recorded,
                         {std::make_shared<const mobb::Tree>(a.tree().shared_clip(), other),
                          std::make_shared<const mobb::Tree>(b.tree().shared_clip(), other)});
        const mobb::Trace &from = query.recorded.trace, &to = compared.recorded.trace;
        if (from.empty()) continue;
        const TraversalComparison& both = compared.traversals;
        const RecordedTraversal first{a, b, &query.recorded},
            second{compared.placed[0], compared.placed[1], &compared.recorded};
        for (int step = 0; step < from.size(); ++step) {
            const int match = matching_step(both, first, second, step);
            ASSERT_GE(match, 0);
            ASSERT_LT(match, to.size());
            if (step + 1 == from.size()) {
                EXPECT_EQ(match, to.size() - 1) << "the answers go together";
                continue;
            }
            const auto end = std::ranges::find(both.decisions[0], step, &Decision::step);
            if (end != both.decisions[0].end() && end->t1 - end->t0 > 1e-6) {
                const double middle =
                    std::clamp(0.5 * (end->t0 + end->t1), both.times.front().t0, both.times.back().t1);
                EXPECT_EQ(matching_step(both, first, second, step, middle), both.decision(*both.at(middle), 1).step);
                ++decided;
            } else if (from[step].parent < 0 && from[step].outcome == mobb::Outcome::overlap && !both.times.empty()) {
                // The roots go together, but where a pair below them is about the same time too.
                const mobb::Node &of_a = second.a.tree().node(to[match].a), &of_b = second.b.tree().node(to[match].b);
                EXPECT_LE(std::max(second.a.begin(of_a), second.b.begin(of_b)), both.times.front().t0 + 1e-9);
                EXPECT_GE(std::min(second.a.end(of_a), second.b.end(of_b)), both.times.back().t1 - 1e-9);
                ++went_on;
            }
        }
    }
    EXPECT_GT(decided, 50);
    EXPECT_GT(went_on, 10);
}

/// A query with separated boxes and measured samples.
ProvenQuery telling_query() {
    mobb::test::Random random(5);
    while (true) {
        ProvenQuery query = random_proven_query(random);
        const mobb::TestCounts& tests = query.recorded.tests;
        if (query.recorded.trace.size() > 10 && tests[mobb::TestKind::samples] > 3 && tests.boxes() > 3 &&
            query.recorded.trace[query.recorded.trace.size() - 1].test != mobb::TestKind::time)
            return query;
    }
}

std::array<DrawnAgent, 2> sides_of(const ProvenQuery& query) {
    return named_sides(query.fitted, query.fitted.queries()[0]);
}

TEST(TraceComparison, TwoTracesAreSteppedSideBySide) {
    const ProvenQuery query = telling_query();
    const std::array<DrawnAgent, 2> sides = sides_of(query);
    mobb::Trace stored, present;
    const std::vector<mobb::MeasuredPair> pairs{{4, 5, 0.75}}, others{{4, 5, 0.5}};
    mobb::Trace::Event event{.test = mobb::TestKind::samples, .outcome = mobb::Outcome::no_hit, .pairs = pairs};
    stored.push(event);
    present.push(event);
    event.parent = 0;
    event.depth = 1;
    stored.push(event);
    event.pairs = others;
    present.push(event);
    stored.push(event);
    EXPECT_TRUE(traces_at(sides, stored, present, 0).agree);
    const SteppedTraces differ = traces_at(sides, stored, present, 1);
    EXPECT_FALSE(differ.agree);
    EXPECT_NE(differ.stored.find("pair 0: samples 4 and 5 at 0.75 m"), std::string::npos) << differ.stored;
    EXPECT_NE(differ.present.find("pair 0: samples 4 and 5 at 0.5 m"), std::string::npos) << differ.present;
    const SteppedTraces ended = traces_at(sides, stored, present, 2);
    EXPECT_FALSE(ended.agree);
    EXPECT_EQ(ended.present, "the trace has ended");
}

TEST(TraversalComparison, WithItselfAllIsZero) {
    mobb::test::Random random(38);
    for (int i = 0; i < certificate_budget() / 3; ++i) {
        SCOPED_TRACE(i);
        const ProvenQuery query = random_proven_query(random);
        const mobb::PlacedTree a = query.a(), b = query.b();
        const mobb::FitOptions same = a.tree().options();
        const FitComparison compared = compare_fits(a, b, query.recorded,
                                                    {std::make_shared<const mobb::Tree>(a.tree().shared_clip(), same),
                                                     std::make_shared<const mobb::Tree>(b.tree().shared_clip(), same)});
        EXPECT_EQ(compared.recorded.tests, query.recorded.tests);
        EXPECT_EQ(compared.traversals.decisions[0].size(), compared.traversals.decisions[1].size());
        for (const ComparedTime& time : compared.traversals.times) {
            EXPECT_EQ(time.earlier, 0);
            EXPECT_EQ(time.decision[0], time.decision[1]);
        }
        const TraceCheck check = check_trace(query.recorded.trace, compared.recorded.trace);
        EXPECT_TRUE(check.agrees());
        EXPECT_EQ(check.compared, query.recorded.trace.size());
        EXPECT_EQ(check.rounding, 0);
    }
}

/// A copy with one event changed, or with the first `events` alone.
mobb::Trace changed(const mobb::Trace& trace, int step, const std::function<void(mobb::Trace::Event&)>& change,
                    int events = -1) {
    mobb::Trace out;
    for (int i = 0; i < (events < 0 ? trace.size() : events); ++i) {
        mobb::Trace::Event event = trace[i];
        if (i == step) change(event);
        out.push(event);
    }
    return out;
}

int step_with(const mobb::Trace& trace, const std::function<bool(const mobb::Trace::Event&)>& is) {
    for (int step = 0; step < trace.size(); ++step) {
        if (is(trace[step])) return step;
    }
    ADD_FAILURE() << "there is none";
    return 0;
}

TEST(TraceCheck, FindsTheFirstDifference) {
    const ProvenQuery query = telling_query();
    const std::array<DrawnAgent, 2> sides = sides_of(query);
    const mobb::Trace& now = query.recorded.trace;
    const int apart = step_with(now, [](const auto& event) { return event.outcome == mobb::Outcome::separated; });
    const int measured = step_with(now, [](const auto& event) { return event.pairs.size() > 1; });
    const auto expect = [&](int step, std::string_view member, const std::function<void(mobb::Trace::Event&)>& change) {
        const mobb::Trace stored = changed(now, step, change);
        const TraceCheck check = check_trace(stored, now);
        ASSERT_TRUE(check.difference) << member;
        EXPECT_EQ(check.difference->step, step);
        EXPECT_EQ(check.compared, step);
        EXPECT_EQ(check.difference->members, (std::vector<std::string_view>{member}));
        const std::string words = check_words(check, sides, stored, now);
        EXPECT_EQ(words.find("the traces differ at step " + std::to_string(step) + " in " + std::string(member) + ":"),
                  0u)
            << words;
    };
    expect(apart, "gap", [](auto& event) { event.gap += 1e-6; });
    expect(apart, "axis", [](auto& event) { event.axis = event.axis == 0 ? 1 : 0; });
    expect(apart, "outcome", [](auto& event) { event.outcome = mobb::Outcome::overlap; });
    expect(2, "depth", [](auto& event) { event.depth += 1; });
    expect(3, "a", [](auto& event) { event.a += 1; });
    expect(3, "parent", [](auto& event) { event.parent = event.parent == 0 ? 1 : 0; });
    expect(measured, "pairs", [](auto& event) { event.pairs = event.pairs.subspan(1); });
    std::vector<mobb::MeasuredPair> pairs(now[measured].pairs.begin(), now[measured].pairs.end());
    pairs[1].distance += 1e-6;
    expect(measured, "pairs", [&](auto& event) { event.pairs = pairs; });
}

TEST(TraceCheck, ATraceThatIsCutShortOrTooLongDiffersWhereItEnds) {
    const ProvenQuery query = telling_query();
    const std::array<DrawnAgent, 2> sides = sides_of(query);
    const mobb::Trace& now = query.recorded.trace;
    const int cut = now.size() - 4;
    mobb::Trace stored = changed(now, -1, {}, cut);
    TraceCheck check = check_trace(stored, now);
    ASSERT_TRUE(check.difference);
    EXPECT_EQ(check.difference->step, cut);
    EXPECT_TRUE(check.difference->members.empty());
    EXPECT_NE(check_words(check, sides, stored, now).find("the stored trace ends there, now it goes on with"),
              std::string::npos);
    check = check_trace(now, stored);
    EXPECT_NE(check_words(check, sides, now, stored).find("now the trace ends there, the stored one goes on with"),
              std::string::npos);
    // Where recording stopped, what is missing says nothing; how many there were does.
    stored.leave_out(4);
    check = check_trace(stored, now);
    EXPECT_TRUE(check.agrees());
    EXPECT_EQ(check.compared, cut);
    EXPECT_NE(check_words(check, sides, stored, now).find("of the stored trace recording stopped at event"),
              std::string::npos);
    stored.leave_out(1);
    check = check_trace(stored, now);
    EXPECT_FALSE(check.agrees());
    EXPECT_FALSE(check.difference);
}

TEST(TraceCheck, RoundingIsToldButAgrees) {
    const ProvenQuery query = telling_query();
    const std::array<DrawnAgent, 2> sides = sides_of(query);
    const mobb::Trace& now = query.recorded.trace;
    const int apart = step_with(now, [](const auto& event) { return event.outcome == mobb::Outcome::separated; });
    const mobb::Trace stored = changed(now, apart, [](auto& event) { event.gap += 1e-12; });
    const TraceCheck check = check_trace(stored, now);
    EXPECT_TRUE(check.agrees());
    EXPECT_GT(check.rounding, 0);
    EXPECT_NE(check_words(check, sides, stored, now).find("gaps and distances to 1e-12 m"), std::string::npos);
}

TEST(TraceCheck, NodesAndAxesAreCalledAsInSentences) {
    const ProvenQuery query = telling_query();
    const std::array<DrawnAgent, 2> sides = sides_of(query);
    const mobb::Trace& now = query.recorded.trace;
    const int apart = step_with(now, [](const auto& event) { return event.outcome == mobb::Outcome::separated; });
    const mobb::Trace::Event event = now[apart];
    const std::string words = plain_sentence(sides, event);
    EXPECT_TRUE(words.starts_with(node_name(sides[0], event.a) + " against " + node_name(sides[1], event.b) + ", " +
                                  std::string(mobb::name(event.test)) + ": separated "))
        << words;
    EXPECT_NE(words.find(" by " + format_double(event.gap) + " m"), std::string::npos) << words;
    EXPECT_EQ(words.find("axis 0"), std::string::npos) << words;
    const mobb::Trace stored = changed(now, apart, [](auto& other) { other.a = 1000; });
    const std::string differs = check_words(check_trace(stored, now), sides, stored, now);
    EXPECT_NE(differs.find("stored " + sides[0].label + " node 1000 against " + node_name(sides[1], event.b)),
              std::string::npos)
        << differs;
    EXPECT_NE(differs.find("; now " + words), std::string::npos) << differs;
}

TEST(FitText, SetsWhatItSays) {
    const mobb::FitOptions base;
    const mobb::FitOptions fit = parse_fit("umobb, leaf=20,axes=covariance", base);
    EXPECT_EQ(fit.tree, mobb::TreeKind::umobb);
    EXPECT_EQ(fit.leaf, 20);
    EXPECT_EQ(fit.axes, mobb::Axes::covariance);
    EXPECT_EQ(fit.levels, base.levels);
    EXPECT_EQ(fit_text(fit, base), "umobb,leaf=20,axes=covariance");
    EXPECT_EQ(fit_words(fit, base), "UMOBB, leaf 20, axes covariance");
    EXPECT_EQ(parse_fit(fit_text(fit, base), base), fit);
    EXPECT_EQ(parse_fit("time_scale=2.5,levels=3", base).time_scale, 2.5);
    EXPECT_EQ(names_of_fits(std::array{base, base, base}), (std::vector<std::string>{"MOBB", "MOBB (2)", "MOBB (3)"}));
    // Blocks have no leaves to choose, and boxes of the floor no time scale.
    EXPECT_EQ(
        names_of_fits(std::array{parse_fit("blocks,leaf=10", base), parse_fit("mobb,leaf=20,time_scale=2", base)}),
        (std::vector<std::string>{std::string(mobb::info(mobb::TreeKind::blocks).label), "MOBB, leaf 20"}));
    for (const char* wrong :
         {"", "tree", "leaf=0", "leaf=2.5", "levels=-1", "axes=x", "time_scale=0", "leaf", "l=2", "mobb,,"})
        EXPECT_THROW(parse_fit(wrong, base), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace mobbscope
