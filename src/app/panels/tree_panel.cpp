#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/panels.h>
#include <app/ui/value_histogram.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/drawlist/color_scale.h>

#include <algorithm>
#include <limits>
#include <utility>

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
    const std::string label = title_of_choice(*find_command("view.color_by"), std::string(name(color_by)));
    const NodeFieldInfo* field = color_figure(color_by);
    if (!field) return {label, "Boxes in their agent's colour"};
    return {label,
            std::string(field->doc) + (field->field == NodeField::level ? "" : ". What stands out most is worst")};
}

/// The choices are in groups: what begins one.
bool begins_group(ColorBy color_by) { return color_by == ColorBy::volume || color_by == ColorBy::share; }
template <class Enum>
bool begins_group(Enum) {
    return false;
}

/// The choices of a command, which are those of an enumeration in its order.
template <class Enum>
void choose(Ui& ui, const char* label, const char* id, Enum now, const char* help) {
    form_label(ui, label, help);
    if (!begin_dropdown(ui, id, choice_words(now).label, label)) return;
    int index = 0;
    for (const std::string& choice : find_command(id)->choices(ui.session)) {
        const auto value = static_cast<Enum>(index++);
        const ChoiceWords words = choice_words(value);
        if (begins_group(value)) ImGui::Separator();
        if (ImGui::Selectable(words.label.c_str(), value == now)) ui.invoke(id, choice);
        ui.mark(std::string(id) + "." + choice, OwnKeys::none, words.label);
        if (value == now) ui.focus.begin_here();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", words.help.c_str());
    }
    ImGui::EndCombo();
}

/// A whole number. While fits take long it counts once the drag is over.
void whole(Ui& ui, Jobs& jobs, const char* label, const char* command, const char* what, int now, int least,
           const char* help) {
    form_label(ui, label, help);
    const auto wanted = number_field(ui, {.mark = command,
                                          .what = what,
                                          .now = static_cast<double>(now),
                                          .least = static_cast<double>(least),
                                          .most = std::numeric_limits<int>::max(),
                                          .live = !jobs.job()});
    if (wanted) ui.invoke(command, formatted("%.0f", *wanted));
}

void time_scale(Ui& ui, Jobs& jobs) {
    const mobb::FitOptions& fit = ui.workspace.fitted().options();
    form_label(ui, "Time scale", "Metres per second that mix time with space in free boxes (w); no other boxes use it");
    ImGui::BeginDisabled(!mobb::info(fit.tree).uses_time_scale());
    const auto wanted = number_field(ui, {.mark = "tree.time_scale",
                                          .what = "The time scale",
                                          .now = fit.time_scale,
                                          .unit = "m/s",
                                          .least = 1 / mobb::kMaxTimeScale,
                                          .most = mobb::kMaxTimeScale,
                                          .by_factors = true,
                                          .live = !jobs.job()});
    ImGui::EndDisabled();
    if (wanted) ui.invoke("tree.time_scale", format_double(*wanted));
}

/// Left and Right go to the next level; with Shift they make a range longer or shorter.
void level_keys(Ui& ui, int depth) {
    LevelRange wanted = ui.workspace.view().levels;
    for (const Chord& chord : ui.focus.take("view.level")) {
        if (chord.key == Key::enter) continue;
        const int way = chord.key == Key::right ? 1 : -1;
        const int last = wanted.leaves ? depth : std::min(wanted.last, depth - 1);
        const int next = std::clamp(last + way, 0, depth - 1);
        wanted = {chord.shift && !wanted.leaves ? std::min(wanted.first, next) : next, next, false};
    }
    if (wanted != ui.workspace.view().levels) ui.invoke("view.level", to_string(wanted));
}

/// A cell for each level, as wide as its number at least: in as many lines as that takes.
class LevelCells {
  public:
    LevelCells(ImVec2 corner, float width, float least, int depth)
        : corner_(corner), width_(width), height_(ImGui::GetFrameHeight()), depth_(depth) {
        const int most = std::clamp(static_cast<int>(width / least), 1, depth);
        lines_ = (depth + most - 1) / most;
        in_line_ = (depth + lines_ - 1) / lines_;
    }

