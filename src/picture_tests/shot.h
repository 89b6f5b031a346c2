/// A picture described in full: what is drawn, of which scene, and how. The body of a test case.
///
///     {"scene": "../scenes/crossing.json",   a scene or clip file, relative to this one; or the scene itself, {...}
///      "fit": {"tree": "umobb"},             over the scene's, key by key
///      "view": {"levels": 1, "query": null}, over the scene's, key by key; null takes a query or a time out
///      "panels": [{"title": "root", "view": {"levels": 0}, "fit": {}}, ...],   side by side, each over the above
///      "columns": 3,                         of the panels; default: all in one row
///      "select": "A:node:3",                 what is highlighted in each panel, as `render --select`; not of a window
///      "size": "640x360", "scale": 1, "samples": 4, "background": "transparent",   as the options of `render`
///      "window": {"script": "why.script", "scale": 1}}      the whole window after a script; no panels then
///
/// File names in the script are relative to the folder of the scene.
///
/// Only `scene` is required.
#pragma once

#include <app/script/script.h>
#include <base/json.h>
#include <render/drawlist/picture_options.h>
#include <render/parts/highlights.h>
#include <scene/fitted_scene.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// One view of the scene. Panels with the same camera, where it frames the scene by itself, share one that sees all of
/// them, so that what differs between them is what is drawn.
struct PicturePanel {
    std::string title;  ///< above it; empty where there is only one
    std::shared_ptr<const FittedScene> fitted;
    ViewState view;
    std::optional<int> query{};  ///< that the case itself names; whether there is one is not checked
};

/// The whole window, after a script has worked it.
struct WindowShot {
    std::optional<app::Script> script;
    double scale = 1;  ///< of text and panels, app::kLeastUiScale..kMostScale
};

struct Shot {
    std::filesystem::path file;  ///< of the case, for messages
    std::filesystem::path scene_file;
    std::vector<PicturePanel> panels;  ///< at least one
    int columns = 1;
    PictureOptions picture;
    std::optional<NamedPart> select;   ///< highlighted in each panel
    std::optional<WindowShot> window;  ///< then there is one panel
};

/// `folder`: what file names are relative to. Reads and checks the scene too. Throws InputError.
Shot read_shot(const JsonPlace& place, const std::filesystem::path& folder);

}  // namespace mobbscope::picture_tests
