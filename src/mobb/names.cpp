// The names of every enumerator, as they stand in files.
#include <mobb/clip.h>
#include <mobb/trace.h>
#include <mobb/tree.h>

#include <algorithm>
#include <array>

namespace mobb {

namespace {

constexpr std::array<std::string_view, 2> kMotionNames{"held", "linear"};
constexpr std::array<std::string_view, 3> kAxesNames{"endpoints", "covariance", "minarea"};
constexpr auto kTreeKindNames = rows::table<TreeKind>([](TreeKind kind) { return info(kind).name; });
constexpr std::array<std::string_view, 5> kOutcomeNames{"disjoint_in_time", "separated", "overlap", "hit", "no_hit"};

/// `names` lists the names of the enumerators 0, 1, 2, ...
template <class Enum>
std::optional<Enum> from_name(std::span<const std::string_view> names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Enum>(found - names.begin());
}

}  // namespace

std::string_view name(Motion motion) { return kMotionNames[static_cast<std::size_t>(motion)]; }
std::optional<Motion> motion_from_name(std::string_view name) { return from_name<Motion>(kMotionNames, name); }
std::span<const std::string_view> motion_names() { return kMotionNames; }

std::string_view name(Axes axes) { return kAxesNames[static_cast<std::size_t>(axes)]; }
std::optional<Axes> axes_from_name(std::string_view name) { return from_name<Axes>(kAxesNames, name); }
std::span<const std::string_view> axes_names() { return kAxesNames; }

std::string_view name(TreeKind kind) { return info(kind).name; }
std::optional<TreeKind> tree_kind_from_name(std::string_view name) { return from_name<TreeKind>(kTreeKindNames, name); }
std::span<const std::string_view> tree_kind_names() { return kTreeKindNames; }

std::string_view name(TestKind test) {
    return test.is_box() ? info(test.box()).name : test == TestKind::time ? "time" : "samples";
}
std::optional<TestKind> test_from_name(std::string_view text) {
    const auto found = std::ranges::find(kTestKinds, text, [](TestKind test) { return name(test); });
    return found == kTestKinds.end() ? std::nullopt : std::optional(*found);
}

std::string_view name(Outcome outcome) { return kOutcomeNames[static_cast<std::size_t>(outcome)]; }
std::optional<Outcome> outcome_from_name(std::string_view name) { return from_name<Outcome>(kOutcomeNames, name); }

}  // namespace mobb
