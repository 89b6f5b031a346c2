#include <render/drawlist/pen.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/disk_pass.h>
#include <render/gl/gl_objects.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

namespace mobbscope {

namespace {

struct Vertex {
    glm::vec3 corner;
    glm::vec3 normal;
};

using ColorBytes = std::array<std::uint8_t, 4>;

constexpr float kFlatBlock = 0.15f;        // of its distance: how far a block may reach and still have one scale
constexpr std::size_t kMostBridged = 512;  // disks beside the picture that are drawn to save a draw call
constexpr std::size_t kMostInBatch = 32;   // blocks in one draw call: between calls the nearest come first

ColorBytes bytes_of(Rgba color) {
    ColorBytes out;
    for (int i = 0; i < 4; ++i) {
        out[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(std::clamp(color[i], 0.0f, 1.0f) * 255));
    }
    return out;
}

/// Enough sides that a disk of so many pixels looks round, off by at most so many pixels.
float sides_for(float radius, float tolerance) {
    const float off = std::min(1.0f, tolerance / std::max(radius, 0.2f));
    return std::numbers::pi_v<float> / std::acos(1 - off);
}

/// Whether all of a disk is nearer than what is drawn, or behind the eye.
bool behind(const DiskInstance& disk, const ViewProjection& projection) {
    return projection.perspective && projection.depth(disk.base) + disk.radius + disk.height < projection.near_depth;
}

/// As many as the usual disk of a block needs, of a few numbers: what is far away is most of a crowd. A disk half as
/// wide again is off by half as much again.
int coarse_sides(float radius) {
    constexpr std::array kSides{4, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 64, 80, 96, 128};
    const float needed = sides_for(radius, 0.9f);
    const auto enough = std::find_if(kSides.begin(), kSides.end() - 1,
                                     [needed](int sides) { return static_cast<float>(sides) >= needed; });
    return *enough;
}

/// Whether some of a block may be in the picture: its ball reaches into what the camera sees.
bool block_may_be_seen(const DiskBlock& block, const ViewProjection& projection) {
    if (projection.perspective && projection.depth(block.middle) + block.reach < projection.near_depth) return false;
    const glm::mat4 rows = glm::transpose(projection.clip_from_world);
    const glm::vec4 middle(block.middle, 1);
    for (const glm::vec4& across : {rows[0], -rows[0], rows[1], -rows[1]}) {
        const glm::vec4 edge = rows[3] + across;
        if (glm::dot(edge, middle) < -block.reach * glm::length(glm::vec3(edge))) return false;
    }
    return true;
}

}  // namespace

DiskPass::DiskPass(GlContext& context) : program_(context, "disk") {}

/// Upper face, side and lower face, in this order: each part is one range.
const DiskPass::Cylinder& DiskPass::cylinder(int sides) {
    Cylinder& made = cylinders_[sides];
    if (made.sides != 0) return made;
    made.sides = sides;
    std::vector<Vertex> vertices;
    std::vector<GLushort> indices;
    const auto add = [&](glm::vec3 corner, glm::vec3 normal) {
        vertices.push_back({corner, normal});
        return static_cast<GLushort>(vertices.size() - 1);
    };
    const auto direction = [&](int i) { return glm::vec3(glm::dvec3(on_circle<double>(i, sides), 0)); };
    const glm::vec3 up(0, 0, 1);
    const auto add_face = [&](bool upper) {
        const glm::vec3 level = upper ? up : glm::vec3(0);
        const glm::vec3 normal = upper ? up : -up;
        const GLushort middle = add(level, normal);
        add(direction(0) + level, normal);
        for (int i = 1; i <= sides; ++i) {
            const GLushort b = add(direction(i) + level, normal);
            const GLushort a = static_cast<GLushort>(b - 1);
            indices.insert(indices.end(), {middle, upper ? a : b, upper ? b : a});
        }
    };
    add_face(true);
    for (int i = 0; i <= sides; ++i) {
        const GLushort below = add(direction(i), direction(i));
        const GLushort above = add(direction(i) + up, direction(i));
        if (i == 0) continue;
        const GLushort a = static_cast<GLushort>(below - 2);
        const GLushort c = static_cast<GLushort>(above - 2);
        indices.insert(indices.end(), {a, below, c, c, below, above});
    }
    add_face(false);
    glBindVertexArray(made.array.name());
    upload(made.vertices, vertices);
    const VertexLayout corner(sizeof(Vertex), 0);
    corner.floats(0, 3, offsetof(Vertex, corner));
    corner.floats(1, 3, offsetof(Vertex, normal));
    upload(made.indices, indices, GL_ELEMENT_ARRAY_BUFFER);
    return made;
}

/// The colours alone, where the shapes are those of before.
void DiskPass::keep(const DrawnWorld& world) {
    const bool same = levels_ && world.disks.shares_with(kept_);
    kept_ = world.disks;
    if (same) {
        stays_ = true;
        return;
    }
    const std::vector<const DiskInstance*> sorted = in_order(world.disks);
    const auto forget_colors = [](Stored& stored) { stored.has_colors = false; };
    if (levels_ && levels_->take_colors(sorted)) {
        stays_ = true;
        forget_colors(fine_);
        std::for_each(coarse_.begin(), coarse_.end(), forget_colors);
        return;
    }
    std::vector<DiskInstance> disks;
    disks.reserve(sorted.size());
    for (const DiskInstance* disk : sorted) disks.push_back(*disk);
    levels_.emplace(std::move(disks));
    stays_ = false;
    const auto forget = [](Stored& stored) { stored.has_pieces = stored.has_colors = false; };
    forget(fine_);
    std::for_each(coarse_.begin(), coarse_.end(), forget);
}

const DiskPass::Stored& DiskPass::store_shapes(int level, DrawStatistics& statistics) {
    Stored& stored = coarse_[static_cast<std::size_t>(level)];
    if (!stored.has_pieces) statistics.world_bytes += upload(stored.pieces, levels_->level(level).pieces);
    stored.has_pieces = true;
    return stored;
}

const DiskPass::Stored& DiskPass::store(int level, DrawStatistics& statistics) {
    store_shapes(level, statistics);
    Stored& stored = coarse_[static_cast<std::size_t>(level)];
    if (stored.has_colors) return stored;
    std::vector<ColorBytes> colors;
    const std::vector<std::size_t>& sources = levels_->level(level).sources;
    colors.reserve(sources.size());
    for (const std::size_t source : sources) colors.push_back(bytes_of(levels_->disks()[source].color));
    statistics.state_bytes += upload(stored.colors, colors);
    stored.has_colors = true;
    return stored;
}

const DiskPass::Stored& DiskPass::store_fine(DrawStatistics& statistics) {
    const std::vector<DiskInstance>& disks = levels_->disks();
    if (!fine_.has_pieces) {
        statistics.world_bytes += upload(fine_.pieces, pieces_of(disks));
    }
    if (!fine_.has_colors) {
        std::vector<ColorBytes> colors(disks.size());
        std::transform(disks.begin(), disks.end(), colors.begin(),
                       [](const DiskInstance& disk) { return bytes_of(disk.color); });
        statistics.state_bytes += upload(fine_.colors, colors);
    }
    fine_.has_pieces = fine_.has_colors = true;
    return fine_;
}

/// Enough sides for the largest disk: one shape for all, so that their edges fit.
std::vector<DiskPass::Batch> DiskPass::fine_batches(const ViewProjection& projection) const {
    const PixelScale scale(projection);
    float radius = 0;
    bool from_above = true;
    bool from_below = true;
    std::vector<DiskLevels::Range> seen;
    for (const DiskBlock& block : levels_->blocks()) {
        if (!block_may_be_seen(block, projection)) continue;
        seen.push_back({block.first, block.count});
        from_above = from_above && !projection.below(block.highest);
        from_below = from_below && projection.below(block.lowest);
        if (block.widest * scale.at_depth(projection.depth(block.middle) - block.reach) <= radius) continue;
        for (std::size_t i = block.first; i < block.first + block.count; ++i) {
            const DiskInstance& disk = levels_->disks()[i];
            if (!behind(disk, projection)) radius = std::max(radius, disk.radius * scale.at(disk.base));
        }
    }
    const int sides = std::clamp(4 * static_cast<int>(std::ceil(sides_for(radius, 0.17f) / 4)), 12, 128);
    const Part part = from_above ? Part::side_and_upper_face : from_below ? Part::side_and_lower_face : Part::all;
    std::ranges::sort(seen, {}, &DiskLevels::Range::first);
    std::vector<Batch> out;
    for (const DiskLevels::Range& range : seen) {
        // A few disks beside the picture cost less than another draw call.
        if (out.empty() || out.back().range.first + out.back().range.count + kMostBridged < range.first) {
            out.push_back({0, sides, part, {range.first, 0}, 0});
        }
        out.back().range.count = range.first + range.count - out.back().range.first;
    }
    return out;
}

std::vector<DiskPass::Batch> DiskPass::coarse_batches(const ViewProjection& projection) {
    const PixelScale scale(projection);
    std::vector<Batch> out;
    Batch tubes, disks;
    std::size_t together = 0;
    const auto flush = [&] {
        for (Batch* batch : {&tubes, &disks}) {
            if (batch->range.count > 0) out.push_back(*batch);
            batch->range.count = 0;
        }
        together = 0;
    };
    for (std::size_t i = 0; i < levels_->blocks().size(); ++i) {
        const DiskBlock& block = levels_->blocks()[i];
        if (!block_may_be_seen(block, projection)) continue;
        const float middle = projection.depth(block.middle);
        const float depth = middle - block.reach;
        // What is little nearer than the middle is little larger.
        const float pixels = scale.at_depth(block.reach < kFlatBlock * middle ? middle : depth);
        const int level = DiskLevels::choose(block, pixels, projection);
        const int sides = coarse_sides(block.usual_radius * pixels);
        const Part part = !projection.below(block.highest) ? Part::side_and_upper_face
                          : projection.below(block.lowest) ? Part::side_and_lower_face
                                                           : Part::all;
        const DiskLevels::Level& made = levels_->level(level);
        const bool alike = together > 0 && together < kMostInBatch && disks.level == level && disks.sides == sides &&
                           disks.part == part &&
                           (tubes.range.count == 0 || tubes.range.first + tubes.range.count == made.tubes[i].first) &&
                           (disks.range.count == 0 || disks.range.first + disks.range.count == made.disks[i].first);
        if (!alike) {
            flush();
            // Where the lower face of a path's first disk is seen, the tube that begins with it shows that.
            tubes = {
                level, sides, part == Part::side_and_upper_face ? Part::side : Part::side_and_lower_face, {}, depth};
            disks = {level, sides, part, {}, depth};
        }
        const auto add = [&](Batch& batch, DiskLevels::Range range) {
            if (batch.range.count == 0) batch.range.first = range.first;
            batch.range.count += range.count;
            batch.depth = std::min(batch.depth, depth);
        };
        add(tubes, made.tubes[i]);
        add(disks, made.disks[i]);
        ++together;
    }
    flush();
    // What is hidden by what was drawn before need not be shaded.
    std::ranges::stable_sort(out, {}, &Batch::depth);
    return out;
}

void DiskPass::draw(const Batch& batch, DrawStatistics& statistics) {
    const Stored& stored = detail_ == Detail::coarse ? store(batch.level, statistics) : store_fine(statistics);
    const Cylinder& shape = cylinder(batch.sides);
    glBindVertexArray(shape.array.name());
    // OpenGL 3.3 has no first instance: the attributes begin there instead.
    glBindBuffer(GL_ARRAY_BUFFER, stored.pieces.name());
    const VertexLayout piece(sizeof(DiskPiece), 1);
    const std::size_t begin = batch.range.first * sizeof(DiskPiece);
    piece.floats(2, 4, begin + offsetof(DiskPiece, base));
    piece.floats(3, 4, begin + offsetof(DiskPiece, top));
    piece.integers(5, 2, begin + offsetof(DiskPiece, id));
    piece.floats(6, 3, begin + offsetof(DiskPiece, above));
    piece.floats(7, 3, begin + offsetof(DiskPiece, below));
    const glm::vec2 next_corner(on_circle<double>(1, batch.sides));
    glUniform2fv(program_.uniform("next_corner"), 1, glm::value_ptr(next_corner));
    glUniform1f(program_.uniform("inner"), std::cos(std::numbers::pi_v<float> / static_cast<float>(batch.sides)));
    glBindBuffer(GL_ARRAY_BUFFER, stored.colors.name());
    VertexLayout(sizeof(ColorBytes), 1).bytes(4, 4, batch.range.first * sizeof(ColorBytes));
    const std::size_t face = 3 * static_cast<std::size_t>(batch.sides);
    const bool upper = batch.part == Part::side_and_upper_face || batch.part == Part::all;
    const bool lower = batch.part == Part::side_and_lower_face || batch.part == Part::all;
    const std::size_t indices = (upper ? face : 0) + 2 * face + (lower ? face : 0);
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(indices), GL_UNSIGNED_SHORT,
                            reinterpret_cast<const void*>(upper ? 0 : face * sizeof(GLushort)),
                            static_cast<GLsizei>(batch.range.count));
    statistics.triangles += indices / 3 * batch.range.count;
    ++statistics.draw_calls;
}

