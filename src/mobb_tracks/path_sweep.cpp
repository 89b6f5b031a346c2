#include <mobb/predicate.h>
#include <mobb_tracks/path_sweep.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace mobb {

namespace {

constexpr int kMostSamples = 16;     // of a piece
constexpr double kMostGrowth = 1.7;  // a piece is at most so many times as wide as its first sample
constexpr int kMostCells = 64;       // a piece that covers more is not in the grid
// Widen the pieces by more than any rounding of the predicate, of held and of linear clips (see mobb/separation.cpp):
// it must not hit where they are apart.
constexpr double kHeldWidening = 1e-14;
constexpr double kLinearWidening = 1e-6;

struct Cell {
    std::int32_t x, y;
    friend bool operator==(const Cell&, const Cell&) = default;
};

/// Square cells on the floor with those who are in them, by numbers.
class FloorGrid {
  public:
    explicit FloorGrid(double size) : per_metre_(1 / size), places_(1024) {}

    struct Cells {
        Cell low, high;
        bool are_few() const {
            return (std::int64_t{high.x} - low.x + 1) * (std::int64_t{high.y} - low.y + 1) <= kMostCells;
        }
    };
    Cells cells_of(const PathPiece& piece) const { return {cell(piece.x0, piece.y0), cell(piece.x1, piece.y1)}; }
    Cell cell(double x, double y) const { return {whole(x * per_metre_), whole(y * per_metre_)}; }

    /// Calls visit(number, cell) for all who are in some of the cells, and puts another one into all of them.
    template <class Visit>
    void visit_and_add(const Cells& cells, int number, const Visit& visit) {
        for_each(cells, [&](Cell cell) {
            std::vector<Entry>& place = places_[index(cell)];
            for (const Entry& entry : place) {
                if (entry.cell == cell) visit(entry.number, cell);
            }
            place.push_back({cell, number});
            ++entries_;
        });
        if (entries_ > 2 * places_.size()) grow();
    }
    void remove(const Cells& cells, int number) {
        for_each(cells, [&](Cell cell) {
            std::vector<Entry>& place = places_[index(cell)];
            for (Entry& entry : place) {
                if (entry.number != number || entry.cell != cell) continue;
                entry = place.back();
                break;
            }
            place.pop_back();
            --entries_;
        });
    }

  private:
    struct Entry {
        Cell cell;
        int number;
    };

    static std::int32_t whole(double v) {
        const auto toward_zero = static_cast<std::int32_t>(v);
        return toward_zero - (toward_zero > v ? 1 : 0);
    }
    template <class Visit>
    static void for_each(const Cells& cells, const Visit& visit) {
        for (std::int32_t x = cells.low.x; x <= cells.high.x; ++x) {
            for (std::int32_t y = cells.low.y; y <= cells.high.y; ++y) visit(Cell{x, y});
        }
    }
    /// Cells that share a place cost time alone.
    std::size_t index(Cell cell) const {
        // Odd and large: columns side by side do not fall on each other.
        const std::uint64_t mixed = std::uint64_t(std::uint32_t(cell.x)) * 0x9E3779B1U + std::uint32_t(cell.y);
        return mixed & (places_.size() - 1);
    }
    void grow() {
        std::vector<std::vector<Entry>> old(2 * places_.size());
        old.swap(places_);
        for (const std::vector<Entry>& place : old) {
            for (const Entry& entry : place) places_[index(entry.cell)].push_back(entry);
        }
    }

    double per_metre_;
    std::vector<std::vector<Entry>> places_;  ///< a power of two of them
    std::size_t entries_ = 0;
};

/// Cells as wide as most paths' first pieces; not so small that their numbers do not fit.
double cell_size(std::span<const PlacedClip> crowd, double within) {
    std::vector<float> widths;
    widths.reserve(crowd.size());
    double largest = 0;
    for (const PlacedClip& clip : crowd) {
        const PathPiece piece = piece_from(clip, 0, 0, within);
        widths.push_back(static_cast<float>(std::max(piece.x1 - piece.x0, piece.y1 - piece.y0)));
        const PlacedFrame& frame = clip.frame();
        largest = std::max(largest, std::abs(frame.translate.x) + std::abs(frame.translate.y) + 2 * frame.reach);
    }
    const auto most = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() * 7 / 8);
    std::nth_element(widths.begin(), most, widths.end());
    return std::max({double(*most), (largest + within) * 0x1p-29, std::numeric_limits<double>::min()});
}

