// Of many queries those that hit are listed first; their numbers stay.
#include "app/folder_window.h"

#include <app/commands/command.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

/// Six stand apart in a row; the last two stand in one place, so that the last of their 15 queries hits.
std::string standing_row() {
    std::string text = R"({"clips": {"stand": {"dt": 1, "samples": [[0, 0, 0.3]]}}, "agents": [)";
    for (int i = 0; i < 6; ++i) {
        text += i > 0 ? ", " : "";
        text += R"({"name": ")" + std::string(1, static_cast<char>('A' + i)) + R"(", "clip": "stand", "translate": [)" +
                std::to_string(std::min(i, 4)) + ", 0]}";
    }
    return text + "]}";
}

struct QueryOrderWindow : FolderWindow<TempFolder> {
    QueryOrderWindow() : FolderWindow({900, 1400}) { open(folder.write("row.json", standing_row())); }
    float height_of(int query) { return window.shell().marks().all().at("query." + std::to_string(query)).min.y; }
    void click(const std::string& mark) {
        window.shell().feed(MouseMove{window.shell().marks().all().at(mark).center()});
        for (const bool down : {true, false}) window.shell().feed(MouseButton{0, down});
        window.settle();
    }
    void key(Key which) {
        for (const bool down : {true, false}) window.shell().feed(KeyPress{which, down});
        window.settle();
    }
};

TEST(QueryOrder, HitsStandFirst) {
    QueryOrderWindow w;
    const QueryAnswers::Known known = *w.session.answers.known();
    EXPECT_EQ(known.asked, 15u);
    EXPECT_EQ(known.hits, std::vector<int>{14});
    std::vector<int> expected{14};
    for (int i = 0; i < 14; ++i) expected.push_back(i);
    EXPECT_EQ(w.session.costs.listed(), expected);
    EXPECT_LT(w.height_of(14), w.height_of(0));
    w.click("query.14");
    EXPECT_EQ(w.session.workspace.view().query, 14) << "by the number that the file gives it";
    w.key(Key::page_down);
    EXPECT_EQ(w.session.workspace.view().query, 0) << "the next row";
    w.key(Key::page_up);
    EXPECT_EQ(w.session.workspace.view().query, 14);
    w.click("queries.number");
    EXPECT_EQ(w.session.costs.listed().front(), 0);
    w.click("queries.hits");
    EXPECT_EQ(w.session.costs.listed(), expected);
}

TEST(QueryOrder, TheListOpensAtTheQueryInView) {
    QueryOrderWindow w;
    w.click("queries.number");
    w.session.settings.folded["queries"] = true;
    run_command(w.session, "query.select", "14");
    w.window.settle();
    w.session.settings.folded["queries"] = false;
    w.window.settle();
    EXPECT_TRUE(w.window.shell().marks().all().contains("query.14"));
    EXPECT_FALSE(w.window.shell().marks().all().contains("query.0"));
}

TEST(QueryOrder, AnEditIsAskedAgain) {
    QueryOrderWindow w;
    run_command(w.session, "go.agent", "F");
    run_command(w.session, "agent.move", "9 0");
    w.window.settle();
    EXPECT_TRUE(w.session.answers.known()->hits.empty());
    EXPECT_EQ(w.session.costs.listed().front(), 0);
}

}  // namespace
}  // namespace mobbscope::app
