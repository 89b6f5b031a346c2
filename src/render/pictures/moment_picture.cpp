#include <explain/query_progress.h>
#include <render/drawlist/cut.h>
#include <render/drawlist/pen.h>
#include <render/layout/annotations.h>
#include <render/layout/follow.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/parts/floor_and_axes.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/parts/sections.h>
#include <render/pictures/candidates.h>
#include <render/pictures/kept_paths.h>
#include <render/pictures/moment.h>
#include <render/pictures/picture.h>
#include <render/pictures/standing_agents.h>
#include <render/query/proof_walls.h>
#include <render/query/query_boxes.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kMostPathsInFull = 12;  // ways of more people would hide one another

/// Straight from above, turned as it is where somebody has turned it.
Camera camera_of_plan(Camera camera) {
    if (camera.preset != CameraPreset::free) camera.preset = CameraPreset::top;
    camera.pitch_deg = 90;
    camera.perspective = false;
    return camera;
}

double beginning(std::span<const DrawnAgent> agents) {
    const auto earlier = [](const DrawnAgent& a, const DrawnAgent& b) { return a.begin() < b.begin(); };
    return std::min_element(agents.begin(), agents.end(), earlier)->begin();
}

/// The corners of upright prisms that those who are shown stay inside of, whenever it is: eight below, eight above, and
/// so on.
std::vector<glm::vec3> standing_room(const DrawnSpace& space, std::span<const DrawnAgent> agents,
                                     std::span<const double> heights, double slip) {
    constexpr int kSides = 8;
    const double outside = 1 / std::cos(std::numbers::pi / kSides);
    std::vector<glm::vec3> out;
    // Where everybody is hidden, the picture still has its place.
    const bool all = shown_count(agents) == 0;
    for (std::size_t s = 0; s < agents.size(); ++s) {
        if (agents[s].hidden && !all) continue;
        for (const mobb::PlacedClip& clip : agents[s].paths()) {
            std::optional<mobb::Disk> last;
            for (int i = 0; i < clip.count(); ++i) {
                const mobb::Disk d = clip.disk(i);
                if (last && std::hypot(d.x - last->x, d.y - last->y) + d.r <= last->r + slip) continue;
                last = d;
                const double radius = (d.r + slip) * outside;
                for (const double height : {0.0, heights[s]}) {
                    for (int side = 0; side < kSides; ++side) {
                        const glm::dvec2 corner = glm::dvec2(d.x, d.y) + radius * on_circle(side + 0.5, kSides);
                        out.push_back(space.point(corner.x, corner.y, height));
                    }
                }
            }
        }
    }
    return out;
}

/// The samples of a path within some seconds of the moment; count 0 if it has none then.
mobb::SampleRange samples_around(const mobb::PlacedClip& clip, double time, double seconds) {
    const int first = mobb::first_ending_after(clip, 0, clip.count(), time - seconds);
    const int last = mobb::first_ending_after(clip, 0, clip.count(), time + seconds);
    return {first, std::min(last + 1, clip.count()) - first};
}

/// Of a run the bounds are its walls, else those of the paths.
Bounds moment_bounds(const FittedScene& fitted, std::span<const DrawnAgent> people) {
    if (!fitted.scene().crowd) return bounds_of(people);
    const CrowdRun& crowd = *fitted.scene().crowd;
    Bounds bounds;
    bounds.add(glm::dvec3(-0.5 * crowd.area, 0));
    bounds.add(glm::dvec3(0.5 * crowd.area, crowd.seconds));
    return bounds;
}

