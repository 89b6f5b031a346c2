#include <import/text.h>
#include <scene/fit_json.h>

#include <limits>
#include <string>
#include <string_view>

namespace mobbscope {

namespace {

/// A tree of the contract that this version cannot build.
bool is_planned(std::string_view tree) { return tree == "production"; }

mobb::TreeKind read_tree_kind(const JsonPlace& place) {
    const std::string& name = place.string();
    if (is_planned(name)) place.fail(in_quotes(name) + " trees are not in this version yet");
    if (const auto kind = mobb::tree_kind_from_name(name)) return *kind;
    place.fail(in_quotes(name) + " is no tree; give one of " + listed(mobb::tree_kind_names()));
}

mobb::Axes read_axes(const JsonPlace& place) {
    if (const auto axes = mobb::axes_from_name(place.string())) return *axes;
    place.fail(in_quotes(place.string()) + " names no axes; give one of " + listed(mobb::axes_names()));
}

}  // namespace

mobb::FitOptions read_fit(const JsonPlace& place, mobb::FitOptions fit) {
    place.allow_only({"tree", "leaf", "levels", "axes", "time_scale"});
    if (const auto tree = place.find("tree")) fit.tree = read_tree_kind(*tree);
    if (const auto leaf = place.find("leaf")) fit.leaf = leaf->integer(1, kMaxInt);
    if (const auto levels = place.find("levels")) fit.levels = levels->integer(0, kMaxInt);
    if (const auto axes = place.find("axes")) fit.axes = read_axes(*axes);
    if (const auto scale = place.find("time_scale")) {
        fit.time_scale = scale->number(1 / mobb::kMaxTimeScale, mobb::kMaxTimeScale);
    }
    return fit;
}

}  // namespace mobbscope
