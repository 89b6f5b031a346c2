#include <render/drawlist/view_projection.h>
#include <render/gl/disk_pass.h>
#include <render/gl/disk_runs.h>
#include <render/gl/gl_objects.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

namespace mobbscope {

struct DiskPass::Instance {
    glm::vec3 base;
    float radius;
    glm::vec3 top;
    float top_radius;
    Rgba color;
    GLuint id[2];
};

namespace {

struct Vertex {
    glm::vec3 corner;
    glm::vec3 normal;
};

/// Pixels that a shape may be off.
constexpr float tolerance(Detail detail) { return detail == Detail::fine ? 0.17f : 0.9f; }

/// Enough sides that a disk of so many pixels looks round.
float sides_for(float radius, Detail detail) {
    const float off = std::min(1.0f, tolerance(detail) / std::max(radius, 0.2f));
    return std::numbers::pi_v<float> / std::acos(1 - off);
}

/// Whether all of a disk is nearer than what is drawn, or behind the eye.
bool behind(const DiskInstance& disk, const ViewProjection& projection) {
    return projection.perspective && projection.depth(disk.base) + disk.radius + disk.height < projection.near_depth;
}

/// Enough sides for the largest disk: one mesh for all, so that their edges fit.
int fine_sides(std::span<const DiskInstance* const> disks, const ViewProjection& projection, const PixelScale& scale) {
    float radius = 0;
    for (const DiskInstance* disk : disks) {
        if (!behind(*disk, projection)) radius = std::max(radius, disk->radius * scale.at(disk->base));
    }
    return std::clamp(4 * static_cast<int>(std::ceil(sides_for(radius, Detail::fine) / 4)), 12, 128);
}

/// Each disk has as many as it needs, of a few numbers: what is far away is most of a crowd.
int coarse_sides(float radius) {
    constexpr std::array kSides{4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128};
    const float needed = sides_for(radius, Detail::coarse);
    const auto enough = std::find_if(kSides.begin(), kSides.end() - 1,
                                     [needed](int sides) { return static_cast<float>(sides) >= needed; });
    return *enough;
}

/// What is hidden by what was drawn before need not be shaded.
void nearest_first(DiskGroups& groups, const ViewProjection& projection) {
    std::ranges::sort(groups.single, {},
                      [&projection](const DiskInstance* disk) { return projection.depth(disk->base); });
    std::ranges::sort(groups.runs, {}, [&projection](const DiskRun& run) { return projection.depth(run.base); });
}

}  // namespace

DiskPass::DiskPass(GlContext& context) : program_(context, "disk") {}

/// Side, upper face and lower face, in this order, so that the face that cannot be seen is left out.
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
    const auto direction = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        return glm::vec3(glm::dvec3(std::cos(angle), std::sin(angle), 0));
    };
    const glm::vec3 up(0, 0, 1);
    for (int i = 0; i <= sides; ++i) {
        const GLushort below = add(direction(i), direction(i));
        const GLushort above = add(direction(i) + up, direction(i));
        if (i == 0) continue;
        const GLushort a = static_cast<GLushort>(below - 2);
        const GLushort c = static_cast<GLushort>(above - 2);
        indices.insert(indices.end(), {a, below, c, c, below, above});
    }
    for (const bool upper : {true, false}) {
        const glm::vec3 level = upper ? up : glm::vec3(0);
        const glm::vec3 normal = upper ? up : -up;
        const GLushort middle = add(level, normal);
        add(direction(0) + level, normal);
        for (int i = 1; i <= sides; ++i) {
            const GLushort b = add(direction(i) + level, normal);
            const GLushort a = static_cast<GLushort>(b - 1);
            indices.insert(indices.end(), {middle, upper ? a : b, upper ? b : a});
        }
    }
    glBindVertexArray(made.array.name());
    upload(made.vertices, vertices);
    const VertexLayout corner(sizeof(Vertex), 0);
    corner.floats(0, 3, offsetof(Vertex, corner));
    corner.floats(1, 3, offsetof(Vertex, normal));
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout disk(sizeof(Instance), 1);
    disk.floats(2, 4, offsetof(Instance, base));
    disk.floats(3, 4, offsetof(Instance, top));
    disk.floats(4, 4, offsetof(Instance, color));
    disk.integers(5, 2, offsetof(Instance, id));
    upload(made.indices, indices, GL_ELEMENT_ARRAY_BUFFER);
    return made;
}

