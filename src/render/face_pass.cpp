#include <render/face_pass.h>
#include <render/gl_state.h>
#include <render/light.h>
#include <render/vertex_layout.h>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace mobbscope {

namespace {

struct Instance {
    glm::vec3 center;
    glm::vec3 extents[3];
    Rgba fill;
    GLuint id[2];
};

bool has_faces(const BoxInstance& box) { return box.fill.a > 0; }

}  // namespace

FacePass::FacePass(GlContext& context) : faces_(context, "face"), composite_(context, "composite") {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const VertexLayout box(sizeof(Instance), 1);
    box.floats(0, 3, offsetof(Instance, center));
    for (GLuint axis = 0; axis < 3; ++axis) {
        box.floats(1 + axis, 3, offsetof(Instance, extents) + axis * sizeof(glm::vec3));
    }
    box.floats(4, 4, offsetof(Instance, fill));
    box.integers(5, 2, offsetof(Instance, id));
}

bool FacePass::needed(const DrawList& list) { return std::any_of(list.boxes.begin(), list.boxes.end(), has_faces); }

void FacePass::draw(const DrawList& list, bool ids) {
    std::vector<Instance> instances;
    for (const BoxInstance* box : in_order(list.boxes)) {
        if (ids ? !box->pickable : !has_faces(*box)) continue;
        instances.push_back(
            {box->center, {box->extents[0], box->extents[1], box->extents[2]}, box->fill, {box->id.r(), box->id.g()}});
    }
    if (instances.empty()) return;
    glBindVertexArray(array_.name());
    upload(instances_, instances);
    faces_.use();
    glUniformMatrix4fv(faces_.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(list.lens.clip_from_world));
    glUniform2f(faces_.uniform("depth_range"), list.lens.near_depth, list.lens.far_depth);
    glUniform1i(faces_.uniform("perspective"), list.lens.perspective);
    glUniform3fv(faces_.uniform("light"), 1, glm::value_ptr(towards_light(list.lens)));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(instances.size()));
}

void FacePass::accumulate(const DrawList& list) {
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    // Colours add up; alpha keeps the product of (1 - opacity).
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    draw(list, false);
}

void FacePass::composite(const Texture& sums, const Texture& weights) {
    glBindVertexArray(nothing_.name());
    glDisable(GL_DEPTH_TEST);
    blend_over();
    composite_.use();
    glUniform1i(composite_.uniform("sums"), 0);
    glUniform1i(composite_.uniform("weights"), 1);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, weights.name());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sums.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FacePass::draw_ids(const DrawList& list) {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    draw(list, true);
}

}  // namespace mobbscope
