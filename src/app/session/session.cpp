#include <app/session/session.h>

#include <algorithm>
#include <exception>

namespace mobbscope::app {

namespace {

Desktop no_desktop;
PictureMaker no_picture_maker;

}  // namespace

bool CommandQueue::run() {
    const bool had_any = !queue_.empty();
    while (!queue_.empty()) {
        const std::function<void()> next = std::move(queue_.front());
        queue_.pop_front();
        try {
            next();
        } catch (const std::exception& error) {
            notifications_.tell(MessageLevel::error, error.what());
        }
    }
    return had_any;
}

Session::Session(bool attended, Settings settings_)
    : options{.attended = attended},
      settings(std::move(settings_)),
      desktop(&no_desktop),
      picture_maker(&no_picture_maker) {
    jobs.after_each = [this] { imports.next(); };
}

double Session::ui_scale() const {
    return std::clamp(settings.ui_scale > 0 ? settings.ui_scale : window_scale, kLeastUiScale, kMostUiScale);
}

void Session::poll() {
    for (const auto& each : screens) each->poll();
    jobs.poll();
    sweeps.update();
    notices.poll();
    imports.ask_for_offer();
}

void Session::end_work() {
    files.end_work();
    recovery.end_work();
    dialogs.preview.end();
    maps.end_work();
    sweeps.cancel();
    answers.end_work();
    fit_costs.end_work();
    notices.end_work();
    for (const auto& each : screens) each->end_work();
}

Session::BeforeDrag Session::before_drag() const {
    return {workspace.history,
            settings,
            counts.arrivals,
            workspace.picture_size,
            workspace.framings,
            workspace.other_cameras,
            screen ? screen->look() : std::any()};
}

void Session::restore(BeforeDrag before) {
    if (before.look.has_value() && screen) screen->restore(before.look);
    if (before.arrivals != counts.arrivals) return;
    workspace.history = std::move(before.history);
    settings = std::move(before.settings);
    // A border between panels may be what was dragged: cameras stand for the pictures of before.
    workspace.picture_size = before.picture_size;
    workspace.framings = std::move(before.framings);
    workspace.other_cameras = std::move(before.other_cameras);
    ++counts.restores;
    workspace.changed();
}

}  // namespace mobbscope::app
