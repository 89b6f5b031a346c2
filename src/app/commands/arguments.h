/// What commands take, read from text. Everything here throws std::invalid_argument in one sentence.
#pragma once

#include <base/text.h>
#include <mobb/tree.h>

#include <glm/vec2.hpp>

#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// The words of a text, apart from blanks; throws nothing.
std::vector<std::string> words_of(std::string_view text);

/// The files of an argument: the text as it stands, or several in double quotes with blanks between them; in quotes a
/// backslash stands before a quote or a backslash that is meant.
std::vector<std::filesystem::path> paths_in(const std::string& text);
/// What paths_in reads.
std::string as_argument(const std::vector<std::filesystem::path>& files);

/// A finite number within [low, high]; `what` names it: "the step".
double number_in(std::string_view text, std::string_view what, double low, double high);
/// A whole number within [low, high].
int whole_number_in(std::string_view text, std::string_view what, int low, int high);
/// One of these names, which stand in the order of the enumeration.
template <class Enum>
Enum choice_named(std::span<const std::string_view> names, const std::string& text, const std::string& what) {
    if (const auto found = enumerator_named<Enum>(names, text)) return *found;
    throw std::invalid_argument(what + " cannot be " + in_quotes(text) + ": give " + either(names));
}
/// Two finite numbers with a blank between them.
glm::dvec2 two_numbers(std::string_view text, std::string_view what);
/// "walker north 12": a name, which may hold blanks, and the word behind it.
std::pair<std::string_view, std::string_view> name_and_word(std::string_view text, std::string_view what);

/// A name as it is kept, without blanks around it; `what` has it: "a view".
std::string given_name(std::string_view text, const std::string& what);

/// The node of an index ("12"), or of a level and a place in it, counted from 0 in order of time ("2.1"). Throws
/// std::invalid_argument, saying what there is, if there is none.
int node_at(const mobb::Tree& tree, std::string_view text);

/// The leaf that holds a sample of the tree's clip.
int leaf_of_sample(const mobb::Tree& tree, int sample);

/// The next node of the same level in the direction of time (1) or against it (-1); -1 if there is none.
int neighbour_on_level(const mobb::Tree& tree, int node, int direction);

}  // namespace mobbscope::app
