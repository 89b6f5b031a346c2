#include <crowd/simulation/reservation_grid.h>

#include <glm/common.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace mobbscope {

namespace {

constexpr double kCell = 4;         // metres: about what a clip of two seconds covers
constexpr int kMostCells = 1024;    // in a row or column: a huge floor gets larger cells
constexpr std::size_t kGrain = 16;  // candidates a task: fewer are not worth a thread

int cells_along(double length) {
    return static_cast<int>(std::clamp(std::ceil(length / kCell), 1.0, static_cast<double>(kMostCells)));
}

/// Row by row: visit(x, y).
void for_each_cell(const auto& range, const auto& visit) {
    for (int y = range.y0; y <= range.y1; ++y) {
        for (int x = range.x0; x <= range.x1; ++x) visit(x, y);
    }
}

bool other_and_overlapping(const auto& a, const auto& b) {
    return a.motion.agent != b.motion.agent && mobb::overlap_in_time(a.begin, a.end, b.begin, b.end);
}

}  // namespace

FloorRect ClipBounds::bounds(const mobb::Placement& placement) const {
    const mobb::Rotation rotation = mobb::Rotation::from_degrees(placement.rotate_deg);
    FloorRect rect{glm::dvec2(std::numeric_limits<double>::infinity()),
                   glm::dvec2(-std::numeric_limits<double>::infinity())};
    for (const glm::dvec2 corner : corners_) {
        const glm::dvec2 at = rotation(corner) + placement.translate;
        rect.low = glm::min(rect.low, at);
        rect.high = glm::max(rect.high, at);
    }
    // Far more than all rounding made here and where disks are placed.
    const double margin = 1e-12 * (reach_ + std::abs(placement.translate.x) + std::abs(placement.translate.y));
    rect.low -= margin;
    rect.high += margin;
    return rect;
}

bool leaves_floor(const mobb::PlacedClip& clip, const ClipBounds& clip_bounds, glm::dvec2 area) {
    const glm::dvec2 wall = area / 2.0;
    const FloorRect rect = clip_bounds.bounds(clip.placement());
    if (rect.low.x >= -wall.x && rect.low.y >= -wall.y && rect.high.x <= wall.x && rect.high.y <= wall.y) return false;
    for (int i = 0; i < clip.count(); ++i) {
        const mobb::Disk disk = clip.disk(i);
        if (std::abs(disk.x) + disk.r > wall.x || std::abs(disk.y) + disk.r > wall.y) return true;
    }
    return false;
}

ReservationGrid::ReservationGrid(glm::dvec2 area)
    : low_(-area / 2.0),
      columns_(cells_along(area.x)),
      rows_(cells_along(area.y)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    cell_size_ = area / glm::dvec2(columns_, rows_);
}

ReservationGrid::CellRange ReservationGrid::cells_of(const FloorRect& rect) const {
    const auto along = [](double at, double low, double size, int count) {
        return static_cast<int>(std::clamp(std::floor((at - low) / size), 0.0, count - 1.0));
    };
    return {along(rect.low.x, low_.x, cell_size_.x, columns_), along(rect.low.y, low_.y, cell_size_.y, rows_),
            along(rect.high.x, low_.x, cell_size_.x, columns_), along(rect.high.y, low_.y, cell_size_.y, rows_)};
}

ReservationGrid::Held ReservationGrid::held(const PlayedMove& motion) const {
    const mobb::PlacedClip placed(motion.tree->clip(), motion.placement);
    const FloorRect bounds = motion.clip_bounds->bounds(motion.placement);
    return {motion, bounds, cells_of(bounds), placed.time(0), placed.time(placed.count())};
}

std::size_t ReservationGrid::reserve(const PlayedMove& motion) {
    auto slot = static_cast<std::uint32_t>(motions_.size());
    if (free_.empty()) {
        motions_.push_back(held(motion));
    } else {
        slot = free_.back();
        free_.pop_back();
        motions_[slot] = held(motion);
    }
    for_each_cell(motions_[slot].cells, [&](int x, int y) { cells_[index(x, y)].push_back(slot); });
    endings_.push({motions_[slot].end, slot});
    return slot;
}

void ReservationGrid::withdraw(std::size_t reservation) {
    // Its slot is used again when it would have ended.
    const auto slot = static_cast<std::uint32_t>(reservation);
    for_each_cell(motions_[slot].cells, [&](int x, int y) { std::erase(cells_[index(x, y)], slot); });
    motions_[slot].motion.tree = nullptr;
}

void ReservationGrid::forget_before(double now) {
    while (!endings_.empty() && endings_.top().end <= now) {
        const std::uint32_t slot = endings_.top().slot;
        endings_.pop();
        if (motions_[slot].motion.tree) withdraw(slot);
        free_.push_back(slot);
    }
}

