/// The scene that a case draws.
#pragma once

#include <base/error.h>
#include <base/json.h>
#include <cases/case_file.h>
#include <mobb/fit.h>
#include <scene/scene.h>
#include <scene/view_state.h>

#include <filesystem>
#include <stdexcept>

namespace mobbscope::picture_tests {

/// What is read because of a place, or what is wrong with it, at that place.
template <class Read>
auto read_at(const JsonPlace& place, const Read& read) {
    try {
        return read();
    } catch (const InputError& error) {
        place.fail(error.what());
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
}

/// A file that a case names. Throws InputError if it is none that could be.
std::filesystem::path read_path(const JsonPlace& place, const std::filesystem::path& folder);

/// What `view` and `fit` of an object say, over what is so already.
struct FitAndView {
    mobb::FitOptions fit;
    ViewState view;

    /// Throws InputError.
    FitAndView over(const JsonPlace& place) const;
};

/// The file, which is the case's own where the scene stands in it, the scene, and how the case sees that. A scene that
/// stands in a case has no name: its file is the folder, "cases/".
struct CaseScene {
    std::filesystem::path file;
    Scene scene;
    FitAndView seen;
};

/// Of an object with `scene`, `fit` and `view`; `folder`: what file names are relative to. Throws InputError.
CaseScene read_case_scene(const JsonPlace& place, const std::filesystem::path& folder);

/// The scene as the case sees it, or as the first of its panels does. Throws InputError.
Scene scene_of(const CaseFile& file);

}  // namespace mobbscope::picture_tests
