// A run in the session: its time, following, choices, conflicts, and two of it opened as a scene.
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/shown_agents.h>
#include <app/script/state_json.h>
#include <base/error.h>
#include <base/file.h>
#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>
#include <crowd/simulation/simulate.h>
#include <mobb/predicate.h>
#include <mobb_tracks/crowds.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <support/temp_folder.h>

#include "app/crowded_run.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

class CrowdTest : public ::testing::Test {
  protected:
    void SetUp() override {
        file = folder.write("run.json", crowded_run());
        session.files.open({file});
        ASSERT_TRUE(session.workspace.crowd())
            << (session.notifications.all().empty() ? "" : session.notifications.all().front().text);
    }
    void run(std::string_view id, const std::string& argument = "") { run_command(session, id, argument); }

    /// Follows somebody at a choice that ruled a candidate out; returns that candidate.
    int follow_a_discarding_choice() {
        const CrowdRun& crowd = *session.workspace.crowd();
        for (const CrowdAgent& agent : crowd.agents) {
            run("crowd.follow", agent.name);
            for (std::size_t play = 1; play < agent.plays.size(); ++play) {
                run("time.at", std::to_string(agent.plays[play].chosen_at + 1e-5));
                const Choice& choice = session.crowds.choice()->choice;
                for (const std::size_t i : shown_candidates(choice)) {
                    if (outcome_of(choice, i) == CandidateOutcome::ruled_out) return static_cast<int>(i);
                }
            }
        }
        throw std::logic_error("nobody was ever ruled out");
    }

    TempFolder folder;
    std::filesystem::path file;
    Session session{false};
};

TEST_F(CrowdTest, OpensInItsMiddle) {
    EXPECT_EQ(session.workspace.view().time, 10);
    EXPECT_EQ(time_span(session.workspace).t1, 20);
    EXPECT_FALSE(session.workspace.modified());
    EXPECT_TRUE(session.workspace.scene().agents.empty());
    EXPECT_GE(session.workspace.fitted().placed_agents().size(), 22u);
    EXPECT_EQ(session.workspace.fitted().queries().size(), 0u);
}

TEST_F(CrowdTest, APersonStaysSelectedWhileTimeRuns) {
    select_agent_named(session.workspace, session.workspace.crowd()->agents[5].name);
    for (double time = 0; time < 20; time += 0.7) {
        run("time.at", std::to_string(time));
        ASSERT_EQ(session.workspace.selection.kind, Selection::Kind::path);
        EXPECT_EQ(session.workspace.fitted().scene().agents[5].run_agent, 5);
        EXPECT_EQ(current_agent(session.workspace), session.workspace.crowd()->agents[5].name);
    }
}

TEST_F(CrowdTest, ASampleIsForgottenWithItsPlay) {
    const int play = session.workspace.fitted().scene().agents[2].play;
    session.workspace.select({Selection::Kind::sample, {2, -1, 0}, 3});
    run("time.at", "10.01");
    if (session.workspace.fitted().scene().agents[2].play == play) {
        EXPECT_EQ(session.workspace.selection.kind, Selection::Kind::sample);
    }
    run("time.at", "18");
    EXPECT_EQ(session.workspace.selection, (Selection{Selection::Kind::path, {2, -1, 0}, -1}));
}

TEST_F(CrowdTest, FollowingMovesTheCameraAlongAndStoppingLeavesIt) {
    const std::string name = session.workspace.crowd()->agents[1].name;
    run("view.moment");
    run("crowd.follow", name);
    EXPECT_EQ(session.workspace.view().follow, name);
    ASSERT_TRUE(session.workspace.view().camera.target);
    const Camera along = session.workspace.view().camera;
    run("time.at", "12");
    EXPECT_EQ(session.workspace.view().camera, along) << "it is the agent that moves";
    run("crowd.stop");
    EXPECT_TRUE(session.workspace.view().follow.empty());
    EXPECT_NE(session.workspace.view().camera, along);
    EXPECT_THROW(run("crowd.follow", "nobody"), std::invalid_argument);
}