template <class Visit>
void ReservationGrid::visit_cells(const CellRange& range, const Visit& visit) const {
    for_each_cell(range, [&](int x, int y) {
        for (const std::uint32_t slot : cells_[index(x, y)]) {
            // Of the cells of the range that a motion reaches into, the first one reports it.
            const CellRange& cells = motions_[slot].cells;
            if (x == std::max(range.x0, cells.x0) && y == std::max(range.y0, cells.y0)) visit(slot);
        }
    });
}

void ReservationGrid::find_near(const Held& candidate, std::vector<std::uint32_t>& slots) const {
    visit_cells(candidate.cells, [&](std::uint32_t slot) {
        const Held& other = motions_[slot];
        if (other_and_overlapping(candidate, other) && candidate.bounds.meets(other.bounds)) slots.push_back(slot);
    });
    std::sort(slots.begin(), slots.end(), [this](std::uint32_t a, std::uint32_t b) {
        const auto order = [this](std::uint32_t slot) {
            const Held& held = motions_[slot];
            return std::tuple(held.begin, held.motion.agent, held.motion.play);
        };
        return order(a) < order(b);
    });
}

CandidateCheck ReservationGrid::check(const PlayedMove& candidate, std::vector<AskedPair>* asked) const {
    CandidateCheck check;
    std::vector<std::uint32_t> slots;
    find_near(held(candidate), slots);
    const mobb::PlacedTree placed(*candidate.tree, candidate.placement);
    for (const std::uint32_t slot : slots) {
        const Held& other = motions_[slot];
        // What begins after the first contact cannot be met before it.
        if (check.blocker && other.begin > check.blocker->contact.time) break;
        ++check.asked;
        if (asked) asked->push_back({candidate, other.motion});
        const auto contact = mobb::query(placed, mobb::PlacedTree(*other.motion.tree, other.motion.placement));
        if (!contact) continue;
        if (!check.blocker || std::tuple(contact->time, other.motion.agent) <
                                  std::tuple(check.blocker->contact.time, check.blocker->agent)) {
            const PlayedMove& met = other.motion;
            check.blocker = {met.agent,    met.play, *contact, met.planned, met.move, met.tree->shared_clip(),
                             met.placement};
        }
    }
    return check;
}

std::vector<CandidateCheck> ReservationGrid::check_all(std::span<const PlayedMove> candidates,
                                                       std::vector<AskedPair>* asked) const {
    std::vector<CandidateCheck> out(candidates.size());
    std::vector<std::vector<AskedPair>> pairs(asked ? candidates.size() : 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            out[i] = check(candidates[i], asked ? &pairs[i] : nullptr);
        }
    });
    for (const std::vector<AskedPair>& of_one : pairs) asked->insert(asked->end(), of_one.begin(), of_one.end());
    return out;
}

bool ReservationGrid::is_clear(const PlayedMove& candidate, std::int64_t& queries,
                               std::vector<AskedPair>* asked) const {
    std::vector<std::uint32_t> slots;
    find_near(held(candidate), slots);
    const mobb::PlacedTree placed(*candidate.tree, candidate.placement);
    return std::ranges::none_of(slots, [&](std::uint32_t slot) {
        const PlayedMove& other = motions_[slot].motion;
        ++queries;
        if (asked) asked->push_back({candidate, other});
        return mobb::query(placed, mobb::PlacedTree(*other.tree, other.placement)).has_value();
    });
}

double ReservationGrid::seconds_of_contact(const PlayedMove& candidate) const {
    std::vector<std::uint32_t> slots;
    find_near(held(candidate), slots);
    const mobb::PlacedTree placed(*candidate.tree, candidate.placement);
    double seconds = 0;
    for (const std::uint32_t slot : slots) {
        const PlayedMove& other = motions_[slot].motion;
        for (const mobb::Interval& interval :
             mobb::contact_intervals(placed, mobb::PlacedTree(*other.tree, other.placement)))
            seconds += interval.t1 - interval.t0;
    }
    return seconds;
}

void ReservationGrid::all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const {
    FloorRect reach = candidate.clip_bounds->bounds(candidate.placement);
    reach.low -= range;
    reach.high += range;
    std::vector<std::uint32_t> slots;
    visit_cells(cells_of(reach), [&](std::uint32_t slot) {
        const Held& other = motions_[slot];
        if (other.motion.agent != candidate.agent && reach.meets(other.bounds)) slots.push_back(slot);
    });
    std::sort(slots.begin(), slots.end());
    for (const std::uint32_t slot : slots) pairs.push_back({candidate, motions_[slot].motion});
}

}  // namespace mobbscope
