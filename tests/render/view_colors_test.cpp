// Boxes and disks in the colours of figures: each compared with the colour of a value that is found out another way.
#include <base/text.h>
#include <explain/avoidable.h>
#include <explain/expected_cost.h>
#include <render/drawlist/color_scale.h>
#include <render/drawlist/palette.h>
#include <render/layout/box_colors.h>
#include <render/parts/paths.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>
#include <scene/drawn_agent.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// Of the clip that all agents of these scenes play: its node or sample.
using Count = std::map<int, double>;

/// Two that hit and one beside them, so that two queries find something and one finds nothing.
FittedScene three_paths(mobb::TreeKind kind = mobb::TreeKind::umobb) {
    mobb::FitOptions options;
    options.tree = kind;
    options.leaf = 4;
    return {testing::scene_of({{}, {{1, -1}, 90, 0}, {{0.2, 1.1}, 10, 0}}), options};
}

DrawList colored_by(const FittedScene& fitted, ColorBy color_by, LevelRange levels = {0, 4, false},
                    std::optional<ValueRange> range = {}) {
    ViewState view;
    view.color_by = color_by;
    view.color_range = range;
    view.levels = levels;
    return build_draw_list(fitted, view, kGoldenSize);
}

glm::dvec3 half_edge(const DrawList& list, const BoxInstance& box, std::size_t axis) {
    const glm::dvec3 drawn(box.extents[axis]);
    return {drawn.x, drawn.y, drawn.z / list.space.time_height};
}

/// From what is drawn: eight times the product of the half edges that lie across one another.
double drawn_volume(const DrawList& list, const BoxInstance& box) {
    return 8 *
           std::abs(glm::dot(half_edge(list, box, 0), glm::cross(half_edge(list, box, 1), half_edge(list, box, 2))));
}

/// Around the drawn corners on the floor, with the rope that a gift is wrapped in.
double drawn_shadow(const BoxInstance& box) {
    std::vector<glm::dvec2> corners;
    for (const glm::vec3& corner : box_corners(box)) corners.emplace_back(corner.x, corner.y);
    const auto before = [](glm::dvec2 a, glm::dvec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::ranges::sort(corners, before);
    const auto turn = [](glm::dvec2 o, glm::dvec2 a, glm::dvec2 b) {
        return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    };
    double area = 0;
    for (const bool upper : {false, true}) {
        std::vector<glm::dvec2> hull;
        for (const glm::dvec2 point : corners) {
            while (hull.size() > 1 && (turn(hull[hull.size() - 2], hull.back(), point) <= 0) != upper) hull.pop_back();
            hull.push_back(point);
        }
        for (std::size_t i = 1; i < hull.size(); ++i) {
            const double strip = 0.5 * (hull[i].x - hull[i - 1].x) * (hull[i].y + hull[i - 1].y);
            area += upper ? strip : -strip;
        }
    }
    return area;
}

/// Of the points of a grid in the drawn box, those outside the node's time.
double drawn_overhang(const DrawList& list, const BoxInstance& box, double t0, double t1) {
    constexpr int kPoints = 30;
    int outside = 0;
    const auto at = [](int i) { return (2 * i + 1.0) / kPoints - 1; };
    for (int i = 0; i < kPoints; ++i) {
        for (int j = 0; j < kPoints; ++j) {
            for (int k = 0; k < kPoints; ++k) {
                const double t = box.center.z / list.space.time_height + list.space.origin.z +
                                 at(i) * half_edge(list, box, 0).z + at(j) * half_edge(list, box, 1).z +
                                 at(k) * half_edge(list, box, 2).z;
                if (t < t0 || t > t1) ++outside;
            }
        }
    }
    return outside / std::pow(kPoints, 3);
}

/// How often each node's box was tested, straight from the traces.
Count tests_of_nodes(const FittedScene& fitted) {
    Count out;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const RecordedQuery asked = record(fitted, fitted.queries()[i]);
        for (int event = 0; event < asked.trace.size(); ++event) {
            const mobb::Trace::Event test = asked.trace[event];
            if (!test.test.is_box()) continue;
            ++out[test.a];
            ++out[test.b];
        }
    }
    return out;
}

