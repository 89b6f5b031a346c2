#include <base/text.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/map_picture.h>
#include <render/query/map_colors.h>
#include <render/text/labels.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr int kBarSteps = 96;  // of the bar of colours
constexpr float kLeastMap = 16;

bool is_length(const MapRange& range) { return range.axis == MapAxis::dx || range.axis == MapAxis::dy; }

/// Draws the map and what stands around it.
class MapDrawing {
  public:
    MapDrawing(DrawList& list, const PlacementMap& map, const std::string& b, const Metrics& metrics)
        : list_(list), map_(map), b_(b), m_(metrics), colors_(usual_colors(map)) {}

    void headline(const std::string& text, const std::string& below) {
        list_.headline = text;
        glm::vec2 at(1.4F * m_.pad, 1.2F * m_.pad);
        const float room = static_cast<float>(list_.size.width) - 2.8F * m_.pad;
        const float size = std::round(1.4F * m_.text);
        write(TextRole::caption, fit_text(text, FontFace::text, size, room), size, list_.palette.text, at);
        at.y += 1.15F * line_height(FontFace::text, size);
        write(TextRole::caption, fit_text(below, FontFace::text, m_.text, room), m_.text, list_.palette.quiet_text, at);
        top_ = at.y + line_height(FontFace::text, m_.text) + m_.pad;
    }

    void draw() {
        const float line = line_height(FontFace::text, m_.small);
        const auto number_room = [&](const std::string& text) {
            return Font::of(FontFace::mono).width(text, m_.small);
        };
        const std::string widest = tick_text(-std::max(std::abs(map_.order.up.from), std::abs(map_.order.up.to)), 0.1);
        const float left = 1.4F * m_.pad + line + number_room(widest) + 8 * m_.scale;
        const float right = 1.4F * m_.pad + legend_width();
        const float below = 1.2F * m_.pad + 2 * line + 10 * m_.scale;
        Rect room{{left, top_ + line + 6 * m_.scale},
                  glm::vec2(list_.size.width, list_.size.height) - glm::vec2(right + m_.pad, below)};
        room.max = glm::max(room.max, room.min + kLeastMap);
        area_ = {glm::round(room.min), glm::round(room.max)};
        if (is_length(map_.order.across) && is_length(map_.order.up)) {
            // A metre is as long on both sides.
            const double metres_x = map_.order.across.to - map_.order.across.from;
            const double metres_y = map_.order.up.to - map_.order.up.from;
            const double scale = std::min(room.size().x / metres_x, room.size().y / metres_y);
            area_.max = glm::round(area_.min +
                                   glm::max(glm::vec2(glm::dvec2(metres_x, metres_y) * scale), glm::vec2(kLeastMap)));
            const float aside = std::floor(0.5F * std::max(0.0F, room.max.x - area_.max.x));
            area_.min.x += aside;
            area_.max.x += aside;
        }
        cells();
        for (const PixelLine& hatch : hit_hatch(map_, area_, std::round(7 * m_.scale)))
            line_of(hatch.from, hatch.to, hatch_color(map_.order.show, list_.palette), m_.scale);
        boundary();
        frame();
        ticks_across(line);
        ticks_up(line);
        present_b();
        legend({area_.max.x + 1.6F * m_.pad, area_.min.y}, line);
    }

  private:
    float legend_width() const { return std::round(150 * m_.scale); }
    void write(TextRole role, const std::string& text, float size, Rgba color, glm::vec2 corner,
               FontFace face = FontFace::text) {
        list_.texts.push_back(text_at(role, text, face, size, color, glm::round(corner)));
    }
    void number(const std::string& text, Rgba color, glm::vec2 corner) {
        write(TextRole::tick, text, m_.small, color, corner, FontFace::mono);
    }
    float width(const std::string& text, FontFace face = FontFace::text) const {
        return Font::of(face).width(text, m_.small);
    }
    void line_of(glm::vec2 from, glm::vec2 to, Rgba color, float width) {
        list_.overlay_lines.push_back({from, to, color, width, kSolid});
    }
    void fill(const Rect& rect, Rgba color) { list_.panels.push_back({rect, 0, color, Rgba(0), 0}); }

    /// Neighbours of one colour in a row as one rectangle; where there are more cells than pixels, some of them.
    void cells() {
        const glm::ivec2 size(area_.size());
        const int columns = std::min(map_.order.width, size.x), rows = std::min(map_.order.height, size.y);
        const auto edge = [](int i, int count, float length) {
            return std::round(static_cast<float>(i) * length / static_cast<float>(count));
        };
        for (int row = 0; row < rows; ++row) {
            const int y = row * map_.order.height / rows;
            const float upper = area_.max.y - edge(row + 1, rows, area_.size().y);
            const float lower = area_.max.y - edge(row, rows, area_.size().y);
            int first = 0;
            const auto color = [&](int column) {
                return cell_color(map_, column * map_.order.width / columns, y, colors_, list_.palette);
            };
            Rgba run = color(0);
            for (int column = 1; column <= columns; ++column) {
                const std::optional<Rgba> next = column < columns ? std::optional(color(column)) : std::nullopt;
                if (next == run) continue;
                fill({{area_.min.x + edge(first, columns, area_.size().x), upper},
                      {area_.min.x + edge(column, columns, area_.size().x), lower}},
                     run);
                first = column;
                if (next) run = *next;
            }
        }
    }

