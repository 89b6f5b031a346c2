#include <render/drawlist/picture_options.h>
#include <render/image/image_diff.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace mobbscope {
namespace {

Image render(const FittedScene& fitted, const ViewState& view, PictureSize size, Renderer& renderer) {
    return renderer.draw(build_draw_list(fitted, view, size));
}

TEST(Picture, AbsurdSizesAreRefused) {
    EXPECT_NO_THROW(check(PictureSize{640, 360}));
    EXPECT_NO_THROW(check(PictureSize{7680, 4320}));
    for (const PictureSize size :
         {PictureSize{0, 360}, PictureSize{-640, 360}, PictureSize{100000, 360}, PictureSize{8192, 8192}}) {
        EXPECT_THROW(check(size), std::invalid_argument);
    }
}

class PictureTest : public testing::OnEachBackend {};

TEST_P(PictureTest, TheSameTwice) {
    const FittedScene fitted = testing::hit_scene();
    const Image once = render(fitted, {}, kSmallSize, renderer());
    Renderer other(GetParam());
    EXPECT_EQ(once.rgba, render(fitted, {}, kSmallSize, other).rgba);
    EXPECT_EQ(once.rgba, render(fitted, {}, kSmallSize, renderer()).rgba);
}

TEST_P(PictureTest, SizesFollowOneAnother) {
    const FittedScene fitted = testing::hit_scene();
    const Image small = render(fitted, {}, kSmallSize, renderer());
    const Image large = render(fitted, {}, {400, 300}, renderer());
    EXPECT_EQ(large.width, 400);
    EXPECT_EQ(large.height, 300);
    EXPECT_EQ(small.rgba, render(fitted, {}, kSmallSize, renderer()).rgba);
}

/// Nested boxes, coplanar faces, equal disks: nothing may depend on the order in which the lists hold them.
TEST_P(PictureTest, ShufflingChangesNothing) {
    const FittedScene fitted(testing::scene_of({{}, {}, {{0.2, 0}, 0, 0}, {{1, -1}, 90, 0}}), {});
    ViewState view;
    view.levels = {0, 5, false};
    DrawList list = build_draw_list(fitted, view, kSmallSize);
    const Image ordered = renderer().draw(list);
    std::mt19937 random(7);
    for (int round = 0; round < 3; ++round) {
        std::shuffle(list.disks.edit().begin(), list.disks.edit().end(), random);
        std::shuffle(list.boxes.begin(), list.boxes.end(), random);
        std::shuffle(list.lines.begin(), list.lines.end(), random);
        const ImageDiff result = diff(renderer().draw(list), ordered, {1, 0});
        EXPECT_TRUE(result.passes) << result.differing << " pixels differ, by up to " << result.largest;
    }
}

/// The passes sort what they are given; permuting what they sort by shows whether faces blend the same in any order.
TEST_P(PictureTest, FacesBlendTheSameInAnyOrder) {
    const FittedScene fitted(testing::scene_of({{}, {}, {{0.2, 0}, 0, 0}, {{1, -1}, 90, 0}}), {});
    ViewState view;
    view.levels = {0, 5, false};
    DrawList list = build_draw_list(fitted, view, kSmallSize);
    // Edges and disks do hide one another; the order decides where they are equally deep.
    list.lines.clear();
    list.disks.edit().clear();
    std::vector<DrawOrder> orders;
    for (BoxInstance& box : list.boxes) {
        box.edge.a = 0;
        orders.push_back(box.order);
    }
    ASSERT_GT(list.boxes.size(), 50u);
    const Image ordered = renderer().draw(list);
    std::mt19937 random(7);
    for (int round = 0; round < 3; ++round) {
        std::shuffle(orders.begin(), orders.end(), random);
        for (std::size_t i = 0; i < orders.size(); ++i) list.boxes[i].order = orders[i];
        const ImageDiff result = diff(renderer().draw(list), ordered, {1, 0});
        EXPECT_TRUE(result.passes) << result.differing << " pixels differ, by up to " << result.largest;
    }
}

TEST_P(PictureTest, FarFromTheOriginItLooksTheSame) {
    const FittedScene near(testing::scene_of({{}, {{1, -1}, 90, 0.25}}), {});
    const FittedScene far(testing::scene_of({{{10000, -8000}, 0, 1e5}, {{10001, -8001}, 90, 100000.25}}), {});
    ViewState view;
    view.labels = false;
    const ImageDiff result =
        diff(render(far, view, kSmallSize, renderer()), render(near, view, kSmallSize, renderer()));
    EXPECT_TRUE(result.passes) << result.differing << " pixels differ, by up to " << result.largest;
}

/// Something just before the eye, as a plane that it stands in, leaves little depth for the rest.
TEST_P(PictureTest, DisksHideTheFloorHoweverNearTheNearestIs) {
    const FittedScene fitted(testing::running_scene({{}, {{1, -1}, 90, 0}}), {});
    ViewState view;
    view.camera.preset = CameraPreset::iso;
    view.boxes = view.labels = false;
    DrawList list = build_draw_list(fitted, view, kSmallSize);
    ViewProjection& projection = list.projection;
    ASSERT_TRUE(projection.perspective);
    const Image usual = renderer().draw(list);
    projection.near_depth = 1e-3f * projection.far_depth;
    const float range = projection.far_depth - projection.near_depth;
    glm::mat4& clip = projection.clip_from_world;
    for (int column = 0; column < 4; ++column) {
        clip[column][2] = (projection.far_depth + projection.near_depth) / range * clip[column][3];
    }
    clip[3][2] -= 2 * projection.far_depth * projection.near_depth / range;
    const ImageDiff result = diff(renderer().draw(list), usual, {8, 0.0005});
    EXPECT_TRUE(result.passes) << result.differing << " pixels differ, by up to " << result.largest;
}

TEST_P(PictureTest, DisksHideWhatIsBehindThem) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.camera.preset = CameraPreset::top;
    view.boxes = view.labels = view.floor = view.time_axis = false;
    const DrawList list = build_draw_list(fitted, view, kSmallSize);
    const Image image = renderer().draw(list);
    // The uppermost disk of B, the later half of its path, shows B's colour; the corner shows the background.
    const glm::vec2 at = list.projection.project(list.disks.back().base).value();
    const std::uint8_t* pixel = image.at(static_cast<int>(at.x), static_cast<int>(at.y));
    EXPECT_GT(pixel[2], pixel[0] + 60);
    EXPECT_NEAR(image.at(0, 0)[0], 0x14, 1);
    EXPECT_NEAR(image.at(0, 0)[2], 0x1D, 1);
}

