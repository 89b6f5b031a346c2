/// The numbers in words that people read, found again with all their digits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

struct NumberInText {
    std::size_t begin = 0, end = 0;  ///< bytes of the text
    double value = 0;
    std::string unit{};  ///< as it follows: "m/s"; empty: none does
};

/// Shown numbers are rounded. This knows the exact ones, in the order in which texts have them.
class ShownNumbers {
  public:
    explicit ShownNumbers(std::vector<double> exact = {}) : exact_(std::move(exact)) {}

    /// The numbers of the next text: each is the first exact one left that is shown so, else what stands there. Digits
    /// of names ("walk4_subject1", "07_05") are none.
    std::vector<NumberInText> in(std::string_view text);

  private:
    std::vector<double> exact_;
};

}  // namespace mobbscope
