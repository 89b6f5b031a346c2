#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/parts/node_boxes.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <cmath>

namespace mobbscope::app {

namespace {

/// How a choice is called in the panel, and what it means.
struct ChoiceWords {
    std::string label;
    std::string help;
};

ChoiceWords choice_words(mobb::TreeKind kind) {
    return {std::string(mobb::info(kind).label), std::string(mobb::info(kind).help)};
}

ChoiceWords choice_words(mobb::Axes axes) {
    const auto help = [&] {
        switch (axes) {
            case mobb::Axes::endpoints:
                return "Along first to last sample: the paper's";
            case mobb::Axes::covariance:
                return "Principal axes of the centres";
            case mobb::Axes::minarea:
                return "Smallest area or volume found";
        }
        return "";
    };
    return {std::string(mobb::name(axes)), help()};
}

ChoiceWords choice_words(ColorBy color_by) {
    return color_by == ColorBy::level ? ChoiceWords{"level", "Boxes by their level, from dark to bright"}
                                      : ChoiceWords{"agent", "Boxes in their agent's colour"};
}

/// The choices of a command, which are those of an enumeration in its order.
template <class Enum>
void choose(Ui& ui, const char* label, const char* id, Enum now, const char* help) {
    form_label(ui, label, help);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::CalcItemWidth(), ImGui::GetFrameHeight()};
    const bool open = ImGui::BeginCombo((std::string("##") + id).c_str(), choice_words(now).label.c_str());
    // Once it is open the last item is of its list.
    ui.marks.add(id, {{corner.x, corner.y}, {corner.x + size.x, corner.y + size.y}});
    if (!open) return;
    int index = 0;
    for (const std::string& choice : find_command(id)->choices(ui.session)) {
        const auto value = static_cast<Enum>(index++);
        const ChoiceWords words = choice_words(value);
        if (ImGui::Selectable(words.label.c_str(), value == now)) invoke(ui.session, id, choice);
        ui.mark(std::string(id) + "." + choice);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", words.help.c_str());
    }
    ImGui::EndCombo();
}

/// A whole number with buttons; what is typed counts when it is done.
void whole(Ui& ui, const char* label, const char* command, int now, int least, const char* help) {
    form_label(ui, label, help);
    ImGui::PushFont(ui.style.mono);
    int value = now;
    ImGui::InputInt((std::string("##") + command).c_str(), &value, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopFont();
    ui.mark(command);
    if (value != now && value >= least) invoke(ui.session, command, std::to_string(value));
}

void time_scale(Ui& ui) {
    const mobb::FitOptions& fit = ui.session.fitted().options();
    form_label(ui, "Time scale", "Metres per second that mix time with space in free boxes (w); no other boxes use it");
    ImGui::BeginDisabled(!mobb::info(fit.tree).uses_time_scale());
    ImGui::PushFont(ui.style.mono);
    double value = fit.time_scale;
    const double least = 1 / mobb::kMaxTimeScale;
    const double most = mobb::kMaxTimeScale;
    const bool changed = ImGui::DragScalar("##tree.time_scale", ImGuiDataType_Double, &value, 0.01f, &least, &most,
                                           "%.3g m/s", ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopFont();
    ImGui::EndDisabled();
    ui.mark("tree.time_scale");
    if (changed && std::isfinite(value)) invoke(ui.session, "tree.time_scale", short_double(value));
}

constexpr float kLeastCell = 10.5f;  // pixels at scale 1: a level's number

/// Which levels are drawn: a cell for each, lit where it is. A click shows one level, a drag or Shift a range.
void shown_levels(Ui& ui, int depth) {
    const LevelRange shown = ui.session.view().levels;
    form_label(ui, "Show", "Which boxes are drawn: click a level; drag over several, or Shift-click, for a range");
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const float leaves = ImGui::CalcTextSize("leaves").x + 2 * padding.x;
    // A tiny window may leave none; ImGui takes no button of no width.
    const float room = std::max(1.0f, ImGui::GetContentRegionAvail().x);
    const bool beside = (room - leaves - ui.px(6)) / static_cast<float>(depth) >= ui.px(kLeastCell);
    const ImVec2 size{beside ? room - leaves - ui.px(6) : room, ImGui::GetFrameHeight()};
    ImGui::InvisibleButton("##levels", size);
    ui.mark("view.level");
    const float cell = size.x / static_cast<float>(depth);
    const auto level_at = [&](float x) { return std::clamp(static_cast<int>((x - corner.x) / cell), 0, depth - 1); };
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive()) {
        const int here = level_at(io.MousePos.x);
        const int from = io.KeyShift && !shown.leaves ? shown.first : level_at(io.MouseClickedPos[0].x);
        const LevelRange wanted{std::min(from, here), std::max(from, here), false};
        if (wanted != shown) invoke(ui.session, "view.level", to_string(wanted));
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, ui.style.window, ui.px(4));
    const int over = ImGui::IsItemHovered() ? level_at(io.MousePos.x) : -1;
    for (int level = 0; level < depth; ++level) {
        const ImVec2 min{corner.x + cell * static_cast<float>(level) + 1, corner.y + 1};
        const ImVec2 max{corner.x + cell * static_cast<float>(level + 1) - 1, corner.y + size.y - 1};
        const bool lit = !shown.leaves && !ui.session.view().query && level >= std::min(shown.first, depth - 1) &&
                         level <= shown.last;
        if (lit || level == over)
            draw.AddRectFilled(min, max, lit ? to_im(with_alpha(ui.style.palette.accent, 0.45f)) : ui.style.raised,
                               ui.px(3));
        const std::string label = std::to_string(level);
        const ImFont& mono = *ui.style.mono;
        const ImVec2 text = text_size(mono, label);
        // Of very deep trees only the cells remain.
        if (text.x > cell) continue;
        draw_text(draw, mono, {0.5f * (min.x + max.x - text.x), 0.5f * (min.y + max.y - text.y)},
                  lit ? ui.style.text : ui.style.quiet, label);
    }
    draw.AddRect(corner, {corner.x + size.x, corner.y + size.y}, ui.style.border, ui.px(4));
    if (beside) {
        ImGui::SameLine(0, ui.px(6));
    } else {
        ImGui::SetCursorScreenPos({corner.x, ImGui::GetCursorScreenPos().y});
    }
    const bool on = shown.leaves && !ui.session.view().query;
    ImGui::PushStyleColor(ImGuiCol_Button, on ? to_im(with_alpha(ui.style.palette.accent, 0.45f)) : ui.style.window);
    if (ImGui::Button("leaves")) invoke(ui.session, "view.leaves");
    ImGui::PopStyleColor();
    ui.mark("view.leaves");
}

/// The tree that the bars are about: of what is selected, else the first that is seen.
int clip_in_focus(const Session& session) {
    if (session.selection.kind == Selection::Kind::clip) return session.selection.index;
    if (session.selection.on_path()) {
        if (const auto who = placed_agent_of(session.fitted(), session.selection.path)) return who->clip;
    }
    return session.fitted().placed_agents().front().clip;
}

/// Volume of each level as a bar, and how much of it the disks fill.
void level_bars(Ui& ui, int clip) {
    const Session& session = ui.session;
    const auto& figures = session.figures_of(clip);
    if (!section(ui, "VOLUME BY LEVEL", session.scene().clips[static_cast<std::size_t>(clip)].name)) return;
    // Free boxes may take more room the finer they are: their fits overlap.
    double most = 1e-300;
    for (const mobb::LevelFigures& level : figures) most = std::max(most, level.volume);
    const ImFont& mono = *ui.style.mono;
    const float height = ui.px(18);
    const auto draw_row = [&](int i) {
        const mobb::LevelFigures& level = figures[static_cast<std::size_t>(i)];
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x);
        const bool clicked = ImGui::InvisibleButton(("level" + std::to_string(i)).c_str(), {width, height});
        ui.mark("level." + std::to_string(i));
        const bool over = ImGui::IsItemHovered();
        const LevelRange shown = session.view().levels;
        const bool drawn =
            !shown.leaves && !session.view().query && level.level >= shown.first && level.level <= shown.last;
        const bool large = level.volume >= 100 && level.volume < 1e6;
        const char* format = large ? (level.tightness ? "%.0f  %3.0f%%" : "%.0f      ")
                                   : (level.tightness ? "%.3g  %3.0f%%" : "%.3g      ");
        const std::string text = formatted(format, level.volume, 100 * level.tightness.value_or(0));
        const float label = ui.px(26);
        const float figure = text_size(mono, "000000  100%").x;
        const float room = std::max(ui.px(20), width - label - figure - ui.px(8));
        const float long_bar = room * static_cast<float>(level.volume / most);
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const float y0 = corner.y + ui.px(3);
        const float y1 = corner.y + height - ui.px(3);
        const ImVec2 start{corner.x + label, y0};
        const float text_y = corner.y + 0.5f * (height - mono.FontSize);
        draw_text(draw, mono, {corner.x, text_y}, drawn || over ? ui.style.text : ui.style.quiet,
                  "L" + std::to_string(level.level));
        const Rgba accent = ui.style.palette.accent;
        draw.AddRectFilled(start, {start.x + std::max(ui.px(1), long_bar), y1},
                           to_im(with_alpha(accent, drawn || over ? 0.55f : 0.3f)), ui.px(2));
        // The filled part is what the disks take of the boxes.
        draw.AddRectFilled(start, {start.x + long_bar * static_cast<float>(level.tightness.value_or(0)), y1},
                           to_im(accent), ui.px(2));
        draw_text(draw, mono, {corner.x + width - text_size(mono, text).x, text_y}, ui.style.quiet, text);
        if (clicked) invoke(ui.session, "view.level", std::to_string(level.level));
        if (over) {
            std::string figures_of_level;
            for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
                figures_of_level += std::string(column.key) + ' ' + level_text(column, level) +
                                    (*column.unit != '\0' ? " " : "") + column.unit + '\n';
            }
            ImGui::SetTooltip("%sclick to show this level", figures_of_level.c_str());
        }
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    for (int i = 0; i < static_cast<int>(figures.size()); ++i) draw_row(i);
    ImGui::PopStyleVar();
    words(ui.style.quiet, "m\u00B2\u00B7s, and how full of disks");
}

/// How the trees are fitted, and which of their boxes are shown.
void fit_fields(Ui& ui) {
    const Session& session = ui.session;
    const mobb::FitOptions fit = session.fitted().options();
    choose(ui, "Kind", "tree.kind", fit.tree, "What bounds the disks");
    whole(ui, "Leaf samples", "tree.leaf", fit.leaf, 1, "n_min: a node of at most so many samples is a leaf");
    ImGui::BeginDisabled(!mobb::info(fit.tree).chooses_axes());
    choose(ui, "Axes", "tree.axes", fit.axes, "How boxes are turned");
    ImGui::EndDisabled();
    whole(ui, "Levels", "tree.levels", fit.levels, 0, "0: all; 1 is the paper's \"1 level\" tree");
    time_scale(ui);
    shown_levels(ui, session.fitted().tree(clip_in_focus(session)).depth());
    choose(ui, "Colour by", "view.color_by", session.view().color_by, "What the boxes' colours mean");
}

}  // namespace

void tree_panel(Ui& ui) {
    const Session& session = ui.session;
    if (session.empty()) return;
    ImGui::PushID("tree");
    if (section(ui, "TREE")) fit_fields(ui);
    level_bars(ui, clip_in_focus(session));
    ImGui::PopID();
}

}  // namespace mobbscope::app