class PathSweep {
  public:
    PathSweep(std::span<const PlacedClip> crowd, std::span<const int> person_of, double within, const Region& region,
              const OnNear& on_near)
        : crowd_(crowd),
          person_of_(person_of),
          within_(within),
          region_(region),
          on_near_(on_near),
          grid_(cell_size(crowd, within)) {}

    void run(const SweepProgress& progress) {
        std::vector<int> by_start(crowd_.size());
        std::iota(by_start.begin(), by_start.end(), 0);
        std::ranges::sort(by_start, {}, [&](int path) { return std::pair(crowd_[std::size_t(path)].time(0), path); });
        std::vector<int> beginning;
        for (std::size_t next = 0;;) {
            const bool some_begin = next < by_start.size();
            if (!some_begin && ends_.empty()) break;
            const double starts = some_begin ? crowd_[std::size_t(by_start[next])].time(0) : Region::kNoLimit;
            const double now = ends_.empty() ? starts : std::min(starts, ends_.top().first);
            if (now >= region_.t1) break;
            // What lasts no longer than this shares no time with what begins now or later.
            const double until = now + kMinOverlap;
            beginning.clear();
            while (!ends_.empty() && ends_.top().first <= until) {
                const int number = ends_.top().second;
                ends_.pop();
                take_out(number);
                if (go_on(number)) beginning.push_back(number);
            }
            for (; next < by_start.size() && crowd_[std::size_t(by_start[next])].time(0) <= until; ++next) {
                if (progress) progress(next, by_start.size());
                if (const int number = enter(by_start[next]); number >= 0) beginning.push_back(number);
            }
            for (const int number : beginning) put_in(number);
        }
    }

  private:
    struct Met {
        int path;
        bool enough;
    };
    enum class Place { none, grid, wide };
    /// Who is there, with the piece that lasts.
    struct Present {
        PathPiece piece;
        Place place = Place::none;
        int entered = 0;         ///< how many entered before
        std::vector<Met> met{};  ///< of those who entered before
    };

    /// The number of who enters; -1 if nothing of the path is in the region's time.
    int enter(int path) {
        const PlacedClip& clip = crowd_[std::size_t(path)];
        if (!(clip.frame().start + clip.frame().duration > region_.t0)) return -1;
        PathPiece piece = piece_from(clip, path, 0, within_);
        while (piece.t1 <= region_.t0) {
            if (piece.end >= clip.clip().steps()) return -1;
            piece = piece_from(clip, path, piece.end, within_);
        }
        int number = static_cast<int>(present_.size());
        if (free_.empty()) {
            present_.emplace_back();
        } else {
            number = free_.back();
            free_.pop_back();
        }
        Present& who = present_[std::size_t(number)];
        who.piece = piece;
        who.entered = entered_++;
        ends_.emplace(piece.t1, number);
        return number;
    }

    /// To the next piece; false, and the number is free, if there is none.
    bool go_on(int number) {
        Present& who = present_[std::size_t(number)];
        const PlacedClip& clip = crowd_[std::size_t(who.piece.path)];
        if (who.piece.end >= clip.clip().steps()) {
            who.met = {};
            free_.push_back(number);
            return false;
        }
        who.piece = piece_from(clip, who.piece.path, who.piece.end, within_);
        ends_.emplace(who.piece.t1, number);
        return true;
    }

