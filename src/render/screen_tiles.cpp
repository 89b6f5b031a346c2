#include <render/box_corners.h>
#include <render/screen_tiles.h>

#include <glm/common.hpp>

#include <cstddef>
#include <limits>

namespace mobbscope {

namespace {

constexpr int kSide = 32;  // pixels of a tile

/// What a box covers, or all if a part of it is behind the eye.
Rect covered_by(const BoxInstance& box, const Lens& lens, const Rect& all) {
    Rect rect{glm::vec2(std::numeric_limits<float>::max()), glm::vec2(std::numeric_limits<float>::lowest())};
    for (const glm::vec3& corner : box_corners(box)) {
        const auto at = lens.project(corner);
        if (!at) return all;
        rect.min = glm::min(rect.min, *at);
        rect.max = glm::max(rect.max, *at);
    }
    return rect.grown(1);
}

}  // namespace

std::vector<Rect> covering_tiles(std::span<const BoxInstance> boxes, const Lens& lens) {
    const int columns = (lens.size.width + kSide - 1) / kSide;
    const int rows = (lens.size.height + kSide - 1) / kSide;
    const glm::vec2 last(columns - 1, rows - 1);
    const glm::vec2 picture(lens.size.width, lens.size.height);
    const Rect all{glm::vec2(0), picture};
    std::vector<char> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    const auto tile = [&](int column, int row) -> char& {
        return covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    };
    for (const BoxInstance& box : boxes) {
        const Rect rect = covered_by(box, lens, all);
        if (!rect.overlaps(all)) continue;
        const glm::ivec2 from(glm::clamp(glm::floor(rect.min / float{kSide}), glm::vec2(0), last));
        const glm::ivec2 to(glm::clamp(glm::floor(rect.max / float{kSide}), glm::vec2(0), last));
        for (int row = from.y; row <= to.y; ++row) {
            for (int column = from.x; column <= to.x; ++column) tile(column, row) = 1;
        }
    }
    std::vector<Rect> out;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (!tile(column, row)) continue;
            const int first = column;
            while (column + 1 < columns && tile(column + 1, row)) ++column;
            const glm::vec2 min(first * kSide, row * kSide);
            const glm::vec2 max((column + 1) * kSide, (row + 1) * kSide);
            out.push_back({min, glm::min(max, picture)});
        }
    }
    return out;
}

}  // namespace mobbscope
