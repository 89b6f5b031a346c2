#include <base/text.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/chart_picture.h>
#include <render/text/labels.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace mobbscope {

namespace {

constexpr float kLeastArea = 16;      // pixels
constexpr float kWidestNames = 0.3F;  // of a chart's width
constexpr std::size_t kMostCaptionLines = 2;
constexpr double kPadding = 0.04;  // of an axis, beyond what it shows

struct Tick {
    double value = 0;
    std::string text;  // empty: a short tick without a number
};

/// An axis with the range that it shows.
class Ruler {
  public:
    explicit Ruler(const Chart::Axis& axis) : axis_(axis) {
        if (axis.from_zero && axis.scale == Chart::Scale::even) include(0);
    }

    bool shows(double value) const { return std::isfinite(value) && (even() || value > 0); }
    void include(double value) {
        if (!shows(value)) return;
        from_ = std::min(from_, along(value));
        to_ = std::max(to_, along(value));
    }
    /// After all values are in.
    void close() {
        if (!(from_ <= to_)) from_ = to_ = 0;
        const bool at_zero = axis_.from_zero && even() && from_ == 0;
        if (to_ - from_ < 1e-9 * std::max(1.0, std::abs(to_))) {
            const double around = even() ? std::max(0.1 * std::abs(to_), 0.5) : std::log10(2.0);
            from_ -= around;
            to_ += around;
        }
        const double padding = kPadding * (to_ - from_);
        from_ = at_zero ? 0 : from_ - padding;
        to_ += padding;
    }

    /// 0 at the axis's beginning, 1 at its end.
    float share(double value) const { return static_cast<float>((along(value) - from_) / (to_ - from_)); }

    /// `room_of` says how many pixels a number takes, with the gap to the next.
    std::vector<Tick> ticks(float length, const std::function<float(const std::string&)>& room_of) const {
        if (!even()) {
            if (auto out = factor_ticks(length, room_of)) return *std::move(out);
        }
        const double low = value_at(from_), high = value_at(to_);
        const double step = ruler_step(low, high, length, room_of);
        std::vector<Tick> out;
        for (const double value : mobbscope::ticks(low, high, step)) out.push_back({value, tick_text(value, step)});
        return out;
    }

    std::string title() const { return axis_.unit.empty() ? axis_.name : axis_.name + ", " + axis_.unit; }

  private:
    bool even() const { return axis_.scale == Chart::Scale::even; }
    double along(double value) const { return even() ? value : std::log10(value); }
    double value_at(double along) const { return even() ? along : std::pow(10.0, along); }

    /// Numbers at 1, 2 and 5 times the powers of ten if they have room, else at powers alone; none of them where the
    /// range holds fewer than two.
    std::optional<std::vector<Tick>> factor_ticks(float length,
                                                  const std::function<float(const std::string&)>& room_of) const {
        constexpr double kHair = 1e-9;
        const int first = static_cast<int>(std::floor(from_)), last = static_cast<int>(std::floor(to_));
        const auto has_number = [&](int power, int digit, int every) {
            return every == 0 ? digit == 1 || digit == 2 || digit == 5 : digit == 1 && power % every == 0;
        };
        for (int every = 0; every <= last - first + 1; ++every) {
            std::vector<Tick> out;
            bool fits = true;
            int numbers = 0;
            double before = 0;
            float room_before = 0;
            for (int power = first; power <= last; ++power) {
                for (int digit = 1; digit <= 9; ++digit) {
                    const double value = digit * std::pow(10.0, power);
                    const double at = std::log10(value);
                    if (at < from_ - kHair || at > to_ + kHair) continue;
                    if (!has_number(power, digit, every)) {
                        out.push_back({value, {}});
                        continue;
                    }
                    const std::string text = tick_text(value, std::min(1.0, std::pow(10.0, power)));
                    const float room = room_of(text);
                    const double apart = (at - before) / (to_ - from_) * length;
                    if (numbers > 0 && apart < 0.5 * (room + room_before)) fits = false;
                    before = at;
                    room_before = room;
                    ++numbers;
                    out.push_back({value, text});
                }
            }
            if (numbers < 2) return std::nullopt;
            if (fits) return out;
        }
        return std::nullopt;
    }

