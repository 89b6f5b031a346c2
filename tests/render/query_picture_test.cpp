#include <explain/query_progress.h>
#include <explain/query_sentence.h>
#include <mobb/random_motion.h>
#include <mobb/traversal.h>
#include <render/layout/caption.h>
#include <render/pictures/build_draw_list.h>
#include <render/query/query_boxes.h>
#include <render/query/separation_gap.h>
#include <scene/scene.h>
#include <support/folders.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

struct Query {
    explicit Query(FittedScene scene) : fitted(std::move(scene)), recorded(record(fitted, fitted.queries()[0])) {
        view.query = 0;
        sides = drawn_agents(fitted, view);
    }
    DrawList at(int step, PictureSize size = kGoldenSize) {
        view.step = {Step::Unit::event, static_cast<double>(step)};
        return build_draw_list(fitted, view, size);
    }
    int find(mobb::TestKind test, mobb::Outcome outcome) const {
        for (int i = 0; i < recorded.trace.size(); ++i) {
            if (recorded.trace[i].test == test && recorded.trace[i].outcome == outcome) return i;
        }
        return -1;
    }

    FittedScene fitted;
    RecordedQuery recorded;
    ViewState view;
    std::vector<DrawnAgent> sides;
};

TEST(QueryProgress, StepsAreEventsPercentagesOrTheEnd) {
    const Query query(testing::hit_scene());
    const int last = query.recorded.trace.size() - 1;
    const auto event_at = [&](const Step& step) { return event_of(step, query.recorded.trace, query.fitted, 0); };
    EXPECT_EQ(event_at({Step::Unit::end, 0}), last);
    EXPECT_EQ(event_at({Step::Unit::percent, 100}), last);
    EXPECT_EQ(event_at({Step::Unit::percent, 0}), 0);
    EXPECT_EQ(event_at({Step::Unit::event, 3}), 3);
    EXPECT_THROW(event_at({Step::Unit::event, last + 1.0}), std::invalid_argument);
}

TEST(QueryProgress, OnlyTestedNodesAreKnown) {
    const Query query(testing::hit_scene());
    for (int step = 0; step < query.recorded.trace.size(); ++step) {
        const QueryProgress progress = progress_at(query.recorded.trace, step, Past::all);
        for (const NodeProgress& node : progress.nodes[0]) {
            EXPECT_NE(node.node, progress.event.a);
            bool tested = false;
            for (int i = 0; i <= step; ++i) tested = tested || query.recorded.trace[i].a == node.node;
            EXPECT_TRUE(tested);
        }
    }
}

/// Which nodes of A and B each kind of past tells of, worked out from the trace by itself.
TEST(QueryProgress, ThePastIsThePairTheAncestorsTheSiblingsOrAll) {
    // Of which siblings have children of their own.
    const Query query(FittedScene(load_scene(kCrossing), {}));
    const mobb::Trace& trace = query.recorded.trace;
    bool siblings_differ = false;
    bool all_differ = false;
    for (int step = 0; step < trace.size(); ++step) {
        std::set<std::pair<std::size_t, int>> chain;
        for (int i = trace[step].parent; i >= 0; i = trace[i].parent) chain.insert({{0, trace[i].a}, {1, trace[i].b}});
        auto siblings = chain;
        std::set<std::pair<std::size_t, int>> all;
        for (int i = 0; i <= step; ++i) {
            all.insert({{0, trace[i].a}, {1, trace[i].b}});
            if (trace[step].parent >= 0 && trace[i].parent == trace[step].parent) {
                siblings.insert({{0, trace[i].a}, {1, trace[i].b}});
            }
        }
        const auto told = [&](Past past) {
            std::set<std::pair<std::size_t, int>> out;
            const QueryProgress progress = progress_at(trace, step, past);
            for (const std::size_t side : {0u, 1u}) {
                for (const NodeProgress& node : progress.nodes[side]) out.emplace(side, node.node);
            }
            return out;
        };
        // The pair under test itself is not of the past.
        for (auto* wanted : {&chain, &siblings, &all}) {
            wanted->erase({0, trace[step].a});
            wanted->erase({1, trace[step].b});
        }
        EXPECT_TRUE(told(Past::pair).empty());
        EXPECT_EQ(told(Past::ancestors), chain) << step;
        EXPECT_EQ(told(Past::siblings), siblings) << step;
        EXPECT_EQ(told(Past::all), all) << step;
        const QueryProgress callers = progress_at(trace, step, Past::ancestors);
        for (const NodeProgress& node : callers.nodes[0]) EXPECT_TRUE(node.open);
        siblings_differ = siblings_differ || siblings != chain;
        all_differ = all_differ || all != siblings;
    }
    EXPECT_TRUE(siblings_differ && all_differ);
}

