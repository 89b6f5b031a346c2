/// The motions that agents have chosen, by place and time.
#pragma once

#include <crowd/simulation/surroundings.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <vector>

namespace mobbscope {

/// How many of some numbers, the least first, are less than `limit`. Without a branch for each step, which would often
/// be mispredicted.
std::size_t count_before(double limit, const std::vector<double>& numbers);

/// The reserved motions of a crowd in a grid over the floor, each with its time. Memory grows with the motions that are
/// not yet forgotten. Const calls are safe from any number of threads while nothing is reserved or forgotten.
class ReservationGrid {
  public:
    /// The grid covers the floor from -area/2 to area/2, in metres; what lies beyond is kept at its edges. Throws
    /// std::invalid_argument unless the area is finite and over 0.
    explicit ReservationGrid(glm::dvec2 area);

    /// Returns a number for `withdraw`, valid until the motion is forgotten.
    std::size_t reserve(const PlayedMove& motion);
    /// The motion blocks nothing any more.
    void withdraw(std::size_t reservation);
    /// Motions that end at `now` or before are dropped: no candidate that begins later can meet them. Throws
    /// std::invalid_argument if it is NaN.
    void forget_before(double now);
    std::size_t size() const { return held_.size() - free_.size(); }  ///< motions not forgotten
    std::size_t bytes() const;                                        ///< of memory, used or kept to be used again

    /// The motions of other agents than `agent` whose bounds meet `bounds`, from `begin` to `end`, global seconds. They
    /// may be asked until something is reserved or forgotten. Throws std::invalid_argument if a number is NaN.
    Surroundings around(int agent, const FloorRect& bounds, double begin, double end) const {
        Surroundings out;
        find_around(agent, bounds, begin, end, out);
        return out;
    }
    /// The same around one candidate.
    Surroundings around(const PlayedMove& candidate) const {
        return around(candidate.agent, candidate.bounds, candidate.begin(), candidate.end());
    }
    /// The same in place of what is there, in its memory.
    void find_around(int agent, const FloorRect& bounds, double begin, double end, Surroundings& out) const;

    /// Appends every pair of the candidate and a motion of another agent whose bounds on the floor come within `range`
    /// metres of the candidate's, at any time: the pairs that would be queried if times were not compared first, and
    /// with an infinite range those that would be queried without a grid. Throws std::invalid_argument if it is NaN.
    void all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const;

  private:
    struct CellRange {
        std::int16_t x0, y0, x1, y1;  ///< inclusive
    };
    struct Held {
        CellRange cells;
        std::uint32_t place;  ///< of motions_
        bool withdrawn;
    };
    /// What decides in a cell whether a motion is near a candidate: beside each other in memory, unlike the motions.
    struct Entry {
        FloorRect bounds;
        double begin, end;  ///< global seconds
        int agent;
        std::uint32_t slot;   ///< of held_
        std::uint32_t place;  ///< of motions_
        std::int16_t x0, y0;  ///< the first cell that it reaches into
    };
    /// The motions whose bounds reach into a cell, by their begin.
    struct Cell {
        std::vector<double> begins;  ///< of the entries, beside each other
        std::vector<Entry> entries;
    };
    struct Ending {
        double end;
        std::uint32_t slot;
        bool operator>(const Ending& other) const { return end > other.end; }
    };

    CellRange cells_of(const FloorRect& rect) const;
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    }
    /// Calls visit(entry) once for each motion that reaches into a cell of the range, begins from `from` on, before
    /// `to`, global seconds, and for which meets(entry) is true.
    template <class Meets, class Visit>
    void visit_cells(const CellRange& range, double from, double to, const Meets& meets, const Visit& visit) const;

    glm::dvec2 low_;
    glm::dvec2 per_metre_;  ///< cells
    int columns_;
    int rows_;
    std::vector<Cell> cells_;
    double longest_ = 0;                                         ///< seconds that a motion lasts
    double latest_end_ = std::numeric_limits<double>::lowest();  ///< global seconds; nothing lasts longer
    std::vector<Held> held_;
    std::vector<std::uint32_t> free_;    ///< slots of held_ that hold nothing
    std::vector<PlayedMove> motions_;    ///< that are held; places are used again at once, so that caches hold them
    std::vector<std::uint32_t> unused_;  ///< places of motions_ that hold nothing
    std::priority_queue<Ending, std::vector<Ending>, std::greater<>> endings_;
};

}  // namespace mobbscope
