// A run in the window, by keys and clicks: who is followed stays in the picture, and buttons do what they say.
#include "app/folder_window.h"

#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/shown_agents.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <render/layout/follow.h>
#include <render/pictures/build_draw_list.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include "app/crowded_run.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

constexpr PictureSize kTall{900, 1400};  // all panels unscrolled

struct CrowdWindow : FolderWindow<TempFolder> {
    explicit CrowdWindow(PictureSize size = kTall, bool attended = false) : FolderWindow(size, 1, attended) {
        session.files.open({folder.write("run.json", crowded_run())});
        while (session.jobs.job()) session.poll();
        window.settle();
    }

    const std::string& name(std::size_t agent) const { return session.workspace.crowd()->agents[agent].name; }
    const Camera& camera() const { return session.workspace.view().camera; }

    void key(const std::string& chord_name) {
        const Chord chord = *chord_from_name(chord_name);
        window.shell().feed(KeyPress{chord.key, true});
        window.shell().feed(KeyPress{chord.key, false});
        window.settle();
    }
    glm::vec2 place(const std::string& mark) { return window.shell().marks().all().at(mark).center(); }
    /// As a person does it: frames go by while the button is down.
    void click(const std::string& mark) {
        ASSERT_TRUE(window.shell().marks().all().contains(mark)) << mark;
        window.shell().feed(MouseMove{place(mark)});
        window.settle();
        window.shell().feed(MouseButton{0, true});
        window.settle();
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
    void double_click(const std::string& mark) {
        ASSERT_TRUE(window.shell().marks().all().contains(mark)) << mark;
        window.shell().feed(MouseMove{place(mark)});
        for (const bool down : {true, false, true, false}) window.shell().feed(MouseButton{0, down});
        window.settle();
    }

    DrawList list() const {
        return build_draw_list(session.workspace.fitted(), session.workspace.view(), session.views.picture->size,
                               session.views.picture->scale);
    }
    /// Where in the picture somebody stands now: (0, 0) in its middle, 1 at its borders.
    glm::vec2 seen_at(std::size_t agent) const {
        const DrawList shown = list();
        ViewState of = session.workspace.view();
        of.follow = name(agent);
        const double time = shown_time(session.workspace);
        const glm::dvec2 at = *followed_place(session.workspace.fitted(), of, time);
        const auto pixel = shown.projection.project(shown.space.point(at.x, at.y, shown.moment ? 0.9 : time));
        if (!pixel) return glm::vec2(1e9f);
        const glm::vec2 size(shown.size.width, shown.size.height);
        return 2.0f * *pixel / size - 1.0f;
    }
    void expect_in_the_middle(std::size_t agent) const {
        EXPECT_LT(glm::length(seen_at(agent)), 0.15) << "agent " << name(agent);
    }
    /// A picture to look at, where MOBBSCOPE_LOOK names a folder.
    void change_view(const std::string& file) {
        const char* const there = std::getenv("MOBBSCOPE_LOOK");
        if (there) write_png(std::filesystem::path(there) / (file + ".png"), window.shell().read_back());
    }
};

/// In space-time, and at a moment.
class CrowdWindowTest : public ::testing::TestWithParam<Show> {
  protected:
    void SetUp() override {
        if (GetParam() == Show::moment) w.key("M");
        ASSERT_EQ(w.session.workspace.view().show, GetParam());
    }
    CrowdWindow w;
};

TEST_P(CrowdWindowTest, FramingGoesOnFollowing) {
    w.click("agent.1");
    w.key("W");
    ASSERT_EQ(w.session.workspace.view().follow, w.name(1));
    const Camera followed = w.camera();
    w.expect_in_the_middle(1);
    w.key("-");
    w.key("F");
    EXPECT_EQ(w.camera(), followed) << "as W frames them";
    w.session.workspace.select({});
    w.key("=");
    w.key("F");
    EXPECT_EQ(w.camera(), followed) << "nobody else is selected";
    w.change_view("framed");
}

/// The button stands in the panel that names who is followed; each click is a state of the history, which moves in
/// memory as it grows.
TEST_P(CrowdWindowTest, StoppingLeavesThePanelWithWhatItDraws) {
    w.click("agent.1");
    for (int i = 0; i < 9; ++i) {
        w.key("W");
        ASSERT_EQ(w.session.workspace.view().follow, w.name(1));
        w.click("crowd.stop");
        ASSERT_EQ(w.session.workspace.view().follow, "");
    }
}

TEST_P(CrowdWindowTest, ADoubleClickOnAnotherNameFollowsThatOne) {
    w.click("agent.1");
    w.key("W");
    w.double_click("agent.4");
    EXPECT_EQ(w.session.workspace.view().follow, w.name(4));
    w.expect_in_the_middle(4);
    w.change_view("another");
}

TEST_P(CrowdWindowTest, WhoIsFramedIsInThePictureThoughNobodyIsFollowed) {
    w.double_click("agent.3");
    EXPECT_EQ(w.session.workspace.view().follow, "");
    const glm::vec2 at = w.seen_at(3);
    EXPECT_LT(std::max(std::abs(at.x), std::abs(at.y)), 1);
    EXPECT_TRUE(w.camera().target);
}

TEST_P(CrowdWindowTest, TheMomentIsShownFromAsNear) {
    w.click("agent.1");
    w.key("W");
    w.key("=");
    w.key("=");
    const double distance = w.camera().distance;
    for (int i = 0; i < 2; ++i) {
        w.key("M");
        ASSERT_TRUE(w.camera().target);
        EXPECT_EQ(w.session.workspace.view().follow, w.name(1));
        EXPECT_NEAR(w.camera().distance, distance, 1e-9);
        w.expect_in_the_middle(1);
        w.change_view("m" + std::to_string(i));
    }
    w.key("Home");
    EXPECT_GT(w.camera().distance, 1.2 * distance) << "everything is shown";
}

TEST_P(CrowdWindowTest, WhoIsLeftStaysWhereTheyWere) {
    w.click("agent.1");
    w.key("W");
    w.key("F");
    const glm::vec2 before = w.seen_at(1);
    w.key("W");
    ASSERT_EQ(w.session.workspace.view().follow, "");
    EXPECT_LT(glm::length(w.seen_at(1) - before), 1e-3);
    w.key("F");
    const glm::vec2 at = w.seen_at(1);
    EXPECT_LT(std::max(std::abs(at.x), std::abs(at.y)), 1);
}

INSTANTIATE_TEST_SUITE_P(Both, CrowdWindowTest, ::testing::Values(Show::space_time, Show::moment),
                         [](const auto& shown) { return shown.param == Show::moment ? "moment" : "space_time"; });

/// The share of pixels that differ.
double difference(const Image& a, const Image& b) {
    std::size_t other = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        other += a.rgba[i] != b.rgba[i] || a.rgba[i + 1] != b.rgba[i + 1] || a.rgba[i + 2] != b.rgba[i + 2];
    }
    return 4.0 * static_cast<double>(other) / static_cast<double>(a.rgba.size());
}

