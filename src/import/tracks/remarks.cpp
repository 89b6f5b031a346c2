#include <base/text.h>
#include <import/clip/column_names.h>
#include <import/tracks/remarks.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>

namespace mobbscope {

namespace {

// How plainly something is said.
constexpr int kInProse = 1;   // "The frame rate was 25 fps", "all lengths in cm"
constexpr int kByItself = 2;  // "framerate: 25", "x/cm"

// Between "frame rate" or "unit" and what it is.
constexpr std::array<std::string_view, 25> kFillers{
    "was",       "is",       "are", "of", "about", "approx", "approximately", "ca",      "the",
    "all",       "set",      "to",  "a",  "fixed", "at",     "length",        "lengths", "coordinates",
    "positions", "constant", "fps", "in", "hz",    "1/s",    "s^-1"};
// What is measured in metres without being where somebody is.
constexpr std::array<std::string_view, 19> kOtherLengths{
    "height", "heights",  "z",          "width",  "widths",   "radius",   "radii", "size",     "sizes", "speed",
    "speeds", "velocity", "velocities", "camera", "camera's", "altitude", "depth", "diameter", "error"};

template <std::size_t N>
bool holds(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

constexpr std::string_view kOpening = "([{\"'";
constexpr std::string_view kClosing = ")]}\"'.,;:!?";

/// Without the punctuation around it.
std::string_view bare(std::string_view word) {
    word.remove_prefix(std::min(word.find_first_not_of(kOpening), word.size()));
    const std::size_t last = word.find_last_not_of(kClosing);
    return word.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

/// Apart from blanks, and from the signs that stand between a name and its value.
std::vector<std::string> words_of(std::string_view comment) {
    std::vector<std::string> out;
    std::string word;
    for (const char c : lower(comment) + ' ') {
        if (c != ' ' && c != '\t' && c != '\r' && c != '=' && c != ':') {
            word += c;
        } else if (!word.empty()) {
            out.push_back(std::exchange(word, ""));
        }
    }
    return out;
}

/// How many words from `at` on count frames by the second; 0: none.
std::size_t rate_unit(std::span<const std::string> words, std::size_t at) {
    if (at >= words.size()) return 0;
    const std::string_view word = bare(words[at]);
    if (word == "fps" || word == "frames/s" || word == "frames/second" || word == "frames/sec") return 1;
    const bool is_long = word == "frames" && at + 2 < words.size() &&
                         (bare(words[at + 1]) == "per" || bare(words[at + 1]) == "a") &&
                         (bare(words[at + 2]) == "second" || bare(words[at + 2]) == "s");
    return is_long ? 3 : 0;
}

/// How many words from `at` on say "frame rate", or "frames per second" ahead of a number; 0: none.
std::size_t rate_key(std::span<const std::string> words, std::size_t at) {
    const std::string_view word = bare(words[at]);
    if (word == "framerate" || word == "frame-rate" || word == "frame_rate") return 1;
    if (word == "frame" && at + 1 < words.size() && bare(words[at + 1]) == "rate") return 2;
    return rate_unit(words, at);
}

/// A number, with its unit behind it or not: "25", "25fps", "25/s".
std::optional<double> rate_number(std::string_view word) {
    word = bare(word);
    for (const std::string_view unit : {"fps", "hz", "/s"}) {
        if (word.ends_with(unit)) word.remove_suffix(unit.size());
    }
    return parse_double(word);
}

}  // namespace

void Remarks::read(std::string_view comment) {
    // Long ones are data that somebody put out of use.
    constexpr std::size_t kLongest = 1000;
    const std::vector<std::string> words = words_of(comment.substr(0, kLongest));
    read_rate(words, comment);
    read_unit(words);
}

void Remarks::take(Said& said, double value, int weight, const std::string& what) {
    if (said.value && said.weight == weight && *said.value != value) {
        warnings_.push_back("comments tell two " + what + ", " + brief(*said.value) + " and " + brief(value) +
                            ": the first is taken");
    }
    if (!said.value || weight > said.weight) said = {value, weight};
}

void Remarks::read_rate(const std::vector<std::string>& words, std::string_view comment) {
    bool is_about_rate = false;
    std::optional<double> found;
    int weight = kInProse;
    for (std::size_t at = 0; at < words.size() && !found; ++at) {
        const std::optional<double> number = rate_number(words[at]);
        if (number && (bare(words[at]).ends_with("fps") || rate_unit(words, at + 1) > 0)) found = number;
        const std::size_t key = rate_key(words, at);
        is_about_rate = is_about_rate || key > 0 || found;
        if (key == 0 || found) continue;
        if (at == 0) weight = kByItself;
        std::size_t value = at + key;
        while (value < words.size() && holds(kFillers, bare(words[value]))) ++value;
        if (value < words.size()) found = rate_number(words[value]);
    }
    if (found && *found > 0 && *found <= kMaxFrameRate) {
        take(rate_, *found, weight, "frame rates");
    } else if (is_about_rate) {
        warnings_.push_back("the comment " + in_quotes(trimmed(comment)) +
                            " does not tell a frame rate and is ignored");
    }
}

void Remarks::read_unit(const std::vector<std::string>& words) {
    std::optional<double> found;
    bool of_something_else = false;
    for (std::size_t at = 0; at < words.size(); ++at) {
        const PlainName name = plain_name(bare(words[at]));
        const std::string_view next = at + 1 < words.size() ? std::string_view(words[at + 1]) : std::string_view();
        const bool is_coordinate = name.word == "x" || name.word == "y";
        // "x/m" and "x [m]".
        std::optional<double> of_column;
        if (is_coordinate && !name.unit.empty()) of_column = metres_of_unit(bare(name.unit));
        if (is_coordinate && name.unit.empty() && next.find_first_of("[(") == 0) of_column = metres_of_unit(bare(next));
        if (of_column) {
            take(unit_, *of_column, kByItself, "units");
            return;
        }
        const std::string_view word = bare(words[at]);
        of_something_else = of_something_else || holds(kOtherLengths, word);
        std::size_t value = at + 1;
        if (word == "unit" || word == "units") {
            while (value < words.size() && holds(kFillers, bare(words[value]))) ++value;
        } else if (word != "in") {
            value = words.size();
        }
        const bool per = value + 1 < words.size() && bare(words[value + 1]) == "per";
        if (value < words.size() && !per && !of_something_else && !found) found = metres_of_unit(bare(words[value]));
        // A clause is about one thing.
        if (std::string_view(",;.").find(words[at].back()) != std::string_view::npos) of_something_else = false;
    }
    if (found) take(unit_, *found, kInProse, "units");
}

}  // namespace mobbscope
