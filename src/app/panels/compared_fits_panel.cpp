// The fits of several views in one table: by level how tight they are and what a query costs.
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/compared_fits.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// As short as tells them apart: the kinds, or what stands behind them.
std::vector<std::string> short_fit_names(const ComparedFits& fits) {
    std::vector<std::string> kinds, rests;
    for (const std::string& name : fits.names) {
        const std::size_t comma = name.find(", ");
        kinds.push_back(name.substr(0, comma));
        rests.push_back(comma == std::string::npos ? name : name.substr(comma + 2));
    }
    const auto differ = [](const std::vector<std::string>& names) {
        return std::set<std::string>(names.begin(), names.end()).size() == names.size();
    };
    return differ(kinds) ? kinds : differ(rests) ? rests : fits.names;
}

std::string value_or_dash(const std::optional<double>& value) { return value ? figure(*value, 3) : "-"; }
std::string share_text(const std::optional<double>& value) { return value ? formatted("%.0f %%", 100 * *value) : "-"; }

/// "+12 %", "-28 %"; empty of the first fit, with which the others are compared.
std::string more_text(const ComparedFigure& of, std::size_t fit) {
    const std::optional<double> by = fit == 0 ? std::nullopt : of.difference(fit);
    if (!by) return "";
    const std::string text = formatted("%.0f", 100 * *by);
    return (*by > 0 && text != "0" ? "+" : "") + (text == "-0" ? "0" : text) + " %";
}

/// The columns as pixels from the left edge: where texts end, but for the name of a fit, which begins there.
struct FitColumns {
    float name = 0, name_end = 0, volume = 0, more = 0, fill = 0, bar = 0, bar_end = 0, cost = 0;
    // Only where names have room beside them.
    bool has_more = true;  ///< by how much volumes differ
    bool has_fill = true;

    FitColumns(const Ui& ui, float width, const std::vector<std::string>& names, const ComparedFits& fits)
        : cost(width) {
        const auto digits = [&](const char* text) { return text_size(*ui.style.mono, text).x; };
        float widest = 0;
        for (const std::string& each : names) widest = std::max(widest, text_size(*ui.style.body, each).x);
        const float gap = ui.px(7);
        float longest_volume = digits("00.00");
        for (const ComparedLevel& level : fits.levels) {
            for (const std::optional<double>& volume_of : level.volume.values)
                longest_volume = std::max(longest_volume, digits(value_or_dash(volume_of).c_str()));
        }
        name = digits("leaf") + gap;
        bar_end = width - digits("00.00") - gap;
        const auto place = [&] {
            volume = std::min(name + widest + ui.px(6) + longest_volume, bar_end);
            more = has_more ? volume + gap + digits("-100 %") : volume;
            fill = has_fill ? more + gap + digits("100 %") : more;
            bar = fill + gap;
        };
        place();
        has_more = bar <= bar_end;
        if (!has_more) place();
        has_fill = has_more || bar <= bar_end;
        if (!has_fill) place();
        name_end = volume - longest_volume - ui.px(4);
    }
    bool has_bar(const Ui& ui) const { return bar_end - bar > ui.px(16); }
};

class FitTable {
  public:
    FitTable(Ui& ui, const ComparedFits& fits)
        : ui_(ui),
          fits_(fits),
          names_(short_fit_names(fits)),
          at_(ui, std::max(1.0f, ImGui::GetContentRegionAvail().x), names_, fits) {
        for (const ComparedLevel& level : fits.levels) {
            for (const std::optional<double>& cost : level.cost.values)
                costliest_ = std::max(costliest_, cost.value_or(0));
        }
    }

