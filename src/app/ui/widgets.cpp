#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <base/numbers_in_text.h>
#include <base/text.h>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cfloat>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
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

constexpr float kLeastField = 84;  // pixels at scale 1

float text_width(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

/// The parts of a word that a line may end behind, each as wide as `room` at most: those of a path, and of what has no
/// slashes as much as fits.
std::vector<std::string> parts_of_word(const std::string& word, float room) {
    std::vector<std::string> out{""};
    for (std::size_t i = 0; i < word.size();) {
        std::size_t next = i + 1;
        while (next < word.size() && (static_cast<unsigned char>(word[next]) & 0xC0u) == 0x80u) ++next;
        const std::string letter = word.substr(i, next - i);
        if (!out.back().empty() && text_width(out.back() + letter) > room) out.emplace_back();
        out.back() += letter;
        if (letter == "/" && next < word.size()) out.emplace_back();
        i = next;
    }
    return out;
}

/// With its folders from the second on left out, as many as it takes; of a name that is too long alone the middle.
std::string short_path(const std::string& path, float room) {
    const std::string ellipsis = "\u2026";
    const std::size_t first = path.find('/', 1);
    for (std::size_t from = first; from != std::string::npos; from = path.find('/', from + 1)) {
        std::string shorter = path.substr(0, first + 1) + ellipsis + path.substr(from);
        if (from > first && text_width(shorter) <= room) return shorter;
    }
    const std::string name = path.substr(path.rfind('/') + 1);
    const std::vector<std::string> halves = parts_of_word(name, (room - text_width(ellipsis)) / 2);
    if (halves.size() < 2) return ellipsis + "/" + name;
    const std::string begin = halves.front() + ellipsis;
    std::string whole = begin;
    for (std::size_t i = name.size(); i-- > 0;) {
        const bool in_letter = (static_cast<unsigned char>(name[i]) & 0xC0u) == 0x80u;
        if (in_letter) continue;
        const std::string longer = std::string(begin).append(name, i);
        if (text_width(longer) > room) break;
        whole = longer;
    }
    return whole;
}

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

bool is_folded(const Settings& settings, const std::string& title, bool at_first) {
    const auto known = settings.folded.find(title);
    return known != settings.folded.end() ? known->second : at_first;
}

bool section(Ui& ui, const std::string& title, const std::string& right, bool folded_at_first) {
    const std::string id = lower(title);
    if (ui.session.keys.section == id) {
        ui.session.keys.section.clear();
        ui.session.settings.folded[id] = false;
        ImGui::SetScrollHereY(0);
        ui.want_frame_in(0);
    }
    const bool open = !is_folded(ui.session.settings, id, folded_at_first);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    heading(ui, title.c_str(), right);
    const ImVec2 below = ImGui::GetCursorScreenPos();
    const float line = ui.style.caption->FontSize;
    const float top = corner.y + ui.px(6) + ImGui::GetStyle().ItemSpacing.y;
    // All of its line is the button, and the room beside it.
    const float edge = ui.px(10);
    ImGui::SetCursorScreenPos({corner.x - edge, top - ui.px(2)});
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), line + ui.px(4)};
    if (ImGui::InvisibleButton(("##section." + id).c_str(), size)) ui.session.settings.folded[id] = open;
    ui.mark_only("section." + id);
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

