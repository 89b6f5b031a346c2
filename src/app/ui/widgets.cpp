#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <base/text.h>

#include <imgui_internal.h>

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <set>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// The words of a text; a number and its unit are one.
std::vector<std::string> unbroken_words(const std::string& text) {
    std::vector<std::string> out;
    for (const std::string& word : words_of(text)) {
        const bool unit = (word[0] == 'm' || word[0] == 's') && (word.size() == 1 || std::ispunct(word[1]) != 0);
        if (unit && word.size() <= 2 && !out.empty()) {
            out.back() += ' ' + word;
        } else {
            out.push_back(word);
        }
    }
    return out;
}

constexpr float kLeastField = 56;  // pixels at scale 1

}  // namespace

void heading(Ui& ui, const char* text, const std::string& right) {
    ImGui::Dummy({0, ui.px(6)});
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    const float room = ImGui::GetContentRegionAvail().x;
    const float left = ImGui::GetCursorPosX();
    ImGui::TextUnformatted(text);
    const float width = ImGui::CalcTextSize(right.c_str()).x;
    if (!right.empty() && ImGui::CalcTextSize(text).x + width + ui.px(12) < room) {
        ImGui::SameLine(left + room - width);
        ImGui::TextUnformatted(right.c_str());
    }
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

bool section(Ui& ui, const std::string& title, const std::string& right) {
    std::string id = title;
    std::ranges::transform(id, id.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::set<std::string>& folded = ui.session.settings.folded;
    const bool open = !folded.contains(id);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    heading(ui, title.c_str(), right);
    const ImVec2 below = ImGui::GetCursorScreenPos();
    const float line = ui.style.caption->FontSize;
    const float top = corner.y + ui.px(6) + ImGui::GetStyle().ItemSpacing.y;
    // All of its line is the button, and the room beside it.
    const float edge = ui.px(10);
    ImGui::SetCursorScreenPos({corner.x - edge, top - ui.px(2)});
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), line + ui.px(4)};
    if (ImGui::InvisibleButton(("##section." + id).c_str(), size)) {
        open ? static_cast<void>(folded.insert(id)) : static_cast<void>(folded.erase(id));
    }
    ui.mark("section." + id);
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 window = ImGui::GetWindowPos();
    draw.PushClipRect(window, {window.x + ImGui::GetWindowWidth(), window.y + ImGui::GetWindowHeight()});
    const ImU32 color = hovered ? ui.style.text : ui.style.quiet;
    const float r = ui.px(3);
    const ImVec2 middle{corner.x - ui.px(6), top + 0.5f * line};
    if (open) {
        draw.AddTriangleFilled({middle.x - r, middle.y - 0.6f * r}, {middle.x + r, middle.y - 0.6f * r},
                               {middle.x, middle.y + 0.8f * r}, color);
    } else {
        draw.AddTriangleFilled({middle.x - 0.6f * r, middle.y - r}, {middle.x + 0.8f * r, middle.y},
                               {middle.x - 0.6f * r, middle.y + r}, color);
    }
    draw.PopClipRect();
    ImGui::SetCursorScreenPos(below);
    return open;
}

