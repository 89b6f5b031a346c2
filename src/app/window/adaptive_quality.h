/// Adaptive quality: a coarse picture while input comes, the fine one once it stops.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace mobbscope::app {

/// Decides by what earlier pictures took: where the fine one takes long, a coarse one comes first.
class AdaptiveQuality {
  public:
    /// A fine picture that takes no longer comes at once, seconds.
    static constexpr double kAtOnce = 0.04;
    /// What a coarse one may take.
    static constexpr double kCoarse = 0.05;
    /// Without a change after which the fine picture is begun.
    static constexpr double kRest = 0.06;
    /// It is painted for so long between looks at what has come from mouse and keys.
    static constexpr double kSlice = 0.03;
    static constexpr int kCoarsest = 4;

    /// What a fine picture needs: all of it, or as the last one had the same disks in the same places, the rest.
    enum class Needs { all, rest };

    /// Whether the next picture is to be a coarse one. After a coarse one it is, so that a drag does not flicker.
    bool coarse_first(Needs needs) const { return coarse_shown_ || fine_seconds_[index(needs)] > kAtOnce; }
    /// Of the next coarse one: it has every so many pixels across and down.
    int divisor() const { return divisor_; }

    void painted_fine(Needs needed, double seconds);
    void painted_coarse(double seconds);
    /// The fine picture was tried at once and given up after so long.
    void gave_up_fine(Needs needed, double seconds);

  private:
    static std::size_t index(Needs needs) { return static_cast<std::size_t>(needs); }

    /// By what they need. As long as nothing is known, all of a fine picture is expected to take long.
    std::array<double, 2> fine_seconds_{std::numeric_limits<double>::infinity(), 0};
    int divisor_ = 2;
    bool coarse_shown_ = false;
};

}  // namespace mobbscope::app
