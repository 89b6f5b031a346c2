#include <base/text.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/render.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mobbscope {

void check(PictureSize size) {
    const auto within = [](int side) { return side >= kMinSide && side <= kMaxSide; };
    if (within(size.width) && within(size.height) && std::int64_t{size.width} * size.height <= kMaxPixels) return;
    throw std::invalid_argument("a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
                                " pixels cannot be made: each side must be " + std::to_string(kMinSide) + " to " +
                                std::to_string(kMaxSide) + ", and there may be at most " + std::to_string(kMaxPixels) +
                                " in all");
}

PictureSize parse_size(const std::string& text) {
    const std::size_t x = text.find('x');
    const std::optional<int> width = parse_int(std::string_view(text).substr(0, x));
    const std::optional<int> height =
        x == std::string::npos ? std::nullopt : parse_int(std::string_view(text).substr(x + 1));
    if (!width || !height)
        throw std::invalid_argument(in_quotes(text) + " is no size: give WIDTHxHEIGHT in pixels (1280x720)");
    const PictureSize size{*width, *height};
    check(size);
    return size;
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
