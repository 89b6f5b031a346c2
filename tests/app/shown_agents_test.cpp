// Hidden, shown alone, pinned: what the commands make of the view, and that nothing else changes.
#include <app/document/shown_agents.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace mobbscope::app {
namespace {

class ShownAgentsTest : public ::testing::Test {
  protected:
    ShownAgentsTest() {
        session.files.open({folder.scene});
        EXPECT_EQ(all_messages(session), "");
    }
    const AgentNames& hidden() const { return session.workspace.view().hidden; }

    CrossingFolder folder;
    Session session{false};
};

TEST_F(ShownAgentsTest, AnswersStay) {
    const bool before = session.queries.answer_of(0).contact.has_value();
    run_command(session, "agents.hide", "B");
    EXPECT_EQ(hidden(), AgentNames{"B"});
    EXPECT_EQ(session.queries.answer_of(0).contact.has_value(), before);
    EXPECT_FALSE(session.workspace.modified()) << "how a scene is seen is not an edit of it";
    run_command(session, "view.previous");
    EXPECT_TRUE(hidden().empty());
}

TEST_F(ShownAgentsTest, AClipMeansAllThatPlayIt) {
    run_command(session, "agents.hide", "clip:walk");
    EXPECT_EQ(hidden(), (AgentNames{"A", "B", "C"}));
    run_command(session, "agents.hide", "clip:walk");
    EXPECT_TRUE(hidden().empty());
    EXPECT_NE(refusal(session, "agents.hide", "clip:stand").find("no agent plays it"), std::string::npos);
    EXPECT_NE(refusal(session, "agents.hide", "clip:wolk").find("walk"), std::string::npos);
    EXPECT_EQ(why_not(session, *find_command("agent.hide")), "no agent is selected");
    session.workspace.select({Selection::Kind::clip, {}, 0});
    run_command(session, "agent.hide");
    EXPECT_EQ(hidden().size(), 3u);
}

TEST_F(ShownAgentsTest, AloneRemembersWhatWasThere) {
    run_command(session, "agents.hide", "C");
    run_command(session, "agents.solo", "A");
    EXPECT_EQ(hidden(), (AgentNames{"B", "C"}));
    run_command(session, "agents.solo", "B");
    EXPECT_EQ(hidden(), (AgentNames{"A", "C"}));
    run_command(session, "agents.solo", "B");
    EXPECT_EQ(hidden(), AgentNames{"C"}) << "as before the first was alone";
    run_command(session, "agents.pin", "C");
    run_command(session, "agents.solo", "A");
    EXPECT_EQ(hidden(), AgentNames{"B"}) << "who is pinned stays";
    run_command(session, "agent.show_all");
    EXPECT_TRUE(hidden().empty());
}

TEST_F(ShownAgentsTest, EditsKeepWhoIsHidden) {
    run_command(session, "agents.hide", "B");
    run_command(session, "go.agent", "B");
    run_command(session, "agent.rename", "Ben");
    EXPECT_EQ(hidden(), AgentNames{"Ben"});
    run_command(session, "agent.remove");
    EXPECT_TRUE(hidden().empty()) << "who is gone is not hidden";
    run_command(session, "edit.undo");
    EXPECT_EQ(hidden(), AgentNames{"Ben"});
}

TEST_F(ShownAgentsTest, NamesThatAreWordsMeanTheirAgents) {
    for (const auto& [from, to] : {std::pair("A", "none"), std::pair("B", "clip:walk"), std::pair("C", "agent:none")}) {
        run_command(session, "go.agent", from);
        run_command(session, "agent.rename", to);
    }
    for (const std::string name : {"none", "clip:walk", "agent:none"}) {
        run_command(session, "agents.hide", text_of_agent(name));
        EXPECT_EQ(hidden(), AgentNames{name});
        run_command(session, "agent.show_all");
    }
    run_command(session, "agents.hide", "clip:walk");
    EXPECT_EQ(hidden().size(), 3u) << "the clip's";
}

TEST_F(ShownAgentsTest, ClipsAreGroupedByFolderAndRig) {
    EXPECT_TRUE(clip_groups(session.workspace).empty()) << "one folder, no skeletons";
    const std::string assets = MOBBSCOPE_SOURCE_DIR "/assets/";
    session.files.open({assets + "clips/walk.glb", assets + "clips/run.glb", folder.file("walk.csv")});
    ASSERT_EQ(all_messages(session), "");
    ASSERT_EQ(clip_groups(session.workspace).size(), 2u);
    EXPECT_EQ(clip_groups(session.workspace)[0].clips, (std::vector<int>{0, 1}));
    EXPECT_EQ(clip_groups(session.workspace)[0].title.rfind("clips: ", 0), 0u)
        << clip_groups(session.workspace)[0].title;
    EXPECT_EQ(session.workspace.view().arrange, Arrange::grid);
    run_command(session, "agents.solo", "group:" + clip_groups(session.workspace)[0].title);
    EXPECT_EQ(hidden(), AgentNames{session.workspace.scene().clips[2].name});
    EXPECT_FALSE(is_crowd(session.workspace));
}

}  // namespace
}  // namespace mobbscope::app
