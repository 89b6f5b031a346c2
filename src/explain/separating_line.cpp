#include <explain/clearance.h>
#include <explain/separating_line.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobbscope {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouchingGap = 1e-9;  // metres that touching disks may seem to overlap by
constexpr double kFarAway = 1e4;       // metres, from where on rounding takes a larger share of that
constexpr int kSpeedSteps = 80;        // of the search for the speed with the widest gap

/// No line that keeps them apart moves faster.
double most_speed(const Hull& a, const Hull& b) {
    double low = kInfinity, high = -kInfinity;
    for (const Hull* hull : {&a, &b}) {
        for (const Reach& p : hull->points()) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
    }
    const double seconds = a.points().back().t - a.points().front().t;
    return seconds > 0 ? 2 * (high - low) / seconds : 0;
}

/// Where a function that rises and then falls is largest.
template <class Gap>
double widest(const Gap& gap, double most) {
    double from = -most, to = most;
    for (int i = 0; i < kSpeedSteps; ++i) {
        const double low = from + (to - from) / 3, high = to - (to - from) / 3;
        if (gap(low) < gap(high)) {
            from = low;
        } else {
            to = high;
        }
    }
    return 0.5 * (from + to);
}

}  // namespace

double line_tolerance(double coordinate) { return kTouchingGap * std::max(1.0, coordinate / kFarAway); }

glm::dvec2 line_of(const mobb::Approach& approach) {
    const double s = approach.nearest();
    const glm::dvec2 from_a(-approach.d.x - s * approach.d_change.x, -approach.d.y - s * approach.d_change.y);
    const double length = glm::length(from_a);
    return length > 0 ? from_a / length : glm::dvec2(1, 0);
}

Pieces pieces_before(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double end) {
    Pieces out;
    double farthest = 0;
    for (const ClearancePiece& piece : clearance_over_time(a, b).pieces) {
        const double t1 = std::min(piece.t1, end);
        if (t1 <= piece.t0) break;
        const mobb::SweptDisk of_a = mobb::swept(a, piece.a_sample);
        const mobb::SweptDisk of_b = mobb::swept(b, piece.b_sample);
        out.pieces.push_back({piece.t0, t1, {of_a.at(piece.t0), of_a.at(t1)}, {of_b.at(piece.t0), of_b.at(t1)}});
        const SharedTime& last = out.pieces.back();
        out.lines.push_back(line_of({{last.a[0], last.a[1], last.t0, t1}, {last.b[0], last.b[1], last.t0, t1}}));
        for (const mobb::Disk& disk : {of_a.from, of_a.to, of_b.from, of_b.to})
            farthest = std::max(farthest, std::abs(disk.x) + std::abs(disk.y) + disk.r);
    }
    out.slack = 0.25 * line_tolerance(farthest);
    return out;
}

void Hull::add(Reach point) {
    if (!points_.empty() && points_.back().t == point.t) {
        if (way_ * (points_.back().y - point.y) >= 0) return;
        points_.pop_back();
    }
    while (points_.size() > 1 && !turns(points_[points_.size() - 2], points_.back(), point)) points_.pop_back();
    points_.push_back(point);
}

std::optional<double> Hull::slope_to(Reach to) const {
    std::optional<double> out;
    for (const Reach& from : points_) {
        if (from.t >= to.t) break;
        const double slope = (to.y - from.y) / (to.t - from.t);
        if (!out || way_ * (*out - slope) > 0) out = slope;
    }
    return out;
}

std::size_t Sweep::fixed(std::size_t first) const {
    double a = -kInfinity, b = kInfinity;
    std::size_t i = first;
    for (; i < pieces_.size(); ++i) {
        for (std::size_t end : {0u, 1u}) {
            a = std::max(a, of_a(i, end).y - slack_);
            b = std::min(b, of_b(i, end).y + slack_);
        }
        if (a > b) break;
    }
    return i - first;
}

std::size_t Sweep::moving(std::size_t first) const {
    Hull a(1), b(-1);
    double least = -kInfinity, most = kInfinity;  // speeds
    std::size_t i = first;
    for (; i < pieces_.size(); ++i) {
        bool apart = true;
        for (std::size_t end : {0u, 1u}) {
            Reach upper = of_a(i, end), lower = of_b(i, end);
            upper.y -= slack_;
            lower.y += slack_;
            apart &= upper.y <= lower.y && upper.y <= b.at_end(upper.t, kInfinity) &&
                     a.at_end(lower.t, -kInfinity) <= lower.y;
            // A's point lies above no line through an earlier one of B, and the other way round.
            if (const auto slope = b.slope_to(upper)) least = std::max(least, *slope);
            if (const auto slope = a.slope_to(lower)) most = std::min(most, *slope);
            a.add(upper);
            b.add(lower);
        }
        if (!apart || least > most) break;
    }
    return i - first;
}

Tile Sweep::tile(std::size_t first, std::size_t count, bool fixed_line) const {
    Hull a(1), b(-1);
    double reach = 0;
    for (std::size_t i = first; i < first + count; ++i) {
        for (std::size_t end : {0u, 1u}) {
            a.add(of_a(i, end));
            b.add(of_b(i, end));
            for (const mobb::Disk& disk : {pieces_[i].a[end], pieces_[i].b[end]})
                reach = std::max(reach, std::abs(disk.x) + std::abs(disk.y) + disk.r);
        }
    }
    Tile out{pieces_[first].t0, pieces_[first + count - 1].t1, u_};
    const auto gap_at = [&](double speed) {
        double upper = -kInfinity, lower = kInfinity;
        for (const Reach& p : a.points()) upper = std::max(upper, p.y - speed * (p.t - out.t0));
        for (const Reach& p : b.points()) lower = std::min(lower, p.y - speed * (p.t - out.t0));
        return lower - upper;
    };
    if (!fixed_line) out.speed = widest(gap_at, most_speed(a, b));
    const double along = std::abs(out.speed) * (out.t1 - out.t0);
    // More than those of a sum, so that a path which is moved or grows by less than the gap does not collide either.
    constexpr double kRoundings = 32;
    out.gap = gap_at(out.speed) - kRoundings * std::numeric_limits<double>::epsilon() * (reach + along);
    return out;
}

Reach Sweep::of_a(std::size_t piece, std::size_t end) const {
    const SharedTime& p = pieces_[piece];
    return {end == 0 ? p.t0 : p.t1, glm::dot(u_, center(p.a[end])) + p.a[end].r};
}

Reach Sweep::of_b(std::size_t piece, std::size_t end) const {
    const SharedTime& p = pieces_[piece];
    return {end == 0 ? p.t0 : p.t1, glm::dot(u_, center(p.b[end])) - p.b[end].r};
}

}  // namespace mobbscope
