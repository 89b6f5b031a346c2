#include <render/drawlist/cut.h>
#include <render/gl/box_buffer.h>
#include <render/gl/gl_objects.h>
#include <render/gl/line_pass.h>
#include <render/vector/world_lines.h>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

constexpr float kLookStep = 0.5F;  // pixels from one look at the depths to the next
constexpr int kShortGap = 3;       // looks; what is hidden for no more is taken for seen

/// A line on the screen, with depths from 0 to 1 as the renderer compares them.
struct SeenLine {
    glm::vec2 from{0}, to{0};
    float from_depth = 0, to_depth = 0;

    float length() const { return std::hypot(to.x - from.x, to.y - from.y); }
    glm::vec2 at(float along) const { return from + (to - from) * (along / std::max(length(), 1e-4F)); }
    float depth_at(float along) const {
        return from_depth + (to_depth - from_depth) * std::clamp(along / std::max(length(), 1e-4F), 0.0F, 1.0F);
    }
};

/// As shaders/line.vert has it; none for what is behind the eye.
std::optional<SeenLine> seen_line(const ViewProjection& projection, glm::vec3 from, glm::vec3 to) {
    glm::vec4 a = projection.clip_from_world * glm::vec4(from, 1);
    glm::vec4 b = projection.clip_from_world * glm::vec4(to, 1);
    const float da = a.z + a.w, db = b.z + b.w;
    if (da <= 0 && db <= 0) return std::nullopt;
    if (da < 0) a = glm::mix(a, b, da / (da - db));
    if (db < 0) b = glm::mix(b, a, db / (db - da));
    const glm::vec2 half(0.5F * static_cast<float>(projection.size.width),
                         0.5F * static_cast<float>(projection.size.height));
    const auto pixel = [&](glm::vec4 p) { return glm::vec2(p.x / p.w + 1, 1 - p.y / p.w) * half; };
    const auto depth = [&](glm::vec4 p) {
        return 0.5F + 0.5F * (p.z - std::min(kLineDepthBias * p.w, most_line_bias(projection))) / p.w;
    };
    return SeenLine{pixel(a), pixel(b), depth(a), depth(b)};
}

/// From where to where a line is within the picture, grown by so much; from > to: nowhere.
std::pair<float, float> part_in_picture(const SeenLine& line, float begin, float end, PictureSize size, float by) {
    const glm::vec2 way = (line.to - line.from) / std::max(line.length(), 1e-4F);
    const glm::vec2 high(static_cast<float>(size.width) + by, static_cast<float>(size.height) + by);
    for (int axis = 0; axis < 2; ++axis) {
        if (std::abs(way[axis]) < 1e-6F) {
            if (line.from[axis] < -by || line.from[axis] > high[axis]) return {1, 0};
            continue;
        }
        const float one = (-by - line.from[axis]) / way[axis], other = (high[axis] - line.from[axis]) / way[axis];
        begin = std::max(begin, std::min(one, other));
        end = std::min(end, std::max(one, other));
    }
    return {begin, end};
}

class Clipper {
  public:
    Clipper(const DrawList& list, const DepthImage* depths) : list_(list), depths_(depths) {}

    void add(glm::vec3 from, glm::vec3 to, const LineStyle& style) {
        if (style.color.a <= 0) return;
        const auto line = seen_line(list_.projection, from, to);
        if (!line) return;
        const float whole = line->length() + style.cap;
        const auto [begin, end] = part_in_picture(*line, -style.cap, whole, list_.size, style.width);
        if (!(begin < end)) return;
        if (!depths_) return draw(seen_, *line, style, begin, end);
        LineStyle hidden = style;
        hidden.color.a *= style.hidden;
        bool is_seen = sees(*line, begin);
        float since = begin;
        const auto finish = [&](float at) {
            if (is_seen) {
                draw(seen_, *line, style, since, at);
            } else if (hidden.color.a > 0) {
                draw(hidden_, *line, hidden, since, at);
            }
            since = at;
        };
        const int steps = static_cast<int>(std::ceil((end - begin) / kLookStep));
        for (int i = 1; i < steps; ++i) {
            const float at = begin + static_cast<float>(i) * kLookStep;
            if (sees(*line, at) == is_seen) continue;
            // A short gap is an edge that touches what it bounds.
            if (is_seen && i + 1 < steps && is_short_gap(*line, at, end)) continue;
            finish(at);
            is_seen = !is_seen;
        }
        finish(end);
    }

    std::vector<VectorStroke> take() {
        std::vector<VectorStroke> out = std::move(hidden_);
        out.insert(out.end(), std::make_move_iterator(seen_.begin()), std::make_move_iterator(seen_.end()));
        return out;
    }

  private:
    bool sees(const SeenLine& line, float along) const {
        const glm::ivec2 at(glm::floor(line.at(along)));
        if (at.x < 0 || at.y < 0 || at.x >= depths_->width || at.y >= depths_->height) return true;
        return line.depth_at(along) <= depths_->at(at.x, at.y);
    }
    bool is_short_gap(const SeenLine& line, float at, float end) const {
        for (int i = 1; i <= kShortGap; ++i) {
            const float ahead = at + static_cast<float>(i) * kLookStep;
            if (ahead < end && sees(line, ahead)) return true;
        }
        return false;
    }

    static void draw(std::vector<VectorStroke>& out, const SeenLine& line, const LineStyle& style, float begin,
                     float end) {
        const float period = style.dash.x + style.dash.y + style.dash.z + style.dash.w;
        const float start = period > 0 ? begin - period * std::floor(begin / period) : 0;
        add_line(out, line.at(begin), line.at(end), style, start);
    }

    const DrawList& list_;
    const DepthImage* depths_;
    std::vector<VectorStroke> hidden_, seen_;
};

}  // namespace

std::vector<VectorStroke> world_lines(const DrawList& list, const DepthImage* depths) {
    Clipper out(list, depths);
    const std::vector<const LineInstance*> lines = in_order(list.lines);
    auto line = lines.begin();
    for (const BoxInstance* box : in_order(list.boxes)) {
        for (; line != lines.end() && !(box->order < (*line)->order); ++line)
            out.add((*line)->from, (*line)->to, **line);
        if (!is_seen(list.slab, *box)) continue;
        const bool cut = list.slab && is_cut(*list.slab, *box);
        const std::array<glm::vec3, 8> corners = box_corners(*box);
        const LineStyle style = edge_style(*box);
        for (const auto& [a, b] : kBoxEdges) {
            glm::vec3 from = corners[a], to = corners[b];
            if (!cut || cut_line(*list.slab, from, to)) out.add(from, to, style);
        }
    }
    for (; line != lines.end(); ++line) out.add((*line)->from, (*line)->to, **line);
    return out.take();
}

std::vector<VectorStroke> highlight_lines(const DrawList& list) {
    Clipper out(list, nullptr);
    for (const HighlightLine& line : list.highlights) {
        LineStyle style;
        style.color = line.color;
        style.width = line.width;
        style.dash = line.dash;
        out.add(line.from, line.to, style);
    }
    return out.take();
}

}  // namespace mobbscope
