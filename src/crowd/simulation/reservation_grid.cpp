#include <crowd/simulation/reservation_grid.h>
#include <mobb/production.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <optional>
#include <tuple>

namespace mobbscope {

namespace {

constexpr double kCell = 4;         // metres: about what a clip of two seconds covers
constexpr int kMostCells = 1024;    // in a row or column: a huge floor gets larger cells
constexpr std::size_t kGrain = 64;  // candidates a task: fewer are not worth a thread
constexpr std::size_t kUsuallyNear = 32;

int cells_along(double length) {
    return static_cast<int>(std::clamp(std::ceil(length / kCell), 1.0, static_cast<double>(kMostCells)));
}

/// Row by row: visit(x, y).
void for_each_cell(const auto& range, const auto& visit) {
    for (int y = range.y0; y <= range.y1; ++y) {
        for (int x = range.x0; x <= range.x1; ++x) visit(x, y);
    }
}

std::optional<mobb::Contact> contact_of(const PlayedMove& a, const PlayedMove& b) {
    return a.playable->tree ? mobb::query(a.placed_tree(), b.placed_tree()) : mobb::query(a.placed, b.placed);
}

/// Adds the seconds over which two collide to `seconds`. What makes them more than `most` may be counted in part.
void add_contact(const PlayedMove& a, const PlayedMove& b, double most, double& seconds) {
    const auto add = [&seconds](const std::vector<mobb::Interval>& intervals) {
        for (const mobb::Interval& interval : intervals) seconds += interval.t1 - interval.t0;
    };
    if (a.playable->tree) return add(mobb::contact_intervals(a.placed_tree(), b.placed_tree()));
    struct Sink {
        mobb::IntervalCollector<mobb::PlacedBlocks, mobb::PlacedBlocks> collector;
        double before, most;
    } sink{{a.placed, b.placed, {}}, seconds, most};
    const auto on_hit = [](void* receiver, int i, int j) {
        auto& [collector, before, enough] = *static_cast<Sink*>(receiver);
        collector(i, j);
        const mobb::Interval& last = collector.intervals.back();
        return before + (last.t1 - last.t0) > enough;
    };
    mobb::for_each_hit(a.placed, b.placed, {on_hit, &sink});
    add(sink.collector.intervals);
}

}  // namespace

ReservationGrid::ReservationGrid(glm::dvec2 area)
    : low_(-area / 2.0),
      columns_(cells_along(area.x)),
      rows_(cells_along(area.y)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    per_metre_ = glm::dvec2(columns_, rows_) / area;
}

ReservationGrid::CellRange ReservationGrid::cells_of(const FloorRect& rect) const {
    const auto along = [](double at, double low, double per_metre, int count) {
        return static_cast<int>(std::clamp((at - low) * per_metre, 0.0, count - 1.0));
    };
    return {along(rect.low.x, low_.x, per_metre_.x, columns_), along(rect.low.y, low_.y, per_metre_.y, rows_),
            along(rect.high.x, low_.x, per_metre_.x, columns_), along(rect.high.y, low_.y, per_metre_.y, rows_)};
}

std::size_t ReservationGrid::reserve(const PlayedMove& motion) {
    auto slot = static_cast<std::uint32_t>(motions_.size());
    const Held held{motion, cells_of(motion.bounds), false};
    if (free_.empty()) {
        motions_.push_back(held);
    } else {
        slot = free_.back();
        free_.pop_back();
        motions_[slot] = held;
    }
    const Entry entry{motion.bounds, motion.begin(), motion.end(), motion.agent, slot, held.cells.x0, held.cells.y0};
    longest_ = std::max(longest_, entry.end - entry.begin);
    for_each_cell(held.cells, [&](int x, int y) {
        std::vector<Entry>& cell = cells_[index(x, y)];
        cell.insert(std::ranges::upper_bound(cell, entry.begin, {}, &Entry::begin), entry);
    });
    endings_.push({entry.end, slot});
    return slot;
}

void ReservationGrid::withdraw(std::size_t reservation) {
    // Its slot is used again when it would have ended.
    Held& held = motions_[reservation];
    for_each_cell(held.cells, [&](int x, int y) {
        std::vector<Entry>& cell = cells_[index(x, y)];
        cell.erase(std::ranges::find(cell, reservation, &Entry::slot));
    });
    held.withdrawn = true;
}

void ReservationGrid::forget_before(double now) {
    while (!endings_.empty() && endings_.top().end <= now) {
        const std::uint32_t slot = endings_.top().slot;
        endings_.pop();
        if (!motions_[slot].withdrawn) withdraw(slot);
        free_.push_back(slot);
    }
}

template <class Visit>
void ReservationGrid::visit_cells(const CellRange& range, double from, double to, const Visit& visit) const {
    for_each_cell(range, [&](int x, int y) {
        const std::vector<Entry>& cell = cells_[index(x, y)];
        for (auto entry = std::ranges::lower_bound(cell, from, {}, &Entry::begin);
             entry != cell.end() && entry->begin <= to; ++entry) {
            // Of the cells of the range that a motion reaches into, the first one reports it.
            if (x == std::max(range.x0, entry->x0) && y == std::max(range.y0, entry->y0)) visit(*entry);
        }
    });
}

/// What a look-up finds. For as many as there usually are no memory is allocated.
struct ReservationGrid::NearMotions {
    alignas(Near) std::array<std::byte, kUsuallyNear * sizeof(Near)> buffer;
    std::pmr::monotonic_buffer_resource memory{buffer.data(), buffer.size()};
    std::pmr::vector<Near> list{&memory};

