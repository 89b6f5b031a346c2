#include <render/drawlist/draw_list.h>
#include <render/layout/block_layout.h>
#include <render/layout/legend.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace mobbscope {

namespace {

using Corners = std::array<glm::vec2, 4>;
constexpr float kBlockGap = 2;  // pixels

/// Where the axis stands, and the labels of floor and axis want to be.
void add_stage_labels(std::vector<Rect>& out, const DrawList& list, const FloorExtent& floor_extent,
                      const ViewState& view, const Metrics& metrics) {
    if (!view.labels) return;
    DrawList scratch;
    scratch.size = list.size;
    scratch.projection = list.projection;
    scratch.space = list.space;
    LabelLayout layout(list.size);
    for (const LabelRequest& label :
         floor_and_axis_labels(scratch, floor_extent, view.floor, view.time_axis, metrics.small)) {
        layout.place(label, scratch);
    }
    for (const TextRun& run : scratch.texts) out.push_back(run.box);
    if (!view.time_axis || time_on_end(list.projection)) return;
    const glm::dvec2 foot = axis_corner(floor_extent, list.projection.right);
    const auto low = list.projection.project(list.space.point(foot.x, foot.y, floor_extent.t0));
    const auto high = list.projection.project(list.space.point(foot.x, foot.y, floor_extent.t1));
    if (low && high) out.push_back(Rect{glm::min(*low, *high), glm::max(*low, *high)}.grown(6 * metrics.scale));
}

}  // namespace

Blocks place_blocks(const Rect& area, glm::vec2 legend, glm::vec2 map, std::span<const Rect> busy) {
    Blocks out;
    const auto corner_for = [&](glm::vec2 size, const Corners& order, const std::optional<Rect>& taken) {
        std::optional<Rect> best;
        std::ptrdiff_t fewest = std::numeric_limits<std::ptrdiff_t>::max();
        const glm::vec2 room = area.size() - size;
        if (size.x <= 0 || size.y <= 0 || room.x < 0 || room.y < 0) return best;
        for (const glm::vec2& corner : order) {
            const glm::vec2 at = glm::round(area.min + corner * room);
            const Rect rect{at, at + size};
            const Rect needed = rect.grown(kBlockGap);
            if (taken && needed.overlaps(*taken)) continue;
            const auto covered =
                std::count_if(busy.begin(), busy.end(), [&](const Rect& r) { return r.overlaps(needed); });
            if (covered >= fewest) continue;
            fewest = covered;
            best = rect;
        }
        out.covers = out.covers || (best && fewest > 0);
        return best;
    };
    out.legend = corner_for(legend, {glm::vec2(0, 1), {1, 1}, {1, 0}, {0, 0}}, std::nullopt);
    out.map = corner_for(map, {glm::vec2(1, 0), {0, 1}, {1, 1}, {0, 0}}, out.legend);
    return out;
}

std::vector<Rect> occupied(const DrawList& list, const FloorExtent& floor_extent, const ViewState& view,
                           const Metrics& metrics) {
    const float cell = 6 * metrics.scale;
    std::vector<Rect> out;
    for (const DiskInstance& disk : list.disks) {
        const auto at = list.projection.project(disk.base);
        if (!at) continue;
        const float r = disk.radius * list.projection.pixels_per_metre(disk.base);
        const Rect rect{*at - glm::vec2(r, 0.5f * r), *at + glm::vec2(r, 0.5f * r)};
        if (out.empty() || !out.back().contains(rect)) out.push_back(rect);
    }
    for (const BoxInstance& box : list.boxes) {
        // Sheets of annotations may be covered in part.
        if (box.state == BoxState::annotation) continue;
        const auto corners = box_corners(box);
        for (const auto& [a, b] : kBoxEdges) {
            const auto from = list.projection.project(corners[a]);
            const auto to = list.projection.project(corners[b]);
            if (!from || !to) continue;
            const int pieces = std::clamp(static_cast<int>(glm::length(*to - *from) / (2 * cell)), 1, 64);
            for (int i = 0; i <= pieces; ++i) {
                const glm::vec2 at = glm::mix(*from, *to, static_cast<float>(i) / static_cast<float>(pieces));
                out.push_back({at - cell, at + cell});
            }
        }
    }
    add_stage_labels(out, list, floor_extent, view, metrics);
    return out;
}

TextBudget fit_to_budget(const Caption& caption, std::vector<LegendEntry> legend, glm::vec2 map, PictureSize size,
                         const Metrics& metrics) {
    const glm::vec2 picture(size.width, size.height);
    const float room = picture.x - 2 * metrics.pad;
    for (LegendEntry& entry : legend) {
        entry.text = fit_text(entry.text, FontFace::text, metrics.small, 0.45f * picture.x);
    }
    TextBudget words{caption_lines(caption, room, metrics.scale, 2), std::move(legend), map};
    const auto fits = [&] {
        const auto area = [](glm::vec2 extent) { return extent.x * extent.y; };
        const float covered = area(caption_size(caption, words.caption, metrics.scale)) +
                              area(legend_size(words.legend, metrics.small)) + area(words.map);
        return covered <= kMostWords * area(picture);
    };
    if (fits()) return words;
    std::erase_if(words.legend, [](const LegendEntry& entry) { return entry.mark == LegendEntry::Mark::remark; });
    if (fits()) return words;
    words.map = glm::vec2(0);
    if (fits()) return words;
    words.legend.clear();
    if (fits()) return words;
    words.caption.detail.clear();
    if (fits()) return words;
    if (caption.headlines.empty()) return words;
    words.caption.headline = caption_lines(caption, room, metrics.scale, 1).headline;
    // A line that breaks off before the outcome says nothing.
    const bool whole = words.caption.headline == std::vector<std::string>{caption.headlines.back()};
    if (whole && fits()) return words;
    words.caption.headline.clear();
    return words;
}

}  // namespace mobbscope
