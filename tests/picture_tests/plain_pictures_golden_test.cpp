// What motion graphs and charts look like: goldens as of a case, though there is no case of them.
#include <render/image/image_diff.h>
#include <render/image/png.h>
#include <render/pictures/chart_picture.h>
#include <render/pictures/graph_picture.h>

#include "render/backends.h"
#include "render/small_charts.h"
#include "render/small_graph.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace mobbscope::picture_tests {
namespace {

const std::filesystem::path kFolder = MOBBSCOPE_SOURCE_DIR "/tests/render/goldens";

class PlainPictures : public mobbscope::testing::OnEachBackend {
  protected:
    void expect_golden(const DrawList& list, const std::string& file) {
        const Image drawn = renderer().draw(list);
        const std::filesystem::path golden = kFolder / file;
        const std::filesystem::path actual = std::filesystem::path(MOBBSCOPE_KEPT_PICTURES) / file;
        std::filesystem::create_directories(actual.parent_path());
        write_png(actual, drawn);
        EXPECT_TRUE(std::filesystem::exists(golden) && diff(drawn, read_png(golden)).passes)
            << "look at " << actual << "; if it is right, copy it to " << golden;
    }
};

TEST_P(PlainPictures, OfAMotionGraphAreTheGoldens) {
    expect_golden(graph_picture(mobbscope::testing::small_graph(), {640, 360}, Theme::dark), "motion_graph.png");
}

TEST_P(PlainPictures, OfAChartAreTheGoldens) {
    expect_golden(chart_picture({mobbscope::testing::small_chart()}, {800, 450}, Theme::light).list, "chart.png");
}

TEST_P(PlainPictures, OfChartsSideBySideAreTheGoldens) {
    expect_golden(chart_picture({mobbscope::testing::small_chart(), mobbscope::testing::small_level_chart()},
                                {1280, 480}, Theme::dark)
                      .list,
                  "charts.png");
}

INSTANTIATE_TEST_SUITE_P(Backends, PlainPictures, ::testing::Values(Backend::osmesa, Backend::egl),
                         mobbscope::testing::backend_name);

}  // namespace
}  // namespace mobbscope::picture_tests
