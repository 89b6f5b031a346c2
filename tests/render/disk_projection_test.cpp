#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/disk_projection.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace mobbscope {
namespace {

FittedScene one_walk(mobb::TreeKind kind, int samples = 60, double time_scale = 1.0) {
    mobb::FitOptions options;
    options.tree = kind;
    options.leaf = 4;
    options.time_scale = time_scale;
    return {testing::scene_of({{{3, -2}, 25, 1.5}}, samples), options};
}

struct Range {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
};

/// What the node's samples cover along its axis, by the marks of each.
Range reached(const DrawnAgent& agent, int node, std::size_t which) {
    Range out;
    const mobb::Node& n = agent.placed.node(node);
    for (int sample = n.first; sample < n.end(); ++sample) {
        const DiskExtents extents = disk_extents(agent, node, sample);
        const AxisExtent& axis = extents.along[which];
        const double at = glm::dot(extents.base, axis.direction);
        out.low = std::min(out.low, at + axis.min);
        out.high = std::max(out.high, at + axis.max);
    }
    return out;
}

TEST(DiskProjection, TheFarthestMarksAreTheBoxesSides) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb}) {
        for (const double w : {1.0, 2.5}) {
            const FittedScene fitted = one_walk(kind, 60, w);
            const DrawnAgent agent = drawn_agents(fitted, {})[0];
            for (std::size_t node = 0; node < agent.placed.tree().nodes().size(); ++node) {
                const mobb::Box box = world_box(agent.placed, static_cast<int>(node));
                for (const std::size_t which : {0u, 1u}) {
                    const DiskExtents extents =
                        disk_extents(agent, static_cast<int>(node), agent.placed.node(static_cast<int>(node)).first);
                    const auto axis = static_cast<std::size_t>(extents.along[which].axis);
                    const double middle = glm::dot(box.center, box.axes[axis]);
                    const double half = box.half[static_cast<int>(axis)];
                    const Range range = reached(agent, static_cast<int>(node), which);
                    EXPECT_NEAR(range.low, middle - half, 1e-9) << "node " << node << ", axis " << axis;
                    EXPECT_NEAR(range.high, middle + half, 1e-9) << "node " << node << ", axis " << axis;
                }
            }
        }
    }
}

TEST(DiskProjection, OfDisksThatRunTheFarthestMarksAreTheBoxesSidesToo) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb}) {
        mobb::FitOptions options;
        options.tree = kind;
        options.leaf = 2;
        const FittedScene fitted(testing::running_scene({{{3, -2}, 25, 1.5}}, 12), options);
        const DrawnAgent agent = drawn_agents(fitted, {})[0];
        for (std::size_t node = 0; node < agent.placed.tree().nodes().size(); ++node) {
            const mobb::Box box = world_box(agent.placed, static_cast<int>(node));
            for (const std::size_t which : {0u, 1u}) {
                const auto axis = static_cast<std::size_t>(
                    disk_extents(agent, static_cast<int>(node), agent.placed.node(static_cast<int>(node)).first)
                        .along[which]
                        .axis);
                const double middle = glm::dot(box.center, box.axes[axis]);
                const double half = box.half[static_cast<int>(axis)];
                const Range range = reached(agent, static_cast<int>(node), which);
                EXPECT_NEAR(range.low, middle - half, 1e-9) << "node " << node << ", axis " << axis;
                EXPECT_NEAR(range.high, middle + half, 1e-9) << "node " << node << ", axis " << axis;
            }
        }
    }
}

TEST(DiskProjection, OfASingleSampleTheMarksAreTheBoxesSides) {
    const FittedScene fitted = one_walk(mobb::TreeKind::umobb, 1);
    const DrawnAgent agent = drawn_agents(fitted, {})[0];
    const DiskExtents extents = disk_extents(agent, 0, 0);
    EXPECT_EQ(extents.along[0].axis, 0);
    EXPECT_EQ(extents.along[1].axis, 1) << "one sample has no way through time: its box is upright";
    for (const AxisExtent& axis : extents.along) {
        EXPECT_NEAR(axis.max, agent.placed.tree().box(0).half[axis.axis], 1e-12);
        EXPECT_NEAR(axis.min, -axis.max, 1e-12);
    }
}