TEST_F(CrowdTest, WhatIsPlayedIsNotEdited) {
    select_agent_named(session.workspace, session.workspace.crowd()->agents[1].name);
    for (const char* id : {"agent.remove", "agent.duplicate"}) EXPECT_THROW(run(id), std::invalid_argument) << id;
    EXPECT_THROW(run("agent.move", "1 2"), std::invalid_argument);
    EXPECT_THROW(run("agent.add", "ahead"), std::invalid_argument);
    EXPECT_THROW(session.files.add({file}), InputError);
}

TEST_F(CrowdTest, TreesAreFittedOtherwiseAndTheRunIsSavedWhole) {
    run("tree.leaf", "4");
    EXPECT_TRUE(session.workspace.modified());
    ASSERT_TRUE(session.workspace.crowd());
    const CrowdRun before = *session.workspace.crowd();
    run("file.save");
    EXPECT_FALSE(session.workspace.modified());
    const Scene again = load_scene(file);
    ASSERT_TRUE(again.crowd);
    EXPECT_EQ(*again.crowd, before);
    EXPECT_EQ(again.fit.leaf, 4);
}

TEST_F(CrowdTest, ChoicesAreSteppedThrough) {
    const CrowdAgent& agent = session.workspace.crowd()->agents[0];
    run("crowd.follow", agent.name);
    run("time.at", "0");
    run("crowd.next_choice");
    EXPECT_EQ(session.workspace.view().time, agent.plays[1].chosen_at);
    ASSERT_TRUE(session.crowds.choice());
    EXPECT_EQ(session.crowds.choice()->play, 1);
    run("crowd.next_choice");
    EXPECT_EQ(session.crowds.choice()->play, 2);
    run("crowd.previous_choice");
    EXPECT_EQ(session.crowds.choice()->play, 1);
    run("crowd.play", "3");
    EXPECT_EQ(session.workspace.view().time, agent.plays[3].placement.start);
}

TEST_F(CrowdTest, ACandidateOpensAgainstWhoRuledItOut) {
    const int index = follow_a_discarding_choice();
    const Candidate candidate = session.crowds.choice()->choice.candidates[static_cast<std::size_t>(index)];
    run("crowd.candidate", std::to_string(index));
    run("crowd.open_candidate");
    ASSERT_TRUE(session.workspace.in_excerpt());
    EXPECT_FALSE(session.workspace.crowd());
    EXPECT_EQ(session.workspace.scene().agents.size(), 2u);
    ASSERT_TRUE(session.workspace.recorded());
    ASSERT_TRUE(session.workspace.recorded()->contact);
    EXPECT_EQ(*session.workspace.recorded()->contact, candidate.blocker->contact);
}

/// What a view draws of each agent: name and colour.
std::map<std::string, Rgba> colors_of(const Workspace& workspace) {
    std::map<std::string, Rgba> out;
    for (const DrawnAgent& who : drawn_agents(workspace.fitted(), workspace.view())) out.emplace(who.name, who.color);
    return out;
}

