/// The boxes of a draw list on the GPU, for their faces and their edges.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// In drawing order. The shapes stay as long as lists have the same; how boxes look may change with every camera.
class BoxBuffer {
  public:
    struct Shape {
        glm::vec3 center;
        glm::vec3 extents[3];
        GLuint id[2];  ///< (0, 0): of nothing that can be pointed at
        friend bool operator==(const Shape&, const Shape&) = default;
    };
    struct Look {
        Rgba fill;
        Rgba edge;
        Dash dash;
        glm::vec3 line;  ///< width and cap in pixels, opacity kept when hidden
        friend bool operator==(const Look&, const Look&) = default;
    };

    void keep(const DrawnWorld& world, DrawStatistics& statistics);

    std::size_t size() const { return shapes_.size(); }
    const std::vector<DrawOrder>& orders() const { return orders_; }
    const std::vector<Look>& looks() const { return looks_; }
    const std::vector<Shape>& shapes() const { return shapes_; }
    const Buffer& shape_buffer() const { return shape_buffer_; }
    const Buffer& look_buffer() const { return look_buffer_; }

  private:
    std::vector<Shape> shapes_;
    std::vector<Look> looks_;
    std::vector<DrawOrder> orders_;
    Buffer shape_buffer_, look_buffer_;
};

}  // namespace mobbscope
