// The window tries others in place of a selected node, and shows them in the picture; the tree stays as it is.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include "app/crossing_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {
namespace {

struct WhatIfWindow : CrossingWindow {
    void unfold() {
        window.shell().feed(MouseMove{window.shell().marks().all().at("section.what if").center()});
        for (const bool down : {true, false}) {
            window.shell().feed(MouseButton{0, down});
            window.settle();
        }
    }
    std::string_view why_not() const { return app::why_not(session, command_named("tree.what_if")); }
    std::vector<HighlightLine> ghosts() {
        std::vector<HighlightLine> out = window.shell().shown()->highlights;
        std::erase_if(out, [](const HighlightLine& line) { return line.role != HighlightLine::Role::ghost; });
        return out;
    }
    int row_of(const std::string& words) const {
        const WhatIf& found = *session.what_if.found();
        const auto at = std::ranges::find_if(found.variants, [&](const NodeVariant& variant) {
            return change_words(*found.variants.front().tree, variant.change) == words;
        });
        EXPECT_NE(at, found.variants.end()) << words;
        return static_cast<int>(at - found.variants.begin());
    }
};

TEST(WhatIfWindow, AButtonMeasuresAndRowsShowTheirBoxes) {
    WhatIfWindow w;
    EXPECT_FALSE(w.has("section.what if")) << "nothing is selected";
    w.run("run go.node B 1.0");
    EXPECT_EQ(w.why_not(), "");
    ASSERT_TRUE(w.has("section.what if"));
    EXPECT_FALSE(w.has("what_if.measure")) << "it is folded";
    w.unfold();
    ASSERT_TRUE(w.has("what_if.measure"));
    const auto tree = w.session.workspace.fitted().shared_tree(0);
    const std::size_t edits = w.session.workspace.history.place();
    w.run("click what_if.measure");
    ASSERT_TRUE(w.session.what_if.found());
    EXPECT_TRUE(w.has("what_if.table"));
    w.run("move 900 300");
    EXPECT_TRUE(w.ghosts().empty());
    // Two outlines, each with a line that sets it off: twelve edges of a box.
    w.run("move what_if." + std::to_string(w.row_of("3D box")));
    EXPECT_EQ(w.ghosts().size(), 24u);
    const auto free_box = w.ghosts();
    w.run("move what_if." + std::to_string(w.row_of("axes minarea")));
    EXPECT_EQ(w.ghosts().size(), 24u);
    EXPECT_NE(w.ghosts(), free_box);
    // A split shows both children's.
    w.run("move what_if." + std::to_string(w.row_of("split 7 + 23")));
    EXPECT_EQ(w.ghosts().size(), 48u);
    w.run("move 900 300");
    EXPECT_TRUE(w.ghosts().empty());
    EXPECT_EQ(w.session.workspace.fitted().shared_tree(0), tree) << "nothing is applied";
    EXPECT_EQ(w.session.workspace.history.place(), edits);
}

TEST(WhatIfWindow, TheTableIsOfTheSelectedNodeAndItsTree) {
    WhatIfWindow w;
    w.run("run go.node B 1.0\nrun tree.what_if");
    ASSERT_TRUE(w.session.what_if.found());
    EXPECT_TRUE(w.has("what_if.table")) << "the command unfolds the section";
    EXPECT_EQ(w.session.what_if.found()->node, 1);
    w.run("run go.node A 1.0");
    EXPECT_TRUE(w.session.what_if.found()) << "it plays the same clip";
    w.run("run go.node B 1.1");
    EXPECT_FALSE(w.session.what_if.found());
    EXPECT_TRUE(w.has("what_if.measure"));
    w.run("run go.node B 1.0");
    EXPECT_TRUE(w.session.what_if.found());
    w.run("run tree.axes minarea\nrun go.node B 1.0");
    EXPECT_FALSE(w.session.what_if.found()) << "it was of another tree";
}

TEST(WhatIfWindow, TheCommandSaysWhyItCannotBeDone) {
    WhatIfWindow w;
    EXPECT_EQ(w.why_not(), "no node is selected");
    w.run("run tree.kind blocks\nrun go.node B 1.0");
    EXPECT_EQ(w.why_not(), "all blocks are built alike");
    w.unfold();
    EXPECT_FALSE(w.has("what_if.measure"));
}

}  // namespace
}  // namespace mobbscope::app
