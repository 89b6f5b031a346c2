/// What commands take, read from text. Everything here throws std::invalid_argument in one sentence.
#pragma once

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

/// A finite number within [low, high]; `what` names it: "the step".
double number_in(std::string_view text, std::string_view what, double low, double high);
/// A whole number within [low, high].
int whole_number_in(std::string_view text, std::string_view what, int low, int high);
/// Two finite numbers with a blank between them.
glm::dvec2 two_numbers(std::string_view text, std::string_view what);
/// "walker north 12": a name, which may hold blanks, and the word behind it.
std::pair<std::string_view, std::string_view> name_and_word(std::string_view text, std::string_view what);

}  // namespace mobbscope::app
