#include <guard/panel_lists.h>

#include <import/error.h>
#include <render/build_draw_list.h>
#include <render/settle.h>
#include <render/sheet.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace mobbscope::guard {

namespace {

PictureSize panel_size(const Shot& shot) {
    if (shot.panels.size() == 1) return shot.picture.size;
    const bool titles =
        std::any_of(shot.panels.begin(), shot.panels.end(), [](const Panel& panel) { return !panel.title.empty(); });
    return cell_size(shot.picture.size, static_cast<int>(shot.panels.size()), shot.columns, titles,
                     metrics_of(shot.picture.size, shot.picture.scale));
}

/// Whether two views are looked at from one place, wherever the scene's size puts that.
bool seen_alike(const ViewState& a, const ViewState& b) {
    return !a.camera.target && a.camera == b.camera && a.show == b.show && a.time_height == b.time_height;
}

/// The height in metres of what a settled camera sees at its target, halved.
double reach(const Camera& camera) { return camera.distance * std::tan(0.5 * camera.fov_deg * std::numbers::pi / 180); }

/// A place to look from that does not depend on what is drawn.
struct Standpoint {
    Camera camera;
    double time_height = 0;
};

std::vector<DrawList> lists_of(const Shot& shot) {
    PictureOptions options = shot.picture;
    options.size = panel_size(shot);
    std::vector<DrawList> lists;
    for (const Panel& panel : shot.panels) {
        lists.push_back(build_draw_list(*panel.fitted, panel.view, options));
    }
    std::vector<Standpoint> from;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        from.push_back({settled(shot.panels[i].view.camera, lists[i]), lists[i].space.time_height});
    }
    for (std::size_t i = 0; i < lists.size(); ++i) {
        ViewState view = shot.panels[i].view;
        std::size_t widest = i;
        for (std::size_t j = 0; j < lists.size(); ++j) {
            if (seen_alike(view, shot.panels[j].view) && reach(from[j].camera) > reach(from[widest].camera)) widest = j;
        }
        if (widest == i) continue;
        view.camera = from[widest].camera;
        view.time_height = from[widest].time_height;
        lists[i] = build_draw_list(*shot.panels[i].fitted, view, options);
    }
    return lists;
}

}  // namespace

std::vector<DrawList> panel_lists(const Shot& shot) {
    try {
        return lists_of(shot);
    } catch (const std::invalid_argument& error) {
        throw InputError(shot.scene_file.string(), "", error.what());
    }
}

}  // namespace mobbscope::guard