namespace {

/// Returns them in their lines.
std::string draw_words(ImU32 color, const std::string& text) {
    const float wrap = ImGui::GetCurrentWindowRead()->DC.TextWrapPos;
    const float room = wrap > 0 ? wrap - ImGui::GetCursorPosX() : ImGui::GetContentRegionAvail().x;
    std::string lines = wrapped(text, room);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::PushTextWrapPos(-1);
    ImGui::TextUnformatted(lines.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    return lines;
}

/// "0.183204 m": as it is copied, or with six digits.
std::string copied_text(const CopiedNumber& number, bool all_digits) {
    const std::string digits = all_digits ? format_double(number.value) : brief(number.value);
    const bool joined = number.unit.empty() || number.unit.starts_with("\u00B0");
    return digits + (joined ? "" : " ") + number.unit;
}

}  // namespace

void words(ImU32 color, const std::string& text) { draw_words(color, text); }

void words(Ui& ui, ImU32 color, const std::string& text, std::vector<double> exact) {
    const std::string lines = draw_words(color, text);
    copies_numbers(ui, lines, ImGui::GetItemRectMin(), *ImGui::GetFont(), std::move(exact));
}

namespace {

/// Whether numbers that are drawn now can be pointed at. Those that want Ctrl may stand in a row that is pressed.
bool can_copy(bool with_ctrl) {
    if (!with_ctrl) return ImGui::IsItemHovered();
    return ImGui::GetIO().KeyCtrl && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
}

}  // namespace

bool copies(Ui& ui, const Rect& place, const CopiedNumber& number) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!can_copy(number.with_ctrl) || !place.contains({{mouse.x, mouse.y}, {mouse.x, mouse.y}})) return false;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    const float y = std::floor(place.max.y - ui.px(1));
    ImGui::GetWindowDrawList()->AddLine({place.min.x, y}, {place.max.x, y}, ui.style.text, ui.px(1));
    ImGui::SetTooltip("%s%s%s\nClick to copy", number.tip.c_str(), number.tip.empty() ? "" : "\n\n",
                      copied_text(number, true).c_str());
    if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return true;
    ui.session.desktop->set_clipboard(format_double(number.value));
    ui.session.notifications.tell(MessageLevel::info, "Copied " + copied_text(number, false));
    return true;
}

bool copies_numbers(Ui& ui, const std::string& text, ImVec2 at, const ImFont& font, std::vector<double> exact,
                    bool with_ctrl) {
    if (!can_copy(with_ctrl)) return false;
    ShownNumbers numbers(std::move(exact));
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::string line = text.substr(begin, text.find('\n', begin) - begin);
        begin += line.size() + 1;
        const float top = at.y;
        at.y += font.FontSize;
        for (const NumberInText& each : numbers.in(line)) {
            const ImVec2 from = text_size(font, line.substr(0, each.begin));
            const ImVec2 to = text_size(font, line.substr(0, each.end));
            const Rect place{{at.x + from.x, top}, {at.x + to.x, at.y}};
            if (copies(ui, place, {.value = each.value, .unit = each.unit, .with_ctrl = with_ctrl})) return true;
        }
    }
    return false;
}

std::string wrapped(const std::string& text, float room) {
    std::string lines;
    std::string line;
    const auto add = [&](const std::string& word, const char* gap) {
        const std::string longer = line.empty() ? word : line + gap + word;
        if (!line.empty() && text_width(longer) > room) {
            lines += line + '\n';
            line = word;
        } else {
            line = longer;
        }
    };
    for (const std::string& word : unbroken_words(text)) {
        if (text_width(word) <= room) {
            add(word, " ");
            continue;
        }
        const char* gap = " ";
        for (const std::string& part : parts_of_word(word, room)) add(part, std::exchange(gap, ""));
    }
    return lines + line;
}

std::string with_short_paths(const std::string& text, float room) {
    std::string out;
    for (const std::string& word : unbroken_words(text)) {
        const bool is_path = std::ranges::count(word, '/') > 1;
        if (!out.empty()) out += ' ';
        out += is_path && text_width(word) > room ? short_path(word, room) : word;
    }
    return out;
}

void number(Ui& ui, const std::string& shown, double value, const char* unit, ImU32 color) {
    text_line(color, shown, ui.style.mono);
    copies(ui, Ui::last_rect(), {.value = value, .unit = unit});
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
    std::string mark = "number." + lower(label);
    std::ranges::replace(mark, ' ', '_');
    ui.mark_only(mark);
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
    const Command& command = *find_command(id, commands(ui.session));
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
    if (!pressed) return;
    ui.focus.done_with(mark);
    ui.invoke(id);
}

