#include <app/panels/panels.h>
#include <app/ui/widgets.h>

#include <imgui_internal.h>

#include <algorithm>
#include <optional>
#include <string>

namespace mobbscope::app {

namespace {

constexpr double kInfoSeconds = 4;
constexpr float kWidest = 560;  // pixels at scale 1

/// Where the lower left corner is, and how wide they are.
struct MessagePlace {
    ImVec2 corner;
    float width;
};

MessagePlace place_of(const Ui& ui) {
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float gap = ui.px(12);
    // Below what a dialog says and asks.
    if (ui.session.dialog != Dialog::none) {
        const float width = std::min(room.x - 2 * gap, ui.px(kWidest));
        return {{(room.x - width) / 2, room.y - gap}, width};
    }
    const auto& marks = ui.marks.all();
    const auto left = marks.find("splitter.left");
    const auto right = marks.find("splitter.right");
    const auto bottom = marks.find("splitter.bottom");
    const float x0 = left == marks.end() ? 0 : left->second.max.x;
    const float x1 = right == marks.end() ? room.x : right->second.min.x;
    const float y = bottom == marks.end() ? room.y : bottom->second.min.y;
    return {{x0 + gap, y - gap}, std::min(x1 - x0 - 2 * gap, ui.px(kWidest))};
}

/// Draws one; true if it is to go.
bool draw(Ui& ui, const Message& message, std::size_t index) {
    const bool stays = message.level != Message::Level::info;
    const ImU32 color = message.level == Message::Level::error     ? ui.style.error
                        : message.level == Message::Level::warning ? ui.style.warning
                                                                   : ui.style.accent;
    const std::string mark = "message." + std::to_string(index);
    const ImGuiStyle& style = ImGui::GetStyle();
    const float words = ImGui::CalcTextSize("Copy").x + ImGui::CalcTextSize("x").x;
    const float buttons = stays ? words + 4 * style.FramePadding.x + style.ItemSpacing.x + ui.px(8) : 0;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(static_cast<int>(index));
    ImGui::BeginGroup();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(10));
    ImGui::PushTextWrapPos(ImGui::GetWindowContentRegionMax().x - buttons);
    ImGui::TextUnformatted(message.text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    ui.mark(mark);
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + ui.px(3), ImGui::GetItemRectMax().y}, color);
    bool gone = false;
    if (stays) {
        ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - buttons + ui.px(8));
        const bool copies = small_button(ui, "Copy", mark + ".copy");
        if (copies && ui.session.hooks.set_clipboard) ui.session.hooks.set_clipboard(message.text);
        ImGui::SameLine();
        gone = small_button(ui, "x", mark + ".dismiss");
    }
    ImGui::PopID();
    return gone;
}

/// Info goes by itself.
void forget_old(Ui& ui) {
    Session& session = ui.session;
    for (std::size_t i = session.messages().size(); i-- > 0;) {
        const Message& message = session.messages()[i];
        if (!message.shown_at) session.note_shown(i, ui.now);
        if (message.level != Message::Level::info) continue;
        const double left = *message.shown_at + kInfoSeconds - ui.now;
        if (left <= 0) {
            session.dismiss(i);
        } else {
            ui.want_frame_in(left);
        }
    }
}

}  // namespace

void messages(Ui& ui) {
    forget_old(ui);
    Session& session = ui.session;
    if (session.messages().empty()) return;
    const MessagePlace place = place_of(ui);
    ImGui::SetNextWindowPos(place.corner, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowSizeConstraints({place.width, 0}, {place.width, ImGui::GetIO().DisplaySize.y / 2});
    ImGui::Begin("##messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
    // Over dialogs too: what went wrong in one is read there.
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    std::optional<std::size_t> gone;
    for (std::size_t i = 0; i < session.messages().size(); ++i) {
        if (draw(ui, session.messages()[i], i)) gone = i;
    }
    ImGui::End();
    if (gone) session.dismiss(*gone);
}

}  // namespace mobbscope::app
