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

/// Of a run.
const MoveSet& moves_of(const Workspace& workspace) {
    std::unique_ptr<MoveSet>& kept = workspace.derived().moves;
    if (!kept) kept = std::make_unique<MoveSet>(*workspace.document().fitted);
    return *kept;
}

}  // namespace

const FollowedChoice* CrowdInspector::choice() const {
    if (!workspace_.crowd() || workspace_.view().follow.empty()) return nullptr;
    const auto run_agent = run_agent_by_name(*workspace_.crowd(), workspace_.view().follow);
    if (!run_agent) return nullptr;
    const double time = run_time(workspace_.scene(), workspace_.view());
    const std::pair made{
        *run_agent, last_chosen(workspace_.crowd()->agents[static_cast<std::size_t>(*run_agent)], time).value_or(-1)};
    Workspace::Derived& d = workspace_.derived();
    const MoveSet& moves = moves_of(workspace_);
    if (d.chosen != made) {
        d.choice = last_choice(moves, *run_agent, time);
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
        std::vector<SceneConflict> found = conflicts_in(in->scene(), progress_of(control));
        double end = 0;
        for (const SceneConflict& conflict : found) end = std::max(end, conflict.facts.intervals.back().t1);
        return [this, in, end, found = std::move(found)]() mutable {
            if (&in->scene() != &workspace_.scene()) {
                return notifications_.tell(MessageLevel::info, "The scene has changed: look for conflicts again");
            }
            workspace_.found = Workspace::FoundConflicts{in, std::move(found), end};
            workspace_.conflict = -1;
        };
    });
}

void CrowdInspector::check_run(const std::function<void(const MoveSet&, const RunCheck&)>& then) {
    jobs_.start("Checking the run",
                [this, then, in = workspace_.document().fitted](JobControl& control) -> Job::Finish {
                    const auto moves = std::make_shared<const MoveSet>(*in);
                    RunCheck found = mobbscope::check_run(*moves, progress_of(control));
                    return [this, then, in, moves, found = std::move(found)] {
                        if (&in->scene() == &workspace_.scene()) return then(*moves, found);
                        notifications_.tell(MessageLevel::info, "The scene has changed: check the run again");
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
        at->second =
            words(workspace_.scene(), choice_of(moves_of(workspace_), *workspace_.crowd(), play.agent, play.play));
    }
    return at->second;
}

namespace {

/// Whether `a` made the conflict of a run, or else `b`: of the two plays the first that the simulator would not have
/// chosen; where both come out, made_by_a.
bool at_fault_is_a(const Workspace& workspace, const SceneConflict& conflict) {
    const CrowdRun& run = *workspace.crowd();
    const MoveSet& moves = moves_of(workspace);
    const auto play_of = [&](int agent, int play) -> const Play& {
        return run.agents[static_cast<std::size_t>(agent)].plays[static_cast<std::size_t>(play)];
    };
    const auto comes_out = [&](int agent, int play) {
        return comes_out_as(play_of(agent, play), choice_of(moves, run, agent, play));
    };
    const int a = conflict.a.agent, b = conflict.b.agent;
    const bool a_comes_out = comes_out(a, conflict.a_play), b_comes_out = comes_out(b, conflict.b_play);
    if (a_comes_out != b_comes_out) return !a_comes_out;
    if (a_comes_out) return made_by_a(run, conflict);
    return std::pair(play_of(a, conflict.a_play).chosen_at, a) < std::pair(play_of(b, conflict.b_play).chosen_at, b);
}

}  // namespace

double time_before(const Workspace& workspace, const SceneConflict& conflict) {
    return std::max(conflict.begin() - kBefore, time_span(workspace).t0);
}

ConflictPlace conflict_place(const Workspace& workspace, const SceneConflict& conflict) {
    const double before = time_before(workspace, conflict);
    if (!workspace.crowd()) return {conflict.a, conflict.b, before};
    const bool by_a = at_fault_is_a(workspace, conflict);
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