TEST_F(CrowdTest, WhoIsOpenedAsASceneKeepsNameAndColour) {
    const std::map<std::string, Rgba> all = colors_of(session.workspace);
    const auto expect_same = [&](const std::string& a, const std::string& b) {
        ASSERT_TRUE(session.workspace.in_excerpt());
        const std::map<std::string, Rgba> two = colors_of(session.workspace);
        ASSERT_EQ(two.size(), 2u);
        for (const std::string& name : {a, b}) {
            ASSERT_TRUE(two.contains(name)) << name;
            EXPECT_EQ(two.at(name), all.at(name)) << name;
        }
        ViewState without_query = session.workspace.view();
        without_query.query.reset();
        for (const DrawnAgent& who : drawn_agents(session.workspace.fitted(), without_query)) {
            EXPECT_EQ(who.color, all.at(who.name)) << who.name << " in lists and in the picture of all";
        }
    };
    const std::string four = session.workspace.crowd()->agents[3].name;
    const std::string six = session.workspace.crowd()->agents[5].name;
    select_agent_named(session.workspace, four);
    run("crowd.open_pair", six);
    expect_same(four, six);
    const std::string file_of_two = (folder.path() / "two.json").string();
    run("file.save_as", file_of_two);
    const Scene saved = load_scene(file_of_two);
    for (const Agent& agent : saved.agents) {
        ASSERT_TRUE(agent.color) << agent.name;
        EXPECT_EQ(hex(static_cast<std::uint32_t>(agent.color->r << 16 | agent.color->g << 8 | agent.color->b)),
                  all.at(agent.name));
    }
    run("crowd.back");
    run("conflicts.find");
    const SceneConflict conflict = session.crowds.conflicts()->front();
    run("conflicts.open", "0");
    if (all.at(conflict.a.name) != all.at(conflict.b.name)) expect_same(conflict.a.name, conflict.b.name);
    run("crowd.back");
    const int index = follow_a_discarding_choice();
    const Candidate candidate = session.crowds.choice()->choice.candidates[static_cast<std::size_t>(index)];
    const std::string blocker =
        session.workspace.crowd()->agents[static_cast<std::size_t>(candidate.blocker->agent)].name;
    const std::string follows = session.workspace.view().follow;
    run("crowd.open_candidate", std::to_string(index));
    if (all.at(follows) != all.at(blocker)) expect_same(follows, blocker);
}

TEST_F(CrowdTest, TwoOfOneColourAreToldApartAsAScene) {
    // There are eight colours.
    const std::string first = session.workspace.crowd()->agents[1].name;
    const std::string second = session.workspace.crowd()->agents[9].name;
    ASSERT_EQ(colors_of(session.workspace).at(first), colors_of(session.workspace).at(second));
    const Rgba before = colors_of(session.workspace).at(first);
    select_agent_named(session.workspace, first);
    run("crowd.open_pair", second);
    EXPECT_EQ(colors_of(session.workspace).at(first), before);
    EXPECT_NE(colors_of(session.workspace).at(second), before);
}

TEST_F(CrowdTest, BothWaysLeadBackFromTwoToAll) {
    const ViewState before = session.workspace.view();
    run("view.moment");
    const std::string other = session.workspace.crowd()->agents[4].name;
    select_agent_named(session.workspace, session.workspace.crowd()->agents[3].name);
    run("crowd.open_pair", other);
    ASSERT_TRUE(session.workspace.in_excerpt());
    EXPECT_FALSE(session.workspace.modified()) << "nothing was changed yet";
    run("edit.undo");
    EXPECT_FALSE(session.workspace.in_excerpt());
    EXPECT_EQ(session.workspace.view().show, Show::moment);
    run("edit.redo");
    ASSERT_TRUE(session.workspace.in_excerpt());
    run("crowd.back");
    EXPECT_FALSE(session.workspace.in_excerpt());
    EXPECT_EQ(session.workspace.view().show, Show::moment);
    EXPECT_FALSE(session.workspace.modified());
    EXPECT_NE(session.workspace.view(), before);
    run("edit.undo");
    EXPECT_TRUE(session.workspace.in_excerpt());
}

TEST_F(CrowdTest, AnExcerptIsSavedBesideTheRunAndNeverOverIt) {
    select_agent_named(session.workspace, session.workspace.crowd()->agents[3].name);
    run("crowd.open_pair", session.workspace.crowd()->agents[4].name);
    select_agent_named(session.workspace, session.workspace.scene().agents[0].name);
    run("agent.move", "1 2");
    EXPECT_TRUE(session.workspace.modified());
    EXPECT_THROW(session.files.save_as(file), InputError);
    run("file.save_as", (folder.path() / "two.json").string());
    EXPECT_TRUE(load_scene(file).crowd);
    EXPECT_EQ(load_scene(folder.path() / "two.json").agents.size(), 2u);
    EXPECT_FALSE(session.workspace.modified());
    EXPECT_TRUE(session.workspace.in_excerpt());
}

