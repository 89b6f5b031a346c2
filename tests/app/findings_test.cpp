/// What is found out about a query is kept as long as it is true, and no longer.
#include <app/commands/command.h>
#include <app/session/session.h>
#include <gtest/gtest.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <cmath>

namespace mobbscope::app {
namespace {

/// Two agents on one clip, and the queries between them and a third.
void add_three_agents(Scene& scene) {
    std::vector<mobb::Disk> walk;
    for (int i = 0; i < 60; ++i) walk.push_back({0.1 * i, 0, 0.2});
    scene.clips.push_back({"walk", std::nullopt, {}, std::make_shared<const mobb::Clip>(0.1, walk)});
    scene.agents.push_back({"A", 0, {}, std::nullopt});
    scene.agents.push_back({"B", 0, {{0, 1}, 0, 0}, std::nullopt});
    scene.agents.push_back({"C", 0, {{0, 2}, 0, 0}, std::nullopt});
}

TEST(Findings, AreNoneWithoutAQuery) {
    Session session(false);
    EXPECT_EQ(session.queries.findings(), nullptr);
    session.workspace.edit({"adding", ""}, add_three_agents);
    EXPECT_EQ(session.queries.findings(), nullptr);
}

TEST(Findings, StayWhileOneLooksAround) {
    Session session(false);
    session.workspace.edit({"adding", ""}, add_three_agents);
    session.workspace.change_view([](ViewState& view) { view.query = 0; });
    const auto before = session.queries.findings();
    ASSERT_NE(before, nullptr);
    session.workspace.change_view([](ViewState& view) {
        view.step = {Step::Unit::event, 0};
        view.time = 1.0;
        view.theme = Theme::light;
    });
    EXPECT_EQ(session.queries.findings(), before);
}

TEST(Findings, FollowTheQueryAndTheScene) {
    Session session(false);
    session.workspace.edit({"adding", ""}, add_three_agents);
    session.workspace.change_view([](ViewState& view) { view.query = 0; });
    const auto first = session.queries.findings();
    EXPECT_FALSE(first->clearance.contact.has_value());
    EXPECT_NEAR(first->clearance.pieces[*first->clearance.least].clearance, 0.6, 1e-9);
    EXPECT_NEAR(first->floor.apart, 0.6, 1e-9);

    session.workspace.change_view([](ViewState& view) { view.query = 1; });
    const auto second = session.queries.findings();
    EXPECT_NE(second, first);
    EXPECT_NEAR(second->clearance.pieces[*second->clearance.least].clearance, 1.6, 1e-9);

    session.workspace.edit({"moving", ""}, [](Scene& scene) { place_agent(scene, 2, {{0, 0.1}, 0, 0}); });
    const auto moved = session.queries.findings();
    EXPECT_NE(moved, second);
    EXPECT_TRUE(moved->clearance.contact.has_value());
    EXPECT_EQ(moved->recursion.total(), session.workspace.recorded()->tests);
    // Who holds the old ones may still read them.
    EXPECT_EQ(second->sides[1].name, "C");
}

/// Two who circle side by side, in boxes along the axes: nearly all overlaps are avoidable.
void add_two_circles(Scene& scene, int samples) {
    for (const double radius : {5.0, 5.82}) {
        std::vector<mobb::Disk> circle;
        for (int i = 0; i < samples; ++i)
            circle.push_back({radius * std::cos(0.01 * i) + 1e-3 * i, radius * std::sin(0.01 * i), 0.4});
        scene.clips.push_back({"circle", std::nullopt, {}, std::make_shared<const mobb::Clip>(0.03, circle)});
    }
    scene.agents = {{"A", 0, {}, std::nullopt}, {"B", 1, {}, std::nullopt}};
    scene.fit = {.tree = mobb::TreeKind::aabb, .leaf = 1};
}

TEST(Findings, OfALongTraceOnlySoManyOverlapsAreJudgedUntilAllAreAskedFor) {
    Session session(false);
    session.workspace.edit({"adding", ""}, [](Scene& scene) { add_two_circles(scene, 20'000); });
    session.queries.show(0);
    const AvoidableOverlaps some = session.queries.findings()->recursion.avoidable;
    EXPECT_FALSE(some.all_judged());
    EXPECT_GT(some.judged, 50);
    session.workspace.change_view([](ViewState& view) { view.step = {Step::Unit::event, 0}; });
    run_command(session, "step.next_avoidable");
    EXPECT_EQ(session.workspace.step(), some.events.front());
    session.workspace.change_view([](ViewState& view) { view.step = {Step::Unit::end, 0}; });
    run_command(session, "step.previous_avoidable");
    EXPECT_EQ(session.workspace.step(), some.events.back());
    run_command(session, "step.next_avoidable");
    EXPECT_NE(session.notifications.all().back().text.find("There is no later avoidable overlap. The first " +
                                                           std::to_string(some.judged) + " of "),
              std::string::npos)
        << session.notifications.all().back().text;
    run_command(session, "query.judge");
    const AvoidableOverlaps& all = session.queries.findings()->recursion.avoidable;
    EXPECT_TRUE(all.all_judged());
    EXPECT_EQ(all.overlaps, some.overlaps);
    EXPECT_GT(all.events.size(), some.events.size());
    EXPECT_TRUE(std::equal(some.events.begin(), some.events.end(), all.events.begin()));
    run_command(session, "step.next_avoidable");
    EXPECT_EQ(session.workspace.step(), all.events[some.events.size()]);
}

TEST(Findings, SayThatNoOverlapWasAvoidable) {
    Session session(false);
    session.workspace.edit({"adding", ""}, add_three_agents);
    session.queries.show(0);
    run_command(session, "step.next_avoidable");
    EXPECT_EQ(session.notifications.all().back().text, "No overlap of this query was avoidable");
}

}  // namespace
}  // namespace mobbscope::app
