// The views of the scene side by side, with titles that compare their fits.
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/compared_fits.h>
#include <explain/query_progress.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// A part of a line, green where it is the best of all views.
struct Told {
    std::string text;
    bool best = false;
};

bool is_best_at(const ComparedFigure& figure, std::size_t place) { return figure.best == static_cast<int>(place); }

/// "MOBB, leaf 10"
std::string title_of_view(const ComparedFits& fits, std::size_t place, const mobb::FitOptions& fit) {
    std::string out = fits.names[place];
    const bool says_leaf = out.find(", leaf ") != std::string::npos;
    if (mobb::info(fit.tree).splits() && !says_leaf) out += ", leaf " + std::to_string(fit.leaf);
    return out;
}

/// A line, and shorter ones for where it has no room.
using Lines = std::vector<std::vector<Told>>;

/// "level 7: 262 m2s, fill 47 %, 938 ns", of the clip in focus.
Lines told_of_level(const ComparedFits& fits, std::size_t place, const LevelRange& shown) {
    const auto has_level = [&](const ComparedLevel& level) { return level.volume.values[place].has_value(); };
    const int depth = static_cast<int>(std::ranges::count_if(fits.levels, has_level));
    const int last = std::min(shown.last, depth - 1);
    const ComparedLevel& level = shown.leaves ? fits.leaves : fits.levels[static_cast<std::size_t>(last)];
    const std::optional<double> volume = level.volume.values[place], fill = level.fill.values[place];
    const std::optional<double> cost = fits.cost.values[place];
    const auto line = [&](const char* at, const char* unit, const char* filled) {
        std::vector<Told> out{{shown.leaves ? "leaves:" : at + std::to_string(last) + ':'}};
        if (volume) out.push_back({figure(*volume, 3) + unit, is_best_at(level.volume, place)});
        if (fill) out.push_back({filled + formatted("%.0f %%", 100 * *fill), is_best_at(level.fill, place)});
        if (cost) out.push_back({figure(*cost, 3) + " ns", is_best_at(fits.cost, place)});
        return out;
    };
    return {line("level ", " m\u00B2\u00B7s", "fill "), line("L", " m\u00B2\u00B7s", ""), line("L", "", "")};
}

/// "step 12 of 53, 54 tests: miss"; `least`: no other view made as few.
Lines told_of_query(const SceneView& seen, const RecordedQuery& recorded, bool least) {
    const int events = recorded.trace.size();
    const std::vector<Told> answer{{counted(recorded.tests.all(), "test", "tests"), least},
                                   {recorded.contact ? "hit" : "miss"}};
    if (events == 0) return {answer};
    const int step = event_of(seen.view.step, recorded.trace, *seen.fitted, *seen.view.query);
    std::vector<Told> whole{{"step " + std::to_string(step) + " of " + std::to_string(events - 1)}};
    whole.insert(whole.end(), answer.begin(), answer.end());
    return {whole, answer};
}

/// The parts as they stand one behind the other.
std::vector<std::string> parts_of_line(const std::vector<Told>& told) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < told.size(); ++i) {
        const bool last = i + 1 == told.size();
        out.push_back(told[i].text + (last || told[i].text.ends_with(':') ? "" : ","));
    }
    return out;
}

void kinds_menu(Ui& ui, std::size_t place, mobb::TreeKind now) {
    const std::string mark = "view.fit." + std::to_string(place);
    if (ImGui::ArrowButton("##fit", ImGuiDir_Down)) ImGui::OpenPopup("fits");
    ui.mark(mark);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Show other trees here");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(8), ui.px(8)});
    if (ImGui::BeginPopup("fits")) {
        for (const mobb::TreeKind kind : mobb::kTreeKinds) {
            const std::string name(mobb::name(kind)), label(mobb::info(kind).label);
            if (ImGui::MenuItem(label.c_str(), nullptr, kind == now)) {
                ui.later([place, name](Session& session) {
                    session.views.activate(place);
                    run_command(session, "tree.kind", name);
                });
            }
            std::string item = mark;
            item.append(1, '.').append(name);
            ui.mark(item, OwnKeys::none, label);
        }
        ImGui::EndPopup();
    }
    ImGui::PopStyleVar();
}

float title_height(const Ui& ui) { return ui.style.body->FontSize + ui.style.mono->FontSize + ui.px(12); }

