// What motion graphs and charts look like: goldens as of a case (picture_tests/reference.h), though there is no case of
// them.
#include <cases/case_file.h>
#include <picture_tests/reference.h>
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <render/pictures/chart_picture.h>
#include <render/pictures/graph_picture.h>

#include "render/backends.h"
#include "render/small_charts.h"
#include "render/small_graph.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace mobbscope::picture_tests {
namespace {

const std::filesystem::path kFolder = MOBBSCOPE_SOURCE_DIR "/tests/render/goldens";

void expect_golden(const Image& drawn, const std::string& file, Tolerance tolerance) {
    const std::filesystem::path golden = kFolder / file;
    const std::filesystem::path actual = std::filesystem::path(MOBBSCOPE_KEPT_PICTURES) / file;
    std::filesystem::create_directories(actual.parent_path());
    write_png(actual, drawn);
    EXPECT_TRUE(std::filesystem::exists(golden) && diff(drawn, read_png(golden), diff_options(tolerance)).passes)
        << "look at " << actual << "; if it is right, copy it to " << golden;
}

class PlainPictures : public mobbscope::testing::OnEachBackend {
  protected:
    /// Without words too, as other machines may letter them otherwise.
    void expect_goldens(DrawList list, const std::string& name) {
        const Image drawn = renderer().draw(list);
        const auto reference = read_reference(kFolder);
        ASSERT_TRUE(reference);
        const std::string other = what_is_other(reference_of(renderer()), *reference);
        if (other.empty()) {
            expect_golden(drawn, name + ".png", Tolerance::tight);
        } else {
            std::cout << "Pixels of text are not compared: drawn with " << other << '\n';
        }
        list.texts.clear();
        expect_golden(coarse_picture(renderer().draw(list)), name + ".plain.png", Tolerance::loose);
    }
};

TEST_P(PlainPictures, OfAMotionGraphAreTheGoldens) {
    expect_goldens(graph_picture(mobbscope::testing::small_graph(), {640, 360}, Theme::dark), "motion_graph");
}

TEST_P(PlainPictures, OfAChartAreTheGoldens) {
    expect_goldens(chart_picture({mobbscope::testing::small_chart()}, {800, 450}, Theme::light).list, "chart");
}

/// Narrow ones: how wide words are decides where their lines stand, so other fonts draw another picture.
TEST_P(PlainPictures, OfChartsSideBySideAreTheGoldens) {
    const auto reference = read_reference(kFolder);
    ASSERT_TRUE(reference);
    if (const std::string other = what_is_other(reference_of(renderer()), *reference); !other.empty())
        GTEST_SKIP() << "drawn with " << other;
    expect_goldens(chart_picture({mobbscope::testing::small_chart(), mobbscope::testing::small_level_chart()},
                                 {1280, 480}, Theme::dark)
                       .list,
                   "charts");
}

INSTANTIATE_TEST_SUITE_P(Backends, PlainPictures, ::testing::Values(Backend::osmesa, Backend::egl),
                         mobbscope::testing::backend_name);

}  // namespace
}  // namespace mobbscope::picture_tests
