// What `render` shows: views from files, exact cameras, toggles, backgrounds.
#include "render_runs.h"

#include <support/folders.h>

#include <scene/view_options.h>

namespace mobbscope {
namespace {

class RenderViewTest : public DrawingTest {};

TEST_F(RenderViewTest, AViewStateGoesOverTheScenesAndOptionsOverBoth) {
    const std::string state = folder.write("view.json", R"({"theme": "light", "levels": "1", "legend": false})");
    const Image plain = picture({kCrossing});
    const Image seen = picture({kCrossing, "--view-state", state});
    EXPECT_NE(seen.rgba, plain.rgba);
    EXPECT_EQ(picture({kCrossing, "--theme", "light", "--level", "1", "--no-legend"}).rgba, seen.rgba);
    EXPECT_EQ(picture({kCrossing, "--view-state", state, "--theme", "dark"}).rgba,
              picture({kCrossing, "--theme", "dark", "--level", "1", "--no-legend"}).rgba);
}

TEST_F(RenderViewTest, TheViewOfAnotherSceneIsTakenWhole) {
    const std::string clip = R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1],[2,0,1.5],[3,0,1]]}})";
    const std::string scene = folder.write("a.json", clip + R"(, "view": {"theme": "light", "floor": false}})");
    const std::string other = folder.write("b.json", clip + R"(, "view": {"labels": false}})");
    EXPECT_EQ(picture({scene, "--view-state", other}).rgba,
              picture({scene, "--theme", "dark", "--floor", "--no-labels"}).rgba);
    const std::string without = folder.write("c.json", clip + "}");
    EXPECT_EQ(picture({scene, "--view-state", without}).rgba, picture({scene, "--theme", "dark", "--floor"}).rgba);
}

TEST(RenderView, ABadViewStateNamesItsPlace) {
    const TempFolder folder;
    const auto refused = [&](const char* text, const std::string& why) {
        const std::string state = folder.write("view.json", text);
        expect_refused(render_small({kCrossing, "--view-state", state, "-o", folder.path() / "o.png"}), 2, why);
    };
    refused("{", "view.json: line 1");
    refused(R"({"theem": "dark"})", "view.json: line 1, /theem");
    refused(R"({"camera": {"target": [0, 0, 0]}})", "/camera");
    // What the scene does not have: both files are named.
    const std::string both = std::string(": ") + kCrossing + ": there is no ";
    refused(R"({"query": 7})", "view.json: line 1, /query" + both + "query 7");
    refused("{\"query\": 0,\n\"step\": 99999}", "view.json: line 2, /step" + both + "step 99999");
    refused(R"({"follow": "nobody", "show": "moment"})", "view.json: line 1, /follow" + both + "agent 'nobody'");
    refused(R"({"projection": {"participant": 9}})", "view.json: line 1, /projection" + both + "participant 9");
    refused(R"({"projection": {"node": 99999}})", "view.json: line 1, /projection" + both + "node 99999");
    refused(R"({"clips": {}, "view": {"query": 7}})", "view.json: line 1, /view/query" + both + "query 7");
    refused("[]", "view.json: line 1");
    // What the command line or the scene says itself is not blamed on the view's file.
    const std::string good = folder.write("view.json", R"({"query": 0, "step": 0})");
    const std::string scene = folder.write("scene.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}},
        "view": {"follow": "nobody", "show": "moment"}})");
    const std::string out = folder.path() / "o.png";
    expect_refused(render_small({kCrossing, "--view-state", good, "--query", "7", "-o", out}), 2,
                   std::string(kCrossing) + ": there is no query 7");
    expect_refused(
        render_small({scene, "--view-state", folder.write("theme.json", R"({"theme": "light"})"), "-o", out}), 2,
        "scene.json: line 2, /view/follow: there is no agent 'nobody'");
    expect_refused(render_small({kCrossing, "--view-state", "none.json", "-o", folder.path() / "o.png"}), 2,
                   "none.json");
    // What is read must not be replaced, whatever it is called.
    const std::string state = folder.write("state.png", "{}");
    expect_refused(render_small({kCrossing, "--view-state", state, "-o", state}), 2, "would replace");
    EXPECT_EQ(files_in(folder.path()), (std::set<std::string>{"scene.json", "state.png", "theme.json", "view.json"}));
}

