/// Where the marks of a scale go.
#pragma once

#include <string>
#include <vector>

namespace mobbscope {

/// The largest of 1, 2, 5 times a power of ten that divides `span` into at least `parts` pieces. span > 0, parts >= 1.
double nice_step(double span, double parts);

/// The multiples of `step` in [from, to], with a hair's breadth of tolerance at the ends.
std::vector<double> ticks(double from, double to, double step);

/// A multiple of `step` with just the decimals that the step needs: "0.5", "10".
std::string tick_text(double value, double step);

}  // namespace mobbscope
