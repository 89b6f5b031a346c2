#include <base/text.h>
#include <mobb/clip.h>
#include <render/drawlist/pen.h>
#include <render/parts/highlights.h>
#include <render/parts/measured_line.h>
#include <render/text/labels.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace mobbscope {

namespace {

constexpr int kEndSides = 16;
constexpr float kEndRadius = 4;  // radius around an end, pixels at scale 1

/// Where a place is drawn: the picture of a moment has all on the floor.
glm::vec3 drawn(const DrawList& list, glm::dvec3 place) {
    return list.space.point(place.x, place.y, list.moment ? 0 : place.z);
}

/// Around an end, level.
std::vector<glm::vec3> ring(const DrawList& list, glm::vec3 middle, float pixels) {
    const float pixels_per_metre = list.projection.pixels_per_metre(middle);
    std::vector<glm::vec3> out;
    if (pixels_per_metre <= 0) return out;
    for (int i = 0; i <= kEndSides; ++i)
        out.push_back(middle + pixels / pixels_per_metre * glm::vec3(on_circle(static_cast<float>(i), kEndSides), 0));
    return out;
}

/// "X,Y,T"; none: it is not that.
std::optional<glm::dvec3> place_in(std::string_view text) {
    glm::dvec3 out{0};
    for (int i = 0; i < 3; ++i) {
        const std::size_t end = i < 2 ? text.find(',') : text.size();
        if (end == std::string_view::npos) return std::nullopt;
        const std::optional<double> number = parse_double(text.substr(0, end));
        const double most = i < 2 ? mobb::kMaxLength : mobb::kMaxTime;
        if (!number || std::abs(*number) > most) return std::nullopt;
        out[i] = *number;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

std::string text_of_place(glm::dvec3 place) {
    return format_double(place.x) + ',' + format_double(place.y) + ',' + format_double(place.z);
}

}  // namespace

double MeasuredLine::metres() const { return glm::length(glm::dvec2(to) - glm::dvec2(from)); }

double MeasuredLine::seconds() const { return std::abs(to.z - from.z); }

std::optional<double> MeasuredLine::speed() const {
    return seconds() > 0 ? std::optional(metres() / seconds()) : std::nullopt;
}

std::string measured_words(const MeasuredLine& line) {
    const std::string metres = formatted("%.3f m", line.metres());
    if (const std::optional<double> speed = line.speed())
        return metres + formatted(", %.3f s, %.3f m/s", line.seconds(), *speed);
    return metres + " at one moment";
}

MeasuredLine parse_measured_line(std::string_view text) {
    const std::size_t colon = text.find(':');
    const auto from = place_in(text.substr(0, colon));
    const auto to = colon == std::string_view::npos ? std::nullopt : place_in(text.substr(colon + 1));
    if (!from || !to)
        throw std::invalid_argument("two places cannot be " + in_quotes(text) +
                                    ": give X,Y,T:X,Y,T in metres and seconds");
    return {*from, *to};
}

std::string text_of(const MeasuredLine& line) { return text_of_place(line.from) + ':' + text_of_place(line.to); }

void add_measured_line(DrawList& list, const MeasuredLine& line, float scale) {
    const glm::vec3 from = drawn(list, line.from), to = drawn(list, line.to);
    std::vector<std::vector<glm::vec3>> lines{
        {from, to}, ring(list, from, kEndRadius * scale), ring(list, to, kEndRadius * scale)};
    const glm::vec3 below(to.x, to.y, from.z);
    if (from.z != to.z && from != below) lines.insert(lines.begin(), {from, below, to});
    add_highlight_lines(list, lines, HighlightLine::Role::measure, scale);
}

std::optional<glm::vec2> middle_in_view(const DrawList& list, const MeasuredLine& line) {
    return list.projection.project(0.5f * (drawn(list, line.from) + drawn(list, line.to)));
}

void add_measure(DrawList& list, const MeasuredLine& line, const Metrics& metrics, bool has_words) {
    add_measured_line(list, line, metrics.scale);
    const auto middle = has_words ? middle_in_view(list, line) : std::nullopt;
    if (!middle) return;
    LabelLayout layout(list);
    layout.place({.text = measured_words(line),
                  .role = TextRole::note,
                  .face = FontFace::mono,
                  .size = metrics.text,
                  .color = list.palette.text,
                  .anchor = *middle,
                  .directions = {{1, -0.5f}, {-1, -0.5f}, {1, 0.5f}, {-1, 0.5f}, {0, -1}, {0, 1}},
                  .distance = metrics.text,
                  .pill = true,
                  .border = list.palette.accent},
                 list);
}

}  // namespace mobbscope
