#include <app/commands/arguments.h>
#include <base/text.h>

#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace mobbscope::app {

namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view what, const std::string& wanted) {
    throw std::invalid_argument(std::string(what) + " cannot be " + in_quotes(text) + ": give " + wanted);
}

}  // namespace

std::string given_name(std::string_view text, const std::string& what) {
    const std::string_view name = trimmed(text);
    if (name.empty()) throw std::invalid_argument(what + " needs a name");
    if (!is_utf8(name)) throw std::invalid_argument("a name is written in UTF-8");
    return std::string(name);
}

std::vector<std::string> words_of(std::string_view text) {
    std::istringstream in{std::string(text)};
    return {std::istream_iterator<std::string>(in), {}};
}

std::vector<std::filesystem::path> paths_in(const std::string& text) {
    if (!text.starts_with('"')) return {text};
    std::vector<std::filesystem::path> out;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == ' ') continue;
        std::string one;
        bool ended = false;
        if (text[at] == '"') {
            for (++at; at < text.size() && !ended; ++at) {
                if (text[at] == '\\' && at + 1 < text.size()) {
                    one += text[++at];
                } else if (text[at] == '"') {
                    ended = true;
                } else {
                    one += text[at];
                }
            }
        }
        if (!ended) refuse(text, "the files", "one, or several in double quotes: \"a.csv\" \"b.csv\"");
        out.emplace_back(one);
    }
    return out;
}

std::string as_argument(const std::vector<std::filesystem::path>& files) {
    if (files.size() == 1 && !files.front().native().starts_with('"')) return files.front().string();
    std::string out;
    for (const std::filesystem::path& file : files) {
        out += out.empty() ? "\"" : " \"";
        for (const char c : file.native()) {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
        out += '"';
    }
    return out;
}

double number_in(std::string_view text, std::string_view what, double low, double high) {
    const std::optional<double> value = parse_double(trimmed(text));
    if (!value || *value < low || *value > high) {
        refuse(text, what, "a number from " + brief(low) + " to " + brief(high));
    }
    return *value;
}

int whole_number_in(std::string_view text, std::string_view what, int low, int high) {
    const std::optional<int> value = parse_int(trimmed(text));
    if (!value || *value < low || *value > high) {
        refuse(text, what, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return *value;
}

glm::dvec2 two_numbers(std::string_view text, std::string_view what) {
    const std::string_view both = trimmed(text);
    const std::size_t blank = both.find(' ');
    const std::optional<double> x = parse_double(both.substr(0, blank));
    const std::optional<double> y =
        blank == std::string_view::npos ? std::nullopt : parse_double(trimmed(both.substr(blank)));
    if (!x || !y) refuse(text, what, "two numbers, such as 1.5 -2");
    return {*x, *y};
}

std::pair<std::string_view, std::string_view> name_and_word(std::string_view text, std::string_view what) {
    const std::string_view both = trimmed(text);
    const std::size_t blank = both.rfind(' ');
    if (blank == std::string_view::npos) refuse(text, what, "a name and a number, such as A 12");
    return {trimmed(both.substr(0, blank)), both.substr(blank + 1)};
}

int node_at(const mobb::Tree& tree, std::string_view text) {
    const std::size_t dot = text.find('.');
    const int count = static_cast<int>(tree.nodes().size());
    if (dot == std::string_view::npos) return whole_number_in(text, "the node", 0, count - 1);
    const int level = whole_number_in(text.substr(0, dot), "the level", 0, tree.depth() - 1);
    // Nodes lie depth first, so those of a level are in order of time.
    std::vector<int> on_level;
    for (int node = 0; node < count; ++node) {
        if (tree.level(node) == level) on_level.push_back(node);
    }
    const int last = static_cast<int>(on_level.size()) - 1;
    return on_level[static_cast<std::size_t>(whole_number_in(text.substr(dot + 1), "the place on the level", 0, last))];
}

int leaf_of_sample(const mobb::Tree& tree, int sample) {
    int node = 0;
    while (true) {
        if (tree.is_leaf(node)) return node;
        node = tree.child_with(node, sample);
    }
}

int neighbour_on_level(const mobb::Tree& tree, int node, int direction) {
    const int level = tree.level(node);
    const int count = static_cast<int>(tree.nodes().size());
    for (int next = node + direction; next >= 0 && next < count; next += direction) {
        if (tree.level(next) == level) return next;
    }
    return -1;
}

}  // namespace mobbscope::app
