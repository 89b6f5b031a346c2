/// Options that are a number or two, in one table from which the command line, dialogs and scripts take them.
#pragma once

#include <base/text.h>

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What an option is; of one number the second is 0.
using Numbers = std::array<double, 2>;

/// How an option is called, and what it takes.
struct NumberOptionInfo {
    std::string_view key;            ///< "pose-distance": of the command line behind two dashes
    std::string_view placeholder{};  ///< "D"
    std::string_view title{};        ///< in a dialog
    std::string_view unit{};         ///< ... behind the number; empty: none
    std::string_view help{};         ///< what it means
    double least = 0, most = 0;      ///< of each number
    double step = 1;                 ///< of an arrow key in a dialog
    int decimals = 0;                ///< shown there; none of a whole number
    bool whole = false;
    char between = 0;            ///< two numbers stand around it: ':', and the first is not the larger one, or 'x'
    std::string_view example{};  ///< of two numbers: "30x40"
};

/// ... and where it is among others.
template <class Options>
struct NumberOption : NumberOptionInfo {
    Numbers (*get)(const Options&);
    void (*set)(Options&, Numbers);
};

/// "0.16", "1:4", "30x40"
std::string text_of(const NumberOptionInfo& option, Numbers numbers);
/// What text_of writes; throws std::invalid_argument, saying what is allowed.
Numbers parse_numbers(const NumberOptionInfo& option, const std::string& text);

/// What an option means, and in brackets what holds without it.
template <class Options>
std::string help_of(const NumberOption<Options>& option) {
    return std::string(option.help).append(" (").append(text_of(option, option.get(Options{}))).append(")");
}

/// Sets one by "hubs=4". Throws std::invalid_argument.
template <class Options>
void set_number(Options& options, std::span<const NumberOption<Options>> all, const std::string& text) {
    const std::string key = text.substr(0, text.find('='));
    const auto option = std::ranges::find(all, key, &NumberOption<Options>::key);
    if (option == all.end()) {
        std::vector<std::string> keys;
        for (const NumberOption<Options>& each : all) keys.emplace_back(each.key);
        throw std::invalid_argument("there is no option " + in_quotes(key) + did_you_mean(key, keys));
    }
    if (key.size() == text.size()) {
        throw std::invalid_argument(key + " needs a value: " + key + '=' + text_of(*option, option->get(Options{})));
    }
    option->set(options, parse_numbers(*option, text.substr(key.size() + 1)));
}

}  // namespace mobbscope