bool small_button(Ui& ui, const char* label, const std::string& mark, const char* help) {
    const bool pressed = ImGui::SmallButton(label);
    ui.mark(mark);
    if (*help && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    return pressed;
}

int word_choice(Ui& ui, const std::string& mark, std::span<const ChoiceWord> all, int chosen) {
    int pressed = -1;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ImGui::GetStyle().ItemSpacing.y});
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
        const ChoiceWord& each = all[static_cast<std::size_t>(i)];
        const bool is_chosen = i == chosen;
        if (i > 0) flow(button_width(each.word.c_str()));
        ImGui::PushStyleColor(ImGuiCol_Text, is_chosen ? ui.style.text : ui.style.quiet);
        ImGui::PushStyleColor(ImGuiCol_Button, is_chosen ? ui.style.raised : IM_COL32_BLACK_TRANS);
        std::string called = mark;
        called.append(1, '.').append(each.name);
        if (small_button(ui, each.word.c_str(), called, each.help)) pressed = i;
        ImGui::PopStyleColor(2);
    }
    ImGui::PopStyleVar();
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

std::string fitted_name(const std::string& name, float room) {
    return fitted_name(name, room, NameList(std::vector<std::string>()));
}

std::string fitted_name(const std::string& name, float room, const NameList& list) {
    const auto fits = [room](const std::string& text) { return text_width(text) <= room; };
    return fitted_text(list.shortened(cleaned(name), fits), room);
}

std::string fitted_pair(const std::string& a, const char* between, const std::string& b, float room,
                        const NameList& list) {
    std::string whole = cleaned(a) + between + cleaned(b);
    if (text_width(whole) <= room) return whole;
    // The names need the room more than the word.
    const std::string dash = " \u2013 ";
    const float rest = std::max(room - text_width(dash), 0.0f);
    // What one does not need the other has.
    const float for_a = std::max(0.5f * rest, rest - text_width(cleaned(b)));
    const float for_b = std::max(0.5f * rest, rest - text_width(cleaned(a)));
    return fitted_name(a, for_a, list) + dash + fitted_name(b, for_b, list);
}

void tell_whole(const Ui& ui, const std::string& shown, const std::string& whole) {
    if (shown == cleaned(whole) || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::SetTooltip("%s", wrapped(cleaned(whole), std::min(ui.px(640), 0.9f * ImGui::GetIO().DisplaySize.x)).c_str());
}

void fitted_line(const Ui& ui, ImU32 color, const std::string& text, float room, ImFont* font) {
    ImGui::PushFont(font ? font : ImGui::GetFont());
    const std::string shown = fitted_text(text, room);
    text_line(color, shown);
    ImGui::PopFont();
    tell_whole(ui, shown, text);
}

void name_line(const Ui& ui, ImU32 color, const std::string& name, float room, const NameList& list) {
    const std::string shown = fitted_name(name, room, list);
    text_line(color, shown);
    tell_whole(ui, shown, name);
}

bool begin_dropdown(Ui& ui, const std::string& mark, const std::string& shown, std::string_view label,
                    ImGuiComboFlags flags) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
    const float room = size.x - size.y - ImGui::GetStyle().FramePadding.x;
    const std::string fits = fitted_name(shown, room);
    const bool open = ImGui::BeginCombo(("##" + mark).c_str(), fits.c_str(), flags);
    // Once it is open the last item is of its list.
    const Rect place{{corner.x, corner.y}, {corner.x + size.x, corner.y + size.y}};
    ui.marks.add(mark, place);
    if (open) return true;
    ui.focus.add(mark, place, ImGui::GetItemID(), OwnKeys::none, label);
    tell_whole(ui, fits, shown);
    return false;
}

void clipped_rows(Ui& ui, const char* name, int count, float height, const std::function<void(int)>& draw,
                  int shown_first) {
    ui.focus.begin_list(ImGui::GetID(name), count);
    ImGuiListClipper clipper;
    clipper.Begin(count, height);
    if (const auto wanted = ui.focus.wanted_row()) clipper.ForceDisplayRangeByIndices(*wanted, *wanted + 1);
    const bool scrolls = shown_first > 0 && ImGui::IsWindowAppearing();
    if (scrolls) clipper.ForceDisplayRangeByIndices(shown_first, shown_first + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            ui.focus.row(i);
            draw(i);
            if (scrolls && i == shown_first) {
                ImGui::SetScrollHereY();
                ui.want_frame_in(0);
            }
        }
    }
    ui.focus.end_list();
}

