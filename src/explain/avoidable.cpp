#include <explain/avoidable.h>
#include <explain/space_time_hull.h>
#include <mobb/query.h>
#include <scene/drawn_agent.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace mobbscope {

namespace {

/// Of which lines one box of a kind can be made tight along any; none of a kind that has no direction.
std::optional<Lines> lines_of(mobb::BoxKind kind) {
    const mobb::BoxInfo& box = mobb::info(kind);
    if (box.round) return std::nullopt;
    if (box.axes == mobb::BoxAxes::world) return Lines::axes;
    return box.is_upright() ? Lines::fixed : Lines::moving;
}

/// A node's box as its test sees it: of a kind that moves for the common time.
HullOfPoints hull_of_box(const mobb::PlacedTree& tree, int node, mobb::Interval common, glm::dvec3 origin) {
    const mobb::Box box = world_box(tree, node);
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    std::array<double, 2> ends{-1, 1};
    if (mobb::info(box.kind).moves && box.half.z > 0) {
        const double w = tree.time_scale();
        ends = {(w * common.t0 - box.center.z) / box.half.z, (w * common.t1 - box.center.z) / box.half.z};
    }
    std::vector<glm::dvec3> corners;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : ends) {
                glm::dvec3 corner = box.center + x * edges[0] + y * edges[1] + z * edges[2];
                corner.z /= tree.time_scale();
                corners.push_back(corner - origin);
            }
        }
    }
    return HullOfPoints(std::move(corners));
}

/// Judges overlaps of one query.
class Judge {
  public:
    Judge(const mobb::PlacedTree& a, const mobb::PlacedTree& b)
        : a_(a), b_(b), least_gap_(line_tolerance(std::max(farthest(a.frame()), farthest(b.frame())))) {}

    std::optional<AvoidableOverlap> judge(const mobb::Trace::Event& overlap) {
        const mobb::Node& node_a = a_.node(overlap.a);
        const mobb::Node& node_b = b_.node(overlap.b);
        const mobb::Interval common{std::max(a_.begin(node_a), b_.begin(node_b)),
                                    std::min(a_.end(node_a), b_.end(node_b))};
        const mobb::Disk near = a_.placed_clip().disk(node_a.first);
        const glm::dvec3 origin(near.x, near.y, common.t0);
        const HullOfDisks shared_a(a_, overlap.a, common, origin), shared_b(b_, overlap.b, common, origin);
        const mobb::Box box_a = world_box(a_, overlap.a), box_b = world_box(b_, overlap.b);
        const double steepness = steepness_of(box_a, box_b, common);
        const auto line = line_between(shared_a, shared_b, Lines::moving, steepness, least_gap_);
        visits_ += shared_a.visits() + shared_b.visits();
        if (!line) return std::nullopt;
        // Less what rounding may have added.
        const double gap = line->gap - least_gap_;
        return AvoidableOverlap{{common.t0, common.t1, line->direction, line->speed, gap},
                                blame(overlap, common, origin, steepness)};
    }
    std::int64_t visits() const { return visits_; }

  private:
    static double farthest(const mobb::PlacedFrame& frame) { return mobb::l1_norm(frame.translate) + frame.reach; }

    /// A line that crosses both boxes in a tenth of their common time.
    static double steepness_of(const mobb::Box& a, const mobb::Box& b, mobb::Interval common) {
        double reach = 1e-3;
        for (const mobb::Box* box : {&a, &b}) {
            for (const glm::dvec3 edge : mobb::half_edges(*box)) reach += mobb::l1_norm(glm::dvec2(edge));
        }
        return 10 * reach / (common.t1 - common.t0);
    }

    Blame blame(const mobb::Trace::Event& overlap, mobb::Interval common, glm::dvec3 origin, double steepness) {
        const mobb::BoxKind kind_a = a_.node(overlap.a).kind, kind_b = b_.node(overlap.b).kind;
        const std::optional<Lines> lines_a = lines_of(kind_a), lines_b = lines_of(kind_b);
        if (!lines_a || !lines_b) return Blame::none;
        constexpr double kEver = std::numeric_limits<double>::infinity();
        const HullOfDisks disks_a(a_, overlap.a, {-kEver, kEver}, origin),
            disks_b(b_, overlap.b, {-kEver, kEver}, origin);
        const auto between = [&](const SpaceTimeHull& a, const SpaceTimeHull& b, Lines lines) {
            return line_between(a, b, lines, steepness, least_gap_);
        };
        const auto of_a = between(disks_a, hull_of_box(b_, overlap.b, common, origin), *lines_a);
        const auto of_b = between(hull_of_box(a_, overlap.a, common, origin), disks_b, *lines_b);
        Blame out = Blame::none;
        if (of_a && of_b) {
            const auto rank_a = std::tuple(a_.tree().level(overlap.a), of_a->gap);
            const auto rank_b = std::tuple(b_.tree().level(overlap.b), of_b->gap);
            out = rank_a >= rank_b ? Blame::a : Blame::b;
        } else if (of_a || of_b) {
            out = of_a ? Blame::a : Blame::b;
        } else if (between(disks_a, disks_b, std::min(*lines_a, *lines_b))) {
            out = Blame::both;
        }
        visits_ += disks_a.visits() + disks_b.visits();
        return out;
    }

