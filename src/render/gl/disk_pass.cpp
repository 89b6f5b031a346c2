#include <base/error.h>
#include <render/drawlist/pen.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/box_buffer.h>
#include <render/gl/disk_pass.h>
#include <render/gl/gl_objects.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

struct Vertex {
    glm::vec4 corner;
    glm::vec3 normal;
};

using ColorBytes = std::array<std::uint8_t, 4>;

constexpr std::size_t kColorColumns = 1024;  // of the texture of colours
// Numbers of disks that floats tell apart, which is as many as the texture holds where it may have 16384 rows.
constexpr std::size_t kMostNumbers = std::size_t{1} << 24;
// Units of textures.
constexpr GLint kVisibility = 0;
constexpr GLint kVisibilitySamples = 1;
constexpr GLint kColors = 2;

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
    return projection.perspective &&
           projection.depth(disk.base) + disk.radius + disk.lean() + disk.height() < projection.near_depth;
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
bool block_may_be_seen(const DiskBlock& block, const ViewProjection& projection, glm::vec2 slab) {
    if (block.highest <= slab.x || block.lowest > slab.y) return false;
    if (projection.perspective && projection.depth(block.middle) + block.reach < projection.near_depth) return false;
    const glm::mat4 rows = glm::transpose(projection.clip_from_world);
    const glm::vec4 middle(block.middle, 1);
    for (const glm::vec4& across : {rows[0], -rows[0], rows[1], -rows[1]}) {
        const glm::vec4 edge = rows[3] + across;
        if (glm::dot(edge, middle) < -block.reach * glm::length(glm::vec3(edge))) return false;
    }
    return true;
}

/// Whether disks of a block end where they are cut. A tube would be open there.
bool crosses_slab(const DiskBlock& block, glm::vec2 slab) {
    const auto reaches = [&](float height) { return block.lowest <= height && height <= block.highest; };
    return reaches(slab.x) || reaches(slab.y);
}

}  // namespace

DiskPass::DiskPass(GlContext& context)
    : policy_(context.policy()), program_(context, "disk"), tint_(context, "composite", "tint") {
    GLint rows = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &rows);
    most_disks_ = std::min(kMostNumbers - 1, kColorColumns * static_cast<std::size_t>(rows));
}

