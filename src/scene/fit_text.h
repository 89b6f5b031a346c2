/// The options of a fit as a line of text: "umobb,leaf=20".
#pragma once

#include <mobb/tree.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// `base` with what the text sets: KEY=VALUE with the keys of a scene's fit, separated by commas; a value alone is the
/// tree. Throws std::invalid_argument, saying what is allowed.
mobb::FitOptions parse_fit(std::string_view text, mobb::FitOptions base);

/// What parse_fit reads: the tree, and what else is not as in `base`.
std::string fit_text(const mobb::FitOptions& fit, const mobb::FitOptions& base);

/// For people, likewise: "UMOBB, leaf 20".
std::string fit_words(const mobb::FitOptions& fit, const mobb::FitOptions& base);

/// Fits that are compared: what tells them apart, or "MOBB" and "MOBB (2)".
std::vector<std::string> names_of_fits(std::span<const mobb::FitOptions> fits);

}  // namespace mobbscope
