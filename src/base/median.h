/// The one in the middle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace mobbscope {

/// The number that stands in the middle of them in order; of an even count the later of the two. Requires numbers.
template <class Number>
Number median(std::vector<Number> numbers) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::ranges::nth_element(numbers, middle);
    return *middle;
}

}  // namespace mobbscope
