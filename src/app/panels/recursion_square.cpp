#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/panels/recursion_picture.h>
#include <app/ui/memo.h>
#include <app/ui/swatch.h>
#include <explain/query_sentence.h>
#include <render/text/ticks.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <tuple>

namespace mobbscope::app {

namespace {

constexpr float kSquareAhead = 0.28f;  // strength of what comes after the present step

/// What both axes cover, and where.
struct Square {
    ImVec2 min, max;
    mobb::Interval a, b;

    float x(double t) const { return min.x + static_cast<float>((t - a.t0) / (a.t1 - a.t0)) * (max.x - min.x); }
    float y(double t) const { return max.y - static_cast<float>((t - b.t0) / (b.t1 - b.t0)) * (max.y - min.y); }
};

std::string seconds(double t) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g s", t);
    return text;
}

/// Where both times are equal: only what it crosses can hit.
void common_time(ImDrawList& list, const Style& style, const Square& square) {
    const double t0 = std::max(square.a.t0, square.b.t0);
    const double t1 = std::min(square.a.t1, square.b.t1);
    if (t1 <= t0) return;
    list.AddLine({square.x(t0), square.y(t0)}, {square.x(t1), square.y(t1)}, style.accent, 1.3f * style.scale);
}

void axis_labels(Ui& ui, const QueryFindings& findings, const Square& square) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    ImFont* font = ui.style.caption;
    const auto text = [&](ImVec2 at, ImU32 color, const std::string& words) {
        list.AddText(font, font->FontSize, at, color, words.c_str());
    };
    const auto width = [&](const std::string& words) {
        return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0, words.c_str()).x;
    };
    const ImU32 color_a = to_im(readable(findings.sides[0].color, ui.style.palette));
    const ImU32 color_b = to_im(readable(findings.sides[1].color, ui.style.palette));
    const float below = square.max.y + ui.px(3);
    const std::string from = seconds(square.a.t0), to = seconds(square.a.t1);
    text({square.min.x, below}, color_a, from);
    text({square.max.x - width(to), below}, color_a, to);
    const std::string name_a = findings.sides[0].label + " \u2192";
    const float middle = 0.5f * (square.min.x + square.max.x - width(name_a));
    if (middle > square.min.x + width(from) + ui.px(4)) text({middle, below}, color_a, name_a);
    const float above = square.min.y - font->FontSize - ui.px(3);
    text({square.min.x, above}, color_b,
         findings.sides[1].label + " \u2191  " + seconds(square.b.t0) + " to " + seconds(square.b.t1));
}

}  // namespace

void recursion_square(Ui& ui, const QueryFindings& findings) {
    const Recursion& recursion = findings.recursion;
    const float caption = ui.style.caption->FontSize;
    const float label = caption + ui.px(5);
    const float side = std::floor(std::min(ImGui::GetContentRegionAvail().x, ui.px(340)));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const Square square{{at.x, at.y + label},
                        {at.x + side, at.y + label + side},
                        recursion.pairs.front().time_a,
                        recursion.pairs.front().time_b};
    const int size = static_cast<int>(side);
    if (size < 16) return;
    ImGui::SetCursorScreenPos(square.min);
    ImGui::InvisibleButton("square", {side, side});
    ui.mark("query.square");
    const bool hovered = ImGui::IsItemHovered();
    const bool clicked = ImGui::IsItemClicked();

    using Drawn = std::pair<std::shared_ptr<const QueryFindings>, int>;
    static Memo<Drawn, std::vector<PairCell>> memo;
    const std::vector<PairCell>& cells = memo.get(
        {ui.session.findings(), size}, [&] { return square_cells(recursion, square.a, square.b, size, size); });
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(square.min, square.max, ui.style.raised);
    const int step = ui.session.step();
    const int present = recursion.pair_of[static_cast<std::size_t>(step)];
    const PairCell* under = nullptr;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (const PairCell& cell : cells) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(cell.pair)];
        const ImVec2 min{square.min.x + static_cast<float>(cell.x0), square.min.y + static_cast<float>(cell.y0)};
        const ImVec2 max{square.min.x + static_cast<float>(cell.x1), square.min.y + static_cast<float>(cell.y1)};
        const float strength = pair.first <= step ? 1 : kSquareAhead;
        if (pair.has_children()) {
            list.AddRect(min, max, to_im(with_alpha(ui.style.palette.axis, 0.6f * strength)), 0, 0, ui.style.scale);
        } else {
            const float gap = cell.x1 - cell.x0 > 4 ? 1.0f : 0.0f;
            outcome_cell(list, ui.style, min, {max.x - gap, max.y - gap}, mark_of(pair), strength);
        }
        // Later cells lie in earlier ones: the last that the mouse is in is the smallest.
        if (mouse.x >= min.x && mouse.x < max.x && mouse.y >= min.y && mouse.y < max.y) under = &cell;
    }
    common_time(list, ui.style, square);
    const RecursionPair& now = recursion.pairs[static_cast<std::size_t>(present)];
    // However small the pair is, its outline is seen.
    const ImVec2 middle{0.5f * (square.x(now.time_a.t0) + square.x(now.time_a.t1)),
                        0.5f * (square.y(now.time_b.t0) + square.y(now.time_b.t1))};
    const float half_x = std::max(ui.px(4), square.x(now.time_a.t1) - middle.x + ui.px(1));
    const float half_y = std::max(ui.px(4), square.y(now.time_b.t0) - middle.y + ui.px(1));
    list.AddRect({middle.x - half_x, middle.y - half_y}, {middle.x + half_x, middle.y + half_y}, ui.style.text, 0, 0,
                 ui.px(2));
    axis_labels(ui, findings, square);
    ImGui::SetCursorScreenPos({at.x, square.max.y + label});
    ImGui::Dummy({0, 0});
    if (!hovered || !under) return;
    const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(under->pair)];
    const std::string more =
        under->merged > 1 ? "\nand " + std::to_string(under->merged - 1) + " smaller pairs here" : "";
    ImGui::SetTooltip("%s%s", step_sentence(findings.sides, ui.session.recorded()->trace, pair.last).c_str(),
                      more.c_str());
    if (clicked) invoke(ui.session, "step.to", std::to_string(pair.last));
}

}  // namespace mobbscope::app
