/// The last choice of an agent that somebody follows.
#pragma once

#include <crowd/choice.h>
#include <scene/crowd_run.h>

#include <optional>

namespace mobbscope {

/// A choice with whose it was.
struct FollowedChoice {
    int agent = 0;  ///< index into CrowdRun::agents
    int play = 0;   ///< the play that was chosen
    Choice choice;
};

/// Which of an agent's plays was chosen last at a time; none before its first choice.
std::optional<int> last_chosen(const CrowdAgent& agent, double time);

/// The choice of that play, made again. Throws what choice_of throws.
std::optional<FollowedChoice> last_choice(const MoveSet& moves, int agent, double time);

}  // namespace mobbscope
