#include <render/drawlist/view_projection.h>
#include <render/gl/tiles.h>

#include <glm/common.hpp>

#include <cstddef>
#include <limits>

namespace mobbscope {

namespace {

constexpr int kSide = 32;  // pixels of a tile

/// What a box covers, or all if a part of it is behind the eye.
Rect covered_by(const BoxInstance& box, const ViewProjection& projection, const Rect& all) {
    Rect rect{glm::vec2(std::numeric_limits<float>::max()), glm::vec2(std::numeric_limits<float>::lowest())};
    for (const glm::vec3& corner : box_corners(box)) {
        const auto at = projection.project(corner);
        if (!at) return all;
        rect.min = glm::min(rect.min, *at);
        rect.max = glm::max(rect.max, *at);
    }
    return rect.grown(1);
}

}  // namespace

std::vector<Rect> covering_tiles(std::span<const BoxInstance> boxes, const ViewProjection& projection) {
    const int columns = (projection.size.width + kSide - 1) / kSide;
    const int rows = (projection.size.height + kSide - 1) / kSide;
    const glm::vec2 last(columns - 1, rows - 1);
    const glm::vec2 picture(projection.size.width, projection.size.height);
    const Rect all{glm::vec2(0), picture};
    std::vector<char> covered(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0);
    const auto tile = [&](int column, int row) -> char& {
        return covered[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                       static_cast<std::size_t>(column)];
    };
    for (const BoxInstance& box : boxes) {
        const Rect rect = covered_by(box, projection, all);
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

Tiles::Tiles() {
    glBindVertexArray(array_.name());
    VertexLayout<Rect>(rectangles_).floats(0, 4, 0);
}

std::optional<Rect> Tiles::cover(std::span<const BoxInstance> boxes, const ViewProjection& projection,
                                 DrawStatistics& statistics) {
    const std::vector<Rect> tiles = covering_tiles(boxes, projection);
    count_ = tiles.size();
    if (tiles.empty()) return std::nullopt;
    statistics.overlay_bytes += upload(rectangles_, tiles);
    Rect around = tiles.front();
    for (const Rect& tile : tiles) around = {glm::min(around.min, tile.min), glm::max(around.max, tile.max)};
    return around;
}

void Tiles::draw(DrawStatistics& statistics) const {
    glBindVertexArray(array_.name());
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(count_));
    statistics.triangles += 2 * count_;
    ++statistics.draw_calls;
}

}  // namespace mobbscope
