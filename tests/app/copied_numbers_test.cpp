// Any number that a panel shows copies itself at a click, with all its digits.
#include <app/document/described.h>
#include <app/window/headless_window.h>
#include <base/text.h>
#include <explain/tree_cost.h>
#include <render/gl/gl_context.h>
#include <scene/drawn_agent.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mobbscope::app {
namespace {

struct CopyWindow : FolderWindow<CrossingFolder> {
    CopyWindow() : FolderWindow({1280, 1400}) { open(folder.scene); }
    /// Clicks so many pixels right of a mark's left edge, or left of its right one.
    std::string click(const std::string& mark, float right, bool ctrl = false) {
        const auto& marks = window.shell().marks().all();
        if (!marks.contains(mark)) return "no " + mark;
        const Rect rect = marks.at(mark);
        desktop.text = "nothing";
        window.shell().feed(MouseMove{{right >= 0 ? rect.min.x + right : rect.max.x + right, rect.center().y}});
        if (ctrl) window.shell().feed(KeyPress{Key::ctrl, true});
        window.settle();
        window.shell().feed(MouseButton{0, true});
        window.settle();
        window.shell().feed(MouseButton{0, false});
        window.settle();
        if (ctrl) window.shell().feed(KeyPress{Key::ctrl, false});
        window.settle();
        return desktop.text;
    }
    std::string said() const {
        return session.notifications.all().empty() ? "" : session.notifications.all().back().text;
    }
};

TEST(CopiedNumbers, FactsOfWhatIsSelected) {
    CopyWindow w;
    w.run("go.sample", "B 17");
    const FittedScene& fitted = w.session.workspace.fitted();
    const mobb::PlacedTree placed = fitted.placed(fitted.placed_agents()[1]);
    const mobb::Disk disk = placed.placed_clip().disk(17);
    EXPECT_EQ(w.click("selection.place", 4), format_double(disk.x));
    EXPECT_EQ(w.said(), "Copied " + brief(disk.x));
    EXPECT_EQ(w.click("selection.place", -20), format_double(disk.y));
    EXPECT_EQ(w.said(), "Copied " + brief(disk.y) + " m");
    EXPECT_EQ(w.click("selection.time", 4), format_double(placed.placed_clip().time(17)));
    EXPECT_EQ(w.click("selection.radius", -3), "nothing") << "a click on the unit";
    w.run("go.node", "B 1");
    EXPECT_EQ(w.click("selection.volume", 4), format_double(mobb::volume(placed.tree().box(1), placed.time_scale())));
}

TEST(CopiedNumbers, CostsAndRowsOfLevels) {
    CopyWindow w;
    const std::shared_ptr<const TreeCost> cost = w.session.workspace.cost_of(0);
    ASSERT_TRUE(cost);
    EXPECT_EQ(w.click("cost.total", 4), format_double(cost->ns()));
    MeanTests samples;
    samples[mobb::TestKind::samples] = cost->tests[mobb::TestKind::samples];
    EXPECT_EQ(w.click("cost.kind.samples", -4), format_double(100 * cost->part(samples)));
    // A click on a row shows its level; with Ctrl it copies.
    w.run("view.level", "1");
    EXPECT_EQ(w.click("level.2", -14, true), format_double(cost->ns(cost->levels[2])));
    EXPECT_EQ(w.session.workspace.view().levels.last, 1);
    EXPECT_EQ(w.click("level.2", -14), "nothing");
    EXPECT_EQ(w.session.workspace.view().levels.last, 2);
}

TEST(CopiedNumbers, TheAnswerOfAQuery) {
    CopyWindow w;
    w.run("query.select", "0");
    const mobb::Contact contact = w.session.workspace.recorded()->contact.value();
    EXPECT_EQ(w.click("number.contact_at", 4), format_double(contact.time));
    EXPECT_EQ(w.said(), "Copied " + brief(contact.time) + " s");
    EXPECT_EQ(w.click("number.distance", 4), format_double(contact.distance));
    // "They collide at 0.967 s": from the left edge over the words to the number.
    bool found = false;
    for (float x = 0; x < 280 && !found; x += 4) found = w.click("query.verdict", x) == format_double(contact.time);
    EXPECT_TRUE(found);
}

}  // namespace
}  // namespace mobbscope::app
