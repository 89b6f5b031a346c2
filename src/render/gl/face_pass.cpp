#include <render/drawlist/draw_list.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/face_pass.h>
#include <render/gl/gl_objects.h>

#include <glm/common.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>

namespace mobbscope {

namespace {

bool has_faces(const BoxInstance& box) { return box.fill.a > 0; }

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

FacePass::FacePass(GlContext& context, const BoxBuffer& boxes)
    : boxes_(boxes), faces_(context, "face"), composite_(context, "composite") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, boxes.shape_buffer().name());
    const VertexLayout shape(sizeof(BoxBuffer::Shape), 1);
    shape.floats(0, 3, offsetof(BoxBuffer::Shape, center));
    for (GLuint axis = 0; axis < 3; ++axis) {
        shape.floats(1 + axis, 3, offsetof(BoxBuffer::Shape, extents) + axis * sizeof(glm::vec3));
    }
    shape.integers(5, 2, offsetof(BoxBuffer::Shape, id));
    glBindBuffer(GL_ARRAY_BUFFER, boxes.look_buffer().name());
    VertexLayout(sizeof(BoxBuffer::Look), 1).floats(4, 4, offsetof(BoxBuffer::Look, fill));
    glBindVertexArray(tile_array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, tiles_.name());
    VertexLayout(sizeof(Rect), 1).floats(0, 4, 0);
}

bool FacePass::needed(const DrawnWorld& world) {
    return std::any_of(world.boxes.begin(), world.boxes.end(), has_faces);
}

void FacePass::draw(const DrawList& list, bool ids, DrawStatistics& statistics) {
    if (boxes_.size() == 0) return;
    glBindVertexArray(array_.name());
    faces_.use();
    glUniformMatrix4fv(faces_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(list.projection.clip_from_world));
    glUniform2f(faces_.uniform("depth_range"), list.projection.near_depth, list.projection.far_depth);
    glUniform1i(faces_.uniform("perspective"), list.projection.perspective);
    glUniform1i(faces_.uniform("ids"), ids);
    glUniform3fv(faces_.uniform("light"), 1, glm::value_ptr(towards_light(list.projection)));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(boxes_.size()));
    statistics.triangles += 12 * boxes_.size();
    ++statistics.draw_calls;
}

/// Only what faces may cover is cleared and blended: these are the dearest pixels of a picture.
void FacePass::clear(const DrawList& list, DrawStatistics& statistics) {
    std::vector<BoxInstance> boxes;
    std::copy_if(list.boxes.begin(), list.boxes.end(), std::back_inserter(boxes), has_faces);
    const std::vector<Rect> tiles = covering_tiles(boxes, list.projection);
    tile_count_ = static_cast<GLsizei>(tiles.size());
    if (tiles.empty()) return;
    statistics.overlay_bytes += upload(tiles_, tiles);
    Rect around = tiles.front();
    for (const Rect& tile : tiles) around = {glm::min(around.min, tile.min), glm::max(around.max, tile.max)};
    const glm::ivec2 corner(around.min.x, static_cast<float>(list.size.height) - around.max.y);
    const glm::ivec2 extent(around.size());
    glScissor(corner.x, corner.y, extent.x, extent.y);
    glEnable(GL_SCISSOR_TEST);
    const std::array<GLfloat, 4> nothing_yet{0, 0, 0, 1};
    const std::array<GLfloat, 4> zero{0, 0, 0, 0};
    glClearBufferfv(GL_COLOR, 0, nothing_yet.data());
    glClearBufferfv(GL_COLOR, 1, zero.data());
    glDisable(GL_SCISSOR_TEST);
}

void FacePass::accumulate(const DrawList& list, DrawStatistics& statistics) {
    clear(list, statistics);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    // Colours add up; alpha keeps the product of (1 - opacity).
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    draw(list, false, statistics);
}

void FacePass::composite(const Texture& sums, const Texture& weights, PictureSize size, DrawStatistics& statistics) {
    glBindVertexArray(tile_array_.name());
    glDisable(GL_DEPTH_TEST);
    blend_over();
    composite_.use();
    glUniform1i(composite_.uniform("sums"), 0);
    glUniform1i(composite_.uniform("weights"), 1);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, weights.name());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sums.name());
    glUniform2f(composite_.uniform("viewport"), static_cast<float>(size.width), static_cast<float>(size.height));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, tile_count_);
    statistics.triangles += 2 * static_cast<std::size_t>(tile_count_);
    ++statistics.draw_calls;
}

void FacePass::draw_ids(const DrawList& list, DrawStatistics& statistics) {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    draw(list, true, statistics);
}

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

}  // namespace mobbscope