    NearMotions() { list.reserve(kUsuallyNear); }
};

void ReservationGrid::find_near(const PlayedMove& candidate, NearMotions& near) const {
    const double begin = candidate.begin(), end = candidate.end();
    // What began longer ago than any motion lasts has ended; the margin is far more than rounding.
    const double from = begin - longest_ - 1e-12 * std::abs(begin);
    visit_cells(cells_of(candidate.bounds), from, end, [&](const Entry& other) {
        if (other.agent != candidate.agent && mobb::overlap_in_time(begin, end, other.begin, other.end) &&
            candidate.bounds.meets(other.bounds))
            near.list.push_back({other.begin, &motions_[other.slot].motion});
    });
    std::sort(near.list.begin(), near.list.end(), [](const Near& a, const Near& b) {
        if (a.begin != b.begin) return a.begin < b.begin;
        return std::tie(a.motion->agent, a.motion->play) < std::tie(b.motion->agent, b.motion->play);
    });
}

std::size_t ReservationGrid::first_met(const PlayedMove& candidate, std::span<const Near> near) {
    if (candidate.playable->tree) {
        const auto meets = [&](const Near& other) { return contact_of(candidate, *other.motion).has_value(); };
        return static_cast<std::size_t>(std::ranges::find_if(near, meets) - near.begin());
    }
    std::array<const mobb::PlacedBlocks*, kUsuallyNear> others;
    for (std::size_t begin = 0; begin < near.size(); begin += kUsuallyNear) {
        const std::size_t count = std::min(kUsuallyNear, near.size() - begin);
        for (std::size_t i = 0; i < count; ++i) others[i] = &near[begin + i].motion->placed;
        const auto met = mobb::intersects_any(candidate.placed, std::span(others).first(count));
        if (met) return begin + *met;
    }
    return near.size();
}

CandidateCheck ReservationGrid::check(const PlayedMove& candidate, std::vector<AskedPair>* asked) const {
    CandidateCheck check;
    NearMotions near;
    find_near(candidate, near);
    for (const auto& [begin, other] : near.list) {
        // What begins after the first contact cannot be met before it.
        if (check.blocker && begin > check.blocker->contact.time) break;
        ++check.asked;
        if (asked) asked->push_back({candidate, *other});
        const auto contact = contact_of(candidate, *other);
        if (!contact) continue;
        if (!check.blocker ||
            std::tuple(contact->time, other->agent) < std::tuple(check.blocker->contact.time, check.blocker->agent)) {
            check.blocker = {other->agent,       other->play, *contact,
                             other->planned,     other->move, other->playable->blocks.shared_clip(),
                             other->at.placement};
        }
    }
    return check;
}

std::vector<CandidateCheck> ReservationGrid::check_all(std::span<const PlayedMove* const> candidates,
                                                       std::vector<AskedPair>* asked) const {
    std::vector<CandidateCheck> out(candidates.size());
    std::vector<std::vector<AskedPair>> pairs(asked ? candidates.size() : 0);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            out[i] = check(*candidates[i], asked ? &pairs[i] : nullptr);
        }
    });
    for (const std::vector<AskedPair>& of_one : pairs) asked->insert(asked->end(), of_one.begin(), of_one.end());
    return out;
}

bool ReservationGrid::is_clear(const PlayedMove& candidate, std::int64_t& queries,
                               std::vector<AskedPair>* asked) const {
    NearMotions near;
    find_near(candidate, near);
    const std::size_t first = first_met(candidate, near.list);
    const std::size_t count = std::min(first + 1, near.list.size());
    queries += static_cast<std::int64_t>(count);
    if (asked) {
        for (std::size_t i = 0; i < count; ++i) asked->push_back({candidate, *near.list[i].motion});
    }
    return first == near.list.size();
}

bool ReservationGrid::is_clear(const PlayedMove& candidate) const {
    std::int64_t queries = 0;
    return is_clear(candidate, queries);
}

double ReservationGrid::seconds_of_contact(const PlayedMove& candidate, double most) const {
    double seconds = 0;
    NearMotions near;
    find_near(candidate, near);
    for (const Near& other : near.list) {
        if (seconds > most) break;
        add_contact(candidate, *other.motion, most, seconds);
    }
    return seconds;
}

void ReservationGrid::all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const {
    FloorRect reach = candidate.bounds;
    reach.low -= range;
    reach.high += range;
    std::vector<std::uint32_t> slots;
    constexpr double kEver = std::numeric_limits<double>::infinity();
    visit_cells(cells_of(reach), -kEver, kEver, [&](const Entry& other) {
        if (other.agent != candidate.agent && reach.meets(other.bounds)) slots.push_back(other.slot);
    });
    std::sort(slots.begin(), slots.end());
    for (const std::uint32_t slot : slots) pairs.push_back({candidate, motions_[slot].motion});
}

}  // namespace mobbscope