TEST_F(RenderViewTest, CamerasAreExact) {
    const std::string state = folder.write("view.json", R"({"camera": {"preset": "free", "yaw_deg": 20, "pitch_deg": 30,
        "fov_deg": 20, "target": [-1.5, 0.5, 2], "distance": 30, "shift": [0.1, -0.05]}})");
    const std::vector<std::string> options{kCrossing,    "--view",     "free",  "--yaw",   "20",
                                           "--pitch",    "30",         "--fov", "20",      "--target",
                                           "-1.5,0.5,2", "--distance", "30",    "--shift", "0.1,-0.05"};
    EXPECT_EQ(picture(options).rgba, picture({kCrossing, "--view-state", state}).rgba);
    // Without perspective the field of view says how large the picture is.
    const Image near = picture({kCrossing, "--view", "top", "--fov", "20", "--target", "0,0,0", "--distance", "30"});
    const Image far = picture({kCrossing, "--view", "top", "--fov", "40", "--target", "0,0,0", "--distance", "30"});
    EXPECT_NE(near.rgba, far.rgba);
    EXPECT_NE(picture({kCrossing, "--ortho"}).rgba, picture({kCrossing}).rgba);
    EXPECT_EQ(picture({kCrossing, "--perspective"}).rgba, picture({kCrossing}).rgba);
    // A distance alone is of the scene's own target.
    EXPECT_NE(picture({kCrossing, "--view-state", state, "--distance", "60"}).rgba,
              picture({kCrossing, "--view-state", state}).rgba);
}

TEST(RenderView, CamerasThatAreNoneAreRefused) {
    const TempFolder folder;
    const struct {
        std::vector<std::string> options;
        std::string why;
    } cases[] = {
        {{"--target", "1,2,3"}, "--distance"},
        {{"--distance", "5"}, "--target"},
        {{"--shift", "0,0"}, "--target"},
        {{"--view", "iso", "--distance", "5"}, "--view iso and --distance"},
        {{"--target", "1,2", "--distance", "5"}, "X,Y,HEIGHT"},
        {{"--target", "1,2,3,4", "--distance", "5"}, "X,Y,HEIGHT"},
        {{"--target", "1,2,nan", "--distance", "5"}, "X,Y,HEIGHT"},
        {{"--target", "1,,3", "--distance", "5"}, "X,Y,HEIGHT"},
        {{"--target", "1,2,3", "--distance", "0"}, "--distance"},
        {{"--target", "1,2,3", "--distance", "5", "--shift", "2,0"}, "from -1 to 1"},
        {{"--view", "top", "--fov", "20"}, "--view top and --fov"},
        {{"--show", "nothing"}, "space-time, moment"},
        {{"--samples", "3"}, "1, 2, 4 or 8"},
        {{"--background", "red"}, "#RRGGBB"},
        {{"--ui", "--background", "#000000"}, "--ui and --background"},
        {{"--ui", "--samples", "1"}, "--ui and --samples"},
        {{"--ui", "--ids", "i.png"}, "--ui and --ids"},
        {{"--ui", "--draw-list", "i.json"}, "--ui and --draw-list"},
        {{"--ui", "--play"}, "--ui and --play"},
        {{"--ids", "i.jpg"}, ".png"},
        {{"--draw-list", "i.png"}, ".json"},
        {{"--perspective=banana"}, "--perspective: 'banana' is neither true nor false"},
        {{"--no-floor=maybe"}, "'maybe' is neither true nor false"},
        {{"--json"}, "--list-backends"},
        {{"--view-state", ""}, "the name of a file is empty"},
        {{"--ids", ""}, "the name of a file is empty"},
    };
    for (const auto& [options, why] : cases) {
        std::vector<std::string> all{kCrossing, "-o", folder.path() / "o.png"};
        all.insert(all.end(), options.begin(), options.end());
        expect_refused(render_small(all), 2, why);
    }
    EXPECT_TRUE(files_in(folder.path()).empty());
    expect_refused(render_small({kCrossing}), 2, "--output");
    expect_refused(render_small({"-o", folder.path() / "o.png"}), 2, "FILE is required");
    expect_refused(render_small({kCrossing, "--ui", "--draw-list", folder.path() / "o.json"}), 2, "--output");
}

