#include <app/session/edits.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <map>
#include <utility>

namespace mobbscope::app {

void Edits::refit(const EditName& name, const std::function<void(mobb::FitOptions&)>& change) {
    edit({name, [change](Scene& scene) { change(scene.fit); }});
}

void Edits::edit(const FitEdit& wanted, const FittedScene* fitted_beside) {
    Scene next = workspace_.changed_scene(wanted.change);
    if (quick_to_fit(next, *workspace_.document().fitted, fitted_beside)) {
        if (wanted.goes_on) workspace_.history.reopen_group();
        workspace_.change_document(with_scene(workspace_.document(), std::move(next), fitted_beside), wanted.name);
        if (wanted.then) wanted.then();
        return;
    }
    FitEdit later = wanted;
    later.goes_on = wanted.goes_on || workspace_.history.has_open_group();
    jobs_.start(
        "Fitting trees",
        [this, later = std::move(later), before = workspace_.document(),
         next = std::move(next)](JobControl& control) -> Job::Finish {
            const Document fitted = with_scene(before, next, nullptr, progress_of(control));
            // The document may have changed meanwhile: the edit is made on what it is now, with the trees made here.
            return [this, later, fitted] { edit(later, fitted.fitted.get()); };
        },
        wanted.purpose);
}

void Edits::rename_agent(int agent, const std::string& name) {
    std::string before;
    Document next = with_scene(workspace_.document(), workspace_.changed_scene([&](Scene& scene) {
        add_agents_for_clips(scene);
        before = scene.agents.at(static_cast<std::size_t>(agent)).name;
        mobbscope::rename_agent(scene, agent, name);
    }));
    for (SceneView& other : next.beside) rename_in_view(other.view, before, name);
    if (workspace_.isolation) {
        std::ranges::replace(workspace_.isolation->hidden, before, name);
        std::ranges::replace(workspace_.isolation->before, before, name);
    }
    if (workspace_.overview) std::ranges::replace(workspace_.overview->foreground, before, name);
    std::map<StepKey, QuerySteps> steps;
    for (const auto& [key, looked_at] : next.steps) {
        auto [a, b, same] = key.first;
        for (std::string* side : {&a, &b}) {
            if (*side == before) *side = name;
        }
        steps[{{a, b, same}, key.second}] = looked_at;
    }
    next.steps = std::move(steps);
    // Not change_document, which would remember a step under the name of before.
    workspace_.history.change(std::move(next), {"renaming " + before + " to " + name, ""});
    workspace_.changed();
}

void Edits::undo() {
    if (workspace_.history.can_undo()) go_to_state(workspace_.history.place() - 1);
}

void Edits::redo() {
    if (workspace_.history.can_redo()) go_to_state(workspace_.history.place() + 1);
}

void Edits::go_to_state(std::size_t state) {
    restore([state](History& history) { history.go_to(state); });
}

void Edits::previous_view() {
    if (workspace_.history.can_look_back()) restore(&History::look_back);
}

void Edits::next_view() {
    if (workspace_.history.can_look_forward()) restore(&History::look_forward);
}

void Edits::restore(const std::function<void(History&)>& turn) {
    const int before = workspace_.document().opening;
    playback_.stop();
    turn(workspace_.history);
    ++counts_.restores;
    // What is made for an excerpt is not put into the whole, nor the other way round.
    if (workspace_.document().opening != before) {
        while (jobs_.count() > 0) jobs_.cancel(0);
        workspace_.other_cameras.clear();
    }
    workspace_.changed();
}

}  // namespace mobbscope::app
