#include <base/number_options.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace mobbscope {

namespace {

std::string text_of_one(const NumberOptionInfo& option, double number) {
    return option.whole ? std::to_string(static_cast<std::int64_t>(number)) : format_double(number);
}

double parse_whole(const NumberOptionInfo& option, const std::string& text) {
    std::int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    // As doubles, the largest seed and the next number would be one.
    const auto least = static_cast<std::int64_t>(option.least);
    const auto most = static_cast<std::int64_t>(option.most);
    if (error == std::errc{} && stop == end && number >= least && number <= most) return static_cast<double>(number);
    throw std::invalid_argument(in_quotes(text) + " is not a whole number from " + text_of_one(option, option.least) +
                                " to " + text_of_one(option, option.most));
}

}  // namespace

std::string text_of(const NumberOptionInfo& option, Numbers numbers) {
    std::string out = text_of_one(option, numbers[0]);
    if (option.between != 0) out.append(1, option.between).append(text_of_one(option, numbers[1]));
    return out;
}

Numbers parse_numbers(const NumberOptionInfo& option, const std::string& text) {
    if (option.whole) return {parse_whole(option, text), 0};
    if (option.between == 0) return {parse_number_within(text, option.least, option.most), 0};
    const std::size_t middle = text.find(option.between);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double first = parse_double(text.substr(0, middle)).value_or(kNone);
    const double second = middle == std::string::npos ? kNone : parse_double(text.substr(middle + 1)).value_or(kNone);
    const auto is_allowed = [&](double number) { return number >= option.least && number <= option.most; };
    if (!is_allowed(first) || !is_allowed(second)) {
        throw std::invalid_argument(in_quotes(text) + " is not like " + std::string(option.placeholder) +
                                    ": give two numbers such as " + std::string(option.example) + ", each from " +
                                    brief(option.least) + " to " + brief(option.most));
    }
    if (option.between == ':' && first > second) {
        throw std::invalid_argument(in_quotes(text) +
                                    " is in the wrong order: give the smaller number first, such as " +
                                    std::string(option.example));
    }
    return {first, second};
}

}  // namespace mobbscope