/// The way that everybody has come, and fainter the one that is still ahead; all of it faint where nobody is there.
void add_ways(DrawList& list, std::span<const DrawnAgent> agents, const Moment& moment, float scale) {
    std::vector<std::optional<int>> sample(agents.size());
    for (const Body& body : moment.bodies) sample[static_cast<std::size_t>(body.agent)] = body.sample;
    for (std::size_t i = 0; i < agents.size(); ++i) {
        const DrawnAgent& agent = agents[i];
        if (agent.hidden) continue;
        mobb::SampleRange shown{0, agent.clip().count()};
        if (agents.size() > kMostPathsInFull || agent.run_agent >= 0)
            shown = samples_around(agent.clip(), moment.time, kWaySeconds);
        if (shown.count <= 0) continue;
        const Rgba ahead = with_alpha(agent.color, list.palette.dark ? 0.4f : 0.5f);
        if (agent.outlined) {
            add_floor_trace(list, agent, shown, 0, ahead, scale);
            continue;
        }
        // What somebody in a run played before is way so far.
        if (!sample[i] && agent.run_agent >= 0 && agent.begin() < moment.time) {
            add_floor_trace(list, agent, shown, 0, with_alpha(agent.color, 0.9f), 2.6f * scale);
            continue;
        }
        if (!sample[i] && agent.run_agent >= 0) {
            add_floor_trace(list, agent, shown, 0, ahead, 1.2f * scale);
            continue;
        }
        if (!sample[i]) {
            add_floor_trace(list, agent, shown, 0, with_alpha(ahead, 0.8f * ahead.a), scale);
            continue;
        }
        const int now = std::clamp(*sample[i], shown.first, shown.end() - 1);
        add_floor_trace(list, agent, {now, shown.end() - now}, 0, ahead, 1.2f * scale);
        add_floor_trace(list, agent, {shown.first, now - shown.first + 1}, 0, with_alpha(agent.color, 0.9f),
                        2.6f * scale);
    }
}

/// Only who is drawn whole, and how near the two are if they are two.
Moment of_whole_ones(const Moment& moment, std::span<const DrawnAgent> agents) {
    Moment out;
    out.time = moment.time;
    std::vector<int> index(moment.bodies.size(), -1);
    for (std::size_t i = 0; i < moment.bodies.size(); ++i) {
        if (!agents[static_cast<std::size_t>(moment.bodies[i].agent)].is_whole()) continue;
        index[i] = static_cast<int>(out.bodies.size());
        out.bodies.push_back(moment.bodies[i]);
    }
    for (const BodyPair& pair : moment.overlaps) {
        const int a = index[static_cast<std::size_t>(pair.a)];
        const int b = index[static_cast<std::size_t>(pair.b)];
        if (a >= 0 && b >= 0) out.overlaps.push_back({a, b, pair.clearance});
    }
    if (people_in(out) != 2 || !out.overlaps.empty()) return out;
    const int bodies = static_cast<int>(out.bodies.size());
    for (int i = 0; i < bodies; ++i) {
        for (int j = i + 1; j < bodies; ++j) {
            const Body &one = out.bodies[static_cast<std::size_t>(i)], &other = out.bodies[static_cast<std::size_t>(j)];
            if (one.agent == other.agent) continue;
            const mobb::Disk &a = one.disk, &b = other.disk;
            const double clearance = std::hypot(b.x - a.x, b.y - a.y) - a.r - b.r;
            if (!out.nearest || clearance < out.nearest->clearance) out.nearest = BodyPair{i, j, clearance};
        }
    }
    return out;
}

