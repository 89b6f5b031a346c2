#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <import/clip/import_options.h>

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kFieldsWidth = 410;      // pixels at scale 1
constexpr std::size_t kFewChoices = 12;  // more are searched
constexpr int kMostChoiceRows = 12;      // before their list scrolls
constexpr double kFirstNumber = 0.3;     // that a drag begins with where there is none
constexpr double kTrimStep = 0.01;       // seconds

struct ImportField {
    const ImportOption& option;
    const OptionOffer* offer;  ///< null: the file has nothing to say of it, but it is given
    const SceneClip& clip;

    std::string mark() const { return std::string("import.") + option.key; }
    bool given() const { return option.is_given(clip.options); }
    std::string text() const { return option_text(clip.options, option); }
};

void set_option(Ui& ui, const ImportField& field, const std::string& text) {
    if (text == field.text()) return;
    ui.invoke("clip.set", std::string(field.option.key) + ' ' + text);
}

std::string label_of(const ImportField& field, const std::string& value) {
    if (!field.offer) return value;
    const auto at = std::ranges::find(field.offer->choices, value, &OfferedChoice::value);
    if (at != field.offer->choices.end()) return at->label;
    if (!parse_double(value) || *field.option.unit == '\0') return value;
    return value + ' ' + field.option.unit + (field.option.is_number() ? "" : " a unit");
}

/// What is taken without the option: "auto: cm".
std::string label_of_default(const ImportField& field) {
    if (!field.offer) return "none";
    if (field.offer->required) return "to be chosen";
    return field.offer->taken.empty() ? "auto" : "auto: " + field.offer->taken;
}

/// A row of an open list; true if it was chosen. The list stays: it is closed from outside a part that scrolls.
bool choice_row(Ui& ui, const ImportField& field, const std::string& label, const std::string& mark, bool chosen) {
    ImGui::PushID(mark.c_str());
    const bool clicked = ImGui::Selectable(label.c_str(), chosen, ImGuiSelectableFlags_DontClosePopups);
    ImGui::PopID();
    ui.mark(field.mark() + '.' + mark, OwnKeys::none, label);
    if (chosen) ui.focus.begin_here();
    return clicked;
}

