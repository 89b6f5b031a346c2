#include <base/text.h>
#include <explain/axis_intervals.h>
#include <explain/certificate.h>
#include <mobb/trace.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

constexpr int kFan = 64;  // directions all around that are searched besides

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
        if (!(tile.gap >= -line_tolerance(farthest))) return tile_number(i) + ": its gap is negative";
        if (!(beyond <= line_tolerance(farthest))) {
            return tile_number(i) + ": a disk passes its line by " + brief(beyond) + " m";
        }
        covered = tile.t1;
    }
    return "";
}

}  // namespace mobbscope
