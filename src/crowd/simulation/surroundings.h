/// The motions that agents have reserved near a place, and which candidates there collide with them.
#pragma once

#include <crowd/simulation/played_move.h>
#include <mobb/clip.h>
#include <mobb/query.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
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

/// The result of checking a candidate.
struct CandidateCheck {
    bool collides = false;
    int asked = 0;  ///< tree queries: as many as it takes to find the blocker, the motions by their begin
};

/// How a candidate collides with what others have reserved.
struct ContactTimes {
    double seconds = 0;                                      ///< in contact; with two at a time it counts twice
    double first = std::numeric_limits<double>::infinity();  ///< global seconds of the first contact; never: infinite
};

/// What is near a place for some time; its candidates are checked as if all other motions were asked. Refers to the
/// motions, which must stay where they are. Const calls are safe from any number of threads.
class Surroundings {
  public:
    /// What decides whether a motion is near a candidate: beside each other in memory, unlike the motions.
    struct Near {
        FloorRect bounds;
        double begin, end;  ///< global seconds
        const PlayedMove* motion;
    };

    Surroundings() = default;
    /// Takes motions in any order.
    explicit Surroundings(std::vector<Near> near);

    /// Checks each candidate. The pairs whose trees were queried are appended to `asked`, in the order of the
    /// candidates. The results do not depend on the number of threads.
    std::vector<CandidateCheck> check_all(std::span<const PlayedMove* const> candidates,
                                          std::vector<AskedPair>* asked = nullptr) const;
    /// The same of one.
    CandidateCheck check(const PlayedMove& candidate, std::vector<AskedPair>* asked = nullptr) const;

    /// What the candidate collides with first; none: it collides with nobody.
    std::optional<Blocker> blocker(const PlayedMove& candidate) const;

    /// Whether the candidate collides with nobody; the first that it is found to collide with ends the search. Adds the
    /// number of tree queries to `queries`, and the pairs to `asked`.
    bool is_clear(const PlayedMove& candidate, std::int64_t& queries, std::vector<AskedPair>* asked = nullptr) const;
    bool is_clear(const PlayedMove& candidate) const;

    /// Where there are more than `most` seconds of contact, they and the first may be found in part.
    ContactTimes contact_times(const PlayedMove& candidate,
                               double most = std::numeric_limits<double>::infinity()) const;

  private:
    /// The first motion that a candidate is found to collide with.
    struct FirstMet {
        std::size_t index;  ///< of near_; its size: there is none
        int asked;          ///< of the motions near the candidate, those up to it
    };
    FirstMet first_met(const PlayedMove& candidate) const;
    /// Asks on behind that motion to the earliest contact: calls visit(motion, contact) for each. How many are asked.
    template <class Visit>
    int ask_on(const PlayedMove& candidate, const FirstMet& met, const Visit& visit) const;
    /// The first `count` motions near the candidate.
    void append(const PlayedMove& candidate, std::int64_t count, std::vector<AskedPair>& asked) const;

    std::vector<Near> near_;  ///< by begin
};

}  // namespace mobbscope