/// What the file has to choose from, searched by a few letters where it is much; a unit or a radius may be any number
/// too.
void offered_choices(Ui& ui, Imports& imports, const ImportField& field) {
    std::string& search = imports.edited.search;
    if (ImGui::IsWindowAppearing()) search.clear();
    const std::vector<OfferedChoice>& all = field.offer->choices;
    const bool is_unit = field.option.key == std::string_view("unit");
    const bool takes_numbers = is_unit || field.option.is_number();
    const bool searched = all.size() > kFewChoices;
    if (searched || takes_numbers) {
        if (ImGui::IsWindowAppearing() && searched) ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(-1);
        const char* const hint = is_unit ? "another: metres a unit" : takes_numbers ? "a number of metres" : "search";
        const bool entered = ImGui::InputTextWithHint("##search", hint, &search, ImGuiInputTextFlags_EnterReturnsTrue);
        ui.mark(field.mark() + ".search");
        if (entered && takes_numbers) {
            set_option(ui, field, search);
            ImGui::CloseCurrentPopup();
        }
    }
    std::vector<const OfferedChoice*> found;
    for (const OfferedChoice& choice : all) {
        const bool matches =
            !searched || mobbscope::lower(choice.label).find(mobbscope::lower(search)) != std::string::npos;
        if (matches) found.push_back(&choice);
    }
    if (searched && !found.empty() && pressed(ImGuiKey_Enter)) {
        set_option(ui, field, found.front()->value);
        ImGui::CloseCurrentPopup();
    }
    std::optional<std::string> taken;
    if (!field.offer->required && choice_row(ui, field, label_of_default(field), "default", !field.given())) {
        taken = "";
    }
    const auto count = static_cast<int>(found.size());
    const bool scrolls = count > kMostChoiceRows;
    const float row = ImGui::GetTextLineHeightWithSpacing();
    if (scrolls) ImGui::BeginChild("##choices", {0, row * (kMostChoiceRows + 0.5f)});
    const auto draw = [&](int i) {
        const OfferedChoice& choice = *found[static_cast<std::size_t>(i)];
        if (choice_row(ui, field, choice.label, choice.value, field.text() == choice.value)) taken = choice.value;
    };
    const auto chosen = std::ranges::find(found, field.text(), &OfferedChoice::value);
    clipped_rows(ui, "offered", count, row, draw, chosen == found.end() ? 0 : static_cast<int>(chosen - found.begin()));
    if (scrolls) ImGui::EndChild();
    if (taken) {
        set_option(ui, field, *taken);
        ImGui::CloseCurrentPopup();
    }
    if (found.empty()) ImGui::TextDisabled("No match.");
    if (pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
}

void choice_field(Ui& ui, Imports& imports, const ImportField& field) {
    const float width = ImGui::CalcItemWidth();
    const std::string now = field.given() ? label_of(field, field.text()) : label_of_default(field);
    // As wide as the field, so that its entries are cut no earlier.
    ImGui::SetNextWindowSizeConstraints({width, 0}, {2 * width, ImGui::GetIO().DisplaySize.y});
    if (!begin_dropdown(ui, field.mark(), now, field.option.label, ImGuiComboFlags_HeightLargest)) return;
    offered_choices(ui, imports, field);
    ImGui::EndCombo();
}

void number_option(Ui& ui, const ImportField& field) {
    const std::optional<double> taken = field.offer ? parse_double(field.offer->taken) : std::nullopt;
    const std::optional<double> given = parse_double(field.text());
    const auto wanted = number_field(ui, {.mark = field.mark(),
                                          .what = field.option.label,
                                          .now = given.value_or(taken.value_or(kFirstNumber)),
                                          .before = given ? "" : "auto: ",
                                          .unit = field.option.unit,
                                          .instead = given || taken ? "" : label_of_default(field),
                                          .by_factors = true});
    if (wanted) set_option(ui, field, formatted("%.6g", *wanted));
}

void trim_field(Ui& ui, Imports& imports, const ImportField& field) {
    const double seconds = imports.edited.offer ? imports.edited.offer->seconds : 0;
    const auto [begin, end] = field.clip.options.trim.value_or(std::pair(0.0, seconds));
    const float spacing = ui.px(6);
    const float width = (ImGui::CalcItemWidth() - spacing) / 2;
    const auto edge = [&](const char* which, const char* what, double now) {
        ImGui::SetNextItemWidth(width);
        const auto wanted = number_field(ui, {.mark = field.mark() + which,
                                              .what = what,
                                              .now = now,
                                              .unit = "s",
                                              .decimals = 3,
                                              .step = kTrimStep,
                                              .least = 0,
                                              .most = std::max(seconds, now)});
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s, in seconds from the file's first key", what);
        return wanted.value_or(now);
    };
    const double from = edge(".from", "Where it begins", begin);
    ImGui::SameLine(0, spacing);
    const double to = edge(".to", "Where it ends", end);
    if (from != begin || to != end) set_option(ui, field, formatted("%.6g %.6g", from, to));
}

/// Why the file alone leads to what is taken, what looks wrong with it, and what was refused.
void field_remarks(Ui& ui, Imports& imports, const ImportField& field, float left) {
    const auto line = [&](ImU32 color, const std::string& text) {
        ImGui::SetCursorPosX(left);
        words(color, text);
    };
    ImGui::PushFont(ui.style.caption);
    if (field.offer && !field.offer->why.empty() && !(field.offer->required && field.given())) {
        const std::string taken = field.offer->taken.empty() ? "" : field.offer->taken + ", ";
        // Of what is automatic the value stands in the field.
        line(field.offer->required ? ui.style.warning : ui.style.quiet,
             field.given() ? "automatic: " + taken + field.offer->why : field.offer->why);
    }
    for (const ImportWarning& warning : field.clip.facts.warnings) {
        // An assumption stands there already, as the reason.
        if (warning.option != field.option.key || (field.offer && field.offer->why == warning.text)) continue;
        line(ui.style.warning, "! " + said(warning));
        ui.mark(field.mark() + ".warning");
    }
    const auto refused = imports.edited.refused.find(field.option.key);
    if (refused != imports.edited.refused.end()) {
        line(ui.style.error, "\u00D7 " + refused->second.text + ": " + refused->second.why);
        ui.mark(field.mark() + ".error");
    }
    ImGui::PopFont();
}

void import_field(Ui& ui, Imports& imports, const ImportField& field) {
    ClipImport& now = imports.edited;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool asked_for = now.field == field.option.key;
    ImGui::PushID(field.option.key);
    // What is said of a field stands close to it.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), ui.px(2)});
    form_label(ui, field.option.label, field.option.help);
    const float left = ImGui::GetCursorPosX();
    const float reset = button_width("reset") + ui.px(6);
    ImGui::SetNextItemWidth(-reset);
    if (field.option.key == std::string_view("trim")) {
        trim_field(ui, imports, field);
    } else if (field.option.is_number() && (!field.offer || field.offer->choices.empty())) {
        number_option(ui, field);
    } else if (field.option.key == std::string_view("columns")) {
        if (const std::optional<std::string> typed = text_edit(ui, field.mark(), field.text()))
            set_option(ui, field, *typed);
    } else {
        choice_field(ui, imports, field);
    }
    if (field.given() && !(field.offer && field.offer->required)) {
        ImGui::SameLine(0, ui.px(6));
        if (ImGui::Button("reset")) set_option(ui, field, "");
        ui.mark(field.mark() + ".reset");
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("As the file says");
    }
    field_remarks(ui, imports, field, left);
    ImGui::PopStyleVar();
    ImGui::Dummy({0, ui.px(1)});
    ImGui::PopID();
    if (!asked_for) return;
    const ImVec2 from{corner.x - ui.px(4), corner.y - ui.px(3)};
    const ImVec2 to{from.x + ImGui::GetContentRegionAvail().x + ui.px(8), ImGui::GetItemRectMax().y + ui.px(2)};
    ImGui::GetWindowDrawList()->AddRect(from, to, ui.style.accent, ui.px(4), 0, ui.px(1));
    if (now.scroll) {
        // The field is laid out in this frame, and the list's length is known in the next.
        ImGui::SetScrollFromPosY(corner.y - ImGui::GetWindowPos().y, 0.3f);
        if (!ImGui::IsWindowAppearing()) now.scroll = false;
        ui.want_frame_in(0);
    }
}

/// A clip of the scene to go on with.
void clip_chooser(Ui& ui, int index) {
    const auto& clips = ui.workspace.scene().clips;
    form_label(ui, "Clip", "Which clip of the scene");
    if (!begin_dropdown(ui, "import.clip", clips[static_cast<std::size_t>(index)].name, "Clip")) return;
    const auto draw = [&](int i) {
        const SceneClip& clip = clips[static_cast<std::size_t>(i)];
        ImGui::PushID(i);
        ImGui::BeginDisabled(!clip.source);
        if (ImGui::Selectable(clip.name.c_str(), i == index)) ui.invoke("clip.import", clip.name);
        ImGui::EndDisabled();
        ImGui::PopID();
        ui.mark("import.clip." + std::to_string(i), OwnKeys::none, clip.name);
        if (i == index) ui.focus.begin_here();
    };
    clipped_rows(ui, "clips", static_cast<int>(clips.size()), ImGui::GetTextLineHeightWithSpacing(), draw, index);
    if (pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
    ImGui::EndCombo();
}

void whole_file(Ui& ui, Imports& imports, int index) {
    const std::size_t clips = clips_of_same_source(ui.workspace.scene(), index).size();
    if (clips < 2) return;
    ImGui::Checkbox(("for all " + std::to_string(clips) + " clips of this file").c_str(), &imports.edited.whole_file);
    ui.mark("import.whole_file");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip(
            "Root, unit, up axis, rate, origin, radius, frame time and motion change for all of them at once");
    }
}

void fields(Ui& ui, Imports& imports, const SceneClip& clip, int index) {
    const ClipImport& now = imports.edited;
    if (ui.workspace.scene().clips.size() > 1) clip_chooser(ui, index);
    whole_file(ui, imports, index);
    if (!now.offer) {
        words(now.unreadable.empty() ? ui.style.quiet : ui.style.error,
              now.unreadable.empty() ? "Reading the file..." : now.unreadable);
        return;
    }
    std::vector<std::string_view> shown;
    for (const ImportOption& option : kImportOptions) {
        const ImportField field{option, now.offer->find(option.key), clip};
        if (!field.offer && !field.given()) continue;
        shown.push_back(option.key);
        import_field(ui, imports, field);
    }
    for (const ImportWarning& warning : clip.facts.warnings) {
        if (std::ranges::find(shown, warning.option) == shown.end()) words(ui.style.warning, "! " + said(warning));
    }
}

std::string said_of(const SceneClip& clip) {
    const SourceFacts& facts = clip.facts;
    const std::string format =
        std::filesystem::path(*clip.source).extension() == '.' + facts.format ? "" : " (" + facts.format + ")";
    return *clip.source + format + ": " + counted(facts.frames, "frame", "frames") + " over " +
           formatted("%.2f s", facts.duration) +
           (facts.joints > 0 ? ", " + counted(facts.joints, "joint", "joints") : std::string());
}

}  // namespace

