#include <base/text.h>
#include <render/drawlist/color_scale.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::size_t kOneIn = 50;  // values at either end that may be left out
constexpr double kDecade = 10;
constexpr double kLeastSpan = 0.05;  // of the larger end

std::string without_article(std::string_view words) {
    constexpr std::string_view kArticle = "the ";
    return std::string(words.starts_with(kArticle) ? words.substr(kArticle.size()) : words);
}

double shown_per_value(const ColoredFigure& figure) { return figure.unit == "%" ? 100 : 1; }

/// What is equally far apart on a logarithmic scale.
double logarithm(const ColoredFigure& figure, double value) { return std::log(value + (figure.counts ? 1 : 0)); }

bool is_a_decade(const ColoredFigure& figure, double least, double most) {
    const double more = figure.counts ? 1 : 0;
    return figure.spans_decades && least + more > 0 && most + more >= kDecade * (least + more);
}

/// The value at a place of the sorted ones.
double nth_value(std::vector<double>& values, std::size_t place) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::ranges::nth_element(values, at);
    return *at;
}

}  // namespace

ColoredFigure colored_figure(const NodeFieldInfo& field) {
    using enum NodeField;
    const bool part_of_box = field.field == fill || field.field == overhang;
    return {.title = without_article(field.words),
            .unit = std::string(field.unit),
            .spans_decades = !part_of_box && field.field != level,
            .counts = field.field == tests || field.field == avoidable,
            .low_is_worse = field.low_is_worse,
            .whole_range = field.field == level};
}

const NodeFieldInfo* color_figure(ColorBy color_by) {
    for (const NodeFieldInfo& field : node_fields()) {
        if (field.colors && field.name == name(color_by)) return &field;
    }
    return nullptr;
}

float ColorScale::share(double value) const {
    if (!(most > least)) return value > most ? 1 : 0;
    const double inside = std::clamp(value, least, most);
    if (!logarithmic) return static_cast<float>((inside - least) / (most - least));
    const double from = logarithm(figure, least);
    return static_cast<float>((logarithm(figure, inside) - from) / (logarithm(figure, most) - from));
}

double ColorScale::value_at(float share) const {
    const double part = std::clamp(static_cast<double>(share), 0.0, 1.0);
    if (!logarithmic) return least + part * (most - least);
    const double from = logarithm(figure, least);
    return std::exp(from + part * (logarithm(figure, most) - from)) - (figure.counts ? 1 : 0);
}

Rgba ColorScale::color_at(float share, const Palette& palette) const {
    return quantity_color(figure.low_is_worse ? 1 - share : share, palette);
}

Rgba ColorScale::color(double value, const Palette& palette) const {
    return std::isnan(value) ? palette.axis : color_at(share(value), palette);
}

std::string ColorScale::text(double value) const {
    std::string out = mobbscope::figure(shown_per_value(figure) * value, 3);
    if (!figure.unit.empty()) out.append(1, ' ').append(figure.unit);
    return out;
}

std::string ColorScale::title() const {
    std::string out = figure.title;
    if (!figure.unit.empty()) out.append(", ").append(figure.unit);
    if (logarithmic) out += " (log)";
    return out;
}

std::string ColorScale::least_text() const {
    return (has_less ? "<" : "") + mobbscope::figure(shown_per_value(figure) * least, 3);
}

std::string ColorScale::most_text() const {
    return (has_more ? ">" : "") + mobbscope::figure(shown_per_value(figure) * most, 3);
}

ColorScale color_scale(const ColoredFigure& figure, std::span<const double> values,
                       const std::optional<ValueRange>& chosen) {
    ColorScale out{.figure = figure, .chosen = chosen.has_value()};
    std::vector<double> known;
    known.reserve(values.size());
    std::ranges::copy_if(values, std::back_inserter(known), [](double value) { return !std::isnan(value); });
    out.known = !known.empty();
    if (chosen) {
        const double unit = shown_per_value(figure);
        out.least = chosen->least / unit;
        out.most = chosen->most / unit;
    } else if (out.known) {
        const std::size_t left_out = figure.whole_range ? 0 : known.size() / kOneIn;
        out.least = figure.from_zero ? 0 : nth_value(known, left_out);
        out.most = nth_value(known, known.size() - 1 - left_out);
        // Nothing has no logarithm: the scale begins at what is more.
        double more = std::numeric_limits<double>::infinity();
        for (const double value : known) more = value > 0 ? std::min(more, value) : more;
        if (out.least <= 0 && !figure.counts && !figure.from_zero && is_a_decade(figure, more, out.most))
            out.least = more;
        if (!figure.whole_range && !figure.from_zero) {
            const double lacking =
                kLeastSpan * std::max(std::abs(out.least), std::abs(out.most)) - (out.most - out.least);
            out.least -= 0.5 * std::max(0.0, lacking);
            out.most += 0.5 * std::max(0.0, lacking);
        }
    }
    out.logarithmic = is_a_decade(figure, out.least, out.most);
    out.has_less = std::ranges::any_of(known, [&](double value) { return value < out.least; });
    out.has_more = std::ranges::any_of(known, [&](double value) { return value > out.most; });
    return out;
}

std::vector<std::size_t> value_counts(const ColorScale& scale, std::span<const double> values, int bars) {
    std::vector<std::size_t> out(static_cast<std::size_t>(bars));
    for (const double value : values) {
        if (std::isnan(value)) continue;
        const auto at = static_cast<int>(scale.share(value) * static_cast<float>(bars));
        ++out[static_cast<std::size_t>(std::clamp(at, 0, bars - 1))];
    }
    return out;
}

}  // namespace mobbscope
