// Slabs of time: what is outside of them is not in the picture, and cannot be pointed at. Where boxes meet a moment.
#include <mobb/traversal.h>
#include <render/drawlist/cut.h>
#include <render/drawlist/pick.h>
#include <render/parts/node_boxes.h>
#include <render/parts/sections.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>
#include <render/vector/world_lines.h>
#include <scene/drawn_agent.h>
#include <scene/view_options.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr PictureSize kSlabSize{480, 360};

/// Two paths from 0 to 2 s that cross.
FittedScene walks_of(mobb::TreeKind kind, bool running, mobb::Axes axes = mobb::Axes::endpoints) {
    mobb::FitOptions options;
    options.tree = kind;
    options.axes = axes;
    options.leaf = 4;
    const std::vector<mobb::Placement> places{{}, {{1, -1}, 90, 0}};
    return {running ? testing::running_scene(places) : testing::scene_of(places), options};
}

/// Seen along y without perspective: a row of the picture is a time.
ViewState from_the_front() {
    ViewState view;
    view.camera.preset = CameraPreset::front;
    view.floor = view.time_axis = view.labels = false;
    view.levels = {0, 4, false};
    return view;
}

float row_of(const DrawList& list, double time) {
    return list.projection.project(list.space.point(list.space.origin.x, list.space.origin.y, time)).value().y;
}

bool is_ground(const DrawList& list, const Image& image, int x, int y) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    for (int c = 0; c < 3; ++c) {
        const float level = 255 * list.palette.background[c];
        if (std::abs(static_cast<float>(image.rgba[at + static_cast<std::size_t>(c)]) - level) > 1.5f) return false;
    }
    return true;
}

double area_of(const std::vector<glm::vec3>& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * std::abs(twice);
}

class SlabTest : public testing::OnEachBackend {};

TEST_P(SlabTest, NothingIsDrawnOutside) {
    for (const bool running : {false, true}) {
        const FittedScene fitted = walks_of(mobb::TreeKind::umobb, running);
        for (const bool cut : {false, true}) {
            ViewState view = from_the_front();
            view.slab = ValueRange{0.55, 1.21};
            view.cut_boxes = cut;
            view.boxes = cut;  // whole ones reach out of the slab
            const DrawList list = build_draw_list(fitted, view, kSlabSize);
            const float top = row_of(list, 1.21), bottom = row_of(list, 0.55);
            for (const int samples : {1, 4}) {
                const Image image = renderer().draw(list, samples);
                int inside = 0;
                for (int y = 0; y < kSlabSize.height; ++y) {
                    for (int x = 0; x < kSlabSize.width; ++x) {
                        if (is_ground(list, image, x, y)) continue;
                        const float row = static_cast<float>(y) + 0.5f;
                        ASSERT_GE(row, top - 2) << x << ", " << y << " with " << samples << " samples";
                        ASSERT_LE(row, bottom + 2) << x << ", " << y << " with " << samples << " samples";
                        ++inside;
                    }
                }
                EXPECT_GT(inside, 2000);
            }
            const IdImage ids = renderer().draw_ids(list);
            for (int y = 0; y < kSlabSize.height; ++y) {
                for (int x = 0; x < kSlabSize.width; ++x) {
                    if (!ids.at(x, y)) continue;
                    ASSERT_GE(static_cast<float>(y) + 0.5f, top - 1);
                    ASSERT_LE(static_cast<float>(y) + 0.5f, bottom + 1);
                }
            }
            for (const VectorStroke& stroke : world_lines(list, nullptr)) {
                for (const auto& run : stroke.runs) {
                    for (const glm::vec2& point : run) {
                        ASSERT_GE(point.y, top - 2);
                        ASSERT_LE(point.y, bottom + 2);
                    }
                }
            }
        }
    }
}

