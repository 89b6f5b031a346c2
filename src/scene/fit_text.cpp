#include <base/text.h>
#include <scene/fit_text.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

constexpr std::array<std::string_view, 5> kFitKeys{"tree", "leaf", "levels", "axes", "time_scale"};

[[noreturn]] void refuse_fit(std::string_view key, std::string_view value, const std::string& give) {
    throw std::invalid_argument(std::string(key) + " cannot be " + in_quotes(value) + ": give " + give);
}

int whole_number(std::string_view key, std::string_view value, int least) {
    const auto number = parse_int(value);
    if (!number || *number < least) refuse_fit(key, value, "a whole number from " + std::to_string(least));
    return *number;
}

void set_option(mobb::FitOptions& fit, std::string_view key, std::string_view value) {
    if (key == "tree") {
        const auto tree = find_tree_kind(value);
        if (!tree) refuse_fit(key, value, "one of " + listed(mobb::tree_kind_names()));
        fit.tree = *tree;
    } else if (key == "leaf") {
        fit.leaf = whole_number(key, value, 1);
    } else if (key == "levels") {
        fit.levels = whole_number(key, value, 0);
    } else if (key == "axes") {
        const auto axes = mobb::axes_from_name(value);
        if (!axes) refuse_fit(key, value, "one of " + listed(mobb::axes_names()));
        fit.axes = *axes;
    } else if (key == "time_scale") {
        fit.time_scale = parse_number_within(value, 1 / mobb::kMaxTimeScale, mobb::kMaxTimeScale);
    } else {
        throw std::invalid_argument("a fit has no option " + in_quotes(key) + "; it has " + listed(kFitKeys));
    }
}

using OptionText = std::pair<std::string_view, std::string>;

/// Whether a kind of tree takes an option.
bool takes(mobb::TreeKind tree, std::string_view option) {
    const mobb::TreeInfo& kind = mobb::info(tree);
    if (option == "axes") return kind.chooses_axes();
    if (option == "time_scale") return kind.uses_time_scale();
    return kind.splits();
}

/// Options beside the tree, as text.
std::array<OptionText, 4> options_beside_tree(const mobb::FitOptions& fit) {
    return {OptionText{"leaf", std::to_string(fit.leaf)}, OptionText{"levels", std::to_string(fit.levels)},
            OptionText{"axes", mobb::name(fit.axes)}, OptionText{"time_scale", format_double(fit.time_scale)}};
}

/// Those that are not as in `base`.
std::vector<OptionText> others(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    const std::array<OptionText, 4> all = options_beside_tree(fit), usual = options_beside_tree(base);
    std::vector<OptionText> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i] != usual[i]) out.push_back(all[i]);
    }
    return out;
}

std::string words_of(const mobb::FitOptions& fit, std::span<const OptionText> options) {
    std::string out(mobb::info(fit.tree).label);
    for (const auto& [key, value] : options) {
        out += ", ";
        out += key == "time_scale" ? "time scale" : key;
        out += ' ';
        out += value;
    }
    return out;
}

}  // namespace

mobb::FitOptions parse_fit(std::string_view text, mobb::FitOptions base) {
    while (true) {
        const std::size_t comma = text.find(',');
        const std::string_view part = trimmed(text.substr(0, comma));
        const std::size_t equals = part.find('=');
        if (equals == std::string_view::npos) {
            set_option(base, "tree", part);
        } else {
            set_option(base, trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1)));
        }
        if (comma == std::string_view::npos) return base;
        text.remove_prefix(comma + 1);
    }
}

std::string fit_text(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    std::string out(mobb::name(fit.tree));
    for (const auto& [key, value] : others(fit, base)) {
        out += ',';
        out += key;
        out += '=';
        out += value;
    }
    return out;
}

std::string fit_words(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    return words_of(fit, others(fit, base));
}

std::vector<std::string> names_of_fits(std::span<const mobb::FitOptions> fits) {
    std::vector<std::string> out;
    for (const mobb::FitOptions& fit : fits) {
        std::vector<OptionText> told;
        for (const OptionText& option : options_beside_tree(fit)) {
            const bool differs = std::ranges::any_of(fits, [&](const mobb::FitOptions& other) {
                const std::array<OptionText, 4> its = options_beside_tree(other);
                return std::ranges::find(its, option) == its.end();
            });
            if (differs && takes(fit.tree, option.first)) told.push_back(option);
        }
        out.push_back(words_of(fit, told));
    }
    std::map<std::string, int> count;
    for (std::string& name : out) {
        const int number = ++count[name];
        if (number == 1) continue;
        name += " (";
        name += std::to_string(number);
        name += ')';
    }
    return out;
}

}  // namespace mobbscope
