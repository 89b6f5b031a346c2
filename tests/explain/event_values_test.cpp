// The values of events against the trace and the trees themselves.
#include <base/text.h>
#include <explain/clearance.h>
#include <explain/event_table.h>
#include <explain/event_values.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::Outcome;
using mobb::TestKind;

struct Valued {
    RandomQuery asked;
    mobb::PlacedTree a, b;
    Recursion recursion;
    EventValues values;

    explicit Valued(mobb::test::Random& random) : Valued(random_query(random)) {}
    explicit Valued(RandomQuery query)
        : asked(std::move(query)),
          a(asked.a()),
          b(asked.b()),
          recursion(recursion_of(asked.trace, a, b)),
          values(asked.trace, recursion, a, b) {}
    Valued(const Valued&) = delete;

    std::vector<int> pass(const std::string& filter) const { return steps_that_pass(values, EventFilter(filter)); }
    template <class Predicate>
    std::vector<int> by_hand(const Predicate& predicate) const {
        std::vector<int> out;
        for (int step = 0; step < asked.trace.size(); ++step) {
            if (predicate(asked.trace[step], step)) out.push_back(step);
        }
        return out;
    }
};

TEST(EventValues, FiltersAgreeWithTheTrace) {
    mobb::test::Random random(36);
    for (int round = 0; round < 100; ++round) {
        const Valued all(random);
        using Event = const mobb::Trace::Event&;
        const mobb::Tree& tree_a = all.asked.tree_a;
        const mobb::Tree& tree_b = all.asked.tree_b;
        EXPECT_EQ(all.pass("gap < 0.3 and level(a) >= 1"), all.by_hand([&](Event e, int) {
            return e.outcome == Outcome::separated && e.gap < 0.3 && tree_a.level(e.a) >= 1;
        }));
        EXPECT_EQ(all.pass("outcome = overlap or outcome = hit"),
                  all.by_hand([](Event e, int) { return e.outcome == Outcome::overlap || e.outcome == Outcome::hit; }));
        EXPECT_EQ(all.pass("not gap >= 0.3"),
                  all.by_hand([](Event e, int) { return e.outcome != Outcome::separated || e.gap < 0.3; }));
        EXPECT_EQ(all.pass("gap != 0.3").size(), all.pass("outcome = separated").size()) << "others have no gap";
        EXPECT_EQ(all.pass("test = samples and pairs > 2"),
                  all.by_hand([](Event e, int) { return e.test == TestKind::samples && e.pairs.size() > 2; }));
        EXPECT_EQ(all.pass("leaf(a) and leaf(b)"),
                  all.by_hand([&](Event e, int) { return tree_a.is_leaf(e.a) && tree_b.is_leaf(e.b); }));
        EXPECT_EQ(all.pass("node(b) = 1.0"),
                  all.by_hand([&](Event e, int) { return tree_b.level(e.b) == 1 && tree_b.place_in_level(e.b) == 0; }));
        EXPECT_EQ(all.pass("node(b) != 1.0").size() + all.pass("node(b) = 1.0").size(),
                  static_cast<std::size_t>(all.values.size()));
        EXPECT_EQ(all.pass("node(a) = 2"), all.by_hand([](Event e, int) { return e.a == 2; }));
        EXPECT_EQ(all.pass("sample(a) = 7"), all.by_hand([&](Event e, int) {
            const mobb::Node& node = tree_a.node(e.a);
            return node.first <= 7 && 7 < node.first + node.count;
        }));
        EXPECT_EQ(all.pass("sample(b) > 7"), all.by_hand([&](Event e, int) {
            const mobb::Node& node = tree_b.node(e.b);
            return node.first + node.count - 1 > 7;
        }));
        EXPECT_EQ(all.pass("depth = 2 and parent >= 0"), all.by_hand([](Event e, int) { return e.depth == 2; }));
        EXPECT_EQ(all.pass("parent = 1"), all.by_hand([](Event e, int) { return e.parent == 1; }));
        EXPECT_EQ(all.pass("axis = 1"), all.by_hand([](Event e, int) { return e.axis == 1; }));
        EXPECT_EQ(all.pass("step >= 3 and step < 9"),
                  all.by_hand([](Event, int step) { return step >= 3 && step < 9; }));
        const auto shared = [&](Event e) {
            return std::min(all.a.end(tree_a.node(e.a)), all.b.end(tree_b.node(e.b))) -
                   std::max(all.a.begin(tree_a.node(e.a)), all.b.begin(tree_b.node(e.b)));
        };
        EXPECT_EQ(all.pass("shared > 0.5"), all.by_hand([&](Event e, int) { return shared(e) > 0.5; }));
        const double moment = all.a.begin(tree_a.node(0)) + 0.4;
        EXPECT_EQ(all.pass("time = " + std::to_string(moment)), all.by_hand([&](Event e, int) {
            const double at = std::stod(std::to_string(moment));
            return shared(e) > 0 && at >= all.a.begin(tree_a.node(e.a)) && at <= all.a.end(tree_a.node(e.a)) &&
                   at >= all.b.begin(tree_b.node(e.b)) && at <= all.b.end(tree_b.node(e.b));
        }));
        EXPECT_EQ(all.pass("clearance < 0.2"), all.by_hand([&](Event e, int) {
            return std::ranges::any_of(e.pairs, [&](const mobb::MeasuredPair& pair) {
                const mobb::Approach approach =
                    mobb::approach_of(all.a.placed_clip(), pair.i, all.b.placed_clip(), pair.j);
                return approach.clearance(approach.nearest()) < 0.2;
            });
        }));
        EXPECT_EQ(all.pass("tests_below > 5"), all.by_hand([&](Event, int step) {
            const RecursionPair& pair =
                all.recursion.pairs[static_cast<std::size_t>(all.recursion.pair_of[static_cast<std::size_t>(step)])];
            return pair.end - pair.last - 1 > 5;
        }));
        EXPECT_EQ(all.pass("avoidable"), all.recursion.avoidable.events);
        EXPECT_EQ(all.pass("hit_below and depth = 0").empty(), all.pass("outcome = hit").empty());
    }
}

