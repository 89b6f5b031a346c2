#include <render/drawlist/draw_list.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/face_pass.h>
#include <render/gl/gl_objects.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace mobbscope {

namespace {

bool has_faces(const BoxInstance& box) { return box.fill.a > 0; }

}  // namespace

FacePass::FacePass(GlContext& context, const BoxBuffer& boxes)
    : boxes_(boxes),
      begin_(context, "composite", "face_begin"),
      faces_(context, "face"),
      composite_(context, "composite") {
    glBindVertexArray(array_.name());
    boxes.describe_shapes({}).integers(5, 2, offsetof(BoxBuffer::Shape, id));
    boxes.looks_from({}).floats(4, 4, offsetof(BoxBuffer::Look, fill));
}

bool FacePass::needed(const DrawnWorld& world) {
    return std::any_of(world.boxes.begin(), world.boxes.end(), has_faces);
}

void FacePass::draw(const DrawList& list, bool ids, DrawStatistics& statistics) {
    if (boxes_.size() == 0) return;
    glBindVertexArray(array_.name());
    faces_.use();
    faces_.set("clip_from_world", list.projection.clip_from_world);
    faces_.set("depth_range", glm::vec2(list.projection.near_depth, list.projection.far_depth));
    faces_.set("perspective", list.projection.perspective);
    faces_.set("ids", ids);
    faces_.set("slab", slab_of(list));
    faces_.set("cut", list.slab && list.slab->cuts_boxes);
    for (GLenum plane = 0; list.slab && plane < 2; ++plane) glEnable(GL_CLIP_DISTANCE0 + plane);
    faces_.set("light", towards_light(list.projection));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(boxes_.size()));
    for (GLenum plane = 0; list.slab && plane < 2; ++plane) glDisable(GL_CLIP_DISTANCE0 + plane);
    statistics.triangles += 12 * boxes_.size();
    ++statistics.draw_calls;
}

/// Only what faces may cover is prepared and blended: these are the dearest pixels of a picture.
void FacePass::begin(const DrawList& list, const Texture* depth_samples, DrawStatistics& statistics) {
    std::vector<BoxInstance> boxes;
    std::copy_if(list.boxes.begin(), list.boxes.end(), std::back_inserter(boxes), has_faces);
    if (!tiles_.cover(boxes, list.projection, statistics)) return;
    begin_.use();
    begin_.set("viewport", list.size);
    begin_.set("depth_samples", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, depth_samples ? depth_samples->name() : 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(depth_samples ? GL_TRUE : GL_FALSE);
    glDisable(GL_BLEND);
    tiles_.draw(statistics);
}

void FacePass::accumulate(const DrawList& list, const Texture* depth_samples, DrawStatistics& statistics) {
    begin(list, depth_samples, statistics);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    // Colours add up; alpha keeps the product of (1 - opacity).
    glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
    draw(list, false, statistics);
}

void FacePass::composite(const Texture& sums, const Texture& weights, PictureSize size, DrawStatistics& statistics) {
    glDisable(GL_DEPTH_TEST);
    blend_over();
    composite_.use();
    composite_.set("sums", 0);
    composite_.set("weights", 1);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, weights.name());
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sums.name());
    composite_.set("viewport", size);
    tiles_.draw(statistics);
}

void FacePass::draw_ids(const DrawList& list, DrawStatistics& statistics) {
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    draw(list, true, statistics);
}

}  // namespace mobbscope
