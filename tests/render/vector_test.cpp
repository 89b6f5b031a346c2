// SVG and PDF of draw lists: what is in the files. That browsers show the PNG's pixels is
// tests/cli/vector_in_browser.sh.
#include <render/pictures/build_draw_list.h>
#include <render/pictures/chart_picture.h>
#include <render/vector/vector_canvas.h>
#include <render/vector/vector_picture.h>
#include <render/vector/world_lines.h>

#include "backends.h"
#include "small_charts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Renderer& no_renderer() { throw std::logic_error("nothing of it needs pixels"); }

std::string bytes_of(const std::string& file, const DrawList& list) {
    return picture_bytes(file, list, 1, no_renderer);
}

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Elements open and close as XML wants, and nothing else stands between their angles.
void expect_xml(const std::string& text) {
    std::vector<std::string> open;
    ASSERT_EQ(text.rfind("<?xml", 0), 0U);
    std::size_t at = text.find("?>") + 2;
    for (std::size_t begin = text.find('<', at); begin != std::string::npos; begin = text.find('<', at)) {
        EXPECT_EQ(text.substr(at, begin - at).find('>'), std::string::npos);
        at = text.find('>', begin) + 1;
        const std::string tag = text.substr(begin + 1, at - begin - 2);
        EXPECT_EQ(times(tag, "\"") % 2, 0U) << tag;
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.front() == '/') {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(name, "/" + open.back());
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
        }
    }
    EXPECT_TRUE(open.empty());
}

DrawList chart() { return chart_picture({testing::small_chart()}, {640, 360}, Theme::light).list; }

TEST(Vector, SvgIsXmlWithEveryTextAsText) {
    const DrawList list = chart();
    const std::string svg = bytes_of("x.svg", list);
    expect_xml(svg);
    EXPECT_NE(svg.find("width=\"640\" height=\"360\" viewBox=\"0 0 640 360\""), std::string::npos);
    EXPECT_EQ(times(svg, "<text "), list.texts.size());
    for (const TextRun& text : list.texts)
        EXPECT_NE(svg.find(">" + text.text + "</text>"), std::string::npos) << text.text;
    EXPECT_EQ(svg.find("<image"), std::string::npos);
}

TEST(Vector, WhatMeansSomethingInXmlIsEscaped) {
    Chart odd = testing::small_chart();
    odd.title = "<a> & \"b\"";
    const std::string svg = bytes_of("x.svg", chart_picture({odd}, {640, 360}, Theme::dark).list);
    expect_xml(svg);
    EXPECT_NE(svg.find("&lt;a&gt; &amp; &quot;b&quot;</text>"), std::string::npos);
}

TEST(Vector, ATextIsAsWideAsInThePicture) {
    DrawList list;
    list.size = {200, 100};
    TextRun text;
    text.text = "Width";
    text.baseline = {10, 20};
    list.texts = {text};
    const std::string svg = bytes_of("x.svg", list);
    EXPECT_NE(svg.find("x=\"10\" y=\"20\""), std::string::npos);
    const std::size_t at = svg.find("textLength=\"");
    ASSERT_NE(at, std::string::npos);
    EXPECT_NEAR(std::stod(svg.substr(at + 12)), Font::of(FontFace::text).width("Width", 12), 1e-3);
}

TEST(Vector, PdfHasThePictureSizeAndNoDate) {
    const std::string pdf = bytes_of("x.PDF", chart());
    EXPECT_EQ(pdf.rfind("%PDF-", 0), 0U);
    EXPECT_NE(pdf.find("/MediaBox [ 0 0 640 360 ]"), std::string::npos);
    EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
    EXPECT_NE(pdf.find("OpenSans"), std::string::npos) << "its face, so its text is text";
    EXPECT_NE(pdf.find("/ToUnicode"), std::string::npos);
    DrawList list = chart();
    std::erase_if(list.texts, [](const TextRun& text) { return text.face == FontFace::mono; });
    EXPECT_EQ(bytes_of("x.pdf", list).find("FiraCode"), std::string::npos);
    list.texts.front().text = "a \u2192 b";
    EXPECT_NE(bytes_of("x.pdf", list).find("FiraCode"), std::string::npos) << "the face that has an arrow";
}

TEST(Vector, TheSameListGivesTheSameBytes) {
    for (const char* file : {"x.svg", "x.pdf"}) EXPECT_EQ(bytes_of(file, chart()), bytes_of(file, chart())) << file;
}

TEST(Vector, LinesThatGoOnAreOneAndTranslucentOnesThatCrossAreNot) {
    LineStyle style;
    std::vector<VectorStroke> strokes;
    add_line(strokes, {0, 0}, {1, 0}, style);
    add_line(strokes, {1, 0}, {1, 1}, style);
    add_line(strokes, {5, 0}, {5, 1}, style);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_EQ(strokes[0].runs.size(), 2U);
    EXPECT_EQ(strokes[0].runs[0].size(), 3U);
    style.color.a = 0.5F;
    add_line(strokes, {0, 0}, {1, 0}, style);
    add_line(strokes, {0.5F, -1}, {0.5F, 1}, style);
    EXPECT_EQ(strokes.size(), 3U);
}

