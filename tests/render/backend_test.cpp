#include <render/gl/backends.h>
#include <render/gl/gl_objects.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/scenes.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

TEST(Backend, NamesAreThoseOfTheContract) {
    EXPECT_EQ(backend_from_name("auto"), Backend::automatic);
    EXPECT_EQ(backend_from_name("osmesa"), Backend::osmesa);
    EXPECT_EQ(backend_from_name("egl"), Backend::egl);
    EXPECT_FALSE(backend_from_name("glx"));
}

TEST(Backend, AMissingLibraryIsNamed) {
    try {
        const SharedLibrary library({"libnosuchthing.so.1", "libnosuchthing.so.2"});
        FAIL() << "opened a library that does not exist";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("libnosuchthing.so.1"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("libnosuchthing.so.2"), std::string::npos) << error.what();
    }
}

/// Shaders from Mesa's cache come without the compiler's remarks.
class BackendTest : public testing::OnEachBackend {
  protected:
    void SetUp() override {
        ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
        OnEachBackend::SetUp();
    }
    void TearDown() override { ::unsetenv("MESA_SHADER_CACHE_DISABLE"); }
};

TEST_P(BackendTest, AnErrorOfOpenGLIsThrown) {
    const auto context = GlContext::open(GetParam());
    EXPECT_NO_THROW(context->check("nothing"));
    glEnable(0xFFFF);
    EXPECT_THROW(context->check("a mistake"), MachineError);
    EXPECT_NO_THROW(context->check("nothing since"));
}

TEST_P(BackendTest, AnErrorThatNobodyTellsIsThrown) {
    const auto context = GlContext::open(GetParam());
    glDisable(GL_DEBUG_OUTPUT);
    glEnable(0xFFFF);
    EXPECT_THROW(context->check("a mistake"), MachineError);
    EXPECT_NO_THROW(context->check("nothing since"));
}

TEST_P(BackendTest, TheCompilerRemarksNothingOnOurShaders) {
    // Each program is compiled when it is first used.
    ViewState view;
    view.time = 1;
    const DrawList list = build_draw_list(testing::hit_scene(), view, PictureSize{320, 200});
    renderer().paint(list, 4);
    renderer().draw_ids(list);
    EXPECT_EQ(renderer().context().warnings(), std::vector<std::string>{});
}

constexpr std::string_view kVertex = "#version 330 core\nout vec4 c;\nvoid main() { c = gl_Position = vec4(0); }\n";
constexpr std::string_view kFragment = "#version 330 core\nin vec4 c;\nout vec4 o;\nvoid main() { o = c; }\n";

TEST_P(BackendTest, ShadersThatDoNotCompileOrLinkAreThrown) {
    const auto context = GlContext::open(GetParam());
    EXPECT_NO_THROW(ShaderProgram(*context, "good", kVertex, kFragment).use());
    const auto complaint = [&](std::string_view vertex, std::string_view fragment) -> std::string {
        try {
            ShaderProgram(*context, "bad", vertex, fragment).use();
        } catch (const MachineError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(complaint("#version 330 core\nvoid main() { nonsense }\n", kFragment).find("bad.vert"),
              std::string::npos);
    EXPECT_NE(complaint(kVertex, "#version 330 core\nvoid main() { nonsense }\n").find("bad.frag"), std::string::npos);
    // Each compiles, but they disagree on what is passed between them.
    EXPECT_NE(complaint(kVertex, "#version 330 core\nin vec2 c;\nout vec4 o;\nvoid main() { o = c.xyxy; }\n"), "");
}

TEST_P(BackendTest, WhatTheCompilerRemarksIsAWarning) {
    const auto context = GlContext::open(GetParam());
    // Mesa may have read its environment before; a text that is new is in no cache.
    const std::string text = "#version 330 core\nout vec4 o;\nvoid main() { float x; o = vec4(x) * " +
                             std::to_string(std::chrono::system_clock::now().time_since_epoch().count()) + ".0; }\n";
    ShaderProgram(*context, "odd", kVertex, text).use();
    EXPECT_FALSE(context->warnings().empty());
}

TEST_P(BackendTest, RenderersMayEndInAnyOrder) {
    const auto other = testing::open_or_skip(GetParam() == Backend::egl ? Backend::osmesa : Backend::egl);
    if (!other) return;
    { const Renderer passing(GetParam()); }
    const auto context = GlContext::open(GetParam());
    context->make_current();
    EXPECT_NO_THROW(context->check("after another has gone"));
}

TEST(Backend, RequiredOnesAreNamed) {
    const char* before = std::getenv("MOBBSCOPE_REQUIRE_GL");
    const std::string kept = before ? before : "";
    ::setenv("MOBBSCOPE_REQUIRE_GL", "egl", 1);
    EXPECT_TRUE(testing::required(Backend::egl));
    EXPECT_TRUE(testing::required(Backend::automatic));
    EXPECT_FALSE(testing::required(Backend::osmesa));
    ::setenv("MOBBSCOPE_REQUIRE_GL", "", 1);
    EXPECT_FALSE(testing::required(Backend::egl));
    EXPECT_FALSE(testing::required(Backend::automatic));
    ::setenv("MOBBSCOPE_REQUIRE_GL", kept.c_str(), 1);
}

TEST_P(BackendTest, TheContextIsCoreAndReportsErrors) {
    const auto context = GlContext::open(GetParam());
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_TRUE(GLAD_GL_KHR_debug);
    GLint flags = 0;
    glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
    // OSMesa has no way to ask for it.
    if (GetParam() == Backend::egl) {
        EXPECT_TRUE(flags & GL_CONTEXT_FLAG_DEBUG_BIT);
    }
}

INSTANTIATE_TEST_SUITE_P(All, BackendTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

}  // namespace
}  // namespace mobbscope