    Chart::Axis axis_;
    double from_ = std::numeric_limits<double>::infinity();
    double to_ = -std::numeric_limits<double>::infinity();
};

/// Places as near to the wanted ones as they can be, in this order, `gap` apart and within [low, high], which has room.
std::vector<float> kept_apart(const std::vector<float>& wanted, float gap, float low, float high) {
    // Less the gaps above them they need only not fall: neighbours that would do take their mean.
    struct Block {
        float sum = 0;
        int count = 0;
        float mean() const { return sum / static_cast<float>(count); }
    };
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        blocks.push_back({wanted[i] - gap * static_cast<float>(i), 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
            const Block last = blocks.back();
            blocks.pop_back();
            blocks.back().sum += last.sum;
            blocks.back().count += last.count;
        }
    }
    const float highest = std::max(low, high - gap * static_cast<float>(wanted.size() - 1));
    std::vector<float> out;
    for (const Block& block : blocks) {
        for (int i = 0; i < block.count; ++i)
            out.push_back(std::clamp(block.mean(), low, highest) + gap * static_cast<float>(out.size()));
    }
    return out;
}

/// Draws one chart within an area of a picture.
class ChartDrawing {
  public:
    ChartDrawing(DrawList& list, const Chart& chart, const Metrics& metrics, const Rect& room)
        : list_(list), chart_(chart), m_(metrics), room_(room), x_(chart.x), y_(chart.y) {
        for (const Chart::Series& series : chart.series) {
            for (const Chart::Point& point : series.points) {
                if (!x_.shows(point.x) || !y_.shows(point.y)) continue;
                x_.include(point.x);
                for (const double y : {point.y - point.error, point.y + point.error}) y_.include(y);
            }
        }
        for (const Chart::Mark& mark : chart.marks) {
            x_.include(mark.x);
            if (mark.y) y_.include(*mark.y);
        }
        x_.close();
        y_.close();
    }

    std::vector<std::vector<std::optional<glm::vec2>>> draw() {
        words_above();
        set_area();
        axes();
        std::vector<std::vector<std::optional<glm::vec2>>> points;
        for (std::size_t i = 0; i < chart_.series.size(); ++i) points.push_back(series(i));
        if (chart_.has_names) names(points);
        marks(points);
        return points;
    }

  private:
    float line() const { return line_height(FontFace::text, m_.small); }
    float width(const std::string& text, FontFace face = FontFace::text) const {
        return Font::of(face).width(text, m_.small);
    }
    void write(TextRole role, const std::string& text, float size, Rgba color, glm::vec2 corner,
               FontFace face = FontFace::text) {
        list_.texts.push_back(text_at(role, text, face, size, color, glm::round(corner)));
    }
    void number(const std::string& text, glm::vec2 corner) {
        if (!text.empty()) write(TextRole::tick, text, m_.small, list_.palette.text, corner, FontFace::mono);
    }
    void line_of(glm::vec2 from, glm::vec2 to, Rgba color, float width, Dash dash = kSolid) {
        list_.overlay_lines.push_back({from, to, color, width, dash});
    }
    glm::vec2 pixel(double x, double y) const {
        return {area_.min.x + x_.share(x) * area_.size().x, area_.max.y - y_.share(y) * area_.size().y};
    }
    Rgba color_of(std::size_t series) const { return series_color(chart_, series, list_.palette); }

    void words_above() {
        const float size = std::round(1.4F * m_.text);
        glm::vec2 at = room_.min;
        if (!chart_.title.empty()) {
            write(TextRole::caption, fit_text(chart_.title, FontFace::text, size, room_.size().x), size,
                  list_.palette.text, at);
            at.y += 1.15F * line_height(FontFace::text, size);
        }
        std::vector<std::string> below = wrap_text(chart_.caption, FontFace::text, m_.text, room_.size().x);
        if (below.size() > kMostCaptionLines) {
            for (std::size_t i = kMostCaptionLines; i < below.size(); ++i)
                below[kMostCaptionLines - 1].append(" ").append(below[i]);
            below.resize(kMostCaptionLines);
        }
        for (const std::string& text : below) {
            write(TextRole::caption, fit_text(text, FontFace::text, m_.text, room_.size().x), m_.text,
                  list_.palette.quiet_text, at);
            at.y += line_height(FontFace::text, m_.text);
        }
        top_ = at.y > room_.min.y ? at.y + m_.pad : at.y;
    }

