#include <render/drawlist/palette.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace mobbscope {

namespace {

constexpr float kFaintestOnDark = 1.35f;
constexpr float kFaintestOnLight = 1.5f;

constexpr std::uint32_t kOrange = 0xE69F00;
constexpr std::uint32_t kPurple = 0xCC79A7;
constexpr std::uint32_t kSkyBlue = 0x56B4E9;
constexpr std::uint32_t kBluishGreen = 0x009E73;
constexpr std::uint32_t kYellow = 0xF0E442;
constexpr std::uint32_t kVermillion = 0xD55E00;

// Viridis (van der Walt and Smith) in equal steps.
constexpr std::array<std::uint32_t, 10> kViridis{0x440154, 0x482878, 0x3E4A89, 0x31688E, 0x26828E,
                                                 0x1F9E89, 0x35B779, 0x6DCD59, 0xB4DE2C, 0xFDE725};

}  // namespace

const Palette& palette(Theme theme) {
    static const Palette dark{.background = hex(0x14181D),
                              .grid = hex(0x2B333C),
                              .axis = hex(0x7F8994),
                              .text = hex(0xE7EAEE),
                              .quiet_text = hex(0x98A2AD),
                              .panel = hex(0x1A2027, 0.92f),
                              .panel_border = hex(0x2C343D),
                              .accent = hex(kSkyBlue),
                              .apart_in_time = hex(0x9AA3AD),
                              .separated = hex(0x12B587),  // bluish green, lifted off the dark ground
                              .overlap = hex(kYellow),
                              .avoidable = hex(0xB99BFF),  // violet, no agent's colour
                              .hit = hex(0xF0701A),        // vermillion, lifted likewise
                              .dark = true};
    static const Palette light{.background = hex(0xF7F8F9),
                               .grid = hex(0xD6DBE0),
                               .axis = hex(0x68727C),
                               .text = hex(0x1D2329),
                               .quiet_text = hex(0x5A646E),
                               .panel = hex(0xFFFFFF, 0.94f),
                               .panel_border = hex(0xD2D7DC),
                               .accent = hex(0x0072B2),
                               .apart_in_time = hex(0x7A838C),
                               .separated = hex(kBluishGreen),
                               .overlap = hex(0xB9A900),  // yellow, darkened to be seen on white
                               .avoidable = hex(0x6A3FC8),
                               .hit = hex(kVermillion),
                               .dark = false};
    return theme == Theme::dark ? dark : light;
}

Rgba quantity_color(float quantity, const Palette& palette) {
    const float t = std::clamp(quantity, 0.0f, 1.0f);
    const float at = (palette.dark ? 0.3f + 0.7f * t : 0.8f * (1 - t)) * static_cast<float>(kViridis.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
    return mix_colors(hex(kViridis[below]), hex(kViridis[below + 1]), at - static_cast<float>(below));
}

Rgba category_color(std::size_t index, const Palette& palette) {
    // What is pale is darkened to be seen on white.
    const auto pale = [&](std::uint32_t color) {
        return palette.dark ? hex(color) : mix_colors(hex(color), Rgba(0, 0, 0, 1), 0.2f);
    };
    const std::array<Rgba, 7> colors{pale(kOrange), pale(kSkyBlue),  palette.separated,    pale(kPurple),
                                     palette.hit,   palette.overlap, palette.apart_in_time};
    return colors[index % colors.size()];
}

Rgba with_alpha(Rgba color, float alpha) { return {color.r, color.g, color.b, alpha}; }

Rgba mix_colors(Rgba a, Rgba b, float t) { return a + (b - a) * t; }

float contrast(Rgba a, Rgba b) {
    const auto lightness = [](Rgba c) {
        const auto linear = [](float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); };
        return 0.2126f * linear(c.r) + 0.7152f * linear(c.g) + 0.0722f * linear(c.b) + 0.05f;
    };
    const float la = lightness(a);
    const float lb = lightness(b);
    return std::max(la, lb) / std::min(la, lb);
}

Rgba faded(Rgba color, float strength, const Palette& palette) {
    // What is thin looks fainter than its colour, the more so on a light ground.
    const float wanted = palette.dark ? kFaintestOnDark : kFaintestOnLight;
    float low = 0;
    float high = 1;
    for (int i = 0; i < 12; ++i) {
        const float middle = 0.5f * (low + high);
        (contrast(mix_colors(palette.background, color, middle), palette.background) < wanted ? low : high) = middle;
    }
    return with_alpha(color, std::max(high, strength));
}

Rgba outlining(Rgba color, const Palette& palette) {
    return with_alpha(palette.dark ? mix_colors(color, Rgba(1), 0.15f) : mix_colors(color, Rgba(0, 0, 0, 1), 0.22f), 1);
}

Rgba readable(Rgba color, const Palette& palette) {
    return with_alpha(palette.dark ? mix_colors(color, Rgba(1), 0.15f) : mix_colors(color, Rgba(0, 0, 0, 1), 0.38f), 1);
}

}  // namespace mobbscope
