// Charts: where points are, what is written, and that no words meet. What they look like are goldens:
// tests/picture_tests/plain_pictures_golden_test.cpp.
#include <render/pictures/chart_picture.h>

#include "small_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

const TextRun* run_with(const DrawList& list, const std::string& text) {
    const auto at =
        std::find_if(list.texts.begin(), list.texts.end(), [&](const TextRun& t) { return t.text == text; });
    return at == list.texts.end() ? nullptr : &*at;
}

/// All words are in the picture, and none over another.
void expect_readable(const DrawList& list) {
    const Rect picture{{0, 0}, {list.size.width, list.size.height}};
    for (std::size_t i = 0; i < list.texts.size(); ++i) {
        EXPECT_TRUE(picture.contains(list.texts[i].box)) << list.texts[i].text;
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(list.texts[i].box.overlaps(list.texts[j].box))
                << list.texts[i].text << " over " << list.texts[j].text;
        }
    }
}

Chart straight(Chart::Scale scale) {
    return {.title = "t",
            .x = {.name = "x", .scale = scale},
            .y = {.name = "y"},
            .series = {{.name = "line", .points = {{1, 0}, {10, 5}, {100, 10}}}}};
}

TEST(ChartPicture, AnEvenAxisKeepsDifferences) {
    const ChartPicture picture = chart_picture({straight(Chart::Scale::even)}, {640, 360}, Theme::dark);
    const auto& points = picture.points.at(0).at(0);
    ASSERT_TRUE(points[0] && points[1] && points[2]);
    EXPECT_NEAR((points[1]->x - points[0]->x) / (points[2]->x - points[0]->x), 9.0 / 99, 1e-4);
    EXPECT_NEAR(points[1]->y, 0.5 * (points[0]->y + points[2]->y), 0.01);
    EXPECT_GT(points[0]->y, points[2]->y) << "more is higher";
}

TEST(ChartPicture, AnAxisByFactorsKeepsFactors) {
    const ChartPicture picture = chart_picture({straight(Chart::Scale::factors)}, {640, 360}, Theme::dark);
    const auto& points = picture.points.at(0).at(0);
    ASSERT_TRUE(points[0] && points[1] && points[2]);
    EXPECT_NEAR(points[1]->x, 0.5 * (points[0]->x + points[2]->x), 0.01);
}

TEST(ChartPicture, ATickStandsWhereItsNumberIs) {
    for (const Chart::Scale scale : {Chart::Scale::even, Chart::Scale::factors}) {
        Chart chart = straight(scale);
        chart.series[0].points = {{20, 0}, {50, 5}, {200, 10}};
        const ChartPicture picture = chart_picture({chart}, {640, 360}, Theme::dark);
        const TextRun* number = run_with(picture.list, "50");
        ASSERT_NE(number, nullptr);
        EXPECT_NEAR(number->box.center().x, picture.points[0][0][1]->x, 1);
    }
}

TEST(ChartPicture, NumbersOfFactorsAreRoundAndHaveRoom) {
    const ChartPicture picture = chart_picture({small_chart()}, {640, 360}, Theme::light);
    for (const char* leaf : {"1", "2", "5", "10", "20", "50", "100", "200"})
        EXPECT_NE(run_with(picture.list, leaf), nullptr) << leaf;
    const ChartPicture small = chart_picture({small_chart()}, {200, 200}, Theme::light);
    EXPECT_NE(run_with(small.list, "10"), nullptr);
    EXPECT_EQ(run_with(small.list, "20"), nullptr);
}

TEST(ChartPicture, ARangeBelowAFactorOfTwoHasEvenNumbers) {
    Chart chart = straight(Chart::Scale::factors);
    chart.series[0].points = {{1.1, 0}, {1.5, 1}};
    const ChartPicture picture = chart_picture({chart}, {640, 360}, Theme::dark);
    EXPECT_NE(run_with(picture.list, "1.20"), nullptr);
    EXPECT_NE(run_with(picture.list, "1.40"), nullptr);
}