TEST(CrowdWindow, NothingFliesWhenFollowingEnds) {
    CrowdWindow w({1000, 700}, true);
    w.click("agent.1");
    w.key("A");  // the ways of a choice are drawn of who is followed
    w.key("W");
    w.window.run_for(1);
    const Image before = w.window.shell().viewport_picture();
    w.window.shell().feed(KeyPress{Key::w, true});
    w.window.frame();
    ASSERT_EQ(w.session.workspace.view().follow, "");
    EXPECT_LT(difference(before, w.window.shell().viewport_picture()), 0.1);
}

TEST(CrowdWindow, CandidatesAreSortedAndFilteredAndTheHighlightFollows) {
    CrowdWindow w;
    run_command(w.session, "time.at", "6");
    w.click("agent.1");
    w.key("W");
    ASSERT_TRUE(w.session.crowds.choice());
    const auto listed = [&] {
        std::vector<std::pair<float, int>> rows;
        for (const auto& [name, rect] : w.window.shell().marks().all()) {
            if (name.starts_with("candidate.")) rows.emplace_back(rect.min.y, std::stoi(name.substr(10)));
        }
        std::ranges::sort(rows);
        std::vector<int> out;
        for (const auto& [y, index] : rows) out.push_back(index);
        return out;
    };
    const std::vector<int> by_outcome = listed();
    ASSERT_GT(by_outcome.size(), 2u);
    w.click("candidate." + std::to_string(by_outcome.front()));
    EXPECT_EQ(w.session.crowds.candidate(), by_outcome.front());
    w.click("crowd.sort_candidates.clip");
    const std::vector<int> by_clip = listed();
    w.click("crowd.sort_candidates.clip");
    const std::vector<int> back = listed();
    EXPECT_NE(by_clip, back);
    EXPECT_EQ(w.session.crowds.candidate(), by_outcome.front()) << "it is a candidate, not a row";
    w.click("crowd.list_candidates.free");
    for (const int index : listed()) {
        EXPECT_TRUE(w.session.crowds.choice()->choice.candidates[static_cast<std::size_t>(index)].is_free());
    }
    EXPECT_LT(listed().size(), by_outcome.size());
    w.click("crowd.list_candidates.all");
    w.click("candidates.filter");
    for (const char c : std::string("OFF FL")) w.window.shell().feed(TypedText{static_cast<char32_t>(c)});
    w.window.settle();
    for (const int index : listed()) {
        EXPECT_TRUE(w.session.crowds.choice()->choice.candidates[static_cast<std::size_t>(index)].leaves_floor);
    }
    EXPECT_LT(listed().size(), by_outcome.size());
    // Another choice has candidates of its own; this one's is still pointed out on the way back.
    const int play = w.session.crowds.choice()->play;
    run_command(w.session, "crowd.next_choice");
    ASSERT_NE(w.session.crowds.choice()->play, play);
    EXPECT_EQ(w.session.crowds.candidate(), -1);
    run_command(w.session, "crowd.previous_choice");
    ASSERT_EQ(w.session.crowds.choice()->play, play);
    EXPECT_EQ(w.session.crowds.candidate(), by_outcome.front());
}

