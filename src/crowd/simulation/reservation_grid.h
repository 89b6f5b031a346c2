/// The motions that agents have chosen, by place and time, and which candidates collide with them.
#pragma once

#include <mobb/clip.h>
#include <mobb/kdop.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>

#include <array>
#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

namespace mobbscope {

/// A rectangle along the axes of the floor, in metres.
struct FloorRect {
    glm::dvec2 low{0};
    glm::dvec2 high{0};

    bool meets(const FloorRect& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
    }
};

/// A polygon around all disks of a clip. Where a run's agents first stand is drawn by these bounds: with others the
/// same seed would give another run.
class ClipBounds {
  public:
    explicit ClipBounds(const mobb::Clip& clip)
        : corners_(mobb::KDop(clip.samples()).coarse_corners()), reach_(clip.reach()) {}

    /// Holds every disk of the clip where it is placed, rounding included.
    FloorRect bounds(const mobb::Placement& placement) const;

  private:
    std::array<glm::dvec2, mobb::KDop::kDirections / 2> corners_;  ///< in the clip's frame
    double reach_;                                                 ///< of the clip: what rounding is measured by
};

/// Whether some disk reaches over a wall of the floor, which goes from -area/2 to area/2. Touching a wall is allowed.
/// The bounds must be the clip's; it only saves time.
bool leaves_floor(const mobb::PlacedClip& clip, const ClipBounds& clip_bounds, glm::dvec2 area);

/// A clip that an agent plays, or may play. The tree and the bounds are of that clip and must outlive the grid.
struct PlayedMove {
    int agent = 0;
    int play = 0;  ///< index among the agent's plays; a Blocker repeats it
    const mobb::Tree* tree = nullptr;
    const ClipBounds* clip_bounds = nullptr;
    mobb::Placement placement;
    int planned = 0;  ///< 0: the play itself; else which of the moves that are planned to follow it, from 1
    int move = -1;    ///< index among those of the MoveSet; -1: somebody who stands. A Blocker repeats it
};

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
    std::vector<CandidateCheck> check_all(std::span<const PlayedMove> candidates,
                                          std::vector<AskedPair>* asked = nullptr) const;

    /// Whether the candidate collides with nobody. Adds the number of tree queries to `queries`, and the pairs to
    /// `asked`.
    bool is_clear(const PlayedMove& candidate, std::int64_t& queries, std::vector<AskedPair>* asked = nullptr) const;

    /// How long the candidate collides with the motions of the other agents, in seconds: with two at a time it counts
    /// twice.
    double seconds_of_contact(const PlayedMove& candidate) const;

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
