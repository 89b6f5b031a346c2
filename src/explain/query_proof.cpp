#include <base/text.h>
#include <explain/query_proof.h>
#include <explain/query_sentence.h>
#include <mobb/traversal.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

constexpr double kLeastShare = 0.6;  // of the shorter side's extent that a wall covers at least

constexpr double kWorthMetres = 1e-3;  // a smaller gap is only said to be small

/// What a path covers while a line holds.
struct Cover {
    double least = std::numeric_limits<double>::infinity();  ///< along the direction, seen from the moving line
    double most = -std::numeric_limits<double>::infinity();
    mobb::Interval along{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

Cover cover_of(const mobb::PlacedClip& clip, const Tile& tile) {
    const glm::dvec2 across(-tile.direction.y, tile.direction.x);
    Cover out;
    for (int i = mobb::first_ending_after(clip, 0, clip.count(), tile.t0); i < clip.count(); ++i) {
        const mobb::SweptDisk swept = mobb::swept(clip, i);
        if (swept.begin >= tile.t1) break;
        for (const double time : {std::max(swept.begin, tile.t0), std::min(swept.end, tile.t1)}) {
            const mobb::Disk disk = swept.at(time);
            const glm::dvec2 center(disk.x, disk.y);
            const double reach = glm::dot(tile.direction, center) - tile.speed * (time - tile.t0);
            const double along = glm::dot(across, center);
            out.least = std::min(out.least, reach - disk.r);
            out.most = std::max(out.most, reach + disk.r);
            out.along = {std::min(out.along.t0, along - disk.r), std::max(out.along.t1, along + disk.r)};
        }
    }
    return out;
}

/// What both cover, or the gap between what they do; never a sliver.
mobb::Interval neighbourhood(mobb::Interval a, mobb::Interval b) {
    const double low = std::max(a.t0, b.t0), high = std::min(a.t1, b.t1);
    const double middle = 0.5 * (low + high);
    const double least = kLeastShare * std::min(a.t1 - a.t0, b.t1 - b.t0);
    const double half = 0.5 * std::max(std::abs(high - low), least);
    return {middle - half, middle + half};
}

/// When the two are nearest within a tile.
double nearest_time(const Clearance& clearance, const Tile& tile) {
    double least = std::numeric_limits<double>::infinity(), at = 0.5 * (tile.t0 + tile.t1);
    const auto& pieces = clearance.pieces;
    auto piece = std::ranges::partition_point(pieces, [&](const ClearancePiece& p) { return p.t1 <= tile.t0; });
    for (; piece != pieces.end() && piece->t0 < tile.t1; ++piece) {
        const double from = std::max(piece->t0, tile.t0), to = std::min(piece->t1, tile.t1);
        if (from >= to) continue;
        const double time = std::clamp(piece->least_at, from, to);
        const double here = clearance_at(*piece, time);
        if (here >= least) continue;
        least = here;
        at = time;
    }
    return at;
}

mobb::Disk disk_at(const mobb::PlacedClip& clip, double time) {
    const int sample = std::min(mobb::first_ending_after(clip, 0, clip.count(), time), clip.count() - 1);
    return mobb::swept(clip, sample).at(time);
}

}  // namespace

ProofLine proof_line_of(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Tile& tile,
                        const Clearance& clearance) {
    ProofLine out{tile};
    const Cover of_a = cover_of(a, tile), of_b = cover_of(b, tile);
    out.offset = 0.5 * (of_a.most + of_b.least);
    out.along = neighbourhood(of_a.along, of_b.along);
    out.nearest = nearest_time(clearance, tile);
    const mobb::Disk p = disk_at(a, out.nearest), q = disk_at(b, out.nearest);
    const glm::dvec2 across(-tile.direction.y, tile.direction.x);
    out.nearest_along =
        std::clamp(0.5 * glm::dot(across, glm::dvec2(p.x + q.x, p.y + q.y)), out.along.t0, out.along.t1);
    return out;
}

std::optional<std::size_t> QueryProof::at(double time) const {
    const auto line =
        std::ranges::find_if(lines, [&](const ProofLine& each) { return each.t0 <= time && time <= each.t1; });
    if (line == lines.end()) return std::nullopt;
    // Where two lines meet, the later one holds from then on.
    const auto next = line + 1;
    return static_cast<std::size_t>((next != lines.end() && next->t0 <= time ? next : line) - lines.begin());
}

QueryProof proof_of(const FittedScene& fitted, const SceneQuery& query, const RecordedQuery& recorded,
                    const Clearance& clearance) {
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    QueryProof out;
    out.certificate = certify(a, b, recorded);
    if (!recorded.trace.stopped()) out.ends = traversal_ends(a, b, recorded.trace);
    out.margins = margins_of(a.placed_clip(), b.placed_clip(), out.certificate);
    for (const Tile& tile : out.certificate.tiles)
        out.lines.push_back(proof_line_of(a.placed_clip(), b.placed_clip(), tile, clearance));
    const auto least = std::ranges::min_element(out.lines, {}, &ProofLine::gap);
    if (least != out.lines.end()) out.tightest = static_cast<std::size_t>(least - out.lines.begin());
    return out;
}

std::string gap_words(double gap) { return gap < kWorthMetres ? "< 1 mm" : proven_words(gap, "m"); }

std::string line_words(std::span<const DrawnAgent> sides, const Tile& tile) {
    const double heading = std::atan2(tile.direction.x, -tile.direction.y) * 180 / std::numbers::pi;
    // A line has no front: 0 to 179 degrees.
    const int degrees = (static_cast<int>(std::lround(heading)) + 360) % 180;
    const std::string along = "along " + std::to_string(degrees) + "\u00B0";
    if (tile.speed == 0) return along + ", fixed";
    return along + ", moves " + formatted("%.2f", std::abs(tile.speed)) + " m/s towards " +
           sides[tile.speed > 0 ? 1 : 0].label;
}

std::string tile_words(std::span<const DrawnAgent> sides, const QueryProof& proof, std::size_t index) {
    const ProofLine& line = proof.lines[index];
    return "Line " + std::to_string(index + 1) + " of " + std::to_string(proof.lines.size()) +
           formatted(", %.2f to %.2f s: ", line.t0, line.t1) + line_words(sides, line) + ", " + gap_words(line.gap) +
           " between the two";
}

}  // namespace mobbscope
