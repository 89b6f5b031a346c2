#include <explain/axis_intervals.h>
#include <explain/query_sentence.h>
#include <mobb/random_motion.h>
#include <mobb/separation.h>
#include <support/folders.h>

#include "render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

struct Counts {
    int separated = 0, overlaps = 0, across = 0, skipped = 0;
};

/// Every box test of a scene's queries against what the intervals say.
Counts check_all(const FittedScene& fitted) {
    Counts counts;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const RecordedQuery recorded = record(fitted, fitted.queries()[i]);
        ViewState view;
        view.query = static_cast<int>(i);
        const std::vector<DrawnAgent> sides = drawn_agents(fitted, view);
        const mobb::RelativeFrame frame(sides[0].clip().frame(), sides[1].clip().frame(), sides[0].placed.time_scale());
        for (int step = 0; step < recorded.trace.size(); ++step) {
            const mobb::Trace::Event event = recorded.trace[step];
            const std::vector<AxisInterval> intervals = axis_intervals(sides, event);
            if (!event.test.is_box()) {
                EXPECT_TRUE(intervals.empty());
                continue;
            }
            const mobb::BoxInfo& shape = mobb::info(event.test.box());
            const bool is_3d = shape.axes == mobb::BoxAxes::space_time;
            // Of moving boxes more than enough: theirs depends on how fast they are.
            const double slack = is_3d ? frame.slack3d() : shape.moves ? 1e-7 : frame.slack2d();
            const auto most = static_cast<std::size_t>(mobb::axis_count(event.test));
            EXPECT_LE(intervals.size(), most);
            EXPECT_GE(intervals.size(), is_3d ? 6u : most);
            counts.skipped += intervals.size() < most ? 1 : 0;
            for (const AxisInterval& interval : intervals) {
                EXPECT_LE(interval.a_min, interval.a_max);
                EXPECT_LE(interval.b_min, interval.b_max);
                EXPECT_NEAR(interval.a_min, -interval.a_max, 1e-12) << "counted from the middle of A's box";
            }
            const auto first = std::find_if(intervals.begin(), intervals.end(),
                                            [&](const AxisInterval& interval) { return interval.gap > slack; });
            if (event.outcome == mobb::Outcome::overlap) {
                ++counts.overlaps;
                EXPECT_EQ(first, intervals.end()) << step;
                continue;
            }
            ++counts.separated;
            counts.across += event.axis >= 6 ? 1 : 0;
            if (first == intervals.end()) {
                ADD_FAILURE() << "step " << step << ": nothing separates";
                continue;
            }
            EXPECT_EQ(first->axis, event.axis) << step;
            EXPECT_NEAR(first->gap, event.gap, 1e-9) << step;
        }
    }
    return counts;
}

TEST(AxisIntervals, SayWhatTheTestsOfTheDemoScenesSaid) {
    Counts all;
    for (const char* name : {"crossing", "collision"}) {
        for (const mobb::TreeKind kind : mobb::test::kFittedTrees) {
            Scene scene = load_scene(kScenes / (std::string(name) + ".json"));
            mobb::FitOptions options = scene.fit;
            options.tree = kind;
            const Counts counts = check_all({std::move(scene), options});
            all.separated += counts.separated;
            all.overlaps += counts.overlaps;
        }
    }
    EXPECT_GT(all.separated, 20);
    EXPECT_GT(all.overlaps, 20);
}

/// Leaning walks in all directions bring up the edge-edge axes; placed far away, the numbers keep their digits.
TEST(AxisIntervals, HoldAcrossEdgesAndFarAway) {
    Counts all;
    for (const bool far : {false, true}) {
        std::vector<mobb::Placement> placements;
        for (int i = 0; i < 24; ++i) {
            const glm::dvec2 at(1.4 * std::cos(1.9 * i), 1.4 * std::sin(1.9 * i));
            placements.push_back(
                {(far ? glm::dvec2(10'000, -10'000) : glm::dvec2(0)) + at, 47.0 * i, (far ? 1e5 : 0.0) + 0.11 * i});
        }
        mobb::FitOptions options;
        options.tree = mobb::TreeKind::umobb;
        options.leaf = 3;
        const Counts counts = check_all({scene_of(placements), options});
        all.separated += counts.separated;
        all.across += counts.across;
        all.skipped += counts.skipped;
    }
    EXPECT_GT(all.separated, 200);
    EXPECT_GT(all.across, 5);
}

TEST(AxisIntervals, HoldForEveryKindFarAway) {
    for (const mobb::TreeKind kind : mobb::test::kFittedTrees) {
        std::vector<mobb::Placement> placements;
        for (int i = 0; i < 24; ++i) {
            const glm::dvec2 at(1.4 * std::cos(1.9 * i), 1.4 * std::sin(1.9 * i));
            placements.push_back({glm::dvec2(10'000, -10'000) + at, 47.0 * i, 1e5 + 0.11 * i});
        }
        mobb::FitOptions options;
        options.tree = kind;
        options.leaf = 3;
        const Counts counts = check_all({scene_of(placements), options});
        EXPECT_GT(counts.separated, 100) << mobb::name(kind);
        EXPECT_GT(counts.overlaps, 100) << mobb::name(kind);
    }
}

TEST(AxisIntervals, ParallelEdgesAreLeftOut) {
    mobb::FitOptions options;
    options.tree = mobb::TreeKind::umobb;
    EXPECT_GT(check_all({scene_of({{}, {{0, 0.9}, 0, 0}}), options}).skipped, 0);
}

TEST(AxisIntervals, AxesAreNamedAsInTheSentence) {
    const FittedScene fitted = miss_scene();
    const RecordedQuery recorded = record(fitted, fitted.queries()[0]);
    ViewState view;
    view.query = 0;
    const std::vector<DrawnAgent> sides = drawn_agents(fitted, view);
    bool found = false;
    for (int step = 0; step < recorded.trace.size(); ++step) {
        const mobb::Trace::Event event = recorded.trace[step];
        if (event.outcome != mobb::Outcome::separated) continue;
        found = true;
        const std::string name = axis_intervals(sides, event).at(static_cast<std::size_t>(event.axis)).name;
        ASSERT_EQ(name.find_first_of("AB"), 0u) << name;
        const std::string words = name.substr(0, 1) + "'s" + name.substr(1) + " axis";
        EXPECT_NE(step_sentence(sides, recorded.trace, step).find(words), std::string::npos) << words;
    }
    EXPECT_TRUE(found);

    mobb::Trace::Event root;
    root.test = mobb::BoxKind::obb3d;
    const std::vector<AxisInterval> all = axis_intervals(sides, root);
    EXPECT_EQ(all.at(0).name, "A long");
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const AxisInterval& i) { return i.name == "B short"; }));
    EXPECT_TRUE(std::all_of(all.begin(), all.end(), [](const AxisInterval& i) {
        return (i.axis >= 6) == (i.name.find(" x B ") != i.name.npos);
    }));
}

}  // namespace
}  // namespace mobbscope
