#include <render/text/ticks.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mobbscope {

double nice_step(double span, double parts) {
    const double largest = span / parts;
    const double power = std::pow(10.0, std::floor(std::log10(largest)));
    // The tolerance keeps 0.9999... * 2 from falling to 1.
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= largest * (1 + 1e-9)) return factor * power;
    }
    return power;
}

std::vector<double> ticks(double from, double to, double step) {
    std::vector<double> out;
    const double slack = 1e-6;
    const double first = std::ceil(from / step - slack);
    const int count = static_cast<int>(std::floor(to / step + slack) - first) + 1;
    for (int i = 0; i < count; ++i) out.push_back((first + i) * step);
    return out;
}

std::string tick_text(double value, double step) {
    const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 12);
    char text[64];
    // Adding zero turns -0 into 0.
    std::snprintf(text, sizeof text, "%.*f", decimals, value + 0.0);
    return text;
}

}  // namespace mobbscope
