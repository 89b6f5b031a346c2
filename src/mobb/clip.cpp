#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobb {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool within(double value, double limit) { return std::isfinite(value) && std::abs(value) <= limit; }

[[noreturn]] void refuse_degrees() { throw std::invalid_argument("rotate_deg must be finite and within 1e9 degrees"); }

}  // namespace

Clip::Clip(double dt, std::vector<Disk> samples, Motion motion)
    : dt_(dt), motion_(motion), samples_(std::move(samples)), most_start_(0), reach_(0) {
    // Written so that NaN fails it.
    if (!(dt > kLeastDt) || !std::isfinite(dt)) {
        throw std::invalid_argument(
            "dt must be a finite number over 2e-9 s: what two samples share for at most 1e-9 s is not tested");
    }
    if (samples_.empty()) throw std::invalid_argument("a clip needs at least one sample");
    if (samples_.size() > kMaxSamples) {
        throw std::invalid_argument("a clip holds at most 500000000 samples");
    }
    if (until_next() > kMaxTime) throw std::invalid_argument("the clip lasts longer than 1e12 s");
    most_start_ = mobb::most_start(dt, until_next());
    if (!(most_start_ >= 0)) throw std::invalid_argument("dt is so near to 2e-9 s that no sample is sure to be tested");
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Disk& d = samples_[i];
        const auto fail = [i](const char* what) {
            throw std::invalid_argument("sample " + std::to_string(i) + ": " + what);
        };
        if (!within(d.x, kMaxLength)) fail("x must be finite and within 1e9 m");
        if (!within(d.y, kMaxLength)) fail("y must be finite and within 1e9 m");
        if (!within(d.r, kMaxLength) || d.r < 0) fail("r must be finite, not negative and within 1e9 m");
        reach_ = std::max(reach_, std::abs(d.x) + std::abs(d.y) + d.r);
    }
}

void refuse_placement(const Placement& placement, double most_start) {
    if (!placement.rotate_deg.has_rotation()) refuse_degrees();
    const double start = placement.start;
    if (!within(start, kMaxTime)) throw std::invalid_argument("start must be finite and within 1e12 s");
    if (!within(start, most_start)) {
        std::array<char, 200> text{};
        std::snprintf(text.data(), text.size(),
                      "start %.9g s is too far from 0: doubles tell these samples' times apart within %.3g s; start "
                      "nearer to 0, or give a larger dt",
                      start, most_start);
        throw std::invalid_argument(text.data());
    }
    throw std::invalid_argument("translate must be finite and within 1e9 m");
}

Turn::Turn(double degrees) : degrees_(degrees) {
    rotation_ = within(degrees, kMaxDegrees) ? Rotation::from_degrees(degrees) : Rotation{kNone, kNone};
}

Turn Turn::by(double cosine, double sine) {
    const double squared = cosine * cosine + sine * sine;
    if (!(std::abs(squared - 1) <= 1e-6))
        throw std::invalid_argument("a rotation's cosine and sine must have squares that add up to 1");
    const double length = std::sqrt(squared);
    Turn out;
    out.rotation_ = {cosine / length, sine / length};
    out.degrees_ = kNone;
    return out;
}

double Turn::degrees_of_rotation() const { return std::atan2(rotation_.s, rotation_.c) * (180 / std::numbers::pi); }

Rotation Rotation::from_degrees(double degrees) {
    if (!within(degrees, kMaxDegrees)) refuse_degrees();
    // Quarter turns first, so that 90, 180 and 270 degrees are exact and the rest is small.
    const double quarters = std::nearbyint(degrees / 90);
    const double rest = (degrees - quarters * 90) * (std::numbers::pi / 180);
    const double c = std::cos(rest);
    const double s = std::sin(rest);
    switch (static_cast<long long>(quarters) & 3) {
        case 0:
            return {c, s};
        case 1:
            return {-s, c};
        case 2:
            return {-c, -s};
        default:
            return {s, -c};
    }
}

}  // namespace mobb
