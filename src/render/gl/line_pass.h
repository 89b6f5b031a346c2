/// Draws lines of constant width on the screen: the edges of boxes, the floor, the axes, and what is drawn over the
/// picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/box_buffer.h>
#include <render/gl/gl_objects.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

class LinePass {
  public:
    /// `boxes`: of the lists that are drawn; they outlive this.
    LinePass(GlContext& context, const BoxBuffer& boxes);

    /// The list's lines and the edges of its boxes, into a framebuffer with the disks' depth: what the disks hide first
    /// and fainter, then the rest.
    void draw_scene(const DrawList& list, DrawStatistics& statistics);
    /// The lines over the picture.
    void draw_overlay(const DrawList& list, DrawStatistics& statistics);

  private:
    struct Instance;
    /// Successive lines, or boxes whose edges are drawn.
    struct Batch {
        bool of_boxes = false;
        std::size_t first = 0, count = 0;
    };
    void begin(const std::vector<Instance>& instances, const glm::mat4& clip_from_world, PictureSize size,
               DrawStatistics& statistics);
    std::vector<Batch> batches(const std::vector<const LineInstance*>& lines) const;
    void draw(const Batch& batch, DrawStatistics& statistics);
    void bind_lines(std::size_t first);
    void bind_boxes(std::size_t first);

    const BoxBuffer& boxes_;
    ShaderProgram program_;
    VertexArray line_array_, box_array_;
    Buffer instances_;
};

}  // namespace mobbscope
