#include <render/parts/floor_inset.h>
#include <render/parts/paths.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mobbscope {

namespace {

constexpr float kMapSide = 128;  // pixels at scale 1, of the longer side
constexpr float kPadding = 9;
constexpr float kTitle = 11;

glm::vec2 map_size(const FloorExtent& s, float scale) {
    const double longest = std::max(s.x1 - s.x0, s.y1 - s.y0);
    return glm::ceil(glm::vec2(glm::dvec2(s.x1 - s.x0, s.y1 - s.y0) / longest) * kMapSide * scale);
}

}  // namespace

glm::vec2 inset_size(const FloorExtent& floor_extent, float scale) {
    const glm::vec2 map = map_size(floor_extent, scale);
    const float title = line_height(FontFace::text, kTitle * scale);
    return {std::max(map.x, 100 * scale) + 2 * kPadding * scale, map.y + title + 2.6f * kPadding * scale};
}

void add_floor_inset(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& s, double time,
                     glm::vec2 corner, float scale) {
    const glm::vec2 size = inset_size(s, scale);
    const glm::vec2 map = map_size(s, scale);
    list.panels.push_back({{corner, corner + size}, 5 * scale, list.palette.panel, list.palette.panel_border, 1});
    char title[64];
    std::snprintf(title, sizeof title, "floor at %.2f s", time);
    list.texts.push_back(
        text_at(title, FontFace::text, kTitle * scale, list.palette.quiet_text, corner + kPadding * scale));
    const glm::vec2 origin(corner.x + 0.5f * (size.x - map.x), corner.y + size.y - kPadding * scale - map.y);
    const auto at = [&](double x, double y) {
        const glm::dvec2 unit((x - s.x0) / (s.x1 - s.x0), (s.y1 - y) / (s.y1 - s.y0));
        return origin + glm::vec2(unit) * map;
    };
    for (const double x : ticks(s.x0, s.x1, s.step)) {
        list.overlay_lines.push_back({at(x, s.y0), at(x, s.y1), list.palette.grid, 1, kSolid});
    }
    for (const double y : ticks(s.y0, s.y1, s.step)) {
        list.overlay_lines.push_back({at(s.x0, y), at(s.x1, y), list.palette.grid, 1, kSolid});
    }
    for (const DrawnAgent& agent : agents) {
        const mobb::PlacedClip& clip = agent.clip();
        glm::vec2 from = at(clip.disk(0).x, clip.disk(0).y);
        for (int i = 1; i < clip.count(); ++i) {
            const glm::vec2 to = at(clip.disk(i).x, clip.disk(i).y);
            if (i + 1 < clip.count() && std::hypot(to.x - from.x, to.y - from.y) < 1.5f) continue;
            list.overlay_lines.push_back({from, to, with_alpha(agent.color, 0.7f), scale, kSolid});
            from = to;
        }
    }
    const float pixels = map.x / static_cast<float>(s.x1 - s.x0);
    for (const DrawnAgent& agent : agents) {
        const std::optional<int> sample = sample_at(agent, time);
        if (!sample) continue;
        const mobb::Disk disk = agent.clip().disk(*sample);
        const glm::vec2 middle = at(disk.x, disk.y);
        const float r = std::max(static_cast<float>(disk.r) * pixels, 2.5f * scale);
        list.marks.push_back({{middle - r, middle + r}, r, with_alpha(agent.color, 0.9f), list.palette.text, scale});
    }
}

}  // namespace mobbscope
