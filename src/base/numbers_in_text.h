/// The numbers in words that people read: large ones in groups, and all of them found again with all their digits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// A large count for people: "65,536".
std::string grouped(std::size_t count);

struct NumberInText {
    std::size_t begin = 0, end = 0;  ///< bytes of the text
    double value = 0;
    std::string unit{};  ///< behind the number: "m/s"; empty: there is none
};

/// Shown numbers are rounded. This knows the exact ones, in the order in which they stand in texts.
class ShownNumbers {
  public:
    explicit ShownNumbers(std::vector<double> exact = {}) : exact_(std::move(exact)) {}

    /// The numbers of the next text. Each has the value of the first unused exact number that is shown like this, or
    /// else the value that the text shows. Digits in names ("walk4_subject1", "07_05") are not numbers.
    std::vector<NumberInText> in(std::string_view text);

  private:
    std::vector<double> exact_;
};

}  // namespace mobbscope
