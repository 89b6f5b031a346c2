#include <app/ui/filter_field.h>
#include <app/ui/widgets.h>
#include <base/text.h>

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

namespace mobbscope::app {

namespace {

/// A word, and what is typed behind it.
std::string completed(const std::string& word) { return word.ends_with('(') ? word : word + ' '; }

struct TypedFilter {
    FieldInput& input;
    FieldTable fields;
};

int on_filter_key(ImGuiInputTextCallbackData* data) {
    const auto& [input, fields] = *static_cast<TypedFilter*>(data->UserData);
    const FilterCompletion completion =
        completion_of(fields, std::string_view(data->Buf, static_cast<std::size_t>(data->CursorPos)));
    const int count = static_cast<int>(completion.words.size());
    if (count == 0) return 0;
    if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) {
        input.picked = (input.picked + (data->EventKey == ImGuiKey_DownArrow ? 1 : count - 1)) % count;
        return 0;
    }
    const int from = static_cast<int>(completion.from);
    data->DeleteChars(from, data->CursorPos - from);
    const std::string& word = completion.words[static_cast<std::size_t>(std::min(input.picked, count - 1))];
    data->InsertChars(data->CursorPos, completed(word).c_str());
    input.picked = 0;
    return 0;
}

bool is_typed(const Ui& ui, const FilterField& field) { return ui.field.typing && ui.field.mark == field.mark; }

/// What stands in the field.
std::string shown_filter(const Ui& ui, const FilterField& field) {
    return is_typed(ui, field) ? ui.field.text : field.now;
}

bool is_filter(const FilterField& field, const std::string& text) {
    try {
        const TableFilter filter(field.fields, text);
        return true;
    } catch (const FilterError&) {
        return false;
    }
}

/// The caret, and why beside it or below.
void wrong_filter(Ui& ui, const FilterField& field, const std::string& text, const FilterError& error) {
    const Rect* box = nullptr;
    if (const auto at = ui.marks.all().find(field.mark); at != ui.marks.all().end()) box = &at->second;
    const ImGuiInputTextState& state = ImGui::GetCurrentContext()->InputTextState;
    const float scrolled = is_typed(ui, field) ? state.ScrollX : 0;
    const ImFont& mono = *ui.style.mono;
    const float left = ImGui::GetCursorScreenPos().x;
    const float room = ImGui::GetContentRegionAvail().x;
    const float before = text_size(mono, text.substr(0, error.at())).x;
    const float field_left = (box ? box->min.x : left) + ImGui::GetStyle().FramePadding.x;
    const float x = std::clamp(field_left + before - scrolled, left, left + room - ui.px(8));
    // What is not finished yet is not wrong.
    const bool open = trimmed(text.substr(error.at())).empty() || !completion_of(field.fields, text).words.empty();
    const ImU32 color = open ? ui.style.quiet : ui.style.error;
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    draw_text(*ImGui::GetWindowDrawList(), mono, {x, corner.y}, color, "^");
    const std::string why = error.what();
    const float width = ImGui::CalcTextSize(why.c_str()).x;
    const float beside = x + text_size(mono, "^ ").x;
    ImGui::Dummy({ui.px(8), line});
    ui.marks.add(field.mark + ".caret", {{x, corner.y}, {x + ui.px(8), corner.y + line}});
    if (beside + width <= left + room) {
        ImGui::SetCursorScreenPos({beside, corner.y});
        text_line(color, why);
    } else if (x - ui.px(8) - width >= left) {
        ImGui::SetCursorScreenPos({x - ui.px(8) - width, corner.y});
        text_line(color, why);
    } else {
        words(color, why);
    }
}

/// On one line: the one that Tab takes stands out.
void candidates(Ui& ui, const FilterField& field) {
    const FilterCompletion completion = completion_of(field.fields, ui.field.text);
    if (completion.words.empty()) return;
    ImGui::PushFont(ui.style.mono);
    const int count = static_cast<int>(completion.words.size());
    const int picked = std::min(ui.field.picked, count - 1);
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const float gap = ui.px(10);
    text_line(ui.style.quiet, "Tab");
    // The picked one is always among those that are seen.
    for (int i = std::max(0, picked - 3); i < count; ++i) {
        const std::string& word = completion.words[static_cast<std::size_t>(i)];
        ImGui::SameLine(0, gap);
        if (ImGui::GetCursorScreenPos().x + ImGui::CalcTextSize(word.c_str()).x + gap > right && i > picked) {
            text_line(ui.style.quiet, "\u2026");
            break;
        }
        text_line(i == picked ? ui.style.text : ui.style.quiet, word);
        if (i == picked) {
            const Rect at = Ui::last_rect();
            ImGui::GetWindowDrawList()->AddLine({at.min.x, at.max.y}, {at.max.x, at.max.y}, ui.style.accent, ui.px(1));
            ui.mark_only(field.mark + ".candidate");
        }
    }
    ImGui::PopFont();
}

}  // namespace

