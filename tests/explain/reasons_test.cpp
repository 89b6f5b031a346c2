// Chains of reasons against a filter of the trace itself, and focus windows against their definition.
#include <explain/focus_window.h>
#include <explain/reasons.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::test::Random;

bool node_holds(const mobb::PlacedTree& tree, int node, double time) {
    const mobb::Node& at = tree.node(node);
    const double root_end = tree.end(tree.node(0));
    return tree.begin(at) <= time && (time < tree.end(at) || (time == root_end && tree.end(at) == root_end));
}

/// The last events of the pairs of a chain.
std::vector<int> last_events(const Recursion& recursion, const std::vector<int>& pairs) {
    std::vector<int> out;
    for (const int pair : pairs) out.push_back(recursion.pairs[static_cast<std::size_t>(pair)].last);
    return out;
}

/// Whether the next event is not of the same pair.
bool is_last_of_pair(const mobb::Trace& trace, int event) {
    return event + 1 == trace.size() || trace[event + 1].a != trace[event].a || trace[event + 1].b != trace[event].b;
}

TEST(Reasons, ChainsAreWhatAFilterOfTheTraceFinds) {
    Random random(361);
    int moments = 0;
    int deep = 0;
    while (moments < 1000) {
        const RandomQuery asked = random_query(random);
        const mobb::PlacedTree a = asked.a();
        const mobb::PlacedTree b = asked.b();
        const Recursion recursion = recursion_of(asked.trace, a, b);
        const double from = std::max(a.begin_time(), b.begin_time());
        const double to = std::min(a.end_time(), b.end_time());
        if (from >= to) continue;
        for (int i = 0; i < 10; ++i, ++moments) {
            // Beginnings of nodes too, where one hands over to the next.
            const auto node = random.integer(0, static_cast<int>(asked.tree_a.nodes().size()) - 1);
            const double time = random.chance(0.2) ? a.begin(a.node(node)) : random.real(from, to);
            std::vector<int> expected;
            for (int event = 0; event < asked.trace.size(); ++event) {
                const mobb::Trace::Event test = asked.trace[event];
                if (node_holds(a, test.a, time) && node_holds(b, test.b, time) && is_last_of_pair(asked.trace, event)) {
                    expected.push_back(event);
                }
            }
            const std::vector<int> chain = pairs_at(recursion, time, time);
            ASSERT_EQ(last_events(recursion, chain), expected);
            for (std::size_t k = 1; k < chain.size(); ++k) {
                EXPECT_EQ(recursion.pairs[static_cast<std::size_t>(chain[k])].parent, chain[k - 1]) << "one chain";
            }
            deep += chain.size() > 3;
        }
    }
    EXPECT_GT(deep, 150);
}

TEST(Reasons, OfASampleAreTheEndPairsThatCoverIt) {
    Random random(362);
    int found = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        for (const int side : {0, 1}) {
            const mobb::Tree& tree = side == 0 ? asked.tree_a : asked.tree_b;
            const int sample = random.integer(0, tree.clip().count() - 1);
            std::set<int> parents;
            for (int event = 0; event < asked.trace.size(); ++event) parents.insert(asked.trace[event].parent);
            std::vector<int> expected;
            for (int event = 0; event < asked.trace.size(); ++event) {
                const mobb::Trace::Event test = asked.trace[event];
                const mobb::Node& node = tree.node(side == 0 ? test.a : test.b);
                const bool covers = node.first <= sample && sample < node.end();
                if (covers && is_last_of_pair(asked.trace, event) && !parents.contains(event))
                    expected.push_back(event);
            }
            const std::vector<int> pairs = end_pairs_of_sample(recursion, tree, side, sample);
            ASSERT_EQ(last_events(recursion, pairs), expected);
            found += static_cast<int>(pairs.size());
        }
    }
    EXPECT_GT(found, 500);
}

