#include <app/document/agents.h>
#include <app/panels/level_strip.h>
#include <app/ui/swatch.h>
#include <base/text.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kMostRow = 15;
constexpr float kLeastRow = 3;
constexpr float kBelow = 6;
constexpr float kBarLength = 90;  // of the colour bar
constexpr int kBarSteps = 32;

using Cell = LevelStrip::Cell;

/// The figure that the strip is coloured by: the boxes', or where these have no figure of their own the wasted space.
const NodeFieldInfo& strip_field(const ViewState& view) {
    const NodeFieldInfo* field = color_figure(view.color_by);
    return field && field->field != NodeField::level ? *field : info(NodeField::waste);
}

/// Whose nodes they are, on the picture's clock.
struct Strip {
    const mobb::Tree& tree;
    mobb::PlacedTree placed;
    AgentRef path;
    std::span<const double> values;
    const ColorScale& scale;
    ChartAxis time;
    float top = 0, row = 0;

    int depth() const { return tree.depth(); }
    float height() const { return row * static_cast<float>(depth()); }
    float left_of(int node) const { return time.pixel(placed.begin(tree.node(node))); }
    float right_of(int node) const { return time.pixel(placed.end(tree.node(node))); }
    float top_of(int level) const { return top + row * static_cast<float>(level); }
    bool is_worse(double a, double b) const {
        if (std::isnan(a) || std::isnan(b)) return std::isnan(b);
        return scale.figure.low_is_worse ? a < b : a > b;
    }
};

LevelStrip::Rows rows_of(const Strip& strip) {
    LevelStrip::Rows out(static_cast<std::size_t>(strip.depth()));
    for (int node = 0; node < static_cast<int>(strip.tree.nodes().size()); ++node) {
        std::vector<Cell>& level = out[static_cast<std::size_t>(strip.tree.level(node))];
        const float left = strip.left_of(node), right = strip.right_of(node);
        const double value = strip.values[static_cast<std::size_t>(node)];
        if (level.empty() || right - level.back().left >= 1) {
            level.push_back({left, right, node, value});
            continue;
        }
        Cell& last = level.back();
        last.right = right;
        if (strip.is_worse(value, last.value)) {
            last.node = node;
            last.value = value;
        }
    }
    return out;
}

void draw_nodes(Ui& ui, const Strip& strip, const LevelStrip::Rows& rows) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float gap = strip.row > ui.px(6) ? std::floor(ui.px(1)) : 0;
    for (int level = 0; level < strip.depth(); ++level) {
        const float top = strip.top_of(level), bottom = strip.top_of(level + 1) - gap;
        for (const Cell& cell : rows[static_cast<std::size_t>(level)]) {
            // Wide ones are told apart.
            const float right = cell.right - (cell.right - cell.left > 3 ? 1.0f : 0.0f);
            const ImU32 color = to_im(strip.scale.color(cell.value, ui.style.palette));
            draw.AddRectFilled({cell.left, top}, {std::max(right, cell.left + 1), bottom}, color);
        }
    }
}

/// Around the cell of a node.
void outline(Ui& ui, const Strip& strip, const Selection& what, ImU32 color) {
    if (what.kind != Selection::Kind::node || what.path != strip.path) return;
    const int level = strip.tree.level(what.index);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float left = strip.left_of(what.index), right = std::max(strip.right_of(what.index), left + ui.px(3));
    draw.AddRect({left - 1, strip.top_of(level) - 1}, {right + 1, strip.top_of(level + 1) + 1}, color, 0, 0,
                 std::max(1.0f, ui.px(1.6f)));
}

void level_numbers(Ui& ui, const Strip& strip, float left) {
    const ImFont& font = *ui.style.caption;
    // Of low rows every second or so has its number.
    const int step = std::max(1, static_cast<int>(std::ceil(font.FontSize / strip.row)));
    const ViewState& view = ui.workspace.view();
    for (int level = 0; level < strip.depth(); level += step) {
        const std::string text = "L" + std::to_string(level);
        const float x = strip.time.first - text_size(font, text).x - ui.px(6);
        if (x < left) continue;
        const bool shown =
            !view.query && !view.levels.leaves && level >= view.levels.first && level <= view.levels.last;
        draw_text(*ImGui::GetWindowDrawList(), font, {x, strip.top_of(level) + 0.5f * (strip.row - font.FontSize)},
                  shown ? ui.style.text : ui.style.quiet, text);
    }
}

/// "LEVELS OVER TIME, empty space", and the colour bar with the values at its ends.
void header(Ui& ui, const ColorScale& scale, float left, float right) {
    const ImFont& font = *ui.style.caption;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float y = ImGui::GetCursorScreenPos().y;
    const std::string title = "LEVELS OVER TIME, " + scale.title();
    draw_text(draw, font, {left, y}, ui.style.quiet, scale.known ? title : title + ", not counted");
    const std::string least = scale.least_text(), most = scale.most_text();
    const float bar = ui.px(kBarLength), gap = ui.px(5);
    const float from = right - text_size(font, most).x - gap - bar;
    const float begin = from - gap - text_size(font, least).x;
    if (scale.known && begin > left + text_size(font, title).x + ui.px(16)) {
        draw_text(draw, font, {begin, y}, ui.style.quiet, least);
        draw_text(draw, font, {from + bar + gap, y}, ui.style.quiet, most);
        for (int i = 0; i < kBarSteps; ++i) {
            const float share = (static_cast<float>(i) + 0.5f) / kBarSteps;
            draw.AddRectFilled({from + bar * static_cast<float>(i) / kBarSteps, y + ui.px(2)},
                               {from + bar, y + font.FontSize - ui.px(1)},
                               to_im(scale.color_at(share, ui.style.palette)));
        }
    }
    ImGui::Dummy({1, font.FontSize + ui.px(1)});
}

