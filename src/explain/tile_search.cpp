#include <explain/space_time_hull.h>
#include <explain/tile_search.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kWidenings = 6;                        // halvings of what the least gap may be
constexpr std::size_t kMostWideningVisits = 50'000;  // of pieces, after which the gaps are wide enough

/// The disks of A or B in some pairs that share time, drawn back so that disks that touch are still kept apart.
class HullOfPieces final : public SpaceTimeHull {
  public:
    using Side = std::array<mobb::Disk, 2> SharedTime::*;

    HullOfPieces(std::span<const SharedTime> pieces, Side side, double slack)
        : pieces_(pieces), side_(side), slack_(slack) {}

    glm::dvec3 furthest(glm::dvec3 direction) const override {
        const double length = glm::length(glm::dvec2(direction)), begin = pieces_.front().t0;
        double best = -std::numeric_limits<double>::infinity(), time = 0;
        const mobb::Disk* disk = nullptr;
        for (const SharedTime& piece : pieces_) {
            for (const std::size_t end : {0u, 1u}) {
                const mobb::Disk& d = (piece.*side_)[end];
                const double t = (end == 0 ? piece.t0 : piece.t1) - begin;
                const double reach = direction.x * d.x + direction.y * d.y + direction.z * t + length * radius(d);
                if (reach <= best) continue;
                best = reach;
                time = t;
                disk = &d;
            }
        }
        const glm::dvec2 edge = length > 0 ? glm::dvec2(direction) * (radius(*disk) / length) : glm::dvec2(0);
        return {disk->x + edge.x, disk->y + edge.y, time};
    }
    bool empty() const override { return pieces_.empty(); }

  private:
    double radius(const mobb::Disk& disk) const { return std::max(disk.r - slack_, 0.0); }

    std::span<const SharedTime> pieces_;
    Side side_;
    double slack_;
};

class TileSearch {
  public:
    TileSearch(const Pieces& all, const KnownLines& known) : all_(all), pieces_(all.pieces), known_(known) {
        glm::dvec2 min(std::numeric_limits<double>::max()), max(std::numeric_limits<double>::lowest());
        for (const SharedTime& piece : pieces_) {
            for (const mobb::Disk& disk : {piece.a[0], piece.a[1], piece.b[0], piece.b[1]}) {
                min = glm::min(min, center(disk));
                max = glm::max(max, center(disk));
            }
        }
        reach_ = glm::length(max - min);
    }

    std::vector<Tile> fewest() {
        std::vector<Tile> out = *tiles(Lines::fixed, 0, pieces_.size());
        if (out.size() <= 1) return out;
        Lines lines = Lines::fixed;
        if (auto fewer = tiles(Lines::moving, 0, out.size() - 1)) {
            out = *std::move(fewer);
            lines = Lines::moving;
        }
        const auto least_gap = [&] { return std::max(std::ranges::min(out, {}, &Tile::gap).gap, 0.0); };
        double low = least_gap(), high = all_.clearance;
        const std::size_t most_visits = visits_ + kMostWideningVisits;
        for (int i = 0; i < kWidenings && low < high && visits_ < most_visits; ++i) {
            const double middle = 0.5 * (low + high);
            if (auto wider = tiles(lines, middle, out.size())) {
                out = *std::move(wider);
                low = std::max(middle, least_gap());
            } else {
                high = middle;
            }
        }
        return out;
    }

  private:
    struct Longest {
        std::size_t count = 0;  ///< pieces
        glm::dvec2 direction{1, 0};
        bool is_fixed = true;
    };

    /// All with a gap of more than `gap` metres, unless that is 0; none if that takes more tiles than `most`.
    std::optional<std::vector<Tile>> tiles(Lines lines, double gap, std::size_t most) {
        std::vector<Tile> out;
        for (std::size_t first = 0; first < pieces_.size();) {
            const Longest longest = longest_from(first, lines, gap);
            if (longest.count == 0 || out.size() == most) return std::nullopt;
            const Sweep sweep(pieces_, longest.direction, all_.slack);
            out.push_back(sweep.tile(first, longest.count, longest.is_fixed));
            first += longest.count;
        }
        return out;
    }

    Longest longest_from(std::size_t first, Lines lines, double gap) {
        const std::size_t left = pieces_.size() - first;
        Longest out = gap > 0 ? Longest{} : longest_known(first, lines);
        const auto try_count = [&](std::size_t count) {
            const auto found = widest_line(pieces_.subspan(first, count), lines, gap);
            if (found) out = {count, found->direction, lines == Lines::fixed};
            return found.has_value();
        };
        // Mostly one line does for all. Where it does not, tiles are short against what is left.
        if (first == 0 && try_count(left)) return out;
        if (out.count > 0) try_count(out.count);
        std::size_t fails = first == 0 ? left : left + 1;
        for (std::size_t step = 1; out.count + 1 < fails; step *= 2) {
            const std::size_t count = out.count + std::min(step, (fails - out.count) / 2);
            if (!try_count(count)) fails = count;
        }
        return out;
    }

    std::optional<SeparatingLine> widest_line(std::span<const SharedTime> pieces, Lines lines, double gap) {
        visits_ += pieces.size();
        // A line that crosses all in a tenth of the time.
        const double steepness = 10 * (reach_ + 1) / (pieces.back().t1 - pieces.front().t0);
        return line_between(HullOfPieces(pieces, &SharedTime::a, all_.slack),
                            HullOfPieces(pieces, &SharedTime::b, all_.slack), lines, steepness, gap + all_.slack);
    }

    /// Along the line of a pair of samples or that of boxes, whichever holds longer.
    Longest longest_known(std::size_t first, Lines lines) {
        // Rounding alone can leave no line: this one is refused by who checks it.
        Longest out{1, all_.lines[first], false};
        const auto offer = [&](glm::dvec2 direction, std::size_t end) {
            const Sweep sweep(pieces_.first(end), direction, all_.slack);
            const std::size_t fixed = sweep.fixed(first);
            const std::size_t moving = lines == Lines::fixed || fixed == end - first ? 0 : sweep.moving(first);
            const std::size_t count = std::max(fixed, moving);
            if (count > 0 && count >= out.count) out = {count, direction, fixed >= moving};
        };
        offer(all_.lines[first], first + 1);
        const SharedTime& piece = pieces_[first];
        if (const auto known = known_(0.5 * (piece.t0 + piece.t1))) {
            const auto until = [&](const SharedTime& each) { return 0.5 * (each.t0 + each.t1) < known->until; };
            const auto end = std::ranges::partition_point(pieces_.subspan(first), until) - pieces_.begin();
            if (static_cast<std::size_t>(end) > first) {
                offer(known->direction, static_cast<std::size_t>(end));
                offer(-known->direction, static_cast<std::size_t>(end));
            }
        }
        return out;
    }

    const Pieces& all_;
    std::span<const SharedTime> pieces_;
    const KnownLines& known_;
    double reach_ = 0;        ///< metres: no two disks are farther apart
    std::size_t visits_ = 0;  ///< of pieces
};

}  // namespace

std::vector<Tile> fewest_tiles(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double end,
                               const KnownLines& known) {
    const Pieces pieces = pieces_before(a, b, end);
    if (pieces.pieces.empty()) return {};
    return TileSearch(pieces, known).fewest();
}

}  // namespace mobbscope
