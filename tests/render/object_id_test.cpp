#include <render/drawlist/draw_list.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

TEST(ObjectId, GoesThroughTwoNumbers) {
    for (const ObjectId id : {ObjectId{0, ObjectId::Kind::disk, 0}, ObjectId{7, ObjectId::Kind::box, 123},
                              ObjectId{1, ObjectId::Kind::disk, 0x7FFFFFFF}}) {
        EXPECT_EQ(ObjectId::decode(id.r(), id.g()), id);
    }
    EXPECT_FALSE(ObjectId::decode(0, 0));
}

class ObjectIdTest : public testing::OnEachBackend {};

TEST_P(ObjectIdTest, TheUppermostDiskIsFoundFromAbove) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.camera.preset = CameraPreset::top;
    view.boxes = false;
    const DrawList list = build_draw_list(fitted, view, PictureSize{320, 240});
    const IdImage ids = renderer().draw_ids(list);
    const int last = fitted.tree(0).clip().count() - 1;
    for (const DiskInstance& disk : list.disks) {
        if (disk.id.index != last) continue;
        const glm::vec2 at = list.projection.project(disk.base).value();
        EXPECT_EQ(ids.at(static_cast<int>(at.x), static_cast<int>(at.y)), disk.id);
    }
    EXPECT_FALSE(ids.at(1, 1));
}

TEST_P(ObjectIdTest, TheNearestBoxHidesTheDisksInIt) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.camera.preset = CameraPreset::top;
    view.levels = {1, 1, false};
    const DrawList list = build_draw_list(fitted, view, PictureSize{320, 240});
    const IdImage ids = renderer().draw_ids(list);
    // The later box of each path is the upper one.
    for (int agent = 0; agent < 2; ++agent) {
        const int node = fitted.tree(0).children(0)[1];
        const auto box = std::find_if(list.boxes.begin(), list.boxes.end(), [&](const BoxInstance& b) {
            return b.id == ObjectId{agent, ObjectId::Kind::box, node};
        });
        ASSERT_NE(box, list.boxes.end());
        const glm::vec2 at = list.projection.project(box->center + 0.9f * box->extents[0]).value();
        EXPECT_EQ(ids.at(static_cast<int>(at.x), static_cast<int>(at.y)), box->id);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ObjectIdTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

}  // namespace
}  // namespace mobbscope
