// How pictures are asked of a GPU, and how of a processor. No machine has both: each is what its context claims to be.
#include <render/gl/drawing_policy.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/counting_context.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

TEST(DrawingPolicy, AProcessorIsKnownByItsName) {
    for (const char* device : {kProcessor, "softpipe", "Software Rasterizer", "GDI Generic", "Google SwiftShader",
                               "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device))"}) {
        const DrawingPolicy policy = DrawingPolicy::of(device);
        EXPECT_TRUE(policy.coarse_first && policy.slices && policy.finishes) << device;
        EXPECT_LT(policy.most_sides, std::size_t{1} << 20) << device;
    }
    for (const char* device : {kGraphicsCard, "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "virgl (AMD Radeon RX 6600)",
                               "AMD Radeon Graphics (radeonsi, renoir, LLVM 15.0.6, DRM 3.49)", "Apple M1", ""}) {
        const DrawingPolicy policy = DrawingPolicy::of(device);
        EXPECT_FALSE(policy.coarse_first || policy.slices || policy.finishes) << device;
        EXPECT_GT(policy.most_sides, std::size_t{1} << 40) << device;
    }
}

/// Of so many sides that a processor is given them in parts.
DrawList many_disks() {
    DrawList list = build_draw_list(testing::hit_scene(), ViewState{}, kSmallSize);
    std::vector<DiskInstance>& disks = list.disks.edit();
    for (std::size_t i = 0; disks.size() < 15'000; ++i) {
        disks.push_back(disks[i]);
        disks.back().id.index = static_cast<int>(disks.size());
    }
    return list;
}

/// The time is over when a part is drawn.
PaintPace no_time() {
    static const std::function<double()> stands = [] { return 0.0; };
    return {stands, 0};
}

class DrawingPolicyTest : public ::testing::TestWithParam<Backend> {
  protected:
    void SetUp() override {
        if (!testing::has_or_skip(GetParam())) GTEST_SKIP();
    }
    Renderer as(const char* device) const {
        return Renderer(std::make_unique<CountingContext>(GlContext::open(GetParam()), device));
    }
    const DrawList list_ = build_draw_list(testing::hit_scene(), ViewState{}, kSmallSize);
};

TEST_P(DrawingPolicyTest, AGraphicsCardDrawsAPictureInOnePassAndNobodyWaits) {
    Renderer renderer = as(kGraphicsCard);
    for (int i = 1; i <= 3; ++i) {
        DrawList list = i == 3 ? many_disks() : list_;
        list.disks.edit().front().radius += 0.01f * static_cast<float>(i);
        CountingContext::counts = {};
        renderer.begin_paint(list, kPictureSamples);
        ASSERT_TRUE(renderer.paint_more(list, no_time())) << "in one part, however little time there is";
        renderer.wait();
        EXPECT_EQ(CountingContext::counts.finishes, 0u);
        EXPECT_EQ(CountingContext::counts.whole, 1u);
        EXPECT_EQ(CountingContext::counts.disk_calls, 1u);
    }
    renderer.paint_coarse(list_, 2);
    renderer.draw(list_);
    EXPECT_EQ(CountingContext::counts.finishes, 0u);
}

TEST_P(DrawingPolicyTest, AProcessorDrawsItInSlicesAndIsWaitedFor) {
    Renderer renderer = as(kProcessor);
    renderer.begin_paint(list_, kPictureSamples);
    std::size_t slices = 1;
    const Texture* painted = nullptr;
    while (!(painted = renderer.paint_more(list_, no_time()))) {
        EXPECT_GE(CountingContext::counts.finishes, slices) << "each is waited for";
        ASSERT_LT(++slices, 100u);
    }
    EXPECT_GT(slices, 5u);
    EXPECT_EQ(CountingContext::counts.whole, 1u);
    const auto in_slices = pixels_of(*painted, kSmallSize);
    Renderer card = as(kGraphicsCard);
    EXPECT_EQ(pixels_of(card.paint(list_, kPictureSamples), kSmallSize), in_slices) << "it is the same picture";
}

