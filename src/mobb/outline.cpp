#include <mobb/outline.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobb {

namespace {

constexpr int kDiskCorners = 24;  // 1 / cos(pi / 24) = 1.009

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

bool is_left_of(glm::dvec2 a, glm::dvec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }
bool is_right_of(glm::dvec2 a, glm::dvec2 b) { return is_left_of(b, a); }

/// The unit vectors from a disk's centre to the corners of its polygon, made longer so that the sides touch the disk.
const std::array<glm::dvec2, kDiskCorners>& disk_corners() {
    static const auto corners = [] {
        std::array<glm::dvec2, kDiskCorners> out;
        const double length = 1 / std::cos(std::numbers::pi / kDiskCorners);
        for (int i = 0; i < kDiskCorners; ++i) {
            const double angle = 2 * std::numbers::pi * i / kDiskCorners;
            out[static_cast<std::size_t>(i)] = {length * std::cos(angle), length * std::sin(angle)};
        }
        return out;
    }();
    return corners;
}

/// Points on the stack: as many as two outlines have.
class Points {
  public:
    static constexpr std::size_t kMost = 2 * Outline::kMostCorners + 4;

    void push(glm::dvec2 p) { points_[size_++] = p; }
    void pop() { --size_; }
    std::size_t size() const { return size_; }
    glm::dvec2& operator[](std::size_t i) { return points_[i]; }
    glm::dvec2 operator[](std::size_t i) const { return points_[i]; }
    std::span<const glm::dvec2> all() const { return {points_.data(), size_}; }

  private:
    std::array<glm::dvec2, kMost> points_;
    std::size_t size_ = 0;
};

/// One more point of a hull that turns left all the way: what would turn right before it goes.
void push_turning_left(Points& hull, std::size_t begin, glm::dvec2 p) {
    while (hull.size() >= begin + 2 &&
           cross(hull[hull.size() - 1] - hull[hull.size() - 2], p - hull[hull.size() - 2]) <= 0) {
        hull.pop();
    }
    if (hull.size() == begin || hull[hull.size() - 1] != p) hull.push(p);
}

/// What a side of the polygon adds to its area if it goes and its two neighbours are prolonged until they meet, and
/// where; infinite if they do not meet.
struct Removal {
    double area = std::numeric_limits<double>::infinity();
    glm::dvec2 corner{0};
};
Removal removal(glm::dvec2 before, glm::dvec2 from, glm::dvec2 to, glm::dvec2 after) {
    const glm::dvec2 u = from - before, side = to - from, v = to - after;
    const double turn = cross(v, u);
    if (!(turn > 0)) return {};
    const double along = cross(v, side) / turn;
    const double area = along * cross(u, side) / 2;
    if (!(area >= 0 && area < std::numeric_limits<double>::max())) return {};
    return {area, from + along * u};
}

Points rectangle_around(const Points& polygon) {
    glm::dvec2 low = polygon[0], high = polygon[0];
    for (const glm::dvec2 p : polygon.all()) low = glm::min(low, p), high = glm::max(high, p);
    Points out;
    for (const glm::dvec2 p : {low, {high.x, low.y}, high, {low.x, high.y}}) out.push(p);
    return out;
}

/// Takes out the sides that add least, as many as are too many.
void simplify(Points& polygon) {
    constexpr auto kMost = static_cast<std::size_t>(Outline::kMostCorners);
    while (polygon.size() > kMost) {
        const std::size_t n = polygon.size();
        const std::size_t excess = n - kMost;
        std::array<Removal, Points::kMost> removals;
        std::array<double, Points::kMost> areas{};
        for (std::size_t i = 0; i < n; ++i) {
            removals[i] = removal(polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]);
            areas[i] = removals[i].area;
        }
        // Side i runs from corner i to i + 1. Two neighbours never go in one round, as each needs the other's line; the
        // last side stays.
        std::nth_element(areas.begin(), areas.begin() + excess - 1, areas.begin() + n - 1);
        const double most = areas[excess - 1];
        if (most == std::numeric_limits<double>::infinity()) {
            polygon = rectangle_around(polygon);  // so small that areas vanish
            return;
        }
        Points out;
        for (std::size_t i = 0; i < n; ++i) {
            if (i + 1 < n && n - (i - out.size()) > kMost && removals[i].area <= most) {
                out.push(removals[i].corner);
                ++i;
            } else {
                out.push(polygon[i]);
            }
        }
        polygon = out;
    }
}

/// Brings corners that are in order, but for rounding errors, into it.
template <class Less>
void sort_almost_sorted(std::span<glm::dvec2> points, Less less) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        for (std::size_t j = i; j > 0 && less(points[j], points[j - 1]); --j) std::swap(points[j], points[j - 1]);
    }
}

}  // namespace

Outline::Outline(std::span<const glm::dvec2> corners) : count_(static_cast<int>(corners.size())) {
    const auto leftmost = std::ranges::min_element(corners, is_left_of);
    std::ranges::rotate_copy(corners, leftmost, corners_.begin());
    const std::span<glm::dvec2> all(corners_.data(), corners.size());
    const auto rightmost = static_cast<std::size_t>(std::ranges::max_element(all, is_left_of) - all.begin());
    rightmost_ = static_cast<int>(rightmost);
    sort_almost_sorted(all.first(rightmost + 1), is_left_of);
    sort_almost_sorted(all.subspan(rightmost), is_right_of);
    corners_[corners.size()] = corners_[0];
}

Outline Outline::around(const Disk& disk) {
    std::array<glm::dvec2, kDiskCorners> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = glm::dvec2{disk.x, disk.y} + disk.r * disk_corners()[i];
    }
    return Outline(corners);
}

Outline Outline::around(std::span<const Disk> disks) {
    if (disks.size() == 1) return around(disks[0]);
    const std::size_t half = disks.size() / 2;
    return merged(around(disks.first(half)), around(disks.subspan(half)));
}

Outline Outline::placed(const Rotation& rotation, glm::dvec2 translate) const {
    std::array<glm::dvec2, kMostCorners> corners;
    std::ranges::transform(this->corners(), corners.begin(), [&](glm::dvec2 p) { return rotation(p) + translate; });
    return Outline(std::span(corners).first(this->corners().size()));
}

Outline merged(const Outline& a, const Outline& b) {
    std::array<glm::dvec2, Points::kMost> side;

    Points hull;
    const auto end_lower = std::ranges::merge(a.lower_side(), b.lower_side(), side.begin(), is_left_of).out;
    for (auto p = side.begin(); p != end_lower; ++p) push_turning_left(hull, 0, *p);
    const std::size_t rightmost = hull.size() - 1;
    const auto end_upper = std::ranges::merge(a.upper_side(), b.upper_side(), side.begin(), is_right_of).out;
    for (auto p = side.begin(); p != end_upper; ++p) push_turning_left(hull, rightmost, *p);
    if (hull.size() > 1) hull.pop();  // the upper side ends where the lower one began

    simplify(hull);
    return Outline(hull.all());
}

}  // namespace mobb