TEST(CrowdWindow, CandidatesAndConflictsThatAreLookedAtArePointedOut) {
    CrowdWindow w;
    const auto roles = [&] {
        std::set<HighlightLine::Role> out;
        for (const HighlightLine& line : w.window.shell().shown()->highlights) out.insert(line.role);
        return out;
    };
    run_command(w.session, "time.at", "6");
    w.click("agent.1");
    w.key("W");
    ASSERT_TRUE(w.session.crowds.choice());
    ASSERT_FALSE(w.session.crowds.choice()->choice.candidates.empty());
    EXPECT_FALSE(roles().contains(HighlightLine::Role::candidate));
    w.session.crowds.point_out(0);
    w.window.settle();
    EXPECT_TRUE(roles().contains(HighlightLine::Role::candidate));
    w.session.crowds.point_out(-1);
    run_command(w.session, "conflicts.find");
    while (w.session.jobs.job()) w.session.poll();
    run_command(w.session, "conflicts.go", "0");
    run_command(w.session, "conflicts.choice");
    w.window.settle();
    ASSERT_GE(w.session.workspace.conflict, 0);
    EXPECT_TRUE(roles().contains(HighlightLine::Role::conflict));
    EXPECT_FALSE(roles().contains(HighlightLine::Role::candidate));
}

TEST(CrowdWindow, ASampleIsFramedWhileSomebodyElseIsFollowed) {
    CrowdWindow w;
    w.click("agent.1");
    w.key("W");
    w.session.workspace.select({Selection::Kind::sample, {4, -1, 0}, 3});
    w.key("F");
    EXPECT_EQ(w.session.workspace.view().follow, w.name(1));
    const DrawList shown = w.list();
    const mobb::PlacedTree tree = w.session.workspace.fitted().placed(w.session.workspace.fitted().placed_agents()[4]);
    const mobb::Disk disk = tree.placed_clip().disk(3);
    const auto pixel = shown.projection.project(shown.space.point(disk.x, disk.y, tree.placed_clip().time(3)));
    ASSERT_TRUE(pixel);
    const glm::vec2 middle(0.5f * static_cast<float>(shown.size.width), 0.5f * static_cast<float>(shown.size.height));
    EXPECT_LT(glm::length(*pixel - middle), 0.2f * middle.x);
}

/// How many names stand in the picture that agents have.
std::set<std::string> names_in(CrowdWindow& w) {
    std::set<std::string> out;
    for (const TextRun& run : w.window.shell().shown()->texts)
        if (run.role == TextRole::name) out.insert(run.text);
    return out;
}

/// Whose disks are drawn, by index into CrowdRun::agents.
std::set<int> drawn_whole(CrowdWindow& w) {
    std::set<int> out;
    const std::vector<DrawnAgent> agents = drawn_agents(w.session.workspace.fitted(), w.session.workspace.view());
    for (const DiskInstance& disk : w.window.shell().shown()->disks)
        out.insert(agents[static_cast<std::size_t>(disk.id.agent)].run_agent);
    return out;
}

