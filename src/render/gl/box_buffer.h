/// The boxes of a draw list on the GPU, for their faces and their edges.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/gl_objects.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
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

    std::size_t size() const { return shapes_.items.size(); }
    const std::vector<DrawOrder>& orders() const { return orders_; }
    const std::vector<Look>& looks() const { return looks_.items; }
    const std::vector<Shape>& shapes() const { return shapes_.items; }

    /// Describes centres (attribute 0) and extents (1 to 3).
    VertexLayout<Shape> describe_shapes(InstanceRange range) const {
        const VertexLayout<Shape> out(shapes_.buffer, 1, range);
        out.floats(0, 3, offsetof(Shape, center));
        for (GLuint i = 0; i < 3; ++i) out.floats(1 + i, 3, offsetof(Shape, extents) + i * sizeof(glm::vec3));
        return out;
    }
    VertexLayout<Look> looks_from(InstanceRange range) const { return VertexLayout<Look>(looks_.buffer, 1, range); }

  private:
    /// What a buffer holds.
    template <class T>
    struct Held {
        std::vector<T> items;
        Buffer buffer;
        std::size_t room = 0;  ///< items that the buffer has room for

        /// Uploads all from the first that differs on: the plane of a time cursor that moves, and the sections on it,
        /// are the last. Returns how many bytes these are.
        std::size_t take(std::vector<T> next) {
            constexpr std::size_t kSpare = 256;  // sections come and go
            auto first = static_cast<std::size_t>(std::ranges::mismatch(next, items).in1 - next.begin());
            items = std::move(next);
            if (first == items.size()) return 0;
            glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
            if (items.size() > room) {
                room = items.size() + kSpare;
                glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(room * sizeof(T)), nullptr, GL_STREAM_DRAW);
                first = 0;
            }
            const std::size_t bytes = (items.size() - first) * sizeof(T);
            glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(T)), static_cast<GLsizeiptr>(bytes),
                            items.data() + first);
            return bytes;
        }
    };

    Held<Shape> shapes_;
    Held<Look> looks_;
    std::vector<DrawOrder> orders_;
};

}  // namespace mobbscope
