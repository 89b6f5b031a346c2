#include "run_program.h"

#include <scene/fitted_scene.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace mobbscope {
namespace {

using nlohmann::json;
using testing::Result;
using testing::run_program;

const std::string kScenes = MOBBSCOPE_SOURCE_DIR "/assets/scenes/";

std::set<std::string> keys(const json& object) {
    std::set<std::string> out;
    for (const auto& [key, value] : object.items()) out.insert(key);
    return out;
}

TEST(Fit, JsonIsTheTree) {
    const Result run = run_program({"fit", kScenes + "crossing.json", "--json", "--tree", "umobb", "--leaf", "7",
                                    "--axes", "covariance", "--time-scale", "1.5", "--levels", "4"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const json trees = json::parse(run.out)["trees"];
    ASSERT_EQ(trees.size(), 2u);
    const FittedScene fitted(load_scene(kScenes + "crossing.json"),
                             {mobb::TreeKind::umobb, 7, 4, mobb::Axes::covariance, 1.5});
    const mobb::Tree& tree = fitted.tree(1);
    const json& printed = trees[1];
    EXPECT_EQ(keys(printed), (std::set<std::string>{"clip", "tree", "axes", "leaf", "time_scale", "levels", "nodes"}));
    EXPECT_EQ(printed["clip"], "bend");
    EXPECT_EQ(printed["tree"], "umobb");
    EXPECT_EQ(printed["axes"], "covariance");
    EXPECT_EQ(printed["leaf"], 7);
    EXPECT_EQ(printed["time_scale"], 1.5);
    ASSERT_EQ(printed["nodes"].size(), tree.nodes().size());
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        const mobb::Node& node = tree.nodes()[i];
        const json& entry = printed["nodes"][i];
        EXPECT_EQ(keys(entry), (std::set<std::string>{"index", "parent", "level", "first", "count", "leaf", "kind",
                                                      "center", "axes", "half", "t0", "t1"}));
        EXPECT_EQ(entry["index"], i);
        EXPECT_EQ(entry["parent"], node.parent);
        EXPECT_EQ(entry["first"], node.first);
        EXPECT_EQ(entry["count"], node.count);
        EXPECT_EQ(entry["leaf"], node.is_leaf());
        const std::size_t dimensions = entry["kind"] == "obb2d" ? 2 : 3;
        ASSERT_EQ(entry["center"].size(), dimensions);
        ASSERT_EQ(entry["axes"].size(), dimensions);
        ASSERT_EQ(entry["half"].size(), dimensions);
        for (int k = 0; k < static_cast<int>(dimensions); ++k) {
            const auto at = static_cast<std::size_t>(k);
            EXPECT_EQ(entry["center"][at], node.box.center[k]);
            EXPECT_EQ(entry["half"][at], node.box.half[k]);
            EXPECT_EQ(entry["axes"][at][0], node.box.axes[at][0]);
            EXPECT_EQ(entry["axes"][at].size(), dimensions);
        }
        EXPECT_EQ(entry["t1"], tree.t1(node));
    }
    const auto figures = mobb::level_figures(tree);
    ASSERT_EQ(printed["levels"].size(), figures.size());
    EXPECT_EQ(printed["levels"][2]["nodes"], figures[2].nodes);
    EXPECT_EQ(printed["levels"][2]["volume"], figures[2].volume);
    EXPECT_EQ(printed["levels"][2]["tightness"], *figures[2].tightness);
}

TEST(Fit, TextHasALineForEachLevel) {
    const Result run = run_program({"fit", kScenes + "circles.json", "--levels", "3"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 5);
    EXPECT_TRUE(run.out.starts_with("circles: 1260 samples in 42 s; mobb tree of 7 nodes"));
}

}  // namespace
}  // namespace mobbscope