    /// What the axes enclose: beside it stand numbers, titles and names.
    void set_area() {
        if (chart_.has_names) {
            for (const Chart::Series& series : chart_.series) names_ = std::max(names_, width(series.name));
        }
        names_ = std::min(std::ceil(names_), kWidestNames * room_.size().x);
        area_.min.y = std::round(top_ + line() + 6 * m_.scale);
        area_.max.y = std::max(std::round(room_.max.y - 2 * line() - 10 * m_.scale), area_.min.y + kLeastArea);
        y_ticks_ = y_.ticks(area_.size().y, [&](const std::string&) { return 2.2F * line(); });
        float numbers = 0;
        for (const Tick& tick : y_ticks_) numbers = std::max(numbers, width(tick.text, FontFace::mono));
        area_.min.x = std::round(room_.min.x + numbers + 8 * m_.scale);
        const float beside = names_ > 0 ? names_ + swatch_room() : 0;
        area_.max.x = std::max(std::round(room_.max.x - beside), area_.min.x + kLeastArea);
    }
    /// From the area's edge over the gap and the swatch to a name.
    float swatch_room() const { return 34 * m_.scale; }

    void axes() {
        const Rgba color = list_.palette.axis, grid = list_.palette.grid;
        for (const Tick& tick : y_ticks_) {
            const glm::vec2 foot(area_.min.x, area_.max.y - y_.share(tick.value) * area_.size().y);
            if (!tick.text.empty()) line_of(foot, {area_.max.x, foot.y}, grid, m_.scale);
            line_of(foot, foot - glm::vec2((tick.text.empty() ? 2 : 4) * m_.scale, 0), color, m_.scale);
            number(tick.text, foot - glm::vec2(width(tick.text, FontFace::mono) + 7 * m_.scale, 0.5F * line()));
        }
        const auto room_of = [&](const std::string& text) { return width(text, FontFace::mono) + 14 * m_.scale; };
        for (const Tick& tick : x_.ticks(area_.size().x, room_of)) {
            const glm::vec2 foot(area_.min.x + x_.share(tick.value) * area_.size().x, area_.max.y);
            if (!tick.text.empty()) line_of(foot, {foot.x, area_.min.y}, grid, m_.scale);
            line_of(foot, foot + glm::vec2(0, (tick.text.empty() ? 2 : 4) * m_.scale), color, m_.scale);
            number(tick.text, foot + glm::vec2(-0.5F * width(tick.text, FontFace::mono), 6 * m_.scale));
        }
        line_of(area_.min, {area_.min.x, area_.max.y}, color, m_.scale);
        line_of({area_.min.x, area_.max.y}, area_.max, color, m_.scale);
        const std::string below = fit_text(x_.title(), FontFace::text, m_.small, area_.size().x);
        write(TextRole::label, below, m_.small, list_.palette.quiet_text,
              {area_.center().x - 0.5F * width(below), area_.max.y + line() + 9 * m_.scale});
        // Above its upper end, as words are not turned.
        const std::string above = fit_text(y_.title(), FontFace::text, m_.small, room_.size().x);
        write(TextRole::label, above, m_.small, list_.palette.quiet_text, {room_.min.x, top_});
    }

    std::vector<std::optional<glm::vec2>> series(std::size_t index) {
        const Rgba color = color_of(index);
        std::vector<std::optional<glm::vec2>> out;
        for (const Chart::Point& point : chart_.series[index].points) {
            const bool shown = x_.shows(point.x) && y_.shows(point.y);
            out.push_back(shown ? std::optional(pixel(point.x, point.y)) : std::nullopt);
            if (!shown) continue;
            if (out.size() > 1 && out[out.size() - 2]) line_of(*out[out.size() - 2], *out.back(), color, 2 * m_.scale);
            dot(*out.back(), index);
            if (point.error > 0) error_bar(point, color);
        }
        return out;
    }

    void error_bar(const Chart::Point& point, Rgba color) {
        const double low = point.y - point.error;
        const glm::vec2 upper = pixel(point.x, point.y + point.error);
        const glm::vec2 lower = y_.shows(low) ? pixel(point.x, low) : glm::vec2(upper.x, area_.max.y);
        line_of(upper, lower, color, m_.scale);
        const glm::vec2 cap(3 * m_.scale, 0);
        for (const glm::vec2 end : {upper, lower}) line_of(end - cap, end + cap, color, m_.scale);
    }

