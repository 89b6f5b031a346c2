#include <render/disk_pass.h>
#include <render/light.h>
#include <render/vertex_layout.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mobbscope {

namespace {

struct Vertex {
    glm::vec3 corner;
    glm::vec3 normal;
};

struct Instance {
    glm::vec3 base;
    float radius;
    float height;
    Rgba color;
    GLuint id[2];
};

/// Enough sides that the largest disk looks round: its outline is within a sixth of a pixel of a circle.
int sides_for(const DrawList& list) {
    float radius = 0;
    for (const DiskInstance& disk : list.disks) {
        radius = std::max(radius, disk.radius * list.lens.pixels_per_metre(disk.base));
    }
    const float sides = std::numbers::pi_v<float> / std::acos(1 - std::min(1.0f, 0.17f / std::max(radius, 0.2f)));
    return std::clamp(4 * static_cast<int>(std::ceil(sides / 4)), 12, 128);
}

}  // namespace

DiskPass::DiskPass(GlContext& context) : program_(context, "disk") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    const VertexLayout corner(sizeof(Vertex), 0);
    corner.floats(0, 3, offsetof(Vertex, corner));
    corner.floats(1, 3, offsetof(Vertex, normal));
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout disk(sizeof(Instance), 1);
    disk.floats(2, 4, offsetof(Instance, base));
    disk.floats(3, 1, offsetof(Instance, height));
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
    for (int i = 0; i < segments; ++i) {
        const glm::vec3 here = direction(i);
        const glm::vec3 next = direction(i + 1);
        const GLushort a = add(here, here);
        const GLushort b = add(next, next);
        const GLushort c = add(here + up, here);
        const GLushort d = add(next + up, next);
        indices.insert(indices.end(), {a, b, c, c, b, d});
    }
    for (const bool upper : {true, false}) {
        const glm::vec3 level = upper ? up : glm::vec3(0);
        const glm::vec3 normal = upper ? up : -up;
        const GLushort middle = add(level, normal);
        for (int i = 0; i < segments; ++i) {
            const GLushort a = add(direction(i) + level, normal);
            const GLushort b = add(direction(i + 1) + level, normal);
            indices.insert(indices.end(), {middle, upper ? a : b, upper ? b : a});
        }
    }
    upload(vertices_, vertices);
    upload(indices_, indices, GL_ELEMENT_ARRAY_BUFFER);
}

void DiskPass::draw(const DrawList& list) {
    if (list.disks.empty()) return;
    glBindVertexArray(array_.name());
    make_cylinder(sides_for(list));
    std::vector<Instance> instances;
    instances.reserve(list.disks.size());
    for (const DiskInstance* disk : in_order(list.disks)) {
        instances.push_back({disk->base, disk->radius, disk->height, disk->color, {disk->id.r(), disk->id.g()}});
    }
    upload(instances_, instances);

    program_.use();
    glUniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(list.lens.clip_from_world));
    glUniform3fv(program_.uniform("light"), 1, glm::value_ptr(towards_light(list.lens)));
    glUniform3fv(program_.uniform("background"), 1, glm::value_ptr(list.palette.background));
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
    glEnable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    const bool from_above = list.lens.back.z >= 0;
    const GLsizei count = static_cast<GLsizei>(instances.size());
    const GLsizei side = 6 * segments_;
    if (from_above) {
        glDrawElementsInstanced(GL_TRIANGLES, side + 3 * segments_, GL_UNSIGNED_SHORT, nullptr, count);
    } else {
        glDrawElementsInstanced(GL_TRIANGLES, side, GL_UNSIGNED_SHORT, nullptr, count);
        const std::size_t lower_face = sizeof(GLushort) * static_cast<std::size_t>(side + 3 * segments_);
        glDrawElementsInstanced(GL_TRIANGLES, 3 * segments_, GL_UNSIGNED_SHORT,
                                reinterpret_cast<const void*>(lower_face), count);
    }
    glDisable(GL_CULL_FACE);
}

}  // namespace mobbscope