/// A click shows the two alone, named, in the picture, before they touch; Escape shows all from where they were seen.
TEST_P(CrowdWindowTest, AClickOnAConflictShowsTheTwoAlone) {
    w.click("conflicts.find");
    const std::vector<SceneConflict>* found = w.session.crowds.conflicts();
    ASSERT_TRUE(found && !found->empty());
    const Camera before = w.camera();
    const SceneConflict& conflict = found->front();
    w.click("conflict.0");
    EXPECT_EQ(w.session.workspace.view().foreground, (AgentNames{conflict.a.name, conflict.b.name}));
    EXPECT_LT(*w.session.workspace.view().time, conflict.begin());
    EXPECT_EQ(names_in(w), (std::set<std::string>{conflict.a.name, conflict.b.name}));
    EXPECT_EQ(drawn_whole(w), (std::set<int>{conflict.a.agent, conflict.b.agent}));
    for (const int agent : {conflict.a.agent, conflict.b.agent}) {
        const glm::vec2 at = w.seen_at(static_cast<std::size_t>(agent));
        EXPECT_LT(std::max(std::abs(at.x), std::abs(at.y)), 0.9f) << agent;
    }
    w.change_view("two alone");
    w.key("Escape");
    EXPECT_TRUE(w.session.workspace.view().foreground.empty());
    EXPECT_EQ(w.camera(), before);
    EXPECT_GT(drawn_whole(w).size(), 2u);
}

/// The mark in the picture and the bar below it do the same as the row.
TEST_P(CrowdWindowTest, AConflictIsOpenedByItsMarkAndItsBar) {
    w.click("conflicts.find");
    ASSERT_TRUE(w.session.crowds.conflicts());
    const SceneConflict conflict = w.session.crowds.conflicts()->front();
    run_command(w.session, "time.at", std::to_string(conflict.begin()));
    w.window.settle();
    w.click("picture.conflict.0");
    EXPECT_EQ(w.session.workspace.conflict, 0);
    EXPECT_EQ(w.session.workspace.view().foreground, (AgentNames{conflict.a.name, conflict.b.name}));
    w.click("conflicts.back");
    EXPECT_TRUE(w.session.workspace.view().foreground.empty());
    w.session.workspace.conflict = -1;
    w.window.settle();
    w.click("timeline.conflict.0");
    ASSERT_GE(w.session.workspace.conflict, 0);
    const double width = 12.0 / 100;  // seconds of the bar
    const double begin =
        (*w.session.crowds.conflicts())[static_cast<std::size_t>(w.session.workspace.conflict)].begin();
    EXPECT_NEAR(begin, conflict.begin(), width) << "the deepest of the bar";
}

TEST(CrowdWindow, ForcedAndTurnedPlaysAreListedForAll) {
    CrowdWindow w;
    const std::vector<SpecialPlay> by_time = w.session.crowds.special_plays();
    ASSERT_GT(by_time.size(), 1u);
    EXPECT_TRUE(std::ranges::is_sorted(by_time, {}, &SpecialPlay::time));
    std::size_t expected = 0;
    for (const CrowdAgent& agent : w.session.workspace.crowd()->agents)
        expected += static_cast<std::size_t>(
            std::ranges::count_if(agent.plays, [](const Play& play) { return play.kind != PlayKind::chosen; }));
    EXPECT_EQ(by_time.size(), expected);
    w.click("special.1");
    const SpecialPlay second = by_time[1];
    EXPECT_EQ(w.session.workspace.view().follow, w.name(static_cast<std::size_t>(second.agent)));
    ASSERT_TRUE(w.session.crowds.choice());
    EXPECT_EQ(w.session.crowds.choice()->play, second.play) << "the choice of that play";
    w.click("special.kind");
    EXPECT_EQ(w.session.crowds.special_plays().front().kind, PlayKind::forced);
    w.click("special.kind");
    EXPECT_EQ(w.session.crowds.special_plays().back().kind, PlayKind::forced) << "the other way round";
}

TEST(CrowdWindow, ADoubleClickOnAConflictShowsTheForcedChoice) {
    CrowdWindow w;
    w.click("conflicts.find");
    ASSERT_TRUE(w.session.crowds.conflicts());
    const std::size_t shown = std::min<std::size_t>(w.session.crowds.conflicts()->size(), 5);
    ASSERT_GT(shown, 0u);
    for (std::size_t i = 0; i < shown; ++i) {
        w.double_click("conflict." + std::to_string(i));
        ASSERT_EQ(w.session.workspace.conflict, static_cast<int>(i));
        ASSERT_TRUE(w.session.crowds.choice());
        EXPECT_EQ(w.session.crowds.choice()->choice.kind, PlayKind::forced);
        EXPECT_TRUE(w.session.crowds.choice()->comes_out);
        EXPECT_FALSE(w.window.shell().marks().all().contains("choice.edited"));
    }
    w.change_view("forced");
}