TEST_P(PictureTest, ManyDisksAndBoxes) {
    std::vector<mobb::Placement> placements;
    for (int i = 0; i < 5; ++i) placements.push_back({{0.3 * i, 0.5 * i}, 30.0 * i, 0.1 * i});
    mobb::FitOptions options;
    options.leaf = 1;
    const FittedScene fitted(testing::scene_of(placements, 1260), options);
    ViewState view;
    view.levels = {0, 20, false};
    const DrawList list = build_draw_list(fitted, view, kSmallSize);
    EXPECT_EQ(list.disks.size(), 6300u);
    EXPECT_GT(list.boxes.size(), 10000u);
    EXPECT_NO_THROW(renderer().draw(list));
}

INSTANTIATE_TEST_SUITE_P(All, PictureTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(Picture, BackendsAgree) {
    const std::unique_ptr<Renderer> osmesa = testing::open_or_skip(Backend::osmesa);
    if (!osmesa) return;
    const std::unique_ptr<Renderer> egl = testing::open_or_skip(Backend::egl);
    if (!egl) return;
    ViewState view;
    view.query = 0;
    view.step = {Step::Unit::percent, 60};
    const FittedScene fitted = testing::hit_scene(mobb::TreeKind::umobb);
    const DrawList list = build_draw_list(fitted, view, kSmallSize);
    const ImageDiff result = diff(osmesa->draw(list), egl->draw(list));
    EXPECT_TRUE(result.passes) << result.differing << " pixels differ, by up to " << result.largest;
    EXPECT_EQ(osmesa->draw_ids(list).rg, egl->draw_ids(list).rg);
}

}  // namespace
}  // namespace mobbscope
