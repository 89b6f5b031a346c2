#include <app/session/playback.h>

#include <utility>

namespace mobbscope::app {

namespace {

/// Of one group with moving in time.
const EditName kPlaying{"playing", "look time"};

}  // namespace

void Playback::play() {
    playing_ = true;
    has_played_ = false;
    if (workspace_.view().time || workspace_.empty()) return;
    workspace_.change_view([&](ViewState& v) { v.time = time_span(workspace_).t0; }, kPlaying);
}

void Playback::advance(double seconds) {
    if (!playing_ || workspace_.empty()) return;
    const mobb::Interval span = time_span(workspace_);
    double time = workspace_.view().time.value_or(span.t0) + seconds * speed;
    if (time >= span.t1 || time < span.t0) time = span.t0;
    if (time == workspace_.view().time) return;
    if (!std::exchange(has_played_, true))
        return workspace_.change_view([&](ViewState& v) { v.time = time; }, kPlaying);
    // A drag meanwhile stays one state, and so does the play.
    workspace_.amend([&](Document& next) { next.view.time = time; });
}

}  // namespace mobbscope::app