void import_dialog(Ui& ui, Imports& imports) {
    const int index = imports.edited.clip;
    const auto& clips = ui.workspace.scene().clips;
    const bool is_there = index >= 0 && static_cast<std::size_t>(index) < clips.size();
    if (!is_there || !clips[static_cast<std::size_t>(index)].source) {
        ui.later(&Dialogs::close);  // the clip, or that it has a file, was undone
        return;
    }
    const SceneClip& clip = clips[static_cast<std::size_t>(index)];
    const bool keys_are_taken = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup) || ImGui::GetIO().WantTextInput;
    begin_dialog(ui, "import", {980, 650});
    text_line(ui.style.text, "Import " + clip.name, ui.style.title);
    ImGui::SameLine(0, ui.px(14));
    ImGui::AlignTextToFramePadding();
    words(ui.style.quiet, said_of(clip));
    const float buttons = ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().ItemSpacing.y + ui.px(2);
    const float height = ImGui::GetContentRegionAvail().y - buttons;
    const float left = std::min(ui.px(kFieldsWidth), 0.48f * ImGui::GetContentRegionAvail().x);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(2)});
    ImGui::PushID(index);  // what is half typed into a field is no other clip's
    ImGui::BeginChild("fields", {left, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    fields(ui, imports, clip, index);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("preview", {0, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    import_preview(ui, imports, clip);
    ImGui::EndChild();
    ImGui::PopID();
    ImGui::PopStyleVar();
    ImGui::Dummy({0, ui.px(2)});
    command_button(ui, "Undo", "edit.undo", "import.undo");
    ImGui::SameLine();
    command_button(ui, "Redo", "edit.redo", "import.redo");
    ImGui::SameLine();
    const float close = button_width("Close");
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - close);
    if (marked_button(ui, "Close", "import.close", true) || (pressed(ImGuiKey_Enter) && !keys_are_taken)) {
        ui.later(&Dialogs::close);
    }
    end_dialog();
}

}  // namespace mobbscope::app
