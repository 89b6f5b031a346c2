#include <base/text.h>
#include <explain/axis_intervals.h>
#include <explain/certificate.h>
#include <explain/tile_search.h>
#include <mobb/trace.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

/// What may be left between the last tile and a contact, seconds: as little as a crack, but for the rounding of its
/// time.
double most_left_before(const mobb::Contact& contact) {
    return std::max(mobb::kMinOverlap, 2 * std::numeric_limits<double>::epsilon() * std::abs(contact.time));
}

std::string tile_number(std::size_t tile) { return "tile " + std::to_string(tile); }

/// How far a tile's line is passed by disks that are present in it, metres: by A's beyond it and B's before it.
double excess(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Tile& tile, double& farthest) {
    const auto reach = [&](const mobb::PlacedClip& clip, double way) {
        double out = -std::numeric_limits<double>::infinity();
        const int first = mobb::first_ending_after(clip, 0, clip.count(), tile.t0);
        for (int i = first; i < clip.count() && clip.time(i) < tile.t1; ++i) {
            const double begin = std::max(clip.time(i), tile.t0), end = std::min(clip.time(i + 1), tile.t1);
            const mobb::SweptDisk swept = mobb::swept(clip, i);
            for (const double t : {begin, end}) {
                const mobb::Disk disk = swept.at(t);
                out =
                    std::max(out, way * (glm::dot(tile.direction, center(disk)) - tile.speed * (t - tile.t0)) + disk.r);
                farthest = std::max({farthest, std::abs(disk.x), std::abs(disk.y)});
            }
        }
        return out;
    };
    return reach(a, 1) + tile.gap + reach(b, -1);
}

/// A pair of samples that shares more than a moment, and some of it between two times; none if there is none.
std::optional<std::pair<int, int>> pair_between(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double from,
                                                double to) {
    int i = mobb::first_ending_after(a, 0, a.count(), from), j = mobb::first_ending_after(b, 0, b.count(), from);
    while (i < a.count() && j < b.count() && std::max(a.time(i), b.time(j)) < to) {
        const double begin = std::max(a.time(i), b.time(j)), end = std::min(a.time(i + 1), b.time(j + 1));
        if (end - begin > mobb::kMinOverlap && std::min(end, to) > std::max(begin, from)) return std::pair(i, j);
        a.time(i + 1) <= b.time(j + 1) ? ++i : ++j;
    }
    return std::nullopt;
}

std::string why_no_contact(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const mobb::Contact& contact) {
    if (contact.a_sample < 0 || contact.a_sample >= a.count() || contact.b_sample < 0 || contact.b_sample >= b.count())
        return "the contact names samples that do not exist";
    const mobb::SweptDisk of_a = mobb::swept(a, contact.a_sample);
    const mobb::SweptDisk of_b = mobb::swept(b, contact.b_sample);
    if (!mobb::overlap_in_time(of_a.begin, of_a.end, of_b.begin, of_b.end))
        return "the samples of the contact share no time";
    if (!mobb::Approach(of_a, of_b).collides()) return "the samples of the contact do not collide";
    const mobb::Contact is = mobb::contact_of(a, contact.a_sample, b, contact.b_sample);
    return is == contact ? "" : "the contact begins at " + brief(is.time) + " s, " + brief(is.distance) + " m apart";
}

}  // namespace

std::vector<TraversalEnd> deciding_events(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                          const mobb::Trace& trace) {
    std::vector<TraversalEnd> out;
    const mobb::PlacedClip &clip_a = a.placed_clip(), &clip_b = b.placed_clip();
    for (int step = 0; step < trace.size(); ++step) {
        const mobb::Trace::Event event = trace[step];
        if (event.outcome == mobb::Outcome::separated) {
            const mobb::Node &of_a = a.tree().node(event.a), &of_b = b.tree().node(event.b);
            out.push_back({std::max(a.begin(of_a), b.begin(of_b)), std::min(a.end(of_a), b.end(of_b)), true, step});
        } else if (!event.pairs.empty()) {
            const mobb::MeasuredPair first = event.pairs.front(), last = event.pairs.back();
            out.push_back({std::max(clip_a.time(first.i), clip_b.time(first.j)),
                           std::min(clip_a.time(last.i + 1), clip_b.time(last.j + 1)), false, step});
        }
    }
    return out;
}

std::vector<TraversalEnd> traversal_ends(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                         const mobb::Trace& trace) {
    std::vector<TraversalEnd> out;
    for (const TraversalEnd& end : deciding_events(a, b, trace)) {
        if (out.empty() || out.back().is_boxes || end.is_boxes) {
            out.push_back(end);
        } else {
            out.back().t1 = end.t1;
        }
    }
    return out;
}

Certificate certify(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const RecordedQuery& recorded) {
    const std::vector<TraversalEnd> ends = traversal_ends(a, b, recorded.trace);
    const auto known = [&](double time) -> std::optional<KnownLine> {
        const auto end = std::ranges::partition_point(ends, [&](const TraversalEnd& each) { return each.t1 <= time; });
        if (end == ends.end() || !end->is_boxes) return std::nullopt;
        // Boxes that share time are never apart along time alone: what lies of the axis on the floor has a length.
        const glm::dvec2 on_floor(separating_axis(a, b, recorded.trace[end->step]));
        return KnownLine{on_floor / glm::length(on_floor), end->t1};
    };
    // Half of what may be left, so that nothing makes it more.
    const double end = recorded.contact ? recorded.contact->time - 0.5 * most_left_before(*recorded.contact)
                                        : std::numeric_limits<double>::infinity();
    return {recorded.contact, fewest_tiles(a.placed_clip(), b.placed_clip(), end, known)};
}

std::string why_not_proven(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Certificate& certificate) {
    double end = std::min(a.time(a.count()), b.time(b.count()));
    if (certificate.contact) {
        if (std::string why = why_no_contact(a, b, *certificate.contact); !why.empty()) return why;
        end = certificate.contact->time - most_left_before(*certificate.contact);
    }
    double covered = std::max(a.time(0), b.time(0));
    const std::vector<Tile>& tiles = certificate.tiles;
    for (std::size_t i = 0; i <= tiles.size(); ++i) {
        const double next = i < tiles.size() ? tiles[i].t0 : end;
        if (const auto pair = pair_between(a, b, covered, next)) {
            return "no tile covers samples " + std::to_string(pair->first) + " and " + std::to_string(pair->second) +
                   " from " + brief(covered) + " s to " + brief(next) + " s";
        }
        if (i == tiles.size()) break;
        const Tile& tile = tiles[i];
        if (!(tile.t1 > tile.t0)) return tile_number(i) + " is empty (t1 <= t0)";
        if (!std::isfinite(tile.speed)) return tile_number(i) + ": its speed is not finite";
        if (i > 0 && tile.t0 < tiles[i - 1].t1) return tile_number(i) + " begins before the one before it ends";
        constexpr double kUnit = 1e-15;
        if (!(std::abs(glm::length(tile.direction) - 1) <= kUnit))
            return tile_number(i) + ": its direction is not a unit vector";
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
