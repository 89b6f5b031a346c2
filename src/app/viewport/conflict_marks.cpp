#include <app/session/session.h>
#include <app/ui/style.h>
#include <app/viewport/conflict_marks.h>
#include <scene/arrangement.h>
#include <scene/crowd_scene.h>

#include <cmath>
#include <string>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostMarks = 300;
constexpr float kSide = 5;       // half of a mark, pixels at scale 1
constexpr float kMarkReach = 7;  // of the mouse
constexpr double kAround = 0.5;  // seconds around the contact in which a moment shows it

/// Whether the picture is of a time at which it takes place.
bool is_now(const Workspace& workspace, const SceneConflict& conflict) {
    const ViewState& view = workspace.view();
    const bool is_moment = view.show != Show::space_time;
    if (!is_moment && !workspace.crowd()) return true;
    const double time =
        workspace.crowd() ? run_time(workspace.scene(), view) : view.time.value_or(time_span(workspace).t0);
    const double around = is_moment ? kAround : view.time_window;
    return std::abs(conflict.begin() - time) <= around;
}

}  // namespace

std::vector<ConflictMark> conflict_marks(const Ui& ui, const ShownPicture& picture) {
    const std::vector<SceneConflict>* found = ui.session.crowds.conflicts();
    const ViewState& view = ui.workspace.view();
    if (!found || view.query || is_in_grid(ui.workspace.scene(), view)) return {};
    std::vector<ConflictMark> out;
    for (std::size_t i = 0; i < found->size() && out.size() < kMostMarks; ++i) {
        const int index = static_cast<int>(i);
        if (!view.foreground.empty() && index != ui.workspace.conflict) continue;
        const SceneConflict& conflict = (*found)[i];
        const auto place = is_now(ui.workspace, conflict) ? place_of(ui.workspace.scene(), conflict) : std::nullopt;
        if (!place) continue;
        if (picture.list.slab && (place->z < view.slab->least || place->z > view.slab->most)) continue;
        const double height = picture.list.moment ? 0 : place->z;
        const auto at = picture.at(picture.list.space.point(place->x, place->y, height));
        if (at) out.push_back({index, *at});
    }
    return out;
}

const ConflictMark* mark_at(const Ui& ui, const std::vector<ConflictMark>& marks, ImVec2 mouse) {
    for (const ConflictMark& mark : marks) {
        if (std::hypot(mark.at.x - mouse.x, mark.at.y - mouse.y) <= ui.px(kMarkReach)) return &mark;
    }
    return nullptr;
}

void draw_conflict_marks(const Ui& ui, const std::vector<ConflictMark>& marks, int lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 ground = to_im(ui.style.palette.background);
    for (const ConflictMark& mark : marks) {
        const ImU32 color = mark.conflict == lit ? ui.style.text : to_im(ui.style.palette.hit);
        const float side = ui.px(kSide);
        const auto cross = [&](ImU32 ink, float width) {
            draw.AddLine({mark.at.x - side, mark.at.y - side}, {mark.at.x + side, mark.at.y + side}, ink, width);
            draw.AddLine({mark.at.x - side, mark.at.y + side}, {mark.at.x + side, mark.at.y - side}, ink, width);
        };
        cross(ground, ui.px(4.5f));
        cross(color, ui.px(2.2f));
        ui.marks.add("picture.conflict." + std::to_string(mark.conflict),
                     {{mark.at.x - side, mark.at.y - side}, {mark.at.x + side, mark.at.y + side}});
    }
}

}  // namespace mobbscope::app
