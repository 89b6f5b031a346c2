/// Proofs of answers that need no tree: lines on the floor that keep two paths apart, each for some time (contract,
/// "Certificates").
#pragma once

#include <explain/separating_line.h>
#include <mobb/query.h>
#include <mobb/trace.h>
#include <scene/fitted_scene.h>

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The proof of an answer. Of a miss the tiles cover the common time; of a hit the time before its contact.
struct Certificate {
    std::optional<mobb::Contact> contact;
    std::vector<Tile> tiles;  ///< in order of time
};

/// What may be left between a tile and the next one, and before a contact, seconds.
inline constexpr double kMostCrack = mobb::kMinOverlap;

/// The proof of a query's answer, with the lines of the boxes and samples that its trace has separated and measured:
/// there are never more tiles than of these.
Certificate certify(const FittedScene& fitted, const SceneQuery& query, const RecordedQuery& recorded);

/// The proof with the fewest tiles for the directions that are searched: `directions` (unit, either way round), the
/// line of each pair of samples that `measured` names, and a fan of others. Fixed lines are taken where they need no
/// more tiles than moving ones. `contact`: of a hit.
Certificate certify(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const std::optional<mobb::Contact>& contact,
                    std::span<const glm::dvec2> directions, std::span<const mobb::MeasuredPair> measured);

/// Why the certificate does not prove the answer; empty: it does. Looks at the samples alone.
std::string why_not_proven(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Certificate& certificate);

}  // namespace mobbscope
