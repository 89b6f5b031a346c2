#include <guard/panel_lists.h>
#include <guard/picture_maker.h>
#include <guard/shader_warnings.h>
#include <guard/window_picture.h>
#include <import/error.h>
#include <render/draw_list_json.h>
#include <render/sheet.h>

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::guard {

namespace {

Image picture_of_window(const Shot& shot, Backend backend) {
    const Panel& panel = shot.panels.front();
    const app::Script* script = shot.window->script ? &*shot.window->script : nullptr;
    try {
        return window_picture(*panel.fitted, panel.view, shot.scene_file, backend, shot.picture.size,
                              shot.window->scale, script);
    } catch (const app::ExpectationError& error) {
        throw InputError(error.what());
    }
}

}  // namespace

PictureMaker::PictureMaker(Backend backend) : renderer_(backend) {}

Image PictureMaker::make(const Shot& shot) {
    refuse_warnings(renderer_.backend(), renderer_.warnings());
    if (shot.window) return picture_of_window(shot, *backend_from_name(renderer_.backend()));
    const std::vector<DrawList> lists = panel_lists(shot);
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

std::string PictureMaker::draw_lists(const Shot& shot) {
    const std::vector<DrawList> lists = panel_lists(shot);
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

}  // namespace mobbscope::guard