/// A click on it makes the view the active one.
void view_title(Ui& ui, std::size_t place, const SceneView& seen, const std::string& title, const Lines& lines) {
    const bool active = place == ui.session.views.active();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), title_height(ui)};
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    const float pad = ui.px(8), side = ui.px(18);
    const float buttons = 2 * side + ui.px(8);
    const float room = std::max(1.0f, size.x - buttons - pad);
    const bool pressed = ImGui::InvisibleButton("##title", {room, size.y});
    ui.mark("view.title." + std::to_string(place), OwnKeys::none, title);
    const bool hovered = ImGui::IsItemHovered();
    if (pressed) ui.later([place](Views& views) { views.activate(place); });
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, end, hovered ? ui.style.raised : ui.style.panel);
    draw.AddLine({corner.x, end.y - 1}, {end.x, end.y - 1}, ui.style.border);
    ImGui::PushFont(ui.style.body);
    draw_text(draw, *ui.style.body, {corner.x + pad, corner.y + ui.px(4)}, active ? ui.style.text : ui.style.quiet,
              fitted_text(title, room - pad));
    ImGui::PopFont();
    const ImFont& mono = *ui.style.mono;
    const ImU32 better = to_im(ui.style.palette.separated);
    const float below = corner.y + ui.px(7) + ui.style.body->FontSize;
    float x = corner.x + pad;
    std::string whole = title + '\n';
    for (const std::string& part : parts_of_line(lines.front())) whole.append(part).append(1, ' ');
    const auto fits = [&](const std::vector<Told>& told) {
        float width = pad;
        for (const std::string& part : parts_of_line(told)) width += text_size(mono, part + ' ').x;
        return width <= size.x;
    };
    const auto chosen = std::ranges::find_if(lines, fits);
    const std::vector<Told>& told = chosen == lines.end() ? lines.back() : *chosen;
    const std::vector<std::string> parts = parts_of_line(told);
    draw.PushClipRect(corner, end, true);
    for (std::size_t i = 0; i < told.size(); ++i) {
        draw_text(draw, mono, {x, below}, told[i].best ? better : active ? ui.style.text : ui.style.quiet, parts[i]);
        x += text_size(mono, parts[i] + ' ').x;
    }
    draw.PopClipRect();
    if (hovered) ImGui::SetTooltip("%s%s", whole.c_str(), active ? "" : "\n\nclick: panels and commands are about it");
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(2)});
    ImGui::SetCursorScreenPos({end.x - buttons, corner.y + ui.px(3)});
    kinds_menu(ui, place, seen.fitted->options().tree);
    ImGui::SetCursorScreenPos({end.x - side - ui.px(2), corner.y + ui.px(3)});
    if (ImGui::Button("\u00D7", {side, 0})) ui.invoke("view.close", std::to_string(place));
    ui.mark("view.close." + std::to_string(place));
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Close this view");
    ImGui::PopStyleVar();
    ImGui::SetCursorScreenPos({corner.x, end.y});
}

/// What the views have in common, each to be switched off.
void link_row(Ui& ui) {
    const ImGuiStyle& style = ImGui::GetStyle();
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(3), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(5), ui.px(2)});
    const std::string label = "linked";
    float width = ImGui::CalcTextSize(label.c_str()).x;
    for (const ViewLink& link : kViewLinks) width += style.ItemSpacing.x + button_width(std::string(link.name).c_str());
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, std::floor(0.5f * (room - width))));
    ImGui::AlignTextToFramePadding();
    text_line(ui.style.quiet, label);
    for (const ViewLink& link : kViewLinks) {
        ImGui::SameLine();
        const bool on = ui.workspace.document().links.*link.on;
        ImGui::PushStyleColor(ImGuiCol_Button, on ? ui.style.raised : IM_COL32_BLACK_TRANS);
        ImGui::PushStyleColor(ImGuiCol_Text, on ? ui.style.text : ui.style.quiet);
        const std::string name(link.name);
        command_button(ui, name.c_str(), link.command.data(), "link." + name);
        ImGui::PopStyleColor(2);
    }
    ImGui::PopStyleVar(2);
    ImGui::PopFont();
}

}  // namespace

void views_panel(Ui& ui, std::vector<Viewport>& viewports) {
    if (viewports.size() == 1 || ui.workspace.empty()) return viewports.front().draw(ui, 0);
    const ComparedFits& fits = ui.session.fit_costs.compared(clip_in_focus(ui.workspace));
    std::vector<SceneView> views;
    std::vector<const RecordedQuery*> recorded;
    for (std::size_t place = 0; place < viewports.size(); ++place) {
        views.push_back(ui.session.views.at(place));
        recorded.push_back(ui.workspace.crowd() ? nullptr : viewports[place].recorded_in(views.back()));
    }
    const auto makes_least = [&](std::size_t place) {
        const auto tests = [&](std::size_t at) {
            const bool same = recorded[at] && views[at].view.query == views[place].view.query;
            return same ? recorded[at]->tests.all() : std::numeric_limits<std::int64_t>::max();
        };
        for (std::size_t other = 0; other < views.size(); ++other) {
            if (other != place && tests(other) <= tests(place)) return false;
        }
        return true;
    };
    const ImVec2 corner = ImGui::GetCursorPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float line = std::max(1.0f, std::floor(ui.px(1)));
    const float links = ui.style.caption->FontSize + ui.px(8);
    const auto count = static_cast<float>(viewports.size());
    const ImVec2 size{std::floor((room.x - line * (count - 1)) / count), std::max(1.0f, room.y - links)};
    for (std::size_t place = 0; place < viewports.size(); ++place) {
        const SceneView& seen = views[place];
        ImGui::SetCursorPos({corner.x + static_cast<float>(place) * (size.x + line), corner.y});
        ImGui::BeginChild(("view " + std::to_string(place)).c_str(), size, false, ImGuiWindowFlags_NoBackground);
        view_title(ui, place, seen, title_of_view(fits, place, seen.fitted->options()),
                   recorded[place] ? told_of_query(seen, *recorded[place], makes_least(place))
                                   : told_of_level(fits, place, seen.view.levels));
        viewports[place].draw(ui, place);
        if (place == ui.session.views.active()) {
            const ImVec2 at = ImGui::GetWindowPos();
            ImGui::GetWindowDrawList()->AddRect(at, {at.x + size.x, at.y + size.y}, ui.style.accent);
        }
        ImGui::EndChild();
    }
    ImGui::SetCursorPos({corner.x, corner.y + size.y + ui.px(2)});
    link_row(ui);
}

}  // namespace mobbscope::app
