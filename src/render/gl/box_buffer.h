/// The boxes of a draw list on the GPU, for their faces and their edges.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// How a line, or the edges of a box, are drawn.
struct LineLook {
    Rgba color;
    Dash dash;
    glm::vec3 shape;  ///< width and cap in pixels, opacity kept when hidden
    friend bool operator==(const LineLook&, const LineLook&) = default;
};

/// What takes the place of an id where there is none: the half of a sheet, and what a slab cuts whatever it does with
/// boxes.
inline constexpr GLuint kTriangle = 1;
inline constexpr GLuint kSheet = 2;

/// From where to where a picture's world is drawn, for shaders: far beyond it where it has no slab.
glm::vec2 slab_of(const DrawnWorld& world);

/// How the edges of a box are drawn.
LineStyle edge_style(const BoxInstance& box);

/// In drawing order. The shapes stay as long as lists have the same; how boxes look may change with every camera.
class BoxBuffer {
  public:
    struct Shape {
        glm::vec3 center;
        glm::vec3 extents[3];
        /// Of nothing that can be pointed at (0, 0), or kTriangle, or kSheet.
        GLuint id[2];
        friend bool operator==(const Shape&, const Shape&) = default;
    };
    struct Look {
        Rgba fill;
        LineLook line;
        friend bool operator==(const Look&, const Look&) = default;
    };

    void keep(const DrawnWorld& world, DrawStatistics& statistics);

    std::size_t size() const { return shapes_.size(); }
    const std::vector<DrawOrder>& orders() const { return orders_; }
    const std::vector<Look>& looks() const { return looks_; }
    const std::vector<Shape>& shapes() const { return shapes_; }

    /// Describes centres (attribute 0) and extents (1 to 3).
    VertexLayout<Shape> describe_shapes(InstanceRange range) const {
        const VertexLayout<Shape> out(shape_buffer_, 1, range);
        out.floats(0, 3, offsetof(Shape, center));
        for (GLuint i = 0; i < 3; ++i) out.floats(1 + i, 3, offsetof(Shape, extents) + i * sizeof(glm::vec3));
        return out;
    }
    VertexLayout<Look> looks_from(InstanceRange range) const { return VertexLayout<Look>(look_buffer_, 1, range); }

  private:
    std::vector<Shape> shapes_;
    std::vector<Look> looks_;
    std::vector<DrawOrder> orders_;
    Buffer shape_buffer_, look_buffer_;
};

}  // namespace mobbscope
