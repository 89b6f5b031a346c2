#include <picture_tests/panel_lists.h>

#include <base/error.h>
#include <render/layout/common_framing.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/sheet.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace mobbscope::picture_tests {

namespace {

PictureSize panel_size(const Shot& shot) {
    if (shot.panels.size() == 1) return shot.picture.size;
    const bool titles =
        std::any_of(shot.panels.begin(), shot.panels.end(), [](const Panel& panel) { return !panel.title.empty(); });
    return cell_size(shot.picture.size, static_cast<int>(shot.panels.size()), shot.columns, titles,
                     metrics_of(shot.picture.size, shot.picture.scale));
}

/// A panel and what it draws when it frames that by itself.
struct Alone {
    const ViewState& view;
    const DrawList& list;
};

/// Whether two panels can be looked at from one place, and are to be.
bool seen_alike(const Alone& a, const Alone& b) {
    const auto framed = [](const ViewState& view) { return !view.camera.target && !view.projection; };
    return framed(a.view) && framed(b.view) && a.view.camera == b.view.camera && a.view.show == b.view.show &&
           a.list.space.origin == b.list.space.origin && a.list.space.time_height == b.list.space.time_height;
}

std::vector<DrawList> lists_of(const Shot& shot) {
    PictureOptions options = shot.picture;
    options.size = panel_size(shot);
    std::vector<DrawList> alone;
    for (const Panel& panel : shot.panels) alone.push_back(build_draw_list(*panel.fitted, panel.view, options));
    std::vector<DrawList> lists;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        CommonFraming framing;
        int alike = 0;
        for (std::size_t j = 0; j < alone.size(); ++j) {
            if (!seen_alike({shot.panels[i].view, alone[i]}, {shot.panels[j].view, alone[j]})) continue;
            framing.add(alone[j]);
            ++alike;
        }
        if (alike < 2) {
            lists.push_back(alone[i]);
            continue;
        }
        ViewState view = shot.panels[i].view;
        view.camera = framing.still(view.camera);
        view.time_height = alone[i].space.time_height;
        PictureOptions framed = options;
        framed.framed = true;
        lists.push_back(build_draw_list(*shot.panels[i].fitted, view, framed));
    }
    return lists;
}

}  // namespace

std::vector<DrawList> panel_lists(const Shot& shot) {
    try {
        return lists_of(shot);
    } catch (const std::invalid_argument& error) {
        throw InputError(shot.file.string(), shot.scene_file.string(), error.what());
    }
}

}  // namespace mobbscope::picture_tests
