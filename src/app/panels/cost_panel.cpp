#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/numbers_in_text.h>
#include <base/text.h>
#include <explain/level_columns.h>
#include <explain/tree_cost.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

using Workload = QueryWorkload::Kind;

std::string per_cent(double share) { return formatted("%.0f %%", 100 * share); }

/// "2D boxes": what tests of a kind are about; and as short as is understood.
std::string tested(mobb::TestKind kind) {
    if (kind.is_box()) return std::string(mobb::info(kind.box()).plural);
    return kind == mobb::TestKind::samples ? "sample pairs" : "time";
}
std::string tested_in_short(mobb::TestKind kind) {
    if (kind.is_box()) return std::string(mobb::info(kind.box()).heading);
    return kind == mobb::TestKind::samples ? "pairs" : "time";
}

/// The kinds of tests that a query makes, those of boxes first.
std::vector<mobb::TestKind> kinds_of(const MeanTests& tests) {
    std::vector<mobb::TestKind> out;
    for (const mobb::BoxKind box : mobb::kBoxKinds) out.emplace_back(box);
    out.insert(out.end(), {mobb::TestKind::samples, mobb::TestKind::time});
    std::erase_if(out, [&](mobb::TestKind kind) { return tests[kind] == 0; });
    return out;
}

/// "201,728 counted, \u00B10.4 %: shift over 25.6 m\u00B2, start within \u00B12 s"
std::string workload_words(const TreeCost& cost, std::size_t most) {
    if (cost.workload == Workload::queries)
        return "the mean of " + counted(cost.queries, "query", "queries") + " of this scene";
    const StandardPlacements& of = cost.expected->placements;
    return grouped(cost.queries) + (cost.count.is_enough(most) ? " counted, \u00B1" : " counted so far, \u00B1") +
           figure(100 * cost.count.standard_error(), 1) + " %: shift over " + figure(of.area(), 3) +
           " m\u00B2, start within \u00B1" + brief(of.offset) + " s";
}

/// How the cost is found out, and by which formula it is divided.
std::string formula(const TreeCost& cost) {
    if (cost.workload == Workload::queries)
        return "Tests of all queries of the scene, counted, times their price, by the number of queries.";
    const StandardPlacements& of = cost.expected->placements;
    return "Tests of " + grouped(cost.queries) + " standard placements of the clip against itself (seed " +
           std::to_string(kCountedSeed) +
           "), counted,\ntimes their price, by the number of placements.\n\n"
           "EV* divides the count among nodes and levels. A pair of nodes gets its part of\n"
           "P + sum over pairs (p, q) of inner nodes and over their children (a, b)\n"
           "      of max(0, K(p,q) - H)/W * (h_a + h_b)/(2T)\n"
           "P: the chance that the roots share time\n"
           "K: the area of the shifts at which two boxes meet, m\u00B2, the least of p, q and those above them;\n"
           "   of 2D boxes A_p + A_q + L_p L_q/(2 pi), areas A and perimeters L\n"
           "H: the area of those at which the two have collided before: a hit ends the query\n"
           "h: how long a node lasts, s\n"
           "W = " +
           figure(of.area()) + " m\u00B2: all shifts.  T = " + figure(of.offset) + " s: starts are within \u00B1T";
}

/// "2D boxes: 13.9 tests x 14 ns = 195 ns"
std::string price_words(mobb::TestKind kind, const MeanTests& tests, const TreeCost& cost) {
    MeanTests alone;
    alone[kind] = tests[kind];
    return tested(kind) + ": " + figure(tests[kind]) + " tests x " + brief(kTestPrices[kind]) +
           " ns = " + figure(cost.ns(alone)) + " ns";
}

std::string price_lines(const MeanTests& tests, const TreeCost& cost) {
    std::string out;
    for (const mobb::TestKind kind : kinds_of(tests)) out.append(price_words(kind, tests, cost)).append(1, '\n');
    return out;
}

ImU32 shade_of(const Ui& ui, std::size_t place) {
    constexpr std::array kStrengths{1.0f, 0.6f, 0.36f, 0.2f};
    return to_im(with_alpha(ui.style.palette.accent, kStrengths[std::min(place, kStrengths.size() - 1)]));
}