TEST(DiskProjection, TheCornersAreWhatTheMarksComeFrom) {
    const FittedScene fitted = one_walk(mobb::TreeKind::umobb);
    const DrawnAgent agent = drawn_agents(fitted, {})[0];
    const DiskExtents extents = disk_extents(agent, 0, 20);
    EXPECT_NEAR(extents.rise.z, 1 / 30.0, 1e-12);
    EXPECT_NE(extents.along[0].max, -extents.along[0].min) << "the base is not the middle of the disk";
    for (const AxisExtent& axis : extents.along) {
        for (const auto& [value, corner] : {std::pair(axis.min, axis.min_corner), {axis.max, axis.max_corner}}) {
            EXPECT_NEAR(glm::dot(corner, axis.direction), value, 1e-12);
            EXPECT_NEAR(std::hypot(corner.x, corner.y), extents.radius, 1e-12);
            EXPECT_TRUE(std::abs(corner.z) < 1e-12 || std::abs(corner.z - extents.rise.z) < 1e-12);
        }
    }
}

TEST(DiskProjection, ThePictureShowsOneDiskAndNamesAllThatIsMarked) {
    const FittedScene fitted = one_walk(mobb::TreeKind::umobb);
    ViewState view;
    view.projection = DiskProjection{0, 1, 7};
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_EQ(list.disks.size(), 1u);
    EXPECT_EQ(list.disks[0].id.index, 7);
    EXPECT_TRUE(list.boxes.empty());
    for (const char* text :
         {"p", "r", "dt", "a\u2080", "a\u2082", "min\u2080", "max\u2080", "min\u2082", "max\u2082"}) {
        EXPECT_TRUE(std::any_of(list.texts.begin(), list.texts.end(), [&](const TextRun& t) { return t.text == text; }))
            << text;
    }
    EXPECT_EQ(list.space.time_height, 1) << "right angles are drawn as such";
    // On each axis one heavy line from the least to the greatest projection.
    const DiskExtents extents = disk_extents(drawn_agents(fitted, view)[0], 1, 7);
    for (const AxisExtent& axis : extents.along) {
        const auto drawn = std::count_if(list.lines.begin(), list.lines.end(), [&](const LineInstance& line) {
            return glm::length(glm::dvec3(line.from) - axis.direction * axis.min) < 1e-5 &&
                   glm::length(glm::dvec3(line.to) - axis.direction * axis.max) < 1e-5;
        });
        EXPECT_EQ(drawn, 1) << "axis " << axis.axis;
    }
}

TEST(DiskProjection, NoTextOverlapsAnother) {
    const FittedScene fitted = one_walk(mobb::TreeKind::umobb);
    ViewState view;
    view.projection = DiskProjection{0, 0, 20};
    for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::front, CameraPreset::top}) {
        view.camera.preset = preset;
        const DrawList list = build_draw_list(fitted, view, kGoldenSize);
        for (std::size_t i = 0; i < list.texts.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_FALSE(list.texts[i].box.overlaps(list.texts[j].box))
                    << list.texts[i].text << " and " << list.texts[j].text;
            }
        }
    }
}

TEST(DiskProjection, SaysWhatThereIsInsteadOfWhatIsAskedFor) {
    const FittedScene fitted = one_walk(mobb::TreeKind::umobb);
    const auto message = [&](DiskProjection projection) {
        ViewState view;
        view.projection = projection;
        try {
            build_draw_list(fitted, view, kGoldenSize);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message({1, 0, 0}), "there is no participant 1: 1 is drawn, counted from 0");
    EXPECT_EQ(message({0, 9999, 0}), "there is no node 9999 in the tree of 'A': it has 31, counted from 0");
    EXPECT_EQ(message({0, 1, 40}), "there is no sample 40 in node 1 of 'A': it has those from 0 to 29");
    EXPECT_EQ(message({0, 1, 29}), "");
}

}  // namespace
}  // namespace mobbscope