std::optional<std::string> table_filter_field(Ui& ui, const FilterField& field) {
    FieldInput& input = ui.field;
    if (ui.session.keys.field == field.mark) {
        ui.session.keys.field.clear();
        input = {.mark = field.mark, .text = field.now, .before = field.now, .fresh = true, .typing = true};
    }
    const bool own = is_typed(ui, field);
    std::string shown = shown_filter(ui, field);
    const std::string hits = is_filter(field, shown) ? field.hits(shown) : "";
    const float for_hits = hits.empty() ? 0 : ImGui::CalcTextSize(hits.c_str()).x + ImGui::GetStyle().ItemSpacing.x;
    const float width = std::max(ui.px(60), ImGui::GetContentRegionAvail().x - field.right - for_hits);
    if (own && !completion_of(field.fields, shown).words.empty()) ui.focus.keep_tab();
    ImGui::PushFont(ui.style.mono);
    ImGui::SetNextItemWidth(width);
    const std::string before = shown;
    std::string& text = own ? input.text : shown;
    TypedFilter typed{input, field.fields};
    const bool entered =
        ImGui::InputTextWithHint(("##" + field.mark).c_str(), field.hint, &text,
                                 ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
                                     ImGuiInputTextFlags_CallbackHistory,
                                 on_filter_key, &typed);
    ImGui::PopFont();
    ui.mark(field.mark);
    const bool active = ImGui::IsItemActive();
    if (!hits.empty()) {
        const Rect box = Ui::last_rect();
        ImGui::SameLine();
        ImGui::SetCursorScreenPos({ImGui::GetCursorScreenPos().x, box.min.y});
        ImGui::AlignTextToFramePadding();
        text_line(own ? ui.style.text : ui.style.quiet, hits);
        ui.mark_only(field.mark + ".hits");
    }
    if (own && input.text != before) input.picked = 0;
    if (own && std::exchange(input.fresh, false)) {
        ui.focus.activate(ImGui::GetCurrentWindow()->GetID(("##" + field.mark).c_str()));
        ui.want_frame_in(0);
        return std::nullopt;
    }
    if (!own) {
        const bool others = input.typing && ui.field.mark != field.mark;
        if (active && !others)
            input = {.mark = field.mark, .text = shown, .before = field.now, .waits = 0, .typing = true};
        return std::nullopt;
    }
    if (active) {
        // In its first frame Dear ImGui does not give it all keys yet.
        if (ImGui::GetIO().WantTextInput) {
            input.waits = 0;
        } else {
            ui.want_frame_in(0);
        }
        return std::nullopt;
    }
    if (input.waits-- > 0 && !entered) return std::nullopt;
    const FieldInput done = std::exchange(input, {});
    if (!entered) return std::nullopt;
    const std::string wanted(trimmed(done.text));
    if (wanted.empty() || is_filter(field, wanted)) return wanted;
    // A wrong one is mended where it stands.
    input = {.mark = field.mark, .text = done.text, .before = done.before, .fresh = true, .typing = true};
    ui.want_frame_in(0);
    return std::nullopt;
}

void filter_words(Ui& ui, const FilterField& field) {
    const std::string text = shown_filter(ui, field);
    const bool typed = is_typed(ui, field);
    if (trimmed(text).empty()) {
        if (typed) candidates(ui, field);
        return;
    }
    try {
        words(typed ? ui.style.text : ui.style.quiet, TableFilter(field.fields, text).words());
        ui.mark_only(field.mark + ".words");
    } catch (const FilterError& error) {
        wrong_filter(ui, field, text, error);
    }
    if (typed) candidates(ui, field);
}

void filter_line(Ui& ui, const std::string& of, FilterField field, const char* menu_help,
                 const std::vector<MenuEntry>& menu) {
    field.mark = of + ".filter";
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    field.right = button_width("all") + button_width("\u00BB") + 2 * gap;
    const std::optional<std::string> entered = table_filter_field(ui, field);
    ImGui::SameLine();
    const std::string all = of + ".all";
    command_button(ui, "all", all.c_str(), all);
    ImGui::SameLine();
    if (ImGui::Button("\u00BB##more")) ImGui::OpenPopup("more of the table");
    ui.mark(of + ".more");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", menu_help);
    context_menu(ui, "more of the table", [&menu] { return menu; });
    filter_words(ui, field);
    if (!entered) return;
    if (!entered->empty()) return ui.invoke(field.mark, *entered);
    if (!field.now.empty()) ui.invoke(all);
}

}  // namespace mobbscope::app