    void boundary() {
        for (const MapLine& line : map_.boundary) {
            line_of(map_pixel(map_.order, area_, line.from), map_pixel(map_.order, area_, line.to),
                    boundary_color(list_.palette), 1.6F * m_.scale);
        }
    }

    void frame() {
        const std::array<glm::vec2, 4> corners{
            area_.min, {area_.max.x, area_.min.y}, area_.max, {area_.min.x, area_.max.y}};
        for (std::size_t i = 0; i < 4; ++i) line_of(corners[i], corners[(i + 1) % 4], list_.palette.axis, m_.scale);
    }

    void ticks_across(float line) {
        const MapRange& range = map_.order.across;
        const auto room = [&](const std::string& text) { return width(text, FontFace::mono) + 14 * m_.scale; };
        const double step = ruler_step(range.from, range.to, area_.size().x, room);
        for (const double at : ticks(range.from, range.to, step)) {
            const glm::vec2 foot(map_pixel(map_.order, area_, {at, map_.order.up.from}));
            line_of(foot, foot + glm::vec2(0, 4 * m_.scale), list_.palette.axis, m_.scale);
            const std::string text = tick_text(at, step);
            number(text, list_.palette.text, foot + glm::vec2(-0.5F * width(text, FontFace::mono), 6 * m_.scale));
        }
        const std::string title = axis_words(range.axis, b_);
        const std::string fitted = fit_text(title, FontFace::text, m_.small, area_.size().x);
        write(TextRole::label, fitted, m_.small, list_.palette.quiet_text,
              {area_.center().x - 0.5F * width(fitted), area_.max.y + line + 9 * m_.scale});
    }

    void ticks_up(float line) {
        const MapRange& range = map_.order.up;
        const auto room = [&](const std::string&) { return 2.5F * line; };
        const double step = ruler_step(range.from, range.to, area_.size().y, room);
        for (const double at : ticks(range.from, range.to, step)) {
            const glm::vec2 foot(map_pixel(map_.order, area_, {map_.order.across.from, at}));
            line_of(foot, foot - glm::vec2(4 * m_.scale, 0), list_.palette.axis, m_.scale);
            const std::string text = tick_text(at, step);
            number(text, list_.palette.text, foot - glm::vec2(width(text, FontFace::mono) + 7 * m_.scale, 0.5F * line));
        }
        // Above its upper end, as words are not turned.
        const std::string title = fit_text(axis_words(range.axis, b_), FontFace::text, m_.small, area_.size().x);
        write(TextRole::label, title, m_.small, list_.palette.quiet_text,
              {area_.min.x, area_.min.y - line - 3 * m_.scale});
    }