/// Between the planes the picture is that of all of time, wherever nothing else stands there.
TEST_P(SlabTest, WhatIsInsideIsAsItWas) {
    const FittedScene fitted = walks_of(mobb::TreeKind::mobb, false);
    ViewState view = from_the_front();
    view.boxes = false;
    const DrawList all = build_draw_list(fitted, view, kSlabSize);
    view.slab = ValueRange{0.55, 1.21};
    const DrawList list = build_draw_list(fitted, view, kSlabSize);
    const IdImage whole = renderer().draw_ids(all), ids = renderer().draw_ids(list);
    for (int y = static_cast<int>(row_of(list, 1.21)) + 2; y < static_cast<int>(row_of(list, 0.55)) - 2; ++y) {
        for (int x = 0; x < kSlabSize.width; ++x) ASSERT_EQ(ids.at(x, y), whole.at(x, y)) << x << ", " << y;
    }
}

/// A disk that is cut shows its full circle where it is cut, whatever stood on it.
TEST_P(SlabTest, FacesOfCutDisksAreWhole) {
    const FittedScene fitted = walks_of(mobb::TreeKind::mobb, false);
    ViewState view = from_the_front();
    view.camera.preset = CameraPreset::top;
    view.boxes = false;
    view.slab = ValueRange{0.5, 1.21};
    view.hidden = {"B"};
    const DrawList list = build_draw_list(fitted, view, kSlabSize);
    const DrawnAgent a = drawn_agents(fitted, view)[0];
    const mobb::Disk last = a.clip().disk(36);  // holds from 1.2 s to 1.23 s
    const IdImage ids = renderer().draw_ids(list);
    const glm::vec3 middle = list.space.point(last.x, last.y, 1.21);
    const double radius = last.r * static_cast<double>(list.projection.pixels_per_metre(middle));
    double pixels = 0;
    for (int y = 0; y < kSlabSize.height; ++y) {
        for (int x = 0; x < kSlabSize.width; ++x)
            pixels += ids.at(x, y) == ObjectId{0, ObjectId::Kind::disk, 36} ? 1 : 0;
    }
    EXPECT_NEAR(pixels, 3.14159 * radius * radius, 0.03 * pixels);
}

TEST_P(SlabTest, PickedIsWhatIsDrawn) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::umobb, mobb::TreeKind::moving}) {
        const FittedScene fitted = walks_of(kind, kind == mobb::TreeKind::moving);
        for (const bool cut : {false, true}) {
            for (const bool above : {true, false}) {
                ViewState view;
                view.levels = {0, 3, false};
                view.slab = ValueRange{0.55, 1.21};
                view.cut_boxes = cut;
                view.camera.preset = CameraPreset::free;
                view.camera.pitch_deg = above ? 35 : -35;
                const DrawList list = build_draw_list(fitted, view, kSlabSize);
                const IdImage ids = renderer().draw_ids(list);
                int shown = 0, differing = 0;
                for (int y = 2; y < kSlabSize.height; y += 5) {
                    for (int x = 2; x < kSlabSize.width; x += 5) {
                        const auto drawn = ids.at(x, y);
                        shown += drawn ? 1 : 0;
                        const auto picks =
                            pick(list, glm::vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
                        const bool agrees =
                            drawn ? std::ranges::any_of(picks,
                                                        [&](const Pick& one) {
                                                            return one.id == *drawn &&
                                                                   one.depth - picks.front().depth < 2e-3f;
                                                        })
                                  : picks.empty();
                        differing += agrees ? 0 : 1;
                    }
                }
                EXPECT_GT(shown, 300);
                EXPECT_LT(differing, 0.01 * shown) << (cut ? "cut" : "whole") << (above ? "" : ", from below");
            }
        }
    }
}

TEST_P(SlabTest, DraggingItsEndsUploadsNothingOfTheWorld) {
    KeptPaths paths(std::make_shared<const FittedScene>(walks_of(mobb::TreeKind::umobb, false)));
    for (const int samples : {1, 4}) {
        for (const bool cut : {false, true}) {
            ViewState view;
            view.levels = {0, 4, false};
            view.cut_boxes = cut;
            view.slab = ValueRange{0.2, 0.9};
            const auto draw = [&] {
                renderer().paint(build_draw_list(paths, view, {.size = kSlabSize}), samples);
                return renderer().statistics().world_bytes;
            };
            draw();
            draw();
            for (int i = 1; i <= 10; ++i) {
                view.slab = ValueRange{0.2 + 0.03 * i, 0.9 + 0.09 * i};
                EXPECT_EQ(draw(), 0u) << i;
            }
        }
    }
}

