#include <crowd/followed.h>

#include <algorithm>

namespace mobbscope {

std::optional<int> last_chosen(const CrowdAgent& agent, double time) {
    // Plays are chosen in their order; the first was placed.
    const auto later = [](double t, const Play& play) { return t < play.chosen_at; };
    const auto after = std::upper_bound(agent.plays.begin() + 1, agent.plays.end(), time, later);
    const auto play = static_cast<int>(after - agent.plays.begin()) - 1;
    return play > 0 ? std::optional(play) : std::nullopt;
}

std::optional<FollowedChoice> last_choice(const MoveSet& moves, int agent, double time) {
    const CrowdRun& run = *moves.fitted().scene().crowd;
    const auto play = last_chosen(run.agents.at(static_cast<std::size_t>(agent)), time);
    if (!play) return std::nullopt;
    return FollowedChoice{agent, *play, choice_of(moves, run, agent, *play)};
}

}  // namespace mobbscope
