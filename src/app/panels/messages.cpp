#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/text.h>

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <optional>
#include <string>

namespace mobbscope::app {

namespace {

constexpr float kWidest = 640;         // pixels at scale 1
constexpr float kNarrowest = 320;      // ... if the picture is that wide
constexpr std::size_t kMostUp = 3;     // over the picture; the others are behind the bell
constexpr std::size_t kMostLines = 4;  // of one over the picture; the mouse and the list tell all
constexpr float kLeastText = 200;      // pixels at scale 1, beside the buttons; else they stand below
constexpr float kLeastHeight = 110;    // pixels at scale 1 that one over the picture is given
constexpr float kListWidth = 640;      // pixels at scale 1
constexpr float kListHeight = 420;     // pixels at scale 1
constexpr float kBarWidth = 3;         // pixels at scale 1: of the coloured edge that says how bad it is

ImU32 color_of(const Ui& ui, MessageLevel level) {
    return level == MessageLevel::error     ? ui.style.error
           : level == MessageLevel::warning ? ui.style.warning
                                            : ui.style.accent;
}

/// "12 s ago"; empty for one that was not shown.
std::string age_text(const Message& message, double now) {
    if (!message.shown_at) return "";
    const double seconds = std::max(now - *message.shown_at, 0.0);
    if (seconds < 1) return "now";
    if (seconds < 60) return formatted("%.0f s ago", std::floor(seconds));
    if (seconds < 3600) return formatted("%.0f min ago", std::floor(seconds / 60));
    return formatted("%.0f h ago", std::floor(seconds / 3600));
}

/// Where their lower right corner is, and how large they may be together.
struct MessagePlace {
    ImVec2 corner;
    float width, height;
};

MessagePlace place_of(const Ui& ui, Dialogs& dialogs) {
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const float gap = ui.px(12);
    // Below what a dialog says and asks.
    if (dialogs.now != Dialog::none) {
        const float width = std::min(room.x - 2 * gap, ui.px(kWidest));
        return {{(room.x + width) / 2, room.y - gap}, width, room.y / 2};
    }
    // In the lower right corner of the picture they cover none of its captions, and nothing beside it.
    const auto& marks = ui.marks.all();
    const auto edge = [&](const char* mark, float otherwise, const auto& of) {
        const auto at = marks.find(mark);
        return at == marks.end() ? otherwise : of(at->second);
    };
    const auto min_x = [](const Rect& rect) { return rect.min.x; };
    const auto min_y = [](const Rect& rect) { return rect.min.y; };
    const auto max_x = [](const Rect& rect) { return rect.max.x; };
    const float right = edge("splitter.right", edge("fold.right", room.x, min_x), min_x);
    const float bottom = edge("splitter.bottom", room.y - status_height(ui), min_y);
    const float left = edge("splitter.left", edge("fold.left", 0, max_x), max_x);
    // Beside the legend, or where that leaves too little above it.
    const float beside_legend = right - std::max(edge("overlay.legend", left, max_x), left) - 2 * gap;
    const float foot = beside_legend < ui.px(kNarrowest) ? edge("overlay.legend", bottom, min_y) : bottom;
    const float free = std::min(std::max(beside_legend, ui.px(kNarrowest)), right - left - 2 * gap);
    const float top = edge("viewport", ImGui::GetFrameHeight(), min_y);
    const float low = std::min(bottom, foot) - gap;
    return {{right - gap, low}, std::min(free, ui.px(kWidest)), low - top - gap};
}

/// What a person wants of a message.
enum class Wish { nothing, dismiss };

/// Offer, Copy and x, from the right end of a line; `wide`: what they need of it.
float buttons_width(const Ui& ui, const Message& message) {
    const float padding = 2 * ImGui::GetStyle().FramePadding.x;
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    float width = ImGui::CalcTextSize("Copy").x + ImGui::CalcTextSize("x").x + 2 * padding + gap + ui.px(8);
    for (const MessageOffer& offer : message.offers)
        width += ImGui::CalcTextSize(offer.label.c_str()).x + padding + gap;
    return width;
}

Wish buttons(Ui& ui, const Message& message, const std::string& mark) {
    for (std::size_t i = 0; i < message.offers.size(); ++i) {
        const MessageOffer& offered = message.offers[i];
        const std::string offer_mark = mark + (i == 0 ? ".offer" : ".offer" + std::to_string(i + 1));
        if (small_button(ui, offered.label.c_str(), offer_mark)) {
            ui.later([offer = offered](Session& session) {
                if (session.dialogs.now == Dialog::messages) session.dialogs.close();
                session.notifications.put_away();
                run_command(session, offer.command, offer.argument);
            });
        }
        ImGui::SameLine();
    }
    if (small_button(ui, "Copy", mark + ".copy", "Copy the text")) {
        ui.session.desktop->set_clipboard(message.text);
    }
    ImGui::SameLine();
    return small_button(ui, "x", mark + ".dismiss", "Remove it from the list") ? Wish::dismiss : Wish::nothing;
}

/// The first of several lines, and an ellipsis for the others.
std::string first_lines(const std::string& lines, float room) {
    std::size_t end = 0;
    for (std::size_t i = 0; i < kMostLines; ++i) {
        const std::size_t begin = i == 0 ? 0 : end + 1;
        end = lines.find('\n', begin);
        if (end == std::string::npos) return lines;
        if (i + 1 < kMostLines) continue;
        const std::string last = lines.substr(begin, end - begin);
        return lines.substr(0, begin) + fitted_text(last + " \u2026", room);
    }
    return lines;
}

/// Draws one; `right` stands at the end of its first line, before the buttons. `in_short`: what is long of it is told
/// under the mouse.
Wish draw_message(Ui& ui, const Message& message, const std::string& mark, const std::string& right, bool in_short) {
    const float side = buttons_width(ui, message);
    const float end = ImGui::GetWindowContentRegionMax().x;
    const float age = right.empty() ? 0 : text_size(*ui.style.caption, right).x + ui.px(12);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(mark.c_str());
    ImGui::BeginGroup();
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ui.px(10));
    const float whole = end - ImGui::GetCursorPosX();
    const float needed = std::min(ui.px(kLeastText), ImGui::CalcTextSize(message.text.c_str()).x);
    const bool beside = whole - side - age >= needed;
    const float room = beside ? whole - side - age : whole;
    const std::string text = in_short ? with_short_paths(message.text, room) : message.text;
    const std::string lines = wrapped(text, room);
    const std::string shown = in_short ? first_lines(lines, room) : lines;
    ImGui::TextUnformatted(shown.c_str());
    ImGui::EndGroup();
    ui.mark(mark);
    const bool is_all = shown == lines && text == with_short_paths(message.text, FLT_MAX);
    if (!is_all && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", wrapped(message.text, ui.px(kWidest)).c_str());
    }
    const float bottom = ImGui::GetItemRectMax().y;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, {at.x + ui.px(kBarWidth), bottom}, color_of(ui, message.level));
    if (beside) ImGui::SameLine();
    if (!right.empty()) {
        ImGui::SetCursorPosX(end - side - age);
        text_line(ui.style.quiet, right, ui.style.caption);
        ImGui::SameLine();
    }
    ImGui::SetCursorPosX(end - side + ui.px(8));
    const Wish wish = buttons(ui, message, mark);
    ImGui::PopID();
    return wish;
}