class MomentPicture final : public Picture {
  public:
    MomentPicture(KeptPaths& kept, const ViewState& view, const PictureOptions& options, const FollowedChoice* choice)
        : Picture(*kept.fitted(), view, options),
          crowd_(fitted_.scene().crowd.get()),
          heights_(cylinder_heights(agents_)) {
        // Time is no direction of this picture.
        view_.time_axis = false;
        if (view_.show == Show::plan) become_plan();
        const double time = crowd_ ? run_time(fitted_.scene(), view) : view.time.value_or(beginning(agents_));
        moment_ = moment_of(agents_, heights_, time);
        if (view_.query) moment_.bones = bones_then(agents_, moment_);
        // Of a run each person stands there with several plays.
        count_ = crowd_ ? crowd_->agents.size() : agents_.size();
        list_.moment = moment_.time;
        tells_all_ = view_.foreground.empty() || view_.query;
        told_ = tells_all_ ? moment_ : of_whole_ones(moment_, agents_);
        bounds_ = moment_bounds(fitted_, agents_);
        const bool someone_is_there = !crowd_ && !moment_.bodies.empty();
        outside_ = (moment_.time < bounds_.min.z || moment_.time >= bounds_.max.z) && !someone_is_there;
        if (!outside_) choice_ = choice;
        if (view_.query && view_.proof && shown_count(agents_) == 2) proof_ = &kept.proof(view_);
        const glm::dvec3 middle = bounds_.middle();
        list_.space = {{middle.x, middle.y, 0}, 1, camera_anchor(fitted_, view_, moment_.time)};
        const double highest = *std::max_element(heights_.begin(), heights_.end());
        floor_extent_ =
            crowd_ ? floor_stage(crowd_->area, 0, highest)
                   : floor_extent_of({bounds_.min.x, bounds_.min.y, 0}, {bounds_.max.x, bounds_.max.y, highest});
        // Walls hold everybody, wherever they will stand.
        if (!crowd_) standing_ = standing_room(list_.space, agents_, heights_, 0.02 * floor_extent_.step);
        corners_ = floor_corners(floor_extent_, list_.space);
        framed_ = ShownPoints(crowd_ ? corners_ : standing_);
        if (view_.show == Show::plan && view_.boxes) find_sections(kept);
        if (view_.frame_boxes && !crowd_) frame_boxes();
        // A plan has its numbers along the edges of the floor.
        if (view_.show == Show::plan) framed_.add(std::span(corners_).first(4));
        points_ = framed_;
        if (!crowd_) points_.add(std::span(corners_).first(4));
    }

  private:
    /// Nobody has a body in it.
    void become_plan() {
        view_.camera = camera_of_plan(view_.camera);
        for (DrawnAgent& agent : agents_) agent.skeleton = nullptr;
    }

    /// Of the boxes of levels, or of the pair under test.
    void find_sections(KeptPaths& kept) {
        DrawList drawn;
        drawn.palette = list_.palette;
        drawn.space = {{list_.space.origin.x, list_.space.origin.y, moment_.time}, 1};
        if (view_.query) {
            const RecordedQuery& recorded = kept.recorded(view_);
            const int event = event_of(view_.step, recorded.trace, fitted_, *view_.query);
            const QueryProgress progress = progress_at(recorded.trace, event, Past::pair);
            add_query_boxes(drawn, agents_, progress, pair_outline(view_), metrics_.scale);
        } else {
            drawn.agents = list_.agents;
            add_level_boxes(drawn, agents_, view_.levels, metrics_.scale);
            if (auto bar = kept.color_boxes(drawn, agents_, view_)) bars_.push_back(std::move(*bar));
        }
        sections_ = std::move(drawn.boxes);
    }

    /// Whenever they have a section.
    void frame_boxes() {
        for (const BoxInstance& box : sections_) {
            for (const glm::vec3 corner : box_corners(box)) framed_.add({corner.x, corner.y, 0});
        }
    }

    std::span<const DrawnAgent> persons() const { return std::span(agents_).first(count_); }

    /// Of a query whose two sides have skeletons, whenever it is.
    bool has_bones() const {
        return view_.query && std::ranges::all_of(agents_, [](const DrawnAgent& agent) { return agent.skeleton; });
    }

    OverlayContents words() override {
        OverlayContents out;
        out.bars = bars_;
        out.caption = moment_caption(list_.palette, agents_, told_, tells_all_ ? count_ : people_in(told_));
        if (outside_) mention_cursor_outside(out.caption, moment_.time, bounds_.min.z, bounds_.max.z);
        if (choice_) {
            out.caption.detail = choice_sentence(fitted_.scene(), *choice_);
            if (!choice_->comes_out) mention(out.caption, edited_run_warning(fitted_.scene(), *choice_));
            out.legend = candidate_legend(list_.palette, choice_->choice);
        }
        if (proof_ && proof_->at(moment_.time)) out.legend.push_back(proof_entry(list_.palette));
        const std::vector<LegendEntry> who = moment_legend(list_, persons(), agents_, view_, has_bones());
        out.legend.insert(out.legend.end(), who.begin(), who.end());
        return out;
    }

