#include <base/text.h>
#include <explain/axis_intervals.h>
#include <explain/certificate.h>
#include <explain/clearance.h>
#include <mobb/trace.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

constexpr int kFan = 64;               // directions all around that are searched besides
constexpr double kTouchingGap = 1e-9;  // metres that touching disks may seem to overlap by
constexpr double kFarAway = 1e4;       // metres, from where on rounding takes a larger share of that
constexpr int kSpeedSteps = 80;        // of the search for the speed with the widest gap

/// A pair of samples that share time, with their disks at both ends of it.
struct Piece {
    double t0 = 0, t1 = 0;
    std::array<mobb::Disk, 2> a{}, b{};
};

glm::dvec2 center(const mobb::Disk& disk) { return {disk.x, disk.y}; }

double tolerance(double coordinate) { return kTouchingGap * std::max(1.0, coordinate / kFarAway); }

/// A point of a path as a line sees it: a moment, and how far the path reaches along the direction then.
struct Reach {
    double t = 0, y = 0;
};

/// The points of a side that a line must pass, seen along a direction: of A the upper ones, of B the lower ones.
class Hull {
  public:
    /// `way`: 1 keeps the upper hull, -1 the lower one.
    explicit Hull(double way) : way_(way) {}

    /// Points come in order of time.
    void add(Reach point) {
        if (!points_.empty() && points_.back().t == point.t) {
            if (way_ * (points_.back().y - point.y) >= 0) return;
            points_.pop_back();
        }
        while (points_.size() > 1 && !turns(points_[points_.size() - 2], points_.back(), point)) points_.pop_back();
        points_.push_back(point);
    }
    std::span<const Reach> points() const { return points_; }
    /// Where the last point is, if it is of that time.
    double at_end(double time, double otherwise) const {
        return !points_.empty() && points_.back().t == time ? points_.back().y : otherwise;
    }

    /// The extreme slope from an earlier point of the hull to `to`: of an upper hull the least, of a lower one the
    /// most.
    std::optional<double> slope_to(Reach to) const {
        std::optional<double> out;
        for (const Reach& from : points_) {
            if (from.t >= to.t) break;
            const double slope = (to.y - from.y) / (to.t - from.t);
            if (!out || way_ * (*out - slope) > 0) out = slope;
        }
        return out;
    }

  private:
    bool turns(Reach p, Reach q, Reach r) const {
        return way_ * ((q.y - p.y) * (r.t - p.t) - (r.y - p.y) * (q.t - p.t)) > 0;
    }

    double way_;
    std::vector<Reach> points_;
};

/// How far lines across one direction keep A and B apart, from a first piece on.
class Sweep {
  public:
    /// `slack`: metres by which each side is drawn back, so that disks that touch are still kept apart.
    Sweep(std::span<const Piece> pieces, glm::dvec2 direction, double slack)
        : pieces_(pieces), u_(direction), slack_(slack) {}

