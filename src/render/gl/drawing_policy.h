/// What is asked of the device that draws, and when it is waited for.
#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace mobbscope {

/// By itself a GPU's: whole pictures, and nobody waits for it. Where the processor draws, a picture takes long and
/// takes that from whoever works.
struct DrawingPolicy {
    /// Of a device by its name (GL_RENDERER). Where the environment says MOBBSCOPE_GL_DEBUG, errors are told at once.
    static DrawingPolicy of(std::string_view device);

    /// While somebody works, a coarse picture stands in for a fine one that takes long, or may.
    bool coarse_first = false;
    /// Fine pictures are painted in slices, between which keys and mouse have their say.
    bool slices = false;
    /// Draw calls, and slices of which more are to come, are waited for: their time is known then, and what a processor
    /// keeps for a draw call, which of a hundred thousand disks are gigabytes, is free again.
    bool finishes = false;
    /// Sides of disks in one draw call.
    std::size_t most_sides = std::numeric_limits<std::size_t>::max();
    /// An error is told within the call that makes it, for debuggers. Else a driver tells when it likes to.
    bool errors_at_once = false;
};

}  // namespace mobbscope