    ImVec2 size() const { return {width_, height_ * static_cast<float>(lines_)}; }
    std::pair<ImVec2, ImVec2> place_of(int level) const {
        const int line = level / in_line_;
        const float x = corner_.x + cell() * static_cast<float>(level % in_line_);
        const float y = corner_.y + height_ * static_cast<float>(line);
        return {{x + 1, y + 1}, {x + cell() - 1, y + height_ - 1}};
    }
    int level_at(ImVec2 at) const {
        const int column = std::clamp(static_cast<int>((at.x - corner_.x) / cell()), 0, in_line_ - 1);
        const int line = std::clamp(static_cast<int>((at.y - corner_.y) / height_), 0, lines_ - 1);
        return std::min(line * in_line_ + column, depth_ - 1);
    }

  private:
    float cell() const { return width_ / static_cast<float>(in_line_); }

    ImVec2 corner_;
    float width_, height_;
    int depth_;
    int lines_ = 1, in_line_ = 1;
};

/// Which levels are drawn: a cell for each, lit where it is. A click shows one level, a drag or Shift a range.
void shown_levels(Ui& ui, int depth) {
    const LevelRange shown = ui.workspace.view().levels;
    form_label(ui, "Show", "Which boxes are drawn: click a level; drag over several, or Shift-click, for a range");
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 padding = ImGui::GetStyle().FramePadding;
    const float leaves = ImGui::CalcTextSize("leaves").x + 2 * padding.x;
    // A tiny window may leave none; ImGui takes no button of no width.
    const float room = std::max(1.0f, ImGui::GetContentRegionAvail().x);
    const float beside = room - leaves - ui.px(6);
    const ImFont& mono = *ui.style.mono;
    const float least = text_size(mono, std::to_string(depth - 1)).x + ui.px(3);
    const bool in_one_line = least * static_cast<float>(depth) <= beside;
    const LevelCells cells(corner, in_one_line ? beside : room, least, depth);
    ImGui::InvisibleButton("##levels", cells.size());
    ui.mark("view.level", OwnKeys::left_right);
    level_keys(ui, depth);
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive()) {
        const int here = cells.level_at(io.MousePos);
        const int from = io.KeyShift && !shown.leaves ? shown.first : cells.level_at(io.MouseClickedPos[0]);
        const LevelRange wanted{std::min(from, here), std::max(from, here), false};
        if (wanted != shown) ui.invoke("view.level", to_string(wanted));
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + cells.size().x, corner.y + cells.size().y};
    draw.AddRectFilled(corner, end, ui.style.window, ui.px(4));
    const int over = ImGui::IsItemHovered() ? cells.level_at(io.MousePos) : -1;
    for (int level = 0; level < depth; ++level) {
        const auto [min, max] = cells.place_of(level);
        ui.marks.add("view.level." + std::to_string(level), {{min.x, min.y}, {max.x, max.y}});
        const bool lit = !shown.leaves && !ui.workspace.view().query && level >= std::min(shown.first, depth - 1) &&
                         level <= shown.last;
        if (lit || level == over)
            draw.AddRectFilled(min, max, lit ? to_im(with_alpha(ui.style.palette.accent, 0.45f)) : ui.style.raised,
                               ui.px(3));
        const std::string label = std::to_string(level);
        const ImVec2 text = text_size(mono, label);
        draw_text(draw, mono, {0.5f * (min.x + max.x - text.x), 0.5f * (min.y + max.y - text.y)},
                  lit ? ui.style.text : ui.style.quiet, label);
    }
    draw.AddRect(corner, end, ui.style.border, ui.px(4));
    if (in_one_line) {
        ImGui::SameLine(0, ui.px(6));
    } else {
        ImGui::SetCursorScreenPos({corner.x, ImGui::GetCursorScreenPos().y});
    }
    const bool on = shown.leaves && !ui.workspace.view().query;
    ImGui::PushStyleColor(ImGuiCol_Button, on ? to_im(with_alpha(ui.style.palette.accent, 0.45f)) : ui.style.window);
    if (ImGui::Button("leaves")) ui.invoke("view.leaves");
    ImGui::PopStyleColor();
    ui.mark("view.leaves");
}

/// Of a figure that has to be counted and is not: a button that does.
void count_figure(Ui& ui, NodeField field) {
    const bool blame = field == NodeField::avoidable;
    if (!blame && field != NodeField::tests) return;
    if (ui.workspace.fitted().queries().empty()) return;
    const char* help = blame ? "Asks all queries of the scene, and whom to blame for avoidable overlaps"
                             : "Asks all queries of the scene, and counts the tests of each box";
    if (!small_button(ui, "Count them", "view.color_by.count", help)) return;
    if (blame) return ui.invoke("query.blame");
    ui.later([](CostInspector& costs) { costs.count(); });
}