    const mobb::PlacedTree& a_;
    const mobb::PlacedTree& b_;
    double least_gap_;
    std::int64_t visits_ = 0;
};

bool is_overlap(const mobb::Trace::Event& event) {
    return event.test.is_box() && event.outcome == mobb::Outcome::overlap;
}

}  // namespace

std::optional<AvoidableOverlap> avoidable_overlap(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                                  const mobb::Trace::Event& event) {
    return is_overlap(event) ? Judge(a, b).judge(event) : std::nullopt;
}

const AvoidableOverlap* AvoidableOverlaps::at(int event) const {
    const auto place = std::ranges::lower_bound(events, event);
    return place != events.end() && *place == event ? &found[static_cast<std::size_t>(place - events.begin())]
                                                    : nullptr;
}

std::int64_t AvoidableOverlaps::before(int end) const { return std::ranges::lower_bound(events, end) - events.begin(); }

AvoidableOverlaps avoidable_overlaps(const mobb::Trace& trace, const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                     std::int64_t most_visits, const Progress& progress) {
    AvoidableOverlaps out;
    // Above a hit there is no line: nobody needs to look.
    std::vector<bool> above_hit(static_cast<std::size_t>(trace.size()));
    for (int event = 0; event < trace.size(); ++event) {
        if (trace[event].outcome != mobb::Outcome::hit) continue;
        for (int i = event; i >= 0; i = trace[i].parent) above_hit[static_cast<std::size_t>(i)] = true;
    }
    Judge judge(a, b);
    for (int event = 0; event < trace.size(); ++event) {
        if (!is_overlap(trace[event])) continue;
        ++out.overlaps;
        if (judge.visits() > most_visits) continue;
        ++out.judged;
        if (above_hit[static_cast<std::size_t>(event)]) continue;
        const auto found = judge.judge(trace[event]);
        if (progress) progress(static_cast<std::size_t>(event), static_cast<std::size_t>(trace.size()));
        if (!found) continue;
        out.events.push_back(event);
        out.found.push_back(*found);
    }
    return out;
}

std::int64_t BlameInScene::of(int clip, int node) const {
    const BlameByNode& nodes = of_clip[static_cast<std::size_t>(clip)];
    return nodes.empty() ? 0 : nodes[static_cast<std::size_t>(node)];
}

void BlameInScene::add(const FittedScene& fitted, const SceneQuery& query, const mobb::Trace& trace,
                       const AvoidableOverlaps& avoidable) {
    const std::array<int, 2> clips{query.a.clip, query.b.clip};
    overlaps += static_cast<std::int64_t>(avoidable.found.size());
    // Trees of members are no clip's.
    if (query.a.member >= 0 || query.b.member >= 0) return;
    for (const int clip : clips) of_clip[static_cast<std::size_t>(clip)].resize(fitted.tree(clip).nodes().size());
    for (std::size_t i = 0; i < avoidable.events.size(); ++i) {
        const mobb::Trace::Event event = trace[avoidable.events[i]];
        const Blame blame = avoidable.found[i].blame;
        for (int side = 0; side < 2; ++side) {
            if (!blames(blame, side)) continue;
            BlameByNode& nodes = of_clip[static_cast<std::size_t>(clips[static_cast<std::size_t>(side)])];
            ++nodes[static_cast<std::size_t>(side == 0 ? event.a : event.b)];
        }
        without_blame += blame == Blame::none ? 1 : 0;
    }
}

BlameInScene blame_in(const FittedScene& fitted, const Progress& progress) {
    BlameInScene out(fitted);
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery recorded = record(fitted, query);
        out.add(fitted, query, recorded.trace,
                avoidable_overlaps(recorded.trace, fitted.placed(query.a), fitted.placed(query.b)));
        if (progress) progress(i + 1, fitted.queries().size());
    }
    return out;
}

}  // namespace mobbscope
