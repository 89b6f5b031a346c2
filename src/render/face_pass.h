/// Draws the faces of boxes: transparent, in no particular order.
#pragma once

#include <render/draw_list.h>
#include <render/gl_objects.h>

namespace mobbscope {

class FacePass {
  public:
    explicit FacePass(GlContext& context);

    /// True if the list has faces to blend.
    static bool needed(const DrawList& list);

    /// Sums the faces into the bound framebuffer (see Targets::faces), which need not be cleared.
    void accumulate(const DrawList& list);
    /// Blends the sums of the last accumulate over the bound framebuffer.
    void composite(const Texture& sums, const Texture& weights, PictureSize size);
    /// Writes the ids of node boxes, faces drawn or not, to output 2, nearest first.
    void draw_ids(const DrawList& list);

  private:
    void clear(const DrawList& list);
    void draw(const DrawList& list, bool ids);

    ShaderProgram faces_;
    ShaderProgram composite_;
    VertexArray array_;
    Buffer instances_;
    VertexArray tile_array_;
    Buffer tiles_;
    GLsizei tile_count_ = 0;
};

}  // namespace mobbscope
