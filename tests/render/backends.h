/// Tests that run on every backend.
#pragma once

#include <import/error.h>
#include <render/renderer.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mobbscope::testing {

/// Runs once for each backend; skips with the reason where the machine lacks it.
class OnEachBackend : public ::testing::TestWithParam<Backend> {
  protected:
    void SetUp() override {
        try {
            renderer_ = std::make_unique<Renderer>(GetParam());
        } catch (const MachineError& error) {
            GTEST_SKIP() << error.what();
        }
    }
    Renderer& renderer() { return *renderer_; }

  private:
    std::unique_ptr<Renderer> renderer_;
};

inline std::string backend_name(const ::testing::TestParamInfo<Backend>& info) {
    return info.param == Backend::osmesa ? "osmesa" : "egl";
}

}  // namespace mobbscope::testing