TEST_F(RenderViewTest, StepsAreFoundByWhatTheyAre) {
    const auto rgba = [&](const char* query, const char* step) {
        return picture({kCrossing, "--query", query, "--step", step}).rgba;
    };
    EXPECT_EQ(rgba("0", "depth:0"), rgba("0", "0"));
    EXPECT_EQ(rgba("0", "overlap"), rgba("0", "overlap:1"));
    EXPECT_NE(rgba("0", "avoidable:1"), rgba("0", "avoidable:2"));
    const std::string view = folder.write("view.json", R"({"query": 0, "step": "avoidable:2"})");
    EXPECT_EQ(picture({kCrossing, "--view-state", view}).rgba, rgba("0", "avoidable:2"));
    const std::string out = folder.path() / "o.png";
    expect_refused(render_small({kCrossing, "--query", "0", "--step", "avoidable:9999", "-o", out}), 2,
                   "there is no step avoidable:9999: the query has only ");
    expect_refused(render_small({kCrossing, "--query", "0", "--step", "leaf:0", "-o", out}), 2, "is not a step");
}

TEST_F(RenderViewTest, WhatIsSwitchedOffIsNotShown) {
    const Image all = picture({kCrossing, "--query", "0", "--step", "40%"});
    for (const char* off : {"--no-labels", "--no-floor", "--no-time-axis", "--no-boxes", "--no-disks", "--pair-only"}) {
        EXPECT_NE(picture({kCrossing, "--query", "0", "--step", "40%", off}).rgba, all.rgba) << off;
    }
    const Image pair = picture({kCrossing, "--query", "0", "--step", "40%", "--past", "pair"});
    EXPECT_EQ(picture({kCrossing, "--query", "0", "--step", "40%", "--pair-only"}).rgba, pair.rgba);
    EXPECT_EQ(picture({kCrossing, "--query", "0", "--step", "40%", "--past", "ancestors"}).rgba, all.rgba);
    EXPECT_NE(picture({kCrossing, "--query", "0", "--step", "40%", "--past", "all"}).rgba, all.rgba);
    EXPECT_NE(picture({kCrossing, "--no-legend"}).rgba, picture({kCrossing}).rgba);
    for (const ViewOption& option : view_options()) {
        if (!option.toggle || option.option.empty()) continue;
        const std::string on = in_command_line(option, ViewState{}).substr(1);
        EXPECT_EQ(picture({kCrossing, "--query", "0", "--step", "40%", on}).rgba, all.rgba) << on;
    }
}

TEST(RenderView, APartOfATreeGoesBeforeTheScenesQuery) {
    const TempFolder folder;
    const std::string list = folder.path() / "list.json";
    const auto drawn = [&](std::vector<std::string> options) {
        options.insert(options.end(), {"--draw-list", list});
        const Result run = render_small(options);
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(list);
    };
    const std::string query = folder.write("query.json", R"({"query": 0})");
    const std::string part = drawn({kCrossing, "--subtree", "A:1"});
    EXPECT_EQ(drawn({kCrossing, "--view-state", query, "--subtree", "A:1"}), part);
    const std::string asked = drawn({kCrossing, "--query", "0"});
    EXPECT_NE(asked, part);
    EXPECT_EQ(drawn({kCrossing, "--view-state", query, "--subtree", "none"}), asked);
}

TEST(RenderView, NamedViewsAreBlamedWhereTheyStand) {
    const TempFolder folder;
    const std::string out = folder.path() / "o.png";
    const std::string scene = folder.write("scene.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}},
        "view": {"subtree": {"participant": 0, "node": 0}},
        "debug": {"views": [{"name": "whole", "view": {}},
        {"name": "part", "view": {"subtree": {"participant": 0, "node": 99}}}]}})");
    expect_refused(render_small({scene, "--view", "part", "-o", out}), 2,
                   "scene.json: line 4, /debug/views/1/view/subtree");
    expect_refused(render_small({scene, "--view", "pert", "-o", out}), 2, "(did you mean 'part'?)");
    expect_refused(render_small({scene, "--view", "tpo", "-o", out}), 2, "(did you mean 'top'?)");
    expect_refused(render_small({scene, "--slab", "0:1e300", "-o", out}), 2, "'0:1e300' is not a range");
}