void DiskPass::draw(const DrawList& list, Detail detail, DrawStatistics& statistics) {
    begin(list, detail, statistics);
    draw_more(list, std::numeric_limits<std::size_t>::max(), statistics);
}

void DiskPass::begin(const DrawList& list, Detail detail, DrawStatistics& statistics) {
    keep(list);
    detail_ = detail;
    undrawn_.clear();
    if (list.disks.empty()) return;
    const bool coarse = detail == Detail::coarse;
    undrawn_ = coarse ? coarse_batches(list.projection) : fine_batches(list.projection);
    std::ranges::reverse(undrawn_);
    if (coarse && stays_) {
        for (int level = 0; level < DiskLevels::kLevels; ++level) store_shapes(level, statistics);
    }
}

bool DiskPass::draw_more(const DrawList& list, std::size_t most, DrawStatistics& statistics) {
    if (undrawn_.empty()) return true;
    program_.use();
    glUniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE,
                       glm::value_ptr(list.projection.clip_from_world));
    glUniform3fv(program_.uniform("light"), 1, glm::value_ptr(towards_light(list.projection)));
    glUniform1f(program_.uniform("scale"), PixelScale(list.projection).near());
    // Without perspective nothing is too near to be drawn.
    const float near_depth =
        list.projection.perspective ? list.projection.near_depth : std::numeric_limits<float>::lowest();
    glUniform1f(program_.uniform("near_depth"), near_depth);
    glUniform3fv(program_.uniform("back"), 1, glm::value_ptr(list.projection.back));
    // With two corners at the sides the outline is right, however few the others are.
    const glm::vec2 across = detail_ == Detail::coarse ? glm::vec2(list.projection.right) : glm::vec2(1, 0);
    glUniform2fv(program_.uniform("across"), 1, glm::value_ptr(across));
    glUniform3fv(program_.uniform("background"), 1, glm::value_ptr(list.palette.background));
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    while (most > 0 && !undrawn_.empty()) {
        Batch& batch = undrawn_.back();
        Batch now = batch;
        now.range.count = std::min(now.range.count, most);
        draw(now, statistics);
        most -= now.range.count;
        batch.range.first += now.range.count;
        batch.range.count -= now.range.count;
        if (batch.range.count == 0) undrawn_.pop_back();
    }
    glDisable(GL_CULL_FACE);
    return undrawn_.empty();
}

}  // namespace mobbscope
