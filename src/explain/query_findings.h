/// All that the window says about a query beyond its answer and trace; kept until scene or query change.
#pragma once

#include <explain/clearance.h>
#include <explain/query_proof.h>
#include <explain/recursion.h>
#include <mobb_tracks/floor_paths.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct QueryFindings {
    std::vector<DrawnAgent> sides;  ///< A and B; refer to the fitted scene
    Clearance clearance;
    mobb::FloorPaths floor;  ///< known only where there is no contact
    Recursion recursion;
    QueryProof proof;
};

/// Requires a query in the view, and `recorded` to be its record.
QueryFindings find_out(const FittedScene& fitted, const ViewState& view, const RecordedQuery& recorded);

/// "A and B never collide", "They collide at 2.310 s". `sides`: A and B.
std::string answer_words(std::span<const DrawnAgent> sides, const Clearance& clearance);

/// Why they never collide, or how they do: sentences, the most telling first. `floor` is read where there is no
/// contact.
std::vector<std::string> why_words(std::span<const DrawnAgent> sides, const Clearance& clearance,
                                   const mobb::FloorPaths& floor);

/// The proof in sentences; none where two share no time, so that no line is needed.
std::vector<std::string> proof_sentences(const QueryFindings& findings);

/// How many pairs the direct search measures: up to the first contact.
std::int64_t direct_pairs(const Clearance& clearance);

/// What the trees saved against measuring every pair, or that they did not.
std::string gain_words(const mobb::TestCounts& tests, const Clearance& clearance);

}  // namespace mobbscope
