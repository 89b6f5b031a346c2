// Dragging an agent in the picture: what is held follows the mouse.
#include <app/viewport/agent_handles.h>
#include <render/drawlist/pick.h>
#include <render/pictures/build_draw_list.h>
#include <scene/load_files.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace mobbscope::app {
namespace {

struct Picture {
    FittedScene fitted;
    DrawList list;

    explicit Picture(CameraPreset preset) : fitted(demo_scene(), demo_scene().fit) {
        ViewState view = fitted.scene().view;
        view.camera = {};
        view.camera.preset = preset;
        list = build_draw_list(fitted, view, PictureSize{900, 600});
    }
    HandleDrag hold(Handle handle, glm::vec2 pixel) const {
        const PlacedAgent& who = fitted.placed_agents()[1];
        const mobb::PlacedTree placed = fitted.placed(who);
        const mobb::Disk first = placed.placed_clip().disk(0);
        return {handle, 1, who.placement, {first.x, first.y}, placed.placed_clip().time(0), pixel};
    }
    glm::vec2 seen(glm::dvec2 place, double time) const {
        return *list.projection.project(list.space.point(place.x, place.y, time));
    }
};

TEST(AgentHandles, AMovedAgentStaysUnderTheMouse) {
    for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::top}) {
        const Picture picture(preset);
        const HandleDrag before = picture.hold(Handle::move, {});
        const HandleDrag drag = picture.hold(Handle::move, picture.seen(before.pivot, before.time));
        const glm::vec2 to = drag.from + glm::vec2(60, -25);
        const auto placement = dragged(drag, picture.list, to, false);
        ASSERT_TRUE(placement);
        const glm::dvec2 pivot = before.pivot + placement->translate - drag.start.translate;
        EXPECT_LT(glm::length(picture.seen(pivot, drag.time) - to), 0.05f);
        EXPECT_EQ(placement->rotate_deg, drag.start.rotate_deg);
        EXPECT_EQ(placement->start, drag.start.start);
    }
}

TEST(AgentHandles, ATurnedAgentKeepsItsFirstPlace) {
    const Picture picture(CameraPreset::iso);
    const HandleDrag at = picture.hold(Handle::turn, {});
    const HandleDrag drag = picture.hold(Handle::turn, picture.seen(at.pivot + glm::dvec2(1, 0), at.time));
    const glm::vec2 quarter_on = picture.seen(at.pivot + glm::dvec2(0, 1), at.time);
    const auto placement = dragged(drag, picture.list, quarter_on, false);
    ASSERT_TRUE(placement);
    EXPECT_NEAR(std::remainder(placement->rotate_deg - drag.start.rotate_deg - 90, 360), 0, 0.1);
    const mobb::Tree& tree = picture.fitted.tree(picture.fitted.placed_agents()[1].clip);
    const mobb::PlacedTree turned(tree, *placement);
    const mobb::Disk first = turned.placed_clip().disk(0);
    EXPECT_NEAR(first.x, at.pivot.x, 1e-9);
    EXPECT_NEAR(first.y, at.pivot.y, 1e-9);
}

TEST(AgentHandles, AShiftedAgentStartsWhereTheMouseIs) {
    const Picture picture(CameraPreset::front);
    const HandleDrag at = picture.hold(Handle::shift, {});
    const HandleDrag drag = picture.hold(Handle::shift, picture.seen(at.pivot, at.time));
    const auto placement = dragged(drag, picture.list, picture.seen(at.pivot, at.time + 0.75), false);
    ASSERT_TRUE(placement);
    EXPECT_NEAR(placement->start, drag.start.start + 0.75, 1e-3);
    EXPECT_EQ(placement->translate, drag.start.translate);
}

TEST(AgentHandles, StepsAreWhole) {
    const Picture picture(CameraPreset::top);
    const HandleDrag at = picture.hold(Handle::move, {});
    HandleDrag drag = picture.hold(Handle::move, picture.seen(at.pivot, at.time));
    const auto moved = dragged(drag, picture.list, drag.from + glm::vec2(31, 17), true);
    ASSERT_TRUE(moved);
    EXPECT_NEAR(std::remainder(moved->translate.x, 0.1), 0, 1e-9);
    EXPECT_NEAR(std::remainder(moved->translate.y, 0.1), 0, 1e-9);
    drag.handle = Handle::turn;
    drag.from += glm::vec2(50, 0);
    const auto turned = dragged(drag, picture.list, drag.from + glm::vec2(0, 21), true);
    ASSERT_TRUE(turned);
    EXPECT_NEAR(std::remainder(turned->rotate_deg, 5), 0, 1e-9);
}

TEST(AgentHandles, WhatCannotBeMeantDoesNothing) {
    // Seen level with the floor no line of sight meets it; seen along time no drag says when.
    const Picture front(CameraPreset::front);
    EXPECT_FALSE(dragged(front.hold(Handle::move, {450, 300}), front.list, {500, 250}, false));
    const Picture top(CameraPreset::top);
    EXPECT_FALSE(dragged(top.hold(Handle::shift, {450, 300}), top.list, {500, 250}, false));
}

}  // namespace
}  // namespace mobbscope::app
