// What is pointed out: lines of their own, over the world and below the words.
#include <mobb/traversal.h>
#include <render/parts/highlights.h>
#include <render/parts/measured_line.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Kind = AgentPart::Kind;
using Role = HighlightLine::Role;

/// Agents that are drawn refer to it.
const FittedScene& scene() {
    static const FittedScene fitted = testing::hit_scene();
    return fitted;
}

DrawList list_at(const ViewState& view) { return build_draw_list(scene(), view, kSmallSize); }

ViewState moment_at(double time) {
    ViewState view;
    view.show = Show::moment;
    view.time = time;
    return view;
}

/// The widths that are used, in order.
std::vector<float> widths(const DrawList& list) {
    std::vector<float> out;
    for (const HighlightLine& line : list.highlights) {
        if (out.empty() || out.back() != line.width) out.push_back(line.width);
    }
    return out;
}

TEST(Highlights, AreLinesOnGroundLinesAndNothingElse) {
    const ViewState view;
    DrawList list = list_at(view);
    const std::string before = text_of(list);
    EXPECT_EQ(before.find("highlights"), std::string::npos);
    add_selection(list, scene(), view, {"A", {Kind::node, 1}}, 2);
    ASSERT_EQ(list.highlights.size(), 24u) << "the edges of a box, twice";
    EXPECT_EQ(widths(list), (std::vector<float>{8, 4})) << "the ground comes first";
    const auto agents = drawn_agents(scene(), view);
    const auto corners = box_corners(node_box(agents[0], 1, list.space));
    for (const HighlightLine& line : list.highlights) {
        EXPECT_EQ(line.role, Role::selection);
        for (const glm::vec3& end : {line.from, line.to}) {
            EXPECT_NE(std::find(corners.begin(), corners.end(), end), corners.end());
        }
    }
    nlohmann::json value = nlohmann::json::parse(text_of(list));
    ASSERT_EQ(value["highlights"].size(), 24u);
    EXPECT_EQ(value["highlights"][12]["role"], "selection");
    EXPECT_EQ(value["highlights"][12]["color"], "#E7EAEEFF");
    EXPECT_EQ(value["highlights"][12]["width"], 4);
    EXPECT_EQ(value["highlights"][12]["on_screen"], true);
    value.erase("highlights");
    EXPECT_EQ(value, nlohmann::json::parse(before)) << "all else stays";
}

TEST(Highlights, StandWhereTheAgentIs) {
    DrawList list = list_at({});
    const DrawnAgent agent = drawn_agents(scene(), {})[1];
    ASSERT_TRUE(add_highlight(list, agent, {Kind::sample, 7}, Role::hover, 1));
    const mobb::Disk disk = agent.clip().disk(7);
    const double time = 0.5 * (agent.clip().time(7) + agent.clip().time(8));
    for (const HighlightLine& line : list.highlights) {
        const glm::dvec3 place = list.space.place(line.from);
        EXPECT_NEAR(std::hypot(place.x - disk.x, place.y - disk.y), disk.r, 1e-4);
        EXPECT_NEAR(place.z, time, 1e-4);
    }
    // A path by its ends, a way and a ghost by their centres.
    const std::size_t ring = list.highlights.size();
    ASSERT_TRUE(add_highlight(list, agent, {}, Role::conflict, 1));
    EXPECT_EQ(list.highlights.size(), 3 * ring);
    list.highlights.clear();
    add_way_highlight(list, agent.clip(), Role::candidate, 1);
    EXPECT_EQ(list.highlights.size(), 2 * static_cast<std::size_t>(agent.clip().count() - 1));
    EXPECT_EQ(list.highlights.front().from,
              list.space.point(agent.clip().disk(0).x, agent.clip().disk(0).y, agent.begin()));
    list.highlights.clear();
    add_ghost(list, agent.clip(), 1);
    EXPECT_EQ(list.highlights.size(), 2 * ring + 2 * static_cast<std::size_t>(agent.clip().count() - 1));
    EXPECT_EQ(list.highlights.back().role, Role::ghost);
}