TEST(QueryPicture, ThePastIsDrawnAsAskedFor) {
    Query query(testing::hit_scene());
    const int step = query.recorded.trace.size() - 1;
    std::vector<std::size_t> drawn;
    for (const Past past : {Past::pair, Past::ancestors, Past::siblings, Past::all}) {
        query.view.past = past;
        const QueryProgress progress = progress_at(query.recorded.trace, step, past);
        std::size_t boxes = 0;
        for (const BoxInstance& box : query.at(step).boxes) boxes += box.pickable ? 1u : 0u;
        EXPECT_EQ(boxes, 2 + progress.nodes[0].size() + progress.nodes[1].size());
        drawn.push_back(boxes);
    }
    EXPECT_TRUE(std::ranges::is_sorted(drawn));
    EXPECT_LT(drawn[1], drawn[3]);
}

TEST(QueryProgress, AHitSettlesThePairsAboveIt) {
    const Query query(testing::hit_scene());
    const QueryProgress progress = progress_at(query.recorded.trace, query.recorded.trace.size() - 1, Past::all);
    ASSERT_EQ(progress.event.outcome, mobb::Outcome::hit);
    const auto root = std::find_if(progress.nodes[0].begin(), progress.nodes[0].end(),
                                   [](const NodeProgress& n) { return n.node == 0; });
    ASSERT_NE(root, progress.nodes[0].end());
    EXPECT_EQ(root->outcome, mobb::Outcome::hit);
    EXPECT_TRUE(root->open);
}

TEST(QueryPicture, ThePairUnderTestIsFilled) {
    Query query(testing::hit_scene());
    for (int step = 0; step < query.recorded.trace.size(); ++step) {
        const DrawList list = query.at(step);
        const mobb::Trace::Event event = query.recorded.trace[step];
        int filled = 0;
        for (const BoxInstance& box : list.boxes) {
            if (box.state != BoxState::under_test) continue;
            ++filled;
            EXPECT_EQ(box.id.index, box.id.agent == 0 ? event.a : event.b);
            EXPECT_GT(box.fill.a, 0);
        }
        EXPECT_EQ(filled, 2);
    }
}

TEST(QueryPicture, ThePairAloneSaysHowItsTestEnded) {
    Query query(testing::miss_scene());
    query.view.past = Past::pair;
    for (int step = 0; step < query.recorded.trace.size(); ++step) {
        const DrawList list = query.at(step, {1280, 720});
        const mobb::Trace::Event event = query.recorded.trace[step];
        const LineStyle style = outcome_style(box_state(event.outcome), list.palette);
        int boxes = 0;
        for (const BoxInstance& box : list.boxes) {
            if (box.state == BoxState::annotation) continue;
            ++boxes;
            EXPECT_EQ(box.state, BoxState::under_test);
            EXPECT_EQ(box.edge, style.color);
            EXPECT_EQ(box.dash, style.dash);
        }
        EXPECT_EQ(boxes, 2) << "those tested before are not drawn";
        for (const LegendEntry& entry : list.legend) EXPECT_EQ(entry.text.find("latest test"), std::string::npos);
    }
}

