#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <iterator>
#include <string>

namespace mobbscope {

namespace {

/// Plays of one person.
class PlaysOf {
  public:
    PlaysOf(const Scene& run, int run_agent)
        : run_(run), run_agent_(run_agent), agent_(run.crowd->agents[static_cast<std::size_t>(run_agent)]) {}

    double begin(std::size_t play) const { return agent_.plays[play].placement.start; }
    double end(std::size_t play) const { return begin(play) + clip(play).duration(); }
    std::size_t at(double time) const { return play_at(agent_, time); }

    Agent agent(std::size_t play, std::size_t present) const {
        Agent out;
        out.name = agent_.name;
        if (play < present) out.name += " -" + std::to_string(present - play);
        if (play > present) out.name += " +" + std::to_string(play - present);
        out.clip = clip_index(play);
        out.placement = agent_.plays[play].placement;
        out.run_agent = run_agent_;
        out.play = static_cast<int>(play);
        return out;
    }

    /// The others that are on between two times, by time.
    void add_around(std::vector<Agent>& out, double time, CrowdWindow window) const {
        const std::size_t present = at(time);
        std::size_t first = present;
        while (first > 0 && end(first - 1) > time - window.before) --first;
        for (std::size_t play = first;
             play < agent_.plays.size() && (play <= present || begin(play) < time + window.after); ++play) {
            if (play != present) out.push_back(agent(play, present));
        }
    }

  private:
    int clip_index(std::size_t play) const {
        return run_.graph->moves[static_cast<std::size_t>(agent_.plays[play].move)].clip;
    }
    const mobb::Clip& clip(std::size_t play) const {
        return *run_.clips[static_cast<std::size_t>(clip_index(play))].clip;
    }

    const Scene& run_;
    int run_agent_;
    const CrowdAgent& agent_;
};

}  // namespace

bool is_run(const Scene& scene) { return scene.crowd && scene.agents.empty(); }

double run_time(const Scene& run, const ViewState& view) { return view.time.value_or(0.5 * run.crowd->seconds); }

std::size_t play_at(const CrowdAgent& agent, double time) {
    const auto begins_later = [](double t, const Play& play) { return t < play.placement.start; };
    const auto after = std::upper_bound(agent.plays.begin(), agent.plays.end(), time, begins_later);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(std::distance(agent.plays.begin(), after) - 1, 0));
}

std::optional<int> run_agent_by_name(const CrowdRun& crowd, std::string_view name) {
    const auto is_it = [&](const CrowdAgent& agent) { return agent.name == name; };
    const auto at = std::find_if(crowd.agents.begin(), crowd.agents.end(), is_it);
    if (at == crowd.agents.end()) return std::nullopt;
    return static_cast<int>(at - crowd.agents.begin());
}

Scene scene_at(const Scene& run, double time, CrowdWindow window) {
    Scene out = run;
    const int people = static_cast<int>(run.crowd->agents.size());
    out.agents.reserve(static_cast<std::size_t>(people));
    for (int run_agent = 0; run_agent < people; ++run_agent) {
        const PlaysOf plays(run, run_agent);
        const std::size_t present = plays.at(time);
        out.agents.push_back(plays.agent(present, present));
    }
    if (window.before <= 0 && window.after <= 0) return out;
    for (int run_agent = 0; run_agent < people; ++run_agent)
        PlaysOf(run, run_agent).add_around(out.agents, time, window);
    return out;
}

FittedScene fitted_at(const FittedScene& run, const ViewState& view) {
    CrowdWindow window{view.time_window, view.time_window};
    if (view.show == Show::moment) {
        const bool with_ways = run.scene().crowd->agents.size() <= kMostWithWays;
        window = with_ways ? CrowdWindow{kWaySeconds, kWaySeconds} : CrowdWindow{};
    }
    return {scene_at(run.scene(), run_time(run.scene(), view), window), run.options(), &run};
}

}  // namespace mobbscope
