#include <base/text.h>
#include <scene/arrangement.h>
#include <scene/crowd_run.h>
#include <scene/view_options.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace mobbscope {

namespace {

constexpr double kGap = 0.25;      // between cells, of the larger side of what is in them
constexpr double kLeastGap = 0.5;  // metres

struct FloorRect {
    glm::dvec2 low{std::numeric_limits<double>::max()};
    glm::dvec2 high{std::numeric_limits<double>::lowest()};
};

FloorRect reach_of(const Scene& scene, const PlacedAgent& who) {
    FloorRect out;
    for (const PlacedAgent& member : members_of(scene, who)) {
        const mobb::PlacedClip clip(*path_of(scene, member), member.placement);
        for (int i = 0; i < clip.count(); ++i) {
            const mobb::Disk disk = clip.disk(i);
            out.low = glm::min(out.low, glm::dvec2(disk.x, disk.y) - disk.r);
            out.high = glm::max(out.high, glm::dvec2(disk.x, disk.y) + disk.r);
        }
    }
    return out;
}

}  // namespace

std::vector<GridCell> grid_of(const Scene& scene, std::span<const PlacedAgent> agents) {
    std::vector<FloorRect> reach;
    glm::dvec2 size(0);
    for (const PlacedAgent& who : agents) {
        reach.push_back(reach_of(scene, who));
        size = glm::max(size, reach.back().high - reach.back().low);
    }
    const glm::dvec2 step = size + std::max(kGap * std::max(size.x, size.y), kLeastGap);
    const std::size_t columns = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(agents.size()) * step.y / step.x))));
    std::vector<GridCell> out;
    for (std::size_t i = 0; i < agents.size(); ++i) {
        const std::size_t row = i / columns;
        const glm::dvec2 middle = step * glm::dvec2(static_cast<double>(i % columns), -static_cast<double>(row));
        const glm::dvec2 offset = middle - 0.5 * (reach[i].low + reach[i].high);
        out.push_back({offset, reach[i].low + offset, reach[i].high + offset, step});
    }
    return out;
}

bool is_in_grid(const Scene& scene, const ViewState& view) {
    const bool of_one_disk = view.projection && view.show == Show::space_time;
    return view.arrange == Arrange::grid && !view.query && !of_one_disk && !scene.crowd;
}

void lay_out_clips(Scene& scene) {
    if (scene.agents.empty() && scene.clips.size() > 1) scene.view.arrange = Arrange::grid;
}

std::vector<std::string> names_in_view(const Scene& scene) {
    std::vector<std::string> out;
    const auto add = [&](const auto& items) {
        for (const auto& item : items) out.push_back(item.name);
    };
    if (scene.crowd) {
        add(scene.crowd->agents);
    } else if (!scene.agents.empty()) {
        add(scene.agents);
    } else {
        add(scene.clips);
    }
    return out;
}

const std::string& name_in_view(const Scene& scene, const PlacedAgent& who) {
    const int run_agent = who.agent < 0 ? -1 : scene.agents[static_cast<std::size_t>(who.agent)].run_agent;
    return run_agent < 0 ? who.name : scene.crowd->agents[static_cast<std::size_t>(run_agent)].name;
}

bool names_agents(const ViewState& view) {
    return std::ranges::any_of(view_options(),
                               [&](const ViewOption& option) { return option.names && !(view.*option.names).empty(); });
}

void check_names(const Scene& scene, const ViewState& view) {
    if (!names_agents(view)) return;
    const std::vector<std::string> all = names_in_view(scene);
    const std::unordered_set<std::string_view> known(all.begin(), all.end());
    for (const ViewOption& option : view_options()) {
        if (!option.names) continue;
        for (const std::string& name : view.*option.names) {
            if (known.contains(name)) continue;
            throw ViewMismatch(std::string(option.key), "there is no agent " + in_quotes(name) + "; the nearest is " +
                                                            in_quotes(nearest(name, all)));
        }
    }
}

void drop_unknown_names(const Scene& scene, ViewState& view) {
    if (!names_agents(view)) return;
    const std::vector<std::string> all = names_in_view(scene);
    const std::unordered_set<std::string_view> known(all.begin(), all.end());
    for (const ViewOption& option : view_options()) {
        if (!option.names) continue;
        std::erase_if(view.*option.names, [&](const std::string& name) { return !known.contains(name); });
    }
}

}  // namespace mobbscope