    /// A disk, a square, a ring or a hollow square, so that lines are told apart without colours too.
    void dot(glm::vec2 at, std::size_t series) {
        const float r = (series % 2 == 0 ? 3 : 2.7F) * m_.scale;
        const bool hollow = series % 4 >= 2;
        list_.marks.push_back({{at - r, at + r},
                               series % 2 == 0 ? r : 0,
                               hollow ? list_.palette.background : color_of(series),
                               hollow ? color_of(series) : Rgba(0),
                               hollow ? 1.5F * m_.scale : 0});
    }

    /// Names beside the ends of the lines, as near to them as they have room; of too many the first.
    void names(const std::vector<std::vector<std::optional<glm::vec2>>>& points) {
        struct End {
            std::size_t series = 0;
            glm::vec2 at{0};
        };
        std::vector<End> ends;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto last =
                std::find_if(points[i].rbegin(), points[i].rend(), [](const auto& p) { return p.has_value(); });
            if (last != points[i].rend()) ends.push_back({i, **last});
        }
        const float gap = line() + 2 * m_.scale;
        const float low = area_.min.y, high = area_.max.y;
        const auto rows = static_cast<std::size_t>((high - low) / gap) + 1;
        const std::size_t all = ends.size();
        if (all > rows) ends.resize(rows - 1);
        std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at.y < b.at.y; });
        std::vector<float> wanted;
        for (const End& end : ends) wanted.push_back(end.at.y);
        const std::vector<float> places = kept_apart(wanted, gap, low, all > rows ? high - gap : high);
        const float left = area_.max.x + swatch_room();
        for (std::size_t i = 0; i < ends.size(); ++i) {
            const Rgba color = color_of(ends[i].series);
            const glm::vec2 swatch(left - 9 * m_.scale, places[i]);
            line_of(ends[i].at, swatch, with_alpha(color, 0.45F), m_.scale);
            dot(swatch, ends[i].series);
            write(TextRole::legend, fit_text(chart_.series[ends[i].series].name, FontFace::text, m_.small, names_),
                  m_.small, readable(color, list_.palette), {left, places[i] - 0.5F * line()});
        }
        if (all > rows)
            write(TextRole::legend, "+ " + std::to_string(all - ends.size()) + " more", m_.small,
                  list_.palette.quiet_text, {left, high - 0.5F * line()});
    }

    void marks(const std::vector<std::vector<std::optional<glm::vec2>>>& points) {
        LabelLayout words(list_.size);
        for (const TextRun& text : list_.texts) words.reserve(text.box);
        LabelLayout clear = words;
        for (const auto& series : points) {
            for (std::size_t i = 0; i < series.size(); ++i) {
                if (!series[i]) continue;
                clear.reserve(Rect{*series[i], *series[i]}.grown(4 * m_.scale));
                if (i > 0 && series[i - 1]) reserve_line(clear, *series[i - 1], *series[i]);
            }
        }
        // What is recommended has its label first, and its ring above the others.
        std::vector<const Chart::Mark*> order;
        for (const Chart::Mark& mark : chart_.marks) order.push_back(&mark);
        std::stable_partition(order.begin(), order.end(), [](const Chart::Mark* mark) { return mark->recommended; });
        std::vector<LabelRequest> requests;
        for (const Chart::Mark* mark : order) {
            if (!x_.shows(mark->x) || (mark->y && !y_.shows(*mark->y))) continue;
            const Rgba color = mark->recommended ? list_.palette.separated : list_.palette.text;
            LabelRequest request;
            request.text = mark->text;
            request.role = TextRole::note;
            request.size = m_.small;
            request.color = mark->recommended ? readable(color, list_.palette) : color;
            request.pill = true;
            request.border = mark->recommended ? color : list_.palette.panel_border;
            if (mark->y) {
                const glm::vec2 at = pixel(mark->x, *mark->y);
                ring(at, (mark->recommended ? 8.0F : 6.0F) * m_.scale, color);
                for (LabelLayout* layout : {&clear, &words}) layout->reserve(Rect{at, at}.grown(9 * m_.scale));
                request.anchor = at;
                request.directions = {{0, 1}, {1, 1}, {-1, 1}, {0, -1}, {1, -1}, {-1, -1}, {1, 0}, {-1, 0}};
            } else {
                const float x = area_.min.x + x_.share(mark->x) * area_.size().x;
                line_of({x, area_.min.y}, {x, area_.max.y}, color, m_.scale, Dash(5, 4, 5, 4) * m_.scale);
                request.anchor = {x, area_.min.y + line()};
                request.directions = {{1, 0}, {-1, 0}, {1, 1}, {-1, 1}};
            }
            requests.push_back(request);
        }
        for (LabelRequest& request : requests) place(request, clear, words);
    }

    /// Off the lines if there is room, near or with a thin line to it, else over them, but never over words.
    void place(LabelRequest& request, LabelLayout& clear, LabelLayout& words) {
        for (LabelLayout* layout : {&clear, &words}) {
            for (const float distance : {12.0F, 26.0F, 44.0F, 66.0F, 92.0F}) {
                request.distance = distance * m_.scale;
                if (!layout->place(request, list_)) continue;
                const Rect label = list_.panels.back().rect;
                (layout == &clear ? words : clear).reserve(label);
                if (distance > 12) {
                    const glm::vec2 near = glm::clamp(request.anchor, label.min, label.max);
                    const glm::vec2 way = near - request.anchor;
                    const float length = std::hypot(way.x, way.y);
                    line_of(request.anchor + way * (9 * m_.scale / std::max(length, 1e-3F)), near, list_.palette.axis,
                            m_.scale);
                }
                return;
            }
        }
    }

    void reserve_line(LabelLayout& layout, glm::vec2 from, glm::vec2 to) const {
        const float step = 6 * m_.scale;
        const glm::vec2 way = to - from;
        const int count = static_cast<int>(std::hypot(way.x, way.y) / step);
        for (int i = 1; i <= count; ++i) {
            const glm::vec2 at = from + way * (static_cast<float>(i) / static_cast<float>(count + 1));
            layout.reserve(Rect{at, at}.grown(0.5F * step));
        }
    }

    /// As of B in a map.
    void ring(glm::vec2 at, float radius, Rgba color) {
        const auto add = [&](float r, Rgba ink, float width) {
            list_.marks.push_back({{at - r, at + r}, r, Rgba(0), ink, width});
        };
        add(radius + 1.2F * m_.scale, list_.palette.background, 4.4F * m_.scale);
        add(radius, color, 2 * m_.scale);
    }

    DrawList& list_;
    const Chart& chart_;
    Metrics m_;
    Rect room_;
    Ruler x_, y_;
    Rect area_;
    std::vector<Tick> y_ticks_;
    float top_ = 0;
    float names_ = 0;  // pixels that the names are wide
};

}  // namespace

