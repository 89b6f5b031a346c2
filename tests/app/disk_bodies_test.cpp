// Agents of several disks in the window: one in the lists, all disks in the picture, the two that are asked in a query.
#include "app/folder_window.h"

#include <app/commands/command.h>
#include <app/document/selection.h>
#include <app/window/headless_window.h>
#include <base/error.h>
#include <render/gl/gl_context.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope::app {
namespace {

struct CarsWindow : FolderWindow<TempFolder> {
    CarsWindow() : FolderWindow({1280, 900}) {
        open(folder.write("cars.json",
                          R"({"clips": {"car": {"dt": 0.5, "motion": "linear", "body": [[1,0,0.9],[0,0,0.9],[-1,0,0.9]],
            "samples": [[0,0,2],[4,0,2],[8,0,2],[12,0,2]]}}, "agents": [{"name": "left", "clip": "car", "floor": 1},
            {"name": "right", "clip": "car", "translate": [0, -2]}, {"name": "across", "clip": "car",
            "translate": [6, -7], "rotate_deg": 90, "floor": 1}, {"name": "below", "clip": "car", "floor": 2}]})"));
    }
    const Workspace& workspace() { return session.workspace; }
};

TEST(DiskBodies, AreOneAgentEach) {
    CarsWindow w;
    EXPECT_EQ(w.workspace().fitted().placed_agents().size(), 4u);
    EXPECT_EQ(w.window.shell().shown()->agents.size(), 4u);
    EXPECT_EQ(w.window.shell().shown()->disks.size(), std::size_t{4} * 3 * 3);
    EXPECT_EQ(w.workspace().fitted().queries().size(), 4u) << "below meets right alone";
}

TEST(DiskBodies, AQueryIsOfTheTwoDisksThatAreAsked) {
    CarsWindow w;
    w.run("query.select", "1");  // left and across, who collide
    ASSERT_TRUE(w.workspace().view().query);
    const SceneQuery query = w.workspace().fitted().queries()[1];
    ASSERT_GE(query.a.member, 0);
    ASSERT_TRUE(w.session.queries.findings()->clearance.contact);
    EXPECT_EQ(w.session.queries.findings()->sides[1].name, "across (disk " + std::to_string(query.b.member) + ")");
    const AgentRef side = agent_in_view(w.workspace().fitted(), w.workspace().view(), 1);
    const auto who = placed_agent_of(w.workspace().fitted(), side);
    ASSERT_TRUE(who);
    EXPECT_EQ(who->member, query.b.member) << "a box that is selected is one of its tree";
    EXPECT_THROW(run_command(w.session, "proof.save", (w.folder.path() / "proof.json").string()), InputError)
        << "a proof is of two disks alone";
    for (const char* command : {"step.first", "step.forward", "step.last", "view.moment"}) w.run(command);
    w.run("query.select", "0");  // who never collide
    EXPECT_FALSE(w.session.queries.findings()->clearance.contact);
}

TEST(DiskBodies, ACaptureKeepsThem) {
    CarsWindow w;
    w.run("query.select", "1");
    const auto contact = w.session.queries.answer_of(1).contact;
    ASSERT_TRUE(contact);
    w.run("query.capture");
    ASSERT_TRUE(w.workspace().in_excerpt());
    ASSERT_EQ(w.workspace().scene().clips[0].members.size(), 3u);
    EXPECT_EQ(w.session.queries.answer_of(0).contact, contact);
    ASSERT_TRUE(w.workspace().scene().queries[0].expect);
    EXPECT_EQ(w.workspace().scene().queries[0].expect->contact, contact);
}

}  // namespace
}  // namespace mobbscope::app