TEST(QueryPicture, ThePairAloneHasItsTimesMarkedOnTheAxis) {
    Query query(testing::miss_scene());
    const int last = query.recorded.trace.size() - 1;
    const auto bars = [&](int step) {
        std::vector<LineInstance> out;
        for (const LineInstance& line : query.at(step).lines) {
            if (line.order.layer == DrawLayer::findings && line.order.level == 1) out.push_back(line);
        }
        return out;
    };
    EXPECT_TRUE(bars(last).empty()) << "with other pairs in the picture the axis stays as it is";
    query.view.past = Past::pair;
    for (int step = 0; step <= last; ++step) {
        const mobb::Trace::Event event = query.recorded.trace[step];
        const std::vector<LineInstance> lines = bars(step);
        const bool apart = event.outcome == mobb::Outcome::disjoint_in_time;
        ASSERT_EQ(lines.size(), apart ? 3u : 2u);
        const DrawnSpace space = query.at(step).space;
        for (std::size_t side = 0; side < 2; ++side) {
            const mobb::PlacedTree& tree = query.sides[side].placed;
            const mobb::Node& node = tree.node(side == 0 ? event.a : event.b);
            EXPECT_NEAR(lines[side].from.z, space.point(0, 0, tree.begin(node)).z, 1e-5);
            EXPECT_NEAR(lines[side].to.z, space.point(0, 0, tree.end(node)).z, 1e-5);
        }
    }
    query.view.time_axis = false;
    EXPECT_TRUE(bars(last).empty());
}

TEST(QueryPicture, OutcomesDifferInMoreThanColour) {
    const Palette& colors = palette(Theme::dark);
    const LineStyle apart = outcome_style(BoxState::apart_in_time, colors);
    const LineStyle separated = outcome_style(BoxState::separated, colors);
    const LineStyle overlap = outcome_style(BoxState::overlap, colors);
    const LineStyle hit = outcome_style(BoxState::hit, colors);
    EXPECT_NE(apart.dash, separated.dash);
    EXPECT_NE(apart.dash, overlap.dash);
    EXPECT_NE(overlap.dash, separated.dash);
    EXPECT_TRUE(hit.dash != separated.dash || hit.width > separated.width + 0.5f);
}

TEST(QueryPicture, TheHitDisksAreMarked) {
    Query query(testing::hit_scene());
    const DrawList list = query.at(query.recorded.trace.size() - 1);
    int marked = 0;
    for (const DiskInstance& disk : list.disks) {
        if (disk.color != list.palette.hit) continue;
        ++marked;
        EXPECT_EQ(disk.id.index,
                  disk.id.agent == 0 ? query.recorded.contact->a_sample : query.recorded.contact->b_sample);
    }
    EXPECT_EQ(marked, 2);
}

TEST(QueryPicture, HitAndCursorRingsDifferAndAreExplained) {
    Query query(testing::hit_scene());
    query.view.time = query.recorded.contact->time;
    const DrawList list = query.at(query.recorded.trace.size() - 1, {1280, 720});
    std::size_t hit_lines = 0;
    std::size_t cursor_lines = 0;
    for (const LineInstance& line : list.lines) {
        if (line.order.layer != DrawLayer::rings) continue;
        hit_lines += line.color == list.palette.hit ? 1u : 0u;
        cursor_lines += line.color == list.palette.text ? 1u : 0u;
        EXPECT_EQ(line.hidden, 1) << "disks must not hide rings";
    }
    EXPECT_EQ(hit_lines, 2 * cursor_lines) << "two rings against one";
    const auto explained = [&](LegendEntry::Mark mark) {
        return std::count_if(list.legend.begin(), list.legend.end(),
                             [&](const LegendEntry& entry) { return entry.mark == mark; });
    };
    EXPECT_EQ(explained(LegendEntry::Mark::ring), 1);
    EXPECT_EQ(explained(LegendEntry::Mark::double_ring), 1);
    EXPECT_EQ(explained(LegendEntry::Mark::disk), 1) << "the dim disks";
}

