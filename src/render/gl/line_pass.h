/// Draws lines of constant width on the screen: the edges of boxes, the floor, the axes, and what is drawn over the
/// picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/box_buffer.h>
#include <render/gl/gl_objects.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// Edges touch the disks that they bound: lines come forward by so much of depths from -1 to 1, but by no more than
/// most_line_bias in clip space, so that the same edge is not taken for hidden.
inline constexpr float kLineDepthBias = 8e-4f;
float most_line_bias(const ViewProjection& projection);

class LinePass {
  public:
    /// `boxes`: of the lists that are drawn; they outlive this.
    LinePass(GlContext& context, const BoxBuffer& boxes);

    /// The list's lines and the edges of its boxes, into a framebuffer with the disks' depth: what the disks hide first
    /// and fainter, then the rest. Where more boxes than `most_boxes` are in the picture, only every so manieth of
    /// them.
    void draw_scene(const DrawList& list, std::size_t most_boxes, DrawStatistics& statistics);
    /// What is pointed out, over the scene.
    void draw_highlights(const DrawList& list, DrawStatistics& statistics);
    /// The lines over the picture: uploads the list's; draws what was uploaded.
    void keep_overlay(const DrawnOverlay& overlay, DrawStatistics& statistics);
    void draw_overlay(PictureSize size, DrawStatistics& statistics);

  private:
    struct Instance;
    /// Successive lines, or boxes whose edges are drawn; `count` before steps leave some out.
    struct Batch {
        bool of_boxes = false;
        std::size_t count = 0;
        InstanceRange range{};
    };
    void begin(const glm::mat4& clip_from_world, PictureSize size);
    std::vector<Batch> batches(const DrawList& list, const std::vector<const LineInstance*>& lines,
                               std::size_t most_boxes) const;
    /// `lines`: what a batch of lines is of.
    void draw(const Batch& batch, const Buffer& lines, DrawStatistics& statistics);

    const BoxBuffer& boxes_;
    ShaderProgram program_;
    VertexArray line_array_, box_array_;
    Buffer scene_lines_, highlights_, overlay_lines_;
    std::size_t overlay_count_ = 0;
};

}  // namespace mobbscope
