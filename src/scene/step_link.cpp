#include <base/error.h>
#include <base/text.h>
#include <scene/answer.h>
#include <scene/fitted_scene.h>
#include <scene/step_link.h>

#include <string_view>
#include <system_error>

namespace mobbscope {

namespace {

constexpr std::string_view kLinkSign = "#q";

/// A whole number from 0; none for any other text.
std::optional<int> counted_from_0(std::string_view text) {
    const std::optional<int> number = parse_int(text);
    return number && *number >= 0 ? number : std::nullopt;
}

/// Where "#q" stands in the last part of a name; npos: nowhere.
std::size_t link_begin(const std::string& name) {
    const std::size_t begin = name.rfind(kLinkSign);
    return begin == std::string::npos || name.find('/', begin) != std::string::npos ? std::string::npos : begin;
}

/// None: it is not written so.
std::optional<StepLink> link_behind(const std::string& name) {
    const std::size_t begin = link_begin(name);
    if (begin == std::string::npos) return std::nullopt;
    const std::string_view numbers = std::string_view(name).substr(begin + kLinkSign.size());
    const std::size_t at = numbers.find('@');
    if (at == std::string_view::npos) return std::nullopt;
    const std::optional<int> query = counted_from_0(numbers.substr(0, at));
    const std::optional<int> step = counted_from_0(numbers.substr(at + 1));
    return query && step ? std::optional(StepLink{*query, *step}) : std::nullopt;
}

[[noreturn]] void refuse_link(const Scene& scene, const StepLink& link, const std::string& why) {
    throw InputError(scene.file.string() + to_string(link), why);
}

}  // namespace

std::string to_string(const StepLink& link) {
    return std::string(kLinkSign) + std::to_string(link.query) + '@' + std::to_string(link.step);
}

bool quotes_step(const std::filesystem::path& name) {
    std::error_code ignored;
    const std::size_t begin = link_begin(name.native());
    return begin != std::string::npos && !std::filesystem::exists(name, ignored) &&
           std::filesystem::is_regular_file(name.native().substr(0, begin), ignored);
}

LinkedFile linked_file(const std::filesystem::path& name) {
    if (!quotes_step(name)) return {name};
    const std::optional<StepLink> link = link_behind(name.native());
    if (!link)
        throw InputError(name, "a step is quoted by its query's number and its own, from 0: write it like #q3@412");
    return {without_link(name), link};
}

std::filesystem::path without_link(const std::filesystem::path& name) {
    const std::string& text = name.native();
    return link_behind(text) ? std::filesystem::path(text.substr(0, link_begin(text))) : name;
}

void show_step(Scene& scene, const StepLink& link) {
    const std::size_t count = query_count(scene);
    if (static_cast<std::size_t>(link.query) >= count) {
        refuse_link(scene, link,
                    count == 0 ? "there are no queries, so no steps"
                               : "there is no query " + std::to_string(link.query) + ": they go from 0 to " +
                                     std::to_string(count - 1));
    }
    scene.view.query = link.query;
    scene.view.step = {Step::Unit::event, static_cast<double>(link.step)};
}

void check_step(const Scene& scene, const StepLink& link) {
    SceneQuery asked = query_at(scene, static_cast<std::size_t>(link.query));
    // Of these two alone: a crowd takes long to fit.
    Scene two;
    two.file = scene.file;
    two.fit = scene.fit;
    for (PlacedAgent* side : {&asked.a, &asked.b}) {
        two.clips.push_back(scene.clips[static_cast<std::size_t>(side->clip)]);
        side->clip = static_cast<int>(two.clips.size()) - 1;
        side->agent = -1;
    }
    two.queries = {asked};
    const FittedScene fitted(two, two.fit);
    const int steps = record(fitted, fitted.queries()[0]).trace.size();
    if (link.step < steps) return;
    refuse_link(
        scene, link,
        "there is no step " + std::to_string(link.step) + ": the query's go from 0 to " + std::to_string(steps - 1));
}

}  // namespace mobbscope
