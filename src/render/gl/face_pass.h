/// Draws the faces of boxes: transparent, in no particular order.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/box_buffer.h>
#include <render/gl/gl_objects.h>
#include <render/gl/tiles.h>

namespace mobbscope {

class FacePass {
  public:
    /// `boxes`: of the lists that are drawn; they outlive this.
    FacePass(GlContext& context, const BoxBuffer& boxes);

    /// True if the list has faces to blend.
    static bool needed(const DrawnWorld& world);

    /// Sums the faces into the bound framebuffer (see Targets::faces), which need not be cleared. `depth_samples`: the
    /// scene's depth, if that is multisampled, else null: then the framebuffer has it. The faces are smooth inside and
    /// their edges are drawn as lines, so one sample will do.
    void accumulate(const DrawList& list, const Texture* depth_samples, DrawStatistics& statistics);
    /// Blends the sums of the last accumulate over the bound framebuffer.
    void composite(const Texture& sums, const Texture& weights, PictureSize size, DrawStatistics& statistics);
    /// Writes the ids of node boxes, faces drawn or not, to output 2, nearest first.
    void draw_ids(const DrawList& list, DrawStatistics& statistics);

  private:
    void begin(const DrawList& list, const Texture* depth_samples, DrawStatistics& statistics);
    void draw(const DrawList& list, bool ids, DrawStatistics& statistics);

    const BoxBuffer& boxes_;
    ShaderProgram begin_, faces_, composite_;
    VertexArray array_;
    Tiles tiles_;
};

}  // namespace mobbscope