namespace {

/// Whether what is done in the field that was drawn last begins now. What was typed elsewhere has this frame to be
/// taken.
bool begins_input(const FieldInput& input, const std::string& mark) {
    const bool others = input.typing && input.mark != mark;
    return ImGui::IsItemActivated() ? !others : ImGui::IsItemActive() && input.mark != mark;
}

}  // namespace

std::optional<std::string> text_edit(Ui& ui, const std::string& mark, const std::string& now) {
    FieldInput& input = ui.field;
    const bool own = input.typing && input.mark == mark;
    std::string shown = now;
    ImGui::InputText(("##" + mark).c_str(), own ? &input.text : &shown);
    ui.mark(mark, OwnKeys::text);
    if (begins_input(input, mark)) input = {.mark = mark, .text = shown, .before = now, .waits = 0, .typing = true};
    if (!own || ImGui::IsItemActive()) return std::nullopt;
    const FieldInput done = std::exchange(input, {});
    if (!ImGui::IsItemDeactivated() || done.text == done.before) return std::nullopt;
    return done.text;
}

namespace {

std::string number_text(const NumberField& field, double value) {
    return field.by_factors ? formatted("%.3g", value) : formatted("%.*f", field.decimals, value);
}

/// The number so many steps on. Whole numbers go by one at least.
double stepped(const NumberField& field, double value, double steps) {
    if (field.by_factors) return value * std::pow(1.1, steps);
    return value + steps * field.step;
}

double whole_or_not(const NumberField& field, double value) {
    if (field.decimals == 0 && !field.by_factors) value = std::round(value);
    return std::clamp(value, field.least, field.most);
}

/// What was typed, with or without its unit; a number that is out of range is brought into it, and that is said.
std::optional<double> typed_number(Ui& ui, const NumberField& field, std::string text) {
    text = std::string(trimmed(text));
    if (!field.unit.empty() && text.ends_with(field.unit)) {
        text = std::string(trimmed(std::string_view(text).substr(0, text.size() - field.unit.size())));
    }
    const std::optional<double> value = parse_double(text);
    const std::string unit = field.unit.empty() ? "" : (field.unit == "\u00B0" ? "" : " ") + field.unit;
    if (!value || !std::isfinite(*value)) {
        ui.session.notifications.tell(MessageLevel::warning, in_quotes(text) + " is not a number; " + field.what +
                                                                 " stays " + number_text(field, field.now) + unit);
        return std::nullopt;
    }
    const double within = whole_or_not(field, *value);
    if (*value < field.least || *value > field.most) {
        const bool low = *value < field.least;
        ui.session.notifications.tell(MessageLevel::info, field.what + (low ? " is at least " : " is at most ") +
                                                              number_text(field, low ? field.least : field.most) +
                                                              unit);
    }
    return within;
}

/// Two arrow heads that point apart: this can be dragged.
void drag_grip(Ui& ui, ImVec2 middle, ImU32 color) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float h = ui.px(3.5f);
    const float from = ui.px(2);
    const float to = ui.px(5.5f);
    draw.AddTriangleFilled({middle.x + from, middle.y - h}, {middle.x + to, middle.y}, {middle.x + from, middle.y + h},
                           color);
    draw.AddTriangleFilled({middle.x - to, middle.y}, {middle.x - from, middle.y - h}, {middle.x - from, middle.y + h},
                           color);
}

