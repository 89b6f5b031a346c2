// OSMesa and EGL draw the same picture of a case.
#include <picture_tests/run_cases.h>
#include <picture_tests/test_case.h>
#include <render/image/png.h>
#include <support/folders.h>

#include "render/backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>

namespace mobbscope::picture_tests {
namespace {

/// Null where the machine lacks the backend; then the test is skipped, or failed.
std::unique_ptr<PictureMaker> maker_or_skip(Backend backend) {
    return mobbscope::testing::has_or_skip(backend) ? std::make_unique<PictureMaker>(backend) : nullptr;
}

class BackendsAgreeTest : public ::testing::TestWithParam<const char*> {};

TEST_P(BackendsAgreeTest, OnEveryCase) {
    const std::unique_ptr<PictureMaker> osmesa = maker_or_skip(Backend::osmesa);
    const std::unique_ptr<PictureMaker> egl = osmesa ? maker_or_skip(Backend::egl) : nullptr;
    if (!egl) return;
    for (const CaseFile& file : find_cases(kSource / GetParam())) {
        const Case tested = read_case(file.file);
        if (tested.terms.skip || !tested.terms.holds(Held::picture)) continue;
        CaseResult result;
        result.file = file;
        const auto [by_egl, egl_state] = egl->make(tested.shot);
        const auto [by_osmesa, osmesa_state] = osmesa->make(tested.shot);
        EXPECT_EQ(egl_state, osmesa_state) << file.name;
        result.image = diff(by_egl, by_osmesa, tested.terms.diff);
        if (result.image->passes) continue;
        result.outcome = CaseOutcome::different;
        result.actual = png_bytes(by_egl);
        result.golden = png_bytes(by_osmesa);
        keep_pictures(result, MOBBSCOPE_KEPT_PICTURES);
        ADD_FAILURE() << file.name << ": " << result.image->differing << " pixels differ, by up to "
                      << result.image->largest << "/255; see " MOBBSCOPE_KEPT_PICTURES;
    }
}

std::string name_of(const ::testing::TestParamInfo<const char*>& folder) {
    std::string name = folder.param;
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
}

// Those of tests/app/goldens are many: pictures.window.osmesa and pictures.window.egl hold each to its golden.
INSTANTIATE_TEST_SUITE_P(Folders, BackendsAgreeTest, ::testing::Values("tests/goldens", "assets/figures"), name_of);

}  // namespace
}  // namespace mobbscope::picture_tests
