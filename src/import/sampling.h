/// From stored frames to samples at a uniform spacing (contract, section 2), and where a path is put.
#pragma once

#include <import/import.h>
#include <mobb/clip.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// A stored frame: a disk and its time in seconds.
struct TimedDisk {
    double t = 0;
    mobb::Disk disk;
};

/// A time within so many frames of a stored frame is that frame: rounded times in files lose nothing.
inline constexpr double kFrameTolerance = 0.02;

/// The most samples that a file may become.
inline constexpr std::size_t kMaxSamples = 10'000'000;

/// The first frame whose time is not t0 + i*dt within kFrameTolerance frames, with dt = span/(N-1); none if all are.
/// Needs two frames at least.
std::optional<std::size_t> first_out_of_step(std::span<const TimedDisk> frames);

/// True if no frame is out of step.
inline bool is_uniform(std::span<const TimedDisk> frames) { return !first_out_of_step(frames); }

/// How many samples lie at begin, begin + step, ... up to and including `end`; at least 1. A frame is `step` long. The
/// result is a double, as absurd inputs give absurd counts.
double sample_count(double begin, double end, double step);

/// Disks at begin + k*step, k in [0, count); between stored frames x, y and r are interpolated, beyond them they stay.
/// A frame, to be within kFrameTolerance of, is as long as the gap between the stored ones or as `step`, the shorter.
/// The frames' times increase.
std::vector<mobb::Disk> sample(std::span<const TimedDisk> frames, double begin, double step, std::size_t count);

/// Moves and turns the path as `origin` says. A path that stays within 0.1 m of its start keeps its heading.
void put_at_origin(std::vector<mobb::Disk>& samples, Origin origin);

}  // namespace mobbscope