TEST(Highlights, AMeasuredLineHasALegOnTheFloorAndOneAlongTime) {
    const MeasuredLine line{{-1, 0, 0.5}, {2, 4, 2}};
    const auto ends = [&](const DrawList& list) {
        std::vector<glm::dvec3> out;
        for (const HighlightLine& each : list.highlights) {
            EXPECT_EQ(each.role, Role::measure);
            out.push_back(list.space.place(each.from));
            out.push_back(list.space.place(each.to));
        }
        return out;
    };
    const auto has = [](const std::vector<glm::dvec3>& all, glm::dvec3 place) {
        return std::ranges::any_of(all, [&](const glm::dvec3& each) { return glm::length(each - place) < 1e-5; });
    };
    DrawList list = list_at({});
    add_measured_line(list, line, 1);
    EXPECT_TRUE(has(ends(list), line.from));
    EXPECT_TRUE(has(ends(list), line.to));
    EXPECT_TRUE(has(ends(list), {2, 4, 0.5})) << "below its end, at the time of its beginning";
    // In the picture of a moment all of it lies on the floor.
    DrawList moment = list_at(moment_at(1));
    add_measured_line(moment, line, 1);
    for (const glm::dvec3& place : ends(moment)) EXPECT_NEAR(place.z, 0, 1e-6);
    EXPECT_TRUE(has(ends(moment), {2, 4, 0}));
}

TEST(Highlights, ASampleThatRunsIsOutlinedWhereItIsThen) {
    const FittedScene fitted(testing::running_scene({{{1, 2}, 40, 3}}), {});
    const DrawnAgent agent = drawn_agents(fitted, {})[0];
    const auto outlined = [&](DrawList list, double time) {
        ASSERT_TRUE(add_highlight(list, agent, {Kind::sample, 2}, Role::hover, 1));
        const mobb::Disk disk = mobb::swept(agent.clip(), 2).at(time);
        for (const HighlightLine& line : list.highlights) {
            const glm::dvec3 place = list.space.place(line.from);
            EXPECT_NEAR(std::hypot(place.x - disk.x, place.y - disk.y), disk.r, 1e-4);
            if (list.moment) continue;
            EXPECT_NEAR(place.z, time, 1e-4);
        }
    };
    outlined(build_draw_list(fitted, {}, kSmallSize), 0.5 * (agent.clip().time(2) + agent.clip().time(3)));
    const double then = agent.clip().time(2) + 0.1;
    outlined(build_draw_list(fitted, moment_at(then), kSmallSize), then);
}

TEST(Highlights, ALongWayHasFewLines) {
    const FittedScene fitted(testing::scene_of({{}}, 5000), mobb::FitOptions{});
    DrawList list = build_draw_list(fitted, {}, kSmallSize);
    const DrawnAgent agent = drawn_agents(fitted, {})[0];
    add_way_highlight(list, agent.clip(), Role::candidate, 1);
    EXPECT_LE(list.highlights.size(), 2002u);
    const mobb::Disk last = agent.clip().disk(agent.clip().count() - 1);
    EXPECT_NEAR(list.space.place(list.highlights.back().to).x, last.x, 1e-3) << "up to its end";
}

TEST(Highlights, OfAMomentAreTheDisksThatHoldThen) {
    const DrawnAgent agent = drawn_agents(scene(), {})[0];
    DrawList list = list_at(moment_at(1));
    ASSERT_TRUE(add_highlight(list, agent, {}, Role::selection, 1));
    const mobb::Disk disk = agent.clip().disk(*sample_at(agent, 1));
    for (const HighlightLine& line : list.highlights) {
        const glm::dvec3 place = list.space.place(line.from);
        EXPECT_NEAR(std::hypot(place.x - disk.x, place.y - disk.y), disk.r, 1e-4);
        EXPECT_EQ(line.from.z, list.space.point(0, 0, 0).z);
    }
    list.highlights.clear();
    EXPECT_FALSE(add_highlight(list, agent, {Kind::node, 0}, Role::selection, 1));
    list.moment = agent.end() + 1;
    EXPECT_FALSE(add_highlight(list, agent, {}, Role::selection, 1)) << "nobody is there then";
    EXPECT_TRUE(list.highlights.empty());
}

