#include <explain/query_progress.h>
#include <mobb/trace.h>
#include <render/drawlist/cut.h>
#include <render/layout/annotations.h>
#include <render/layout/caption.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/highlights.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/parts/sections.h>
#include <render/pictures/candidates.h>
#include <render/pictures/kept_paths.h>
#include <render/pictures/picture.h>
#include <render/query/proof_walls.h>
#include <render/query/query_boxes.h>
#include <render/text/labels.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

/// What matters of each path; `behind`: all step back.
std::vector<PathFocus> foci_of(std::span<const DrawnAgent> agents, const Emphasis& emphasis,
                               const QueryProgress* progress, bool behind) {
    std::vector<PathFocus> out(agents.size());
    for (std::size_t i = 0; i < agents.size(); ++i) {
        out[i].behind = behind;
        const DrawnAgent& agent = agents[i];
        if (agent.subtree) {
            const mobb::Node& part = agent.placed.node(*agent.subtree);
            out[i].range = mobb::SampleRange{part.first, part.count};
        }
        if (!progress) continue;
        const mobb::Node& tested = agent.placed.node(agent.index == 0 ? progress->event.a : progress->event.b);
        out[i].range = mobb::SampleRange{tested.first, tested.count};
        if (emphasis.hits) out[i].hit = (*emphasis.hits)[static_cast<std::size_t>(agent.index)];
    }
    return out;
}

void add_floor_and_axes(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& floor_extent,
                        const ViewState& view, float scale) {
    if (view.floor) {
        add_floor_grid(list, floor_extent, scale);
        if (!floor_on_edge(list.projection)) {
            const float height = list.space.point(0, 0, floor_extent.t0).z;
            for (const DrawnAgent& agent : agents) {
                if (!agent.is_whole()) continue;
                add_floor_trace(list, agent, {0, agent.clip().count()}, height, floor_trace_color(agent, list.palette),
                                1.6f * scale);
            }
        }
    }
    if (view.time_axis) add_time_axis(list, floor_extent, scale);
}

/// Paths and boxes in space-time.
class SpaceTimePicture final : public Picture {
  public:
    /// `kept`: of this scene.
    SpaceTimePicture(KeptPaths& kept, const ViewState& view, const PictureOptions& options)
        : Picture(*kept.fitted(), view, options) {
        const Bounds& bounds = kept.bounds(agents_, view_);
        list_.space = space_for(bounds, view_);
        list_.space.anchor = camera_anchor(fitted_, view_, view_.time.value_or(bounds.min.z));
        list_.slab = slab_of_view(view_, list_.space);
        shown_from_ = view_.slab ? std::max(bounds.min.z, view_.slab->least) : bounds.min.z;
        shown_to_ = view_.slab ? std::min(bounds.max.z, view_.slab->most) : bounds.max.z;
        if (view_.query) ask(kept);
        emphasis_ = emphasis_of(view_, agents_, shown_from_, shown_to_, test());
        if (view_.boxes && test()) add_query_boxes(list_, agents_, *test(), pair_outline(view_), metrics_.scale);
        const bool levels = view_.boxes && !view_.query;
        if (levels) add_level_boxes(list_, agents_, view_.levels, metrics_.scale);
        if (auto bar = kept.color_boxes(list_, agents_, view_)) bars_.push_back(std::move(*bar));
        if (levels && view_.cost) box_tests_ = kept.box_tests();
        const bool behind = levels && view_.color_by != ColorBy::agent;
        framed_ = kept.add_disks_of(list_, agents_, view_, foci_of(agents_, emphasis_, test(), behind));
        if (!view_.disks) list_.disks = {};
        if (auto bar = kept.heat_bar()) bars_.push_back(std::move(*bar));
        floor_extent_ = floor_extent_of(bounds.min, bounds.max);
        if (walls_) within_slab([&] { gaps_ = add_proof_walls(list_, *walls_, view_.time, metrics_.scale); });
        if (list_.slab)
            std::erase_if(gaps_, [&](const WallGap& gap) { return !list_.slab->shows(gap.at.z, gap.at.z); });
        if (view_.boxes && view_.frame_boxes) frame_boxes();
        points_ = framed_;
        if (!view_.foreground.empty()) add_outlines_to(points_, bounds);
        for (const BoxInstance& box : list_.boxes) points_.add(box_corners(box));
        add_floor_points(points_, list_.space, floor_extent_, view_, emphasis_.cursor.has_value());
        if (!recorded_ || !view_.boundary) return;
        boundary_ = kept.boundary(view_);
        for (const auto& [from, to] : boundary_) points_.add(list_.space.point(from.x, from.y, floor_extent_.t0));
    }

