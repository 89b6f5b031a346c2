/// Tests that run on every backend.
#pragma once

#include <base/error.h>
#include <render/gl/renderer.h>

#include <glad/gl.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

inline std::string name_of(Backend backend) {
    return backend == Backend::osmesa ? "osmesa" : backend == Backend::egl ? "egl" : "auto";
}

/// Whether MOBBSCOPE_REQUIRE_GL, such as "osmesa,egl", says that the machine has this backend. Any that it names is one
/// that `auto` finds.
inline bool required(Backend backend) {
    const char* value = std::getenv("MOBBSCOPE_REQUIRE_GL");
    if (!value) return false;
    if (backend == Backend::automatic) return *value != '\0';
    return ("," + std::string(value) + ",").find("," + name_of(backend) + ",") != std::string::npos;
}

/// Null where the machine lacks the backend; then the test is skipped with the reason, or failed if it is required.
inline std::unique_ptr<Renderer> open_or_skip(Backend backend) {
    try {
        return std::make_unique<Renderer>(backend);
    } catch (const MachineError& error) {
        [&] {
            if (required(backend)) FAIL() << "required by MOBBSCOPE_REQUIRE_GL: " << error.what();
            GTEST_SKIP() << error.what();
        }();
        return nullptr;
    }
}

/// The same where others draw with it: it is opened once a process.
inline bool has_or_skip(Backend backend) {
    static std::set<Backend> found;
    if (!found.contains(backend) && open_or_skip(backend)) found.insert(backend);
    return found.contains(backend);
}

/// A texture's pixels, rows from top to bottom.
inline std::vector<std::uint8_t> pixels_of(const Texture& texture, PictureSize size) {
    const std::size_t row = 4 * static_cast<std::size_t>(size.width);
    std::vector<std::uint8_t> upwards(row * static_cast<std::size_t>(size.height));
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
    std::vector<std::uint8_t> out;
    for (std::size_t y = static_cast<std::size_t>(size.height); y-- > 0;) {
        const auto begin = upwards.begin() + static_cast<std::ptrdiff_t>(y * row);
        out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
    }
    return out;
}

/// Runs once for each backend; see open_or_skip.
class OnEachBackend : public ::testing::TestWithParam<Backend> {
  protected:
    void SetUp() override { renderer_ = open_or_skip(GetParam()); }
    Renderer& renderer() { return *renderer_; }

  private:
    std::unique_ptr<Renderer> renderer_;
};

inline std::string backend_name(const ::testing::TestParamInfo<Backend>& info) { return name_of(info.param); }

}  // namespace testing
}  // namespace mobbscope