TEST(QueryPicture, AContactBetweenSamplesStandsWhereItBegins) {
    Query query(FittedScene(testing::running_scene({{{2, 1}, 30, 5}, {{4.2, 2.9}, 200, 5}}), {}));
    ASSERT_TRUE(query.recorded.contact);
    const mobb::Contact& contact = *query.recorded.contact;
    query.view.time = contact.time + 0.05;
    const DrawList list = query.at(query.recorded.trace.size() - 1, {1280, 720});
    const auto agents = drawn_agents(query.fitted, query.view);
    const std::array<int, 2> samples{contact.a_sample, contact.b_sample};
    EXPECT_GT(contact.time, agents[0].clip().time(samples[0]) + 0.02) << "not where a sample begins";
    const auto disk = [&](std::size_t side, double time) {
        return mobb::swept(agents[side].clip(), samples[side]).at(time);
    };
    // How wide a ring is around what it stands around, in radii.
    const auto around = [&](const LineInstance& line, double time) {
        const glm::dvec3 place = list.space.place(line.from);
        EXPECT_NEAR(place.z, time, 1e-5);
        const auto radii = [&](std::size_t side) {
            const mobb::Disk d = disk(side, time);
            return std::hypot(place.x - d.x, place.y - d.y) / d.r;
        };
        const auto is_ring = [](double r) { return std::abs(r - 1.04) < 1e-4 || std::abs(r - 1.4) < 1e-4; };
        return is_ring(radii(0)) || is_ring(radii(1));
    };
    int hits = 0, cursors = 0;
    for (const LineInstance& line : list.lines) {
        if (line.order.layer != DrawLayer::rings) continue;
        const bool cursor = line.color == list.palette.text;
        ++(cursor ? cursors : hits);
        EXPECT_TRUE(around(line, cursor ? *query.view.time : contact.time));
    }
    EXPECT_GT(hits, 0);
    EXPECT_GT(cursors, 0);
    // The words point at A's disk then.
    const mobb::Disk a = disk(0, contact.time);
    const glm::vec2 at = list.projection.project(list.space.point(a.x, a.y, contact.time)).value();
    EXPECT_TRUE(std::ranges::any_of(list.overlay_lines,
                                    [&](const OverlayLine& line) { return glm::length(line.from - at) < 0.01f; }));
}

TEST(QueryPicture, EarlierPairsAreSeenInBothThemes) {
    Query query(testing::miss_scene());
    query.view.past = Past::all;
    for (const Theme theme : {Theme::dark, Theme::light}) {
        query.view.theme = theme;
        for (int step = 0; step < query.recorded.trace.size(); ++step) {
            const DrawList list = query.at(step);
            for (const BoxInstance& box : list.boxes) {
                if (box.state == BoxState::annotation) continue;
                const Rgba seen = mix_colors(list.palette.background, with_alpha(box.edge, 1), box.edge.a);
                EXPECT_GE(contrast(seen, list.palette.background), 1.34f);
            }
        }
    }
}

TEST(QueryPicture, SmallPicturesKeepTheScene) {
    Query query(testing::hit_scene());
    for (const PictureSize size : {PictureSize{64, 64}, PictureSize{160, 90}, PictureSize{320, 180}}) {
        for (const int step : {0, 5, query.recorded.trace.size() - 1}) {
            query.view.time = 1.0;
            const DrawList list = query.at(step, size);
            const glm::vec2 picture(size.width, size.height);
            float words = 0;
            const auto area = [](const Rect& rect) { return rect.size().x * rect.size().y; };
            for (const TextRun& run : list.texts) words += area(run.box);
            EXPECT_LE(words, 0.45f * picture.x * picture.y) << size.width;
            glm::vec2 low(1e9f);
            glm::vec2 high(-1e9f);
            for (const DiskInstance& disk : list.disks) {
                low = glm::min(low, list.projection.project(disk.base).value());
                high = glm::max(high, list.projection.project(disk.base).value());
            }
            EXPECT_GT(high.x - low.x + high.y - low.y, 0.35f * picture.y) << size.width;
        }
    }
}

