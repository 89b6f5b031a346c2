#include <base/error.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/picture_state.h>
#include <picture_tests/window_picture.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/sheet.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::picture_tests {

namespace {

PictureSize panel_size(const Shot& shot) {
    if (shot.panels.size() == 1) return shot.picture.size;
    const bool titles = std::any_of(shot.panels.begin(), shot.panels.end(),
                                    [](const PicturePanel& panel) { return !panel.title.empty(); });
    return cell_size(shot.picture.size, static_cast<int>(shot.panels.size()), shot.columns, titles,
                     metrics_of(shot.picture.size, shot.picture.scale));
}

std::vector<DrawList> lists_of(const Shot& shot) {
    PictureOptions options = shot.picture;
    options.size = panel_size(shot);
    std::vector<PictureBeside> panels;
    for (const PicturePanel& panel : shot.panels) panels.push_back({panel.fitted, panel.view});
    return build_draw_lists(panels, options);
}

}  // namespace

PictureMaker::PictureMaker(Backend backend) : renderer_(backend) {}

PictureMaker::Made PictureMaker::make(const Shot& shot) {
    if (!shot.window) {
        const std::vector<DrawList> lists = panel_lists(shot);
        return {draw(shot, lists), picture_state(shot, lists)};
    }
    refuse_warnings(renderer_.backend(), renderer_.context().warnings());
    try {
        const PicturePanel& panel = shot.panels.front();
        WindowPicture window = window_picture(
            *panel.fitted, panel.view, panel.fitted->scene().file, *backend_from_name(renderer_.backend()),
            shot.picture.size, shot.window->scale, shot.window->script ? &*shot.window->script : nullptr);
        return {std::move(window.picture), window_state(window.state)};
    } catch (const app::ExpectationError& error) {
        // A case that fails, like one that cannot be read.
        throw InputError(error.what());
    }
}

Image PictureMaker::draw(const Shot& shot, const std::vector<DrawList>& lists) {
    refuse_warnings(renderer_.backend(), renderer_.context().warnings());
    const PictureOptions& options = shot.picture;
    if (lists.size() == 1) return renderer_.draw(lists.front(), options.samples);
    std::vector<SheetCell> cells;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        cells.push_back({shot.panels[i].title, renderer_.draw(lists[i], options.samples)});
    }
    const Palette& colors = lists.front().palette;
    return make_sheet(cells, shot.columns, colors, options.background.value_or(colors.background),
                      metrics_of(options.size, options.scale), renderer_, options.size);
}

std::vector<DrawList> panel_lists(const Shot& shot) {
    try {
        std::vector<DrawList> lists = lists_of(shot);
        for (std::size_t i = 0; shot.select && i < lists.size(); ++i) {
            const float scale = metrics_of(lists[i].size, shot.picture.scale).scale;
            add_selection(lists[i], *shot.panels[i].fitted, shot.panels[i].view, *shot.select, scale);
        }
        return lists;
    } catch (const std::invalid_argument& error) {
        throw InputError(shot.file.string(), shot.scene_file.string(), error.what());
    }
}

}  // namespace mobbscope::picture_tests
