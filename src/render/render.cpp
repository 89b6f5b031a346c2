#include <render/build_draw_list.h>
#include <render/render.h>

#include <cstdint>
#include <stdexcept>
#include <string>

namespace mobbscope {

void check(PictureSize size) {
    const auto within = [](int side) { return side >= kMinSide && side <= kMaxSide; };
    if (within(size.width) && within(size.height) && std::int64_t{size.width} * size.height <= kMaxPixels) return;
    throw std::invalid_argument("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                " pixels cannot be made: each side must be " + std::to_string(kMinSide) + " to " +
                                std::to_string(kMaxSide) + ", and there may be at most " + std::to_string(kMaxPixels) +
                                " in all");
}

Image render(const FittedScene& fitted, const ViewState& view, PictureSize size, Renderer& renderer, double scale) {
    check(size);
    return renderer.draw(build_draw_list(fitted, view, size, scale));
}

IdImage render_ids(const FittedScene& fitted, const ViewState& view, PictureSize size, Renderer& renderer,
                   double scale) {
    check(size);
    return renderer.draw_ids(build_draw_list(fitted, view, size, scale));
}

}  // namespace mobbscope