TEST_F(CrowdTest, AConflictIsSeenWhereItWasForced) {
    EXPECT_EQ(session.crowds.conflicts(), nullptr);
    run("conflicts.find");
    ASSERT_TRUE(session.crowds.conflicts());
    ASSERT_FALSE(session.crowds.conflicts()->empty()) << "nobody was forced: take a smaller floor";
    const std::vector<SceneConflict> all = *session.crowds.conflicts();
    double before = -1e9;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const SceneConflict& found = all[i];
        SCOPED_TRACE(found.a.name + " and " + found.b.name);
        EXPECT_LT(found.a.agent, found.b.agent);
        EXPECT_LT(found.facts.deepest.least_clearance, 0);
        EXPECT_GE(found.facts.deepest.least_clearance, before) << "the deepest first";
        before = found.facts.deepest.least_clearance;
        run("conflicts.go", std::to_string(i));
        EXPECT_EQ(session.workspace.view().foreground, (AgentNames{found.a.name, found.b.name}));
        EXPECT_DOUBLE_EQ(*session.workspace.view().time, std::max(found.begin() - 0.5, 0.0));
        EXPECT_EQ(session.workspace.view().follow, "");
        run("conflicts.choice");
        ASSERT_TRUE(session.crowds.choice());
        EXPECT_EQ(session.crowds.choice()->choice.kind, PlayKind::forced);
        const bool of_a = session.crowds.choice()->agent == found.a.agent;
        EXPECT_EQ(session.crowds.choice()->play, of_a ? found.a_play : found.b_play) << "that of the contact";
        EXPECT_EQ(session.workspace.view().follow, of_a ? found.a.name : found.b.name);
        EXPECT_LE(*session.workspace.view().time, found.begin());
    }
    run("conflicts.go", "0");
    EXPECT_EQ(current_agent(session.workspace), "") << "nobody stands out among the two";
    run("conflicts.open");
    ASSERT_TRUE(session.workspace.in_excerpt());
    ASSERT_TRUE(session.workspace.recorded()->contact);
    EXPECT_EQ(session.workspace.recorded()->contact->time, all.front().begin());
    run("crowd.back");
    EXPECT_TRUE(session.crowds.conflicts()) << "they are still those of the run";
}

/// A run in which somebody took what the simulator would not have taken, and collides with one who chose later.
struct WrongChoice {
    Scene run;
    int agent = -1, play = -1;
};

WrongChoice run_with_a_wrong_choice() {
    const Scene simulated = with_run(walker_scene(), 26, {13, 13}, 4);
    const FittedScene fitted(simulated, {});
    const MoveSet moves(fitted);
    const auto graph_moves = static_cast<int>(simulated.graph->moves.size());
    for (int agent = 0; agent < 26; ++agent) {
        const int last = static_cast<int>(simulated.crowd->agents[static_cast<std::size_t>(agent)].plays.size()) - 1;
        const Choice choice = choice_of(moves, *simulated.crowd, agent, last);
        for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
            const Candidate& candidate = choice.candidates[i];
            if (i == choice.taken || !candidate.is_free() || candidate.played >= graph_moves) continue;
            CrowdRun edited = *simulated.crowd;
            edited.agents[static_cast<std::size_t>(agent)].plays.back() = {
                candidate.played, candidate.placement, choice.time, PlayKind::chosen, {}};
            WrongChoice out{simulated, agent, last};
            out.run.crowd = std::make_shared<const CrowdRun>(std::move(edited));
            const std::vector<SceneConflict> found = conflicts_in(out.run);
            if (found.empty() || was_forced(*out.run.crowd, found.front())) continue;
            const bool by_a = made_by_a(*out.run.crowd, found.front());
            if ((by_a ? found.front().a : found.front().b).agent != agent) return out;
        }
    }
    throw std::logic_error("nobody collides with one who chose later: take a smaller floor");
}

