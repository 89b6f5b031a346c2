#include <render/build_draw_list.h>

#include <render/caption.h>
#include <render/floor_inset.h>
#include <render/label_layout.h>
#include <render/legend.h>
#include <render/level_boxes.h>
#include <render/paths.h>
#include <render/query_boxes.h>
#include <render/query_progress.h>
#include <render/query_sentence.h>
#include <render/separation_gap.h>
#include <render/subject.h>
#include <render/surroundings.h>
#include <render/world_box.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace mobbscope {

namespace {

/// Text and lines grow with the picture, but slower, and stay readable in small ones.
float scale_for(PictureSize size) {
    const double pixels = static_cast<double>(size.width) * size.height;
    return static_cast<float>(std::clamp(std::sqrt(pixels / (1280.0 * 720.0)), 0.8, 4.0));
}

/// Bounds of the paths' disks in (x, y, t).
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::max()};
    glm::dvec3 max{std::numeric_limits<double>::lowest()};

    void add(glm::dvec3 p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
};

Bounds bounds_of(std::span<const Subject> subjects) {
    Bounds bounds;
    for (const Subject& subject : subjects) {
        const mobb::PlacedClip& clip = subject.clip();
        for (int i = 0; i < clip.count(); ++i) {
            const mobb::Disk d = clip.disk(i);
            bounds.add({d.x - d.r, d.y - d.r, clip.time(i)});
            bounds.add({d.x + d.r, d.y + d.r, clip.time(i + 1)});
        }
    }
    return bounds;
}

DrawnSpace space_for(const Bounds& bounds, const ViewState& view) {
    DrawnSpace space;
    const glm::dvec3 extent = bounds.max - bounds.min;
    space.origin = {0.5 * (bounds.min.x + bounds.max.x), 0.5 * (bounds.min.y + bounds.max.y), bounds.min.z};
    // About as tall as wide; a point that stands still has no width to match.
    const double wide = std::max({extent.x, extent.y, 1e-3});
    space.time_height = view.time_height > 0 ? view.time_height : wide / extent.z;
    return space;
}