TEST_F(RenderViewTest, AnAgentCalledNoneCanBeHidden) {
    const std::string scene = folder.write("none.json", R"({
        "clips": {"c": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.4]]}},
        "agents": [{"name": "none", "clip": "c"}, {"name": "B", "clip": "c"}]})");
    const std::string list = folder.path() / "none.draw.json";
    const auto drawn = [&](const std::string& whom) {
        const Result run = render_small({scene, "--draw-list", list, "--hide", whom});
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(list);
    };
    EXPECT_NE(drawn("none").find("none is hidden"), std::string::npos);
    EXPECT_EQ(drawn("").find("is hidden"), std::string::npos) << "an empty name is nobody's";
}

TEST_F(RenderViewTest, WhoIsHiddenIsNotDrawnAndAGridIs) {
    const std::string lists = folder.path() / "list.json";
    const auto list = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{kCrossing, "--draw-list", lists};
        all.insert(all.end(), options.begin(), options.end());
        const Result run = render_small(all);
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(lists);
    };
    const std::string one = list({"--hide", "B", "--no-boxes"});
    EXPECT_NE(one.find("B is hidden"), std::string::npos);
    EXPECT_LT(one.size(), list({"--no-boxes"}).size());
    EXPECT_NE(list({"--hide", "A", "B"}).find("A and B are hidden"), std::string::npos);
    EXPECT_NE(list({"--hide", "B", "--query", "0"}).find("B is hidden"), std::string::npos);
    EXPECT_NE(list({"--arrange", "grid"}).find("in a grid, not where they are"), std::string::npos);
    EXPECT_EQ(list({"--arrange", "grid", "--query", "0"}), list({"--query", "0"})) << "a query is where it is";
    expect_refused(render_small({kCrossing, "-o", folder.path() / "o.png", "--hide", "C"}), 2,
                   "there is no agent 'C'; the nearest is 'A'");
    expect_refused(render_small({kCrossing, "-o", folder.path() / "o.png", "--hide", "B", "--select", "B"}), 2,
                   "'B' is hidden");
}

TEST_F(RenderViewTest, WhatIsMeasuredIsDrawn) {
    const std::string lists = folder.path() / "list.json";
    const auto list = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{kCrossing, "--draw-list", lists};
        all.insert(all.end(), options.begin(), options.end());
        const Result run = render_small(all);
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(lists);
    };
    const std::string measured = list({"--measure", "-3,-1,0:0,3,2.5"});
    EXPECT_NE(measured.find("\"role\": \"measure\""), std::string::npos);
    EXPECT_NE(measured.find("5.000 m, 2.500 s, 2.000 m/s"), std::string::npos);
    EXPECT_EQ(list({"--measure", "-3,-1,0:0,3,2.5", "--no-labels"}).find("2.000 m/s"), std::string::npos);
    EXPECT_EQ(list({}).find("\"measure\""), std::string::npos);
    expect_refused(render_small({kCrossing, "-o", folder.path() / "o.png", "--measure", "1,2:3,4"}), 2,
                   "give X,Y,T:X,Y,T in metres and seconds");
}

