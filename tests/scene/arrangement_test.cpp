// Who is in the picture and where it is drawn: names in views, and the grid.
#include <scene/arrangement.h>
#include <scene/drawn_agent.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>
#include <scene/view_options.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope {
namespace {

Scene three_agents(const std::string& view) {
    return parse_scene(R"({"clips": {"walk": {"dt": 1, "samples": [[0, 0, 0.5], [3, 0, 0.5]]},
                                     "stand": {"dt": 1, "samples": [[0, 0, 1]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "rotate_deg": 90},
                   {"name": "C", "clip": "stand", "translate": [100, 7]}],
        "queries": [{"a": "A", "b": "B"}], "view": )" +
                           view + "}",
                       "s.json", "");
}

FittedScene fitted(const Scene& scene) { return {scene, scene.fit}; }

TEST(Arrangement, AGridMovesWhatIsDrawnAndNothingElse) {
    const FittedScene scene = fitted(three_agents(R"({"arrange": "grid"})"));
    ViewState view = scene.scene().view;
    const std::vector<DrawnAgent> drawn = drawn_agents(scene, view);
    ASSERT_EQ(drawn.size(), 3u);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const GridCell& cell = drawn[i].cell.value();
        EXPECT_EQ(cell.size, drawn[0].cell->size) << "cells are even";
        for (int s = 0; s < drawn[i].clip().count(); ++s) {
            const mobb::Disk disk = drawn[i].clip().disk(s);
            EXPECT_GE(disk.x - disk.r, cell.low.x - 1e-9);
            EXPECT_GE(disk.y - disk.r, cell.low.y - 1e-9);
            EXPECT_LE(disk.x + disk.r, cell.high.x + 1e-9);
            EXPECT_LE(disk.y + disk.r, cell.high.y + 1e-9);
        }
        const glm::dvec2 inner = cell.high - cell.low;
        EXPECT_LT(inner.x, cell.size.x);
        EXPECT_LT(inner.y, cell.size.y);
        for (std::size_t other = 0; other < i; ++other) {
            const glm::dvec2 apart = 0.5 * (cell.low + cell.high - drawn[other].cell->low - drawn[other].cell->high);
            EXPECT_TRUE(std::abs(apart.x) > cell.size.x - 1e-9 || std::abs(apart.y) > cell.size.y - 1e-9);
        }
        const PlacedAgent& who = scene.placed_agents()[i];
        EXPECT_EQ(who.placement.translate, three_agents("{}").agents[i].placement.translate);
        EXPECT_EQ(shown_placement(scene, view, who).translate, who.placement.translate + cell.offset);
    }
    view.query = 0;
    EXPECT_FALSE(drawn_agents(scene, view)[0].cell) << "a query is shown where its agents are";
    EXPECT_EQ(drawn_agents(scene, view)[1].clip().placement(), scene.placed_agents()[1].placement);
}

TEST(Arrangement, ClipsThatAreOpenedTogetherAreInAGrid) {
    const TempFolder folder;
    const std::string walk = "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n";
    folder.write("a.csv", walk);
    EXPECT_EQ(load_files({folder.path() / "a.csv"}).view.arrange, Arrange::none);
    folder.write("b.csv", walk);
    EXPECT_EQ(load_files({folder.path()}).view.arrange, Arrange::grid);
    EXPECT_EQ(load_files({folder.path() / "a.csv", folder.path() / "b.csv"}).view.arrange, Arrange::grid);
    folder.write("tracks.csv", "id,t,x,y,r\n1,0,0,0,0.3\n1,1,1,0,0.3\n2,0,5,0,0.3\n2,1,6,0,0.3\n");
    EXPECT_EQ(load_files({folder.path() / "tracks.csv"}).view.arrange, Arrange::none) << "their places belong together";
    folder.write("scene.json", R"({"clips": {"a": {"source": "a.csv"}, "b": {"source": "b.csv"}}})");
    EXPECT_EQ(load_files({folder.path() / "scene.json"}).view.arrange, Arrange::none) << "a scene says it itself";
}

TEST(Arrangement, WhoIsHiddenHasItsPlaceAmongWhatIsDrawn) {
    const FittedScene scene = fitted(three_agents(R"({"hidden": ["B"], "pinned": ["C"]})"));
    const std::vector<DrawnAgent> drawn = drawn_agents(scene, scene.scene().view);
    ASSERT_EQ(drawn.size(), 3u);
    EXPECT_FALSE(drawn[0].hidden || drawn[0].pinned);
    EXPECT_TRUE(drawn[1].hidden);
    EXPECT_TRUE(drawn[2].pinned);
}

TEST(Arrangement, AnUnknownNameIsRefusedAtItsPlace) {
    const std::string message = input_error([] { three_agents(R"({"hidden": ["A", "D"]})"); });
    EXPECT_NE(message.find("/view/hidden/1"), std::string::npos) << message;
    EXPECT_NE(message.find("there is no agent 'D'"), std::string::npos) << message;
    EXPECT_NE(message.find("the nearest is"), std::string::npos) << message;
    EXPECT_NE(input_error([] { three_agents(R"({"arrange": "heap"})"); }).find("'heap'"), std::string::npos);
    const Scene scene = three_agents("{}");
    ViewState view;
    view.pinned = {"walk"};
    EXPECT_THROW(check_names(scene, view), ViewMismatch) << "where there are agents a clip is none";
    drop_unknown_names(scene, view);
    EXPECT_TRUE(view.pinned.empty());
}

TEST(Arrangement, AnAgentCalledNoneIsMeantByThat) {
    for (const char* key : {"hidden", "pinned", "follow"}) {
        const ViewOption& option = view_option(key);
        ViewState view;
        option.take_agent("A", view);
        for (const std::vector<std::string>& agents : {std::vector<std::string>{"A", "B"}, {"A", "none"}}) {
            const bool is_name = agents.back() == "none";
            ViewState read = view;
            if (option.names) (read.*option.names).clear();
            parse_option(option, "none", agents, read);
            EXPECT_EQ(read == ViewState{}, !is_name) << key;
            const std::string line = ' ' + std::string(option.option);
            EXPECT_EQ(in_command_line(option, read, agents), line + " none") << "it is read as it was written";
            EXPECT_EQ(in_command_line(option, {}, agents), line + (is_name ? " ''" : " none"));
            parse_option(option, "", agents, view);
            EXPECT_EQ(view, ViewState{}) << "an empty name is nobody's";
        }
    }
}

TEST(Arrangement, ARenamedAgentStaysHidden) {
    Scene scene = three_agents(R"({"hidden": ["B"], "pinned": ["B"]})");
    rename_agent(scene, 1, "Ben");
    EXPECT_EQ(scene.view.hidden, std::vector<std::string>{"Ben"});
    EXPECT_EQ(scene.view.pinned, std::vector<std::string>{"Ben"});
}

}  // namespace
}  // namespace mobbscope
