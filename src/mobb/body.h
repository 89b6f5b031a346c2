/// Bodies that one disk does not fit: several disks, each in its place along the heading of a clip.
#pragma once

#include <mobb/clip.h>

#include <span>
#include <vector>

namespace mobb {

/// A disk of a body, in metres: where its centre is from the clip's, along the heading and to its left. r >= 0.
struct BodyDisk {
    double forward = 0;
    double left = 0;
    double r = 0;

    friend bool operator==(const BodyDisk&, const BodyDisk&) = default;
};

/// The most disks that a body may have.
inline constexpr std::size_t kMaxBodyDisks = 64;

/// As few disks in a row as cover a rectangle, centred, and stand out at its sides by at most a twentieth of the
/// shorter one; at most kMaxBodyDisks. `length` along the heading and `width`: metres, >= 0.
std::vector<BodyDisk> rectangle_body(double length, double width);
/// Metres: how far the disks of rectangle_body stand out at the longer sides.
double rectangle_excess(double length, double width);

/// Metres: the radius of the disk around the clip's centre that all disks of a body are within.
double body_reach(std::span<const BodyDisk> body);

/// Whether a clip ever is 0.1 m or more from its first sample: less is taken for noise, and has no direction.
bool has_direction(const Clip& clip);

/// The direction of motion at each sample, degrees: that of the shortest way of at least 0.1 m, and less is taken for
/// noise. Who stands keeps the direction it had; before it first moves it has the first one that it will have; who
/// never moves so far (has_direction) has 0.
/// `body`: of whom. If its disks are the same when it is turned by 180 degrees (to 1e-9 m), it may as well drive
/// backwards: it takes, of that direction and its opposite, the one that is nearer to the heading before. So who
/// reverses does not turn round, and linear disks do not run through the centre. Other bodies, and no body, look where
/// they go.
std::vector<double> headings_of(const Clip& clip, std::span<const BodyDisk> body = {});

/// The path of one disk of a body whose centre walks a clip: same times, same motion. So linear disks run on straight
/// lines between their places at the samples. `headings`: degrees, one a sample. Throws std::invalid_argument, as Clip
/// does, and unless there is a heading for each sample.
Clip member_of(const Clip& clip, std::span<const double> headings, const BodyDisk& disk);

}  // namespace mobb
