#include <render/gl_context.h>
#include <render/shared_library.h>

#include "render/backends.h"

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <stdexcept>

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

class BackendTest : public testing::OnEachBackend {};

TEST_P(BackendTest, AnErrorOfOpenGLIsThrown) {
    const auto context = GlContext::open(GetParam());
    EXPECT_NO_THROW(context->check("nothing"));
    glEnable(0xFFFF);
    EXPECT_THROW(context->check("a mistake"), MachineError);
    EXPECT_NO_THROW(context->check("nothing since"));
}

TEST_P(BackendTest, TheContextIsCoreAndReportsErrors) {
    const auto context = GlContext::open(GetParam());
    GLint profile = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_TRUE(GLAD_GL_KHR_debug);
}

INSTANTIATE_TEST_SUITE_P(All, BackendTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

}  // namespace
}  // namespace mobbscope
