/// The motions that agents have reserved near a place, and which candidates there collide with them.
#pragma once

#include <crowd/simulation/played_move.h>
#include <mobb/clip.h>
#include <mobb/query.h>

#include <cstddef>
#include <limits>
#include <optional>
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
    bool is_joint = false;          ///< see PlayedMove
    bool before_candidate = false;  ///< met by the joint that leads to the candidate: that is `a` of the contact

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

/// The first motion that a candidate is found to collide with.
struct FirstMet {
    static constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

    std::size_t index = kNobody;  ///< among the surroundings
    int asked = 0;                ///< tree queries: of the motions near the candidate, those up to it

    bool collides() const { return index != kNobody; }
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

    /// Motions in any order, in place of those that are there.
    template <class Fill>
    void refill(const Fill& fill) {
        near_.clear();
        fill(near_);
        sort();
    }

    /// Checks each candidate. The pairs whose trees were queried are appended to `asked`, in the order of the
    /// candidates. The results do not depend on the number of threads.
    std::vector<CandidateCheck> check_all(std::span<const PlayedMove* const> candidates,
                                          std::vector<AskedPair>* asked = nullptr) const;

    /// What the candidate collides with first; none: it collides with nobody.
    std::optional<Blocker> blocker(const PlayedMove& candidate) const;

    /// The first motion that each candidate is found to collide with: several are asked about together. Goes on from
    /// what is found, as of surroundings asked before: candidates that collide are not asked about, and queries add up.
    /// Requires as many found as candidates.
    void find_first(std::span<const PlayedMove* const> candidates, std::span<FirstMet> found) const;
    /// Whether the candidate collides with nobody.
    bool is_clear(const PlayedMove& candidate) const;
    /// Appends the pairs of the first `count` queries about a candidate; returns how many of them are missing here.
    int append(const PlayedMove& candidate, int count, std::vector<AskedPair>& asked) const;

    /// Where there are more than `most` seconds of contact, they and the first may be found in part.
    ContactTimes contact_times(const PlayedMove& candidate,
                               double most = std::numeric_limits<double>::infinity()) const;

  private:
    void sort();
    /// As find_first, of one.
    void find_first(const PlayedMove& candidate, FirstMet& found) const;
    /// Of some that have met nobody so far, against those of near_ from `from` on, as many as a number has bits.
    void find_first_in(std::span<const PlayedMove* const> candidates, std::size_t from,
                       std::span<FirstMet> found) const;
    /// With the first motion that the candidate meets.
    CandidateCheck check(const PlayedMove& candidate, const FirstMet& met) const;
    /// Asks on behind that motion to the earliest contact: calls visit(motion, contact) for each. How many are asked.
    template <class Visit>
    int ask_on(const PlayedMove& candidate, const FirstMet& met, const Visit& visit) const;

    std::vector<Near> near_;  ///< by begin
};

}  // namespace mobbscope
