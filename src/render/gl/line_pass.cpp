#include <render/gl/gl_objects.h>
#include <render/gl/line_pass.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace mobbscope {

struct LinePass::Instance {
    glm::vec3 from;
    glm::vec3 to;
    Rgba color;
    Dash dash;
    glm::vec3 shape;
};

namespace {

/// How strongly the edges of a box show through disks.
constexpr float kHiddenEdge = 0.38f;

/// The twelve edges, each from the corner with the lower number.
void add_edges(const BoxInstance& box, std::vector<LineInstance>& lines) {
    if (box.edge.a <= 0) return;
    const auto corner = [&](unsigned bits) {
        glm::vec3 p = box.center;
        for (unsigned axis = 0; axis < 3; ++axis) p += box.extents[axis] * ((bits >> axis) & 1u ? 1.0f : -1.0f);
        return p;
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (unsigned bits = 0; bits < 8; ++bits) {
            if ((bits >> axis) & 1u) continue;
            // The order is the box's: all its edges look alike.
            lines.push_back({corner(bits), corner(bits | (1u << axis)), box.edge, box.width, box.dash, kHiddenEdge,
                             box.width * 0.5f, box.order});
        }
    }
}

}  // namespace

LinePass::LinePass(GlContext& context) : program_(context, "line") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout line(sizeof(Instance), 1);
    line.floats(0, 3, offsetof(Instance, from));
    line.floats(1, 3, offsetof(Instance, to));
    line.floats(2, 4, offsetof(Instance, color));
    line.floats(3, 4, offsetof(Instance, dash));
    line.floats(4, 3, offsetof(Instance, shape));
}

void LinePass::begin(const std::vector<Instance>& instances, const glm::mat4& clip_from_world, PictureSize size) {
    glBindVertexArray(array_.name());
    upload(instances_, instances);
    program_.use();
    glUniformMatrix4fv(program_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip_from_world));
    glUniform2f(program_.uniform("viewport"), static_cast<float>(size.width), static_cast<float>(size.height));
    glUniform1i(program_.uniform("hidden"), 0);
    glUniform1f(program_.uniform("depth_bias"), 0);
    blend_over();
    glDepthMask(GL_FALSE);
}

void LinePass::draw_scene(const DrawList& list) {
    std::vector<LineInstance> lines;
    lines.reserve(list.lines.size() + 12 * list.boxes.size());
    lines = list.lines;
    for (const BoxInstance* box : in_order(list.boxes)) add_edges(*box, lines);
    if (lines.empty()) return;
    std::vector<Instance> instances;
    instances.reserve(lines.size());
    bool some_show_through = false;
    for (const LineInstance* line : in_order(lines)) {
        instances.push_back(
            {line->from, line->to, line->color, line->dash, glm::vec3(line->width, line->cap, line->hidden)});
        some_show_through = some_show_through || line->hidden > 0;
    }
    begin(instances, list.projection.clip_from_world, list.size);
    // Edges touch the disks that they bound; they lie in front of them, and the same edge must not be taken for hidden.
    glUniform1f(program_.uniform("depth_bias"), 8e-4f);
    glEnable(GL_DEPTH_TEST);
    const GLsizei count = static_cast<GLsizei>(instances.size());
    if (some_show_through) {
        glDepthFunc(GL_GREATER);
        glUniform1i(program_.uniform("hidden"), 1);
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
        glUniform1i(program_.uniform("hidden"), 0);
    }
    glDepthFunc(GL_LEQUAL);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count);
}

void LinePass::draw_overlay(const DrawList& list) {
    if (list.overlay_lines.empty()) return;
    std::vector<Instance> instances;
    for (const OverlayLine& line : list.overlay_lines) {
        instances.push_back(
            {glm::vec3(line.from, 0), glm::vec3(line.to, 0), line.color, line.dash, glm::vec3(line.width, 0, 0)});
    }
    glm::mat4 pixels(1);
    pixels[0][0] = 2 / static_cast<float>(list.size.width);
    pixels[1][1] = -2 / static_cast<float>(list.size.height);
    pixels[3] = {-1, 1, 0, 1};
    begin(instances, pixels, list.size);
    glDisable(GL_DEPTH_TEST);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
}

}  // namespace mobbscope
