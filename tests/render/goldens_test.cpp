// Pictures against those in tests/goldens; see the README there.
#include <render/image_diff.h>
#include <render/png.h>
#include <render/render.h>
#include <scene/scene.h>

#include "render/backends.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <tuple>

namespace mobbscope {
namespace {

constexpr PictureSize kSize{640, 360};

const std::filesystem::path kGoldens = std::filesystem::path(MOBBSCOPE_SOURCE_DIR) / "tests" / "goldens";
const std::filesystem::path kOutput = MOBBSCOPE_GOLDEN_OUTPUT;

bool updating() {
    const char* value = std::getenv("MOBBSCOPE_UPDATE_GOLDENS");
    return value && std::string(value) == "1";
}

class GoldenTest : public ::testing::TestWithParam<std::tuple<const char*, Backend>> {};

TEST_P(GoldenTest, Matches) {
    const auto [name, backend] = GetParam();
    const std::unique_ptr<Renderer> renderer = testing::open_or_skip(backend);
    if (!renderer) return;
    // One backend makes the goldens, so that the other is held against it.
    if (updating() && backend != Backend::osmesa) GTEST_SKIP() << "goldens are made with osmesa";

    Scene scene = load_scene(kGoldens / (std::string(name) + ".json"));
    const ViewState view = scene.view;
    const mobb::FitOptions options = scene.fit;
    const Image actual = render(FittedScene(std::move(scene), options), view, kSize, *renderer);
    const std::filesystem::path golden = kGoldens / (std::string(name) + ".png");
    if (updating()) {
        write_png(golden, actual);
        GTEST_SKIP() << "wrote " << golden.string() << "; look at it";
    }

    const std::string stem = std::string(name) + "." + std::string(renderer->backend());
    const auto keep = [&](const char* what, const Image& image) {
        std::filesystem::create_directories(kOutput);
        const std::filesystem::path file = kOutput / (stem + "." + what + ".png");
        write_png(file, image);
        return file.string();
    };
    if (!std::filesystem::exists(golden)) {
        FAIL() << "missing golden: there is no " << golden.string() << "; the picture is " << keep("actual", actual)
               << "; MOBBSCOPE_UPDATE_GOLDENS=1 takes it";
    }
    const Image reference = read_png(golden);
    const ImageDiff result = diff(actual, reference);
    if (result.same) return;
    const std::string kept = keep("actual", actual) + ", " + keep("golden", reference);
    ASSERT_TRUE(result.same_size) << "different picture: the golden is " << reference.width << "x" << reference.height
                                  << "; see " << kept;
    FAIL() << "different picture: " << result.differing << " of " << result.pixels << " pixels differ, by up to "
           << result.largest << "/255; see " << kept << ", " << keep("heat", result.heat);
}

INSTANTIATE_TEST_SUITE_P(All, GoldenTest,
                         ::testing::Combine(::testing::Values("disk_stack", "mobb_level", "umobb_level", "query_step"),
                                            ::testing::Values(Backend::osmesa, Backend::egl)),
                         [](const auto& tested) {
                             return std::string(std::get<0>(tested.param)) + "_" +
                                    testing::name_of(std::get<1>(tested.param));
                         });

}  // namespace
}  // namespace mobbscope
