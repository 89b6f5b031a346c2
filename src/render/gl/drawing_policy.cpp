#include <render/gl/drawing_policy.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace mobbscope {

DrawingPolicy DrawingPolicy::of(std::string_view device) {
    // Mesa's, Google's and Microsoft's software renderers.
    constexpr std::array<std::string_view, 7> kSoftware{"llvmpipe",    "softpipe", "swrast", "Software Rasterizer",
                                                        "SwiftShader", "SWR",      "GDI"};
    DrawingPolicy out;
    out.errors_at_once = std::getenv("MOBBSCOPE_GL_DEBUG") != nullptr;
    if (std::ranges::any_of(kSoftware, [&](std::string_view name) { return device.find(name) != device.npos; })) {
        out.coarse_first = out.slices = out.finishes = true;
        out.most_sides = std::size_t{1} << 18;
    }
    return out;
}

}  // namespace mobbscope
