#include <base/text.h>
#include <mobb/clip.h>
#include <scene/view_state.h>

#include <array>

namespace mobbscope {

namespace {

constexpr int kMaxLevel = 1000;  // far beyond the depth of any tree: halving 2^31 samples takes 31 levels

std::optional<int> level(std::string_view text) {
    const std::optional<int> value = parse_int(text);
    return value && *value >= 0 && *value <= kMaxLevel ? value : std::nullopt;
}

// In the order of their enumerations.
constexpr std::array<std::string_view, 5> kPresets{"iso", "top", "front", "side", "free"};
constexpr std::array<std::string_view, 2> kThemes{"dark", "light"};
constexpr std::array<std::string_view, 11> kColorings{"agent", "level",    "volume", "empty", "waste",    "fill",
                                                      "floor", "overhang", "share",  "tests", "avoidable"};
constexpr std::array<std::string_view, 4> kPasts{"pair", "ancestors", "siblings", "all"};
constexpr std::array<std::string_view, 2> kArrangements{"none", "grid"};
constexpr std::array<std::string_view, 3> kShows{"space-time", "moment", "plan"};
constexpr std::array<std::string_view, 9> kStepUnits{"",    "",          "end",  "separated", "overlap",
                                                     "hit", "avoidable", "leaf", "depth"};

/// "leaf", "leaf:3", "depth:4".
std::optional<Step> found_step(std::string_view text) {
    const std::size_t colon = text.find(':');
    const auto unit = enumerator_named<Step::Unit>(kStepUnits, text.substr(0, colon));
    if (!unit || *unit <= Step::Unit::end) return std::nullopt;
    const int least = *unit == Step::Unit::depth ? 0 : 1;
    std::optional<int> value;
    if (colon != std::string_view::npos) {
        value = parse_int(text.substr(colon + 1));
    } else if (*unit != Step::Unit::depth) {
        value = 1;
    }
    if (!value || *value < least) return std::nullopt;
    return Step{*unit, static_cast<double>(*value)};
}

}  // namespace

LevelRange parse_level_range(const std::string& text) {
    if (text == "leaves") return {0, kMaxLevel, true};
    const std::size_t colon = text.find(':');
    const std::optional<int> first = level(std::string_view(text).substr(0, colon));
    const std::optional<int> last =
        colon == std::string::npos ? first : level(std::string_view(text).substr(colon + 1));
    if (!first || !last || *first > *last) {
        throw std::invalid_argument(
            in_quotes(text) +
            " is not a range of levels: give a level (2), a range (1:3) or leaves; levels go from 0 to " +
            std::to_string(kMaxLevel));
    }
    return {*first, *last, false};
}

std::optional<ValueRange> parse_value_range(const std::string& text) {
    if (text == "auto" || text == "none") return std::nullopt;
    const std::size_t colon = text.find(':');
    const std::optional<double> least = parse_double(std::string_view(text).substr(0, colon));
    const std::optional<double> most =
        colon == std::string::npos ? std::nullopt : parse_double(std::string_view(text).substr(colon + 1));
    // As files have them.
    const bool within = least && most && *least >= -mobb::kMaxTime && *most <= mobb::kMaxTime;
    if (!within || !(*least <= *most)) {
        throw std::invalid_argument(in_quotes(text) +
                                    " is not a range: give the least and the most, such as 0:2.5, from " +
                                    brief(-mobb::kMaxTime) + " to " + brief(mobb::kMaxTime));
    }
    return ValueRange{*least, *most};
}

Step parse_step(const std::string& text) {
    if (text == "end") return {Step::Unit::end, 0};
    if (text.ends_with('%')) {
        const std::optional<double> percent = parse_double(std::string_view(text).substr(0, text.size() - 1));
        if (percent && *percent >= 0 && *percent <= 100) return {Step::Unit::percent, *percent};
    } else if (const std::optional<int> event = parse_int(text); event && *event >= 0) {
        return {Step::Unit::event, static_cast<double>(*event)};
    } else if (const std::optional<Step> found = found_step(text)) {
        return *found;
    }
    throw std::invalid_argument(
        in_quotes(text) +
        " is not a step: give an event number from 0, a percentage (40%), end, hit, leaf:3 (the "
        "third; likewise separated, overlap, avoidable) or depth:4");
}

std::string to_string(const LevelRange& levels) {
    if (levels.leaves) return "leaves";
    const std::string first = std::to_string(levels.first);
    return levels.first == levels.last ? first : first + ':' + std::to_string(levels.last);
}

std::string to_string(const ValueRange& range) { return format_double(range.least) + ':' + format_double(range.most); }

std::string to_string(const Step& step) {
    switch (step.unit) {
        case Step::Unit::event:
            return std::to_string(static_cast<int>(step.value));
        case Step::Unit::percent:
            return format_double(step.value) + '%';
        case Step::Unit::end:
            return "end";
        case Step::Unit::separated:
        case Step::Unit::overlap:
        case Step::Unit::hit:
        case Step::Unit::avoidable:
        case Step::Unit::leaf:
        case Step::Unit::depth:
            break;
    }
    const std::string unit(kStepUnits[static_cast<std::size_t>(step.unit)]);
    const int value = static_cast<int>(step.value);
    return value == 1 && step.unit != Step::Unit::depth ? unit : unit + ':' + std::to_string(value);
}

std::optional<CameraPreset> camera_preset(const std::string& name) {
    return enumerator_named<CameraPreset>(kPresets, name);
}
std::string_view name(CameraPreset preset) { return kPresets[static_cast<std::size_t>(preset)]; }

std::optional<Theme> theme_from_name(std::string_view text) { return enumerator_named<Theme>(kThemes, text); }
std::string_view name(Theme theme) { return kThemes[static_cast<std::size_t>(theme)]; }

std::optional<ColorBy> color_by_from_name(std::string_view text) { return enumerator_named<ColorBy>(kColorings, text); }
std::string_view name(ColorBy color_by) { return kColorings[static_cast<std::size_t>(color_by)]; }

std::optional<Past> past_from_name(std::string_view text) { return enumerator_named<Past>(kPasts, text); }
std::string_view name(Past past) { return kPasts[static_cast<std::size_t>(past)]; }
std::optional<Arrange> arrange_from_name(std::string_view text) {
    return enumerator_named<Arrange>(kArrangements, text);
}
std::string_view name(Arrange arrange) { return kArrangements[static_cast<std::size_t>(arrange)]; }

std::optional<Show> show_from_name(std::string_view text) { return enumerator_named<Show>(kShows, text); }
std::string_view name(Show show) { return kShows[static_cast<std::size_t>(show)]; }

}  // namespace mobbscope