std::optional<double> type_number(Ui& ui, const NumberField& field) {
    FieldInput& input = ui.field;
    ImGui::PushFont(ui.style.mono);
    ImGui::InputText(("##typed " + field.mark).c_str(), &input.text, ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopFont();
    ui.mark(field.mark, OwnKeys::up_down);
    if (std::exchange(input.fresh, false)) {
        ui.focus.activate(ImGui::GetItemID());
        ui.want_frame_in(0);
        return std::nullopt;
    }
    if (ImGui::IsItemActive()) {
        // In its first frame Dear ImGui does not give it all keys yet.
        if (ImGui::GetIO().WantTextInput) {
            input.waits = 0;
        } else {
            ui.want_frame_in(0);
        }
        return std::nullopt;
    }
    // It has the keys a frame after it asked for them.
    if (input.waits-- > 0) return std::nullopt;
    const FieldInput done = std::exchange(input, {});
    if (!ImGui::IsItemDeactivated() || done.text == done.before) return std::nullopt;
    return typed_number(ui, field, done.text);
}

/// Whether the mouse has moved so far that it is no click.
bool is_dragged() { return ImGui::IsMouseDragPastThreshold(ImGuiMouseButton_Left); }

/// A click or Enter gives the field the keys.
void begin_typing(Ui& ui, const NumberField& field, double value) {
    const std::string text = number_text(field, value);
    ui.field = {.mark = field.mark, .text = text, .before = text, .fresh = true, .typing = true};
    ui.want_frame_in(0);
}

std::optional<double> drag_number(Ui& ui, const NumberField& field, double per_pixel) {
    FieldInput& input = ui.field;
    if (begins_input(input, field.mark)) input = {.mark = field.mark, .value = field.now, .given = field.now};
    if (input.typing || input.mark != field.mark) return std::nullopt;
    const bool held = ImGui::IsItemActive();
    if (held)
        input.value =
            std::clamp(stepped(field, input.value, per_pixel * ImGui::GetIO().MouseDelta.x), field.least, field.most);
    const double wanted = whole_or_not(field, input.value);
    const bool gives = wanted != input.given && is_dragged() && (field.live || !held);
    input.given = gives ? wanted : input.given;
    if (!held) input = {};
    return gives ? std::optional(wanted) : std::nullopt;
}

/// Up and Down, and Enter, which begins to type.
std::optional<double> number_keys(Ui& ui, const NumberField& field) {
    double value = field.now;
    for (const Chord& chord : ui.focus.take(field.mark)) {
        if (chord.key == Key::enter) {
            begin_typing(ui, field, value);
            continue;
        }
        const double size = chord.shift ? 0.1 : chord.ctrl ? 10 : 1;
        const bool whole = field.decimals == 0 && !field.by_factors;
        const double steps = whole ? std::max(size, 1 / field.step) : size;
        const double next = whole_or_not(field, stepped(field, value, chord.key == Key::up ? steps : -steps));
        if (next == value) {
            const bool low = chord.key == Key::down;
            ui.session.notifications.tell(
                MessageLevel::info, field.what + (low ? " is at least " : " is at most ") + number_text(field, next));
        }
        value = next;
    }
    if (value == field.now) return std::nullopt;
    // However often a key is pressed, the number is changed once.
    ui.later([](Workspace& workspace) { workspace.history.reopen_group(); });
    return value;
}

}  // namespace

