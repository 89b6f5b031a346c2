// A node that is shown alone with what is below it, and the boxes above it as ghosts.
#include <render/layout/caption.h>
#include <render/parts/highlights.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/pictures/build_draw_list.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Kind = AgentPart::Kind;
using Role = HighlightLine::Role;

const FittedScene& hit_walks() {
    static const FittedScene fitted = testing::hit_scene();
    return fitted;
}

DrawList list_of_walks(const ViewState& view) { return build_draw_list(hit_walks(), view, kSmallSize); }

int node_at_place(const mobb::Tree& tree, int level, int place) {
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i)
        if (tree.level(i) == level && tree.place_in_level(i) == place) return i;
    return -1;
}

const mobb::Tree& tree() { return hit_walks().tree(0); }

/// A view of levels with A's node alone, or with all.
ViewState with_levels(LevelRange shown, std::optional<int> node = {}) {
    ViewState view;
    view.levels = shown;
    if (node) view.subtree = DrawnNode{0, *node};
    return view;
}

std::set<int> boxes_of(const DrawList& list, int agent) {
    std::set<int> out;
    for (const BoxInstance& box : list.boxes)
        if (box.id.agent == agent) out.insert(box.id.index);
    return out;
}

const BoxInstance& box_of(const DrawList& list, int agent, int node) {
    return *std::ranges::find_if(list.boxes,
                                 [&](const BoxInstance& box) { return box.id.agent == agent && box.id.index == node; });
}

std::vector<HighlightLine> ghosts_of(const DrawList& list) {
    std::vector<HighlightLine> out = list.highlights;
    std::erase_if(out, [](const HighlightLine& line) { return line.role != Role::ancestor; });
    return out;
}

TEST(Subtree, ShowsOfItsAgentTheNodesBelowAlone) {
    const int top = node_at_place(tree(), 1, 1);
    const DrawList all = list_of_walks(with_levels({3, 3, false}));
    const DrawList part = list_of_walks(with_levels({3, 3, false}, top));
    std::set<int> below;
    for (const int node : shown_nodes(tree(), {3, 3, false}))
        if (tree().parent(tree().parent(node)) == top) below.insert(node);
    ASSERT_EQ(below.size(), 4u);
    std::set<int> with_top = below;
    with_top.insert(top);
    EXPECT_EQ(boxes_of(part, 0), with_top);
    EXPECT_EQ(boxes_of(part, 1), boxes_of(all, 1)) << "the other agent stays as it is";
    // Those below look as they did; their top is an outline around them.
    EXPECT_EQ(box_of(part, 0, top).fill.a, 0);
    EXPECT_GT(box_of(part, 0, top).edge.a, 0);
    EXPECT_TRUE(box_of(part, 0, top).pickable);
    for (const int node : below) EXPECT_GT(box_of(part, 0, node).fill.a, 0);
}

TEST(Subtree, HasItsOwnBoxOnItsLevelOrBelowTheLevelsThatAreShown) {
    const int top = node_at_place(tree(), 2, 1);
    for (const LevelRange shown : {LevelRange{2, 2, false}, LevelRange{0, 0, false}, LevelRange{0, 2, false}}) {
        const DrawList part = list_of_walks(with_levels(shown, top));
        EXPECT_EQ(boxes_of(part, 0), std::set<int>{top}) << to_string(shown);
        EXPECT_GT(box_of(part, 0, top).fill.a, 0);
    }
    const int leaf = shown_nodes(tree(), {0, 0, true}).back();
    EXPECT_EQ(boxes_of(list_of_walks(with_levels({9, 9, false}, leaf)), 0), std::set<int>{leaf})
        << "a leaf above the level";
    std::set<int> range = boxes_of(list_of_walks(with_levels({1, 3, false}, top)), 0);
    const auto [first, last] = tree().children(top);
    EXPECT_EQ(range, (std::set<int>{top, first, last}));
}

TEST(Subtree, DimsTheDisksOfItsAgentThatAreOutsideIt) {
    const int top = node_at_place(tree(), 2, 1);
    const mobb::Node& node = tree().node(top);
    const DrawList all = list_of_walks(with_levels({2, 2, false})),
                   part = list_of_walks(with_levels({2, 2, false}, top));
    ASSERT_EQ(all.disks.size(), part.disks.size());
    for (std::size_t i = 0; i < all.disks.size(); ++i) {
        const DiskInstance &was = all.disks[i], &is = part.disks[i];
        const bool inside = is.id.agent != 0 || (is.id.index >= node.first && is.id.index < node.end());
        EXPECT_FLOAT_EQ(is.color.a, was.color.a * (inside ? 1 : kOutOfFocus)) << is.id.agent << ' ' << is.id.index;
    }
    const auto dim = std::ranges::find(part.legend, "dim: outside A 2.1", &LegendEntry::text);
    EXPECT_NE(dim, part.legend.end());
    EXPECT_EQ(std::ranges::find(all.legend, "dim: outside A 2.1", &LegendEntry::text), all.legend.end());
}

