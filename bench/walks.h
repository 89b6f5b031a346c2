/// Walks for measurements: about as fast, as wide and as winding as people's.
#pragma once

#include <mobb/random_motion.h>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace mobb::bench {

/// A walk of `seconds` at 30 samples a second, inside a room of about 3 m as motion capture has it.
inline ClipPtr walk(test::Random& random, double seconds) {
    const int n = static_cast<int>(seconds * 30);
    const double speed = random.real(0.6, 1.4);
    const double turn = random.real(0.4, 1.2) * (random.chance(0.5) ? 1 : -1);
    double x = 0, y = 0, heading = random.real(0, 6.28);
    std::vector<Disk> samples;
    for (int i = 0; i < n; ++i) {
        samples.push_back({x, y, 0.4 + 0.07 * std::sin(0.37 * i)});
        // Turning back whenever the wall is near keeps the walk in the room.
        const bool outward = x * std::cos(heading) + y * std::sin(heading) > 0;
        heading += (outward && std::hypot(x, y) > 1 ? 2.5 : 0.3) * turn / 30 + random.real(-0.05, 0.05);
        x += speed / 30 * std::cos(heading);
        y += speed / 30 * std::sin(heading);
    }
    return std::make_shared<const Clip>(1.0 / 30, std::move(samples));
}

/// A walk of `seconds` at 30 samples a second that goes where it likes: every ten seconds or so another way, so that
/// the area that it roams grows with its path.
inline ClipPtr wander(test::Random& random, double seconds) {
    const int n = static_cast<int>(seconds * 30);
    double x = 0, y = 0, heading = random.real(0, 6.28);
    std::vector<Disk> samples;
    for (int i = 0; i < n; ++i) {
        samples.push_back({x, y, 0.4 + 0.07 * std::sin(0.37 * i)});
        heading += random.real(-0.14, 0.14);
        x += 1.2 / 30 * std::cos(heading);
        y += 1.2 / 30 * std::sin(heading);
    }
    return std::make_shared<const Clip>(1.0 / 30, std::move(samples));
}

/// The rectangle along x and y that the centres span, in metres.
struct Extent {
    glm::dvec2 middle, half;
};
inline Extent extent_of(const Clip& clip) {
    glm::dvec2 low{1e300}, high{-1e300};
    for (const Disk& disk : clip.samples()) {
        low = glm::min(low, {disk.x, disk.y});
        high = glm::max(high, {disk.x, disk.y});
    }
    return {(low + high) / 2.0, (high - low) / 2.0};
}

/// Both clips somewhere in the room, apart in time by up to 1.2 clip lengths: mostly misses, many of them close.
inline Placement somewhere(test::Random& random, double seconds) {
    return {.translate = {random.real(-5, 5), random.real(-5, 5)},
            .rotate_deg = random.real(0, 360),
            .start = random.real(-1.2, 1.2) * seconds};
}

}  // namespace mobb::bench