    void draw() {
        headings();
        std::vector<const ComparedLevel*> levels;
        for (const ComparedLevel& level : fits_.levels) levels.push_back(&level);
        if (fits_.differ_in_depth()) levels.push_back(&fits_.leaves);
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ui_.px(3)});
        ui_.focus.begin_list(ImGui::GetID("compared levels"), static_cast<int>(levels.size()));
        for (int i = 0; i < static_cast<int>(levels.size()); ++i) {
            ui_.focus.row(i);
            level_rows(*levels[static_cast<std::size_t>(i)]);
        }
        ui_.focus.end_list();
        total_rows();
        ImGui::PopStyleVar();
    }

  private:
    float row_height() const { return ui_.px(16); }
    float height() const { return row_height() * static_cast<float>(names_.size()); }
    ImU32 better() const { return to_im(ui_.style.palette.separated); }

    void ending(ImVec2 corner, float right, ImU32 color, const std::string& text) const {
        const ImFont& mono = *ui_.style.mono;
        draw_text(*ImGui::GetWindowDrawList(), mono, {corner.x + right - text_size(mono, text).x, corner.y}, color,
                  text);
    }
    ImU32 color_of(const ComparedFigure& of, std::size_t fit, ImU32 usual) const {
        return of.best == static_cast<int>(fit) ? better() : usual;
    }

    void headings() const {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const ImFont& font = *ui_.style.caption;
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const auto heading = [&](float right, const char* text) {
            draw_text(draw, font, {corner.x + right - text_size(font, text).x, corner.y}, ui_.style.quiet, text);
        };
        draw_text(draw, font, corner, ui_.style.quiet, "level");
        heading(at_.volume, "m\u00B2\u00B7s");
        if (at_.has_more) heading(at_.more, "change");
        if (at_.has_fill) heading(at_.fill, "fill");
        if (at_.has_bar(ui_)) draw_text(draw, font, {corner.x + at_.bar, corner.y}, ui_.style.quiet, "cost");
        heading(at_.cost, "ns");
        ImGui::Dummy({at_.cost, font.FontSize});
    }

    /// The name of a fit; returns where its row begins.
    ImVec2 begin_row(ImVec2 corner, std::size_t fit, ImU32 color) const {
        const ImFont& body = *ui_.style.body;
        const ImVec2 at{corner.x, corner.y + row_height() * static_cast<float>(fit) + 1};
        ImGui::PushFont(ui_.style.body);
        draw_text(*ImGui::GetWindowDrawList(), body, {at.x + at_.name, at.y}, color,
                  fitted_text(names_[fit], at_.name_end - at_.name));
        ImGui::PopFont();
        return at;
    }

    void level_rows(const ComparedLevel& level) const {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const std::string name = level.level < 0 ? "leaves" : std::to_string(level.level);
        const bool pressed = ImGui::InvisibleButton(("compared" + name).c_str(), {at_.cost, height()});
        ui_.mark("compared.level." + name);
        const LevelRange& shown = ui_.workspace.view().levels;
        const bool is_level = !shown.leaves && level.level >= shown.first && level.level <= shown.last;
        const bool lit = !ui_.workspace.view().query && (level.level < 0 ? shown.leaves : is_level);
        const bool over = ImGui::IsItemHovered();
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        if (lit || over)
            draw.AddRectFilled({corner.x - ui_.px(4), corner.y}, {corner.x + at_.cost + ui_.px(4), corner.y + height()},
                               ui_.style.raised, ui_.px(3));
        const ImU32 usual = lit || over ? ui_.style.text : ui_.style.quiet;
        draw_text(draw, *ui_.style.mono, {corner.x, corner.y + 1}, usual,
                  level.level < 0 ? "leaf" : "L" + std::to_string(level.level));
        for (std::size_t fit = 0; fit < names_.size(); ++fit) {
            const ImVec2 row = begin_row(corner, fit, usual);
            ending(row, at_.volume, color_of(level.volume, fit, usual), value_or_dash(level.volume.values[fit]));
            if (at_.has_more) ending(row, at_.more, color_of(level.volume, fit, usual), more_text(level.volume, fit));
            if (at_.has_fill)
                ending(row, at_.fill, color_of(level.fill, fit, usual), share_text(level.fill.values[fit]));
            ending(row, at_.cost, color_of(level.cost, fit, usual), value_or_dash(level.cost.values[fit]));
            const double cost = level.cost.values[fit].value_or(0);
            if (cost <= 0 || !at_.has_bar(ui_)) continue;
            const float length = (at_.bar_end - at_.bar) * static_cast<float>(cost / costliest_);
            draw.AddRectFilled(
                {row.x + at_.bar, row.y + ui_.px(4)},
                {row.x + at_.bar + std::max(ui_.px(1), length), row.y + row_height() - ui_.px(4)},
                level.cost.best == static_cast<int>(fit) ? better() : to_im(with_alpha(ui_.style.palette.accent, 0.6f)),
                ui_.px(2));
        }
        if (pressed) ui_.invoke("view.level", name);
        if (over) ImGui::SetTooltip("%s", tooltip(level).c_str());
    }

    std::string tooltip(const ComparedLevel& level) const {
        std::string out = level.level < 0 ? "the last level of each" : "level " + std::to_string(level.level);
        for (std::size_t fit = 0; fit < names_.size(); ++fit) {
            out.append("\n").append(fits_.names[fit]).append(": ");
            if (!level.volume.values[fit]) {
                out += "does not go so deep";
                continue;
            }
            out.append(figure(*level.volume.values[fit])).append(" m\u00B2\u00B7s");
            if (level.fill.values[fit]) out.append(", fill ").append(share_text(level.fill.values[fit]));
            if (level.cost.values[fit])
                out.append(", ").append(figure(*level.cost.values[fit])).append(" ns of a query");
        }
        return out + "\n\nbars: cost, on one scale\nclick to show this level";
    }

    /// A query as a whole.
    void total_rows() const {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddLine(corner, {corner.x + at_.cost, corner.y}, ui_.style.border);
        ImGui::Dummy({at_.cost, height() + ui_.px(2)});
        ui_.mark_only("compared.total");
        const ImVec2 below{corner.x, corner.y + ui_.px(2)};
        draw_text(*ImGui::GetWindowDrawList(), *ui_.style.mono, {below.x, below.y + 1}, ui_.style.text, "all");
        for (std::size_t fit = 0; fit < names_.size(); ++fit) {
            const ImVec2 row = begin_row(below, fit, ui_.style.text);
            const ImU32 color = color_of(fits_.cost, fit, ui_.style.text);
            ending(row, at_.cost, color, value_or_dash(fits_.cost.values[fit]));
            if (at_.has_more) ending(row, at_.bar_end, color, more_text(fits_.cost, fit));
        }
    }

    Ui& ui_;
    const ComparedFits& fits_;
    std::vector<std::string> names_;
    FitColumns at_;
    double costliest_ = 1e-300;
};

}  // namespace