Count blame_of_nodes(const FittedScene& fitted) {
    Count out;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery asked = record(fitted, query);
        for (int event = 0; event < asked.trace.size(); ++event) {
            const auto found = avoidable_overlap(fitted.placed(query.a), fitted.placed(query.b), asked.trace[event]);
            if (!found) continue;
            if (blames(found->blame, 0)) ++out[asked.trace[event].a];
            if (blames(found->blame, 1)) ++out[asked.trace[event].b];
        }
    }
    return out;
}

double value_of(const FittedScene& fitted, const DrawList& list, const BoxInstance& box, ColorBy color_by) {
    const mobb::Tree& tree = fitted.tree(0);
    const mobb::Node& node = tree.node(box.id.index);
    const double volume = drawn_volume(list, box);
    double filled = 0;
    for (int i = node.first; i < node.end(); ++i)
        filled += std::numbers::pi * std::pow(tree.clip().samples()[static_cast<std::size_t>(i)].r, 2) / 30;
    switch (color_by) {
        case ColorBy::level:
            return box.order.level;
        case ColorBy::volume:
            return volume;
        case ColorBy::empty:
            return volume - filled;
        case ColorBy::waste: {
            // The list has the children of no leaf, and of other nodes all: their volumes are those of the tree.
            double below = tree.is_leaf(box.id.index) ? filled : 0;
            for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
                if (tree.parent(i) == box.id.index) below += mobb::volume(tree.box(i), tree.time_scale());
            }
            return volume - below;
        }
        case ColorBy::fill:
            return filled / volume;
        case ColorBy::floor:
            return drawn_shadow(box);
        case ColorBy::overhang:
            return drawn_overhang(list, box, tree.t0(node), tree.t1(node));
        case ColorBy::share:
            return expected_cost(tree, tree)->node_shares()[static_cast<std::size_t>(box.id.index)];
        case ColorBy::tests:
            return tests_of_nodes(fitted)[box.id.index];
        case ColorBy::avoidable:
            return blame_of_nodes(fitted)[box.id.index];
        case ColorBy::agent:
            break;
    }
    return kNoValue;
}

/// 0 to 1, of the range from the least to the most.
double share_of(ColorBy color_by, double value, double least, double most) {
    const bool counts = color_by == ColorBy::tests || color_by == ColorBy::avoidable;
    const bool linear = color_by == ColorBy::fill || color_by == ColorBy::overhang || color_by == ColorBy::level;
    const double more = counts ? 1 : 0;
    if (linear || least + more <= 0 || most + more < 10 * (least + more)) return (value - least) / (most - least);
    return std::log((value + more) / (least + more)) / std::log((most + more) / (least + more));
}

/// Values that are nearly equal look so: the ends of the colours are a twentieth of the larger one apart.
void widen(double& least, double& most) {
    const double room = std::max(0.0, 0.05 * std::max(std::abs(least), std::abs(most)) - (most - least));
    least -= room / 2;
    most += room / 2;
}

class BoxFiguresTest : public ::testing::TestWithParam<ColorBy> {};