TEST(Reasons, APairSaysHowItEndedWithItsLastChild) {
    Random random(363);
    int none = 0;
    int some = 0;
    int hits = 0;
    for (int round = 0; round < 300; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        std::set<int> ended;
        for (int event = 0; event < asked.trace.size(); ++event) {
            for (const int pair : pairs_ended_at(recursion, event)) {
                EXPECT_EQ(recursion.pairs[static_cast<std::size_t>(pair)].end, event + 1);
                EXPECT_TRUE(ended.insert(pair).second);
            }
        }
        for (int pair = 0; pair < static_cast<int>(recursion.pairs.size()); ++pair) {
            const RecursionPair& of = recursion.pairs[static_cast<std::size_t>(pair)];
            EXPECT_EQ(ended.contains(pair), of.has_children());
            const std::string words = how_it_ended(recursion, pair);
            EXPECT_EQ(words.empty(), !of.has_children());
            int children = 0;
            for (const RecursionPair& child : recursion.pairs) children += child.parent == pair;
            EXPECT_EQ(children_of(recursion, pair).size(), static_cast<std::size_t>(children));
            if (words.empty()) continue;
            none += words == "none of its " + std::to_string(children) + " met";
            some += words.ends_with("without a hit");
            hits += words.starts_with("a hit in number ");
            EXPECT_EQ(of.hit, words.starts_with("a hit"));
        }
    }
    EXPECT_GT(none, 10);
    EXPECT_GT(some, 20);
    EXPECT_GT(hits, 20);
}

TEST(Reasons, PairsThatRecordingStoppedInHaveNotEnded) {
    Random random(371);
    int open = 0;
    for (int round = 0; round < 60; ++round) {
        const RandomQuery asked = random_query(random);
        const mobb::PlacedTree a = asked.a(), b = asked.b();
        const int kept = asked.trace.size() / 2;
        if (kept < 4) continue;
        mobb::TraceRecorder recorder({.events = kept});
        static_cast<void>(mobb::query(a, b, recorder));
        const mobb::Trace stopped = recorder.take();
        ASSERT_EQ(stopped.size(), kept);
        const Recursion recursion = recursion_of(stopped, a, b), whole = recursion_of(asked.trace, a, b);
        EXPECT_TRUE(pairs_ended_at(recursion, kept - 1).empty());
        for (int pair = 0; pair < static_cast<int>(recursion.pairs.size()); ++pair) {
            const RecursionPair& of = recursion.pairs[static_cast<std::size_t>(pair)];
            if (!of.has_children()) continue;
            const bool is_open = of.end == kept;
            EXPECT_EQ(how_it_ended(recursion, pair),
                      is_open ? "recording stopped before it ended" : how_it_ended(whole, pair));
            open += is_open ? 1 : 0;
        }
    }
    EXPECT_GT(open, 20);
}

TEST(FocusWindow, CountsWhatIsInIt) {
    Random random(364);
    for (int round = 0; round < 100; ++round) {
        const RandomQuery asked = random_query(random);
        if (asked.trace.size() > 600) continue;
        const mobb::PlacedTree a = asked.a();
        const mobb::PlacedTree b = asked.b();
        const Recursion recursion = recursion_of(asked.trace, a, b);
        FocusWindow focus;
        EXPECT_TRUE(events_in(recursion, focus).empty()) << "all of it";
        if (random.chance(0.7)) focus.branch = random.integer(0, static_cast<int>(recursion.pairs.size()) - 1);
        if (!focus.branch || random.chance(0.5)) {
            const double at = random.real(a.begin_time(), a.end_time());
            focus.time = mobb::Interval{at, at + random.real(0.01, 1)};
        }
        const InFocus inside = events_in(recursion, focus);
        const auto is_inside = [&](int event) {
            const mobb::Trace::Event test = asked.trace[event];
            bool below = !focus.branch;
            for (int at = event; at >= 0 && !below; at = asked.trace[at].parent) {
                below = recursion.pair_of[static_cast<std::size_t>(at)] == *focus.branch;
            }
            if (!focus.time) return below;
            const double begin = std::max({a.begin(a.node(test.a)), b.begin(b.node(test.b)), focus.time->t0});
            return below && begin < std::min({a.end(a.node(test.a)), b.end(b.node(test.b)), focus.time->t1});
        };
        mobb::Trace part;
        for (int event = 0; event < asked.trace.size(); ++event) {
            ASSERT_EQ(inside[static_cast<std::size_t>(event)] != 0, is_inside(event)) << event;
            mobb::Trace::Event kept = asked.trace[event];
            kept.parent = -1;
            if (is_inside(event)) part.push(kept);
            ASSERT_EQ(counts_in(inside, asked.trace, recursion, event).tests, part.counts());
        }
        if (focus == FocusWindow{{}, 0}) {
            EXPECT_EQ(counts_in(inside, asked.trace, recursion, asked.trace.size() - 1).avoidable,
                      static_cast<std::int64_t>(recursion.avoidable.events.size()));
        }
    }
}

}  // namespace
}  // namespace mobbscope