TEST(QueryPicture, LongNamesLeaveTheOutcomeWhole) {
    Scene scene = testing::scene_of({{}, {{1, -1}, 90, 0}});
    scene.agents[0].name = "a very long name of a recording that goes on and on 0001";
    scene.agents[1].name = "a very long name of a recording that goes on and on 0002";
    Query query(FittedScene(std::move(scene), {}));
    const int last = query.recorded.trace.size() - 1;
    const std::string outcome = with_unit(query.recorded.contact->time, "s");
    for (const PictureSize size : {PictureSize{320, 180}, PictureSize{640, 360}, PictureSize{1280, 720}}) {
        const DrawList list = query.at(last, size);
        EXPECT_EQ(list.agents[0].size(), 56u) << "the whole name is kept where there is room";
        std::string said;
        for (const TextRun& run : list.texts) said += run.text + ' ';
        EXPECT_NE(said.find("hit at " + outcome), std::string::npos) << said;
        EXPECT_NE(said.find("deep"), std::string::npos) << said;
    }
}

TEST(QueryPicture, TheGapIsAsWideAsTheTraceSays) {
    for (const mobb::TreeKind kind : mobb::test::kFittedTrees) {
        for (const bool hits : {true, false}) {
            const Query query(hits ? testing::hit_scene(kind) : testing::miss_scene(kind));
            int separated = 0;
            for (int step = 0; step < query.recorded.trace.size(); ++step) {
                const mobb::Trace::Event event = query.recorded.trace[step];
                const auto gap = separation_gap(query.sides, event);
                EXPECT_EQ(gap.has_value(), event.outcome == mobb::Outcome::separated);
                if (!gap) continue;
                ++separated;
                EXPECT_NEAR(glm::length(gap->to - gap->from), event.gap, 1e-9);
                EXPECT_NEAR(glm::dot(gap->to - gap->from, gap->across), 0, 1e-9);
                EXPECT_NEAR(glm::dot(gap->to - gap->from, gap->along), 0, 1e-9);
            }
            EXPECT_GT(separated, 0);
        }
    }
}