Rgba series_color(const Chart& chart, std::size_t series, const Palette& palette) {
    if (chart.colors == Chart::Colors::categories)
        return category_color(chart.series[series].color.value_or(series), palette);
    const std::size_t steps = std::max<std::size_t>(chart.series.size() - 1, 1);
    return quantity_color(static_cast<float>(series) / static_cast<float>(steps), palette);
}

ChartPicture chart_picture(const std::vector<Chart>& charts, PictureSize size, Theme theme, double scale) {
    check(size);
    ChartPicture out;
    out.list.size = size;
    out.list.palette = palette(theme);
    const Metrics m = metrics_of(size, scale);
    const Rect whole{glm::vec2(1.4F * m.pad, 1.2F * m.pad),
                     glm::vec2(size.width, size.height) - glm::vec2(1.4F * m.pad, 1.2F * m.pad)};
    const int side = size.width >= size.height ? 0 : 1;
    const float gap = 2 * m.pad;
    const auto count = static_cast<float>(charts.size());
    const float part = (whole.size()[side] - gap * (count - 1)) / count;
    for (std::size_t i = 0; i < charts.size(); ++i) {
        if (i == 0) out.list.headline = charts[i].title;
        Rect room = whole;
        room.min[side] += static_cast<float>(i) * (part + gap);
        room.max[side] = room.min[side] + part;
        out.points.push_back(ChartDrawing(out.list, charts[i], m, room).draw());
    }
    return out;
}

}  // namespace mobbscope
