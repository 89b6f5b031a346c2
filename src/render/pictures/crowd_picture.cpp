#include <base/text.h>
#include <mobb/traversal.h>
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
#include <render/pictures/picture.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kFlat = 0.4;
constexpr double kMostHeight = 4;  // metres drawn per second: people walk about a third of it
constexpr float kLeastRing = 3;    // pixels of radius

struct Seconds {
    double begin = 0, time = 0, end = 0;
};

std::string headline_of(std::size_t people, double time) {
    return (people == 0 ? "Nobody is on the floor" : counted(people, "agent", "agents")) + at_time(time);
}

/// Before a run some are there already, after it nobody is.
std::size_t people_at(std::span<const DrawnAgent> paths, double time) {
    std::set<int> people;
    for (const DrawnAgent& path : paths) {
        if (sample_at(path, time)) people.insert(path.run_agent);
    }
    return people.size();
}

std::string window_text(const Seconds& s) { return formatted("upwards from %.2f to %.2f s", s.begin, s.end); }

/// Boxes that begin before what is shown, or end behind it, would stand there empty.
void keep_within(DrawList& list, std::span<const DrawnAgent> paths, const Seconds& seconds) {
    std::erase_if(list.boxes, [&](const BoxInstance& box) {
        const mobb::PlacedTree& tree = paths[static_cast<std::size_t>(box.id.agent)].placed;
        const mobb::Node& node = tree.node(box.id.index);
        return tree.begin(node) < seconds.begin || tree.end(node) > seconds.end;
    });
}

std::vector<DrawnAgent> boxed(std::span<const DrawnAgent> paths, const ViewState& view, int followed) {
    std::size_t boxes = 0;
    std::vector<DrawnAgent> all;
    std::vector<DrawnAgent> own;
    for (const DrawnAgent& path : paths) {
        if (path.samples().count == 0 || !path.is_whole()) continue;
        if (boxes <= kMostCrowdBoxes) boxes += shown_nodes(path.placed.tree(), view.levels).size();
        all.push_back(path);
        if (path.run_agent == followed) own.push_back(path);
    }
    return boxes <= kMostCrowdBoxes ? all : own;
}

class CrowdPicture final : public Picture {
  public:
    CrowdPicture(KeptPaths& kept, const ViewState& view, const PictureOptions& options, const FollowedChoice* choice)
        : Picture(*kept.fitted(), view, options),
          crowd_(*fitted_.scene().crowd),
          time_(run_time(fitted_.scene(), view)) {
        outside_ = time_ < 0 || time_ >= crowd_.seconds;
        if (!outside_) choice_ = choice;
        seconds_ = {time_ - view.time_window, time_, time_ + view.time_window};
        followed_ = view.follow.empty() ? -1 : run_agent_by_name(crowd_, view.follow).value_or(-1);
        Bounds bounds;
        bounds.add(glm::dvec3(-0.5 * crowd_.area, seconds_.begin));
        bounds.add(glm::dvec3(0.5 * crowd_.area, seconds_.end));
        list_.space = space_for(bounds, view);
        // As tall as wide it would be a forest of poles.
        if (view.time_height <= 0) list_.space.time_height = std::min(kFlat * list_.space.time_height, kMostHeight);
        list_.space.anchor = camera_anchor(fitted_, view, time_);
        list_.slab = slab_of_view(view, list_.space);
        if (view.disks) kept.add_disks_of(list_, agents_, view, std::vector<PathFocus>(agents_.size()));
        if (view.boxes) {
            add_level_boxes(list_, boxed(agents_, view_, followed_), view_.levels, metrics_.scale);
            keep_within(list_, agents_, seconds_);
        }
        if (auto bar = kept.color_boxes(list_, agents_, view_)) bars_.push_back(std::move(*bar));
        if (auto bar = view.disks ? kept.heat_bar() : std::nullopt) bars_.push_back(std::move(*bar));
        floor_extent_ = floor_stage(crowd_.area, seconds_.begin, seconds_.end);
        framed_ = ShownPoints(floor_corners(floor_extent_, list_.space));
        points_ = framed_;
    }