TEST_P(BoxFiguresTest, ABoxHasTheColourOfItsFigure) {
    const FittedScene fitted = three_paths();
    const ColorBy color_by = GetParam();
    for (const LevelRange levels : {LevelRange{2, 2, false}, LevelRange{0, 2, false}}) {
        // On one level boxes lean alike: a grid of points does not tell them apart.
        if (color_by == ColorBy::overhang && levels.first == levels.last) continue;
        const DrawList list = colored_by(fitted, color_by, levels);
        std::vector<std::pair<const BoxInstance*, double>> boxes;
        double least = 1e300, most = -1e300;
        for (const BoxInstance& box : list.boxes) {
            ASSERT_EQ(box.state, BoxState::level);
            boxes.emplace_back(&box, value_of(fitted, list, box, color_by));
            least = std::min(least, boxes.back().second);
            most = std::max(most, boxes.back().second);
        }
        ASSERT_EQ(boxes.size(), levels.first == 2 ? 12u : 21u) << "of three agents, too few to leave any out";
        if (color_by == ColorBy::level) {
            least = 0;
            most = fitted.tree(0).depth() - 1;
        }
        ASSERT_GT(most, least);
        // What is not above 0 has no logarithm: the scale begins at the least that is.
        double above = 1e300;
        for (const auto& [box, value] : boxes) above = value > 0 ? std::min(above, value) : above;
        if (color_by == ColorBy::waste && least <= 0 && most >= 10 * above) least = above;
        widen(least, most);
        for (const auto& [box, value] : boxes) {
            const double share = share_of(color_by, std::max(value, least), least, most);
            const auto worse = static_cast<float>(color_by == ColorBy::fill ? 1 - share : share);
            const Rgba wanted = quantity_color(worse, list.palette);
            // A grid of points finds overhangs to the hundredth.
            const float tolerance = color_by == ColorBy::overhang ? 0.06f : 2e-3f;
            EXPECT_LT(glm::length(with_alpha(box->fill, 1) - wanted), tolerance) << box->id.index << ' ' << value;
            EXPECT_LT(glm::length(with_alpha(box->edge, 1) - outlining(wanted, list.palette)), tolerance);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, BoxFiguresTest,
                         ::testing::Values(ColorBy::level, ColorBy::volume, ColorBy::empty, ColorBy::waste,
                                           ColorBy::fill, ColorBy::floor, ColorBy::overhang, ColorBy::share,
                                           ColorBy::tests, ColorBy::avoidable),
                         [](const auto& one) { return std::string(name(one.param)); });

TEST(FigureColors, APartAloneKeepsItsColours) {
    const FittedScene fitted = three_paths();
    const DrawList all = colored_by(fitted, ColorBy::volume);
    ViewState view;
    view.color_by = ColorBy::volume;
    view.levels = {0, 4, false};
    view.subtree = DrawnNode{0, fitted.tree(0).children(0)[1]};
    const DrawList part = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_LT(part.boxes.size(), all.boxes.size());
    for (const BoxInstance& box : part.boxes) {
        const auto same = std::ranges::find(all.boxes, box.id, &BoxInstance::id);
        ASSERT_NE(same, all.boxes.end());
        EXPECT_EQ(with_alpha(box.fill, 1), with_alpha(same->fill, 1)) << box.id.index;
    }
}

TEST(FigureColors, AChosenRangeIsExactAndWhatIsOutsideStepsBack) {
    const FittedScene fitted = three_paths();
    const DrawList usual = colored_by(fitted, ColorBy::fill),
                   list = colored_by(fitted, ColorBy::fill, {0, 4, false}, {{10, 30}});
    ASSERT_EQ(list.boxes.size(), usual.boxes.size());
    int inside = 0, outside = 0;
    for (std::size_t i = 0; i < list.boxes.size(); ++i) {
        const double fill = value_of(fitted, list, list.boxes[i], ColorBy::fill);
        const auto share = static_cast<float>(std::clamp((fill - 0.1) / 0.2, 0.0, 1.0));
        EXPECT_LT(glm::length(with_alpha(list.boxes[i].fill, 1) - quantity_color(1 - share, list.palette)), 2e-3f);
        const bool is_inside = fill >= 0.1 && fill <= 0.3;
        ++(is_inside ? inside : outside);
        if (is_inside) continue;
        EXPECT_LT(list.boxes[i].edge.a, 0.5f * usual.boxes[i].edge.a) << fill;
    }
    EXPECT_GT(inside, 0);
    EXPECT_GT(outside, 0);
}

TEST(FigureColors, WhatHasNoFigureIsNeutral) {
    const DrawList list = colored_by(three_paths(mobb::TreeKind::mobb), ColorBy::overhang);
    for (const BoxInstance& box : list.boxes) EXPECT_EQ(with_alpha(box.fill, 1), list.palette.axis);
    const auto said = [&](const char* words) {
        return std::ranges::any_of(list.texts,
                                   [&](const TextRun& text) { return text.text.find(words) != std::string::npos; });
    };
    EXPECT_TRUE(said("boxes: overhang in time (unknown here)"));
}

/// The colours of the bar between the two values at its ends.
std::vector<Rgba> colors_of_bar(const DrawList& list, const std::string& least, const std::string& most) {
    const auto text = [&](const std::string& wanted) {
        return std::ranges::find_if(list.texts, [&](const TextRun& run) { return run.text == wanted; });
    };
    const auto from = text(least), to = text(most);
    std::vector<Rgba> out;
    if (from == list.texts.end() || to == list.texts.end()) return out;
    for (const OverlayPanel& panel : list.panels) {
        const float y = panel.rect.center().y;
        const bool between = panel.rect.min.x >= from->box.max.x && panel.rect.max.x <= to->box.min.x &&
                             y > from->box.min.y && y < from->box.max.y;
        if (between) out.push_back(panel.fill);
    }
    return out;
}

TEST(FigureColors, TheBarSaysWhatTheColoursMean) {
    const FittedScene fitted = three_paths();
    const DrawList list = colored_by(fitted, ColorBy::fill, {0, 4, false}, {{20, 30}});
    const auto title =
        std::ranges::find_if(list.texts, [](const TextRun& text) { return text.text == "boxes: fill, %"; });
    ASSERT_NE(title, list.texts.end());
    EXPECT_EQ(title->role, TextRole::legend);
    const std::vector<Rgba> bar = colors_of_bar(list, "<20", ">30");
    ASSERT_GT(bar.size(), 20u);
    // The emptier, the brighter.
    EXPECT_LT(glm::length(bar.front() - quantity_color(1, list.palette)), 0.05f);
    EXPECT_LT(glm::length(bar.back() - quantity_color(0, list.palette)), 0.05f);
    for (const OverlayPanel& panel : list.panels) EXPECT_TRUE((Rect{{0, 0}, {640, 360}}.contains(panel.rect)));

    const DrawList levels = colored_by(fitted, ColorBy::level, {1, 3, false});
    const std::vector<Rgba> of_levels = colors_of_bar(levels, "0", "4");
    ASSERT_GT(of_levels.size(), 20u) << "the whole range of levels, whichever are shown";
    EXPECT_LT(glm::length(of_levels.front() - quantity_color(0, levels.palette)), 0.05f);
}

TEST(FigureColors, AChosenRangeOfLevelsIsOfTheBoxesAlone) {
    const DrawList list = colored_by(three_paths(), ColorBy::level, {1, 3, false}, {{1, 3}});
    EXPECT_GT(colors_of_bar(list, "1", "3").size(), 20u) << "no level lies outside";
}

/// What the picture's boxes have is what box_colors says, whichever picture shows them.
TEST(FigureColors, TheScaleIsThatOfTheBoxesInThePicture) {
    const auto fitted = std::make_shared<const FittedScene>(three_paths());
    SceneFigures figures;
    ViewState view;
    view.color_by = ColorBy::volume;
    view.levels = {1, 2, false};
    view.hidden = {fitted->scene().agents[1].name};
    for (const Show show : {Show::space_time, Show::plan, Show::moment}) {
        view.show = show;
        const auto colors = box_colors(figures, fitted, view);
        ASSERT_EQ(colors.has_value(), show != Show::moment) << "a moment shows no boxes";
        const DrawList list = build_draw_list(*fitted, view, kGoldenSize);
        if (!colors) continue;
        EXPECT_EQ(colors->values.size(), 12u) << "two agents' six nodes";
        EXPECT_GT(colors_of_bar(list, colors->scale.least_text(), colors->scale.most_text()).size(), 20u);
        if (show != Show::space_time) continue;
        ASSERT_EQ(list.boxes.size(), colors->values.size());
        for (std::size_t i = 0; i < list.boxes.size(); ++i) {
            const Rgba wanted = colors->scale.color(colors->values[i], list.palette);
            EXPECT_LT(glm::length(with_alpha(list.boxes[i].fill, 1) - wanted), 2e-3f);
        }
    }
    view.show = Show::space_time;
    view.boxes = false;
    EXPECT_FALSE(box_colors(figures, fitted, view));
    view.boxes = true;
    view.query = 0;
    EXPECT_FALSE(box_colors(figures, fitted, view)) << "the boxes of a query say what its tests found";
}

TEST(FigureColors, PicturesBesideShareOneScale) {
    const auto fitted = std::make_shared<const FittedScene>(three_paths());
    const auto other = std::make_shared<const FittedScene>(three_paths(mobb::TreeKind::mobb));
    SceneFigures figures;
    ViewState view;
    view.levels = {1, 2, false};
    view.color_by = ColorBy::volume;
    BoxColors one = *box_colors(figures, fitted, view), two = *box_colors(figures, other, view);
    view.color_by = ColorBy::fill;
    BoxColors third = *box_colors(figures, other, view);
    const ColorScale of_fill = third.scale;
    const double least = std::min(one.scale.least, two.scale.least), most = std::max(one.scale.most, two.scale.most);
    ASSERT_NE(one.scale, two.scale);
    const std::vector<double> values = one.values;
    share_scale({&one, &two, nullptr, &third});
    EXPECT_EQ(one.scale, two.scale);
    EXPECT_DOUBLE_EQ(one.scale.least, least);
    EXPECT_DOUBLE_EQ(one.scale.most, most);
    EXPECT_EQ(one.values, values);
    EXPECT_EQ(third.scale, of_fill) << "another figure has its own";
    KeptPaths kept(fitted);
    kept.adopt_colors(std::make_shared<const BoxColors>(one));
    view.color_by = ColorBy::volume;
    const DrawList list = build_draw_list(kept, view, {.size = kGoldenSize});
    for (const BoxInstance& box : list.boxes) {
        const Rgba wanted = one.scale.color(drawn_volume(list, box), list.palette);
        EXPECT_LT(glm::length(with_alpha(box.fill, 1) - wanted), 2e-3f);
    }
    view.color_range = ValueRange{1, 2};
    one = *box_colors(figures, fitted, view);
    share_scale({&one, &two});
    EXPECT_EQ(one.scale.most, 2) << "a chosen range is exact";
}

TEST(FigureColors, NothingIsCountedWhereItIsDoneElsewhere) {
    const auto fitted = std::make_shared<const FittedScene>(three_paths());
    const auto figures = std::make_shared<SceneFigures>(SceneFigures::Counting::elsewhere);
    KeptPaths kept(fitted, figures);
    ViewState view;
    view.color_by = ColorBy::tests;
    const DrawList before = build_draw_list(kept, view, {.size = kGoldenSize});
    EXPECT_EQ(with_alpha(before.boxes[0].fill, 1), before.palette.axis);
    const auto title = std::ranges::find_if(
        before.texts, [](const TextRun& text) { return text.text == "boxes: number of tests (not counted)"; });
    EXPECT_NE(title, before.texts.end());
    figures->take(fitted, std::make_shared<const SceneCosts>(scene_costs(*fitted)), nullptr);
    const DrawList after = build_draw_list(kept, view, {.size = kGoldenSize});
    const DrawList at_once = colored_by(*fitted, ColorBy::tests, view.levels);
    ASSERT_EQ(after.boxes.size(), at_once.boxes.size());
    for (std::size_t i = 0; i < after.boxes.size(); ++i) EXPECT_EQ(after.boxes[i].fill, at_once.boxes[i].fill);
    // Other placements are asked anew.
    Scene moved = fitted->scene();
    moved.agents[1].placement.translate.x += 1;
    const auto other = std::make_shared<const FittedScene>(moved, fitted->options(), fitted.get());
    figures->take(other, nullptr, nullptr);
    EXPECT_FALSE(figures->of(other, 0, NodeField::tests).has(NodeField::tests));
}

TEST(Heat, ADiskHasTheColourOfTheTestsThatHoldIt) {
    const FittedScene fitted = three_paths(mobb::TreeKind::mobb);
    Count heat;
    double most = 0;
    for (const auto& [node, tests] : tests_of_nodes(fitted)) {
        const mobb::Node& of = fitted.tree(0).node(node);
        for (int sample = of.first; sample < of.end(); ++sample) heat[sample] += tests;
    }
    for (const auto& [sample, tests] : heat) most = std::max(most, tests);
    ASSERT_EQ(heat.size(), 60u);
    ASSERT_GT(most, 0);
    ViewState view;
    view.heat = true;
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_EQ(list.disks.size(), 180u);
    for (const DiskInstance& disk : list.disks) {
        // From 0 on, whatever the least is.
        const auto share = static_cast<float>(share_of(ColorBy::tests, heat[disk.id.index], 0, most));
        EXPECT_LT(glm::length(disk.color - quantity_color(share, list.palette)), 2e-3f) << disk.id.index;
    }
    EXPECT_TRUE(std::ranges::any_of(
        list.texts, [](const TextRun& text) { return text.text.starts_with("disks: tests of boxes that hold them"); }));
    EXPECT_FALSE(colors_of_bar(list, "0", figure(most, 3)).empty()) << "the bar says both ends";
    view.heat = false;
    EXPECT_NE(build_draw_list(fitted, view, kGoldenSize).disks[0].color, list.disks[0].color);
}

TEST(Heat, DisksOutOfFocusStepBack) {
    const FittedScene fitted = three_paths(mobb::TreeKind::mobb);
    ViewState view;
    view.heat = true;
    const DrawList all = build_draw_list(fitted, view, kGoldenSize);
    view.subtree = DrawnNode{0, 1};
    const DrawList part = build_draw_list(fitted, view, kGoldenSize);
    const mobb::Node& node = fitted.tree(0).node(1);
    ASSERT_EQ(part.disks.size(), all.disks.size());
    for (std::size_t i = 0; i < all.disks.size(); ++i) {
        const DiskInstance &was = all.disks[i], &is = part.disks[i];
        const bool inside = is.id.agent != 0 || (is.id.index >= node.first && is.id.index < node.end());
        Rgba wanted = was.color;
        if (!inside) wanted.a *= kOutOfFocus;
        EXPECT_EQ(is.color, wanted) << is.id.agent << ' ' << is.id.index;
    }
    // ... and of an agent beside one that stands out.
    DrawnAgent agent = drawn_agents(fitted, view)[1];
    agent.dimmed = true;
    PathFocus focus;
    focus.colors = std::make_shared<const std::vector<Rgba>>(60, Rgba(1, 0, 0, 1));
    DrawList dim;
    dim.palette = all.palette;
    dim.space = all.space;
    add_disks(dim, agent, focus);
    ASSERT_EQ(dim.disks.size(), 60u);
    EXPECT_EQ(dim.disks[0].color, mix_colors(all.palette.background, Rgba(1, 0, 0, 1), kDimmed));
}

TEST(Heat, WithoutQueriesItIsWhatIsExpected) {
    const FittedScene fitted(testing::scene_of({{}}), {.leaf = 4});
    const std::vector<double> shares = expected_cost(fitted.tree(0), fitted.tree(0))->node_shares();
    Count heat;
    for (int node = 0; node < static_cast<int>(shares.size()); ++node) {
        const mobb::Node& of = fitted.tree(0).node(node);
        for (int i = of.first; i < of.end(); ++i) heat[i] += shares[static_cast<std::size_t>(node)];
    }
    std::vector<double> sorted;
    for (const auto& [sample, value] : heat) sorted.push_back(value);
    std::ranges::sort(sorted);
    const double most = sorted[sorted.size() - 2];
    ViewState view;
    view.heat = true;
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_EQ(list.disks.size(), 60u);
    for (const DiskInstance& disk : list.disks) {
        const auto share = static_cast<float>(std::min(heat[disk.id.index] / most, 1.0));
        EXPECT_LT(glm::length(disk.color - quantity_color(share, list.palette)), 2e-3f) << disk.id.index;
    }
}

/// The kept disks take other colours and give them back.
TEST(Heat, KeptDisksAreColouredAnew) {
    const auto fitted = std::make_shared<const FittedScene>(three_paths());
    KeptPaths kept(fitted);
    ViewState view;
    const DrawList usual = build_draw_list(kept, view, {.size = kGoldenSize});
    view.heat = true;
    const DrawList hot = build_draw_list(kept, view, {.size = kGoldenSize});
    const DrawList again = build_draw_list(kept, view, {.size = kGoldenSize});
    EXPECT_TRUE(again.disks.shares_with(hot.disks)) << "nothing is made anew for the same picture";
    const DrawList without = build_draw_list(*fitted, view, kGoldenSize);
    for (std::size_t i = 0; i < hot.disks.size(); ++i) EXPECT_EQ(hot.disks[i].color, without.disks[i].color);
    view.heat = false;
    const DrawList back = build_draw_list(kept, view, {.size = kGoldenSize});
    for (std::size_t i = 0; i < hot.disks.size(); ++i) EXPECT_EQ(back.disks[i].color, usual.disks[i].color);
}

// --- the scale

ColoredFigure figure_named(NodeField field) { return colored_figure(info(field)); }

/// Whatever the theme, the worst is what the eye meets first.
TEST(ColorScale, TheWorstStandsOutMostInBothThemes) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        for (const NodeField field : {NodeField::empty, NodeField::fill}) {
            const Palette& colors = palette(theme);
            const ColorScale scale = color_scale(figure_named(field), std::vector<double>{0.1, 0.9});
            const auto stands_out = [&](int i) {
                const float share = static_cast<float>(i) / 10;
                return contrast(scale.color_at(field == NodeField::fill ? 1 - share : share, colors),
                                colors.background);
            };
            for (int i = 1; i <= 10; ++i) EXPECT_GT(stands_out(i), stands_out(i - 1)) << name(theme) << ' ' << i;
            EXPECT_GT(stands_out(0), 1.5f) << "the best is seen too";
        }
    }
}

