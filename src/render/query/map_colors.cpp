#include <render/query/map_colors.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace mobbscope {

namespace {

constexpr float kFreeTint = 0.3f;  // of the separated colour, of an answer

/// Whether a cell's colour says its value.
bool is_colored(const PlacementMap& map, int x, int y) {
    if (map.order.show == MapShow::tests) return true;
    return map.order.show == MapShow::clearance && !map.hit(x, y) && std::isfinite(map.value(x, y));
}

template <class Do>
void for_colored(const PlacementMap& map, const Do& what) {
    if (map.step == 0) return;
    for (int y = 0; y < map.order.height; y += map.step) {
        for (int x = 0; x < map.order.width; x += map.step) {
            if (is_colored(map, x, y)) what(map.value(x, y));
        }
    }
}

}  // namespace

MapColors usual_colors(const PlacementMap& map) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for_colored(map, [&](double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    });
    if (map.order.show == MapShow::clearance || !(least <= most)) least = 0;
    return {least, most > least ? most : least + 1};
}

Rgba value_color(MapShow show, double value, const MapColors& colors, const Palette& palette) {
    const auto share = static_cast<float>((value - colors.from) / (colors.to - colors.from));
    return quantity_color(show == MapShow::clearance ? 1 - share : share, palette);
}

Rgba cell_color(const PlacementMap& map, int x, int y, const MapColors& colors, const Palette& palette) {
    if (is_colored(map, x, y)) return value_color(map.order.show, map.value(x, y), colors, palette);
    if (map.hit(x, y)) return palette.hit;
    const bool alone = std::isinf(map.value(x, y));
    return mix_colors(palette.background, alone ? palette.apart_in_time : palette.separated, kFreeTint);
}

Image map_image(const PlacementMap& map, const MapColors& colors, const Palette& palette) {
    Image image(map.order.width, map.order.height);
    const auto byte = [](float channel) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.f, 1.f)));
    };
    for (int y = 0; y < map.order.height; ++y) {
        for (int x = 0; x < map.order.width; ++x) {
            const Rgba color = cell_color(map, x, y, colors, palette);
            const std::array<std::uint8_t, 4> pixel{byte(color.r), byte(color.g), byte(color.b), 255};
            std::ranges::copy(pixel, image.at(x, map.order.height - 1 - y));
        }
    }
    return image;
}

glm::vec2 map_pixel(const MapOrder& order, const Rect& area, glm::dvec2 offset) {
    const glm::dvec2 share{(offset.x - order.across.from) / (order.across.to - order.across.from),
                           (offset.y - order.up.from) / (order.up.to - order.up.from)};
    return {area.min.x + static_cast<float>(share.x) * area.size().x,
            area.max.y - static_cast<float>(share.y) * area.size().y};
}

std::vector<PixelLine> hit_hatch(const PlacementMap& map, const Rect& area, float apart) {
    std::vector<PixelLine> out;
    if (map.step == 0) return out;
    const glm::vec2 size = area.size();
    const auto is_hit = [&](glm::vec2 at) {
        const auto cell = [](float share, int cells) {
            return std::clamp(static_cast<int>(share * static_cast<float>(cells)), 0, cells - 1);
        };
        return map.hit(cell((at.x - area.min.x) / size.x, map.order.width),
                       cell((area.max.y - at.y) / size.y, map.order.height));
    };
    const float across = apart * std::sqrt(2.0f);
    // Each begins at the left or at the lower side, and is walked pixel by pixel.
    for (int line = 1; static_cast<float>(line) * across < size.x + size.y; ++line) {
        const float c = static_cast<float>(line) * across;
        const float begin = std::max(0.0f, c - size.y), end = std::min(size.x, c);
        std::optional<glm::vec2> from;
        const int last = static_cast<int>(end - begin);
        for (int pixel = 0; pixel <= last; ++pixel) {
            const float x = begin + static_cast<float>(pixel);
            const glm::vec2 at{area.min.x + x, area.min.y + c - x};
            const bool hit = is_hit(at);
            if (hit && !from) from = at;
            if (from && (!hit || pixel == last)) {
                if (at.x - from->x > 2) out.push_back({*from, at});
                from.reset();
            }
        }
    }
    return out;
}

Rgba boundary_color(const Palette& palette) { return mix_colors(palette.hit, Rgba(1), palette.dark ? 0.75f : 0.9f); }

Rgba hatch_color(MapShow show, const Palette& palette) {
    return show == MapShow::tests ? palette.hit : mix_colors(palette.hit, Rgba(0, 0, 0, 1), 0.35f);
}

std::vector<std::size_t> value_counts(const PlacementMap& map, const MapColors& range, int bars) {
    std::vector<std::size_t> out(static_cast<std::size_t>(bars));
    for_colored(map, [&](double value) {
        const double at = (value - range.from) / (range.to - range.from) * bars;
        ++out[static_cast<std::size_t>(std::clamp(at, 0.0, bars - 1.0))];
    });
    return out;
}

}  // namespace mobbscope