/// What one needs on a single line.
float width_of(const Ui& ui, const Message& message) {
    const float padding = 2 * ImGui::GetStyle().WindowPadding.x;
    return ImGui::CalcTextSize(message.text.c_str()).x + buttons_width(ui, message) + ui.px(16) + padding;
}

/// A bell of this height, in lines.
void draw_bell(ImDrawList& draw, ImVec2 middle, float height, ImU32 color) {
    const float h = height / 2;
    const auto at = [&](float x, float y) { return ImVec2{middle.x + x * h, middle.y + y * h}; };
    draw.PathLineTo(at(-0.95f, 0.6f));
    draw.PathLineTo(at(-0.62f, 0.25f));
    draw.PathLineTo(at(-0.62f, -0.2f));
    draw.PathArcTo(at(0, -0.2f), 0.62f * h, 3.1416f, 6.2832f, 10);
    draw.PathLineTo(at(0.62f, 0.25f));
    draw.PathLineTo(at(0.95f, 0.6f));
    draw.PathStroke(color, ImDrawFlags_Closed, std::max(1.0f, height / 11));
    draw.AddCircleFilled(at(0, 0.84f), 0.22f * h, color);
}

/// "2 warnings, 1 error", "5 messages".
std::string count_words(const Notifications& notifications, const std::vector<std::size_t>& which) {
    std::size_t errors = 0;
    std::size_t warnings = 0;
    for (const std::size_t i : which) {
        const MessageLevel level = notifications.all()[i].level;
        errors += level == MessageLevel::error ? 1 : 0;
        warnings += level == MessageLevel::warning ? 1 : 0;
    }
    if (warnings == which.size()) return counted(warnings, "warning", "warnings");
    if (errors == which.size()) return counted(errors, "error", "errors");
    std::string out = counted(which.size(), "message", "messages");
    if (errors > 0) out += ", " + counted(errors, "error", "errors");
    if (warnings > 0) out += ", " + counted(warnings, "warning", "warnings");
    return out;
}

}  // namespace

