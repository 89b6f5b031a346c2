/// From stored frames to samples at a uniform spacing (contract, section 2), and where a path is put.
#pragma once

#include <import/clip/imported_clip.h>
#include <mobb/clip.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

/// A stored frame: a disk and its time in seconds.
struct TimedDisk {
    double t = 0;
    mobb::Disk disk;
};

/// A time within so many frames of a stored frame is that frame: rounded times in files lose nothing.
inline constexpr double kFrameTolerance = 0.02;

/// A sampling time so many samples after the last key is still at it. Less than kFrameTolerance: a last key that comes
/// that much earlier was meant to.
inline constexpr double kEndTolerance = 0.001;

/// The most samples that a file may become.
inline constexpr std::size_t kMaxSamples = 10'000'000;

/// The most samples, and poses of single joints, that a file or the sources of a scene become together beyond what they
/// hold: with a high fps a small file would fill the memory, and take minutes to pose.
inline constexpr std::size_t kMostMadeSamples = 2'000'000;
inline constexpr std::size_t kMostMadePoses = 10'000'000;

/// Twice what the files hold: to make more samples of what is long is no fault.
constexpr std::size_t most_made(std::size_t stored) { return kMostMadeSamples + 2 * stored; }

/// What was made so far, and what the files hold.
class MadeSamples {
  public:
    /// `joints`: that are posed for each, 0 without a skeleton. False if that is more than may be made.
    bool add(std::size_t samples, std::size_t joints) {
        samples_ += samples;
        poses_ += samples * joints;
        return samples_ <= most_made(stored_) && poses_ <= kMostMadePoses + 2 * stored_poses_;
    }
    /// What add refused, for a message.
    static std::string too_many() {
        return "become more than " + std::to_string(kMostMadeSamples) + " samples, or " +
               std::to_string(kMostMadePoses) +
               " poses of single joints, beyond what the files hold; lower fps, give "
               "trim";
    }
    /// Of frames that no clip before came from.
    void add_stored(std::size_t frames, std::size_t joints) {
        stored_ += frames;
        stored_poses_ += frames * joints;
    }

  private:
    std::size_t samples_ = 0, poses_ = 0, stored_ = 0, stored_poses_ = 0;
};

/// What times in whole milliseconds may have been rounded to, in seconds: 60 frames a second are then 16 or 17 ms
/// apart.
inline constexpr double kMillisecond = 0.001;

/// Whether a time in seconds is a whole number of milliseconds.
bool is_in_milliseconds(double t);

/// How far times may be from where they were in step, in seconds: kFrameTolerance frames, or less than what all of them
/// are rounded to, unless that is much of a frame. `rounding`: seconds; 0: they are not rounded.
double time_tolerance(double step, double rounding);

/// The first frame whose time is not t0 + i*dt within time_tolerance, with dt = span/(N-1); none if all are. Needs two
/// frames at least.
std::optional<std::size_t> first_out_of_step(std::span<const TimedDisk> frames, double rounding = 0);

/// True if no frame is out of step.
inline bool is_uniform(std::span<const TimedDisk> frames, double rounding = 0) {
    return !first_out_of_step(frames, rounding);
}

/// How many samples lie at begin, begin + step, ... up to and including `end`; at least 1. A frame is `step` long. The
/// result is a double, as absurd inputs give absurd counts.
double sample_count(double begin, double end, double step);

/// Sampling times begin + k*step in seconds, k in [0, count).
struct SampleGrid {
    double begin = 0;
    double step = 1;
    std::size_t count = 1;

    double time(std::size_t k) const { return begin + static_cast<double>(k) * step; }
};

/// The times at which a file with keys from `first` to `last` is sampled, or the part of it that `trim` takes. Throws
/// std::invalid_argument if trim begins after the end, or for more than `most` samples.
SampleGrid sample_grid(double first, double last, const std::optional<std::pair<double, double>>& trim, double step,
                       std::size_t most);

/// Disks at the times of the grid; between stored frames x, y and r are interpolated, beyond them they stay. A frame,
/// to be within kFrameTolerance of, is as long as the gap between the stored ones or as the grid's step, the shorter.
/// The frames' times increase.
std::vector<mobb::Disk> sample(std::span<const TimedDisk> frames, const SampleGrid& grid);

/// Between two disks: x, y and r are interpolated.
mobb::Disk mix(const mobb::Disk& a, const mobb::Disk& b, double share);

/// Moves and turns the path as `origin` says. A path that stays within 0.1 m of its start keeps its heading. Gives how
/// it was turned.
mobb::Rotation put_at_origin(std::vector<mobb::Disk>& samples, Origin origin);

/// Turns headings, degrees, with their path.
void turn_headings(std::vector<double>& headings, const mobb::Rotation& turn);

}  // namespace mobbscope