/// The node under the mouse, by the cell that is drawn there.
std::optional<int> node_under(const Strip& strip, const LevelStrip::Rows& rows, ImVec2 mouse) {
    const int level = static_cast<int>(std::floor((mouse.y - strip.top) / strip.row));
    if (level < 0 || level >= strip.depth()) return std::nullopt;
    const std::vector<Cell>& row = rows[static_cast<std::size_t>(level)];
    const auto after = std::ranges::upper_bound(row, mouse.x, {}, &Cell::left);
    if (after == row.begin()) return std::nullopt;
    const Cell& cell = *std::prev(after);
    if (mouse.x > std::max(cell.right, cell.left + 1)) return std::nullopt;
    return cell.node;
}

std::string node_words(const Ui& ui, const Strip& strip, int node) {
    const mobb::Node& of = strip.tree.node(node);
    const std::string who = placed_agent_of(ui.workspace.fitted(), strip.path)->name;
    std::string out = who + ' ' + std::to_string(strip.tree.level(node)) + '.' +
                      std::to_string(strip.tree.place_in_level(node)) + ", samples " + std::to_string(of.first) + ".." +
                      std::to_string(of.end() - 1) +
                      formatted(", %.2f to %.2f s", strip.placed.begin(of), strip.placed.end(of));
    const double value = strip.values[static_cast<std::size_t>(node)];
    out += '\n' + strip.scale.figure.title + ": " + (std::isnan(value) ? "not known" : strip.scale.text(value));
    return out + "\nclick to select it";
}

/// Byte by byte, as a value may be NaN.
bool are_same(std::span<const double> a, std::span<const double> b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

}  // namespace

void LevelStrip::draw(Ui& ui, int clip, const ChartAxis& time, float most_height) {
    const auto path = player_of(ui.workspace, clip);
    if (!path || ui.workspace.crowd()) return;
    const FittedScene& fitted = ui.workspace.fitted();
    const auto who = placed_agent_of(fitted, *path);
    const ViewState& view = ui.workspace.view();
    const mobb::Tree& tree = fitted.tree(*who);
    const auto depth = static_cast<float>(tree.depth());
    const float heading = ui.style.caption->FontSize + ui.px(1), below = ui.px(kBelow);
    const float row = std::floor(std::min((most_height - heading - below) / depth, ui.px(kMostRow)));
    if (row < std::floor(ui.px(kLeastRow)) || time.last - time.first < 1) return;

    const NodeFieldInfo& field = strip_field(view);
    const std::span<const double> values = ui.session.figures.column(clip, field.field);
    const mobb::PlacedTree placed = fitted.placed(*who);
    Key key{.tree = fitted.shared_tree(*who), .figure = colored_figure(field)};
    // Of its own, in which all levels have room: on the scale of one level the others would have one colour.
    key.figure.whole_range = true;
    if (color_figure(view.color_by) == &field) key.chosen = view.color_range;
    key.times = {placed.begin(tree.node(0)), placed.end(tree.node(0)), time.from, time.to, time.first, time.last};
    const bool are_new = key_ != key || !are_same(values_, values);
    if (are_new) {
        values_.assign(values.begin(), values.end());
        scale_ = color_scale(key.figure, values_, key.chosen);
    }
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    header(ui, scale_, corner.x, time.last);
    const Strip strip{.tree = tree,
                      .placed = placed,
                      .path = *path,
                      .values = values_,
                      .scale = scale_,
                      .time = time,
                      .top = ImGui::GetCursorScreenPos().y,
                      .row = row};
    if (are_new) {
        rows_ = rows_of(strip);
        key_ = std::move(key);
    }
    const float left = time.first, right = time.last;
    ImGui::SetCursorScreenPos({left, strip.top});
    const bool clicked = ImGui::InvisibleButton("##levels over time", {right - left, strip.height()});
    ui.mark_only("nodes.levels");
    const bool over = ImGui::IsItemHovered();
    level_numbers(ui, strip, corner.x);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    // A query's two may not be there as long as this one.
    draw.PushClipRect({left - ui.px(2), strip.top - ui.px(2)},
                      {right + ui.px(2), strip.top + strip.height() + ui.px(2)}, true);
    draw_nodes(ui, strip, rows_);
    if (view.time && *view.time >= time.from && *view.time <= time.to) {
        const float x = time.pixel(*view.time);
        draw.AddLine({x, strip.top - ui.px(2)}, {x, strip.top + strip.height() + ui.px(2)}, ui.style.text, ui.px(1.3f));
    }
    outline(ui, strip, ui.workspace.hovered, ui.style.quiet);
    outline(ui, strip, ui.workspace.selection, ui.style.text);
    draw.PopClipRect();
    ImGui::SetCursorScreenPos({corner.x, strip.top + strip.height() + below});
    const auto node = over ? node_under(strip, rows_, ImGui::GetIO().MousePos) : std::nullopt;
    if (!node) return;
    const Selection at{Selection::Kind::node, *path, *node};
    ui.hovered = at;
    ImGui::SetTooltip("%s", node_words(ui, strip, *node).c_str());
    if (clicked) ui.later([at](Workspace& workspace) { workspace.select(at); });
}

}  // namespace mobbscope::app