TEST(EventValues, SortsByEveryFieldBothWaysAndKeepsOrderOfEqualOnes) {
    mobb::test::Random random(37);
    const Valued all(random);
    for (int number = 0; number < std::ssize(event_fields()); ++number) {
        const auto field = static_cast<EventField>(number);
        for (const bool descending : {false, true}) {
            std::vector<int> steps(static_cast<std::size_t>(all.values.size()));
            std::iota(steps.begin(), steps.end(), 0);
            sort_steps(steps, all.values, field, 1, descending);
            for (std::size_t i = 1; i < steps.size(); ++i) {
                const double before = all.values.value(field, 1, steps[i - 1]).least;
                const double after = all.values.value(field, 1, steps[i]).least;
                if (std::isnan(after)) continue;
                ASSERT_FALSE(std::isnan(before)) << info(field).name << ": without a value comes last";
                EXPECT_TRUE(descending ? before >= after : before <= after) << info(field).name;
                if (before == after) {
                    EXPECT_LT(steps[i - 1], steps[i]) << info(field).name;
                }
            }
        }
    }
}

TEST(EventValues, SmallGapsAreToldApart) {
    const auto gap_text = [](double gap) {
        const auto at = [](double x) {
            const std::vector<mobb::Disk> disks{{x, 0, 0.5}};
            return mobb::Tree(std::make_shared<const mobb::Clip>(1.0, disks), {});
        };
        RandomQuery asked{at(0), at(1 + gap), {}, {}, {}};
        mobb::TraceRecorder recorder;
        static_cast<void>(mobb::query(asked.a(), asked.b(), recorder));
        asked.trace = recorder.take();
        const Valued all(std::move(asked));
        const std::vector<int> separated = all.pass("outcome = separated");
        return separated.empty() ? "none" : all.values.text(EventField::gap, 0, separated.front());
    };
    EXPECT_EQ(gap_text(0.25), "0.250");
    EXPECT_EQ(gap_text(0.0001), "0.0001");
    EXPECT_EQ(gap_text(0.0002), "0.0002");
    EXPECT_EQ(gap_text(0.000123), "0.000123");
}

TEST(EventValues, RowsHaveTheValuesWithAllDigits) {
    mobb::test::Random random(39);
    for (int round = 0; round < 20; ++round) {
        const Valued all(random);
        std::vector<int> steps(static_cast<std::size_t>(all.asked.trace.size()));
        std::iota(steps.rbegin(), steps.rend(), 0);
        std::istringstream in(event_rows(all.values, steps, ','));
        std::string line;
        ASSERT_TRUE(std::getline(in, line));
        EXPECT_EQ(
            line,
            "step,node(a),node(b),test,outcome,gap,clearance,tests_below,time,level(a),level(b),axis,pairs,depth");
        for (const int step : steps) {
            ASSERT_TRUE(std::getline(in, line));
            std::vector<std::string> cells{""};
            for (const char c : line) {
                if (c == ',') {
                    cells.emplace_back();
                } else {
                    cells.back().push_back(c);
                }
            }
            ASSERT_EQ(cells.size(), event_columns().size()) << line;
            const mobb::Trace::Event event = all.asked.trace[step];
            EXPECT_EQ(cells[0], std::to_string(step));
            EXPECT_EQ(cells[3], name(event.test));
            EXPECT_EQ(cells[4], name(event.outcome));
            EXPECT_EQ(cells[5], event.outcome == Outcome::separated ? format_double(event.gap) : "");
            EXPECT_EQ(cells[9], std::to_string(all.asked.tree_a.level(event.a)));
            EXPECT_EQ(cells[13], std::to_string(event.depth));
        }
        EXPECT_FALSE(std::getline(in, line));
    }
}

}  // namespace
}  // namespace mobbscope