TEST(ColorScale, HeatBeginsAtZero) {
    for (const NodeField field : {NodeField::tests, NodeField::share}) {
        ColoredFigure heat = figure_named(field);
        heat.from_zero = true;
        const ColorScale scale = color_scale(heat, std::vector<double>{30, 31, 32});
        EXPECT_EQ(scale.least, 0);
        EXPECT_EQ(scale.most, 32);
        EXPECT_EQ(scale.least_text(), "0");
        EXPECT_EQ(scale.share(0), 0);
        EXPECT_LT(scale.share(32) - scale.share(30), 0.1f) << "what is nearly alike looks so";
    }
}

TEST(ColorScale, AFewThatStandAloneDoNotTakeAllColours) {
    std::vector<double> values(100, 0);
    for (std::size_t i = 0; i < 100; ++i) values[i] = 0.4 + 0.002 * static_cast<double>(i);
    values[7] = 0.99;
    const ColorScale scale = color_scale(figure_named(NodeField::fill), values);
    EXPECT_FALSE(scale.logarithmic);
    EXPECT_GT(scale.share(values[98]) - scale.share(values[2]), 0.95f);
    EXPECT_EQ(scale.share(0.99), 1);
    EXPECT_TRUE(scale.has_more);
    EXPECT_EQ(scale.most_text(), ">59.6");
    EXPECT_FALSE(scale.chosen) << "what was left out does not step back";
}

