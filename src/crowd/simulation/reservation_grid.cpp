#include <crowd/simulation/reservation_grid.h>
#include <mobb/predicate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>

namespace mobbscope {

namespace {

constexpr double kCell = 4;       // metres: about what a clip of two seconds covers
constexpr int kMostCells = 1024;  // in a row or column: a huge floor gets larger cells

int cells_along(double length) {
    return static_cast<int>(std::clamp(std::ceil(length / kCell), 1.0, static_cast<double>(kMostCells)));
}

/// Puts a value where `free` says that there is none, or else at the end; returns where.
template <class T>
std::uint32_t put(std::vector<T>& values, std::vector<std::uint32_t>& free, const T& value) {
    if (free.empty()) {
        values.push_back(value);
        return static_cast<std::uint32_t>(values.size() - 1);
    }
    const std::uint32_t place = free.back();
    free.pop_back();
    values[place] = value;
    return place;
}

/// Into the processor's caches: values up to `end`, the first few lines of them.
template <class T>
void fetch(const T* from, const T* end) {
    constexpr std::ptrdiff_t kLine = 64 / sizeof(T), kMost = 8 * kLine;
    for (end = from + std::min(end - from, kMost); from < end; from += kLine) __builtin_prefetch(from);
}

/// Refuses what is not a number: nothing would be near it.
void check_numbers(const char* what, std::initializer_list<double> values) {
    for (const double value : values) {
        if (std::isnan(value)) [[unlikely]]
            throw std::invalid_argument(std::string(what) + " must not be NaN");
    }
}

glm::dvec2 checked_area(glm::dvec2 area) {
    for (const double side : {area.x, area.y}) {
        if (!(side > 0 && std::isfinite(side)))
            throw std::invalid_argument("area must be finite and over 0 m along both sides");
    }
    return area;
}

/// Row by row: visit(x, y).
void for_each_cell(const auto& range, const auto& visit) {
    for (int y = range.y0; y <= range.y1; ++y) {
        for (int x = range.x0; x <= range.x1; ++x) visit(x, y);
    }
}

}  // namespace

std::size_t count_before(double limit, const std::vector<double>& numbers) {
    const double* from = numbers.data();
    for (std::size_t left = numbers.size(); left > 0;) {
        const std::size_t half = (left + 1) / 2;
        from += half * static_cast<std::size_t>(from[half - 1] < limit);
        left -= half;
    }
    return static_cast<std::size_t>(from - numbers.data());
}

ReservationGrid::ReservationGrid(glm::dvec2 area)
    : low_(-checked_area(area) / 2.0),
      columns_(cells_along(area.x)),
      rows_(cells_along(area.y)),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    per_metre_ = glm::dvec2(columns_, rows_) / area;
}

ReservationGrid::CellRange ReservationGrid::cells_of(const FloorRect& rect) const {
    const auto along = [](double at, double low, double per_metre, int count) {
        return static_cast<std::int16_t>(std::clamp((at - low) * per_metre, 0.0, count - 1.0));
    };
    return {along(rect.low.x, low_.x, per_metre_.x, columns_), along(rect.low.y, low_.y, per_metre_.y, rows_),
            along(rect.high.x, low_.x, per_metre_.x, columns_), along(rect.high.y, low_.y, per_metre_.y, rows_)};
}

std::size_t ReservationGrid::reserve(const PlayedMove& motion) {
    const std::uint32_t place = put(motions_, unused_, motion);
    const CellRange cells = cells_of(motion.bounds);
    const std::uint32_t slot = put(held_, free_, Held{cells, place, false});
    const Entry entry{motion.bounds, motion.begin(), motion.end(), motion.agent, slot, place, cells.x0, cells.y0};
    longest_ = std::max(longest_, entry.end - entry.begin);
    latest_end_ = std::max(latest_end_, entry.end);
    for_each_cell(cells, [&](int x, int y) {
        Cell& cell = cells_[index(x, y)];
        const auto next = std::ranges::upper_bound(cell.begins, entry.begin);
        cell.entries.insert(cell.entries.begin() + (next - cell.begins.begin()), entry);
        cell.begins.insert(next, entry.begin);
    });
    endings_.push({entry.end, slot});
    return slot;
}

void ReservationGrid::withdraw(std::size_t reservation) {
    // Its slot is used again when it would have ended, its place in memory at once.
    Held& held = held_[reservation];
    for_each_cell(held.cells, [&](int x, int y) {
        Cell& cell = cells_[index(x, y)];
        const auto entry = std::ranges::find(cell.entries, reservation, &Entry::slot);
        cell.begins.erase(cell.begins.begin() + (entry - cell.entries.begin()));
        cell.entries.erase(entry);
    });
    held.withdrawn = true;
    unused_.push_back(held.place);
}

