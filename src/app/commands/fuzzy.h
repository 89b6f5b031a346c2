/// How well a few letters stand for a longer text.
#pragma once

#include <optional>
#include <string_view>

namespace mobbscope::app {

/// The letters of `word` must stand in `text` in their order, whatever their case; starts of words and runs count more,
/// and a match of letters strewn about is none. Higher is better; 0 for an empty word.
std::optional<double> fuzzy_score(std::string_view word, std::string_view text);

/// The same where `word` is the beginning of a word of `text`, or all of it: for whole sentences, in which a few
/// letters are found always.
std::optional<double> word_score(std::string_view word, std::string_view text);

}  // namespace mobbscope::app
