#include <render/drawlist/pick.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Disks, boxes with faces, lines, panels and text.
DrawList everything() {
    ViewState view;
    view.levels = {0, 3, false};
    view.time = 1;
    return build_draw_list(testing::hit_scene(), view, kSmallSize);
}

class PaintTest : public testing::OnEachBackend {
  protected:
    /// What a renderer that has drawn nothing before makes of it.
    Image fresh(const DrawList& list) const { return Renderer(GetParam()).draw(list); }
};

TEST_P(PaintTest, TheTextureHoldsThePicture) {
    const DrawList list = everything();
    const Image drawn = renderer().draw(list);
    EXPECT_EQ(pixels_of(renderer().paint(list, kPictureSamples), kSmallSize), drawn.rgba);
    for (std::size_t i = 3; i < drawn.rgba.size(); i += 4) ASSERT_EQ(drawn.rgba[i], 255) << "pixel " << i / 4;
}

TEST_P(PaintTest, OneSampleIsNotMultisampled) {
    const DrawList list = everything();
    renderer().paint(list, 1);
    GLint buffers = -1;
    glGetIntegerv(GL_SAMPLE_BUFFERS, &buffers);
    EXPECT_EQ(buffers, 0);
}

/// What is seen around each pixel of a picture: by the arithmetic of picking, which knows no rasteriser. `of`: makes a
/// number of what the line of sight meets first, 0 if that is nothing; where it is one number in all pixels within
/// `reach` it stands for the pixel, else `kEdge` does.
constexpr int kEdge = -1;
template <class Of>
std::vector<int> seen_around(const DrawList& list, int reach, const Of& of) {
    const int width = list.size.width, height = list.size.height;
    const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    std::vector<int> seen(index(0, height)), out(seen.size(), kEdge);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::vector<Pick> met = pick(list, glm::vec2(x, y) + 0.5f);
            seen[index(x, y)] = met.empty() ? 0 : of(met.front().id);
        }
    }
    for (int y = reach; y < height - reach; ++y) {
        for (int x = reach; x < width - reach; ++x) {
            bool one = true;
            for (int v = y - reach; v <= y + reach; ++v) {
                for (int u = x - reach; u <= x + reach; ++u) one = one && seen[index(u, v)] == seen[index(x, y)];
            }
            if (one) out[index(x, y)] = seen[index(x, y)];
        }
    }
    return out;
}

/// The darkest that the light leaves the side of a disk, and the line at its edge that.
constexpr double kDarkest = 0.54 * 0.62;

/// What moves is drawn with few sides and as tubes: that must not show. Whatever is drawn, two pixels beside a disk is
/// nothing and two pixels inside nobody else, and it is lit.
TEST_P(PaintTest, CoarseDisksDifferAtTheirEdgesAlone) {
    const std::vector<mobb::Placement> places{{}, {{1, -1}, 90, 0}};
    const auto agree = [&](const FittedScene& fitted, double pitch) {
        for (const double distance : {3.0, 12.0, 60.0}) {
            ViewState view;
            view.boxes = view.labels = view.floor = view.time_axis = false;
            view.camera.preset = CameraPreset::free;
            view.camera.pitch_deg = pitch;
            view.camera.target = glm::dvec3(0, 0, 1);
            view.camera.distance = distance;
            DrawList list = build_draw_list(fitted, view, PictureSize{160, 120});
            list.background = Rgba(0, 1, 0, 1);
            for (DiskInstance& disk : list.disks.edit()) {
                disk.color = disk.id.agent == 0 ? Rgba(1, 0, 0, 1) : Rgba(0, 0, 1, 1);
            }
            const std::vector<int> who = seen_around(list, 2, [](const ObjectId& id) { return id.agent + 1; });
            for (const int samples : {1, kPictureSamples}) {
                const Image image = renderer().draw(list, samples);
                int wrong = 0;
                for (std::size_t i = 0; i < who.size(); ++i) {
                    if (who[i] == kEdge) continue;
                    const std::uint8_t* p = image.rgba.data() + 4 * i;
                    const int dark = static_cast<int>(255 * kDarkest) - 1;
                    const bool nothing = p[0] == 0 && p[1] == 255 && p[2] == 0;
                    const bool first = p[0] >= dark && p[1] == 0 && p[2] == 0;
                    const bool second = p[0] == 0 && p[1] == 0 && p[2] >= dark;
                    wrong += !(who[i] == 0 ? nothing : who[i] == 1 ? first : second);
                }
                EXPECT_EQ(wrong, 0) << list.disks.size() << " disks from " << distance << " m, " << pitch
                                    << " degrees, samples: " << samples;
            }
        }
    };
    agree(testing::hit_scene(), ViewState{}.camera.pitch_deg);
    // Those that run lean far between samples, or hardly: then they join up.
    for (const double pitch : {-40.0, 25.0, 90.0}) {
        agree({testing::running_scene(places), {}}, pitch);
        agree({testing::running_scene(places, 300, 1 / 120.0), {}}, pitch);
    }
}