void messages(Ui& ui, Notifications& notifications, Dialogs& dialogs) {
    std::vector<std::size_t> up;
    for (std::size_t i = notifications.all().size(); i-- > 0;) {
        if (notifications.all()[i].up) up.push_back(i);
    }
    if (up.empty()) return;
    MessagePlace place = place_of(ui, dialogs);
    const auto room = static_cast<std::size_t>(std::max(1.0f, place.height / ui.px(kLeastHeight)));
    const std::size_t shown = std::min({up.size(), kMostUp, room});
    float needed = 0;
    for (std::size_t i = 0; i < shown; ++i) needed = std::max(needed, width_of(ui, notifications.all()[up[i]]));
    place.width = std::min(place.width, needed);
    ImGui::SetNextWindowPos(place.corner, ImGuiCond_Always, {1, 1});
    ImGui::SetNextWindowSizeConstraints({place.width, 0}, {place.width, std::max(1.0f, place.height)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(4));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.style.panel);
    ImGui::Begin("##messages", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    // Over dialogs too: what went wrong in one is read there. Not over an open menu.
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    std::optional<std::size_t> gone;
    // The latest at the bottom, where the eye goes first.
    for (std::size_t i = shown; i-- > 0;) {
        const Message& message = notifications.all()[up[i]];
        if (draw_message(ui, message, "message." + std::to_string(up[i]), "", true) == Wish::dismiss) gone = up[i];
    }
    if (up.size() > 1) {
        text_line(ui.style.quiet, count_words(notifications, up), ui.style.caption);
        ImGui::SameLine();
        if (small_button(ui, "read all", "message.all", "Opens the list of all messages  (F8)")) {
            ui.invoke("help.messages");
        }
    }
    const bool held = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    ImGui::End();
    ui.want_frame_in(notifications.age(ui.now, held));
    if (gone) ui.later([&notifications, index = *gone] { notifications.dismiss(index); });
}

float message_bell(Ui& ui, Notifications& notifications) {
    const std::size_t unread = notifications.unread();
    const std::string count = unread > 0 ? std::to_string(unread) : "";
    const float pad = ui.px(10);
    const float height = ImGui::GetFrameHeight();
    const float bell = ui.px(13);
    const float number = count.empty() ? 0 : text_size(*ui.style.mono, count).x + ui.px(4);
    const float width = bell + number + pad;
    const float x = ImGui::GetWindowWidth() - width - ui.px(4);
    ImGui::SetCursorPos({x, 0});
    if (ImGui::InvisibleButton("##bell", {width, height})) ui.invoke("help.messages");
    ui.mark("menu.bell");
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) {
        const std::string key(first_shortcut(*find_command("help.messages")));
        const std::string text = unread > 0                    ? counted(unread, "unread message", "unread messages")
                                 : notifications.all().empty() ? std::string("No messages")
                                                               : std::string("Messages");
        ImGui::SetTooltip("%s (%s)", text.c_str(), key.c_str());
    }
    const bool error = std::ranges::any_of(notifications.all(), [](const Message& message) {
        return !message.read && message.level == MessageLevel::error;
    });
    const ImU32 color = unread > 0 ? (error ? ui.style.error : ui.style.warning)
                        : hovered  ? ui.style.text
                                   : ui.style.quiet;
    const ImVec2 at = ImGui::GetItemRectMin();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_bell(draw, {at.x + pad / 2 + bell / 2, at.y + height / 2 - ui.px(0.5f)}, bell, color);
    if (!count.empty()) {
        draw_text(draw, *ui.style.mono,
                  {at.x + pad / 2 + bell + ui.px(4), at.y + (height - ui.style.mono->FontSize) / 2}, color, count);
    }
    return x;
}

