/// Proofs of answers in words, beside what the trees needed for the same.
#pragma once

#include <explain/margins.h>

#include <span>
#include <string>

namespace mobbscope {

/// "Proven bound: at least 0.183 m apart. Proof: 2 lines over 12.40 s; the trees needed 5 box pairs and 2 runs of
/// samples." Without `ends` nothing is said of the trees.
std::string proof_words(const Certificate& certificate, std::span<const TraversalEnd> ends);

/// What no proof about two says, as doubles do not hold it (coarse_times): "A: up to 19 % of each sample's 1e-05 s is
/// not sure ...". Empty where all their times are held well.
std::string doubt_words(const std::string& name_a, const mobb::PlacedClip& a, const std::string& name_b,
                        const mobb::PlacedClip& b);

/// "Both radii may grow by 0.091 m; B may start up to 0.400 s earlier or later." `b`: B's name.
std::string margin_words(const Margins& margins, const std::string& b);

}  // namespace mobbscope
