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

}  // namespace mobbscope