  private:
    OverlayContents words() override {
        OverlayContents out;
        out.caption.headlines = {headline_of(outside_ ? people_at(agents_, time_) : crowd_.agents.size(), time_)};
        out.caption.detail = choice_ ? choice_sentence(fitted_.scene(), *choice_) : window_text(seconds_);
        if (choice_ && !choice_->comes_out) mention(out.caption, edited_run_warning(fitted_.scene(), *choice_));
        if (outside_) mention_cursor_outside(out.caption, time_, 0, crowd_.seconds);
        if (names_fit(crowd_.agents.size())) {
            out.legend = agent_entries(list_, std::span(agents_).first(crowd_.agents.size()), agents_);
        }
        if (choice_) {
            const auto fates = candidate_legend(list_.palette, choice_->choice);
            out.legend.insert(out.legend.end(), fates.begin(), fates.end());
        }
        out.legend.push_back(line_entry({list_.palette.accent, 1.3f}, "now"));
        out.bars = bars_;
        return out;
    }

    std::vector<LabelRequest> content() override {
        if (view_.boxes) refine_crowded_boxes(list_, metrics_.scale);
        if (view_.floor) {
            add_floor_grid(list_, floor_extent_, metrics_.scale);
            add_walls(list_, crowd_.area, seconds_.begin, seconds_.begin, metrics_.scale);
        }
        if (view_.time_axis) add_time_axis(list_, floor_extent_, metrics_.scale);
        if (list_.slab) add_slab_planes(list_, floor_extent_, *view_.slab, metrics_.scale);
        add_time_cursor(list_, floor_extent_, time_, metrics_.scale);
        if (view_.slice) add_slice();
        if (view_.disks) within_slab([&] { add_rings_and_outlines(); });
        std::vector<LabelRequest> notes;
        if (choice_) notes = add_candidates(list_, fitted_, *choice_, metrics_);
        if (followed_ >= 0) {
            const auto name = add_followed(list_, agents_, followed_, time_, 0, metrics_);
            notes.insert(notes.end(), name.begin(), name.end());
        }
        if (!view_.foreground.empty()) {
            const auto names = names_at(list_, agents_, time_, metrics_);
            notes.insert(notes.end(), names.begin(), names.end());
        }
        return notes;
    }

    void add_rings_and_outlines() {
        add_rings_now();
        for (const DrawnAgent& agent : agents_) {
            if (agent.outlined && !agent.hidden) add_path_outline(list_, agent, metrics_.scale);
        }
    }

    void add_slice() {
        DrawList drawn;
        drawn.palette = list_.palette;
        drawn.space = list_.space;
        if (view_.boxes) {
            std::ranges::copy_if(list_.boxes, std::back_inserter(drawn.boxes), &BoxInstance::pickable);
        } else {
            add_level_boxes(drawn, boxed(agents_, view_, followed_), view_.levels, metrics_.scale);
        }
        const float height = list_.space.point(0, 0, time_).z;
        add_sections(list_, drawn.boxes, height, height, metrics_.scale);
    }

    /// Around everybody at the time, where they are large enough to be seen.
    void add_rings_now() {
        const Rect picture{glm::vec2(0), glm::vec2(list_.size.width, list_.size.height)};
        for (const DrawnAgent& agent : agents_) {
            const auto sample = sample_at(agent, time_);
            if (!sample || agent.hidden) continue;
            const mobb::Disk disk = mobb::swept(agent.clip(), *sample).at(time_);
            const glm::vec3 middle = list_.space.point(disk.x, disk.y, time_);
            const float radius = static_cast<float>(disk.r) * list_.projection.pixels_per_metre(middle);
            const auto pixel = list_.projection.project(middle);
            if (radius < kLeastRing || !pixel || !picture.grown(2 * radius).contains({*pixel, *pixel})) continue;
            const int pieces = std::clamp(static_cast<int>(1.5f * radius), 10, 48);
            add_cursor_ring(list_, agent, *sample, time_, metrics_.scale, pieces);
        }
    }

    const CrowdRun& crowd_;
    const FollowedChoice* choice_ = nullptr;
    double time_;
    bool outside_ = false;
    Seconds seconds_;
    int followed_ = -1;
    std::vector<ColorBar> bars_;
};

}  // namespace

std::unique_ptr<Picture> crowd_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                                       const FollowedChoice* choice) {
    return std::make_unique<CrowdPicture>(kept, view, options, choice);
}

}  // namespace mobbscope