/// Tells something where the last item is under the mouse.
void tell(const std::string& text) {
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

void total(Ui& ui, const TreeCost& cost) {
    const std::string ns = figure(cost.ns(), 3) + " ns";
    text_line(ui.style.text, ns + " a query", ui.style.title);
    ui.mark_only("cost.total");
    Rect place = Ui::last_rect();
    place.max.x = place.min.x + text_size(*ui.style.title, ns).x;
    const std::string about = formula(cost) + "\n\n" + price_lines(cost.tests, cost);
    if (!copies(ui, place, {.value = cost.ns(), .unit = "ns", .tip = about})) tell(about);
}

/// What the numbers are about, to choose where the scene has queries.
void workload_choice(Ui& ui, const TreeCost* cost) {
    const std::size_t count = ui.workspace.crowd() ? 0 : ui.workspace.document().fitted->queries().size();
    if (count > 0) {
        const std::array all{ChoiceWord{"placements", "standard placements",
                                        "The clip against itself, placed at random: these say nothing about any scene"},
                             ChoiceWord{"queries", counted(count, "query", "queries"), "What this scene asks"}};
        const int pressed = word_choice(ui, "tree.cost_of", all, static_cast<int>(ui.workspace.workload()));
        if (pressed >= 0) ui.invoke("tree.cost_of", all[static_cast<std::size_t>(pressed)].name);
    }
    if (!cost) return;
    ImGui::PushFont(ui.style.caption);
    if (cost->workload == Workload::queries) {
        words(ui.style.quiet, workload_words(*cost, ui.session.fit_costs.most_counted()));
    } else {
        const StandardPlacements& of = cost->expected->placements;
        words(ui, ui.style.quiet,
              (count > 0 ? "" : "standard placements, ") + workload_words(*cost, ui.session.fit_costs.most_counted()),
              {static_cast<double>(cost->queries), 100 * cost->count.standard_error(), of.area(), of.offset});
        words(ui.style.quiet, "EV* divides the count among levels and nodes.");
    }
    ImGui::PopFont();
}

/// The tests by kind: a bar of their parts of the cost, and a row for each.
void kinds(Ui& ui, const TreeCost& cost) {
    const MeanTests& tests = cost.tests;
    const std::vector<mobb::TestKind> all = kinds_of(tests);
    const ImFont& mono = *ui.style.mono;
    const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x);
    const auto part = [&](mobb::TestKind kind) {
        MeanTests alone;
        alone[kind] = tests[kind];
        return cost.part(alone);
    };
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    ImGui::Dummy({width, ui.px(7)});
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float end = at.x + width * static_cast<float>(part(all[i]));
        draw.AddRectFilled(at, {std::max(at.x + 1, end - ui.px(1)), at.y + ui.px(7)}, shade_of(ui, i));
        at.x = end;
    }
    // From the right: the part, the price, the number.
    const float of_part = text_size(mono, " 100 %").x, of_price = text_size(mono, " x 1.4").x;
    float of_count = 0, of_label = 0;
    for (const mobb::TestKind kind : all) {
        of_count = std::max(of_count, text_size(mono, figure(tests[kind], 3)).x);
        of_label = std::max(of_label, text_size(*ui.style.body, tested(kind)).x);
    }
    const float label_at = ui.px(13), room = width - label_at - ui.px(6) - of_count - of_part;
    const bool shows_prices = of_label + of_price <= room;
    const float height = ui.px(17);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const mobb::TestKind kind = all[i];
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        ImGui::Dummy({width, height});
        ui.mark_only("cost.kind." + std::string(name(kind)));
        const float y = corner.y + 0.5f * (height - mono.FontSize);
        const float dot = ui.px(7), top = corner.y + 0.5f * (height - dot);
        draw.AddRectFilled({corner.x, top}, {corner.x + dot, top + dot}, shade_of(ui, i));
        const std::string about = price_words(kind, tests, cost);
        bool copied = false;
        const auto ending = [&](float right, ImU32 color, const std::string& text, const CopiedNumber& number) {
            const ImVec2 from{corner.x + right - text_size(mono, text).x, y};
            draw_text(draw, mono, from, color, text);
            copied = copies(ui, {{from.x, y}, {corner.x + right, y + mono.FontSize}}, number) || copied;
        };
        ending(width, ui.style.quiet, per_cent(part(kind)), {.value = 100 * part(kind), .unit = "%", .tip = about});
        const float priced = width - of_part;
        if (shows_prices) {
            const float at_price = corner.x + priced - of_price;
            draw_text(draw, mono, {at_price, y}, ui.style.quiet, " x " + brief(kTestPrices[kind]));
        }
        ending(shows_prices ? priced - of_price : priced, ui.style.text, figure(tests[kind], 3),
               {.value = tests[kind], .tip = about});
        draw_text(draw, *ui.style.body, {corner.x + label_at, corner.y + 0.5f * (height - ui.style.body->FontSize)},
                  ui.style.text, of_label <= room ? tested(kind) : tested_in_short(kind));
        if (!copied) tell(about);
    }
}

