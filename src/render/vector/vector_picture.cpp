#include <base/file.h>
#include <render/image/picture_names.h>
#include <render/image/png.h>
#include <render/vector/vector_canvas.h>
#include <render/vector/vector_picture.h>
#include <render/vector/world_lines.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace mobbscope {

namespace {

/// A file of more would be slow in whatever opens it.
constexpr std::size_t kMostLines = 40'000;

/// The list's world without its lines, or with them, and nothing over it.
DrawList world_of(const DrawList& list, bool with_lines) {
    DrawList out;
    static_cast<PictureFrame&>(out) = static_cast<const PictureFrame&>(list);
    static_cast<DrawnWorld&>(out) = static_cast<const DrawnWorld&>(list);
    out.palette = list.palette;
    out.background = list.background;
    out.agents = list.agents;
    if (with_lines) {
        out.lines = list.lines;
    } else {
        for (BoxInstance& box : out.boxes) box.edge.a = 0;
    }
    return out;
}

void draw_world(VectorCanvas& canvas, const DrawList& list, int samples, const std::function<Renderer&()>& renderer) {
    const std::size_t edges = kBoxEdges.size() * static_cast<std::size_t>(std::count_if(
                                                     list.boxes.begin(), list.boxes.end(),
                                                     [](const BoxInstance& box) { return box.edge.a > 0; }));
    const bool vectors = list.lines.size() + edges <= kMostLines;
    const bool faces =
        std::any_of(list.boxes.begin(), list.boxes.end(), [](const BoxInstance& box) { return box.fill.a > 0; });
    if (list.disks.empty() && !faces && vectors) {
        canvas.fill(list.background.value_or(list.palette.background));
    } else {
        canvas.image(renderer().draw(world_of(list, !vectors), samples));
    }
    if (!vectors) return;
    std::optional<DepthImage> depths;
    if (!list.disks.empty() && list.lines.size() + edges > 0) depths = renderer().draw_depths(list);
    for (const VectorStroke& stroke : world_lines(list, depths ? &*depths : nullptr)) canvas.stroke(stroke);
}

void draw_overlay(VectorCanvas& canvas, const DrawList& list) {
    for (const VectorStroke& stroke : highlight_lines(list)) canvas.stroke(stroke);
    for (const OverlayPanel& panel : list.panels) draw_panel(canvas, panel);
    std::vector<VectorStroke> strokes;
    for (const OverlayLine& line : list.overlay_lines) {
        LineStyle style;
        style.color = line.color;
        style.width = line.width;
        style.dash = line.dash;
        add_line(strokes, line.from, line.to, style);
    }
    for (const VectorStroke& stroke : strokes) canvas.stroke(stroke);
    for (const OverlayPanel& mark : list.marks) draw_panel(canvas, mark);
    for (const TextRun& text : list.texts) canvas.text(text);
}

}  // namespace

std::string picture_bytes(const std::filesystem::path& file, const DrawList& list, int samples,
                          const std::function<Renderer&()>& renderer) {
    if (!is_vector_name(file)) return png_bytes(renderer().draw(list, samples));
    const std::unique_ptr<VectorCanvas> canvas =
        lower_extension(file) == ".svg" ? svg_canvas(list.size, list.headline) : pdf_canvas(list.size, list.headline);
    draw_world(*canvas, list, samples, renderer);
    draw_overlay(*canvas, list);
    return canvas->finish();
}

std::string picture_bytes(const std::filesystem::path& file, const DrawList& list, int samples, Backend backend) {
    std::optional<Renderer> made;
    return picture_bytes(file, list, samples, [&]() -> Renderer& { return made ? *made : made.emplace(backend); });
}

}  // namespace mobbscope
