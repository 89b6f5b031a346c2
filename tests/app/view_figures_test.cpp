// Colours by a figure in the window: the histogram with its handles, and the strip of levels over time.
#include <app/document/workspace.h>
#include <app/window/headless_window.h>
#include <explain/branch_costs.h>
#include <explain/expected_cost.h>
#include <mobb/box.h>
#include <render/drawlist/color_scale.h>
#include <render/gl/gl_context.h>
#include <scene/view_options.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

struct FigureWindow : FolderWindow<CrossingFolder> {
    FigureWindow() : FolderWindow({1600, 1000}) { open(folder.scene); }
    void move(glm::vec2 to) {
        window.shell().feed(MouseMove{to});
        window.settle();
    }
    void button(bool down) {
        window.shell().feed(MouseButton{0, down});
        window.settle();
    }
    void click(glm::vec2 at) {
        move(at);
        button(true);
        button(false);
    }
    const ViewState& view() const { return session.workspace.view(); }
    /// The colour of a pixel of the window.
    Rgba pixel(glm::vec2 at) {
        const Image image = window.shell().read_back();
        const std::uint8_t* found = image.at(static_cast<int>(at.x), static_cast<int>(at.y));
        return Rgba(found[0], found[1], found[2], 255) / 255.0f;
    }
};

TEST(ViewFigures, TheScaleIsKnownBeforeAPictureIsDrawn) {
    FigureWindow w;
    for (const char* figure : {"empty", "fill"}) {
        run_command(w.session, "view.color_by", figure);
        ASSERT_TRUE(w.session.figures.boxes());
        EXPECT_EQ(w.session.figures.boxes()->scale.figure, colored_figure(*color_figure(w.view().color_by)));
    }
    run_command(w.session, "view.boxes");
    EXPECT_FALSE(w.session.figures.boxes()) << "no box has a colour";
}

TEST(ViewFigures, AModeIsChosenFromTheListWithTheOthers) {
    FigureWindow w;
    EXPECT_FALSE(w.has("view.color_range.from"));
    w.click(w.rect("view.color_by").center());
    for (const std::string_view mode : view_option("color_by").choices)
        EXPECT_TRUE(w.has("view.color_by." + std::string(mode))) << mode;
    w.click(w.rect("view.color_by.empty").center());
    EXPECT_EQ(w.view().color_by, ColorBy::empty);
    ASSERT_TRUE(w.session.figures.boxes());
    EXPECT_EQ(w.session.figures.boxes()->scale.figure.title, "empty space");
    EXPECT_TRUE(w.has("view.color_range.from"));
    w.run("query.select", "0");
    EXPECT_FALSE(w.has("view.color_range.from")) << "the boxes of a query have other colours";
}

TEST(ViewFigures, HandlesChooseTheRange) {
    FigureWindow w;
    w.run("view.level", "3");
    w.run("view.color_by", "empty");
    const ColorScale scale = w.session.figures.boxes()->scale;
    ASSERT_TRUE(scale.known);
    EXPECT_FALSE(w.has("view.color_range.auto"));
    const glm::vec2 at = w.rect("view.color_range.to").center();
    w.move(at);
    w.button(true);
    w.move(at - glm::vec2(60, 0));
    w.button(false);
    ASSERT_TRUE(w.view().color_range);
    EXPECT_TRUE(w.session.workspace.history.look_back_title().starts_with("colour range: "));
    EXPECT_LT(w.view().color_range->most, scale.most);
    EXPECT_NEAR(w.view().color_range->least, scale.least, 1e-3 * scale.least);
    EXPECT_TRUE(w.session.figures.boxes()->scale.chosen);
    EXPECT_TRUE(w.session.figures.boxes()->scale.has_more);
    EXPECT_NEAR(w.rect("view.color_range.to").center().x, at.x - 60, 2) << "it stays under the mouse";
    w.click(w.rect("view.color_range.auto").center());
    EXPECT_FALSE(w.view().color_range);
}

TEST(ViewFigures, ARangeIsOfOneFigure) {
    FigureWindow w;
    w.run("view.color_by", "fill");
    w.run("view.color_range", "10:30");
    EXPECT_EQ(w.view().color_range, (ValueRange{10, 30}));
    EXPECT_DOUBLE_EQ(w.session.figures.boxes()->scale.most, 0.3) << "parts are given in per cent";
    w.run("view.color_by", "fill");
    EXPECT_TRUE(w.view().color_range);
    w.run("view.color_by", "empty");
    EXPECT_FALSE(w.view().color_range) << "of another figure it would mean something else";
    w.run("view.color_range", "auto");
    EXPECT_NE(refusal(w.session, "view.color_range", "3:1").find("not a range"), std::string::npos);
}