void DiskPass::draw(const Cylinder& cylinder, const std::vector<Instance>& instances, Part part) const {
    if (instances.empty()) return;
    glBindVertexArray(cylinder.array.name());
    upload(instances_, instances);
    const GLsizei count = static_cast<GLsizei>(instances.size());
    const GLsizei of_side = 6 * cylinder.sides;
    const GLsizei of_face = 3 * cylinder.sides;
    const GLsizei first = part == Part::side_and_upper_face ? of_side + of_face : of_side;
    glDrawElementsInstanced(GL_TRIANGLES, first, GL_UNSIGNED_SHORT, nullptr, count);
    if (part != Part::side_and_lower_face) return;
    const std::size_t begin = sizeof(GLushort) * static_cast<std::size_t>(of_side + of_face);
    glDrawElementsInstanced(GL_TRIANGLES, of_face, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(begin), count);
}

void DiskPass::draw(const DrawList& list, Detail detail) {
    if (list.disks.empty()) return;
    const PixelScale scale(list.projection);
    DiskGroups groups;
    groups.single = in_order(list.disks);
    int sides = 0;
    if (detail == Detail::coarse) {
        groups = group_runs(groups.single, list.projection, tolerance(detail));
    } else {
        sides = fine_sides(groups.single, list.projection, scale);
    }
    struct OneShape {
        std::vector<Instance> above, below, runs;
    };
    // What has more sides is nearer: first.
    std::map<int, OneShape, std::greater<>> shapes;
    const auto shape_of = [&](float radius, glm::vec3 at) -> OneShape& {
        return shapes[detail == Detail::fine ? sides : coarse_sides(radius * scale.at(at))];
    };
    if (detail == Detail::coarse) nearest_first(groups, list.projection);
    for (const DiskInstance* disk : groups.single) {
        if (behind(*disk, list.projection)) continue;
        const glm::vec3 top = disk->base + glm::vec3(0, 0, disk->height);
        OneShape& shape = shape_of(disk->radius, disk->base);
        std::vector<Instance>& seen_from = list.projection.below(disk->base.z) ? shape.below : shape.above;
        seen_from.push_back({disk->base, disk->radius, top, disk->radius, disk->color, {disk->id.r(), disk->id.g()}});
    }
    for (const DiskRun& run : groups.runs) {
        shape_of(std::max(run.radius, run.top_radius), run.base)
            .runs.push_back({run.base, run.radius, run.top, run.top_radius, run.color, {0, 0}});
    }

    program_.use();
    glUniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE,
                       glm::value_ptr(list.projection.clip_from_world));
    glUniform3fv(program_.uniform("light"), 1, glm::value_ptr(towards_light(list.projection)));
    glUniform1f(program_.uniform("scale"), scale.near());
    glUniform3fv(program_.uniform("back"), 1, glm::value_ptr(list.projection.back));
    // With two corners at the sides the outline is right, however few the others are.
    const glm::vec2 across = detail == Detail::coarse ? glm::vec2(list.projection.right) : glm::vec2(1, 0);
    glUniform2fv(program_.uniform("across"), 1, glm::value_ptr(across));
    glUniform3fv(program_.uniform("background"), 1, glm::value_ptr(list.palette.background));
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    for (const auto& [count, shape] : shapes) {
        const Cylinder& with = cylinder(count);
        glUniform1i(program_.uniform("runs"), 0);
        draw(with, shape.above, Part::side_and_upper_face);
        draw(with, shape.below, Part::side_and_lower_face);
        // The ends of runs lie within the path; its last disk is a single one.
        glUniform1i(program_.uniform("runs"), 1);
        draw(with, shape.runs, Part::side);
    }
    glDisable(GL_CULL_FACE);
}

}  // namespace mobbscope
