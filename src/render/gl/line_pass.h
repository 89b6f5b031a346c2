/// Draws lines of constant width on the screen: the edges of boxes, the floor, the axes, and what is drawn over the
/// picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

namespace mobbscope {

class LinePass {
  public:
    explicit LinePass(GlContext& context);

    /// The list's lines and the edges of its boxes, into a framebuffer with the disks' depth: what the disks hide first
    /// and fainter, then the rest.
    void draw_scene(const DrawList& list);
    /// The lines over the picture.
    void draw_overlay(const DrawList& list);

  private:
    struct Instance;
    void begin(const std::vector<Instance>& instances, const glm::mat4& clip_from_world, PictureSize size);

    ShaderProgram program_;
    VertexArray array_;
    Buffer instances_;
};

}  // namespace mobbscope