    /// A ring where B stands now, if that is in the map.
    void present_b() {
        if (!map_.cell_at({0, 0})) return;
        const glm::vec2 at = map_pixel(map_.order, area_, {0, 0});
        const float r = 6 * m_.scale;
        const auto ring = [&](float radius, Rgba color, float width) {
            list_.marks.push_back({{at - radius, at + radius}, radius, Rgba(0), color, width});
        };
        ring(r + 1.2F * m_.scale, Rgba(0, 0, 0, 1), 4.4F * m_.scale);
        ring(r, Rgba(1), 2 * m_.scale);
        LabelLayout layout(list_.size);
        layout.place({.text = b_ + " now",
                      .role = TextRole::name,
                      .size = m_.small,
                      .color = list_.palette.text,
                      .anchor = at,
                      .directions = {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}},
                      .distance = r + 3 * m_.scale,
                      .pill = true,
                      .border = list_.palette.panel_border},
                     list_);
    }

    void legend(glm::vec2 corner, float line) {
        const bool answers = map_.order.show == MapShow::answer;
        if (!answers) corner = color_bar(corner, line);
        const float side = std::round(1.1F * line);
        const auto row = [&](Rgba color, bool hatched, const std::string& text) {
            const Rect swatch{glm::round(corner), glm::round(corner + side)};
            if (color.a > 0) fill(swatch, color);
            if (hatched) {
                for (const float c : {0.5F, 1.0F, 1.5F}) {
                    const float begin = std::max(0.0F, c - 1) * side, end = std::min(1.0F, c) * side;
                    line_of(swatch.min + glm::vec2(begin, c * side - begin),
                            swatch.min + glm::vec2(end, c * side - end), hatch_color(map_.order.show, list_.palette),
                            m_.scale);
                }
                const std::array<glm::vec2, 4> corners{
                    swatch.min, {swatch.max.x, swatch.min.y}, swatch.max, {swatch.min.x, swatch.max.y}};
                for (std::size_t i = 0; i < 4; ++i)
                    line_of(corners[i], corners[(i + 1) % 4], boundary_color(list_.palette), 1.6F * m_.scale);
            }
            write(TextRole::legend, fit_text(text, FontFace::text, m_.small, legend_width() - side - 6 * m_.scale),
                  m_.small, list_.palette.text, {swatch.max.x + 6 * m_.scale, swatch.center().y - 0.5F * line});
            corner.y += side + 6 * m_.scale;
        };
        row(map_.order.show == MapShow::tests ? Rgba(0) : list_.palette.hit, true, "the two collide");
        const auto cell_of = [&](auto is_meant) {
            for (int y = 0; y < map_.order.height; ++y) {
                for (int x = 0; x < map_.order.width; ++x) {
                    if (is_meant(x, y)) return std::optional(cell_color(map_, x, y, colors_, list_.palette));
                }
            }
            return std::optional<Rgba>();
        };
        if (answers) {
            if (const auto free = cell_of([&](int x, int y) { return !map_.hit(x, y); }))
                row(*free, false, "they never collide");
        } else if (const auto alone = cell_of([&](int x, int y) { return std::isinf(map_.value(x, y)); })) {
            row(*alone, false, "they share no time");
        }
    }

    /// Returns where the legend goes on below it.
    glm::vec2 color_bar(glm::vec2 corner, float line) {
        const bool clearance = map_.order.show == MapShow::clearance;
        write(TextRole::legend, clearance ? "least clearance, m" : "tests of a query", m_.small,
              list_.palette.quiet_text, corner);
        corner.y += line + 6 * m_.scale;
        const float height = std::max(2 * line, std::min(0.5F * area_.size().y, 220 * m_.scale));
        const Rect bar{glm::round(corner), glm::round(corner + glm::vec2(14 * m_.scale, height))};
        for (int i = 0; i < kBarSteps; ++i) {
            const auto edge = [&](int k) {
                return std::round(bar.max.y - bar.size().y * static_cast<float>(k) / kBarSteps);
            };
            const double value = colors_.from + (i + 0.5) / kBarSteps * (colors_.to - colors_.from);
            fill({{bar.min.x, edge(i + 1)}, {bar.max.x, edge(i)}},
                 value_color(map_.order.show, value, colors_, list_.palette));
        }
        const auto room = [&](const std::string&) { return 2 * line; };
        double step = ruler_step(colors_.from, colors_.to, bar.size().y, room);
        if (!clearance) step = std::max(step, 1.0);
        for (const double value : ticks(colors_.from, colors_.to, step)) {
            const double share = (value - colors_.from) / (colors_.to - colors_.from);
            const glm::vec2 foot(bar.max.x, bar.max.y - static_cast<float>(share) * bar.size().y);
            line_of(foot, foot + glm::vec2(4 * m_.scale, 0), list_.palette.axis, m_.scale);
            number(tick_text(value, step), list_.palette.text, foot + glm::vec2(7 * m_.scale, -0.5F * line));
        }
        return {corner.x, bar.max.y + line};
    }

    DrawList& list_;
    const PlacementMap& map_;
    const std::string& b_;
    Metrics m_;
    MapColors colors_;
    Rect area_;
    float top_ = 0;
};

/// What the numbers are of.
std::string below_headline(const PlacementMap& map) {
    std::string cells = std::to_string(map.order.width) + " x " + std::to_string(map.order.height) + " cells";
    if (map.order.show == MapShow::answer) return cells;
    std::optional<std::pair<double, double>> range;
    for (const double value : map.values) {
        if (!std::isfinite(value)) continue;
        range =
            range ? std::pair(std::min(range->first, value), std::max(range->second, value)) : std::pair(value, value);
    }
    if (!range) return cells;
    const bool clearance = map.order.show == MapShow::clearance;
    return cells + (clearance ? ", least clearance " : ", tests ") + figure(range->first, 3) + " to " +
           figure(range->second, 3) + (clearance ? " m" : "");
}

}  // namespace

DrawList map_picture(const PlacementMap& map, const std::string& a, const std::string& b, PictureSize size, Theme theme,
                     double scale) {
    check(size);
    DrawList list;
    list.size = size;
    list.palette = palette(theme);
    MapDrawing drawing(list, map, b, metrics_of(size, scale));
    drawing.headline(map_words(map, a, b), below_headline(map));
    drawing.draw();
    return list;
}

}  // namespace mobbscope