void compared_fits_panel(Ui& ui, FitCosts& costs) {
    if (ui.workspace.empty() || ui.session.views.count() < 2) return;
    const int clip = clip_in_focus(ui.workspace);
    costs.update(clip);
    const std::string& name = ui.workspace.scene().clips[static_cast<std::size_t>(clip)].name;
    if (!section(ui, "COMPARE FITS", name)) return;
    const ComparedFits& fits = costs.compared(clip);
    words(ui.style.text, verdict(fits));
    ui.mark_only("compared.verdict");
    ImGui::PushFont(ui.style.caption);
    const bool counted = ui.workspace.workload() == QueryWorkload::Kind::queries;
    const bool known = std::ranges::all_of(fits.cost.values, [](const auto& cost) { return cost.has_value(); });
    const bool asks = counted && !costs.counts_unasked();
    words(ui.style.quiet, !known && asks
                              ? "The queries are many: click the title of a view, then Count them below COST."
                          : !known  ? "What a query costs is not known of all yet."
                          : counted ? "ns: the mean of this scene's queries"
                                    : "ns: a query of the clip against itself, standard placements");
    ImGui::PopFont();
    ImGui::Dummy({0, ui.px(2)});
    FitTable(ui, fits).draw();
}

}  // namespace mobbscope::app
