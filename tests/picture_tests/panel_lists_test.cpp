// Panels are seen from one place, so that what differs is what is drawn.
#include <picture_tests/picture_maker.h>
#include <picture_tests/test_case.h>
#include <render/drawlist/draw_list.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

std::vector<DrawList> lists_of(const std::string& more) {
    const CaseFolder cases;
    const std::string keys = R"({"mobbscope_case": 1, "scene": "scene.json", "size": "600x200", )";
    return panel_lists(read_case(cases.write("a", keys + more + "}").file).shot);
}

/// But for the depth, which fits what is drawn.
void expect_same_lens(const DrawList& a, const DrawList& b) {
    for (int column = 0; column < 4; ++column) {
        for (const int row : {0, 1, 3}) {
            EXPECT_NEAR(a.projection.clip_from_world[column][row], b.projection.clip_from_world[column][row], 1e-4)
                << column << " " << row;
        }
    }
}

/// Whether all disks are inside the picture; boxes may go beyond it.
bool shows_all(const DrawList& list) {
    return std::all_of(list.disks.begin(), list.disks.end(), [&](const DiskInstance& disk) {
        const glm::vec4 clip = list.projection.clip_from_world * glm::vec4(disk.base, 1);
        return std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
    });
}

TEST(PanelLists, HaveOneCameraWhateverTheyShow) {
    // The root's boxes are larger, and move no camera.
    const std::vector<DrawList> lists =
        lists_of(R"("panels": [{"title": "a", "view": {"levels": "leaves"}}, {"view": {"levels": 0}}, {}])");
    ASSERT_EQ(lists.size(), 3u);
    EXPECT_NE(lists[0].boxes.size(), lists[1].boxes.size());
    expect_same_lens(lists[0], lists[1]);
    expect_same_lens(lists[2], lists[1]);
    for (const DrawList& list : lists) {
        EXPECT_EQ(list.size, lists[0].size);
        EXPECT_TRUE(shows_all(list));
    }
}

TEST(PanelLists, ACameraOfItsOwnStays) {
    const std::vector<DrawList> lists =
        lists_of(R"("panels": [{}, {"view": {"camera": {"preset": "top"}}}, {"view": {"time_height": 9}}])");
    EXPECT_NEAR(lists[1].projection.back.z, 1, 1e-6);
    EXPECT_LT(lists[0].projection.back.z, 0.9f);
    EXPECT_EQ(lists[2].space.time_height, 9);
    EXPECT_NE(lists[0].space.time_height, 9);
}

TEST(PanelLists, DifferentPeopleAreFramedEachByThemselves) {
    const CaseFolder cases;
    cases.folder().write("far.json", R"({"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.4]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [2, 1]},
                   {"name": "C", "clip": "walk", "translate": [90, 40]}]})");
    const CaseFile file = cases.write("a", R"({"mobbscope_case": 1, "scene": "far.json", "size": "600x200",
        "panels": [{"view": {"query": 0}}, {"view": {"query": 1}}]})");
    const std::vector<DrawList> lists = panel_lists(read_case(file.file).shot);
    for (const DrawList& list : lists) EXPECT_TRUE(shows_all(list));
    const auto metre = [](const DrawList& list) { return list.projection.pixels_per_metre(list.disks.front().base); };
    EXPECT_GT(metre(lists[0]), 5 * metre(lists[1])) << "A and B are near one another, C is far away";
}

}  // namespace
}  // namespace mobbscope::picture_tests
