/// Crowds of tests, and all conflicts of one at once: those of tests are few.
#pragma once

#include <mobb/random_motion.h>
#include <mobb_tracks/people_conflicts.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace mobb::test {

/// Trees and where they are placed, each a person's own.
class Crowd {
  public:
    void add(ClipPtr clip, const Placement& placement, const FitOptions& fit = {}) {
        trees_.push_back(std::make_unique<Tree>(std::move(clip), fit));
        placed_.emplace_back(*trees_.back(), placement);
        person_of_.push_back(static_cast<int>(person_of_.size()));
    }
    std::span<const PlacedTree> trees() const { return placed_; }
    std::vector<PlacedClip> clips() const {
        std::vector<PlacedClip> out;
        for (const PlacedTree& tree : placed_) out.push_back(tree.placed_clip());
        return out;
    }
    const PlacedClip& clip(int i) const { return placed_[static_cast<std::size_t>(i)].placed_clip(); }
    std::span<const int> person_of() const { return person_of_; }
    PeopleConflicts conflicts(const ConflictSearch& search = {}) const { return {clips(), person_of_, search}; }

  private:
    std::vector<std::unique_ptr<Tree>> trees_;
    std::vector<PlacedTree> placed_;
    std::vector<int> person_of_;
};

/// So many paths of up to so many samples within `side` metres and some seconds: held and linear, of one dt and of
/// others, aligned and not.
inline Crowd random_crowd(Random& random, int paths, int most_samples, double side) {
    Crowd crowd;
    const ClipPtr first = random_motion(random, random_clip(random, most_samples));
    for (int i = 0; i < paths; ++i) {
        const ClipPtr clip = random_motion(random, random_partner(random, *first, most_samples));
        Placement other, placement;
        random_placements(random, *first, *clip, other, placement);
        placement.translate += glm::dvec2{random.real(0, side), random.real(0, side)};
        crowd.add(clip, placement, random_fit(random));
    }
    return crowd;
}

inline std::vector<PeopleConflict> all_of(const PeopleConflicts& conflicts) {
    std::vector<PeopleConflict> out;
    for (std::size_t i = 0; i < conflicts.size(); ++i) out.push_back(conflicts[i]);
    return out;
}

}  // namespace mobb::test
