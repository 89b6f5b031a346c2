/// Draws the disks: opaque, instanced, lit.
#pragma once

#include <render/draw_list.h>
#include <render/gl_objects.h>

namespace mobbscope {

class DiskPass {
  public:
    explicit DiskPass(GlContext& context);

    /// Into the bound framebuffer, colours to output 0 and ids to output 1.
    void draw(const DrawList& list);

  private:
    void make_cylinder(int segments);

    ShaderProgram program_;
    VertexArray array_;
    Buffer vertices_;
    Buffer indices_;
    Buffer instances_;
    int segments_ = 0;
};

}  // namespace mobbscope