/// Everything between the view state and the draw list, step by step.
class Builder {
  public:
    Builder(const FittedScene& fitted, const ViewState& view, PictureSize size)
        : fitted_(fitted), view_(view), subjects_(subjects(fitted, view)), scale_(scale_for(size)), layout_(size) {
        if (subjects_.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
        list_.size = size;
        list_.palette = palette(view.theme);
        for (const Subject& subject : subjects_) list_.participants.push_back(subject.name);
    }

    DrawList build() {
        const Bounds bounds = bounds_of(subjects_);
        list_.space = space_for(bounds, view_);
        if (view_.query) {
            recorded_ = record(fitted_, fitted_.queries()[static_cast<std::size_t>(*view_.query)]);
            progress_ = progress_at(recorded_.trace, event_of(view_.step, recorded_.trace));
        }
        if (view_.boxes) add_boxes();
        stage_ = make_stage(with_boxes(bounds).min, with_boxes(bounds).max);
        stage_.t0 = bounds.min.z;
        stage_.t1 = bounds.max.z;
        add_caption();
        if (view_.disks) add_paths();
        if (view_.legend && view_.labels) {
            list_.legend = legend_entries(list_, subjects_, view_, view_.query ? &progress_ : nullptr);
            for (LegendEntry& entry : list_.legend) {
                entry.text =
                    fit_text(entry.text, FontFace::text, small_size(), 0.45f * static_cast<float>(list_.size.width));
            }
        }
        aim();
        refine_small_boxes(list_);
        add_stage();
        add_annotations();
        add_overlay();
        return std::move(list_);
    }

  private:
    bool has_time_cursor() const { return view_.time && *view_.time >= stage_.t0 && *view_.time <= stage_.t1; }

    void add_boxes() {
        if (view_.query) {
            add_query_boxes(list_, subjects_, progress_, scale_);
        } else {
            for (const Subject& subject : subjects_) add_level_boxes(list_, subject, view_.levels, scale_);
        }
    }

    /// The paths' bounds with those of the boxes that are shown.
    Bounds with_boxes(Bounds bounds) const {
        for (const BoxInstance& box : list_.boxes) {
            const glm::vec3 reach = glm::abs(box.extents[0]) + glm::abs(box.extents[1]) + glm::abs(box.extents[2]);
            for (const glm::vec3& corner : {box.center - reach, box.center + reach}) {
                bounds.add({corner.x + list_.space.origin.x, corner.y + list_.space.origin.y,
                            corner.z / list_.space.time_height + list_.space.origin.z});
            }
        }
        return bounds;
    }

    void add_paths() {
        for (const Subject& subject : subjects_) {
            PathFocus focus;
            if (view_.query) {
                const int node = subject.index == 0 ? progress_.event.a : progress_.event.b;
                const mobb::Node& tested = subject.placed.node(node);
                focus.range = mobb::SampleRange{tested.first, tested.count};
                focus.hit = hit_sample(subject.index);
            }
            add_disks(list_, subject, focus);
        }
    }

    std::optional<int> hit_sample(int side) const {
        if (!view_.query || progress_.event.outcome != mobb::Outcome::hit || progress_.event.pairs.empty())
            return std::nullopt;
        const mobb::MeasuredPair& pair = progress_.event.pairs.back();
        return side == 0 ? pair.i : pair.j;
    }

    /// All that must be inside the picture, as points.
    std::vector<glm::vec3> points() const {
        std::vector<glm::vec3> out;
        for (const DiskInstance& disk : list_.disks) {
            for (int i = 0; i < 8; ++i) {
                const double angle = i * std::numbers::pi / 4;
                const glm::vec3 rim =
                    disk.base + disk.radius * glm::vec3(glm::dvec3(std::cos(angle), std::sin(angle), 0));
                out.push_back(rim);
                out.push_back(rim + glm::vec3(0, 0, disk.height));
            }
        }
        for (const BoxInstance& box : list_.boxes) {
            for (unsigned bits = 0; bits < 8; ++bits) {
                glm::vec3 p = box.center;
                for (unsigned axis = 0; axis < 3; ++axis) p += box.extents[axis] * ((bits >> axis) & 1u ? 1.0f : -1.0f);
                out.push_back(p);
            }
        }
        const std::vector<glm::vec3> corners = stage_corners(stage_, list_.space);
        out.insert(out.end(), corners.begin(), corners.begin() + (has_time_cursor() ? 8 : 4));
        if (view_.time_axis) {
            const glm::dvec2 foot = axis_corner(stage_, right_of(view_.camera));
            out.push_back(list_.space.point(foot.x, foot.y, stage_.t1));
        }
        return out;
    }

    /// The lens, so that everything fits into what captions, labels and legend leave.
    void aim() {
        const std::vector<glm::vec3> all = points();
        frame_ = free_frame();
        const auto try_frame = [&](const Frame& frame) {
            std::optional<glm::vec3> target;
            if (view_.camera.target) {
                const glm::dvec3& t = *view_.camera.target;
                target = list_.space.point(t.x, t.y, t.z / list_.space.time_height);
            }
            return make_lens(view_.camera, all, target ? &*target : nullptr, frame, list_.size);
        };
        list_.lens = try_frame(frame_);
        std::vector<Rect> busy = occupied();
        place_blocks(busy);
        if (legend_fits_ || view_.camera.target) return;
        // No corner is free: the scene makes room, beside or below it, whichever costs it less.
        const glm::vec2 block = blocks_extent();
        Frame beside = frame_;
        beside.min.x += block.x;
        Frame above = frame_;
        above.max.y -= block.y;
        const Lens lens_beside = try_frame(beside);
        const Lens lens_above = try_frame(above);
        const glm::vec3 middle = 0.5f * (all.front() + all.back());
        const bool side = lens_beside.pixels_per_metre(middle) >= lens_above.pixels_per_metre(middle);
        list_.lens = side ? lens_beside : lens_above;
        frame_ = side ? beside : above;
        busy = occupied();
        place_blocks(busy);
    }

    float text_size() const { return std::round(12 * scale_); }
    float small_size() const { return std::round(11 * scale_); }
    float pad() const { return std::round(14 * scale_); }

    /// The picture without its margin, the caption, and room for the labels along the scene's outline.
    Frame free_frame() const {
        Frame frame{glm::vec2(pad()), glm::vec2(list_.size.width, list_.size.height) - pad()};
        frame.min.y = std::max(frame.min.y, caption_bottom_);
        if (!view_.labels) return frame;
        const Font& mono = Font::of(FontFace::mono);
        const bool floor_seen_level = std::abs(orientation(view_.camera).pitch_deg) < 2;
        const float line = 1.6f * small_size();
        frame.min.y += 1.8f * text_size();  // names over the paths
        if (view_.floor) {
            frame.max.y -= line;
            // Half of what the corner of the floor is labelled with goes beyond it, all of it where that corner is to
            // the right.
            frame.max.x -=
                mono.width("y " + longest_distance(stage_) + " m", small_size()) * (floor_seen_level ? 0.5f : 1.0f);
        }
        if (view_.time_axis) frame.min.x += mono.width(longest_tick(stage_), small_size()) + small_size();
        return frame;
    }

    void add_caption() {
        if (!view_.labels) {
            caption_bottom_ = pad();
            return;
        }
        const Caption caption = view_.query ? query_caption(list_.palette, subjects_, recorded_, progress_.step)
                                            : scene_caption(list_.palette, fitted_, subjects_, view_);
        caption_bottom_ = mobbscope::add_caption(list_, caption, pad(), scale_);
        for (const TextRun& run : list_.texts) layout_.reserve(run.box);
    }

    /// Where the scene's paths and boxes are, as small squares of the picture.
    std::vector<Rect> occupied() const {
        const float cell = 6 * scale_;
        std::vector<Rect> out;
        for (const DiskInstance& disk : list_.disks) {
            const glm::vec2 at = list_.lens.project(disk.base);
            const float r = disk.radius * list_.lens.pixels_per_metre(disk.base);
            const Rect rect{at - glm::vec2(r, 0.5f * r), at + glm::vec2(r, 0.5f * r)};
            if (out.empty() || !out.back().contains(rect)) out.push_back(rect);
        }
        for (const BoxInstance& box : list_.boxes) {
            std::array<glm::vec2, 8> corners;
            for (unsigned bits = 0; bits < 8; ++bits) {
                glm::vec3 p = box.center;
                for (unsigned axis = 0; axis < 3; ++axis) p += box.extents[axis] * ((bits >> axis) & 1u ? 1.0f : -1.0f);
                corners[bits] = list_.lens.project(p);
            }
            for (unsigned axis = 0; axis < 3; ++axis) {
                for (unsigned bits = 0; bits < 8; ++bits) {
                    if ((bits >> axis) & 1u) continue;
                    const glm::vec2 from = corners[bits];
                    const glm::vec2 to = corners[bits | (1u << axis)];
                    const int pieces =
                        std::clamp(static_cast<int>(std::hypot(to.x - from.x, to.y - from.y) / (2 * cell)), 1, 64);
                    for (int i = 0; i <= pieces; ++i) {
                        const glm::vec2 at = glm::mix(from, to, static_cast<float>(i) / static_cast<float>(pieces));
                        out.push_back({at - cell, at + cell});
                    }
                }
            }
        }
        add_stage_labels_to(out);
        return out;
    }

    /// Where the axis stands, and the labels of floor and axis want to be.
    void add_stage_labels_to(std::vector<Rect>& busy) const {
        if (!view_.labels) return;
        DrawList scratch;
        scratch.size = list_.size;
        scratch.lens = list_.lens;
        scratch.space = list_.space;
        LabelLayout layout(list_.size);
        for (const LabelRequest& label : stage_labels(scratch, stage_, view_.floor, view_.time_axis, small_size())) {
            layout.place(label, scratch);
        }
        for (const TextRun& run : scratch.texts) busy.push_back(run.box);
        if (!view_.time_axis || time_on_end(list_.lens)) return;
        const glm::dvec2 foot = axis_corner(stage_, list_.lens.right);
        const glm::vec2 low = list_.lens.project(list_.space.point(foot.x, foot.y, stage_.t0));
        const glm::vec2 high = list_.lens.project(list_.space.point(foot.x, foot.y, stage_.t1));
        busy.push_back(Rect{glm::min(low, high), glm::max(low, high)}.grown(6 * scale_));
    }

    /// Legend and map, together, as one would stack them.
    glm::vec2 blocks_extent() const {
        const glm::vec2 legend = legend_size(list_.legend, small_size());
        const glm::vec2 inset = has_time_cursor() && view_.labels ? inset_size(stage_, scale_) : glm::vec2(0);
        return glm::max(legend, inset) + pad();
    }

    /// Gives legend and map a corner each where they cover nothing; notes whether the legend and the map found one.
    void place_blocks(std::vector<Rect>& busy) {
        legend_fits_ = true;
        const auto corner_for = [&](glm::vec2 size, const std::array<glm::vec2, 4>& order) {
            const glm::vec2 low(pad(), caption_bottom_ + 0.3f * pad());
            const glm::vec2 high = glm::vec2(list_.size.width, list_.size.height) - pad() - size;
            std::size_t fewest = std::numeric_limits<std::size_t>::max();
            glm::vec2 best(0);
            for (const glm::vec2& corner : order) {
                const glm::vec2 at = glm::round(low + corner * (high - low));
                const Rect rect{at, at + size};
                const auto covered = static_cast<std::size_t>(
                    std::count_if(busy.begin(), busy.end(), [&](const Rect& r) { return r.overlaps(rect.grown(2)); }));
                if (covered < fewest) {
                    fewest = covered;
                    best = at;
                }
            }
            if (fewest > 0) legend_fits_ = false;
            busy.push_back({best, best + size});
            return best;
        };
        if (has_time_cursor() && view_.labels) {
            inset_corner_ = corner_for(inset_size(stage_, scale_), {glm::vec2(1, 0), {0, 1}, {1, 1}, {0, 0}});
        }
        if (!list_.legend.empty()) {
            legend_corner_ =
                corner_for(legend_size(list_.legend, small_size()), {glm::vec2(0, 1), {1, 1}, {1, 0}, {0, 0}});
        }
    }

    void add_stage() {
        const float floor_height = list_.space.point(0, 0, stage_.t0).z;
        if (view_.floor) {
            add_floor_grid(list_, stage_, scale_);
            if (!floor_on_edge(list_.lens)) {
                for (const Subject& subject : subjects_) add_floor_trace(list_, subject, floor_height, 1.6f * scale_);
            }
        }
        if (view_.time_axis) add_time_axis(list_, stage_, scale_);
    }

    void add_annotations() {
        if (view_.disks) {
            for (const Subject& subject : subjects_) add_thin_path(list_, subject, 1.3f * scale_);
        }
        if (has_time_cursor()) {
            add_time_cursor(list_, stage_, *view_.time, scale_);
            for (const Subject& subject : subjects_) {
                if (const auto sample = sample_at(subject, *view_.time))
                    add_ring(list_, subject, *sample, list_.palette.text, 2 * scale_);
            }
        }
        if (!view_.query) return;
        const mobb::Trace::Event& event = progress_.event;
        if (const auto gap = separation_gap(subjects_, event)) {
            const glm::vec3 at = add_separation_gap(list_, *gap, subjects_[0].placed.time_scale(), scale_);
            note(at, with_unit(event.gap, "m"), list_.palette.separated);
        }
        if (const auto gap = time_gap(subjects_, event, list_.space)) {
            add_time_gap(list_, *gap, scale_);
            note(0.5f * (gap->from + gap->to), gap->seconds > 1e-9 ? with_unit(gap->seconds, "s") : "0 s",
                 list_.palette.apart_in_time);
        }
        for (const Subject& subject : subjects_) {
            if (const auto sample = hit_sample(subject.index))
                add_ring(list_, subject, *sample, list_.palette.text, 2 * scale_);
        }
        if (const auto sample = hit_sample(0)) {
            const mobb::Disk disk = subjects_[0].clip().disk(*sample);
            note(list_.space.point(disk.x, disk.y, subjects_[0].clip().time(*sample)),
                 "hit at " + with_unit(recorded_.contact->time, "s"), list_.palette.hit);
        }
    }

    /// A number at a place in the scene.
    void note(glm::vec3 at, std::string text, Rgba color) {
        LabelRequest label;
        label.text = std::move(text);
        label.face = FontFace::mono;
        label.size = text_size();
        label.color = readable(color, list_.palette);
        label.border = color;
        label.anchor = list_.lens.project(at);
        label.directions = {{1, -0.5f}, {-1, -0.5f}, {1, 0.5f}, {-1, 0.5f}, {0, -1}, {0, 1}};
        label.distance = 4.5f * text_size();
        label.pill = true;
        notes_.push_back(std::move(label));
    }

    void add_overlay() {
        if (!view_.labels) return;
        const glm::vec2 legend = legend_size(list_.legend, small_size());
        if (!list_.legend.empty()) {
            add_legend(list_, legend_corner_, small_size());
            layout_.reserve({legend_corner_, legend_corner_ + legend});
        }
        if (has_time_cursor()) {
            add_floor_inset(list_, subjects_, stage_, *view_.time, inset_corner_, scale_);
            layout_.reserve({inset_corner_, inset_corner_ + inset_size(stage_, scale_)});
        }
        for (const LabelRequest& label : notes_) {
            if (layout_.place(label, list_)) {
                const Rect& pill = list_.panels.back().rect;
                const glm::vec2 nearest = glm::clamp(label.anchor, pill.min, pill.max);
                list_.overlay_lines.push_back({label.anchor, nearest, with_alpha(label.border, 0.9f), scale_, kSolid});
            }
        }
        for (const LabelRequest& label : stage_labels(list_, stage_, view_.floor, view_.time_axis, small_size())) {
            layout_.place(label, list_);
        }
        // A single path is named by the legend.
        if (subjects_.size() > 1) {
            for (const Subject& subject : subjects_) add_name(subject);
        }
    }

    void add_name(const Subject& subject) {
        const mobb::PlacedClip& clip = subject.clip();
        const mobb::Disk last = clip.disk(clip.count() - 1);
        const glm::vec3 top = list_.space.point(last.x, last.y, subject.end());
        LabelRequest label;
        label.text = fit_text(subject.name, FontFace::text, text_size(), 0.3f * static_cast<float>(list_.size.width));
        label.size = text_size();
        label.color = readable(subject.color, list_.palette);
        label.anchor = list_.lens.project(top);
        label.directions = {{0, -1}, {1, -1}, {-1, -1}, {1, 0}, {-1, 0}, {0, 1}};
        const float radius = static_cast<float>(last.r) * list_.lens.pixels_per_metre(top);
        label.pill = true;
        label.distance = radius * std::max(std::abs(list_.lens.back.z), 0.1f) + 0.4f * text_size();
        layout_.place(label, list_);
    }

    const FittedScene& fitted_;
    const ViewState& view_;
    std::vector<Subject> subjects_;
    float scale_;
    LabelLayout layout_;
    DrawList list_;
    Stage stage_;
    RecordedQuery recorded_;
    QueryProgress progress_;
    Frame frame_;
    float caption_bottom_ = 0;
    glm::vec2 legend_corner_{0};
    glm::vec2 inset_corner_{0};
    bool legend_fits_ = true;
    std::vector<LabelRequest> notes_;
};

}  // namespace

DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size) {
    return Builder(fitted, view, size).build();
}

}  // namespace mobbscope