    /// How many pieces from `first` on a fixed line keeps apart.
    std::size_t fixed(std::size_t first) const {
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

    /// The same of a line that moves evenly, at whatever speed.
    std::size_t moving(std::size_t first) const {
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

    /// The tile over pieces [first, first + count).
    Tile tile(std::size_t first, std::size_t count, bool fixed_line) const {
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
        constexpr double kRoundings = 16;
        out.gap = gap_at(out.speed) - kRoundings * std::numeric_limits<double>::epsilon() * (reach + along);
        return out;
    }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    Reach of_a(std::size_t piece, std::size_t end) const {
        const Piece& p = pieces_[piece];
        return {end == 0 ? p.t0 : p.t1, glm::dot(u_, center(p.a[end])) + p.a[end].r};
    }
    Reach of_b(std::size_t piece, std::size_t end) const {
        const Piece& p = pieces_[piece];
        return {end == 0 ? p.t0 : p.t1, glm::dot(u_, center(p.b[end])) - p.b[end].r};
    }

    /// No line that keeps them apart moves faster.
    static double most_speed(const Hull& a, const Hull& b) {
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
    static double widest(const Gap& gap, double most) {
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

    std::span<const Piece> pieces_;
    glm::dvec2 u_;
    double slack_;
};

/// Along which the disks of a pair stay apart all the time that they share: from A to B when they are nearest. A convex
/// hull of the two relative disks at its ends is nearest to the origin there.
glm::dvec2 line_of(const mobb::Approach& approach) {
    const double s = approach.nearest();
    const glm::dvec2 from_a(-approach.d.x - s * approach.d_change.x, -approach.d.y - s * approach.d_change.y);
    const double length = glm::length(from_a);
    return length > 0 ? from_a / length : glm::dvec2(1, 0);
}

/// All pairs that share time before `end`, in order of time, and the direction that keeps each apart.
struct Pieces {
    std::vector<Piece> pieces;
    std::vector<glm::dvec2> lines;
    double slack = 0;
};

Pieces pieces_before(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double end) {
    Pieces out;
    double farthest = 0;
    for (const ClearancePiece& piece : clearance_over_time(a, b).pieces) {
        const double t1 = std::min(piece.t1, end);
        if (t1 <= piece.t0) break;
        const mobb::SweptDisk of_a = mobb::swept(a, piece.a_sample);
        const mobb::SweptDisk of_b = mobb::swept(b, piece.b_sample);
        out.pieces.push_back({piece.t0, t1, {of_a.at(piece.t0), of_a.at(t1)}, {of_b.at(piece.t0), of_b.at(t1)}});
        const Piece& last = out.pieces.back();
        out.lines.push_back(line_of({{last.a[0], last.a[1], last.t0, t1}, {last.b[0], last.b[1], last.t0, t1}}));
        for (const mobb::Disk& disk : {of_a.from, of_a.to, of_b.from, of_b.to})
            farthest = std::max(farthest, std::abs(disk.x) + std::abs(disk.y) + disk.r);
    }
    out.slack = 0.25 * tolerance(farthest);
    return out;
}

/// The fewest tiles: from each end point on the longest, and of those that are as long the one with the widest gap.
std::vector<Tile> fewest_tiles(const Pieces& all, std::span<const glm::dvec2> directions, bool fixed_lines) {
    std::vector<Tile> out;
    for (std::size_t first = 0; first < all.pieces.size();) {
        std::optional<Tile> best;
        std::size_t reached = 1;
        const auto try_line = [&](glm::dvec2 direction) {
            const Sweep sweep(all.pieces, direction, all.slack);
            const std::size_t fixed = sweep.fixed(first);
            const std::size_t moving = fixed_lines ? 0 : sweep.moving(first);
            const std::size_t count = std::max(fixed, moving);
            if (count < reached) return;
            const Tile tile = sweep.tile(first, count, fixed >= moving);
            if (best && count == reached && tile.gap <= best->gap) return;
            best = tile;
            reached = count;
        };
        try_line(all.lines[first]);
        for (const glm::dvec2 direction : directions) {
            try_line(direction);
            try_line(-direction);
        }
        // Rounding alone can leave no line: this one is refused by who checks it.
        if (!best) best = Sweep(all.pieces, all.lines[first], all.slack).tile(first, 1, false);
        out.push_back(*best);
        first += reached;
    }
    return out;
}

std::string tile_number(std::size_t tile) { return "tile " + std::to_string(tile); }

/// How far a tile's line is passed by disks that are present in it, metres: by A's beyond it and B's before it.
double excess(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Tile& tile, double& farthest) {
    const auto reach = [&](const mobb::PlacedClip& clip, double way) {
        double out = -std::numeric_limits<double>::infinity();
        for (int i = 0; i < clip.count(); ++i) {
            const double begin = std::max(clip.time(i), tile.t0), end = std::min(clip.time(i + 1), tile.t1);
            if (!(end > begin)) continue;
            const mobb::SweptDisk swept = mobb::swept(clip, i);
            for (const double t : {begin, end}) {
                const mobb::Disk disk = swept.at(t);
                out =
                    std::max(out, way * (glm::dot(tile.direction, center(disk)) - tile.speed * (t - tile.t0)) + disk.r);
                farthest = std::max(farthest, std::abs(disk.x) + std::abs(disk.y) + disk.r);
            }
        }
        return out;
    };
    return reach(a, 1) + tile.gap + reach(b, -1);
}

/// A pair of samples that shares more than a moment, and some of it between two times; none if there is none.
std::optional<std::pair<int, int>> pair_between(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double from,
                                                double to) {
    for (int i = 0, j = 0; i < a.count() && j < b.count();) {
        const double begin = std::max(a.time(i), b.time(j)), end = std::min(a.time(i + 1), b.time(j + 1));
        if (end - begin > mobb::kMinOverlap && std::min(end, to) > std::max(begin, from)) return std::pair(i, j);
        a.time(i + 1) <= b.time(j + 1) ? ++i : ++j;
    }
    return std::nullopt;
}

std::string why_no_contact(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const mobb::Contact& contact) {
    if (contact.a_sample < 0 || contact.a_sample >= a.count() || contact.b_sample < 0 || contact.b_sample >= b.count())
        return "the contact is of samples that there are not";
    const mobb::SweptDisk of_a = mobb::swept(a, contact.a_sample);
    const mobb::SweptDisk of_b = mobb::swept(b, contact.b_sample);
    if (!mobb::overlap_in_time(of_a.begin, of_a.end, of_b.begin, of_b.end))
        return "the samples of the contact share no time";
    if (!mobb::Approach(of_a, of_b).collides()) return "the samples of the contact do not collide";
    const mobb::Contact is = mobb::contact_of(a, contact.a_sample, b, contact.b_sample);
    return is == contact ? "" : "the contact begins at " + brief(is.time) + " s, " + brief(is.distance) + " m apart";
}

}  // namespace

Certificate certify(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const std::optional<mobb::Contact>& contact,
                    std::span<const glm::dvec2> directions, std::span<const mobb::MeasuredPair> measured) {
    // Half of what may be left, so that no rounding makes it more.
    const double end = contact ? contact->time - 0.5 * kMostCrack : std::numeric_limits<double>::infinity();
    const Pieces pieces = pieces_before(a, b, end);
    std::vector<glm::dvec2> all(directions.begin(), directions.end());
    for (const mobb::MeasuredPair& pair : measured) all.push_back(line_of(mobb::approach_of(a, pair.i, b, pair.j)));
    for (int i = 0; i < kFan; ++i) {
        const double angle = std::numbers::pi * i / kFan;
        all.emplace_back(std::cos(angle), std::sin(angle));
    }
    const std::vector<Tile> fixed = fewest_tiles(pieces, all, true);
    if (fixed.size() <= 1) return {contact, fixed};
    const std::vector<Tile> moving = fewest_tiles(pieces, all, false);
    return {contact, moving.size() < fixed.size() ? moving : fixed};
}

Certificate certify(const FittedScene& fitted, const SceneQuery& query, const RecordedQuery& recorded) {
    const mobb::PlacedTree a = fitted.placed(query.a);
    const mobb::PlacedTree b = fitted.placed(query.b);
    std::vector<glm::dvec2> directions;
    std::vector<mobb::MeasuredPair> measured;
    for (int step = 0; step < recorded.trace.size(); ++step) {
        const mobb::Trace::Event event = recorded.trace[step];
        measured.insert(measured.end(), event.pairs.begin(), event.pairs.end());
        if (event.outcome != mobb::Outcome::separated) continue;
        const glm::dvec2 direction(separating_axis(a, b, event));
        // Boxes that share time are never apart along time alone.
        const double length = glm::length(direction);
        if (length > 0) directions.push_back(direction / length);
    }
    return certify(a.placed_clip(), b.placed_clip(), recorded.contact, directions, measured);
}

std::string why_not_proven(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Certificate& certificate) {
    double end = std::min(a.time(a.count()), b.time(b.count()));
    if (certificate.contact) {
        if (std::string why = why_no_contact(a, b, *certificate.contact); !why.empty()) return why;
        end = certificate.contact->time - kMostCrack;
    }
    double covered = std::max(a.time(0), b.time(0));
    const std::vector<Tile>& tiles = certificate.tiles;
    for (std::size_t i = 0; i <= tiles.size(); ++i) {
        const double next = i < tiles.size() ? tiles[i].t0 : end;
        if (const auto pair = pair_between(a, b, covered, next)) {
            return "nothing is said of samples " + std::to_string(pair->first) + " and " +
                   std::to_string(pair->second) + " from " + brief(covered) + " s to " + brief(next) + " s";
        }
        if (i == tiles.size()) break;
        const Tile& tile = tiles[i];
        if (!(tile.t1 > tile.t0)) return tile_number(i) + " lasts no time";
        if (i > 0 && tile.t0 < tiles[i - 1].t1) return tile_number(i) + " begins before the one before it ends";
        constexpr double kUnit = 1e-15;
        if (!(std::abs(glm::length(tile.direction) - 1) <= kUnit))
            return tile_number(i) + ": its direction is no unit vector";
        double farthest = 0;
        const double beyond = excess(a, b, tile, farthest);
        if (!(tile.gap >= -tolerance(farthest))) return tile_number(i) + ": its gap is negative";
        if (!(beyond <= tolerance(farthest))) {
            return tile_number(i) + ": a disk passes its line by " + brief(beyond) + " m";
        }
        covered = tile.t1;
    }
    return "";
}

}  // namespace mobbscope