std::optional<double> number_field(Ui& ui, const NumberField& field) {
    const std::optional<double> stepped_to = number_keys(ui, field);
    if (ui.field.typing && ui.field.mark == field.mark) return type_number(ui, field);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::CalcItemWidth()), ImGui::GetFrameHeight()};
    ImGui::InvisibleButton(("##" + field.mark).c_str(), size);
    ui.mark(field.mark, OwnKeys::up_down);
    const ImGuiIO& io = ImGui::GetIO();
    const double factor = io.KeyShift ? 0.1 : io.KeyCtrl ? 10 : 1;
    std::optional<double> wanted = drag_number(ui, field, 0.1 * factor);
    const bool held = ui.field.mark == field.mark;
    const bool over = ImGui::IsItemHovered();
    const bool enabled = (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) == 0;
    const bool released = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    if (released && over && !is_dragged()) begin_typing(ui, field, field.now);
    if (over || held) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImGuiStyle& style = ImGui::GetStyle();
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    draw.AddRectFilled(corner, end, ImGui::GetColorU32(over || held ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
                       style.FrameRounding);
    draw.AddRect(corner, end, ImGui::GetColorU32(ImGuiCol_Border), style.FrameRounding, 0, style.FrameBorderSize);
    const float grip = ui.px(16);
    drag_grip(ui, {end.x - 0.5f * grip - ui.px(2), corner.y + 0.5f * size.y},
              ImGui::GetColorU32(held   ? ImGuiCol_SliderGrab
                                 : over ? ImGuiCol_Text
                                        : ImGuiCol_TextDisabled));
    const double shown = held ? whole_or_not(field, ui.field.value) : field.now;
    const std::string gap = field.unit.empty() || field.unit == "\u00B0" ? "" : " ";
    const std::string text =
        field.instead.empty() || held ? field.before + number_text(field, shown) + gap + field.unit : field.instead;
    ImGui::PushFont(ui.style.mono);
    const std::string fits = fitted_text(text, size.x - style.FramePadding.x - grip);
    draw_text(draw, *ui.style.mono, {corner.x + style.FramePadding.x, corner.y + style.FramePadding.y},
              ImGui::GetColorU32(enabled ? ImGuiCol_Text : ImGuiCol_TextDisabled), fits);
    ImGui::PopFont();
    return wanted ? wanted : stepped_to;
}

void rows(Ui& ui, const char* name, int count, int most_rows, int present, const std::function<void(int)>& draw) {
    const float height = ImGui::GetFrameHeight();
    const bool scrolls = count > most_rows;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    if (scrolls)
        ImGui::BeginChild(name, {0, height * (static_cast<float>(most_rows) + 0.5f)}, false,
                          ImGuiWindowFlags_NoBackground);
    clipped_rows(ui, name, count, height, draw, scrolls ? present : 0);
    if (scrolls) ImGui::EndChild();
    ImGui::PopStyleVar();
}

bool row(Ui& ui, const Row& row) {
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(row.mark.c_str());
    const bool clicked = ImGui::InvisibleButton("##row", {width - row.buttons, height});
    ImGui::PopID();
    ui.mark(row.mark);
    if (row.selected) ui.focus.begin_here();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    ImVec2 end{corner.x + width, corner.y + height};
    if (row.selected || row.hovered || ImGui::IsItemHovered()) {
        draw.AddRectFilled(corner, end, row.selected ? ui.style.raised : ui.style.border, ui.px(4));
    }
    if (row.selected) draw.AddRectFilled(corner, {corner.x + ui.px(2), end.y}, ui.style.accent, ui.px(1));
    end.x -= row.right;
    const float pad = ui.px(6);
    const ImFont& mono = *ui.style.mono;
    const float y = corner.y + 0.5f * (height - ImGui::GetFontSize());
    const float left = corner.x + pad + row.indent;
    const float room = end.x - pad - left;
    // The name keeps a part of a narrow row.
    const float name_width = std::min(ImGui::CalcTextSize(cleaned(row.name).c_str()).x, 0.35f * room);
    ImGui::PushFont(ui.style.mono);
    const std::string remark = fitted_name(row.remark, std::max(room - name_width - ui.px(8), 0.0f));
    const float width_of_remark = ImGui::CalcTextSize(remark.c_str()).x;
    ImGui::PopFont();
    const float name_room = std::max(ui.px(24), room - width_of_remark - ui.px(8));
    const std::string name = row.fitted ? row.fitted(name_room) : fitted_name(row.name, name_room);
    const std::string gap = row.remark.empty() ? "" : "   ";
    tell_whole(ui, name + gap + remark, row.name + gap + row.remark);
    const ImVec2 remark_at{end.x - pad - width_of_remark, corner.y + 0.5f * (height - mono.FontSize)};
    const bool copied = copies_numbers(ui, remark, remark_at, mono, row.exact, true);
    draw.AddText({left, y}, row.quiet ? ui.style.quiet : ui.style.text, name.c_str());
    draw_text(draw, mono, remark_at, row.remark_color != 0 ? row.remark_color : ui.style.quiet, remark);
    return clicked && !copied;
}

}  // namespace mobbscope::app