    std::vector<LabelRequest> content() override {
        if (view_.floor) {
            add_floor_grid(list_, floor_extent_, metrics_.scale);
            if (crowd_) add_walls(list_, crowd_->area, 0, kWallHeight, metrics_.scale);
            if (!floor_on_edge(list_.projection) && count_ <= kMostWithWays) {
                add_ways(list_, agents_, moment_, metrics_.scale);
            }
        }
        const bool walls = view_.boxes && view_.show == Show::moment;
        add_bodies(list_, agents_, moment_, {view_.disks, walls}, metrics_.scale);
        // Over the disks.
        add_sections(list_, sections_, 0, static_cast<float>(*std::ranges::max_element(heights_)), metrics_.scale);
        if (proof_) add_proof_pane(list_, *proof_, moment_.time, kWallHeight, metrics_.scale);
        std::vector<LabelRequest> notes;
        const auto add = [&](const std::vector<LabelRequest>& some) {
            notes.insert(notes.end(), some.begin(), some.end());
        };
        if (choice_) add(add_candidates(list_, fitted_, *choice_, metrics_));
        for (const DrawnAgent& agent : agents_) {
            if (crowd_ || names_fit(count_) || agent.name != view_.follow) continue;
            const double height = heights_[static_cast<std::size_t>(agent.index)];
            add(add_followed(list_, agent, moment_.time, height, metrics_));
        }
        if (crowd_ && !view_.follow.empty()) {
            const int followed = run_agent_by_name(*crowd_, view_.follow).value_or(-1);
            add(add_followed(list_, agents_, followed, moment_.time, heights_.front(), metrics_));
        }
        const auto is_hidden = [&](const Body& body) { return agents_[static_cast<std::size_t>(body.agent)].hidden; };
        if (told_.nearest && view_.disks && (!tells_all_ || names_fit(count_))) {
            const Body& a = told_.bodies[static_cast<std::size_t>(told_.nearest->a)];
            const Body& b = told_.bodies[static_cast<std::size_t>(told_.nearest->b)];
            if (!is_hidden(a) && !is_hidden(b)) add(add_clearance(list_, a, b, metrics_));
        }
        if (moment_.bones && shown_count(agents_) == 2) add(add_nearest_bones(list_, agents_, moment_, metrics_));
        // Where two overlap, that is what the picture is about.
        if (view_.disks && may_show_radii(persons()) && moment_.overlaps.empty() && !moment_.bones) {
            for (const Body& body : moment_.bodies) {
                if (!sets_radius(body) || is_hidden(body)) continue;
                const auto length = add_radius(list_, agents_[static_cast<std::size_t>(body.agent)], body, metrics_);
                if (moment_.bodies.size() == 1) add(length);
            }
        }
        return notes;
    }

    void add_names_to(LabelLayout& layout) override {
        if (agents_.front().cell) return add_cell_names(list_, layout, agents_, 0, metrics_);
        add_body_names(list_, layout, agents_, moment_, metrics_);
    }

    const CrowdRun* crowd_;
    const FollowedChoice* choice_ = nullptr;
    const QueryProof* proof_ = nullptr;  ///< of the view's query, if it is shown
    std::vector<double> heights_;
    Moment moment_;
    bool tells_all_ = true;  ///< the words are about all, not about the foreground alone
    Moment told_;            ///< what they are about
    std::size_t count_ = 0;  ///< people
    Bounds bounds_;
    bool outside_ = false;  ///< nobody is there yet, or any more
    std::vector<glm::vec3> standing_, corners_;
    std::vector<ColorBar> bars_;
    std::vector<BoxInstance> sections_;  ///< boxes that a plan shows the sections of, the moment at height 0
};

}  // namespace

std::unique_ptr<Picture> moment_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                                        const FollowedChoice* choice) {
    return std::make_unique<MomentPicture>(kept, view, options, choice);
}

}  // namespace mobbscope