TEST(Subtree, IsSaidInTheCaption) {
    const ViewState view = with_levels({3, 3, false}, node_at_place(tree(), 1, 1));
    const std::vector<DrawnAgent> agents = drawn_agents(hit_walks(), view);
    const std::string said = scene_caption(hit_walks(), agents, view).detail;
    EXPECT_TRUE(said.starts_with("only A 1.1 and below")) << said;
    EXPECT_NE(said.find("level 3, 12 boxes"), std::string::npos) << "4 of A and 8 of B: " << said;
    ViewState hidden = view;
    hidden.hidden = {"A"};
    EXPECT_EQ(scene_caption(hit_walks(), drawn_agents(hit_walks(), hidden), hidden).detail.find("only"),
              std::string::npos);
}

TEST(Subtree, IsNoneOfAQueryAndRefusedWhereThereIsNone) {
    ViewState view = with_levels({0, 0, true}, 1);
    view.query = 0;
    EXPECT_EQ(drawn_agents(hit_walks(), view)[0].subtree, std::nullopt);
    for (const DrawnNode part : {DrawnNode{2, 0}, DrawnNode{-1, 0}, DrawnNode{0, 1000}, DrawnNode{0, -1}}) {
        ViewState wrong;
        wrong.subtree = part;
        try {
            list_of_walks(wrong);
            ADD_FAILURE() << part.agent << ' ' << part.node;
        } catch (const ViewMismatch& mismatch) {
            EXPECT_EQ(mismatch.key(), "subtree");
            EXPECT_NE(std::string(mismatch.what()).find("counted from 0"), std::string::npos) << mismatch.what();
        }
    }
}

TEST(Ancestors, AreDashedOutlinesFainterWithHeight) {
    const int node = node_at_place(tree(), 3, 5);
    ViewState view = with_levels({3, 3, false}, node);
    EXPECT_TRUE(list_of_walks(view).highlights.empty());
    view.ancestors = true;
    const DrawList list = list_of_walks(view);
    const std::vector<HighlightLine> ghosts = ghosts_of(list);
    ASSERT_EQ(ghosts.size(), 36u) << "the edges of three boxes";
    const DrawnAgent agent = drawn_agents(hit_walks(), view)[0];
    int above = node;
    for (std::size_t box = 0; box < 3; ++box) {
        above = tree().parent(above);
        const auto corners = box_corners(node_box(agent, above, list.space));
        for (std::size_t edge = 0; edge < 12; ++edge) {
            const HighlightLine& line = ghosts[12 * box + edge];
            EXPECT_NE(std::ranges::find(corners, line.from), corners.end());
            EXPECT_NE(std::ranges::find(corners, line.to), corners.end());
            EXPECT_NE(line.dash, kSolid);
            if (box > 0) {
                EXPECT_LT(line.color.a, ghosts[12 * (box - 1)].color.a);
            }
        }
    }
    EXPECT_EQ(above, 0);
    EXPECT_NE(testing::text_of(list).find(R"("role": "ancestor")"), std::string::npos);
}

TEST(Ancestors, AreThoseOfTheSelectedNodeBeforeThoseOfThePart) {
    ViewState view = with_levels({2, 2, false}, node_at_place(tree(), 2, 1));
    view.ancestors = true;
    DrawList list = list_of_walks(view);
    EXPECT_EQ(ghosts_of(list).size(), 24u);
    add_selection(list, hit_walks(), view, {"B", {Kind::node, node_at_place(tree(), 3, 0)}}, 1);
    EXPECT_EQ(ghosts_of(list).size(), 36u);
    EXPECT_EQ(list.highlights.front().role, Role::ancestor) << "the selection lies over them";
    const auto root = box_corners(node_box(drawn_agents(hit_walks(), view)[1], 0, list.space));
    EXPECT_NE(std::ranges::find(root, ghosts_of(list).back().from), root.end()) << "they are B's";
    list = list_of_walks(view);
    add_selection(list, hit_walks(), view, {"B", {Kind::sample, 3}}, 1);
    EXPECT_EQ(ghosts_of(list).size(), 24u) << "a sample is not a node";
    view.ancestors = false;
    list = list_of_walks(view);
    add_selection(list, hit_walks(), view, {"B", {Kind::node, node_at_place(tree(), 3, 0)}}, 1);
    EXPECT_TRUE(ghosts_of(list).empty());
}

}  // namespace
}  // namespace mobbscope