TEST(QuerySentence, SaysWhatAStepShows) {
    const Query query(testing::miss_scene());
    const int step = query.find(mobb::BoxKind::obb2d, mobb::Outcome::separated);
    ASSERT_GE(step, 0);
    const std::string sentence = step_sentence(query.sides, query.recorded.trace, step);
    const std::string start =
        "step " + std::to_string(step) + " of 0.." + std::to_string(query.recorded.trace.size() - 1) + ": A ";
    EXPECT_TRUE(sentence.starts_with(start)) << sentence;
    EXPECT_NE(sentence.find(" against B "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("separated along "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(with_unit(query.recorded.trace[step].gap, "m")), std::string::npos) << sentence;
    EXPECT_EQ(query.recorded.contact, std::nullopt);
    EXPECT_TRUE(answer_sentence(query.sides, query.recorded).starts_with("A and B never collide; "));
}

TEST(QuerySentence, NamesItsAgentsHoweverShortItIs) {
    Query query(testing::miss_scene());
    const int step = query.find(mobb::BoxKind::obb2d, mobb::Outcome::separated);
    ASSERT_GE(step, 0);
    for (const auto& [a, b] :
         {std::pair<std::string, std::string>{"A", "C"}, {"pedestrian 0012 of zara01", "pedestrian 0112 of zara01"}}) {
        query.sides[0].label = a;
        query.sides[1].label = b;
        std::vector<std::string> all = step_sentences(query.sides, query.recorded.trace, step);
        for (const std::string& less : outcome_sentences(query.sides, query.recorded.trace, step)) all.push_back(less);
        for (const std::string& sentence : all) {
            EXPECT_EQ(sentence.find("B's"), std::string::npos) << sentence;
            EXPECT_TRUE(sentence.starts_with("step " + std::to_string(step))) << sentence;
        }
        const std::vector<DrawnAgent> terse = with_short_names(query.sides, 5);
        EXPECT_NE(terse[0].label, terse[1].label);
    }
}

TEST(QuerySentence, ANarrowCaptionKeepsStepTreeAndCounts) {
    const Query query(testing::miss_scene());
    const int step = query.find(mobb::BoxKind::obb2d, mobb::Outcome::separated);
    const Caption caption = query_caption(palette(Theme::dark), query.sides, query.recorded,
                                          progress_at(query.recorded.trace, step, Past::pair));
    for (const float room : {120.0f, 150.0f, 250.0f, 600.0f}) {
        const CaptionLines lines =
            caption_lines(caption, room, 1, room < 400 ? CaptionSize::small : CaptionSize::large);
        const auto joined = [](const std::vector<std::string>& all) {
            std::string out;
            for (const std::string& line : all) out += line + ' ';
            return out;
        };
        EXPECT_TRUE(joined(lines.headline).starts_with("step " + std::to_string(step))) << room;
        const std::string detail = joined(lines.detail);
        EXPECT_TRUE(detail.starts_with("MOBB, leaf ")) << detail;
        EXPECT_NE(detail.find(" pairs of samples "), std::string::npos) << room << ": " << detail;
    }
}

TEST(QuerySentence, SaysWhichBoxesWereTested) {
    const auto sentences = [](mobb::TreeKind kind, mobb::TestKind test) {
        const Query query(testing::miss_scene(kind));
        const int step = query.find(test, mobb::Outcome::separated);
        return step_sentence(query.sides, query.recorded.trace, step) + '\n' +
               answer_sentence(query.sides, query.recorded);
    };
    for (const mobb::TreeKind kind : mobb::test::kFittedTrees) {
        const std::string said = sentences(kind, mobb::info(kind).root);
        EXPECT_NE(said.find(' ' + std::string(mobb::info(mobb::info(kind).root).title) + " test"), std::string::npos)
            << said;
    }
    const std::string moving = sentences(mobb::TreeKind::moving, mobb::BoxKind::moving);
    EXPECT_NE(moving.find("'s long axis by "), std::string::npos) << moving;
    EXPECT_NE(moving.find(" m at the nearest"), std::string::npos) << moving;
    const std::string aabb = sentences(mobb::TreeKind::aabb, mobb::BoxKind::aabb);
    EXPECT_NE(aabb.find("separated along y by "), std::string::npos) << aabb;
}

TEST(QuerySentence, SaysWhenAndHowDeepAHitIs) {
    const Query query(testing::hit_scene());
    const std::string sentence = step_sentence(query.sides, query.recorded.trace, query.recorded.trace.size() - 1);
    EXPECT_NE(sentence.find("hit at " + with_unit(query.recorded.contact->time, "s")), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(" m deep"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find("up to"), std::string::npos) << sentence;
    // Who moves between samples only touches the other at first.
    const Query moving(FittedScene(testing::running_scene({{}, {{1, -1}, 90, 0}}), {}));
    ASSERT_TRUE(moving.recorded.contact);
    const std::string touch = step_sentence(moving.sides, moving.recorded.trace, moving.recorded.trace.size() - 1);
    EXPECT_NE(touch.find(" s, up to "), std::string::npos) << touch;
}

TEST(QuerySentence, NodesAreNamedByLevelAndPlace) {
    const Query query(testing::miss_scene());
    EXPECT_EQ(node_name(query.sides[0], 0), "A 0.0");
    EXPECT_EQ(node_name(query.sides[1], query.fitted.tree(0).children(0)[1]), "B 1.1");
}

TEST(QuerySentence, NumbersKeepTheirMeaning) {
    EXPECT_EQ(with_unit(0.1834, "m"), "0.183 m");
    EXPECT_EQ(with_unit(12.3456, "s"), "12.35 s");
    EXPECT_EQ(with_unit(0.0000123456, "m"), "0.0000123 m");
    EXPECT_EQ(with_unit(0, "m"), "0.000 m");
}

}  // namespace
}  // namespace mobbscope
