/// What many agents are committed to, and which candidates it rules out.
#pragma once

#include <crowd/simulation/clip_bounds.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace mobbscope {

/// A clip as an agent plays it, or may. The tree and the bounds are of the same clip and must outlive the world.
struct PlayedMove {
    int agent = 0;
    int play = 0;  ///< which of the agent's: handed back with what it rules out
    const mobb::Tree* tree = nullptr;
    const ClipBounds* clip_bounds = nullptr;
    mobb::Placement placement;
};

/// The committed motion that rules a candidate out: the one that it meets first; of those met at the same time the one
/// of the first agent.
struct Blocker {
    int agent = 0;
    int play = 0;
    mobb::Contact contact;  ///< a is the candidate, b the committed motion

    friend bool operator==(const Blocker&, const Blocker&) = default;
};

/// A pair that was given to the trees.
struct AskedPair {
    PlayedMove candidate;
    PlayedMove committed;
};

/// What becomes of a candidate.
struct CandidateCheck {
    std::optional<Blocker> blocker;  ///< none: it collides with nobody
    int asked = 0;                   ///< how many pairs the trees were asked
};

/// The committed motions of a crowd in a grid over the floor, with the time of each. It grows with what is committed
/// and not yet forgotten. Verdicts may be asked from any number of threads while nothing is committed or forgotten.
class ReservationGrid {
  public:
    /// The grid covers the floor from -area/2 to area/2, in metres; what lies beyond is kept at its edges.
    explicit ReservationGrid(glm::dvec2 area);

    /// Returns what `withdraw` takes until the motion is forgotten.
    std::size_t commit(const PlayedMove& motion);
    /// From now on the motion rules nothing out.
    void withdraw(std::size_t committed);
    /// Motions that end at `now` or before are dropped: no candidate that begins later can meet them.
    void forget_before(double now);
    std::size_t size() const { return motions_.size() - free_.size(); }  ///< motions not forgotten

    /// For each candidate the motion of another agent that rules it out, or none. With `asked`, the pairs that the
    /// trees were asked are appended to it, in the order of candidates. The same on any number of threads.
    std::vector<CandidateCheck> check_all(std::span<const PlayedMove> candidates,
                                          std::vector<AskedPair>* asked = nullptr) const;

    /// How long the candidate collides with the motion that rules it out, which must still be held.
    double seconds_of_contact(const PlayedMove& candidate, const Blocker& blocker) const;

    /// Appends every pair of the candidate and a motion of another agent whose bounds on the floor come within `range`
    /// metres of its own, at whatever time: what the trees were asked if nobody looked at times before them, and with
    /// an infinite range if there were no grid at all.
    void all_pairs(const PlayedMove& candidate, double range, std::vector<AskedPair>& pairs) const;

  private:
    struct CellRange {
        int x0, y0, x1, y1;  ///< inclusive
    };
    struct Held {
        PlayedMove motion;
        FloorRect bounds;
        CellRange cells;
        double begin = 0, end = 0;  ///< global seconds
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
    Held held(const PlayedMove& motion) const;
    void take_from_cells(std::uint32_t slot);
    /// Calls visit(slot) once for each motion that reaches into a cell of the range.
    template <class Visit>
    void visit_cells(const CellRange& range, const Visit& visit) const;
    /// Slots of the motions of other agents whose bounds and times meet the candidate's, earliest first.
    void find_near(const Held& candidate, std::vector<std::uint32_t>& slots) const;
    CandidateCheck check(const PlayedMove& candidate, std::vector<AskedPair>* asked) const;

    glm::dvec2 low_;
    glm::dvec2 cell_size_;
    int columns_;
    int rows_;
    std::vector<std::vector<std::uint32_t>> cells_;  ///< slots of motions_ whose bounds reach into the cell
    std::vector<Held> motions_;
    std::vector<std::uint32_t> free_;  ///< slots of motions_ that hold nothing
    std::priority_queue<Ending, std::vector<Ending>, std::greater<>> endings_;
};

}  // namespace mobbscope
