// The scenes of the paper's figures tell what the figures tell.
#include <scene/fitted_scene.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace mobbscope {
namespace {

const std::filesystem::path kFigures = MOBBSCOPE_SOURCE_DIR "/assets/figures/scenes";

/// A scene with its query recorded.
struct Figure {
    explicit Figure(const std::string& name)
        : fitted(load(name)), recorded(record(fitted, fitted.queries()[0])), trace(recorded.trace) {}

    static FittedScene load(const std::string& name) {
        Scene scene = load_scene(kFigures / name);
        const mobb::FitOptions fit = scene.fit;
        return {std::move(scene), fit};
    }
    const mobb::Tree& tree_a() const { return fitted.tree(fitted.queries()[0].a.clip); }
    const mobb::Tree& tree_b() const { return fitted.tree(fitted.queries()[0].b.clip); }
    std::array<int, 2> children_a(int step) const { return tree_a().children(trace[step].a); }
    std::array<int, 2> children_b(int step) const { return tree_b().children(trace[step].b); }

    FittedScene fitted;
    RecordedQuery recorded;
    const mobb::Trace& trace;
};

using mobb::Outcome;
using mobb::TestKind;

TEST(FigureScenes, OfFourPairsOfChildrenTwoAreSeparatedOneIsApartInTimeAndOneGoesOn) {
    const Figure figure("inner_nodes.json");
    const mobb::Trace& trace = figure.trace;
    EXPECT_EQ(trace[1].outcome, Outcome::overlap);
    ASSERT_EQ(trace[1].test, mobb::BoxKind::obb2d);
    ASSERT_FALSE(figure.tree_a().is_leaf(trace[1].a) || figure.tree_b().is_leaf(trace[1].b));
    const struct {
        int step;
        std::size_t a, b;  // which child
        TestKind test;
        Outcome outcome;
    } steps[] = {{3, 0, 0, mobb::BoxKind::obb2d, Outcome::separated},
                 {4, 0, 1, TestKind::time, Outcome::disjoint_in_time},
                 {6, 1, 0, mobb::BoxKind::obb2d, Outcome::separated},
                 {8, 1, 1, mobb::BoxKind::obb2d, Outcome::overlap}};
    for (const auto& step : steps) {
        EXPECT_EQ(trace[step.step].parent, 1);
        EXPECT_EQ(trace[step.step].a, figure.children_a(1)[step.a]);
        EXPECT_EQ(trace[step.step].b, figure.children_b(1)[step.b]);
        EXPECT_EQ(trace[step.step].test, step.test);
        EXPECT_EQ(trace[step.step].outcome, step.outcome);
    }
    EXPECT_GT(trace[3].gap, 0.5) << "a gap to be seen";
    EXPECT_GT(trace[6].gap, 0.5);
    EXPECT_EQ(trace[9].parent, 8) << "the overlap leads on";
}

TEST(FigureScenes, OfAnInnerNodesChildrenOneIsOverWhenTheLeafBegins) {
    const Figure figure("leaf.json");
    const mobb::Trace& trace = figure.trace;
    ASSERT_EQ(trace[15].outcome, Outcome::overlap);
    EXPECT_FALSE(figure.tree_a().is_leaf(trace[15].a));
    EXPECT_GE(figure.tree_a().parent(trace[15].a), 0) << "not the root";
    EXPECT_TRUE(figure.tree_b().is_leaf(trace[15].b));
    const Outcome outcomes[] = {Outcome::disjoint_in_time, Outcome::overlap};
    for (int child = 0; child < 2; ++child) {
        EXPECT_EQ(trace[16 + child].parent, 15);
        EXPECT_EQ(trace[16 + child].a, figure.children_a(15)[static_cast<std::size_t>(child)]);
        EXPECT_EQ(trace[16 + child].b, trace[15].b);
        EXPECT_EQ(trace[16 + child].test, TestKind::time) << "no boxes are tested here";
        EXPECT_EQ(trace[16 + child].outcome, outcomes[child]);
    }
    EXPECT_EQ(trace[18].parent, 17);
}

TEST(FigureScenes, TheGeneratorMakesTheFilesThatAreThere) {
    if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
    const TempFolder folder;
    const std::string command =
        "python3 -B '" MOBBSCOPE_SOURCE_DIR "/scripts/make_figures.py' '" + folder.path().string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (const char* file : {"person.json", "levels.json", "inner_nodes.json", "leaf.json", "disk.json"}) {
        EXPECT_EQ(slurp(folder.path() / file), slurp(kFigures / file)) << file;
    }
}

}  // namespace
}  // namespace mobbscope