void text_line(ImU32 color, const std::string& text, ImFont* font) {
    ImGui::PushFont(font ? font : ImGui::GetFont());
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void words(ImU32 color, const std::string& text) {
    const float wrap = ImGui::GetCurrentWindowRead()->DC.TextWrapPos;
    const float room = wrap > 0 ? wrap - ImGui::GetCursorPosX() : ImGui::GetContentRegionAvail().x;
    std::string lines;
    std::string line;
    for (const std::string& word : unbroken_words(text)) {
        const std::size_t before = line.size();
        if (before > 0) line += ' ';
        line += word;
        if (before == 0 || ImGui::CalcTextSize(line.c_str()).x <= room) continue;
        lines.append(line, 0, before) += '\n';
        line = word;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(-1);
    ImGui::TextUnformatted((lines + line).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

void number(Ui& ui, const std::string& shown, double value, const char* unit, ImU32 color) {
    text_line(color, shown, ui.style.mono);
    if (!ImGui::IsItemHovered()) return;
    const std::string digits = formatted("%.17g", value);
    ImGui::SetTooltip("%s %s\nClick to copy", digits.c_str(), unit);
    if (ImGui::IsItemClicked() && ui.session.hooks.set_clipboard) ui.session.hooks.set_clipboard(digits);
}

void number_row(Ui& ui, const char* label, const std::string& shown, double value, const char* unit) {
    const float room = ImGui::GetContentRegionAvail().x;
    const float left = ImGui::GetCursorPosX();
    text_line(ui.style.quiet, label);
    ImGui::PushFont(ui.style.mono);
    const float width = ImGui::CalcTextSize(shown.c_str()).x;
    ImGui::PopFont();
    ImGui::SameLine(left + room - width);
    number(ui, shown, value, unit, ui.style.text);
}

void form_label(Ui& ui, const char* label, const char* help) {
    ImGui::AlignTextToFramePadding();
    text_line(ui.style.quiet, label);
    if (help && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    // Below the longest label of all forms the columns still stand under one another.
    const float column = ImGui::GetWindowContentRegionMin().x + ImGui::CalcTextSize("Leaf samples").x + ui.px(12);
    const float right = ImGui::GetWindowContentRegionMax().x;
    const float left = std::max(column, 0.34f * right);
    // In a narrow panel the widget stands below its label.
    if (right - left >= ui.px(kLeastField)) ImGui::SameLine(left);
    ImGui::SetNextItemWidth(-1);
}

void framed(Ui& ui, ImU32 fill, ImU32 border, const std::function<void()>& draw) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float inset = ui.px(9);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.ChannelsSplit(2);
    list.ChannelsSetCurrent(1);
    ImGui::SetCursorScreenPos({at.x + inset, at.y + inset});
    ImGui::BeginGroup();
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width - 2 * inset);
    draw();
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
    const float bottom = ImGui::GetItemRectMax().y + inset;
    list.ChannelsSetCurrent(0);
    list.AddRectFilled(at, {at.x + width, bottom}, fill, ui.px(5));
    list.AddRect(at, {at.x + width, bottom}, border, ui.px(5), 0, ui.px(1.5f));
    list.ChannelsMerge();
    ImGui::SetCursorScreenPos(at);
    ImGui::Dummy({width, bottom - at.y});
}

void flow(float width) {
    const float spacing = ImGui::GetStyle().ItemSpacing.x;
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + spacing + width <= right) ImGui::SameLine();
}

std::string signed_metres(double metres) { return formatted("%+.3f", metres); }

void command_button(Ui& ui, const char* label, const char* id, const std::string& mark) {
    const Command& command = *find_command(id);
    ImGui::BeginDisabled(!command.enabled(ui.session));
    ImGui::PushID(mark.c_str());  // labels may be alike
    const bool pressed = ImGui::Button(label);
    ImGui::PopID();
    ImGui::EndDisabled();
    ui.mark(mark);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        const std::string_view key = first_shortcut(command);
        ImGui::PushStyleColor(ImGuiCol_Text, ui.style.text);  // whatever the button's
        ImGui::SetTooltip("%s%s", std::string(command.doc).c_str(),
                          key.empty() ? "" : ("  (" + std::string(key) + ")").c_str());
        ImGui::PopStyleColor();
    }
    if (pressed) invoke(ui.session, id);
}

bool small_button(Ui& ui, const char* label, const std::string& mark, const char* help) {
    const bool pressed = ImGui::SmallButton(label);
    ui.mark(mark);
    if (*help && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
}

void draw_text(ImDrawList& list, const ImFont& font, ImVec2 at, ImU32 color, const std::string& text) {
    list.AddText(&font, font.FontSize, at, color, text.c_str());
}

ImVec2 text_size(const ImFont& font, const std::string& text) {
    return font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, text.c_str());
}

float button_width(const char* label) {
    return ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
}

std::string fitted_text(const std::string& text, float room) {
    std::string line = cleaned(text);
    if (ImGui::CalcTextSize(line.c_str()).x <= room) return line;
    const float left = std::max(room - ImGui::CalcTextSize("\u2026").x, 0.0f);
    const char* end = nullptr;
    ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), left, 0, line.c_str(), nullptr, &end);
    return line.substr(0, static_cast<std::size_t>(end - line.c_str())) + "\u2026";
}

void rows(Ui& ui, const char* name, int count, int most_rows, const std::function<void(int)>& draw) {
    const float height = ImGui::GetFrameHeight();
    const bool scrolls = count > most_rows;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    if (scrolls)
        ImGui::BeginChild(name, {0, height * (static_cast<float>(most_rows) + 0.5f)}, false,
                          ImGuiWindowFlags_NoBackground);
    ImGuiListClipper clipper;
    clipper.Begin(count, height);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw(i);
    }
    if (scrolls) ImGui::EndChild();
    ImGui::PopStyleVar();
}

bool row(Ui& ui, const Row& row) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(row.mark.c_str());
    const bool clicked = ImGui::InvisibleButton("##row", {width, height});
    ImGui::PopID();
    ui.mark(row.mark);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + width, corner.y + height};
    if (row.selected || row.hovered || ImGui::IsItemHovered()) {
        draw.AddRectFilled(corner, end, row.selected ? ui.style.raised : ui.style.border, ui.px(4));
    }
    if (row.selected) draw.AddRectFilled(corner, {corner.x + ui.px(2), end.y}, ui.style.accent, ui.px(1));
    const float pad = ui.px(6);
    const ImFont& mono = *ui.style.mono;
    const float y = corner.y + 0.5f * (height - ImGui::GetFontSize());
    const float left = corner.x + pad + row.indent;
    const float room = end.x - pad - left;
    // The name keeps half of a narrow row.
    const float name_width = std::min(ImGui::CalcTextSize(cleaned(row.name).c_str()).x, 0.5f * room);
    ImGui::PushFont(ui.style.mono);
    const std::string remark = fitted_text(row.remark, std::max(room - name_width - ui.px(8), 0.0f));
    const float width_of_remark = ImGui::CalcTextSize(remark.c_str()).x;
    ImGui::PopFont();
    const std::string name = fitted_text(row.name, std::max(ui.px(24), room - width_of_remark - ui.px(8)));
    draw.AddText({left, y}, ui.style.text, name.c_str());
    draw_text(draw, mono, {end.x - pad - width_of_remark, corner.y + 0.5f * (height - mono.FontSize)},
              row.remark_color != 0 ? row.remark_color : ui.style.quiet, remark);
    return clicked;
}

}  // namespace mobbscope::app
