#include <base/error.h>
#include <picture_tests/picture_maker.h>
#include <picture_tests/window_picture.h>
#include <render/drawlist/draw_list_json.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/sheet.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

namespace {

/// The size of the scene without text out of a window of this size. It is small: what is drawn of a scene is held by
/// the cases without a window.
PictureSize size_of_scene(PictureSize window) {
    return {std::max(window.width / 4, kMinSide), std::max(window.height / 4, kMinSide)};
}

/// A script whose expectation does not hold is a case that fails, like one that cannot be read.
template <class Work>
auto work_window(const Work& work) {
    try {
        return work();
    } catch (const app::ExpectationError& error) {
        throw InputError(error.what());
    }
}

const app::Script* script_of(const Shot& shot) { return shot.window->script ? &*shot.window->script : nullptr; }

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

Image PictureMaker::make(const Shot& shot) {
    if (shot.window) {
        refuse_warnings(renderer_.backend(), renderer_.context().warnings());
        return work_window([&] {
            return window_picture(*shot.panels.front().fitted, shot.panels.front().view, shot.scene_file,
                                  *backend_from_name(renderer_.backend()), shot.picture.size, shot.window->scale,
                                  script_of(shot));
        });
    }
    return make(shot, panel_lists(shot));
}

Image PictureMaker::make(const Shot& shot, const std::vector<DrawList>& lists) {
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

std::string PictureMaker::draw_lists(const std::vector<DrawList>& lists) {
    std::ostringstream out;
    if (lists.size() > 1) out << "[\n";
    for (std::size_t i = 0; i < lists.size(); ++i) {
        if (i > 0) out << ",\n";
        const IdImage ids = renderer_.draw_ids(lists[i]);
        write_draw_list(out, lists[i], &ids);
    }
    if (lists.size() > 1) out << "]\n";
    return out.str();
}

PictureMaker::Window PictureMaker::window_without_text(const Shot& shot) {
    const WindowContents contents = work_window([&] {
        return window_contents(*shot.panels.front().fitted, shot.panels.front().view, shot.scene_file,
                               *backend_from_name(renderer_.backend()), shot.picture.size, shot.window->scale,
                               size_of_scene(shot.picture.size), script_of(shot));
    });
    return {renderer_.draw(contents.scene), contents.state};
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