TEST(ColorScale, ValuesThatAreNearlyEqualHaveNearlyOneColour) {
    const ColorScale scale = color_scale(figure_named(NodeField::fill), std::vector<double>{0.434, 0.435});
    EXPECT_LT(scale.share(0.435) - scale.share(0.434), 0.05f);
    EXPECT_GT(scale.share(0.435), scale.share(0.434));
    EXPECT_FALSE(scale.has_less || scale.has_more);
    const ColorScale chosen =
        color_scale(figure_named(NodeField::fill), std::vector<double>{0.434, 0.435}, {{43.4, 43.5}});
    EXPECT_EQ(chosen.share(0.435), 1) << "a chosen range is exact";
    const ColorScale nothing = color_scale(figure_named(NodeField::avoidable), std::vector<double>{0, 0});
    EXPECT_EQ(nothing.share(0), 0);
}

TEST(ColorScale, VolumesThatAreADecadeApartHaveALogarithmicOne) {
    const std::vector<double> values{1, 10, 100, 0};
    const ColorScale scale = color_scale(figure_named(NodeField::volume), values);
    EXPECT_TRUE(scale.logarithmic);
    EXPECT_EQ(scale.title(), "volume, m\u00B2\u00B7s (log)");
    EXPECT_FLOAT_EQ(scale.share(10), 0.5f);
    EXPECT_FLOAT_EQ(scale.share(0), 0);
    EXPECT_TRUE(scale.has_less) << "nothing has no logarithm";
    EXPECT_NEAR(scale.value_at(0.5f), 10, 1e-6);
    EXPECT_FALSE(color_scale(figure_named(NodeField::volume), std::vector<double>{1, 9}).logarithmic);
}

