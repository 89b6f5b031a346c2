// What is selected means the same in every picture, and never what is gone.
#include <app/commands/command.h>
#include <app/document/described.h>
#include <app/document/selection.h>
#include <app/session/session.h>
#include <app/viewport/selection_display.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <gtest/gtest.h>

namespace mobbscope::app {
namespace {

FittedScene fitted_demo() {
    Scene scene = demo_scene();
    // A third agent, and a query whose second side is a placed clip.
    duplicate_agent(scene, 0);
    SceneQuery placed = scene.queries.front();
    placed.b = {"bend", 1, {{5, 5}, 0, 0}, -1};
    scene.queries.push_back(placed);
    const mobb::FitOptions options = scene.fit;
    return {std::move(scene), options};
}

TEST(Selection, AnAgentIsTheSameInEveryPicture) {
    const FittedScene fitted = fitted_demo();
    const AgentRef second{1, -1, 0};
    ViewState view;
    EXPECT_EQ(agent_in_view(fitted, view, 1), second);
    EXPECT_EQ(index_in_view(fitted, view, second), 1);
    view.query = 0;
    EXPECT_EQ(agent_in_view(fitted, view, 1), second);
    EXPECT_EQ(index_in_view(fitted, view, second), 1);
    EXPECT_EQ(index_in_view(fitted, view, {2, -1, 0}), std::nullopt) << "the third agent is not asked";
}

TEST(Selection, ASideThatPlacesAClipIsAPathToo) {
    const FittedScene fitted = fitted_demo();
    ViewState view;
    view.query = 1;
    const AgentRef side = agent_in_view(fitted, view, 1);
    EXPECT_EQ(side, (AgentRef{-1, 1, 1}));
    EXPECT_EQ(index_in_view(fitted, view, side), 1);
    ASSERT_TRUE(placed_agent_of(fitted, side));
    EXPECT_EQ(placed_agent_of(fitted, side)->placement.translate, glm::dvec2(5, 5));
    view.query.reset();
    EXPECT_EQ(index_in_view(fitted, view, side), std::nullopt);
}

TEST(Selection, OnlyWhatThereIsExists) {
    const FittedScene fitted = fitted_demo();
    using Kind = Selection::Kind;
    const int nodes = static_cast<int>(fitted.tree(0).nodes().size());
    const int samples = fitted.tree(0).clip().count();
    EXPECT_TRUE(exists(fitted, {}));
    EXPECT_TRUE(exists(fitted, {Kind::path, {2, -1, 0}, -1}));
    EXPECT_FALSE(exists(fitted, {Kind::path, {3, -1, 0}, -1}));
    EXPECT_TRUE(exists(fitted, {Kind::node, {0, -1, 0}, nodes - 1}));
    EXPECT_FALSE(exists(fitted, {Kind::node, {0, -1, 0}, nodes}));
    EXPECT_TRUE(exists(fitted, {Kind::sample, {0, -1, 0}, samples - 1}));
    EXPECT_FALSE(exists(fitted, {Kind::sample, {0, -1, 0}, samples}));
    EXPECT_TRUE(exists(fitted, {Kind::query, {}, 1}));
    EXPECT_FALSE(exists(fitted, {Kind::query, {}, 2}));
    EXPECT_FALSE(exists(fitted, {Kind::clip, {}, 2}));
    EXPECT_FALSE(exists(fitted, {Kind::sample, {-1, 2, 0}, 0}));
}

TEST(Selection, IsDescribedByItsNumbers) {
    Session session(false);
    run_command(session, "file.demo");
    const Workspace& workspace = session.workspace;
    const FittedScene& fitted = workspace.fitted();
    const Described node = describe(workspace, {Selection::Kind::node, {1, -1, 0}, 0});
    EXPECT_EQ(node.name, "B 0.0");
    const auto fact = [&](const Described& what, const std::string& key) {
        for (const auto& [name, value] : what.facts) {
            if (name == key) return value;
        }
        return std::string("none");
    };
    const int count = fitted.tree(1).clip().count();
    EXPECT_EQ(fact(node, "samples"), "0.." + std::to_string(count - 1) + " (" + std::to_string(count) + ")");
    const Described sample = describe(workspace, {Selection::Kind::sample, {0, -1, 0}, 0});
    EXPECT_EQ(sample.name, "A, sample 0");
    EXPECT_EQ(fact(sample, "time").substr(0, 5), "0.000");
    EXPECT_EQ(fact(node, "to blame"), "none") << "nobody has counted yet";
    run_command(session, "query.blame");
    const Described counted = describe(workspace, {Selection::Kind::node, {1, -1, 0}, 0});
    const int clip = fitted.placed_agents()[1].clip;
    ASSERT_NE(workspace.blame(), nullptr);
    EXPECT_TRUE(fact(counted, "to blame").starts_with(std::to_string(workspace.blame()->of(clip, 0)) + " avoidable"));
}

TEST(Selection, ANodeOfATreeThatIsFittedAnewIsItsPath) {
    const FittedScene before = fitted_demo();
    Scene moved = before.scene();
    place_agent(moved, 0, {{1, 2}, 3, 4});
    const mobb::FitOptions same = moved.fit;
    const FittedScene elsewhere(std::move(moved), same, &before);
    const Selection node{Selection::Kind::node, {1, -1, 0}, 3};
    EXPECT_EQ(remapped(node, before, elsewhere), node) << "a placement changes no tree";
    mobb::FitOptions other = before.options();
    other.leaf = 4;
    const FittedScene refitted(before.scene(), other, &before);
    EXPECT_EQ(remapped(node, before, refitted), (Selection{Selection::Kind::path, {1, -1, 0}, -1}));
    const Selection sample{Selection::Kind::sample, {1, -1, 0}, 3};
    EXPECT_EQ(remapped(sample, before, refitted), sample);
    EXPECT_EQ(remapped({Selection::Kind::clip, {}, 99}, before, refitted), Selection{});
}

}  // namespace
}  // namespace mobbscope::app
