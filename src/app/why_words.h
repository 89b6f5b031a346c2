/// The answer to a query, and why, in words.
#pragma once

#include <app/clearance.h>
#include <app/floor_paths.h>
#include <app/recursion.h>
#include <render/subject.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope::app {

/// "A and B never collide", "They collide at 2.310 s". `sides`: A and B.
std::string answer_words(std::span<const Subject> sides, const Clearance& clearance);

/// Why they never collide, or how they do: sentences, the most telling first. `floor` is read where there is no
/// contact.
std::vector<std::string> why_words(std::span<const Subject> sides, const Clearance& clearance, const FloorPaths& floor);

/// How many pairs the direct search measures: up to the first contact.
std::int64_t direct_pairs(const Clearance& clearance);

/// What the trees saved against measuring every pair, or that they did not.
std::string gain_words(const mobb::TestCounts& tests, const Clearance& clearance);

}  // namespace mobbscope::app