void ReservationGrid::forget_before(double now) {
    check_numbers("now", {now});
    while (!endings_.empty() && endings_.top().end <= now) {
        const std::uint32_t slot = endings_.top().slot;
        endings_.pop();
        if (!held_[slot].withdrawn) withdraw(slot);
        free_.push_back(slot);
    }
}

std::size_t ReservationGrid::bytes() const {
    const auto room = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
    std::size_t bytes = sizeof(*this) + room(cells_) + room(held_) + room(free_) + room(motions_) + room(unused_) +
                        endings_.size() * sizeof(Ending);
    for (const Cell& cell : cells_) bytes += room(cell.begins) + room(cell.entries);
    return bytes;
}

template <class Meets, class Visit>
void ReservationGrid::visit_cells(const CellRange& range, double from, double to, const Meets& meets,
                                  const Visit& visit) const {
    struct Window {
        const Entry* next;
        const Entry* last;
        int x, y;
    };
    constexpr std::ptrdiff_t kAtATime = 32;
    std::array<Window, kAtATime> windows;
    std::size_t count = 0;
    const auto visit_windows = [&] {
        for (auto [next, last, x, y] : std::span(windows).first(count)) {
            std::array<const Entry*, kAtATime> met;
            while (next < last) {
                std::size_t meeting = 0;
                for (const Entry* const end = next + std::min(kAtATime, last - next); next != end; ++next) {
                    // Of the cells of the range that a motion reaches into, the first one reports it. Without a branch
                    // for each, which would often be mispredicted.
                    const unsigned is_first = static_cast<unsigned>(x == std::max(range.x0, next->x0)) &
                                              static_cast<unsigned>(y == std::max(range.y0, next->y0));
                    met[meeting] = next;
                    meeting += is_first & static_cast<unsigned>(meets(*next));
                }
                for (std::size_t i = 0; i < meeting; ++i) visit(*met[i]);
            }
        }
        count = 0;
    };
    // What belongs to a cell lies anywhere in memory: of all cells it is fetched before it is read of one.
    for_each_cell(range, [&](int x, int y) {
        const std::vector<double>& begins = cells_[index(x, y)].begins;
        fetch(begins.data(), begins.data() + begins.size());
    });
    for_each_cell(range, [&](int x, int y) {
        const auto& [begins, entries] = cells_[index(x, y)];
        const Entry* const first = entries.data() + count_before(from, begins);
        const Entry* const last = entries.data() + count_before(to, begins);
        fetch(first, last);
        windows[count++] = {first, last, x, y};
        if (count == windows.size()) visit_windows();
    });
    visit_windows();
}

void ReservationGrid::find_around(int agent, const FloorRect& bounds, double begin, double end,
                                  Surroundings& out) const {
    check_numbers("bounds", {bounds.low.x, bounds.low.y, bounds.high.x, bounds.high.y});
    check_numbers("begin and end", {begin, end});
    out.refill([&](std::vector<Surroundings::Near>& near) {
        // Most plans go on when all that is played has ended.
        if (begin >= latest_end_) return;
        // What began longer ago than any motion lasts has ended; the margin is far more than rounding.
        const double from = begin - longest_ - 1e-12 * std::abs(begin);
        const auto meets = [&](const Entry& other) {
            return static_cast<unsigned>(other.agent != agent) &
                   static_cast<unsigned>(mobb::overlap_in_time(begin, end, other.begin, other.end)) &
                   static_cast<unsigned>(bounds.meets(other.bounds));
        };
        visit_cells(cells_of(bounds), from, end, meets, [&](const Entry& other) {
            near.push_back({other.bounds, other.begin, other.end, &motions_[other.place]});
        });
    });
}

void ReservationGrid::all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const {
    check_numbers("range", {range});
    FloorRect reach = candidate.bounds;
    reach.low -= range;
    reach.high += range;
    std::vector<std::uint32_t> slots;
    constexpr double kEver = std::numeric_limits<double>::infinity();
    const auto meets = [&](const Entry& other) { return other.agent != candidate.agent && reach.meets(other.bounds); };
    visit_cells(cells_of(reach), -kEver, kEver, meets, [&](const Entry& other) { slots.push_back(other.slot); });
    std::sort(slots.begin(), slots.end());
    for (const std::uint32_t slot : slots) pairs.push_back({candidate, motions_[held_[slot].place]});
}

}  // namespace mobbscope
