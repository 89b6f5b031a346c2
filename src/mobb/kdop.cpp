#include <mobb/kdop.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace mobb {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

/// A vector as the sum of two neighbouring directions: along it, a polygon reaches as far as the corner that the two
/// make.
struct KDop::Corner {
    double of_first;
    double of_second;

    double reach(const std::array<double, kDirections>& reach, std::size_t first) const {
        return of_first * reach[first % kDirections] + of_second * reach[(first + 1) % kDirections];
    }
};

/// The directions, from +x on.
struct KDop::Circle {
    static constexpr double kStep = 2 * std::numbers::pi / kDirections;

    std::array<glm::dvec2, kDirections> directions;
    double per_sine = 1 / std::sin(kStep);

    Circle() {
        for (std::size_t k = 0; k < kDirections; ++k) {
            const double angle = kStep * static_cast<double>(k);
            directions[k] = {std::cos(angle), std::sin(angle)};
        }
    }
    glm::dvec2 operator[](std::size_t k) const { return directions[k % kDirections]; }

    /// The last direction that v has reached or passed on its way around; `from` is one that it is known to have, by
    /// less than half a turn.
    std::size_t before(glm::dvec2 v, std::size_t from) const {
        while (cross((*this)[from + 1], v) > 0) ++from;
        return from;
    }
    std::size_t before(glm::dvec2 v) const {
        const std::size_t quarter = v.y >= 0 ? (v.x > 0 ? 0 : 1) : (v.x < 0 ? 2 : 3);
        return before(v, quarter * kQuarter);
    }
    /// v lies between directions `first` and `first` + 1.
    Corner corner(std::size_t first, glm::dvec2 v) const {
        return {cross(v, (*this)[first + 1]) * per_sine, cross((*this)[first], v) * per_sine};
    }

    static const Circle& get() {
        static const Circle circle;
        return circle;
    }
};

KDop::KDop(glm::dvec2 origin, glm::dvec2 axis) : origin_(origin), frame_{axis.x, axis.y} { reach_.fill(-kInfinity); }

void KDop::stretch(glm::dvec2 half) {
    // More would cost digits, and a size of 0 everything.
    constexpr double kMostStretch = 100;
    constexpr double kLeastSize = 1e-100;
    const double least = std::max(std::max(half.x, half.y) / kMostStretch, kLeastSize);
    size_ = glm::max(half, least);
}

KDop::KDop(std::span<const Disk> disks, glm::dvec2 axis) : KDop({disks[0].x, disks[0].y}, axis) {
    const auto center = [&](const Disk& d) { return frame_.inverse()(glm::dvec2{d.x, d.y} - origin_); };
    glm::dvec2 low{kInfinity}, high{-kInfinity};
    for (const Disk& d : disks) {
        low = glm::min(low, center(d) - d.r);
        high = glm::max(high, center(d) + d.r);
    }
    stretch((high - low) / 2.0);

    const Circle& circle = Circle::get();
    std::array<double, kDirections> of_radius;
    for (std::size_t k = 0; k < kDirections; ++k) of_radius[k] = glm::length(circle[k] / size_);
    for (const Disk& d : disks) {
        const glm::dvec2 p = center(d) / size_;
        for (std::size_t k = 0; k < kDirections; ++k) {
            reach_[k] = std::max(reach_[k], glm::dot(circle[k], p) + of_radius[k] * d.r);
        }
    }
}

KDop::KDop(std::span<const Disk> disks) : KDop(glm::dvec2(0), {1, 0}) {
    const Circle& circle = Circle::get();
    for (const Disk& d : disks) {
        for (std::size_t k = 0; k < kDirections; ++k) {
            reach_[k] = std::max(reach_[k], glm::dot(circle[k], glm::dvec2(d.x, d.y)) + d.r);
        }
    }
}

std::array<glm::dvec2, KDop::kDirections / 2> KDop::coarse_corners() const {
    const Circle& circle = Circle::get();
    const double sine = std::sin(2 * Circle::kStep);
    std::array<glm::dvec2, kDirections / 2> out;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::size_t k = 2 * i, next = (k + 2) % kDirections;
        const glm::dvec2 a = circle[k], b = circle[next];
        out[i] = glm::dvec2(reach_[k] * b.y - reach_[next] * a.y, reach_[next] * a.x - reach_[k] * b.x) / sine;
    }
    return out;
}

KDop::KDop(const KDop& a, const KDop& b, glm::dvec2 axis) : KDop(a.origin_, axis) {
    glm::dvec2 low{kInfinity}, high{-kInfinity};
    measure(a, low, high);
    measure(b, low, high);
    stretch((high - low) / 2.0);
    enclose(a);
    enclose(b);
}

KDop KDop::placed(const Rotation& rotation, glm::dvec2 translate) const {
    KDop out = *this;
    out.origin_ = rotation(origin_) + translate;
    out.frame_ = rotation * frame_;
    return out;
}

void KDop::measure(const KDop& other, glm::dvec2& low, glm::dvec2& high) const {
    const Circle& circle = Circle::get();
    const Rotation turn = other.frame_.inverse() * frame_;
    const glm::dvec2 offset = frame_.inverse()(other.origin_ - origin_);
    for (int i = 0; i < 2; ++i) {
        const glm::dvec2 v = other.size_ * turn(i == 0 ? glm::dvec2{1, 0} : glm::dvec2{0, 1});
        const std::size_t k = circle.before(v);
        const Corner corner = circle.corner(k, v);
        high[i] = std::max(high[i], offset[i] + corner.reach(other.reach_, k));
        low[i] = std::min(low[i], offset[i] - corner.reach(other.reach_, k + kHalf));
    }
}

void KDop::enclose(const KDop& other) {
    const Circle& circle = Circle::get();
    const Rotation turn = other.frame_.inverse() * frame_;
    const glm::dvec2 offset = frame_.inverse()(other.origin_ - origin_) / size_;
    // A direction of this outline's, as the other one's circle has it.
    const glm::dvec2 seen_x = other.size_ * turn({1 / size_.x, 0}), seen_y = other.size_ * turn({0, 1 / size_.y});
    const auto seen = [&](glm::dvec2 direction) { return direction.x * seen_x + direction.y * seen_y; };
    std::size_t k = circle.before(seen(circle[0]));
    for (std::size_t j = 0; j < kHalf; ++j) {
        const glm::dvec2 v = seen(circle[j]);
        k = circle.before(v, k);
        const Corner corner = circle.corner(k, v);
        const double along = glm::dot(circle[j], offset);
        reach_[j] = std::max(reach_[j], corner.reach(other.reach_, k) + along);
        reach_[j + kHalf] = std::max(reach_[j + kHalf], corner.reach(other.reach_, k + kHalf) - along);
    }
}

}  // namespace mobb