/// Its world is clip space: from -1 to 1 each way, z away from the eye.
DrawList plane() {
    DrawList list;
    list.size = {200, 100};
    list.projection.size = list.size;
    list.projection.clip_from_world = glm::mat4(1);
    list.palette = palette(Theme::dark);
    return list;
}

LineInstance line_of(glm::vec3 from, glm::vec3 to, float hidden) {
    LineInstance line;
    line.from = from;
    line.to = to;
    line.hidden = hidden;
    return line;
}

TEST(Vector, ALineBehindADiskIsHiddenThere) {
    DrawList list = plane();
    list.lines = {line_of({-1, 0, 0.5F}, {1, 0, 0.5F}, 0.25F)};
    DepthImage depths{200, 100, std::vector<float>(200 * 100, 1)};
    for (std::size_t y = 0; y < 100; ++y) {
        for (std::size_t x = 50; x < 80; ++x) depths.depths[y * 200 + x] = 0.2F;
    }
    std::vector<VectorStroke> strokes = world_lines(list, &depths);
    ASSERT_EQ(strokes.size(), 2U);  // what is hidden, and the rest
    EXPECT_FLOAT_EQ(strokes[0].color.a, 0.25F);
    ASSERT_EQ(strokes[0].runs.size(), 1U);
    EXPECT_NEAR(strokes[0].runs[0].front().x, 50, 1);
    EXPECT_NEAR(strokes[0].runs[0].back().x, 80, 1);
    EXPECT_NEAR(strokes[0].runs[0].back().y, 50, 1e-3);
    ASSERT_EQ(strokes[1].runs.size(), 2U);
    list.lines[0].hidden = 0;
    strokes = world_lines(list, &depths);
    ASSERT_EQ(strokes.size(), 1U) << "nothing of it is kept";
    list.lines[0].from.z = list.lines[0].to.z = -0.8F;
    strokes = world_lines(list, &depths);
    ASSERT_EQ(strokes.size(), 1U);
    EXPECT_EQ(strokes[0].runs.size(), 1U) << "it lies before the disk";
}

TEST(Vector, DashesGoOnWhereALineComesOutOfADisk) {
    DrawList list = plane();
    list.lines = {line_of({-1, 0, 0.5F}, {1, 0, 0.5F}, 0)};
    list.lines[0].dash = {6, 4, 6, 4};
    DepthImage depths{200, 100, std::vector<float>(200 * 100, 1)};
    for (std::size_t y = 0; y < 100; ++y) {
        for (std::size_t x = 50; x < 83; ++x) depths.depths[y * 200 + x] = 0.2F;
    }
    const std::vector<VectorStroke> strokes = world_lines(list, &depths);
    ASSERT_EQ(strokes.size(), 2U);
    EXPECT_FLOAT_EQ(strokes[0].dash_start, 0);
    EXPECT_NEAR(strokes[1].dash_start, std::fmod(strokes[1].runs[0].front().x, 20.0F), 1e-3);
}

TEST(Vector, OnlyWhatIsInThePictureIsWritten) {
    DrawList list = plane();
    list.lines = {line_of({-50, 0, 0}, {50, 0, 0}, 0), line_of({-1, 7, 0}, {1, 7, 0}, 0)};
    const std::vector<VectorStroke> strokes = world_lines(list, nullptr);
    ASSERT_EQ(strokes.size(), 1U);
    ASSERT_EQ(strokes[0].runs.size(), 1U);
    EXPECT_NEAR(strokes[0].runs[0].front().x, 0, 5);
    EXPECT_NEAR(strokes[0].runs[0].back().x, 200, 5);
}

class VectorWorld : public testing::OnEachBackend {};

TEST_P(VectorWorld, DisksArePixelsAndEdgesAreLines) {
    DrawList list = plane();
    DiskInstance disk;
    disk.base = {0, 0, -0.1F};
    disk.radius = 0.3F;
    disk.top = {0, 0, 0};
    disk.top_radius = 0.3F;
    list.disks.edit().push_back(disk);
    BoxInstance box;
    box.extents = {glm::vec3(0.5F, 0, 0), glm::vec3(0, 0.5F, 0), glm::vec3(0, 0, 0.5F)};
    list.boxes = {box};
    const std::string svg = picture_bytes("x.svg", list, 1, [this]() -> Renderer& { return renderer(); });
    EXPECT_EQ(times(svg, "<image"), 1U);
    EXPECT_GE(times(svg, "<path"), 1U);
    EXPECT_EQ(svg, picture_bytes("x.svg", list, 1, [this]() -> Renderer& { return renderer(); }));
}

INSTANTIATE_TEST_SUITE_P(Backends, VectorWorld, ::testing::Values(Backend::osmesa, Backend::egl),
                         testing::backend_name);

}  // namespace
}  // namespace mobbscope