TEST(Highlights, PartsHaveNames) {
    const struct {
        std::string text;
        NamedPart named;
    } cases[] = {
        {"A", {"A", {}}},
        {"A:node:12", {"A", {Kind::node, 12}}},
        {"A:sample:0", {"A", {Kind::sample, 0}}},
        {"a:b", {"a:b", {}}},
        {"a:b:node:3", {"a:b", {Kind::node, 3}}},
        {"A:node:x", {"A:node:x", {}}},
        {"node:3", {"node:3", {}}},
        // Names that end like a part.
        {"A:node:1:path", {"A:node:1", {}}},
        {"A:node:1:sample:2", {"A:node:1", {Kind::sample, 2}}},
        {"A:path:path", {"A:path", {}}},
    };
    for (const auto& one : cases) {
        EXPECT_EQ(parse_named_part(one.text), one.named) << one.text;
        EXPECT_EQ(text_of(one.named), one.text);
    }
    EXPECT_EQ(parse_named_part("A:path"), (NamedPart{"A", {}}));
}

TEST(Highlights, WhatThePictureLacksIsRefused) {
    const auto refusal = [](const NamedPart& named, const ViewState& view) -> std::string {
        DrawList list = list_at(view);
        try {
            add_selection(list, scene(), view, named, 1);
        } catch (const std::invalid_argument& error) {
            EXPECT_TRUE(list.highlights.empty());
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal({"C", {}}, {}), "the picture is not of an agent 'C': it is of 'A', 'B'");
    EXPECT_EQ(refusal({"A", {Kind::sample, 60}}, {}), "'A' has no sample 60: give 0 to 59");
    EXPECT_EQ(refusal({"A", {Kind::node, -1}}, {}).substr(0, 30), "'A' has no node -1: give 0 to ");
    EXPECT_NE(refusal({"A", {Kind::node, 0}}, moment_at(1)).find("a node is not shown"), std::string::npos);
    EXPECT_EQ(refusal({"B", {Kind::node, 0}}, {}), "");
    ViewState projection;
    projection.projection = DiskProjection{0, 0, 3};
    EXPECT_EQ(refusal({"B", {}}, projection), "the picture is not of an agent 'B': it is of 'A'");
    EXPECT_EQ(refusal({"A", {}}, projection), "");
}

class HighlightPixelsTest : public testing::OnEachBackend {};

TEST_P(HighlightPixelsTest, ShowThroughTheWorldBelowTheWords) {
    for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::front, CameraPreset::top}) {
        ViewState view;
        view.camera.preset = preset;
        DrawList list = list_at(view);
        ASSERT_FALSE(list.disks.empty());
        const glm::vec3 base = list.disks.front().base;
        const float nearest =
            list.projection.perspective ? list.projection.depth(base) - list.projection.near_depth : 99;
        // Across the picture, behind all that there is and before it.
        for (const float nearer : {-50.0f, -5.0f, 0.9f * nearest}) {
            const glm::vec3 middle = base + nearer * list.projection.back;
            const glm::vec3 aside = 500.0f * list.projection.right;
            list.highlights = {{Role::selection, middle - aside, middle + aside, Rgba(1, 0, 0, 1), 9}};
            const auto at = list.projection.project(middle);
            ASSERT_TRUE(at);
            const int y = static_cast<int>(at->y);
            list.panels = {{{{0, at->y - 20}, {40, at->y + 20}}, 0, {0, 1, 0, 1}}};
            list.marks.clear();
            list.texts.clear();
            list.overlay_lines.clear();
            const Image image = renderer().draw(list);
            const auto is = [&](int x, std::array<int, 3> rgb) {
                return std::equal(rgb.begin(), rgb.end(), image.at(x, y));
            };
            EXPECT_TRUE(is(20, {0, 255, 0})) << "a panel lies over it";
            for (int x = 45; x < image.width; ++x) EXPECT_TRUE(is(x, {255, 0, 0})) << x << " at " << nearer;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, HighlightPixelsTest, ::testing::Values(Backend::osmesa, Backend::egl),
                         testing::backend_name);

}  // namespace
}  // namespace mobbscope
