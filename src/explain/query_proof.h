/// The proof of an answer as people are shown it: how its lines lie, and what they say in words.
#pragma once

#include <explain/certificate.h>
#include <explain/clearance.h>
#include <explain/margins.h>
#include <explain/proof_words.h>
#include <scene/drawn_agent.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// A tile, and where its line runs: at time t in the middle between what the two leave free, at
/// `offset` + speed * (t - t0) along the direction.
struct ProofLine : Tile {
    double offset = 0;         ///< metres along the direction, at t0
    mobb::Interval along{};    ///< metres along the line: the part that lies between the two
    double nearest = 0;        ///< global seconds: when the two are nearest in the tile
    double nearest_along = 0;  ///< metres along the line: where they are then

    /// Of the line at a time, `along` metres from where it is nearest to the world's origin.
    glm::dvec2 at(double time, double along_it) const {
        return (offset + speed * (time - t0)) * direction + along_it * glm::dvec2(-direction.y, direction.x);
    }
};

struct QueryProof {
    Certificate certificate;
    std::optional<Margins> margins;       ///< none of a hit, and where they share no time
    std::vector<ProofLine> lines;         ///< the certificate's tiles
    std::optional<std::size_t> tightest;  ///< the line with the least gap; none without lines
    std::vector<TraversalEnd> ends;       ///< the proof that the trees found; none where recording stopped before

    /// The line that holds at a time.
    std::optional<std::size_t> at(double time) const;
};

/// `clearance`: of the two clips.
ProofLine proof_line_of(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Tile& tile,
                        const Clearance& clearance);

/// `clearance`: of the query.
QueryProof proof_of(const FittedScene& fitted, const SceneQuery& query, const RecordedQuery& recorded,
                    const Clearance& clearance);

/// "0.183 m", "< 1 mm": what lies free across a line.
std::string gap_words(double gap);

/// How a line lies: "along 37\u00B0, fixed", "along 37\u00B0, moves 0.80 m/s towards B". `sides`: A and B.
std::string line_words(std::span<const DrawnAgent> sides, const Tile& tile);

/// "Line 2 of 3, 1.20 to 2.31 s: along 37\u00B0, fixed, 0.183 m between the two"
std::string tile_words(std::span<const DrawnAgent> sides, const QueryProof& proof, std::size_t index);

}  // namespace mobbscope
