#include <app/document/job.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>

#include <cmath>

namespace mobbscope::app {

namespace {

constexpr double kProgressFrame = 1 / 15.0;  // seconds between frames while it moves
constexpr double kSweep = 1.6;               // seconds that the bar takes where nothing is known

}  // namespace

void job_progress(Ui& ui) {
    const Job* job = ui.session.job();
    if (!job) return;
    begin_dialog(ui, "job", {380, 130});
    ImGui::TextUnformatted(job->title().c_str());
    const double progress = job->progress();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ui.px(6);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + width, at.y + height}, ui.style.raised, height / 2);
    float from = 0;
    float to = static_cast<float>(progress);
    if (progress < 0) {
        from = static_cast<float>(0.75 * (0.5 - 0.5 * std::cos(ui.now / kSweep * 6.283)));
        to = from + 0.25f;
    }
    draw.AddRectFilled({at.x + from * width, at.y}, {at.x + to * width, at.y + height}, ui.style.accent, height / 2);
    ImGui::Dummy({width, height});
    ui.mark("job.bar");
    ImGui::Dummy({0, ui.px(2)});
    const bool cancelled = marked_button(ui, "Cancel", "job.cancel") || pressed(ImGuiKey_Escape);
    end_dialog();
    ui.want_frame_in(kProgressFrame);
    if (cancelled) ui.session.cancel_job();
}

}  // namespace mobbscope::app
