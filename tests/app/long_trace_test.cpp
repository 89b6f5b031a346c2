// Long traces in the window: recorded once, and where recording stopped is said.
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <sstream>
#include <string>

namespace mobbscope::app {
namespace {

struct LongTraceWindow : FolderWindow<CrossingFolder> {
    LongTraceWindow() : FolderWindow({1280, 1100}) {
        session.files.open({folder.scene});
        session.workspace.change_view([](ViewState& view) { view.query = 0; });
        window.settle();
    }
};

constexpr std::array kNotes{"query.stopped.steps",    "query.stopped.reasons", "query.stopped.branches",
                            "query.stopped.counters", "query.stopped.square",  "timeline.stopped"};

TEST(LongTrace, ThePictureAndThePanelsShareOneRecord) {
    LongTraceWindow w;
    const auto recorded = w.session.workspace.fitted().recorded(0);
    EXPECT_EQ(recorded.get(), w.session.workspace.recorded());
    EXPECT_EQ(recorded.use_count(), 3) << "the picture, the panels, and this";
    w.session.workspace.change_view([](ViewState& view) { view.step = {Step::Unit::event, 3}; });
    w.window.settle();
    EXPECT_EQ(recorded.get(), w.session.workspace.recorded());
    EXPECT_EQ(recorded.use_count(), 3) << "stepping records nothing";
}

TEST(LongTrace, EveryPanelSaysWhereRecordingStopped) {
    LongTraceWindow w;
    for (const char* note : kNotes) EXPECT_FALSE(w.has(note)) << note;
    const RecordedQuery whole = *w.session.workspace.recorded();
    const auto stopped = std::make_shared<const RecordedQuery>(
        record(w.session.workspace.fitted(), w.session.workspace.fitted().queries()[0], Search::trees, {.events = 9}));
    Workspace::Derived& derived = w.session.workspace.derived();
    derived.recorded.emplace(0, stopped);
    derived.forget_findings();
    w.session.workspace.change_view([](ViewState& view) {
        view.step = {Step::Unit::event, 4};
        view.time = 0.5;
    });
    w.window.settle();
    for (const char* note : kNotes) EXPECT_TRUE(w.has(note)) << note;
    std::ostringstream out;
    Script::parse("run reasons.of_sample a 59", "test").run(w.session, w.window, out);
    EXPECT_TRUE(w.has("query.stopped.reasons")) << "no test that came to it was recorded";
    EXPECT_EQ(recording_words(w.session.workspace.recorded()->trace),
              "recording stopped at event 9 of " + std::to_string(whole.trace.size()));
    EXPECT_EQ(stopped->tests, whole.tests) << "the answer is that of the whole query";
    EXPECT_EQ(stopped->contact, whole.contact);
    EXPECT_EQ(recording_words(whole.trace), "");
}

}  // namespace
}  // namespace mobbscope::app