TEST_F(RenderViewTest, WhatIsSelectedIsHighlighted) {
    const std::string lists = folder.path() / "list.json";
    const auto highlighted = [&](const std::vector<std::string>& options) {
        std::vector<std::string> all{kCrossing, "--draw-list", lists};
        all.insert(all.end(), options.begin(), options.end());
        const Result run = render_small(all);
        EXPECT_EQ(run.status, 0) << run.err;
        return slurp(lists).find("\"role\": \"selection\"") != std::string::npos;
    };
    EXPECT_FALSE(highlighted({}));
    EXPECT_TRUE(highlighted({"--select", "A"}));
    EXPECT_TRUE(highlighted({"--select", "B:sample:3", "--query", "0", "--step", "2"}));
    EXPECT_TRUE(highlighted({"--select", "A", "--show", "moment", "--time", "1"}));
    EXPECT_NE(picture({kCrossing, "--select", "A:node:1"}).rgba, picture({kCrossing, "--select", "A"}).rgba);
    const std::string named = folder.write("colons.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}},
        "agents": [{"name": "a:b", "clip": "c"}, {"name": "a:sample:0", "clip": "c", "translate": [9, 0]}]})");
    EXPECT_NE(picture({named, "--select", "a:b:sample:1"}).rgba, picture({named, "--select", "a:b"}).rgba);
    EXPECT_NE(picture({named, "--select", "a:sample:0:path"}).rgba, picture({named}).rgba);
    // Of several pictures one is enough that shows it.
    const Result run = render_small({kCrossing, "--show", "moment", "--play", "--rate", "1", "--select", "B",
                                     "--draw-list", folder.path() / "all.json"});
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(RenderView, ASelectionThatIsNoneIsRefused) {
    const TempFolder folder;
    const struct {
        std::vector<std::string> options;
        std::string why;
    } cases[] = {
        {{"C"}, kCrossing + ": --select: the picture is not of an agent 'C': it is of 'A', 'B'"},
        {{"A:node:99999"}, "--select: 'A' has no node 99999: give 0 to "},
        {{"A:sample:-1"}, "--select: 'A' has no sample -1: give 0 to "},
        {{"A:node:x"}, "not of an agent 'A:node:x'"},
        {{""}, "give AGENT, AGENT:path, AGENT:node:N or AGENT:sample:N"},
        {{"A", "--ui"}, "--ui and --select"},
        {{"A:node:0", "--show", "moment"}, "leave out --show"},
        {{"A", "--show", "moment", "--time", "900"}, "'A' is not there at 900 s"},
    };
    for (const auto& [options, why] : cases) {
        std::vector<std::string> all{kCrossing, "-o", folder.path() / "o.png", "--select"};
        all.insert(all.end(), options.begin(), options.end());
        expect_refused(render_small(all), 2, why);
    }
    EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST_F(RenderViewTest, BackgroundsAndSamplesAreTaken) {
    const Image clear = picture({kCrossing, "--background", "transparent"});
    EXPECT_EQ(clear.at(1, 238)[3], 0);
    const Image red = picture({kCrossing, "--background", "#FF0000"});
    EXPECT_EQ(std::vector<int>(red.at(1, 238), red.at(1, 238) + 4), (std::vector<int>{255, 0, 0, 255}));
    const Image usual = picture({kCrossing});
    EXPECT_EQ(picture({kCrossing, "--samples", "4"}).rgba, usual.rgba);
    EXPECT_NE(picture({kCrossing, "--samples", "1"}).rgba, usual.rgba);
}

TEST_F(RenderViewTest, BackendsAreListed) {
    const Result words = run_program({"render", "--list-backends"});
    EXPECT_EQ(words.status, 0) << words.err;
    EXPECT_EQ(words.err, "");
    EXPECT_NE(words.out.find("osmesa: "), std::string::npos);
    EXPECT_NE(words.out.find("egl: "), std::string::npos);
    EXPECT_NE(words.out.find("OpenGL "), std::string::npos);
    const Result report = run_program({"render", "--list-backends", "--json"});
    EXPECT_EQ(report.status, 0);
    EXPECT_NE(report.out.find("\"works\": true"), std::string::npos) << report.out;
    ::setenv("MESA_GL_VERSION_OVERRIDE", "2.1", 1);
    const Result none = run_program({"render", "--list-backends"});
    ::unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(none.status, 3);
    EXPECT_NE(none.out.find("osmesa: not here: "), std::string::npos) << none.out;
    EXPECT_TRUE(is_one_line(none.err)) << none.err;
}

TEST_F(RenderViewTest, ACaseIsDrawnAsItSays) {
    const std::string text =
        R"({"mobbscope_case": 1, "scene": ")" + kCrossing +
        R"(", "size": "320x240", "samples": 1, "background": "transparent", "view": {"levels": 1}})";
    const std::string file = folder.write("a.case.json", text);
    const std::string out = folder.path() / "a.png";
    const Result run = run_program({"render", file, "-o", out});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(read_png(out).rgba,
              picture({kCrossing, "--level", "1", "--samples", "1", "--background", "transparent"}).rgba);
    std::filesystem::remove(out);
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--size", "100x100"},
                                                 {"--no-labels"},
                                                 {"--tree", "umobb"},
                                                 {"--play"},
                                                 {"--ids", "i.png"}}) {
        std::vector<std::string> all{"render", file, "-o", out};
        all.insert(all.end(), more.begin(), more.end());
        expect_refused(run_program(all), 2, "a case says by itself");
    }
    expect_refused(run_program({"render", file}), 2, "--output");
    expect_refused(render_small({"--batch", folder.write("list", file + " -o " + out)}), 2, "list:1: ");
    const std::string skipped = folder.write("b.case.json", R"({"mobbscope_case": 1, "skip": "later"})");
    expect_refused(run_program({"render", skipped, "-o", out}), 2, "later");
    EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
}  // namespace mobbscope
