/// Turns draw lists into pixels.
#pragma once

#include <render/draw_list.h>
#include <render/gl_context.h>
#include <render/image.h>
#include <render/object_id.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The smallest and largest side of a picture, and the most pixels that it may have.
inline constexpr int kMinSide = 64;
inline constexpr int kMaxSide = 8192;
inline constexpr int kMaxPixels = 7680 * 4320;

/// Holds a context and what it keeps between pictures. Pictures depend on the draw list alone. Not for several threads.
class Renderer {
  public:
    /// Throws MachineError if there is no such context.
    explicit Renderer(Backend backend = Backend::automatic);
    ~Renderer();

    /// The backend in use, "osmesa" or "egl".
    std::string_view backend() const;

    /// What the shader compiler remarked.
    const std::vector<std::string>& warnings() const;

    /// Draws and reads back. Throws MachineError if OpenGL reports an error.
    Image draw(const DrawList& list);

    /// What is nearest in each pixel: disks, and the boxes of nodes whether or not their faces are shown.
    IdImage draw_ids(const DrawList& list);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace mobbscope