TEST(ColorScale, CountsBeginAtNothing) {
    const ColorScale scale = color_scale(figure_named(NodeField::avoidable), std::vector<double>{0, 1, 99, 0});
    EXPECT_TRUE(scale.logarithmic);
    EXPECT_EQ(scale.share(0), 0);
    EXPECT_GT(scale.share(1), 0.1f) << "one is told from none";
    EXPECT_NEAR(scale.value_at(scale.share(1)), 1, 1e-6);
    EXPECT_EQ(scale.most_text(), "99");
}

TEST(ColorScale, AChosenRangeIsInTheUnitThatIsShown) {
    const ColorScale scale = color_scale(figure_named(NodeField::overhang), std::vector<double>{0.1, 0.4}, {{20, 40}});
    EXPECT_DOUBLE_EQ(scale.least, 0.2);
    EXPECT_EQ(scale.least_text(), "<20");
    EXPECT_EQ(scale.most_text(), "40");
    EXPECT_TRUE(scale.outside(0.1));
    EXPECT_EQ(scale.text(0.35), "35 %");
    const ColorScale other = color_scale(figure_named(NodeField::empty), std::vector<double>{1, 2}, {{0, 5}});
    EXPECT_FALSE(other.logarithmic);
    EXPECT_EQ(other.share(2.5), 0.5f);
}

