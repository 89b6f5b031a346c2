/// Queries of a simulation, kept for a workload.
#pragma once

#include <crowd/simulation/reservation_grid.h>
#include <scene/scene.h>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mobbscope {

/// Which queries a workload is drawn from.
enum class Recorded {
    asked,  ///< those that the trees were asked: the pairs that are near each other in space and time
    all,    ///< candidate against every motion that another agent is committed to, near or far, at any time
};

/// A uniform sample without repetition of all queries that it is offered (reservoir sampling: Vitter 1985, Algorithm
/// R).
class QuerySample {
  public:
    /// Keeps at most `size` queries; 0 keeps all. Of `all` only pairs whose bounds on the floor come within `range`
    /// metres of each other are offered.
    QuerySample(Recorded recorded, std::size_t size, std::uint64_t seed,
                double range = std::numeric_limits<double>::infinity())
        : recorded_(recorded), size_(size), seed_(seed), range_(range) {}

    Recorded recorded() const { return recorded_; }
    double range() const { return range_; }
    void offer(std::span<const AskedPair> pairs);
    std::uint64_t offered() const { return offered_; }
    std::size_t size() const { return kept_.size(); }

    /// A scene with the clips of `scene` and one query for each pair, in the order in which they were asked. The
    /// candidate is `a`.
    Scene workload(const Scene& scene) const;

  private:
    struct Kept {
        std::uint64_t number;  ///< among those offered
        AskedPair pair;
    };

    Recorded recorded_;
    std::size_t size_;
    std::uint64_t seed_;
    double range_;
    std::uint64_t offered_ = 0;
    std::vector<Kept> kept_;
};

}  // namespace mobbscope