/// Most processes that draw draw one picture.
TEST_P(DrawingPolicyTest, APictureTakesTheProgramsAndTexturesThatItNeeds) {
    Renderer renderer = as(kProcessor);
    EXPECT_EQ(CountingContext::counts.programs, 0u);
    DrawList few = list_;
    few.boxes = {};
    renderer.draw(few);
    EXPECT_EQ(CountingContext::counts.programs, 4u) << "disks, lines, samples, words";
    EXPECT_EQ(CountingContext::counts.textures, 2u) << "colour and depth";
    renderer.draw(list_);
    EXPECT_EQ(CountingContext::counts.programs, 8u) << "faces: begun, summed, blended; colours of disks";
    EXPECT_EQ(CountingContext::counts.textures, 3u) << "which disks are seen, as the picture before had the same";
    renderer.paint(list_, kPictureSamples);
    EXPECT_EQ(CountingContext::counts.programs, 8u);
    EXPECT_EQ(CountingContext::counts.textures, 3u);
}

TEST_P(DrawingPolicyTest, WhatAProcessorKeepsForADrawCallDoesNotPileUp) {
    Renderer renderer = as(kProcessor);
    renderer.paint(many_disks(), kPictureSamples);
    EXPECT_GT(CountingContext::counts.disk_calls, 1u);
    EXPECT_EQ(CountingContext::counts.finishes, CountingContext::counts.disk_calls - 1);
}

TEST_P(DrawingPolicyTest, ErrorsAreToldAtOnceWhereThatIsAskedFor) {
    const char* before = std::getenv("MOBBSCOPE_GL_DEBUG");
    const std::string kept = before ? before : "";
    for (const bool asked : {true, false}) {
        asked ? ::setenv("MOBBSCOPE_GL_DEBUG", "1", 1) : ::unsetenv("MOBBSCOPE_GL_DEBUG");
        Renderer renderer = as(kGraphicsCard);
        EXPECT_EQ(CountingContext::counts.errors_at_once, asked);
        EXPECT_NO_THROW(renderer.context().check("nothing"));
        glEnable(0xFFFF);
        EXPECT_THROW(renderer.context().check("a mistake"), MachineError) << "an error is one either way";
        EXPECT_NO_THROW(renderer.context().check("nothing since"));
        renderer.context().complain("later than its number");
        EXPECT_THROW(renderer.context().check("a late word"), MachineError) << "what the driver says is told once";
        EXPECT_NO_THROW(renderer.context().check("nothing since"));
    }
    if (before) ::setenv("MOBBSCOPE_GL_DEBUG", kept.c_str(), 1);
}

TEST_P(DrawingPolicyTest, WhereMemoryLacksAPictureHasOneSampleAndSaysSo) {
    Renderer renderer = as(kGraphicsCard);
    const auto single = pixels_of(renderer.paint(list_, 1), kSmallSize);
    const auto smooth = pixels_of(renderer.paint(list_, kPictureSamples), kSmallSize);
    ASSERT_NE(smooth, single);
    EXPECT_EQ(renderer.notice(), "");

    DrawList wide = list_;
    wide.size.width = wide.projection.size.width = 2 * kSmallSize.width;
    const auto wide_single = pixels_of(renderer.paint(wide, 1), wide.size);
    CountingContext::lacks_memory = true;
    EXPECT_EQ(pixels_of(renderer.paint(wide, kPictureSamples), wide.size), wide_single);
    EXPECT_EQ(renderer.notice(), "this OpenGL (" + testing::name_of(GetParam()) +
                                     ") lacks memory for 4 samples of each pixel: edges are less smooth");
    EXPECT_TRUE(renderer.has_disks(wide, kPictureSamples)) << "it is not tried again for each picture";
    EXPECT_EQ(pixels_of(renderer.paint_highlights(wide, kPictureSamples), wide.size), wide_single);
    // What is written has what was asked for, or is not written.
    const auto why_not = [&]() -> std::string {
        try {
            renderer.draw(wide);
        } catch (const MachineError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(why_not(), "this OpenGL (" + testing::name_of(GetParam()) +
                             ") lacks memory for 4 samples of each pixel: take fewer, or make the picture smaller");
    CountingContext::lacks_memory = false;
    EXPECT_EQ(why_not(), "");
    EXPECT_EQ(pixels_of(renderer.paint(list_, kPictureSamples), kSmallSize), smooth);
}

INSTANTIATE_TEST_SUITE_P(All, DrawingPolicyTest, ::testing::Values(Backend::osmesa, Backend::egl),
                         testing::backend_name);

}  // namespace
}  // namespace mobbscope
