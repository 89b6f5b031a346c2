#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mobbscope {
namespace {

TEST(DrawList, HasADiskForEverySample) {
    const FittedScene fitted = testing::hit_scene();
    const DrawList list = build_draw_list(fitted, {}, kGoldenSize);
    ASSERT_EQ(list.disks.size(), 120u);
    const mobb::PlacedTree placed = fitted.placed(fitted.placed_agents()[1]);
    for (int i = 0; i < 60; ++i) {
        const DiskInstance& disk = list.disks[static_cast<std::size_t>(60 + i)];
        const mobb::Disk truth = placed.placed_clip().disk(i);
        EXPECT_NEAR(disk.base.x + list.space.origin.x, truth.x, 1e-5);
        EXPECT_NEAR(disk.base.y + list.space.origin.y, truth.y, 1e-5);
        EXPECT_NEAR(disk.base.z / list.space.time_height + list.space.origin.z, placed.placed_clip().time(i), 1e-5);
        EXPECT_NEAR(disk.height() / list.space.time_height, 1 / 30.0, 1e-6);
        EXPECT_FLOAT_EQ(disk.radius, 0.4f);
        EXPECT_EQ(disk.id, (ObjectId{1, ObjectId::Kind::disk, i}));
    }
}

TEST(DrawList, ADiskThatRunsEndsInTheFaceInWhichTheNextBegins) {
    for (const double far : {0.0, 1e4}) {
        const FittedScene fitted(testing::running_scene({{{far, 1}, 33, far}}, 40), {});
        const DrawList list = build_draw_list(fitted, {}, kGoldenSize);
        ASSERT_EQ(list.disks.size(), 39u) << "the last sample is where the last disk ends";
        const mobb::PlacedClip clip = drawn_agents(fitted, {})[0].clip();
        for (int i = 0; i < 39; ++i) {
            const DiskInstance& disk = list.disks[static_cast<std::size_t>(i)];
            const mobb::Disk end = clip.disk_at_end(i);
            EXPECT_LT(glm::length(disk.top - list.space.point(end.x, end.y, clip.time(i + 1))), 1e-5f) << i;
            EXPECT_GT(disk.lean(), 0.5f) << i;
            if (i == 38) break;
            const DiskInstance& next = list.disks[static_cast<std::size_t>(i + 1)];
            EXPECT_EQ(disk.top, next.base) << i;
            EXPECT_EQ(disk.top_radius, next.radius) << i;
        }
    }
}

TEST(DrawList, ALevelCoversTheWholeClip) {
    const FittedScene fitted = testing::hit_scene();
    const mobb::Tree& tree = fitted.tree(0);
    for (int level = 0; level < tree.depth() + 2; ++level) {
        int samples = 0;
        for (const int node : shown_nodes(tree, {level, level, false}))
            samples += tree.nodes()[static_cast<std::size_t>(node)].count;
        EXPECT_EQ(samples, 60) << "level " << level;
    }
    int samples = 0;
    for (const int node : shown_nodes(tree, {0, 0, true}))
        samples += tree.nodes()[static_cast<std::size_t>(node)].count;
    EXPECT_EQ(samples, 60);
}

/// Every disk's rim, both ends of its hold, lies in the box that bounds it, also once both are drawn.
TEST(DrawList, DrawnBoxesHoldTheirDisks) {
    for (const mobb::TreeKind kind : mobb::kTreeKinds) {
        mobb::FitOptions options;
        options.tree = kind;
        options.leaf = 2;
        const std::vector<mobb::Placement> places{{}, {{1, -1}, 70, 0}};
        for (const bool running : {false, true}) {
            const FittedScene fitted(running ? testing::running_scene(places, 12) : testing::scene_of(places), options);
            ViewState view;
            view.time_height = 0.37;
            view.levels = {0, 2, false};
            const DrawList list = build_draw_list(fitted, view, kGoldenSize);
            for (const BoxInstance& box : list.boxes) {
                const glm::mat3 inverse = glm::inverse(glm::mat3(box.extents[0], box.extents[1], box.extents[2]));
                const mobb::Node& node = fitted.tree(0).nodes()[static_cast<std::size_t>(box.id.index)];
                for (const DiskInstance& disk : list.disks) {
                    if (disk.id.agent != box.id.agent || disk.id.index < node.first || disk.id.index >= node.end())
                        continue;
                    for (int i = 0; i < 16; ++i) {
                        const float angle = static_cast<float>(i) * 0.3926991f;
                        const glm::vec3 way(std::cos(angle), std::sin(angle), 0);
                        for (const glm::vec3& rim : {disk.base + disk.radius * way, disk.top + disk.top_radius * way}) {
                            const glm::vec3 unit = glm::abs(inverse * (rim - box.center));
                            EXPECT_LE(std::max({unit.x, unit.y, unit.z}), 1 + 1e-4f);
                        }
                    }
                }
            }
        }
    }
}

TEST(DrawList, AFreeBoxIsShearedByTheDrawnTime) {
    const FittedScene fitted = testing::hit_scene(mobb::TreeKind::umobb);
    ViewState view;
    view.time_height = 3;
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    const mobb::Box world = world_box(fitted.placed(fitted.placed_agents()[0]), list.boxes[0].id.index);
    const glm::vec3 tip = list.boxes[0].center + list.boxes[0].extents[0];
    const glm::dvec3 truth = world.center + world.half.x * world.axes[0];
    EXPECT_NEAR(tip.x + list.space.origin.x, truth.x, 1e-4);
    EXPECT_NEAR(tip.z, 3 * truth.z, 1e-3);
    const bool told = std::any_of(list.legend.begin(), list.legend.end(), [](const LegendEntry& entry) {
        return entry.text.find("sheared") != std::string::npos;
    });
    EXPECT_TRUE(told);
}

TEST(DrawList, TheLegendSaysWhatBoxesBeyondThePaperAre) {
    const auto told = [](mobb::TreeKind kind, std::string_view text) {
        const DrawList list = build_draw_list(testing::hit_scene(kind), {}, kGoldenSize);
        return std::any_of(list.legend.begin(), list.legend.end(),
                           [&](const LegendEntry& entry) { return entry.text.find(text) != std::string::npos; });
    };
    for (const mobb::TreeKind kind : mobb::kTreeKinds)
        for (const mobb::BoxKind box : mobb::kBoxKinds) {
            if (mobb::info(box).in_paper) continue;
            EXPECT_EQ(told(kind, mobb::info(box).looks), mobb::info(kind).below == box) << mobb::name(kind);
        }
}

TEST(DrawList, ASceneIsAboutAsTallAsWide) {
    const DrawList list = build_draw_list(testing::hit_scene(), {}, kGoldenSize);
    float height = 0;
    float width = 0;
    for (const DiskInstance& disk : list.disks) {
        height = std::max(height, disk.base.z + disk.height());
        width = std::max(width, 2 * (std::abs(disk.base.x) + disk.radius));
    }
    EXPECT_NEAR(height / width, 1, 0.1);
}

/// The same scene far away gives the same numbers to draw, but for the labels.
TEST(DrawList, FarFromTheOriginNothingIsLost) {
    const FittedScene near(testing::scene_of({{}, {{1, -1}, 90, 0.25}}), {});
    const FittedScene far(testing::scene_of({{{10000, -8000}, 0, 1e5}, {{10001, -8001}, 90, 100000.25}}), {});
    const DrawList a = build_draw_list(near, {}, kGoldenSize);
    const DrawList b = build_draw_list(far, {}, kGoldenSize);
    ASSERT_EQ(a.disks.size(), b.disks.size());
    for (std::size_t i = 0; i < a.disks.size(); ++i) {
        EXPECT_LT(glm::length(a.disks[i].base - b.disks[i].base), 1e-5f);
    }
    ASSERT_EQ(a.boxes.size(), b.boxes.size());
    for (std::size_t i = 0; i < a.boxes.size(); ++i)
        EXPECT_LT(glm::length(a.boxes[i].center - b.boxes[i].center), 1e-5f);
}

TEST(DrawList, EverythingIsInThePictureWhateverItsShape) {
    const FittedScene fitted = testing::hit_scene();
    for (const PictureSize size :
         {kGoldenSize, PictureSize{1920, 1080}, PictureSize{400, 600}, PictureSize{1000, 200}}) {
        for (const CameraPreset preset :
             {CameraPreset::iso, CameraPreset::top, CameraPreset::front, CameraPreset::side}) {
            ViewState view;
            view.camera.preset = preset;
            const DrawList list = build_draw_list(fitted, view, size);
            const Rect picture{{0, 0}, glm::vec2(size.width, size.height)};
            for (const DiskInstance& disk : list.disks) {
                const glm::vec2 at = list.projection.project(disk.base).value();
                EXPECT_TRUE(picture.contains({at, at}));
            }
            for (std::size_t i = 0; i < list.texts.size(); ++i) {
                EXPECT_TRUE(picture.contains(list.texts[i].box)) << list.texts[i].text;
                for (std::size_t j = 0; j < i; ++j) {
                    EXPECT_FALSE(list.texts[i].box.overlaps(list.texts[j].box.grown(-1)))
                        << list.texts[i].text << " over " << list.texts[j].text;
                }
            }
        }
    }
}

TEST(DrawList, LegendExplainsEveryAgentAndLevel) {
    ViewState view;
    view.levels = {1, 3, false};
    const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
    std::vector<std::string> texts;
    for (const LegendEntry& entry : list.legend) texts.push_back(entry.text);
    EXPECT_EQ(texts, (std::vector<std::string>{"A", "B", "level 1", "level 2", "level 3"}));
}

TEST(DrawList, WhatIsSwitchedOffIsNotThere) {
    ViewState view;
    view.disks = view.boxes = view.floor = view.time_axis = view.labels = view.legend = false;
    const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
    EXPECT_TRUE(list.disks.empty());
    EXPECT_TRUE(list.boxes.empty());
    EXPECT_TRUE(list.lines.empty());
    EXPECT_TRUE(list.texts.empty());
    EXPECT_TRUE(list.panels.empty());
}

TEST(DrawList, ATimeCursorMarksTheDisksThatHold) {
    ViewState view;
    view.time = 1.0;
    const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
    const auto rings = std::count_if(list.lines.begin(), list.lines.end(),
                                     [](const LineInstance& l) { return l.order.layer == DrawLayer::rings; });
    EXPECT_EQ(rings % 2, 0);
    EXPECT_GT(rings, 0);
    view.time = 17;
    EXPECT_NO_THROW(build_draw_list(testing::hit_scene(), view, kGoldenSize));
}

TEST(DrawList, ACursorOutsideIsSaidAndNotExplained) {
    ViewState view;
    view.time = 999;
    const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
    for (const LegendEntry& entry : list.legend) EXPECT_EQ(entry.text.find("cursor"), std::string::npos);
    EXPECT_TRUE(std::any_of(list.texts.begin(), list.texts.end(), [](const TextRun& run) {
        return run.text.find("999 s lies outside 0..2 s") != std::string::npos;
    }));
}

TEST(DrawList, LegendDashesGrowWithTheText) {
    ViewState view;
    view.query = 0;
    view.past = Past::all;
    const auto longest_dash = [&](PictureSize size) {
        float longest = 0;
        for (const OverlayLine& line : build_draw_list(testing::hit_scene(), view, size).overlay_lines)
            longest = std::max(longest, line.dash.x);
        return longest;
    };
    const float usual = longest_dash({1280, 720});
    ASSERT_GT(usual, 0);
    EXPECT_NEAR(longest_dash({3840, 2160}), 3 * usual, 0.01f * usual);
}

/// Boxes of a long clip must not become one mass.
TEST(DrawList, CrowdedBoxesFade) {
    const auto faintest = [](int samples, int leaf) {
        mobb::FitOptions options;
        options.leaf = leaf;
        ViewState view;
        view.levels = {0, 0, true};
        float least = 1;
        for (const BoxInstance& box :
             build_draw_list(FittedScene(testing::scene_of({{}}, samples), options), view, kGoldenSize).boxes)
            least = std::min(least, box.edge.a);
        return least;
    };
    EXPECT_GT(faintest(60, 30), 0.9f);
    EXPECT_LT(faintest(1260, 1), 0.2f);
}

TEST(DrawList, ManyAgentsStandUnnamed) {
    for (const int agents : {12, 13}) {
        std::vector<mobb::Placement> placements;
        for (int i = 0; i < agents; ++i) placements.push_back({{2.0 * i, 0}, 90, 0});
        ViewState view;
        view.legend = view.boxes = false;
        const DrawList list =
            build_draw_list(FittedScene(testing::scene_of(placements), {}), view, PictureSize{1280, 720});
        const auto says = [&](const std::string& text) {
            return std::any_of(list.texts.begin(), list.texts.end(), [&](const TextRun& r) { return r.text == text; });
        };
        EXPECT_EQ(says("A"), agents == 12);
        EXPECT_EQ(says("13 agents, unnamed here"), agents == 13);
    }
}

TEST(DrawList, LabelsBehindTheEyeAreLeftOut) {
    ViewState view;
    view.time_height = 1;
    view.camera = {CameraPreset::free, 225, 25, true, 40, glm::dvec3(5, 5, 1.5), 2};
    const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
    // Everything lies between x -1 and 3, all behind this eye or to its side.
    for (const TextRun& run : list.texts) EXPECT_NE(run.face, FontFace::mono) << run.text;
}

TEST(DrawList, TheMapsDisksLieOverItsGrid) {
    ViewState view;
    view.time = 1.0;
    const DrawList list = build_draw_list(testing::hit_scene(), view, PictureSize{1280, 720});
    EXPECT_EQ(list.marks.size(), 2u);
}

TEST(DrawList, AQueryOrStepThatThereIsNotIsRefused) {
    ViewState view;
    view.query = 1;
    EXPECT_THROW(build_draw_list(testing::hit_scene(), view, kGoldenSize), std::invalid_argument);
    view.query = 0;
    view.step = {Step::Unit::event, 100000};
    EXPECT_THROW(build_draw_list(testing::hit_scene(), view, kGoldenSize), std::invalid_argument);
}

TEST(DrawList, OddScenesAreDrawn) {
    for (const mobb::Disk disk : {mobb::Disk{0, 0, 0}, mobb::Disk{1e8, -1e8, 1e-3}, mobb::Disk{0, 0, 1e7}}) {
        for (const int count : {1, 5}) {
            Scene scene;
            const std::vector<mobb::Disk> still(static_cast<std::size_t>(count), disk);
            scene.clips.push_back({"still", std::nullopt, {}, std::make_shared<const mobb::Clip>(1e-3, still)});
            const DrawList list = build_draw_list(FittedScene(scene, {}), {}, kGoldenSize);
            EXPECT_EQ(list.disks.size(), static_cast<std::size_t>(count));
            const glm::vec2 at = list.projection.project(list.disks[0].base).value();
            EXPECT_TRUE(at.x >= 0 && at.x <= 640 && at.y >= 0 && at.y <= 360) << at.x << ' ' << at.y;
        }
    }
}

/// Also where colours say whose boxes they are.
TEST(DrawList, ARangeOfLevelsIsToldApart) {
    const FittedScene fitted = testing::miss_scene();
    for (const Theme theme : {Theme::dark, Theme::light}) {
        ViewState view;
        view.theme = theme;
        view.levels = {0, 4, false};
        const DrawList list = build_draw_list(fitted, view, PictureSize{1280, 720});
        const auto apart = [](Rgba a, Rgba b) { return glm::length(glm::vec3(a) - glm::vec3(b)); };
        for (const int agent : {0, 1}) {
            std::map<int, Rgba> colors;
            for (const BoxInstance& box : list.boxes) {
                if (box.id.agent == agent) colors[box.order.level] = box.edge;
            }
            ASSERT_EQ(colors.size(), 5u);
            for (int level = 1; level < 5; ++level) EXPECT_GT(apart(colors[level - 1], colors[level]), 0.1f) << level;
            for (const auto& [level, color] : colors) EXPECT_GT(contrast(color, list.palette.background), 1.5f);
        }
        std::vector<LegendEntry> swatches;
        for (const LegendEntry& entry : list.legend) {
            if (entry.text.starts_with("level")) swatches.push_back(entry);
        }
        ASSERT_EQ(swatches.size(), 5u);
        for (std::size_t i = 1; i < 5; ++i) {
            EXPECT_GT(apart(swatches[i - 1].color, swatches[i].color), 0.1f) << i;
            EXPECT_EQ(swatches[i].fill.a, swatches[0].fill.a);
        }
    }
}

TEST(DrawList, ColoursByLevelGoFromTheRootToTheLeaves) {
    const FittedScene fitted = testing::miss_scene();
    for (const Theme theme : {Theme::dark, Theme::light}) {
        ViewState view;
        view.theme = theme;
        view.levels = {0, 3, false};
        const DrawList by_agent = build_draw_list(fitted, view, PictureSize{1280, 720});
        view.color_by = ColorBy::level;
        const DrawList list = build_draw_list(fitted, view, PictureSize{1280, 720});
        std::map<int, Rgba> colors;
        for (const BoxInstance& box : list.boxes) {
            // Whoever it belongs to, and however faint it is where boxes crowd.
            const Rgba edge = with_alpha(box.edge, 1);
            EXPECT_EQ(colors.try_emplace(box.order.level, edge).first->second, edge);
            EXPECT_GT(contrast(edge, list.palette.background), 2);
        }
        ASSERT_EQ(colors.size(), 4u);
        for (const auto& [level, color] : colors) {
            const Rgba wanted = quantity_color(static_cast<float>(level) / 4, list.palette);
            EXPECT_LT(glm::length(color - outlining(wanted, list.palette)), 1e-3f) << level;
            if (level == 0) continue;
            EXPECT_GT(glm::length(color - colors[level - 1]), 0.15f) << level;
        }
        for (std::size_t i = 0; i < list.disks.size(); ++i) {
            const Rgba usual = by_agent.disks[i].color;
            EXPECT_EQ(with_alpha(list.disks[i].color, 1), with_alpha(usual, 1)) << "still the agent's";
            EXPECT_LT(list.disks[i].color.a, 0.6f * usual.a) << "but behind the boxes";
        }
    }
}

TEST(DrawList, ALevelHasOneColourInEveryPicture) {
    ViewState view;
    view.color_by = ColorBy::level;
    view.levels = {0, 3, false};
    const FittedScene fitted = testing::miss_scene();
    std::optional<Rgba> color;
    for (const BoxInstance& box : build_draw_list(fitted, view, kGoldenSize).boxes) {
        if (box.order.level == 2) color = with_alpha(box.edge, 1);
    }
    view.levels = {2, 2, false};
    EXPECT_EQ(with_alpha(build_draw_list(fitted, view, kGoldenSize).boxes.at(0).edge, 1), color);
}

TEST(DrawList, QueriesKeepTheirStatesColours) {
    ViewState view;
    view.query = 0;
    const FittedScene fitted = testing::hit_scene();
    const DrawList usual = build_draw_list(fitted, view, kGoldenSize);
    view.color_by = ColorBy::level;
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_EQ(list.boxes.size(), usual.boxes.size());
    for (std::size_t i = 0; i < list.boxes.size(); ++i) EXPECT_EQ(list.boxes[i].edge, usual.boxes[i].edge);
    EXPECT_EQ(list.disks[0].color, usual.disks[0].color);
}

TEST(Metrics, TextIsOneSizeFromSmallWindowsToLargeOnes) {
    for (const PictureSize size : {PictureSize{850, 540}, PictureSize{800, 500}, PictureSize{1280, 720}}) {
        EXPECT_EQ(metrics_of(size).text, 12) << size.width;
    }
    EXPECT_FLOAT_EQ(metrics_of({640, 360}).scale, 0.8f);
    EXPECT_FLOAT_EQ(metrics_of({100, 100}).scale, 0.8f);
    EXPECT_FLOAT_EQ(metrics_of({2560, 1440}).scale, 2);
    float before = 0;
    for (int width = 64; width < 8000; width += 50) {
        const float scale = metrics_of({width, width / 2}).scale;
        EXPECT_GE(scale, before);
        EXPECT_LT(scale - before, before == 0 ? 1 : 0.1f) << "no jumps";
        before = scale;
    }
    EXPECT_FLOAT_EQ(metrics_of({640, 360}, 3).scale, 3);
}

TEST(DrawList, TextAndLinesTakeTheScaleThatIsAskedFor) {
    const FittedScene fitted = testing::miss_scene();
    const PictureSize size{1280, 720};
    const DrawList usual = build_draw_list(fitted, {}, size);
    const DrawList large = build_draw_list(fitted, {}, size, 2);
    EXPECT_FLOAT_EQ(large.texts[0].size, 2 * usual.texts[0].size);
    EXPECT_FLOAT_EQ(large.lines[0].width, 2 * usual.lines[0].width);
    for (const double scale : {-1.0, 0.4, 8.5, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(build_draw_list(fitted, {}, size, scale), std::invalid_argument) << scale;
    }
}

}  // namespace
}  // namespace mobbscope
