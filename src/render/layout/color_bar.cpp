#include <render/layout/color_bar.h>
#include <render/layout/legend.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr int kSteps = 48;                // of the gradient
constexpr float kGradientLength = 7;      // in sizes of text
constexpr float kGradientHeight = 0.72f;  // likewise
constexpr float kGradientGap = 0.5f;      // between the bar and the values at its ends

std::string title_of(const ColorBar& bar) {
    const std::string title = bar.of + ": " + (bar.scale.known ? bar.scale.title() : bar.scale.figure.title);
    return bar.scale.known ? title : title + " (" + bar.unknown + ")";
}

float width_of(const std::string& text, float size) { return Font::of(FontFace::text).width(text, size); }

int lines_of(const ColorBar& bar) { return bar.scale.known ? 2 : 1; }

}  // namespace

glm::vec2 color_bars_size(std::span<const ColorBar> bars, float text_size) {
    glm::vec2 out(0);
    for (const ColorBar& bar : bars) {
        out.x = std::max(out.x, width_of(title_of(bar), text_size));
        out.y += legend_row(text_size) * static_cast<float>(lines_of(bar));
        if (!bar.scale.known) continue;
        out.x = std::max(out.x, width_of(bar.scale.least_text(), text_size) +
                                    (kGradientLength + 2 * kGradientGap) * text_size +
                                    width_of(bar.scale.most_text(), text_size));
    }
    return {std::ceil(out.x), out.y};
}

void add_color_bars(DrawList& list, std::span<const ColorBar> bars, glm::vec2 corner, float text_size) {
    const float height = line_height(FontFace::text, text_size);
    const auto add_text = [&](const std::string& text, glm::vec2 at) {
        list.texts.push_back(text_at(TextRole::legend, text, FontFace::text, text_size, list.palette.text, at));
    };
    for (const ColorBar& bar : bars) {
        add_text(title_of(bar), corner);
        corner.y += legend_row(text_size);
        if (!bar.scale.known) continue;
        add_text(bar.scale.least_text(), corner);
        const float from =
            std::round(corner.x + width_of(bar.scale.least_text(), text_size) + kGradientGap * text_size);
        const float to = from + std::round(kGradientLength * text_size);
        const float top = std::round(corner.y + 0.5f * (height - kGradientHeight * text_size));
        const float bottom = top + std::round(kGradientHeight * text_size);
        // Each reaches to the end and the next lies over it: no ground is seen between two.
        for (int i = 0; i < kSteps; ++i) {
            const float left = std::round(from + (to - from) * static_cast<float>(i) / kSteps);
            const float share = (static_cast<float>(i) + 0.5f) / kSteps;
            list.panels.push_back(
                {{{left, top}, {to, bottom}}, 0, bar.scale.color_at(share, list.palette), Rgba(0), 0});
        }
        add_text(bar.scale.most_text(), {to + kGradientGap * text_size, corner.y});
        corner.y += legend_row(text_size);
    }
}

}  // namespace mobbscope
