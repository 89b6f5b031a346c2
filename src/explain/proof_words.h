/// Proofs of answers in words, beside what the trees needed for the same.
#pragma once

#include <explain/margins.h>

#include <span>
#include <string>

namespace mobbscope {

/// "Proven bound: at least 0.183 m apart. Proof: 2 lines over 12.40 s; the trees needed 5 box pairs and 2 runs of
/// samples." Without `ends` nothing is said of the trees.
std::string proof_words(const Certificate& certificate, std::span<const TraversalEnd> ends);

/// "Both radii may grow by 0.091 m; B may start up to 0.400 s earlier or later." `b`: B's name.
std::string margin_words(const Margins& margins, const std::string& b);

}  // namespace mobbscope
