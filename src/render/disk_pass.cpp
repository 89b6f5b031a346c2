#include <render/disk_pass.h>
#include <render/disk_runs.h>
#include <render/light.h>
#include <render/vertex_layout.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

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
constexpr float tolerance(Detail detail) { return detail == Detail::fine ? 0.17f : 0.45f; }

/// Enough sides that the largest disk looks round.
int sides_for(const DrawList& list, Detail detail) {
    const PixelScale scale(list.lens);
    float radius = 0;
    for (const DiskInstance& disk : list.disks) radius = std::max(radius, disk.radius * scale.at(disk.base));
    const float off = std::min(1.0f, tolerance(detail) / std::max(radius, 0.2f));
    const float sides = std::numbers::pi_v<float> / std::acos(1 - off);
    return std::clamp(4 * static_cast<int>(std::ceil(sides / 4)), detail == Detail::fine ? 12 : 8, 128);
}

}  // namespace

DiskPass::DiskPass(GlContext& context) : program_(context, "disk") {
    describe(single_);
    describe(runs_);
}

void DiskPass::describe(const Batch& batch) const {
    glBindVertexArray(batch.array.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    const VertexLayout corner(sizeof(Vertex), 0);
    corner.floats(0, 3, offsetof(Vertex, corner));
    corner.floats(1, 3, offsetof(Vertex, normal));
    glBindBuffer(GL_ARRAY_BUFFER, batch.instances.name());
    const VertexLayout disk(sizeof(Instance), 1);
    disk.floats(2, 4, offsetof(Instance, base));
    disk.floats(3, 4, offsetof(Instance, top));
    disk.floats(4, 4, offsetof(Instance, color));
    disk.integers(5, 2, offsetof(Instance, id));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
}

/// Side, upper face and lower face, in this order, so that the face that cannot be seen is left out.
void DiskPass::make_cylinder(int segments) {
    if (segments == segments_) return;
    segments_ = segments;
    std::vector<Vertex> vertices;
    std::vector<GLushort> indices;
    const auto add = [&](glm::vec3 corner, glm::vec3 normal) {
        vertices.push_back({corner, normal});
        return static_cast<GLushort>(vertices.size() - 1);
    };
    const auto direction = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / segments;
        return glm::vec3(glm::dvec3(std::cos(angle), std::sin(angle), 0));
    };
    const glm::vec3 up(0, 0, 1);
    for (int i = 0; i <= segments; ++i) {
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
        for (int i = 1; i <= segments; ++i) {
            const GLushort b = add(direction(i) + level, normal);
            const GLushort a = static_cast<GLushort>(b - 1);
            indices.insert(indices.end(), {middle, upper ? a : b, upper ? b : a});
        }
    }
    upload(vertices_, vertices);
    upload(indices_, indices, GL_ELEMENT_ARRAY_BUFFER);
}

/// Sides, and the one face of each disk that can be seen.
void DiskPass::draw_single(const std::vector<Instance>& disks, Face face) {
    if (disks.empty()) return;
    upload(single_.instances, disks);
    const GLsizei count = static_cast<GLsizei>(disks.size());
    const GLsizei of_side = 6 * segments_;
    const GLsizei of_face = 3 * segments_;
    if (face == Face::upper) {
        glDrawElementsInstanced(GL_TRIANGLES, of_side + of_face, GL_UNSIGNED_SHORT, nullptr, count);
        return;
    }
    glDrawElementsInstanced(GL_TRIANGLES, of_side, GL_UNSIGNED_SHORT, nullptr, count);
    const std::size_t begin = sizeof(GLushort) * static_cast<std::size_t>(of_side + of_face);
    glDrawElementsInstanced(GL_TRIANGLES, of_face, GL_UNSIGNED_SHORT, reinterpret_cast<const void*>(begin), count);
}

void DiskPass::draw(const DrawList& list, Detail detail) {
    if (list.disks.empty()) return;
    DiskGroups groups;
    groups.single = in_order(list.disks);
    if (detail == Detail::coarse) groups = group_runs(groups.single, list.lens, tolerance(detail));
    std::vector<Instance> above;
    std::vector<Instance> below;
    above.reserve(groups.single.size());
    for (const DiskInstance* disk : groups.single) {
        const glm::vec3 top = disk->base + glm::vec3(0, 0, disk->height);
        std::vector<Instance>& seen_from = list.lens.below(disk->base.z) ? below : above;
        seen_from.push_back({disk->base, disk->radius, top, disk->radius, disk->color, {disk->id.r(), disk->id.g()}});
    }
    std::vector<Instance> runs;
    runs.reserve(groups.runs.size());
    for (const DiskRun& run : groups.runs) {
        runs.push_back({run.base, run.radius, run.top, run.top_radius, run.color, {0, 0}});
    }

    glBindVertexArray(single_.array.name());
    make_cylinder(sides_for(list, detail));
    program_.use();
    glUniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(list.lens.clip_from_world));
    glUniform3fv(program_.uniform("light"), 1, glm::value_ptr(towards_light(list.lens)));
    glUniform1f(program_.uniform("scale"), PixelScale(list.lens).near());
    glUniform3fv(program_.uniform("back"), 1, glm::value_ptr(list.lens.back));
    glUniform3fv(program_.uniform("background"), 1, glm::value_ptr(list.palette.background));
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);

    glUniform1i(program_.uniform("runs"), 0);
    draw_single(above, Face::upper);
    draw_single(below, Face::lower);
    if (!runs.empty()) {
        glUniform1i(program_.uniform("runs"), 1);
        glBindVertexArray(runs_.array.name());
        upload(runs_.instances, runs);
        // Their ends lie within the path; its last disk is a single one.
        glDrawElementsInstanced(GL_TRIANGLES, 6 * segments_, GL_UNSIGNED_SHORT, nullptr,
                                static_cast<GLsizei>(runs.size()));
    }
    glDisable(GL_CULL_FACE);
}

}  // namespace mobbscope