TEST(ChartPicture, WordsNeverMeet) {
    for (const PictureSize size :
         {PictureSize{320, 240}, PictureSize{640, 360}, PictureSize{1280, 720}, PictureSize{500, 900}}) {
        expect_readable(chart_picture({small_chart()}, size, Theme::light).list);
        expect_readable(chart_picture({small_level_chart()}, size, Theme::dark).list);
        expect_readable(chart_picture({small_chart(), small_level_chart()}, size, Theme::dark).list);
    }
}

TEST(ChartPicture, NamesOfLinesThatEndTogetherStandApart) {
    Chart chart = straight(Chart::Scale::even);
    chart.series.clear();
    for (int i = 0; i < 9; ++i)
        chart.series.push_back({.name = "tree " + std::to_string(i), .points = {{0, 0}, {1, 5 + 0.001 * i}, {2, 5}}});
    const DrawList list = chart_picture({chart}, {640, 360}, Theme::light).list;
    expect_readable(list);
    for (const Chart::Series& series : chart.series) EXPECT_NE(run_with(list, series.name), nullptr) << series.name;
}

TEST(ChartPicture, NamesThatHaveNoRoomAreCounted) {
    Chart chart = straight(Chart::Scale::even);
    for (int i = 0; i < 40; ++i)
        chart.series.push_back({.name = "tree " + std::to_string(i), .points = {{0, 1.0 * i}, {1, 2.0 * i}}});
    const DrawList list = chart_picture({chart}, {640, 360}, Theme::light).list;
    expect_readable(list);
    const auto names = std::count_if(list.texts.begin(), list.texts.end(), [](const TextRun& t) {
        return t.role == TextRole::legend && t.text.find("more") == std::string::npos;
    });
    EXPECT_NE(run_with(list, "+ " + std::to_string(41 - names) + " more"), nullptr);
}

TEST(ChartPicture, MarkedPointsHaveARingAndALabel) {
    const ChartPicture picture = chart_picture({small_chart()}, {640, 360}, Theme::dark);
    EXPECT_NE(run_with(picture.list, "now: MOBB, leaf 10"), nullptr);
    EXPECT_NE(run_with(picture.list, "recommended: moving, leaf 40"), nullptr);
    const auto rings_at = [&](glm::vec2 at) {
        return std::count_if(picture.list.marks.begin(), picture.list.marks.end(), [&](const OverlayPanel& mark) {
            const glm::vec2 off = glm::abs(mark.rect.center() - at);
            return mark.fill.a == 0 && off.x < 0.01F && off.y < 0.01F;
        });
    };
    EXPECT_EQ(rings_at(*picture.points[0][0][5]), 2);  // of now, on its dark ground
    EXPECT_EQ(rings_at(*picture.points[0][2][8]), 2);  // of the recommended one
    EXPECT_EQ(rings_at(*picture.points[0][1][8]), 0);
}

TEST(ChartPicture, WhatIsNoNumberBreaksTheLine) {
    Chart chart = straight(Chart::Scale::factors);
    chart.series[0].points = {{0, 1}, {1, 1}, {10, std::numeric_limits<double>::quiet_NaN()}, {100, 2}, {1000, 3}};
    const ChartPicture picture = chart_picture({chart}, {640, 360}, Theme::dark, 1);
    const auto& points = picture.points[0][0];
    EXPECT_FALSE(points[0]) << "an axis by factors has no 0";
    EXPECT_TRUE(points[1]);
    EXPECT_FALSE(points[2]);
    const auto lines = std::count_if(picture.list.overlay_lines.begin(), picture.list.overlay_lines.end(),
                                     [](const OverlayLine& line) { return line.width == 2; });
    EXPECT_EQ(lines, 1) << "from 100 to 1000";
}

TEST(ChartPicture, NothingOrOnePointIsAChartToo) {
    Chart chart = straight(Chart::Scale::factors);
    chart.series[0].points = {{7, 3}};
    expect_readable(chart_picture({chart}, {640, 360}, Theme::dark).list);
    chart.series.clear();
    expect_readable(chart_picture({chart}, {640, 360}, Theme::dark).list);
    EXPECT_TRUE(chart_picture({}, {640, 360}, Theme::dark).list.texts.empty());
    EXPECT_THROW(chart_picture({chart}, {1, 1}, Theme::dark), std::invalid_argument);
}

}  // namespace
}  // namespace mobbscope
