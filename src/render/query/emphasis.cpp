#include <render/parts/paths.h>
#include <render/query/emphasis.h>

#include <algorithm>

namespace mobbscope {

bool Emphasis::cuts() const {
    return std::any_of(at_cursor.begin(), at_cursor.end(), [](const auto& sample) { return sample.has_value(); });
}

Emphasis emphasis_of(const ViewState& view, std::span<const DrawnAgent> agents, double begin, double end,
                     const QueryProgress* progress) {
    Emphasis out;
    if (view.time && *view.time >= begin && *view.time <= end) {
        out.cursor = view.time;
        for (const DrawnAgent& agent : agents) out.at_cursor.push_back(sample_at(agent, *view.time));
    }
    if (!progress) return out;
    const mobb::Trace::Event& event = progress->event;
    if (event.outcome == mobb::Outcome::hit && !event.pairs.empty())
        out.hits = {event.pairs.back().i, event.pairs.back().j};
    for (const DrawnAgent& agent : agents) {
        const mobb::Node& node = agent.placed.node(agent.index == 0 ? event.a : event.b);
        out.dims = out.dims || (view.disks && node.count < agent.clip().count());
    }
    return out;
}

}  // namespace mobbscope
