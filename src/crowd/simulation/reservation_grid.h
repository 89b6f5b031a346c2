/// The motions that agents have chosen, by place and time, and which candidates collide with them.
#pragma once

#include <crowd/simulation/played_move.h>
#include <mobb/clip.h>
#include <mobb/query.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace mobbscope {

/// The reserved motion that a candidate collides with first; of those met at the same time, that of the agent with the
/// lowest index.
struct Blocker {
    int agent = 0;
    int play = 0;
    mobb::Contact contact;  ///< a: the candidate; b: the reserved motion
    int planned = 0;        ///< see PlayedMove
    int move = -1;          ///< see PlayedMove
    mobb::ClipPtr clip{};   ///< of the reserved motion, and where it is placed
    mobb::Placement placement{};

    friend bool operator==(const Blocker&, const Blocker&) = default;
};

/// A pair whose trees were queried.
struct AskedPair {
    PlayedMove candidate;
    PlayedMove reserved;
};

/// The result of checking a candidate against the reserved motions.
struct CandidateCheck {
    std::optional<Blocker> blocker;  ///< none: it collides with nobody
    int asked = 0;                   ///< number of tree queries made
};

/// The reserved motions of a crowd in a grid over the floor, each with its time. Memory grows with the motions that are
/// not yet forgotten. Const calls are safe from any number of threads while nothing is reserved or forgotten.
class ReservationGrid {
  public:
    /// The grid covers the floor from -area/2 to area/2, in metres; what lies beyond is kept at its edges.
    explicit ReservationGrid(glm::dvec2 area);

    /// Returns a number for `withdraw`, valid until the motion is forgotten.
    std::size_t reserve(const PlayedMove& motion);
    /// The motion blocks nothing any more.
    void withdraw(std::size_t reservation);
    /// Motions that end at `now` or before are dropped: no candidate that begins later can meet them.
    void forget_before(double now);
    std::size_t size() const { return motions_.size() - free_.size(); }  ///< motions not forgotten

    /// Checks each candidate against the motions of the other agents. The pairs whose trees were queried are appended
    /// to `asked`, in the order of the candidates. The results do not depend on the number of threads.
    std::vector<CandidateCheck> check_all(std::span<const PlayedMove* const> candidates,
                                          std::vector<AskedPair>* asked = nullptr) const;
    /// The same of one.
    CandidateCheck check(const PlayedMove& candidate, std::vector<AskedPair>* asked = nullptr) const;

    /// Whether the candidate collides with nobody. Adds the number of tree queries to `queries`, and the pairs to
    /// `asked`.
    bool is_clear(const PlayedMove& candidate, std::int64_t& queries, std::vector<AskedPair>* asked = nullptr) const;
    bool is_clear(const PlayedMove& candidate) const;

    /// How long the candidate collides with the motions of the other agents, in seconds: with two at a time it counts
    /// twice. What is more than `most` may be counted in part.
    double seconds_of_contact(const PlayedMove& candidate, double most = std::numeric_limits<double>::infinity()) const;

    /// Appends every pair of the candidate and a motion of another agent whose bounds on the floor come within `range`
    /// metres of the candidate's, at any time: the pairs that would be queried if times were not compared first, and
    /// with an infinite range those that would be queried without a grid.
    void all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const;

  private:
    struct CellRange {
        int x0, y0, x1, y1;  ///< inclusive
    };
    struct Held {
        PlayedMove motion;
        CellRange cells;
        bool withdrawn;
    };
    /// What decides in a cell whether a motion is near a candidate: beside each other in memory, unlike the motions.
    struct Entry {
        FloorRect bounds;
        double begin, end;  ///< global seconds
        int agent;
        std::uint32_t slot;  ///< of motions_
        int x0, y0;          ///< the first cell that it reaches into
    };
    /// A motion near a candidate.
    struct Near {
        double begin;  ///< global seconds
        const PlayedMove* motion;
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
    /// Calls visit(entry) once for each motion that reaches into a cell of the range and begins from `from` to `to`,
    /// global seconds.
    template <class Visit>
    void visit_cells(const CellRange& range, double from, double to, const Visit& visit) const;
    struct NearMotions;
    /// Finds the motions of other agents whose bounds and times meet the candidate's, earliest first.
    void find_near(const PlayedMove& candidate, NearMotions& near) const;
    /// The index of the first of them that the candidate collides with; their number if there is none.
    static std::size_t first_met(const PlayedMove& candidate, std::span<const Near> near);

    glm::dvec2 low_;
    glm::dvec2 per_metre_;  ///< cells
    int columns_;
    int rows_;
    std::vector<std::vector<Entry>> cells_;  ///< motions whose bounds reach into the cell, by their begin
    double longest_ = 0;                     ///< seconds that a motion lasts
    std::vector<Held> motions_;
    std::vector<std::uint32_t> free_;  ///< slots of motions_ that hold nothing
    std::priority_queue<Ending, std::vector<Ending>, std::greater<>> endings_;
};

}  // namespace mobbscope