TEST(ViewFigures, TestsAreCountedWhereSomebodyAsks) {
    FigureWindow w;
    for (const char* mode : {"tests", "avoidable"}) {
        w.run("view.color_by", mode);
        ASSERT_TRUE(w.session.figures.boxes()) << mode;
        EXPECT_FALSE(w.session.figures.boxes()->scale.known) << mode;
        EXPECT_EQ(w.session.figures.boxes()->unknown, "not counted");
        w.click(w.rect("view.color_by.count").center());
        w.window.settle();
        EXPECT_TRUE(w.session.figures.boxes()->scale.known) << mode;
        EXPECT_FALSE(w.has("view.color_by.count"));
    }
}

TEST(ViewFigures, SideBySideEachFitIsCounted) {
    for (const std::size_t first : {0u, 1u}) {
        SCOPED_TRACE(first);
        FigureWindow w;
        w.run("compare.fits", "mobb,leaf=4 mobb,leaf=1");
        const auto go = [&](std::size_t place) {
            w.session.views.activate(place);
            w.window.settle();
            return w.session.figures.boxes();
        };
        for (const char* mode : {"tests", "avoidable"}) {
            go(first);
            w.run("view.color_by", mode);
            EXPECT_FALSE(go(first)->scale.known) << mode;
            w.click(w.rect("view.color_by.count").center());
            w.window.settle();
            EXPECT_TRUE(go(first)->scale.known) << mode;
            EXPECT_FALSE(go(1 - first)->scale.known) << mode;
            w.click(w.rect("view.color_by.count").center());
            w.window.settle();
            EXPECT_TRUE(go(1 - first)->scale.known) << mode;
            EXPECT_TRUE(go(first)->scale.known) << mode;
        }
        w.run("view.color_by", "tests");
        w.run("view.level", "0:9");
        std::vector<double> shown, counted;
        for (const std::size_t place : {0u, 1u}) {
            const std::vector<double> values = go(place)->values;
            shown.push_back(std::accumulate(values.begin(), values.end(), 0.0));
            // Three agents play the clip, and all boxes of each are shown.
            counted.push_back(0);
            for (const NodeCost& node : scene_costs(*w.session.views.at(place).fitted).nodes)
                counted.back() += 3 * static_cast<double>(node.boxes);
        }
        EXPECT_EQ(shown, counted) << "each its own";
        EXPECT_NE(counted[0], counted[1]) << "else nothing was told apart";
    }
}

TEST(ViewFigures, SideBySideOneColourIsOneValue) {
    FigureWindow w;
    w.run("compare.fits", "mobb,leaf=4 umobb,leaf=4");
    w.run("view.level", "1");
    w.run("view.color_by", "volume");
    std::vector<double> volumes;
    std::vector<Rgba> colors;
    const auto look = [&](std::size_t place) {
        w.session.views.activate(place);
        w.window.settle();
        volumes.clear();
        colors.clear();
        const mobb::Tree& tree = w.session.workspace.fitted().tree(clip_in_focus(w.session.workspace));
        for (const BoxInstance& box : w.window.shell().shown()->boxes) {
            if (box.state != BoxState::level) continue;
            volumes.push_back(mobb::volume(tree.box(box.id.index), tree.time_scale()));
            colors.push_back(with_alpha(box.fill, 1));
        }
        EXPECT_EQ(volumes.size(), 6u) << "two nodes of three agents";
    };
    look(0);
    std::vector<double> all = volumes;
    look(1);
    EXPECT_NE(all, volumes);
    all.insert(all.end(), volumes.begin(), volumes.end());
    const ColorScale scale = color_scale(colored_figure(info(NodeField::volume)), all);
    for (const std::size_t place : {0u, 1u, 0u}) {
        look(place);
        EXPECT_EQ(w.session.figures.boxes()->scale, scale) << place;
        for (std::size_t i = 0; i < volumes.size(); ++i)
            EXPECT_LT(glm::length(colors[i] - scale.color(volumes[i], w.window.shell().shown()->palette)), 2e-3f);
    }
    w.run("view.plan");
    EXPECT_EQ(w.session.figures.boxes()->scale, scale) << "on the floor plan too";
    w.run("view.plan");
    w.run("view.link_levels");
    for (const std::size_t place : {0u, 1u}) {
        look(place);
        EXPECT_EQ(w.session.figures.boxes()->scale, color_scale(scale.figure, volumes)) << "each its own range";
    }
}