    void put_in(int number) {
        Present& who = present_[std::size_t(number)];
        const PathPiece& piece = who.piece;
        if (!(piece.x0 < region_.x1 && piece.x1 >= region_.x0)) return;
        for (const int other : wide_) meet(who, present_[std::size_t(other)]);
        const FloorGrid::Cells cells = grid_.cells_of(piece);
        if (cells.are_few()) {
            grid_.visit_and_add(cells, number, [&](int other, Cell cell) {
                Present& met = present_[std::size_t(other)];
                // Most share several cells: they meet in the first.
                const PathPiece& at = met.piece;
                if (grid_.cell(std::max(piece.x0, at.x0), std::max(piece.y0, at.y0)) == cell) meet(who, met);
            });
            who.place = Place::grid;
        } else {
            for (Present& other : present_) {
                if (other.place == Place::grid) meet(who, other);
            }
            wide_.push_back(number);
            who.place = Place::wide;
        }
    }

    void take_out(int number) {
        Present& who = present_[std::size_t(number)];
        if (who.place == Place::grid) grid_.remove(grid_.cells_of(who.piece), number);
        if (who.place == Place::wide) std::erase(wide_, number);
        who.place = Place::none;
    }

    void meet(Present& one, Present& other) {
        if (!near(one.piece, other.piece) || !region_.has(one.piece, other.piece)) return;
        const int path = one.piece.path, with = other.piece.path;
        if (person_of_[std::size_t(path)] == person_of_[std::size_t(with)]) return;
        // Who entered later keeps that they have met, and forgets it when leaving.
        std::vector<Met>& met = one.entered > other.entered ? one.met : other.met;
        const int whom = one.entered > other.entered ? with : path;
        auto at = std::ranges::find(met, whom, &Met::path);
        const bool first = at == met.end();
        if (first) at = met.insert(at, {whom, false});
        if (!at->enough)
            at->enough =
                path < with ? on_near_(one.piece, other.piece, first) : on_near_(other.piece, one.piece, first);
    }

    std::span<const PlacedClip> crowd_;
    std::span<const int> person_of_;
    double within_;
    Region region_;
    const OnNear& on_near_;
    FloorGrid grid_;
    std::vector<Present> present_;  ///< by number
    std::vector<int> free_;         ///< numbers of nobody
    std::vector<int> wide_;         ///< numbers of those who cover too much for the grid
    int entered_ = 0;
    /// When pieces end, and whose: the next one first.
    using End = std::pair<double, int>;
    std::priority_queue<End, std::vector<End>, std::greater<>> ends_;
};

}  // namespace

PathPiece piece_from(const PlacedClip& clip, int path, int first, double within) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    PathPiece piece{path, first, first, clip.time(first), 0, kFar, -kFar, kFar, -kFar};
    const double widening = clip.is_linear() ? kLinearWidening : kHeldWidening;
    const int steps = clip.clip().steps();
    // One that runs to the next sample lies between the two.
    const bool runs = clip.clip().runs();
    const auto cover = [&](int i) {
        const Disk disk = clip.disk(i);
        const double r = disk.r + within / 2;
        const double wide = r + widening * (std::abs(disk.x) + std::abs(disk.y) + r);
        piece.x0 = std::min(piece.x0, disk.x - wide);
        piece.x1 = std::max(piece.x1, disk.x + wide);
        piece.y0 = std::min(piece.y0, disk.y - wide);
        piece.y1 = std::max(piece.y1, disk.y + wide);
    };
    const auto width = [&] { return std::max(piece.x1 - piece.x0, piece.y1 - piece.y0); };
    cover(first);
    if (runs) cover(first + 1);
    const double most = kMostGrowth * width();
    for (piece.end = first + 1; piece.end < steps && piece.end - first < kMostSamples; ++piece.end) {
        const PathPiece before = piece;
        cover(runs ? piece.end + 1 : piece.end);
        if (width() <= most) continue;
        piece = before;
        break;
    }
    piece.t1 = clip.time(piece.end);
    return piece;
}

bool near(const PathPiece& a, const PathPiece& b) {
    return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1 && overlap_in_time(a.t0, a.t1, b.t0, b.t1);
}

void sweep_paths(std::span<const PlacedClip> crowd, std::span<const int> person_of, double within, const Region& region,
                 const OnNear& on_near, const SweepProgress& progress) {
    if (!crowd.empty()) PathSweep(crowd, person_of, within, region, on_near).run(progress);
}

}  // namespace mobb