/// Of the world nothing but the plane of the time cursor, and the sections that lie on it.
TEST_P(SlabTest, ScrubbingUploadsNoBoxes) {
    KeptPaths paths(std::make_shared<const FittedScene>(walks_of(mobb::TreeKind::umobb, false)));
    for (const bool slice : {false, true}) {
        ViewState view;
        view.levels = {0, 9, false};
        view.slice = slice;
        view.time = 0.2;
        const auto draw = [&] {
            renderer().paint(build_draw_list(paths, view, {.size = kSlabSize}), 1);
            return renderer().statistics();
        };
        draw();
        draw();
        for (int i = 1; i <= 10; ++i) {
            *view.time += 0.1;
            const DrawStatistics statistics = draw();
            EXPECT_LT(statistics.world_bytes, slice ? 6000u : 100u) << i;
            EXPECT_LT(statistics.state_bytes, slice ? 6000u : 100u) << i;
        }
    }
}

/// Nothing, one moment, and what lies beyond all time.
TEST_P(SlabTest, EmptySlabs) {
    for (const bool running : {false, true}) {
        const FittedScene fitted = walks_of(mobb::TreeKind::mobb, running);
        ViewState view = from_the_front();
        view.camera.preset = CameraPreset::top;
        view.boxes = false;
        const auto disks_seen = [&](ValueRange slab) {
            view.slab = slab;
            const IdImage ids = renderer().draw_ids(build_draw_list(fitted, view, kSlabSize));
            std::set<std::pair<int, int>> out;
            for (int y = 0; y < kSlabSize.height; ++y) {
                for (int x = 0; x < kSlabSize.width; ++x) {
                    if (const auto id = ids.at(x, y)) out.emplace(id->agent, id->index);
                }
            }
            return out;
        };
        const int sample = mobb::first_ending_after(drawn_agents(fitted, view)[0].clip(), 0, 6, 0.05);
        const std::set<std::pair<int, int>> at_one{{0, sample}, {1, sample}};
        EXPECT_EQ(disks_seen({0.05, 0.05}), at_one);
        EXPECT_TRUE(disks_seen({5, 6}).empty());
        EXPECT_TRUE(disks_seen({-6, -5}).empty());
        EXPECT_TRUE(disks_seen({-1, 0}).empty()) << "nobody is there before 0 s";
        EXPECT_EQ(disks_seen({0, 0}).size(), 2u);
        EXPECT_GT(disks_seen({-1e9, 1e9}).size(), 4u);
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, SlabTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(Slab, WhatItShows) {
    const DrawnSlab slab{1, 2};
    EXPECT_TRUE(slab.shows(0, 1.5f));
    EXPECT_TRUE(slab.shows(1.5f, 3));
    EXPECT_FALSE(slab.shows(0, 1)) << "it ends where the slab begins";
    EXPECT_FALSE(slab.shows(2, 3)) << "it begins where the slab ends";
    const DrawnSlab moment{1, 1};
    EXPECT_TRUE(moment.shows(1, 2));
    EXPECT_FALSE(moment.shows(0, 1)) << "the next one holds then";
}

TEST(Slab, RangesThatAreNone) {
    const ViewOption& slab = view_option("slab");
    ViewState view;
    for (const char* text : {"", "1", "2:1", "nan:1", "0:nan", "0:inf", "a:b", "1:2:3"}) {
        EXPECT_THROW(slab.parse(text, view), std::invalid_argument) << text;
    }
    slab.parse("-1:2.5", view);
    EXPECT_EQ(view.slab, (ValueRange{-1, 2.5}));
    slab.parse("none", view);
    EXPECT_FALSE(view.slab);
}

/// The caption says what is cut away, and where the time cursor lies outside.
TEST(Slab, TheCaptionSaysIt) {
    const FittedScene fitted = walks_of(mobb::TreeKind::mobb, false);
    ViewState view;
    view.slab = ValueRange{0.5, 1};
    view.time = 1.5;
    const DrawList list = build_draw_list(fitted, view, PictureSize{1280, 720});
    const auto says = [&](std::string_view words) {
        return std::ranges::any_of(list.texts,
                                   [&](const TextRun& run) { return run.text.find(words) != std::string::npos; });
    };
    EXPECT_TRUE(says("from 0.5 to 1 s"));
    EXPECT_TRUE(says("1.5 s lies outside 0.5..1 s"));
    EXPECT_FALSE(
        std::ranges::any_of(list.lines, [](const LineInstance& line) { return line.order.layer == DrawLayer::rings; }));
}

TEST(Slab, OfOneMomentIsSaidSo) {
    ViewState view;
    view.slab = ValueRange{1, 1};
    const DrawList list = build_draw_list(walks_of(mobb::TreeKind::mobb, false), view, PictureSize{1280, 720});
    EXPECT_TRUE(std::ranges::any_of(list.texts,
                                    [](const TextRun& run) { return run.text.find("at 1 s") != std::string::npos; }));
}

TEST(Slab, TheLegendHasWhatIsInItAlone) {
    const FittedScene fitted = walks_of(mobb::TreeKind::mobb, false);
    const auto rows_of = [&](ValueRange slab) {
        ViewState view;
        view.levels = {2, 2, false};
        view.slab = slab;
        std::set<std::string> out;
        for (const LegendEntry& entry : build_draw_list(fitted, view, kSlabSize).legend) out.insert(entry.text);
        return out;
    };
    const std::set<std::string> inside = rows_of({0.5, 1}), outside = rows_of({100, 200});
    for (const char* row : {"A", "B", "level 2"}) {
        EXPECT_TRUE(inside.contains(row)) << row;
        EXPECT_FALSE(outside.contains(row)) << row;
    }
}

/// Of every kind of box, against counting the points of the floor that lie in it.
TEST(Sections, HaveTheAreaThatTheBoxHasThen) {
    std::mt19937 random(7);
    // Along the endpoints a free box has an axis in the floor, so all its sections have four corners.
    const auto leaning = mobb::Axes::covariance;
    for (const auto& [kind, axes] :
         {std::pair(mobb::TreeKind::mobb, mobb::Axes::endpoints),
          std::pair(mobb::TreeKind::umobb, mobb::Axes::endpoints), std::pair(mobb::TreeKind::umobb, leaning),
          std::pair(mobb::TreeKind::moving, mobb::Axes::endpoints)}) {
        const FittedScene fitted = walks_of(kind, false, axes);
        ViewState view;
        view.levels = {0, 9, false};
        const DrawList list = build_draw_list(fitted, view, kSlabSize);
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
        std::set<std::size_t> corners_seen;
        int compared = 0;
        for (const BoxInstance& box : list.boxes) {
            const DrawnAgent& agent = agents[static_cast<std::size_t>(box.id.agent)];
            const mobb::Box exact = world_box(agent.placed, box.id.index);
            const glm::vec2 heights = heights_of(box);
            for (const float share : {0.004f, 0.03f, 0.3f, 0.61f, 0.98f, 0.997f}) {
                const float height = heights.x + share * (heights.y - heights.x);
                const std::vector<glm::vec3> section = level_section(box, height);
                ASSERT_GE(section.size(), 3u);
                ASSERT_LE(section.size(), 6u);
                corners_seen.insert(section.size());
                glm::vec3 low = section[0], high = section[0];
                for (const glm::vec3& corner : section) {
                    EXPECT_FLOAT_EQ(corner.z, height);
                    low = glm::min(low, corner);
                    high = glm::max(high, corner);
                }
                const double w = agent.placed.time_scale();
                const double t = list.space.place({0, 0, height}).z;
                constexpr int kCells = 80;
                int inside = 0;
                for (int i = 0; i < kCells * kCells; ++i) {
                    const glm::dvec2 share_of((0.5 + i % kCells) / kCells, (0.5 + i / kCells) / kCells);
                    const glm::dvec2 at = glm::dvec2(low) + share_of * glm::dvec2(high - low);
                    const glm::dvec3 place = list.space.place({at, 0});
                    glm::dvec3 from = glm::dvec3(place.x, place.y, t * w) - exact.center;
                    from -= glm::dvec3(exact.drift * (from.z / exact.half.z), 0);
                    bool within = true;
                    for (int axis = 0; axis < 3; ++axis) {
                        within = within && std::abs(glm::dot(from, exact.axes[static_cast<std::size_t>(axis)])) <=
                                               exact.half[axis] + 1e-9;
                    }
                    inside += within ? 1 : 0;
                }
                const glm::dvec2 extent(high - low);
                const double counted = extent.x * extent.y * inside / (kCells * kCells);
                EXPECT_NEAR(area_of(section), counted, 0.03 * extent.x * extent.y);
                ++compared;
            }
        }
        EXPECT_GT(compared, 50);
        EXPECT_TRUE(corners_seen.contains(4));
        EXPECT_EQ(corners_seen.size() > 1, axes == leaning) << mobb::name(kind) << " along " << mobb::name(axes);
    }
}

TEST(Sections, CountFromTheBeginToBeforeTheEnd) {
    BoxInstance box;
    box.extents = {glm::vec3(1, 0, 0), glm::vec3(0, 2, 0), glm::vec3(0, 0, 3)};
    EXPECT_EQ(level_section(box, -3).size(), 4u);
    EXPECT_EQ(area_of(level_section(box, -3)), 8);
    EXPECT_TRUE(level_section(box, 3).empty());
    EXPECT_TRUE(level_section(box, 3.5f).empty());
    EXPECT_TRUE(level_section(box, std::numeric_limits<float>::quiet_NaN()).empty());
}

/// The triangles that fill a section cover it once.
TEST(Sections, FillingsCoverThem) {
    const FittedScene fitted = walks_of(mobb::TreeKind::umobb, false);
    ViewState view;
    view.levels = {2, 2, false};
    view.time = 0.7;
    const DrawList without = build_draw_list(fitted, view, kSlabSize);
    view.slice = true;
    const DrawList list = build_draw_list(fitted, view, kSlabSize);
    const float height = list.space.point(0, 0, 0.7).z;
    double expected = 0, filled = 0, outlined = 0;
    for (const BoxInstance& box : without.boxes) {
        if (box.state == BoxState::level) expected += area_of(level_section(box, height));
    }
    for (const BoxInstance& box : list.boxes) {
        if (!box.triangle) continue;
        EXPECT_FLOAT_EQ(box.center.z, height);
        EXPECT_FALSE(box.pickable);
        filled += 2.0 * static_cast<double>(glm::length(glm::cross(box.extents[0], box.extents[1])));
    }
    for (const LineInstance& line : list.lines) outlined += line.order.layer == DrawLayer::findings ? 1 : 0;
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(filled, expected, 1e-4 * expected);
    EXPECT_GE(outlined, 8);
    view.boxes = false;
    const DrawList alone = build_draw_list(fitted, view, kSlabSize);
    EXPECT_EQ(std::ranges::count_if(alone.boxes, &BoxInstance::triangle),
              std::ranges::count_if(list.boxes, &BoxInstance::triangle))
        << "sections are shown without the boxes too";
}

double filled_area(const DrawList& list) {
    double out = 0;
    for (const BoxInstance& box : list.boxes) {
        if (box.triangle) out += 2.0 * static_cast<double>(glm::length(glm::cross(box.extents[0], box.extents[1])));
    }
    return out;
}

TEST(FloorPlan, HasTheDisksAndSectionsOfItsMoment) {
    for (const bool running : {false, true}) {
        const FittedScene fitted = walks_of(mobb::TreeKind::umobb, running);
        ViewState view;
        view.levels = {1, 2, false};
        view.time = 0.7;
        view.slice = true;
        const double expected = filled_area(build_draw_list(fitted, view, kSlabSize));
        view.show = Show::plan;
        const DrawList list = build_draw_list(fitted, view, PictureSize{1280, 720});
        EXPECT_NEAR(filled_area(list), expected, 1e-4 * expected);
        EXPECT_NEAR(list.projection.back.z, 1, 1e-6);
        EXPECT_FALSE(list.projection.perspective);
        ASSERT_EQ(list.disks.size(), 2u);
        const std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
        for (const DiskInstance& disk : list.disks) {
            const DrawnAgent& agent = agents[static_cast<std::size_t>(disk.id.agent)];
            const mobb::Disk there = mobb::swept(agent.clip(), disk.id.index).at(0.7);
            const glm::dvec3 place = list.space.place(disk.base);
            EXPECT_NEAR(place.x, there.x, 1e-5);
            EXPECT_NEAR(place.y, there.y, 1e-5);
            EXPECT_NEAR(static_cast<double>(disk.radius), there.r, 1e-6);
        }
        for (const char* name : {"A", "B"}) {
            EXPECT_TRUE(std::ranges::any_of(list.texts, [&](const TextRun& run) {
                return run.role == TextRole::name && run.text == name;
            })) << name;
        }
        view.boxes = false;
        EXPECT_EQ(filled_area(build_draw_list(fitted, view, kSlabSize)), 0);
        view.boxes = true;
        view.time = 50;
        const DrawList after = build_draw_list(fitted, view, kSlabSize);
        EXPECT_TRUE(after.disks.empty());
        EXPECT_EQ(filled_area(after), 0);
    }
}

/// Of a query those of the pair under test.
TEST(FloorPlan, HasThePairUnderTest) {
    const FittedScene fitted = testing::hit_scene(mobb::TreeKind::umobb);
    ViewState view;
    view.show = Show::plan;
    view.query = 0;
    view.step = {Step::Unit::event, 0};
    view.time = 0.7;
    const DrawList list = build_draw_list(fitted, view, kSlabSize);
    view.show = Show::space_time;
    view.past = Past::pair;
    const DrawList boxes = build_draw_list(fitted, view, kSlabSize);
    const float height = boxes.space.point(0, 0, 0.7).z;
    double expected = 0;
    for (const BoxInstance& box : boxes.boxes) {
        if (box.pickable) expected += area_of(level_section(box, height));
    }
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(filled_area(list), expected, 1e-3 * expected);
}

/// A camera that frames the scene by itself has the boxes in the picture, all corners of them, unless it is not to.
TEST(Framing, HasTheBoxesUnlessItIsNotTo) {
    const FittedScene fitted = walks_of(mobb::TreeKind::umobb, false);
    for (const bool query : {false, true}) {
        const FittedScene& of = query ? testing::hit_scene(mobb::TreeKind::umobb) : fitted;
        ViewState view;
        view.levels = {0, 0, false};
        if (query) view.query = 0, view.step = {Step::Unit::event, 0};
        const auto corners_outside = [&] {
            const DrawList list = build_draw_list(of, view, kSlabSize);
            int outside = 0;
            for (const BoxInstance& box : list.boxes) {
                if (!box.pickable || box.extents[2].z == 0) continue;
                for (const glm::vec3& corner : box_corners(box)) {
                    const auto at = list.projection.project(corner);
                    outside +=
                        at && at->x >= 0 && at->y >= 0 && at->x < kSlabSize.width && at->y < kSlabSize.height ? 0 : 1;
                }
            }
            return outside;
        };
        view.camera.preset = CameraPreset::side;
        EXPECT_EQ(corners_outside(), 0) << (query ? "query" : "levels");
        const double with = build_draw_list(of, view, kSlabSize).camera.distance;
        view.frame_boxes = false;
        EXPECT_LT(build_draw_list(of, view, kSlabSize).camera.distance, with);
    }
}

/// "time, s" is in every picture of space-time.
TEST(TimeTitle, IsInEveryView) {
    const FittedScene fitted = walks_of(mobb::TreeKind::mobb, false);
    for (const PictureSize size : {PictureSize{1280, 720}, {640, 360}, {320, 240}, {200, 150}, {300, 600}}) {
        for (const CameraPreset preset :
             {CameraPreset::iso, CameraPreset::top, CameraPreset::front, CameraPreset::side}) {
            for (const double nearer : {1.0, 4.0, 40.0}) {
                ViewState view;
                view.camera.preset = preset;
                view.time = 0.5;
                view.camera = build_draw_list(fitted, view, size).camera;
                view.camera.distance /= nearer;
                const DrawList list = build_draw_list(fitted, view, size);
                const auto titles = std::ranges::count_if(
                    list.texts, [](const TextRun& run) { return run.text.starts_with("time, s"); });
                EXPECT_EQ(titles, 1) << size.width << "x" << size.height << ", preset " << static_cast<int>(preset)
                                     << ", " << nearer << " times as near";
            }
        }
    }
}

}  // namespace
}  // namespace mobbscope
