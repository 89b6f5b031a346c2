/// The parts of a picture that something is worked out in pixel by pixel, as that is dear.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// Disjoint rectangles in whole pixels, inside the picture, that together cover all these boxes.
std::vector<Rect> covering_tiles(std::span<const BoxInstance> boxes, const ViewProjection& projection);

/// Rectangles on the GPU: attribute 0 of composite.vert.
class Tiles {
  public:
    Tiles();
    /// Uploads those that cover the boxes; returns what lies around them all, nothing of none.
    std::optional<Rect> cover(std::span<const BoxInstance> boxes, const ViewProjection& projection,
                              DrawStatistics& statistics);
    /// Draws them by the program in use.
    void draw(DrawStatistics& statistics) const;

  private:
    VertexArray array_;
    Buffer rectangles_;
    std::size_t count_ = 0;
};

}  // namespace mobbscope