/// How the figures of the boxes in the picture are spread, and the range of the colours.
void figures_of_boxes(Ui& ui, BoxFigures& kept) {
    const std::shared_ptr<const BoxColors>& boxes = ui.session.figures.boxes();
    if (!boxes) return;
    const ColorScale& scale = boxes->scale;
    if (!scale.known) {
        words(ui.style.quiet, scale.figure.title + ": " + boxes->unknown);
        return count_figure(ui, color_figure(ui.workspace.view().color_by)->field);
    }
    if (kept.of != boxes) {
        constexpr int kBars = 48;
        kept.of = boxes;
        // The bar has room for all values that colours are spread over, and for both ends.
        ColoredFigure figure = scale.figure;
        figure.whole_range = true;
        std::vector<double> all = boxes->range;
        all.insert(all.end(), boxes->values.begin(), boxes->values.end());
        all.insert(all.end(), {scale.least, scale.most});
        kept.whole = color_scale(figure, all);
        kept.counts = value_counts(kept.whole, boxes->values, kBars);
    }
    const ColorScale& whole = kept.whole;
    const HistogramChange change =
        value_histogram(ui,
                        {.mark = "view.color_range",
                         .counts = kept.counts,
                         .color = [&](float place) { return scale.color(whole.value_at(place), ui.style.palette); },
                         .from = whole.share(scale.least),
                         .to = whole.share(scale.most),
                         .at = [&](float place) { return whole.text(whole.value_at(place)); },
                         .from_text = scale.text(scale.least),
                         .to_text = scale.text(scale.most),
                         .chosen = scale.chosen},
                        std::max(1.0f, ImGui::GetContentRegionAvail().x));
    if (change.kind == HistogramChange::Kind::automatic) ui.invoke("view.color_range", "auto");
    if (change.kind != HistogramChange::Kind::dragged) return;
    // The end that stays keeps its value. One that nobody chose takes in the outliers that it left out: they would
    // fade.
    const auto [from, to] = change.ends;
    const auto shown = [&](double value) {
        return *parse_double(figure((scale.figure.unit == "%" ? 100 : 1) * value));
    };
    const double least = from != whole.share(scale.least) ? whole.value_at(from)
                         : scale.chosen                   ? scale.least
                                                          : whole.least;
    const double most = to != whole.share(scale.most) ? whole.value_at(to) : scale.chosen ? scale.most : whole.most;
    ui.invoke("view.color_range", to_string(ValueRange{shown(least), shown(most)}));
}

/// How the trees are fitted, and which of their boxes are shown.
void fit_fields(Ui& ui, Jobs& jobs, BoxFigures& boxes) {
    const mobb::FitOptions fit = ui.workspace.fitted().options();
    choose(ui, "Kind", "tree.kind", fit.tree, "What bounds the disks");
    ImGui::BeginDisabled(!mobb::info(fit.tree).splits());
    whole(ui, jobs, "Leaf samples", "tree.leaf", "The number of samples of a leaf", fit.leaf, 1,
          "n_min: a node of at most so many samples is a leaf");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!mobb::info(fit.tree).chooses_axes());
    choose(ui, "Axes", "tree.axes", fit.axes, "How boxes are turned");
    ImGui::EndDisabled();
    ImGui::BeginDisabled(!mobb::info(fit.tree).splits());
    whole(ui, jobs, "Levels", "tree.levels", "The number of levels", fit.levels, 0,
          "0: all; 1 is the paper's \"1 level\" tree");
    ImGui::EndDisabled();
    time_scale(ui, jobs);
    shown_levels(ui, ui.workspace.fitted().tree(clip_in_focus(ui.workspace)).depth());
    choose(ui, "Colour by", "view.color_by", ui.workspace.view().color_by, "What the boxes' colours mean");
    figures_of_boxes(ui, boxes);
}

}  // namespace

void tree_panel(Ui& ui, Jobs& jobs, QueryInspector& queries, FitCosts& costs, FitNotices& notices, BoxFigures& boxes) {
    if (ui.workspace.empty()) return;
    ImGui::PushID("tree");
    if (section(ui, "TREE")) fit_fields(ui, jobs, boxes);
    cost_section(ui, queries, costs, clip_in_focus(ui.workspace));
    findings_panel(ui, notices, clip_in_focus(ui.workspace));
    ImGui::PopID();
}

}  // namespace mobbscope::app