TEST(ColorScale, AllOfOneValueAndNoneAreNoFault) {
    const ColorScale one = color_scale(figure_named(NodeField::volume), std::vector<double>{3, 3});
    EXPECT_FLOAT_EQ(one.share(3), 0.5f);
    const ColorScale none = color_scale(figure_named(NodeField::volume), std::vector<double>{kNoValue});
    EXPECT_FALSE(none.known);
    const Palette& colors = palette(Theme::dark);
    EXPECT_EQ(none.color(kNoValue, colors), colors.axis);
    EXPECT_EQ(value_counts(one, std::vector<double>{3, kNoValue, 3}, 4), (std::vector<std::size_t>{0, 0, 2, 0}));
}

TEST(ColorScale, EveryModeButTheAgentsHasAFigure) {
    EXPECT_EQ(color_figure(ColorBy::agent), nullptr);
    for (const ColorBy color_by : {ColorBy::level, ColorBy::volume, ColorBy::empty, ColorBy::fill, ColorBy::floor,
                                   ColorBy::overhang, ColorBy::share, ColorBy::tests, ColorBy::avoidable}) {
        ASSERT_NE(color_figure(color_by), nullptr) << name(color_by);
        EXPECT_EQ(color_figure(color_by)->name, name(color_by));
    }
}

}  // namespace
}  // namespace mobbscope