TEST(CrowdWindow, AChoiceOfAnEditedRunSaysSo) {
    std::string text = crowded_run();
    const std::size_t seed = text.find("\"seed\": 1");
    ASSERT_NE(seed, std::string::npos);
    text.replace(seed, 9, "\"seed\": 2");
    CrowdWindow w;
    w.session.files.open({w.folder.write("edited.json", text)});
    while (w.session.jobs.job()) w.session.poll();
    w.window.settle();
    w.click("agent.1");
    w.key("W");
    // With another seed some choice soon comes out otherwise.
    for (int i = 0; i < 40 && (!w.session.crowds.choice() || w.session.crowds.choice()->comes_out); ++i) {
        w.key(i < 8 ? "N" : "Shift+N");
    }
    ASSERT_TRUE(w.session.crowds.choice());
    ASSERT_FALSE(w.session.crowds.choice()->comes_out);
    EXPECT_TRUE(w.window.shell().marks().all().contains("choice.edited")) << "the panel says it";
    std::string said;
    for (const TextRun& run : w.window.shell().shown()->texts) said += run.text + ' ';
    EXPECT_NE(said.find("made again the choice is"), std::string::npos) << "and the picture: " << said;
    w.change_view("edited");
}

TEST(CrowdWindow, AConflictOpensByItsButtonWhileSomebodyIsFollowed) {
    CrowdWindow w;
    w.click("conflicts.find");
    ASSERT_TRUE(w.session.crowds.conflicts());
    w.double_click("conflict.0");
    ASSERT_NE(w.session.workspace.view().follow, "");
    ASSERT_TRUE(w.window.shell().marks().all().contains("crowd.open_candidate")) << "a button of the same words";
    w.click("conflicts.open");
    EXPECT_TRUE(w.session.workspace.in_excerpt());
}

TEST(CrowdWindow, AnExcerptBeginsAtTheTopOfItsPanels) {
    CrowdWindow w({1280, 600});
    w.click("conflicts.find");
    w.double_click("conflict.0");
    const auto scroll_down = [&] {
        const glm::vec2 splitter = w.place("splitter.right");
        // Dear ImGui keeps the wheel to what it scrolled last until the mouse moves.
        w.window.shell().feed(MouseMove{{splitter.x + 20, 300}});
        w.window.settle();
        w.window.shell().feed(MouseMove{{splitter.x + 20, 60}});
        for (int i = 0; i < 20; ++i) w.window.shell().feed(Wheel{{0, -10}});
        w.window.settle();
    };
    const float at_top = w.place("crowd.stop").y;
    scroll_down();
    ASSERT_LT(w.place("crowd.stop").y, at_top - 50);
    run_command(w.session, "conflicts.open");
    w.window.settle();
    ASSERT_TRUE(w.session.workspace.in_excerpt());
    const float answer = w.place("query.answer").y;
    EXPECT_GT(answer, 40);
    EXPECT_LT(answer, 300);
    scroll_down();
    ASSERT_LT(w.place("query.answer").y, answer - 50);
    w.key("Backspace");
    ASSERT_FALSE(w.session.workspace.in_excerpt());
    EXPECT_LT(w.place("crowd.stop").y, at_top - 50) << "the crowd's panel is where it was left";
    run_command(w.session, "conflicts.open");
    w.window.settle();
    EXPECT_EQ(w.place("query.answer").y, answer) << "another excerpt";
}

TEST(CrowdWindow, TheTwoOfAnUnforcedConflictExpectNone) {
    Session session(false);
    session.files.open({kSource / "tests/app/goldens/files/run.json"});
    const auto open_first = [&] {
        run_command(session, "conflicts.find");
        while (session.jobs.job()) session.poll();
        run_command(session, "conflicts.go", "0");
        run_command(session, "conflicts.open");
        ASSERT_TRUE(session.workspace.in_excerpt());
    };
    open_first();
    EXPECT_TRUE(session.workspace.scene().queries.empty()) << "a forced play may collide";
    run_command(session, "crowd.back");
    session.workspace.edit({"an edit", ""}, [](Scene& scene) {
        CrowdRun run = *scene.crowd;
        for (CrowdAgent& agent : run.agents) {
            for (Play& play : agent.plays) play.kind = PlayKind::pivoted;
        }
        scene.crowd = std::make_shared<const CrowdRun>(std::move(run));
    });
    open_first();
    ASSERT_EQ(session.workspace.scene().queries.size(), 1u);
    EXPECT_EQ(session.workspace.scene().queries[0].expect, (Expectation{false, {}}));
    EXPECT_TRUE(session.queries.answer_of(0).contact) << "which is wrong";
    run_command(session, "query.capture");
    EXPECT_FALSE(session.workspace.scene().clips[0].source) << "its samples are inside";
    EXPECT_EQ(session.workspace.scene().queries[0].expect->collides, true);
    run_command(session, "crowd.back");
    EXPECT_TRUE(session.workspace.crowd());
}

}  // namespace
}  // namespace mobbscope::app
