#include <base/text.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr float kEdge = 3;      // pixels kept free along the picture's edge
constexpr float kLabelGap = 2;  // ... and between labels

/// The rectangle of a size whose edge is `distance` from the anchor in a direction.
Rect beside(glm::vec2 anchor, glm::vec2 direction, float distance, glm::vec2 size) {
    const float length = std::max(std::hypot(direction.x, direction.y), 1e-6f);
    const glm::vec2 unit = direction / length;
    // From the centre of a rectangle to its edge along the direction.
    const float to_edge = std::min(std::abs(unit.x) > 1e-3f ? 0.5f * size.x / std::abs(unit.x) : 1e9f,
                                   std::abs(unit.y) > 1e-3f ? 0.5f * size.y / std::abs(unit.y) : 1e9f);
    const glm::vec2 center = anchor + unit * (distance + to_edge);
    const glm::vec2 corner(std::round(center.x - 0.5f * size.x), std::round(center.y - 0.5f * size.y));
    return {corner, corner + size};
}

}  // namespace

float line_height(FontFace face, float size) {
    const Font& font = Font::of(face);
    return std::ceil(font.ascent(size) + font.descent(size));
}

TextRun text_at(TextRole role, const std::string& text, FontFace face, float size, Rgba color, glm::vec2 corner) {
    const Font& font = Font::of(face);
    const glm::vec2 baseline(corner.x, std::round(corner.y + font.ascent(size)));
    const Rect box{corner, corner + glm::vec2(font.width(text, size), line_height(face, size))};
    return {.text = text, .role = role, .face = face, .size = size, .baseline = baseline, .color = color, .box = box};
}

LabelLayout::LabelLayout(PictureSize size)
    : picture_{glm::vec2(kEdge), glm::vec2(static_cast<float>(size.width), static_cast<float>(size.height)) - kEdge} {}

LabelLayout::LabelLayout(const DrawList& list) : LabelLayout(list.size) {
    for (const TextRun& run : list.texts) reserve(run.box);
    for (const OverlayPanel& panel : list.panels) reserve(panel.rect);
}

bool LabelLayout::is_free(const Rect& rect, float room) const {
    const glm::vec2 around(std::max(room, kLabelGap), kLabelGap);
    const Rect needed{rect.min - around, rect.max + around};
    return picture_.contains(rect) &&
           std::none_of(taken_.begin(), taken_.end(), [&](const Rect& other) { return other.overlaps(needed); });
}

bool LabelLayout::place(const LabelRequest& request, DrawList& list) {
    const float padding = request.pill ? std::round(0.4f * request.size) : 0.0f;
    const glm::vec2 text_size(std::ceil(Font::of(request.face).width(request.text, request.size)),
                              line_height(request.face, request.size));
    const glm::vec2 size = text_size + glm::vec2(2 * padding, padding);
    for (const glm::vec2& direction : request.directions) {
        const Rect rect = beside(request.anchor, direction, request.distance, size);
        // Words and figures that nearly touch read as one: "0.0 s0.2 s".
        if (!is_free(rect, 0.5f * request.size)) continue;
        taken_.push_back(rect);
        if (request.pill) list.panels.push_back({rect, 0.3f * request.size, list.palette.panel, request.border, 1});
        const glm::vec2 corner = rect.min + glm::vec2(padding, std::floor(0.5f * padding));
        list.texts.push_back(text_at(request.role, request.text, request.face, request.size, request.color, corner));
        return true;
    }
    return false;
}

float panel_padding(float text_size) { return std::round(0.8f * text_size); }

OverlayPanel text_panel(const Rect& rect, const Palette& palette, float text_size) {
    return {rect, 0.4f * text_size, palette.panel, palette.panel_border, 1};
}

double nice_step(double span, double parts) {
    const double largest = span / parts;
    const double power = std::pow(10.0, std::floor(std::log10(largest)));
    // The tolerance keeps 0.9999... * 2 from falling to 1.
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= largest * (1 + 1e-9)) return factor * power;
    }
    return power;
}

double ruler_step(double from, double to, float length, const std::function<float(const std::string&)>& width_of) {
    const double span = to - from;
    if (!(span > 0) || !(length > 0)) return 1;
    constexpr int kMostHalvings = 40;
    double parts = std::max(1.0f, length / width_of("0"));
    for (int i = 0; i < kMostHalvings; ++i) {
        const double step = nice_step(span, parts);
        const float widest = std::max(width_of(tick_text(from, step)), width_of(tick_text(to, step)));
        if (step / span * length >= widest) return step;
        parts /= 2;
    }
    return span;
}

std::vector<double> ticks(double from, double to, double step) {
    std::vector<double> out;
    const double slack = 1e-6;
    const double first = std::ceil(from / step - slack);
    const int count = static_cast<int>(std::floor(to / step + slack) - first) + 1;
    for (int i = 0; i < count; ++i) out.push_back((first + i) * step);
    return out;
}

std::string tick_text(double value, double step) {
    const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
    // Adding zero turns -0 into 0.
    return formatted("%.*f", decimals, value + 0.0);
}

}  // namespace mobbscope