/// The columns of the table of levels, as pixels from its left edge: where texts end, and where bars are.
struct LevelLayout {
    float volume, fill, bar, bar_end, width;

    LevelLayout(const Ui& ui, float width_) : width(width_) {
        const auto digits = [&](const char* text) { return text_size(*ui.style.mono, text).x; };
        volume = digits("L00 ") + digits("000000");
        fill = volume + digits(" 100 %");
        bar = fill + ui.px(10);
        bar_end = width - digits(" 000.0");
    }
};

void level_headings(Ui& ui, const LevelLayout& at) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImFont& font = *ui.style.caption;
    const auto ending = [&](float right, const char* text) {
        draw_text(draw, font, {corner.x + right - text_size(font, text).x, corner.y}, ui.style.quiet, text);
    };
    draw_text(draw, font, corner, ui.style.quiet, "level");
    ending(at.volume, "m\u00B2\u00B7s");
    ending(at.fill, "fill");
    ending(at.width, "ns");
    ImGui::Dummy({at.width, font.FontSize});
}

std::string level_tooltip(const mobb::LevelFigures* level, const TreeCost* cost, std::size_t i) {
    std::string out;
    if (level) {
        for (const mobb::LevelColumn& column : mobb::kLevelColumns) out += level_words(column, *level) + '\n';
    } else {
        out += "of trees that are deeper than this one\n";
    }
    if (cost && i < cost->levels.size()) {
        out += "\nTests of pairs of this level's nodes, a query:\n" + price_lines(cost->levels[i], *cost);
        out += "together " + figure(cost->ns(cost->levels[i])) + " ns\n";
    }
    return out + "\nclick to show this level, Ctrl and click to copy a number";
}