TEST_F(CrowdTest, TheChoiceOfAConflictIsTheOneAtFault) {
    const WrongChoice wrong = run_with_a_wrong_choice();
    session.files.open({folder.write("wrong.json", to_json(wrong.run, true))});
    run("conflicts.find");
    ASSERT_FALSE(session.crowds.conflicts()->empty());
    run("conflicts.go", "0");
    run("conflicts.choice");
    ASSERT_TRUE(session.crowds.choice());
    EXPECT_EQ(session.crowds.choice()->agent, wrong.agent);
    EXPECT_EQ(session.crowds.choice()->play, wrong.play);
    EXPECT_FALSE(session.crowds.choice()->comes_out);
    // The run as a whole names the same.
    run("time.at", "1");
    run("crowd.check");
    ASSERT_TRUE(session.crowds.choice());
    EXPECT_EQ(session.crowds.choice()->agent, wrong.agent);
    EXPECT_EQ(session.crowds.choice()->play, wrong.play);
    const std::string said = session.notifications.all().back().text;
    EXPECT_NE(said.find("made again the choice is"), std::string::npos) << said;
    EXPECT_NE(said.find("\nnow: "), std::string::npos) << said;
}

TEST_F(CrowdTest, ARunThatComesOutIsSaidTo) {
    run("crowd.check");
    EXPECT_NE(session.notifications.all().back().text.find("come out as the run says"), std::string::npos);
}

TEST_F(CrowdTest, TheTimelineHoldsTheConflicts) {
    // As if less had been simulated: what was chosen goes on.
    Scene shorter = session.workspace.scene();
    CrowdRun crowd = *shorter.crowd;
    crowd.seconds = 1;
    shorter.crowd = std::make_shared<const CrowdRun>(std::move(crowd));
    session.files.open({folder.write("shorter.json", to_json(shorter, true))});
    EXPECT_EQ(time_span(session.workspace).t1, 1);
    run("conflicts.find");
    double end = 0;
    for (const SceneConflict& conflict : *session.crowds.conflicts())
        end = std::max(end, conflict.facts.intervals.back().t1);
    ASSERT_GT(end, 1);
    EXPECT_EQ(time_span(session.workspace).t1, end);
}

/// The walkers' clips differ in dt, so people are several agents of scene_of_people.
TEST_F(CrowdTest, ConflictsAreCountedAsTheCommandCountsThem) {
    run("conflicts.find");
    ASSERT_TRUE(session.crowds.conflicts());
    const Scene people = scene_of_people(session.workspace.scene());
    ASSERT_GT(people.agents.size(), session.workspace.crowd()->agents.size());
    std::vector<int> person_of;
    for (const Agent& who : people.agents) person_of.push_back(who.run_agent);
    mobb::ConflictSearch direct;
    direct.direct = true;
    const std::vector<mobb::PeopleConflict> other = mobb::test::all_of({Crowd(people).placed(), person_of, direct});
    ASSERT_EQ(session.crowds.conflicts()->size(), other.size());
    std::set<std::pair<int, int>> pairs;
    for (std::size_t i = 0; i < other.size(); ++i) {
        const mobb::PeopleConflict& here = (*session.crowds.conflicts())[i].facts;
        EXPECT_EQ(std::pair(here.a, here.b), std::pair(other[i].a, other[i].b));
        EXPECT_NEAR(here.deepest.least_clearance, other[i].deepest.least_clearance, 1e-9);
        EXPECT_NEAR(here.seconds(), other[i].seconds(), 1e-6);
        EXPECT_TRUE(pairs.emplace(here.a, here.b).second) << "each pair once";
    }
    double seconds = 0;
    for (const mobb::PeopleConflict& conflict : other) seconds += conflict.seconds();
    EXPECT_EQ(session.crowds.conflict_summary(),
              conflict_count(other.size(), session.workspace.crowd()->agents.size(), seconds));
}

