// What is noticed about a fit, in the window: See goes there, Mend fits anew, and undo takes it back.
#include <app/window/headless_window.h>
#include <base/text.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mobbscope::app {
namespace {

/// A walk of 20 s, swaying, of which sample 300 lies 2 m beside the path.
std::string walk_with_a_jump() {
    std::string samples;
    for (int i = 0; i < 600; ++i) {
        samples += formatted("%s[%.9g, %.9g, 0.4]", i == 0 ? "" : ", ", 1.4 * i / 30,
                             0.02 * std::sin(i / 5.0) + (i == 300 ? 2 : 0));
    }
    return R"({"clips": {"walk": {"dt": 0.03333333333333333, "samples": [)" + samples + "]}}}";
}

struct NoticesWindow : FolderWindow<TempFolder> {
    NoticesWindow() : FolderWindow({1280, 1300}) { open(walk_with_a_jump()); }
    void open(const std::string& scene) {
        session.files.open({folder.write("scene.json", scene)});
        window.settle();
    }
    void click(const std::string& mark) {
        ASSERT_TRUE(has(mark)) << mark;
        window.shell().feed(MouseMove{window.shell().marks().all().at(mark).center()});
        window.settle();
        for (const bool down : {true, false}) {
            window.shell().feed(MouseButton{0, down});
            window.settle();
        }
    }
    const std::vector<FitFinding>& findings() { return session.notices.of(0)->findings; }
    const ViewState& view() const { return session.workspace.view(); }
};

TEST(FitNotices, SeeGoesToTheSample) {
    NoticesWindow w;
    ASSERT_EQ(w.findings().size(), 1u);
    EXPECT_EQ(w.findings()[0].kind, FitFinding::Kind::jump);
    const double before = w.view().camera.distance;
    w.click("finding.0.see");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::sample);
    EXPECT_EQ(w.session.workspace.selection.index, 300);
    EXPECT_NE(w.view().camera.distance, before);
    EXPECT_FALSE(w.has("finding.0.mend"));
}

TEST(FitNotices, MendIsOneEdit) {
    NoticesWindow w;
    w.run("tree.kind", "umobb");
    ASSERT_EQ(w.findings()[0].kind, FitFinding::Kind::loose_levels);
    const mobb::FitOptions mend = *w.findings()[0].mend;
    const std::size_t edits = w.session.workspace.history.place();
    w.click("finding.0.see");
    EXPECT_EQ(w.view().levels.first, w.findings()[0].level);
    EXPECT_EQ(w.session.workspace.history.place(), edits);
    w.click("finding.0.mend");
    EXPECT_EQ(w.session.workspace.fitted().options(), mend);
    EXPECT_EQ(w.session.workspace.history.place(), edits + 1);
    run_command(w.session, "edit.undo");
    w.window.settle();
    EXPECT_EQ(w.session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
    EXPECT_TRUE(w.has("finding.0.mend"));
}

TEST(FitNotices, NothingIsShownWhereNothingStandsOut) {
    NoticesWindow w;
    EXPECT_TRUE(w.has("section.noticed"));
    w.open(R"({"clips": {"stand": {"dt": 1, "samples": [[0, 0, 0.4], [0, 0, 0.4]]}}})");
    EXPECT_TRUE(w.findings().empty());
    EXPECT_FALSE(w.has("section.noticed"));
    run_command(w.session, "tree.next_finding");
    EXPECT_EQ(w.session.notifications.all().back().text, "Nothing stands out in this fit");
}

TEST(FitNotices, OneThatOnlyTheClipCouldMendSaysSo) {
    NoticesWindow w;
    EXPECT_EQ(refusal(w.session, "tree.see_finding", "1"), "the last finding is 0");
    EXPECT_EQ(refusal(w.session, "tree.mend"), "no other fit helps: the clip itself would have to change");
}

}  // namespace
}  // namespace mobbscope::app