/// Upper face, side and lower face, in this order: each part is one range.
const DiskPass::Cylinder& DiskPass::cylinder(int sides) {
    Cylinder& made = cylinders_[sides];
    if (made.sides != 0) return made;
    made.sides = sides;
    std::vector<Vertex> vertices;
    std::vector<GLushort> indices;
    const auto add = [&](glm::vec3 corner, glm::vec3 normal, float rim = 1) {
        vertices.push_back({glm::vec4(corner, rim), normal});
        return static_cast<GLushort>(vertices.size() - 1);
    };
    const auto direction = [&](int i) { return glm::vec3(glm::dvec3(on_circle<double>(i, sides), 0)); };
    const glm::vec3 up(0, 0, 1);
    const auto add_face = [&](bool upper) {
        const glm::vec3 level = upper ? up : glm::vec3(0);
        const glm::vec3 normal = upper ? up : -up;
        for (int i = 0; i <= sides; ++i) {
            const GLushort inside = add(direction(i) + level, normal, 0);
            const GLushort rim = add(direction(i) + level, normal);
            if (i == 0) continue;
            const GLushort before = static_cast<GLushort>(inside - 2);
            const GLushort rim_before = static_cast<GLushort>(rim - 2);
            if (upper) indices.insert(indices.end(), {before, rim_before, rim, before, rim, inside});
            if (!upper) indices.insert(indices.end(), {before, rim, rim_before, before, inside, rim});
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
    const VertexLayout<Vertex> corner(made.vertices, 0);
    corner.floats(0, 4, offsetof(Vertex, corner));
    corner.floats(1, 3, offsetof(Vertex, normal));
    upload(made.indices, indices, GL_ELEMENT_ARRAY_BUFFER);
    return made;
}

/// The colours alone, where the shapes are those of before.
void DiskPass::keep(const DrawnWorld& world) {
    const bool same = levels_ && world.disks.shares_with(kept_);
    kept_ = world.disks;
    if (same) return;
    const std::vector<const DiskInstance*> sorted = in_order(world.disks);
    has_colors_ = false;
    if (levels_ && levels_->take_colors(sorted)) return;
    std::vector<DiskInstance> disks;
    disks.reserve(sorted.size());
    for (const DiskInstance* disk : sorted) disks.push_back(*disk);
    levels_.emplace(std::move(disks));
    ++shapes_;
    drawn_ = false;
    fine_.has_pieces = false;
    for (Stored& stored : coarse_) stored.has_pieces = false;
}

const DiskPass::Stored& DiskPass::store(int level, DrawStatistics& statistics) {
    Stored& stored = coarse_[static_cast<std::size_t>(level)];
    if (stored.has_pieces) return stored;
    const DiskLevels::Level& made = levels_->level(level);
    statistics.world_bytes += upload(stored.pieces, made.pieces) + upload(stored.sources, made.sources);
    stored.has_pieces = true;
    return stored;
}

const DiskPass::Stored& DiskPass::store_fine(DrawStatistics& statistics) {
    if (fine_.has_pieces) return fine_;
    const std::vector<DiskInstance>& disks = levels_->disks();
    std::vector<std::uint32_t> sources(disks.size());
    std::iota(sources.begin(), sources.end(), 0u);
    statistics.world_bytes += upload(fine_.pieces, pieces_of(disks)) + upload(fine_.sources, sources);
    fine_.has_pieces = true;
    return fine_;
}

void DiskPass::store_colors(DrawStatistics& statistics) {
    if (has_colors_) return;
    const std::vector<DiskInstance>& disks = levels_->disks();
    const std::size_t rows = (disks.size() + kColorColumns - 1) / kColorColumns;
    std::vector<ColorBytes> colors(rows * kColorColumns);
    std::ranges::transform(disks, colors.begin(), [](const DiskInstance& disk) { return bytes_of(disk.color); });
    fill_texture(colors_, GL_RGBA8, {kColorColumns, static_cast<int>(rows)}, GL_RGBA, GL_UNSIGNED_BYTE, colors.data());
    statistics.state_bytes += disks.size() * sizeof(ColorBytes);
    has_colors_ = true;
}

/// Enough sides for the largest disk: one shape for all, so that their edges fit.
std::vector<DiskPass::Batch> DiskPass::fine_batches(const ViewProjection& projection, glm::vec2 slab) const {
    const PixelScale scale(projection);
    float radius = 0;
    bool from_above = true;
    bool from_below = true;
    std::vector<DiskLevels::Range> seen;
    for (const DiskBlock& block : levels_->blocks()) {
        if (!block_may_be_seen(block, projection, slab)) continue;
        seen.push_back({block.first, block.count});
        from_above = from_above && !projection.below(block.highest);
        from_below = from_below && projection.below(block.lowest);
        if (block.widest * scale.at_depth(projection.depth(block.middle) - block.reach) <= radius) continue;
        for (std::size_t i = block.first; i < block.first + block.count; ++i) {
            const DiskInstance& disk = levels_->disks()[i];
            if (behind(disk, projection)) continue;
            radius = std::max(radius, std::max(disk.radius, disk.top_radius) * scale.at(disk.base));
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

std::vector<DiskPass::Batch> DiskPass::coarse_batches(const ViewProjection& projection, glm::vec2 slab) {
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
        if (!block_may_be_seen(block, projection, slab)) continue;
        const float middle = projection.depth(block.middle);
        const float depth = middle - block.reach;
        // What is little nearer than the middle is little larger.
        const float pixels = scale.at_depth(block.reach < kFlatBlock * middle ? middle : depth);
        const int level = crosses_slab(block, slab) ? 0 : DiskLevels::choose(block, pixels, projection);
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
    const VertexLayout<DiskPiece> piece(stored.pieces, 1, {batch.range.first});
    piece.floats(2, 4, offsetof(DiskPiece, base));
    piece.floats(3, 4, offsetof(DiskPiece, top));
    piece.integers(5, 2, offsetof(DiskPiece, id));
    piece.floats(6, 3, offsetof(DiskPiece, above));
    piece.floats(7, 3, offsetof(DiskPiece, below));
    VertexLayout<std::uint32_t>(stored.sources, 1, {batch.range.first}).integers(4, 1, 0);
    program_.set("inner", std::cos(std::numbers::pi_v<float> / static_cast<float>(batch.sides)));
    const std::size_t face = 6 * static_cast<std::size_t>(batch.sides);
    const bool upper = batch.part == Part::side_and_upper_face || batch.part == Part::all;
    const bool lower = batch.part == Part::side_and_lower_face || batch.part == Part::all;
    const std::size_t indices = (upper ? face : 0) + face + (lower ? face : 0);
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(indices), GL_UNSIGNED_SHORT,
                            reinterpret_cast<const void*>(upper ? 0 : face * sizeof(GLushort)),
                            static_cast<GLsizei>(batch.range.count));
    statistics.triangles += indices / 3 * batch.range.count;
    ++statistics.draw_calls;
}

void DiskPass::draw(const DrawList& list, Detail detail, DrawStatistics& statistics) {
    begin(visibility_key(list, detail), false, statistics);
    draw_more(list, std::numeric_limits<std::size_t>::max(), statistics);
}

DiskPass::VisibilityKey DiskPass::visibility_key(const DrawList& list, Detail detail) {
    if (list.disks.size() > most_disks_) {
        throw MachineError("this OpenGL draws at most " + std::to_string(most_disks_) + " disks, not " +
                           std::to_string(list.disks.size()) + "; hide some of the agents");
    }
    keep(list);
    const ViewProjection& projection = list.projection;
    const glm::vec2 slab = slab_of(list);
    VisibilityKey out{shapes_, detail, {}, projection.clip_from_world, projection.right, projection.back, slab};
    if (list.disks.empty()) return out;
    out.batches = detail == Detail::coarse ? coarse_batches(projection, slab) : fine_batches(projection, slab);
    return out;
}

void DiskPass::begin(const VisibilityKey& key, bool colored, DrawStatistics& statistics) {
    detail_ = key.detail;
    colored_ = colored;
    undrawn_.assign(key.batches.rbegin(), key.batches.rend());
    if (undrawn_.empty()) return;
    if (detail_ == Detail::coarse && drawn_) {
        for (int level = 0; level < DiskLevels::kLevels; ++level) store(level, statistics);
    }
    drawn_ = true;
}

bool DiskPass::draw_more(const DrawList& list, std::size_t most, DrawStatistics& statistics) {
    if (undrawn_.empty()) return true;
    program_.use();
    const ViewProjection& projection = list.projection;
    program_.set("clip_from_world", projection.clip_from_world);
    program_.set("light", towards_light(projection));
    program_.set("scale", PixelScale(projection).near());
    // Without perspective nothing is too near to be drawn.
    program_.set("near_depth", projection.perspective ? projection.near_depth : std::numeric_limits<float>::lowest());
    program_.set("most_lean", levels_->most_lean());
    program_.set("agent_depths", kAgentDepths);
    program_.set("agent_depth_step", agent_depth_step(projection));
    program_.set("slab", slab_of(list));
    program_.set("back", projection.back);
    // With two corners at the sides the outline is right, however few the others are.
    program_.set("across", detail_ == Detail::coarse ? glm::vec2(projection.right) : glm::vec2(1, 0));
    if (colored_) use_colors(program_, list, statistics);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    while (most > 0 && !undrawn_.empty()) {
        Batch& batch = undrawn_.back();
        Batch now = batch;
        const std::size_t at_once =
            std::max<std::size_t>(1, policy_.most_sides / static_cast<std::size_t>(batch.sides));
        now.range.count = std::min({now.range.count, most, at_once});
        draw(now, statistics);
        if (policy_.finishes && now.range.count < batch.range.count) glFinish();
        most -= now.range.count;
        batch.range.first += now.range.count;
        batch.range.count -= now.range.count;
        if (batch.range.count == 0) undrawn_.pop_back();
    }
    glDisable(GL_CULL_FACE);
    return undrawn_.empty();
}

void DiskPass::use_colors(ShaderProgram& program, const DrawList& list, DrawStatistics& statistics) {
    glActiveTexture(GL_TEXTURE0 + kColors);
    store_colors(statistics);
    glBindTexture(GL_TEXTURE_2D, colors_.name());
    glActiveTexture(GL_TEXTURE0);
    program.set("colors", kColors);
    program.set("background", glm::vec3(list.palette.background));
}

void DiskPass::tint(const DrawList& list, const Texture& visibility, DrawStatistics& statistics) {
    tint_.use();
    use_colors(tint_, list, statistics);
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    const bool multisampled = samples > 0;
    glActiveTexture(GL_TEXTURE0 + (multisampled ? kVisibilitySamples : kVisibility));
    glBindTexture(multisampled ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D, visibility.name());
    glActiveTexture(GL_TEXTURE0);
    tint_.set("visibility", kVisibility);
    tint_.set("visibility_samples", kVisibilitySamples);
    tint_.set("sample_index", -1);
    tint_.set("viewport", list.size);
    std::vector<BoxInstance> around;
    for (const DiskBlock& block : levels_->blocks()) {
        if (!block_may_be_seen(block, list.projection, slab_of(list))) continue;
        BoxInstance& box = around.emplace_back();
        box.center = block.middle;
        for (int axis = 0; axis < 3; ++axis) box.extents[static_cast<std::size_t>(axis)][axis] = block.reach;
    }
    if (!tiles_.cover(around, list.projection, statistics)) return;
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    if (multisampled) glEnable(GL_SAMPLE_MASK);
    for (GLint sample = 0; sample < std::max(samples, 1); ++sample) {
        if (multisampled) {
            glSampleMaski(0, 1u << sample);
            tint_.set("sample_index", sample);
        }
        tiles_.draw(statistics);
    }
    glDisable(GL_SAMPLE_MASK);
}

}  // namespace mobbscope