/// One walks 4 m in steps of 1 m and 0.5 s, twice; another stands for 0.3 s where the first runs on from 3 m to 4 m.
constexpr const char* kMetBetweenPlays = R"({"mobbscope": 1,
  "clips": {"walk": {"dt": 0.5, "motion": "linear", "samples": [[0,0,0.1],[1,0,0.1],[2,0,0.1],[3,0,0.1]]},
            "post": {"dt": 0.3, "samples": [[0,0,0.1]]}},
  "graph": {"hubs": [{"name": "a"}, {"name": "b"}], "bounds": {"pose_distance": null, "root_speed": null},
            "moves": [{"clip": "walk", "from": 0, "to": 0, "entry": [0,0,0], "exit": [4,0,0]},
                      {"clip": "post", "from": 1, "to": 1, "entry": [0,0,0], "exit": [0,0,0]}]},
  "crowd": {"area": [40, 40], "seconds": 4, "seed": 1, "ahead": 0, "grace": 0, "turn_rate": 0, "agents": [
    {"name": "17", "plays": [{"move": 0, "translate": [0,0], "rotate_deg": 0, "start": 0},
      {"move": 0, "translate": [4,0], "rotate_deg": 0, "start": 2, "chosen_at": 1.5, "kind": "forced"}]},
    {"name": "42", "plays": [{"move": 1, "translate": [3.5,0], "rotate_deg": 0, "start": 1.6, "chosen_at": 0}]}]}})";

TEST(CrowdOfTracks, ADoubtStandsBesideTheCountOfConflicts) {
    Session session(false);
    const auto add = [&](const std::string& doubt) {
        session.workspace.edit({"adding", ""}, [&](Scene& scene) {
            std::vector<mobb::Disk> walk;
            for (int i = 0; i < 20; ++i) walk.push_back({1.2 * i, 0, 0.2});
            scene.clips.push_back({"walk", std::nullopt, {}, std::make_shared<const mobb::Clip>(0.1, walk)});
            scene.clips.back().facts.doubt = doubt;
            const int clip = static_cast<int>(scene.clips.size()) - 1;
            for (int i = 0; i < 20; ++i)
                scene.agents.push_back(
                    {doubt + std::to_string(i), clip, {{0, 5.0 * i + 100.0 * clip}, 0, 0}, std::nullopt});
        });
        run_command(session, "conflicts.find");
        return state_json(session).at("crowd").at("conflicts");
    };
    const auto clean = add("");
    EXPECT_EQ(clean.at("count"), 0);
    EXPECT_FALSE(clean.contains("warnings"));
    EXPECT_EQ(add("too fast").at("warnings"), nlohmann::ordered_json({"too fast"}));
}

TEST_F(CrowdTest, WhoIsMetBetweenTwoLinearPlaysIsOpenedWithTheJoint) {
    session.files.open({folder.write("joint.json", kMetBetweenPlays)});
    ASSERT_TRUE(session.workspace.crowd());
    const auto expect_hit = [&] {
        ASSERT_TRUE(session.workspace.in_excerpt());
        EXPECT_TRUE(session.queries.answer_of(0).contact);
        EXPECT_EQ(session.workspace.scene().clips[0].clip->count(), 2);
        EXPECT_EQ(session.workspace.scene().clips[0].name, "joint to walk");
        EXPECT_EQ(session.workspace.scene().agents[0].placement.start, 1.5);
        session.excerpts.leave();
    };
    run("conflicts.find");
    ASSERT_TRUE(session.crowds.conflicts());
    ASSERT_EQ(session.crowds.conflicts()->size(), 1u);
    run("conflicts.open", "0");
    expect_hit();
    run("crowd.follow", "17");
    run("time.at", "1.7");
    ASSERT_TRUE(session.crowds.choice());
    run("crowd.open_candidate", "0");
    expect_hit();
    // What is drawn then runs on, too.
    run("crowd.open_pair", "42");
    ASSERT_TRUE(session.workspace.in_excerpt());
    EXPECT_TRUE(session.queries.answer_of(0).contact);
}

}  // namespace
}  // namespace mobbscope::app