/// The levels: volume, how much of it the disks fill, and what they cost.
void levels(Ui& ui, const std::vector<mobb::LevelFigures>& figures, const TreeCost* cost) {
    // Free boxes may take more room the finer they are: their fits overlap.
    double most = 1e-300, costliest = 1e-300;
    for (const mobb::LevelFigures& level : figures) most = std::max(most, level.volume);
    std::vector<double> costs;
    if (cost) {
        for (const MeanTests& level : cost->levels) costs.push_back(cost->ns(level));
        for (const double level : costs) costliest = std::max(costliest, level);
        // No query came so deep.
        costs.resize(std::max(costs.size(), figures.size()));
    }
    // The largest has three digits, and all of them its decimals, where these have room.
    const bool are_fixed = most >= 0.01 && most < 1e6;
    const int decimals = std::max(2 - static_cast<int>(std::floor(std::log10(most))), 0);
    const ImFont& mono = *ui.style.mono;
    const float height = ui.px(18);
    const LevelLayout at(ui, std::max(1.0f, ImGui::GetContentRegionAvail().x));
    level_headings(ui, at);
    const auto draw_row = [&](int i) {
        const auto index = static_cast<std::size_t>(i);
        const mobb::LevelFigures* level = index < figures.size() ? &figures[index] : nullptr;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const bool clicked = ImGui::InvisibleButton(("level" + std::to_string(i)).c_str(), {at.width, height});
        ui.mark("level." + std::to_string(i));
        const LevelRange shown = ui.workspace.view().levels;
        if (shown.first == i) ui.focus.begin_here();
        const bool over = ImGui::IsItemHovered();
        const bool drawn = !shown.leaves && !ui.workspace.view().query && i >= shown.first && i <= shown.last;
        const ImU32 color = drawn || over ? ui.style.text : ui.style.quiet;
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const float y = corner.y + 0.5f * (height - mono.FontSize);
        bool copied = false;
        const auto ending = [&](float right, const std::string& text, const CopiedNumber& number) {
            const ImVec2 from{corner.x + right - text_size(mono, text).x, y};
            draw_text(draw, mono, from, color, text);
            copied =
                (text != "-" && copies(ui, {{from.x, y}, {corner.x + right, y + mono.FontSize}}, number)) || copied;
        };
        draw_text(draw, mono, {corner.x, y}, color, "L" + std::to_string(i));
        ending(at.volume, level ? formatted(are_fixed ? "%.*f" : "%.*g", are_fixed ? decimals : 3, level->volume) : "-",
               {.value = level ? level->volume : 0, .unit = "m\u00B2\u00B7s", .with_ctrl = true});
        const double fill = level ? level->tightness.value_or(0) : 0;
        ending(at.fill, level && level->tightness ? per_cent(fill) : "-",
               {.value = 100 * fill, .unit = "%", .with_ctrl = true});
        const double ns = index < costs.size() ? costs[index] : 0;
        ending(at.width, index < costs.size() ? figure(ns, 3) : "-", {.value = ns, .unit = "ns", .with_ctrl = true});
        if (ns > 0 && at.bar_end > at.bar) {
            const float length = (at.bar_end - at.bar) * static_cast<float>(ns / costliest);
            draw.AddRectFilled({corner.x + at.bar, corner.y + ui.px(4)},
                               {corner.x + at.bar + std::max(ui.px(1), length), corner.y + height - ui.px(4)},
                               to_im(with_alpha(ui.style.palette.accent, drawn || over ? 1.0f : 0.6f)), ui.px(2));
        }
        if (clicked && !copied) ui.invoke("view.level", std::to_string(i));
        if (over && !copied) tell(level_tooltip(level, cost, index));
    };
    const int count = static_cast<int>(std::max(figures.size(), costs.size()));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ui.focus.begin_list(ImGui::GetID("levels"), count);
    for (int i = 0; i < count; ++i) {
        ui.focus.row(i);
        draw_row(i);
    }
    ui.focus.end_list();
    ImGui::PopStyleVar();
}

/// Instead of a cost that is not known.
void no_cost(Ui& ui, const mobb::Tree& tree) {
    if (const std::string_view why = why_no_cost(tree); !why.empty()) return words(ui.style.quiet, std::string(why));
    if (ui.workspace.workload() == Workload::placements) return text_line(ui.style.quiet, "\u2026", ui.style.title);
    words(ui.style.quiet, "The tests of all queries are not counted.");
    if (small_button(ui, "Count them", "cost.count")) ui.later([](CostInspector& costs) { costs.count(); });
}

}  // namespace

void cost_section(Ui& ui, QueryInspector& queries, FitCosts& costs, int clip) {
    costs.update(clip);
    // Not amid a drag, which changes what is asked again and again.
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) && costs.wants_count())
        ui.later([](CostInspector& all) { all.count(); });
    if (!section(ui, "COST", ui.workspace.scene().clips[static_cast<std::size_t>(clip)].name)) return;
    const std::shared_ptr<const TreeCost> cost = ui.workspace.cost_of(clip);
    cost ? total(ui, *cost) : no_cost(ui, ui.workspace.fitted().tree(clip));
    workload_choice(ui, cost.get());
    if (cost) kinds(ui, *cost);
    ImGui::Dummy({0, ui.px(2)});
    levels(ui, queries.figures_of(clip), cost.get());
}

}  // namespace mobbscope::app