  private:
    /// What is left of who is not in the foreground is not framed, but seen.
    void add_outlines_to(ShownPoints& points, const Bounds& bounds) const {
        for (const double x : {bounds.min.x, bounds.max.x}) {
            for (const double y : {bounds.min.y, bounds.max.y}) {
                for (const double t : {bounds.min.z, bounds.max.z}) points.add(list_.space.point(x, y, t));
            }
        }
    }

    /// Finds out how far the search is, and whether the proof is shown.
    void ask(KeptPaths& kept) {
        recorded_ = &kept.recorded(view_);
        const mobb::Trace& trace = recorded_->trace;
        progress_ = progress_at(trace, event_of(view_.step, trace, fitted_, *view_.query), view_.past);
        if (view_.proof)
            progress_->avoidable = avoidable_overlap(agents_[0].placed, agents_[1].placed, progress_->event);
        const bool last_step = progress_->step + 1 == trace.size();
        if (!view_.proof || !last_step || shown_count(agents_) < 2) return;
        const QueryProof& proof = kept.proof(view_);
        if (proof.lines.empty()) return;
        walls_ = &proof;
        // A miss is explained by its lines, not by the pair that happened to be tested last, unless that is asked for.
        replaces_test_ = !proof.certificate.contact && view_.past != Past::pair && view_.past != Past::all;
    }

    /// The test that is drawn; null: none.
    const QueryProgress* test() const { return progress_ && !replaces_test_ ? &*progress_ : nullptr; }

    OverlayContents words() override {
        OverlayContents out;
        out.caption = replaces_test_ ? proof_caption(list_.palette, agents_, *recorded_, *walls_)
                      : recorded_    ? query_caption(list_.palette, agents_, *recorded_, *progress_)
                                     : scene_caption(fitted_, agents_, view_, box_tests_);
        if (view_.time && !emphasis_.cursor) {
            mention_cursor_outside(out.caption, *view_.time, shown_from_, shown_to_);
        }
        out.bars = bars_;
        out.legend = legend_entries(list_, agents_, view_, emphasis_, test());
        if (walls_) out.legend.push_back(proof_entry(list_.palette));
        if (emphasis_.cursor && view_.slice)
            out.legend.push_back(line_entry({list_.palette.text, 2.2f}, "sections of boxes then"));
        if (!boundary_.empty())
            out.legend.push_back(
                line_entry(boundary_style(list_.palette, 1), agents_[1].label + " beginning inside collides"));
        if (emphasis_.cursor) {
            out.map_title = "floor" + at_time(*emphasis_.cursor);
            out.map = map_size(floor_extent_, metrics_.scale);
        }
        return out;
    }

    std::vector<LabelRequest> content() override {
        refine_crowded_boxes(list_, metrics_.scale);
        add_floor_and_axes(list_, agents_, floor_extent_, view_, metrics_.scale);
        if (view_.disks) within_slab([&] { add_centre_lines(); });
        if (test() && view_.time_axis && pair_outline(view_) == PairOutline::outcome) {
            add_time_intervals(list_, floor_extent_, agents_, test()->event, metrics_.scale);
        }
        if (!boundary_.empty() && !floor_on_edge(list_.projection)) {
            const float height = list_.space.point(0, 0, floor_extent_.t0).z;
            add_floor_boundary(list_, boundary_, agents_[1], height, metrics_.scale);
        }
        if (list_.slab) add_slab_planes(list_, floor_extent_, *view_.slab, metrics_.scale);
        if (emphasis_.cursor) add_time_cursor(list_, floor_extent_, *emphasis_.cursor, metrics_.scale);
        if (emphasis_.cursor && view_.slice) add_slice(*emphasis_.cursor);
        add_ancestors_of_part(list_, agents_, view_, metrics_.scale);
        within_slab([&] { add_rings(list_, agents_, emphasis_, metrics_.scale); });
        if (!recorded_) return names_now();
        std::vector<LabelRequest> notes;
        if (walls_) notes = proof_notes();
        if (!test()) return notes;
        const std::size_t lines = list_.lines.size();
        std::vector<LabelRequest> found;
        within_slab([&] { found = add_findings(list_, agents_, *recorded_, *test(), metrics_); });
        // What is cut away needs no number.
        if (!list_.slab || list_.lines.size() > lines) notes.insert(notes.end(), found.begin(), found.end());
        return notes;
    }

