// The map of placements in the window: a click or a drag in it places B, and moving B leaves it as it is.
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <render/pictures/build_draw_list.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <string>

namespace mobbscope::app {
namespace {

struct MapWindow : FolderWindow<CrossingFolder> {
    MapWindow() : FolderWindow({1600, 1000}) {
        session.files.open({folder.scene});
        run_command(session, "query.select", "0");
        window.settle();
    }
    Rect rect(const std::string& mark) const {
        return const_cast<HeadlessWindow&>(window).shell().marks().all().at(mark);
    }
    glm::vec2 in_map(float right, float up) const {
        const Rect map = rect("query.map");
        return {map.min.x + right * map.size().x, map.max.y - up * map.size().y};
    }
    void move(glm::vec2 to) {
        window.shell().feed(MouseMove{to});
        window.settle();
    }
    void button(bool down) {
        window.shell().feed(MouseButton{0, down});
        window.settle();
    }
    std::shared_ptr<const PlacementMap> map() const { return session.maps.map(); }
    mobb::Placement b() const { return session.maps.query().b.placement; }
    std::size_t edits() const { return session.workspace.history.place(); }
};

TEST(Map, AClickPlacesBAndUndoTakesItBack) {
    MapWindow w;
    const mobb::Placement before = w.b();
    const auto map = w.map();
    ASSERT_TRUE(map);
    EXPECT_EQ(map->step, 1);
    w.move(w.in_map(0.25f, 0.75f));
    w.button(true);
    w.button(false);
    const MapOrder& order = map->order;
    EXPECT_NEAR(w.b().translate.x, order.across.from + 0.25 * (order.across.to - order.across.from), 0.1);
    EXPECT_NEAR(w.b().translate.y, order.up.from + 0.75 * (order.up.to - order.up.from), 0.1);
    EXPECT_EQ(w.b().rotate_deg, before.rotate_deg);
    EXPECT_EQ(w.edits(), 1u);
    EXPECT_EQ(w.map(), map) << "only B has moved";
    run_command(w.session, "edit.undo");
    w.window.settle();
    EXPECT_EQ(w.b(), before);
    EXPECT_EQ(w.map(), map);
}

TEST(Map, ADragIsOneEditAndTheAnswerGoesAlong) {
    MapWindow w;
    const mobb::Placement before = w.b();
    const auto map = w.map();
    w.move(w.in_map(0.1f, 0.1f));
    w.button(true);
    int hits = 0, misses = 0;
    for (int i = 1; i <= 8; ++i) {
        w.move(w.in_map(0.1f + 0.1f * static_cast<float>(i), 0.5f));
        const bool collides = w.session.workspace.recorded()->contact.has_value();
        ++(collides ? hits : misses);
        const auto cell = map->cell_at(w.session.maps.place_of_b(*map));
        ASSERT_TRUE(cell);
        EXPECT_EQ(map->hit(cell->x, cell->y), collides);
    }
    w.button(false);
    EXPECT_GT(hits, 0);
    EXPECT_GT(misses, 0);
    EXPECT_EQ(w.edits(), 1u);
    run_command(w.session, "edit.undo");
    EXPECT_EQ(w.b(), before);
}

/// Along a line over the boundary: what is said of the place under the mouse is what the query says after a click.
TEST(Map, WhatIsSaidOfAPlaceIsWhatAClickThereGives) {
    MapWindow w;
    for (const std::string axes : {"dx,dy", "dheading,dstart", "dx,dstart"}) {
        run_command(w.session, "map.axes", axes);
        w.window.settle();
        const auto map = w.map();
        int hits = 0, misses = 0, unlike_cell = 0;
        for (int i = 0; i < 60; ++i) {
            w.move(w.in_map(0.2f + 0.0107f * static_cast<float>(i), 0.513f));
            ASSERT_TRUE(w.session.maps.told());
            const MapInspector::Told told = *w.session.maps.told();
            w.button(true);
            w.button(false);
            EXPECT_EQ(w.b(), told.query.b.placement);
            const bool collides = w.session.workspace.recorded()->contact.has_value();
            ++(collides ? hits : misses);
            const Clearance& clearance = w.session.queries.findings()->clearance;
            PlacedAnswer now{collides, std::numeric_limits<double>::infinity()};
            if (clearance.least) now.value = clearance.pieces[*clearance.least].clearance;
            EXPECT_EQ(told.words, placed_words(MapShow::clearance, now));
            const auto cell = map->cell_at(w.session.maps.place_of_b(*map));
            ASSERT_TRUE(cell);
            const PlacedAnswer middle{map->hit(cell->x, cell->y), map->value(cell->x, cell->y)};
            unlike_cell += told.words != placed_words(MapShow::clearance, middle) ? 1 : 0;
        }
        EXPECT_GT(hits, 0) << axes;
        EXPECT_GT(misses, 0) << axes;
        EXPECT_GT(unlike_cell, 20) << "of the cell's middle something else is true";
    }
}

TEST(Map, IsMadeAnewForAnotherAAndOtherAxes) {
    MapWindow w;
    const auto first = w.map();
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "0.5 0");
    w.window.settle();
    const auto second = w.map();
    EXPECT_NE(second, first);
    EXPECT_NE(second->values, first->values);
    run_command(w.session, "map.axes", "dheading,dstart");
    w.window.settle();
    EXPECT_EQ(w.map()->order.up.axis, MapAxis::dstart);
    const mobb::Placement before = w.b();
    w.move(w.in_map(0.7f, 0.6f));
    w.button(true);
    w.button(false);
    EXPECT_NE(w.b().start, before.start);
    EXPECT_NE(w.b().rotate_deg, before.rotate_deg);
    EXPECT_EQ(w.b().translate, before.translate);
}

TEST(Map, CommandsChooseWhatItShows) {
    MapWindow w;
    run_command(w.session, "map.show", "tests");
    w.window.settle();
    EXPECT_EQ(w.map()->order.show, MapShow::tests);
    EXPECT_TRUE(w.has("map.range.from"));
    run_command(w.session, "map.range", "5:20");
    EXPECT_EQ(w.session.maps.choice.colors, std::pair(5.0, 20.0));
    run_command(w.session, "map.extent", "-1:2,-3:4");
    w.window.settle();
    EXPECT_EQ(w.map()->order.across.from, -1);
    EXPECT_EQ(w.map()->order.up.to, 4);
    run_command(w.session, "map.extent", "auto");
    run_command(w.session, "map.show", "answer");
    w.window.settle();
    EXPECT_FALSE(w.has("map.range.from"));
    run_command(w.session, "map.place", "1.5 -2");
    EXPECT_EQ(w.b().translate, glm::dvec2(1.5, -2));
    EXPECT_NE(refusal(w.session, "map.extent", "2:1,0:1").find("dx must go from"), std::string::npos);
    EXPECT_NE(refusal(w.session, "map.axes", "dx,dx").find("not two axes of a map"), std::string::npos);
    EXPECT_NE(refusal(w.session, "map.show", "gaps").find("a map cannot show"), std::string::npos);
    EXPECT_NE(refusal(w.session, "map.range", "3:1").find("not a range of values"), std::string::npos);
}

TEST(Map, ItsColoursAreDraggedByHandles) {
    MapWindow w;
    const Rect handle = w.rect("map.range.to");
    w.move(handle.center());
    w.button(true);
    w.move(handle.center() - glm::vec2(100, 0));
    w.button(false);
    ASSERT_TRUE(w.session.maps.choice.colors);
    EXPECT_LT(w.session.maps.choice.colors->second, 0.8 * 8);
    EXPECT_EQ(w.edits(), 0u);
    run_command(w.session, "map.range", "auto");
    EXPECT_FALSE(w.session.maps.choice.colors);
}

TEST(Map, FoldsAndLeavesWithTheQuery) {
    MapWindow w;
    EXPECT_TRUE(state_json(w.session).contains("map"));
    run_command(w.session, "map.panel");
    w.window.settle();
    EXPECT_FALSE(w.has("query.map"));
    EXPECT_FALSE(state_json(w.session).contains("map"));
    run_command(w.session, "map.panel");
    w.window.settle();
    EXPECT_TRUE(w.has("query.map"));
    run_command(w.session, "query.none");
    w.window.settle();
    EXPECT_FALSE(w.has("query.map"));
}

/// The line on the floor: B's path begins inside of it exactly where the two collide.
TEST(Map, BoundaryOnTheFloorIsDrawnWithAQuery) {
    MapWindow w;
    const auto lines = [&](bool on) {
        ViewState view = w.session.workspace.view();
        view.boundary = on;
        return build_draw_list(w.session.workspace.fitted(), view, PictureSize{640, 400}).lines.size();
    };
    EXPECT_GT(lines(true), lines(false) + 100);
}

}  // namespace
}  // namespace mobbscope::app