void message_list(Ui& ui, Dialogs& dialogs, Notifications& notifications) {
    DialogInput& input = dialogs.input;
    begin_dialog(ui, "message list", {kListWidth, kListHeight});
    dialog_title(ui, "Messages");
    const float foot = ImGui::GetFrameHeightWithSpacing() + ui.px(4);
    ImGui::BeginChild("list", {0, -foot}, false);
    ImGui::Dummy({0, ui.px(2)});
    const std::vector<Message>& all = notifications.all();
    const int count = static_cast<int>(all.size());
    if (all.empty()) ImGui::TextDisabled("No messages yet.");
    const bool moved = move_picked(input.picked, count);
    std::optional<std::size_t> gone;
    // The latest first.
    for (int i = 0; i < count; ++i) {
        const std::size_t index = all.size() - 1 - static_cast<std::size_t>(i);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const bool picked = i == input.picked;
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        draw.ChannelsSplit(2);
        draw.ChannelsSetCurrent(1);
        const Wish wish =
            draw_message(ui, all[index], "messages." + std::to_string(i), age_text(all[index], ui.now), false);
        if (wish == Wish::dismiss) gone = index;
        const ImVec2 to{at.x + ImGui::GetContentRegionAvail().x, ImGui::GetCursorScreenPos().y - ui.px(3)};
        draw.ChannelsSetCurrent(0);
        if (picked) draw.AddRectFilled({at.x, at.y - ui.px(3)}, to, ui.style.raised, ui.px(2));
        draw.ChannelsMerge();
        ImGui::Dummy({0, ui.px(2)});
        if (picked && moved) ImGui::SetScrollHereY();
    }
    ImGui::EndChild();
    const auto index = all.size() - 1 - static_cast<std::size_t>(input.picked);
    const Message* picked = all.empty() ? nullptr : &all[index];
    if (picked && pressed(ImGuiKey_Delete)) gone = index;
    if (picked && ImGui::GetIO().KeyCtrl && pressed(ImGuiKey_C)) {
        ui.session.desktop->set_clipboard(picked->text);
    }
    if (marked_button(ui, "Close", "messages.close", true) || pressed(ImGuiKey_Enter)) {
        ui.later(&Dialogs::close);
    }
    if (!all.empty()) {
        ImGui::SameLine();
        if (marked_button(ui, "Clear", "messages.clear")) ui.invoke("help.clear_messages");
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextDisabled("Up and Down choose, Ctrl+C copies, Delete removes it");
    }
    end_dialog();
    if (gone) ui.later([&notifications, which = *gone] { notifications.dismiss(which); });
    ui.want_frame_in(1);  // the ages go on
}

}  // namespace mobbscope::app