    void add_centre_lines() {
        for (const DrawnAgent& agent : agents_) {
            if (agent.is_whole()) add_thin_path(list_, agent, 1.3f * metrics_.scale);
            if (agent.outlined && !agent.hidden) add_path_outline(list_, agent, metrics_.scale);
        }
    }

    void frame(const BoxInstance& box) {
        if (box.state != BoxState::annotation && is_seen(list_.slab, box)) framed_.add(box_corners(box));
    }

    /// Boxes of a query come and go with its steps: the roots' stand for most of them.
    void frame_boxes() {
        for (const BoxInstance& box : list_.boxes) frame(box);
        if (!view_.query) return;
        for (const DrawnAgent& agent : agents_) {
            if (!agent.hidden) frame(node_box(agent, 0, list_.space));
        }
    }

    void frame_boxes_of_steps() override {
        if (!view_.boxes || !view_.frame_boxes) return;
        for (const DrawnAgent& agent : agents_) {
            if (agent.hidden) continue;
            std::vector<bool> framed(agent.placed.tree().nodes().size());
            for (int i = 0; i < recorded_->trace.size(); ++i) {
                const mobb::Trace::Event event = recorded_->trace[i];
                const int node = agent.index == 0 ? event.a : event.b;
                if (framed[static_cast<std::size_t>(node)]) continue;
                framed[static_cast<std::size_t>(node)] = true;
                frame(node_box(agent, node, list_.space));
            }
        }
    }

    /// Also of boxes that are not shown themselves.
    void add_slice(double time) {
        DrawList drawn;
        drawn.palette = list_.palette;
        drawn.space = list_.space;
        if (view_.boxes) {
            std::ranges::copy_if(list_.boxes, std::back_inserter(drawn.boxes), &BoxInstance::pickable);
        } else if (test()) {
            add_query_boxes(drawn, agents_, *test(), pair_outline(view_), metrics_.scale);
        } else if (!view_.query) {
            add_level_boxes(drawn, agents_, view_.levels, metrics_.scale);
        }
        const float height = list_.space.point(0, 0, time).z;
        add_sections(list_, drawn.boxes, height, height, metrics_.scale);
    }

    /// The numbers beside the walls, and the region that is free.
    std::vector<LabelRequest> proof_notes() {
        std::vector<LabelRequest> notes;
        for (const WallGap& gap : gaps_) add_gap_note(notes, list_, gap, metrics_);
        if (!view_.free_region || !walls_->margins || floor_on_edge(list_.projection)) return notes;
        if (const auto middle = add_free_region(list_, agents_[1], *walls_->margins, floor_extent_, metrics_.scale))
            add_region_note(notes, list_, agents_[1], *middle, metrics_);
        return notes;
    }

    /// Beside where they are: of who is in the foreground, and of so many that the rest dims of the followed one, which
    /// is ringed, at the time cursor, else where its path begins.
    std::vector<LabelRequest> names_now() {
        std::vector<LabelRequest> notes;
        if (emphasis_.cursor && !view_.foreground.empty())
            notes = names_at(list_, agents_, *emphasis_.cursor, metrics_);
        if (names_fit(agents_.size())) return notes;
        for (const DrawnAgent& agent : agents_) {
            if (agent.name != view_.follow) continue;
            const auto name = add_followed(list_, agent, emphasis_.cursor.value_or(agent.begin()), 0, metrics_);
            notes.insert(notes.end(), name.begin(), name.end());
            break;
        }
        return notes;
    }

    void add_map(const Rect& within) override {
        add_floor_map(list_, agents_, floor_extent_, *emphasis_.cursor, within, metrics_.scale);
    }

    void add_names_to(LabelLayout& layout) override {
        if (agents_.front().cell) return add_cell_names(list_, layout, agents_, floor_extent_.t0, metrics_);
        add_names(list_, layout, agents_, metrics_);
    }

    const RecordedQuery* recorded_ = nullptr;  ///< of the view's query; null: it has none
    std::optional<QueryProgress> progress_;    ///< refers to it
    const QueryProof* walls_ = nullptr;        ///< null: they are not shown
    bool replaces_test_ = false;               ///< the walls stand alone
    std::vector<WallGap> gaps_;
    double shown_from_ = 0, shown_to_ = 0;  ///< global seconds
    FloorLines boundary_;
    std::vector<ColorBar> bars_;
    std::optional<double> box_tests_;  ///< for the caption
    Emphasis emphasis_;
};

}  // namespace

std::unique_ptr<Picture> space_time_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options) {
    return std::make_unique<SpaceTimePicture>(kept, view, options);
}

}  // namespace mobbscope