TEST(ViewFigures, TheBarEndsWhereItsScaleEnds) {
    for (const char* theme : {"dark", "light"}) {
        FigureWindow w;
        w.run("view.theme", theme);
        w.run("compare.fits", "mobb,leaf=4 umobb,leaf=4");
        w.run("view.level", "1");
        w.run("view.color_by", "volume");
        for (const std::size_t place : {0u, 1u}) {
            w.session.views.activate(place);
            w.window.settle();
            const ColorScale& scale = w.session.figures.boxes()->scale;
            const Palette& colors = w.window.shell().shown()->palette;
            // Between the two handles, on the stripe of colours below the bars.
            const Rect from = w.rect("view.color_range.from"), to = w.rect("view.color_range.to");
            const float y = from.min.y + 32;
            for (const auto& [x, value] :
                 {std::pair(from.center().x + 2, scale.least), {to.center().x - 2, scale.most}})
                EXPECT_LT(glm::length(w.pixel({x, y}) - scale.color(value, colors)), 0.06f)
                    << theme << ' ' << place << ' ' << value;
        }
    }
}

/// The table's part of the cost is that of the colours and the strip, whatever costs are about.
TEST(ViewFigures, ThePartOfTheCostIsTheExpectedOne) {
    FigureWindow w;
    w.session.settings.cost_of = QueryWorkload::Kind::queries;
    w.session.costs.count();
    w.window.settle();
    const int clip = clip_in_focus(w.session.workspace);
    const mobb::Tree& tree = w.session.workspace.fitted().tree(clip);
    const std::vector<double> expected = expected_cost(tree, tree)->node_shares();
    const std::shared_ptr<const NodeValues> table = w.session.nodes.values();
    const std::span<const double> strip = w.session.figures.column(clip, NodeField::share);
    for (int node = 0; node < table->size(); ++node) {
        EXPECT_EQ(table->value(NodeField::share, node), expected[static_cast<std::size_t>(node)]);
        EXPECT_EQ(strip[static_cast<std::size_t>(node)], expected[static_cast<std::size_t>(node)]);
    }
}

/// Where the strip has a node.
struct OnStrip {
    FigureWindow& w;
    glm::vec2 of(int agent, int node) {
        const PlacedAgent& who = w.session.workspace.fitted().placed_agents()[static_cast<std::size_t>(agent)];
        const mobb::PlacedTree placed = w.session.workspace.fitted().placed(who);
        const mobb::Interval span = time_span(w.session.workspace);
        const Rect strip = w.rect("nodes.levels");
        const double middle = 0.5 * (placed.begin(placed.node(node)) + placed.end(placed.node(node)));
        const auto share = static_cast<float>((middle - span.t0) / (span.t1 - span.t0));
        const auto level = static_cast<float>(placed.tree().level(node));
        return {strip.min.x + share * strip.size().x,
                strip.min.y + (level + 0.5f) / static_cast<float>(placed.tree().depth()) * strip.size().y};
    }
};

TEST(LevelStrip, LevelsDiffer) {
    for (const char* theme : {"dark", "light"}) {
        FigureWindow w;
        w.run("view.theme", theme);
        w.run("view.level", "3");
        w.run("view.color_by", "volume");
        w.run("bottom.show", "nodes");
        const mobb::Tree& tree = w.session.workspace.fitted().tree(clip_in_focus(w.session.workspace));
        OnStrip on{w};
        std::vector<float> contrasts;
        for (int node = 0; !tree.is_leaf(node); node = tree.children(node)[0])
            contrasts.push_back(contrast(w.pixel(on.of(0, node)), w.window.shell().shown()->palette.background));
        ASSERT_GT(contrasts.size(), 3u);
        for (std::size_t level = 1; level < contrasts.size(); ++level)
            EXPECT_LT(contrasts[level], 0.95f * contrasts[level - 1]) << theme << ' ' << level;
    }
}

TEST(LevelStrip, TellsAndSelectsTheNodeUnderTheMouse) {
    FigureWindow w;
    w.run("bottom.show", "nodes");
    ASSERT_TRUE(w.has("nodes.levels"));
    const Rect bars = w.rect("timeline.time"), strip = w.rect("nodes.levels");
    EXPECT_FLOAT_EQ(strip.min.x, bars.min.x) << "one time axis";
    EXPECT_FLOAT_EQ(strip.max.x, bars.max.x);
    const mobb::Tree& tree = w.session.workspace.fitted().tree(clip_in_focus(w.session.workspace));
    OnStrip on{w};
    for (const int node : {0, 1, tree.children(1)[1], static_cast<int>(tree.nodes().size()) - 1}) {
        w.move(on.of(0, node));
        EXPECT_EQ(w.session.workspace.hovered, (Selection{Selection::Kind::node, {0, -1, 0}, node}));
    }
    w.click(on.of(0, 1));
    EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::node, {0, -1, 0}, 1}));
    w.move({800, 300});
    EXPECT_EQ(w.session.workspace.hovered.kind == Selection::Kind::node && w.session.workspace.hovered.index == 1,
              false);
    // Of the other agent, once it is in focus.
    w.run("go.agent", "B");
    w.click(on.of(1, 2));
    EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::node, {1, -1, 0}, 2}));
}

}  // namespace
}  // namespace mobbscope::app