/// Disks that follow one another leave out what they hide of each other; those of which every other is missing do not.
/// The rest of a face is cut into other triangles, whose edges are rounded otherwise: within a disk nothing differs.
TEST_P(PaintTest, WhatDisksHideOfEachOtherIsLeftOutWithoutATrace) {
    for (const double pitch : {-70.0, -15.0, 4.0, 30.0, 90.0}) {
        // So near that all disks are drawn one by one, in both pictures.
        for (const double distance : {10.0, 14.0, 30.0}) {
            ViewState view;
            view.camera.preset = CameraPreset::free;
            view.camera.pitch_deg = pitch;
            view.camera.target = glm::dvec3(0, 0, 1);
            view.camera.distance = distance;
            view.camera.perspective = distance < 14;
            for (const bool running : {false, true}) {
                DrawList list = build_draw_list(
                    running ? FittedScene(testing::running_scene({{}, {{0, 1.1}, 0, 0}}), {}) : testing::miss_scene(),
                    view, kSmallSize);
                const Image left_out = renderer().draw(list);
                for (DiskInstance& disk : list.disks.edit()) disk.id.index *= 2;
                const Image all = renderer().draw(list);
                list.boxes.clear();
                const std::vector<int> which =
                    seen_around(list, 1, [](const ObjectId& id) { return 1 + id.index + 100'000 * id.agent; });
                int wrong = 0;
                for (std::size_t i = 0; i < 4 * which.size(); ++i) {
                    wrong += which[i / 4] != kEdge && std::abs(all.rgba[i] - left_out.rgba[i]) > 2;
                }
                EXPECT_EQ(wrong, 0) << pitch << " degrees, " << distance << " m" << (running ? ", running" : "");
            }
        }
    }
}

/// So many boxes, each this far from the one before.
DrawList with_boxes(DrawList list, std::size_t count, glm::vec3 apart, bool edges) {
    BoxInstance box = list.boxes.front();
    box.fill.a = 0;
    if (!edges) box.edge.a = 0;
    for (std::size_t i = 0; i < count; ++i) {
        box.center += apart;
        list.boxes.push_back(box);
    }
    return list;
}

constexpr std::size_t kEdgeTriangles = 2 * 24;  // of a box: before and behind the disks

TEST_P(PaintTest, BoxesBesideThePictureAreLeftOutWithoutATrace) {
    const DrawList list = everything();
    const auto triangles = [&](bool edges) {
        const DrawList more = with_boxes(list, 4000, list.projection.right, edges);
        static_cast<void>(renderer().draw(more));
        return renderer().statistics().triangles;
    };
    const std::size_t without = triangles(false);
    EXPECT_LT(triangles(true), without + 100 * kEdgeTriangles);
    DrawList boxes = list;
    boxes.boxes.clear();
    const Image nothing = renderer().draw(boxes);
    for (const float far : {3.0f, 10.0f, 100.0f}) {
        boxes = with_boxes(list, 1, far * list.projection.right, true);
        boxes.boxes.erase(boxes.boxes.begin(), boxes.boxes.end() - 1);
        const bool is_seen = std::ranges::any_of(box_corners(boxes.boxes.front()), [&](glm::vec3 corner) {
            return list.projection.project(corner)->x < static_cast<float>(list.size.width + 1);  // lines are wide
        });
        EXPECT_EQ(renderer().draw(boxes).rgba != nothing.rgba, is_seen) << far;
    }
}

TEST_P(PaintTest, OfManyBoxesACoarsePictureHasTheEdgesOfSome) {
    const DrawList list = everything();
    const glm::vec3 hardly = list.projection.up * 1e-4f;
    const auto coarse = [&](bool edges) { return renderer().draw_coarse(with_boxes(list, 5000, hardly, edges), 4); };
    const Image without = coarse(false);
    const std::size_t triangles = renderer().statistics().triangles;
    EXPECT_NE(coarse(true).rgba, without.rgba);
    EXPECT_GT(renderer().statistics().triangles, triangles + 500 * kEdgeTriangles);
    EXPECT_LE(renderer().statistics().triangles, triangles + 1000 * kEdgeTriangles);
    static_cast<void>(renderer().draw(with_boxes(list, 5000, hardly, true)));
    EXPECT_GE(renderer().statistics().triangles, 5000 * kEdgeTriangles) << "a fine one has all";
}

/// A clock by which each part of a picture takes longer than there is time for.
PaintPace one_part() {
    static double now = 0;
    static const std::function<double()> hurries = [] { return now += 1; };
    return {hurries, 0.5};
}

TEST_P(PaintTest, APictureThatIsPaintedInPartsIsTheSame) {
    const DrawList list = everything();
    const Image drawn = renderer().draw(list);
    for (const std::string then : {"go on", "something else between", "go on"}) {
        renderer().begin_paint(list, kPictureSamples);
        int parts = 1;
        const Texture* painted = nullptr;
        for (; !(painted = renderer().paint_more(list, one_part())); ++parts) {
            ASSERT_LT(parts, 1000);
            if (parts != 2 || then == "go on") continue;
            const DrawList other = build_draw_list(testing::miss_scene(), ViewState{}, kSmallSize);
            renderer().paint_coarse(other, 2);
            EXPECT_FALSE(renderer().is_painting(list)) << "another picture ends it";
            renderer().begin_paint(list, kPictureSamples);
        }
        EXPECT_GE(parts, 3) << then;
        EXPECT_EQ(pixels_of(*painted, kSmallSize), drawn.rgba) << then;
        EXPECT_TRUE(renderer().has_scene(list, kPictureSamples));
    }
}

/// Whether all of a picture within so many pixels of one has its colour.
bool is_even(const Image& image, int x, int y, int reach) {
    if (x < reach || y < reach || x + reach >= image.width || y + reach >= image.height) return false;
    const auto* middle = image.at(x, y);
    for (int v = y - reach; v <= y + reach; ++v) {
        for (int u = x - reach; u <= x + reach; ++u) {
            if (!std::equal(middle, middle + 3, image.at(u, v))) return false;
        }
    }
    return true;
}

TEST_P(PaintTest, ACoarsePictureHasEverythingWhereTheFineOneHasIt) {
    const DrawList list = everything();
    const Image fine = renderer().draw(list);
    EXPECT_EQ(pixels_of(renderer().paint_coarse(list, 1), kSmallSize),
              pixels_of(renderer().paint(list, 1), kSmallSize));
    const Image single = renderer().draw(list, 1);
    DrawList narrow = list;
    narrow.disks.edit().clear();
    narrow.boxes.clear();
    const auto lines_and_words = pixels_of(renderer().paint(narrow, 1), kSmallSize);
    for (const int divisor : {2, 3, 4}) {
        EXPECT_EQ(pixels_of(renderer().paint_coarse(narrow, divisor), kSmallSize), lines_and_words) << "on all pixels";
        Image coarse(kSmallSize.width, kSmallSize.height);
        coarse.rgba = pixels_of(renderer().paint_coarse(list, divisor), kSmallSize);
        EXPECT_NE(coarse.rgba, fine.rgba);
        int even = 0, wrong = 0;
        for (int y = 0; y < fine.height; ++y) {
            for (int x = 0; x < fine.width; ++x) {
                if (!is_even(fine, x, y, divisor + 1)) continue;
                ++even;
                wrong += !std::equal(coarse.at(x, y), coarse.at(x, y) + 4, single.at(x, y));
            }
        }
        EXPECT_GT(even, 10'000) << "ground, panels, faces of boxes and of disks";
        EXPECT_EQ(wrong, 0) << divisor;
        // The words are on all pixels.
        const Rect words = list.texts.front().box;
        int differing = 0;
        for (int y = static_cast<int>(words.min.y); y < static_cast<int>(words.max.y); ++y) {
            const int x = static_cast<int>(words.min.x);
            const auto* row = coarse.at(x, y);
            differing += !std::equal(row, row + 4 * static_cast<int>(words.size().x), fine.at(x, y));
        }
        EXPECT_EQ(differing, 0) << divisor;
    }
    EXPECT_EQ(renderer().draw(list).rgba, fine.rgba) << "it leaves nothing behind";
}

TEST_P(PaintTest, TheNumberOfSamplesMayChange) {
    const DrawList list = everything();
    const auto single = pixels_of(renderer().paint(list, 1), kSmallSize);
    EXPECT_EQ(renderer().draw(list).rgba, fresh(list).rgba);
    EXPECT_EQ(pixels_of(renderer().paint(list, 1), kSmallSize), single);
}

TEST_P(PaintTest, AContextMayBeGiven) {
    const DrawList list = everything();
    Renderer given(GlContext::open(GetParam()));
    EXPECT_EQ(given.draw(list).rgba, renderer().draw(list).rgba);
    EXPECT_EQ(given.backend(), testing::name_of(GetParam()));
    EXPECT_EQ(given.context().name(), given.backend());
}

/// Whether EGL has a GPU is the machine's.
TEST(Paint, OsmesaIsSoftware) {
    const auto renderer = testing::open_or_skip(Backend::osmesa);
    EXPECT_TRUE(!renderer || renderer->context().policy().coarse_first);
}

/// What others that draw in the same context leave behind.
struct Mischief {
    const char* name;
    std::function<void()> make;
};

const std::vector<Mischief>& mischiefs() {
    static const std::vector<Mischief> all{
        {"scissor", [] { glEnable(GL_SCISSOR_TEST), glScissor(3, 3, 5, 5); }},
        {"stencil", [] { glEnable(GL_STENCIL_TEST), glStencilFunc(GL_NEVER, 0, 0); }},
        {"viewport", [] { glViewport(1, 2, 30, 40); }},
        {"blending", [] { glEnable(GL_BLEND), glBlendFunc(GL_ONE, GL_ONE); }},
        {"blend equation", [] { glBlendEquation(GL_FUNC_REVERSE_SUBTRACT); }},
        {"culling", [] { glEnable(GL_CULL_FACE), glCullFace(GL_FRONT_AND_BACK); }},
        {"winding", [] { glFrontFace(GL_CW); }},
        {"depth", [] { glEnable(GL_DEPTH_TEST), glDepthFunc(GL_NEVER), glDepthMask(GL_FALSE); }},
        {"depth range", [] { glDepthRange(1, 0), glEnable(GL_DEPTH_CLAMP); }},
        {"wireframe", [] { glPolygonMode(GL_FRONT_AND_BACK, GL_LINE); }},
        {"polygon offset", [] { glEnable(GL_POLYGON_OFFSET_FILL), glPolygonOffset(1000, 100000); }},
        {"colour mask", [] { glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE); }},
        {"logic op", [] { glEnable(GL_COLOR_LOGIC_OP), glLogicOp(GL_INVERT); }},
        {"no rasteriser", [] { glEnable(GL_RASTERIZER_DISCARD); }},
        {"coverage", [] { glEnable(GL_SAMPLE_COVERAGE), glSampleCoverage(0.25f, GL_FALSE); }},
        {"first vertex", [] { glProvokingVertex(GL_FIRST_VERTEX_CONVENTION); }},
        {"packing", [] { glPixelStorei(GL_PACK_ALIGNMENT, 8), glPixelStorei(GL_PACK_ROW_LENGTH, 1000); }},
        {"unpacking", [] { glPixelStorei(GL_UNPACK_ALIGNMENT, 8), glPixelStorei(GL_UNPACK_SKIP_PIXELS, 3); }},
        {"no program", [] { glUseProgram(0), glBindVertexArray(0), glBindBuffer(GL_ARRAY_BUFFER, 0); }},
        {"texture unit", [] { glActiveTexture(GL_TEXTURE5); }},
        {"no textures",
         [] {
             for (GLenum unit = 0; unit < 2; ++unit) {
                 glActiveTexture(GL_TEXTURE0 + unit);
                 glBindTexture(GL_TEXTURE_2D, 0);
             }
         }},
    };
    return all;
}

TEST_P(PaintTest, WhatOthersLeaveInTheContextChangesNothing) {
    const DrawList list = everything();
    const Image expected = renderer().draw(list);
    const auto single = pixels_of(renderer().paint(list, 1), kSmallSize);
    const IdImage ids = renderer().draw_ids(list);
    for (const Mischief& mischief : mischiefs()) {
        // Each on a renderer of its own: what one hides, another must not.
        Renderer disturbed(GetParam());
        disturbed.draw(list);
        mischief.make();
        EXPECT_EQ(disturbed.draw(list).rgba, expected.rgba) << mischief.name;
        mischief.make();
        EXPECT_EQ(pixels_of(disturbed.paint(list, 1), kSmallSize), single) << mischief.name;
        mischief.make();
        EXPECT_EQ(disturbed.draw_ids(list).rg, ids.rg) << mischief.name;
    }
}

TEST_P(PaintTest, WhatIsKeptFollowsTheList) {
    DrawList list = everything();
    ASSERT_FALSE(list.disks.empty());
    ASSERT_FALSE(list.boxes.empty());
    ASSERT_FALSE(list.lines.empty());
    ASSERT_FALSE(list.texts.empty());
    ASSERT_FALSE(list.panels.empty());
    Image before = renderer().draw(list);
    const auto changed = [&](const char* what) {
        const Image after = renderer().draw(list);
        EXPECT_NE(after.rgba, before.rgba) << what << " changes nothing that is seen";
        EXPECT_EQ(after.rgba, fresh(list).rgba) << what;
        before = after;
    };
    for (DiskInstance& disk : list.disks.edit()) disk.radius *= 1.5f;
    changed("radius");
    for (DiskInstance& disk : list.disks.edit()) disk.top_radius *= 1.2f;
    changed("radius above");
    for (DiskInstance& disk : list.disks.edit()) disk.top.x += 0.1f;
    changed("lean");
    list.disks.edit().back().color = {1, 0, 1, 1};
    changed("colour of a disk");
    list.disks.edit().pop_back();
    changed("a disk less");
    list.boxes.front().fill.a = 0.5f;
    changed("face of a box");
    list.boxes.front().width = 6;
    changed("edge of a box");
    list.boxes.pop_back();
    changed("a box less");
    list.lines.front().color = {1, 1, 0, 1};
    list.lines.front().width = 9;
    changed("line");
    list.texts.front().text[0] = 'Q';
    changed("text");
    list.panels.front().fill = {0, 1, 0, 1};
    changed("panel");
    list.disks.edit().clear();
    list.boxes.clear();
    list.lines.clear();
    changed("nothing left");
}

INSTANTIATE_TEST_SUITE_P(All, PaintTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

}  // namespace
}  // namespace mobbscope
