#include <app/document/agents.h>
#include <app/session/crowd_inspector.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr double kBefore = 0.5;  // seconds before a conflict

}  // namespace

const FollowedChoice* CrowdInspector::choice() const {
    if (!workspace_.crowd() || workspace_.view().follow.empty()) return nullptr;
    const auto run_agent = run_agent_by_name(*workspace_.crowd(), workspace_.view().follow);
    if (!run_agent) return nullptr;
    const double time = run_time(workspace_.scene(), workspace_.view());
    const std::pair made{
        *run_agent, last_chosen(workspace_.crowd()->agents[static_cast<std::size_t>(*run_agent)], time).value_or(-1)};
    Workspace::Derived& d = workspace_.derived();
    if (!d.moves) d.moves = std::make_unique<MoveSet>(*workspace_.document().fitted);
    if (d.chosen != made) {
        d.choice = last_choice(*d.moves, *run_agent, time);
        d.chosen = made;
    }
    return d.choice ? &*d.choice : nullptr;
}

int CrowdInspector::candidate() const {
    const Workspace::PointedOut& out = workspace_.pointed_out;
    const FollowedChoice* now = out.candidate >= 0 ? choice() : nullptr;
    return now && now->agent == out.agent && now->play == out.play ? out.candidate : -1;
}

void CrowdInspector::point_out(int candidate) {
    const FollowedChoice* now = choice();
    workspace_.pointed_out = {};
    if (now && candidate >= 0) workspace_.pointed_out = {now->agent, now->play, candidate};
}

const std::vector<SceneConflict>* CrowdInspector::conflicts() const {
    const std::optional<Workspace::FoundConflicts>& found = workspace_.found;
    return found && &found->in->scene() == &workspace_.scene() ? &found->conflicts : nullptr;
}

void CrowdInspector::find_conflicts() {
    jobs_.start("Looking for conflicts", [this, in = workspace_.document().fitted](JobControl& control) -> Job::Finish {
        std::vector<SceneConflict> found = conflicts_in(*in, progress_of(control));
        return [this, in, found = std::move(found)]() mutable {
            if (&in->scene() != &workspace_.scene()) {
                return notifications_.tell(MessageLevel::info, "The scene has changed: look for conflicts again");
            }
            workspace_.found = Workspace::FoundConflicts{in, std::move(found)};
            workspace_.conflict = -1;
        };
    });
}

std::string CrowdInspector::conflict_summary() const {
    double seconds = 0;
    for (const SceneConflict& conflict : *conflicts()) seconds += conflict.facts.seconds();
    return conflict_count(conflicts()->size(), people_in(workspace_), seconds);
}

const std::vector<SpecialPlay>& CrowdInspector::special_plays() const {
    const bool is_new = listed_.of != workspace_.document().fitted;
    if (!is_new && listed_.by == play_order.by && listed_.descending == play_order.descending) return listed_.plays;
    if (is_new) {
        listed_.plays.clear();
        listed_.reasons.clear();
        const CrowdRun& run = *workspace_.crowd();
        for (int agent = 0; agent < static_cast<int>(run.agents.size()); ++agent) {
            const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
            for (int i = 0; i < static_cast<int>(plays.size()); ++i) {
                const Play& play = plays[static_cast<std::size_t>(i)];
                if (play.kind != PlayKind::chosen) listed_.plays.push_back({agent, i, play.placement.start, play.kind});
            }
        }
    }
    listed_.of = workspace_.document().fitted;
    listed_.by = play_order.by;
    listed_.descending = play_order.descending;
    const auto before = [&](const SpecialPlay& a, const SpecialPlay& b) {
        const auto by_time = [](const SpecialPlay& of) { return std::tuple(of.time, of.agent, of.play); };
        switch (listed_.by) {
            case SpecialPlayList::Column::time:
                break;
            case SpecialPlayList::Column::agent:
                return std::tuple(a.agent, a.play) < std::tuple(b.agent, b.play);
            case SpecialPlayList::Column::kind:
                // Forced plays matter more.
                if (a.kind != b.kind) return a.kind > b.kind;
        }
        return by_time(a) < by_time(b);
    };
    std::ranges::sort(listed_.plays,
                      [&](const auto& a, const auto& b) { return listed_.descending ? before(b, a) : before(a, b); });
    return listed_.plays;
}

const std::string& CrowdInspector::why(const SpecialPlay& play, const WordsOfChoice& words) const {
    const auto [at, is_new] = listed_.reasons.try_emplace({play.agent, play.play});
    if (is_new) {
        Workspace::Derived& d = workspace_.derived();
        if (!d.moves) d.moves = std::make_unique<MoveSet>(*workspace_.document().fitted);
        at->second = words(workspace_.scene(), choice_of(*d.moves, *workspace_.crowd(), play.agent, play.play));
    }
    return at->second;
}

double time_before(const Workspace& workspace, const SceneConflict& conflict) {
    return std::max(conflict.begin() - kBefore, time_span(workspace).t0);
}

ConflictPlace conflict_place(const Workspace& workspace, const SceneConflict& conflict) {
    const double before = time_before(workspace, conflict);
    if (!workspace.crowd()) return {conflict.a, conflict.b, before};
    const bool by_a = made_by_a(*workspace.crowd(), conflict);
    ConflictPlace out{by_a ? conflict.a : conflict.b, by_a ? conflict.b : conflict.a, before};
    const int play = by_a ? conflict.a_play : conflict.b_play;
    const CrowdAgent& agent = workspace.crowd()->agents[static_cast<std::size_t>(out.followed.agent)];
    // A first play was placed, not chosen.
    if (play > 0 && last_chosen(agent, before) != play) {
        out.time = agent.plays[static_cast<std::size_t>(play)].chosen_at;
    }
    return out;
}

}  // namespace mobbscope::app
