// What is wrong with a scene is said in one line that names the file, the place and the remedy.
#include "scene_refusal.h"

#include <base/text.h>
#include <scene/scene.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

/// A scene of a clip "c" with two agents "A" and "B", and another clip, with `rest` after it.
std::string with(const std::string& rest) {
    return R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1],[2,0,1]]}, "fine": {"dt": 1e-5, "samples": [[0,0,1]]}},)"
           "\n"
           R"("agents": [{"name": "A", "clip": "c"}, {"name": "B", "clip": "c"}],)"
           "\n" +
           rest + "}";
}

std::string with_clip(const std::string& clip) { return "{\"clips\": {\n\"c\": " + clip + "}}"; }

TEST(SceneErrors, UnknownKeysNameThemselvesTheirLineAndTheNearest) {
    EXPECT_EQ(scene_refusal(with("\"quieries\": []")),
              "s.json: line 3, /quieries: unknown key 'quieries'; the nearest known key is 'queries'");
    EXPECT_NE(scene_refusal(with("\"fit\": {\"tre\": 1}"))
                  .find("/fit/tre: unknown key 'tre'; the nearest known key is 'tree'"),
              std::string::npos);
    EXPECT_NE(scene_refusal(with("\"view\": {\"camera\": {\"yaw\": 1}}")).find("'yaw_deg'"), std::string::npos);
    EXPECT_NE(scene_refusal("{\"clips\": {}, \"\": 1}").find("unknown key ''"), std::string::npos);
}

TEST(SceneErrors, ClipsAreChecked) {
    const std::pair<const char*, const char*> cases[] = {
        {"{\"samples\": [[0,0,1]],\n\"dt\": 0}", "line 3, /clips/c/dt: dt must be"},
        {R"({"dt": 1e12, "samples": [[0,0,1],[0,0,1]]})", "/clips/c/dt: the clip lasts longer"},
        {R"({"dt": -1, "samples": [[0,0,1]]})", "dt must be"},
        {R"({"dt": 1e-310, "samples": [[0,0,1]]})", "line 2, /clips/c/dt: dt must be a finite number over 2e-9 s"},
        {"{\"dt\": 1,\n\"samples\": []}", "line 3, /clips/c/samples: a clip needs at least one sample"},
        {R"({"dt": 1, "samples": [[0,0,-1]]})", "/clips/c/samples/0/2: -1 is out of range"},
        {R"({"dt": 1, "samples": [[0,0,1],[1e10,0,1]]})", "/clips/c/samples/1/0: 1e+10 is out of range"},
        {R"({"dt": 1, "samples": [[0,0]]})", "/clips/c/samples/0: has 2 elements; give [x, y, r]"},
        {R"({"dt": 1, "samples": [[0,0,"1"]]})", "expected a number, found a string"},
        {R"({"dt": 1, "samples": 3})", "expected an array, found a number"},
        {R"({"dt": 1})", "a clip needs a source, or dt and samples"},
        {R"({"samples": [[0,0,1]]})", "the key 'dt' is missing"},
        {R"({"dt": 1, "samples": [[0,0,1]], "fps": 30})", "/clips/c/fps: an import key is for a clip with a source"},
        {R"({"source": "x.csv", "samples": []})", "a source or samples, not both"},
        {R"({"source": ""})", "the source is empty"},
        {"{\"source\": \"x.csv\",\n\"fps\": -3}", "line 3, /clips/c/fps: fps must be over 0"},
        {R"({"source": "x.csv", "unit": "ell"})", "/clips/c/unit: unit must be"},
        {R"({"source": "x.csv", "trim": [2, 1]})", "/clips/c/trim: trim must be"},
        {R"({"source": "x.csv", "radius": -1, "fps": 30})", "/clips/c/radius: radius must be"},
        {R"({"source": "x.csv", "dt": 1e13})", "/clips/c/dt: dt must be over 2e-09 seconds"},
        {R"({"source": "x.csv", "id": 1.5})", "/clips/c/id: 1.5 is not exact as a number; write the id as a string"},
        {R"({"source": "x.csv", "id": 9007199254740992})", "write the id as a string"},
        {R"({"source": "x.csv", "up": "z"})", "/clips/c/up: up does not apply to .csv files; leave it out"},
        {R"({"source": "x.csv", "unit": "auto"})", "/clips/c/unit: unit auto does not apply"},
        {R"({"source": "x\u0000.csv"})", "/clips/c/source: the source holds a NUL byte"},
        {R"({"sourec": "walk.csv"})", "/clips/c/sourec: unknown key 'sourec'; the nearest known key is 'source'"},
        {R"({"sorce": "walk.csv", "fps": 30})", "unknown key 'sorce'; the nearest known key is 'source'"},
        {R"({"dt": 1, "sampels": [[0,0,1]]})", "unknown key 'sampels'; the nearest known key is 'samples'"},
        {R"({"fps": 30})", "a clip needs a source, or dt and samples"},
        {R"({"source": "x.csv", "trim": [1]})", "give [A, B]"},
        {R"({"source": "x.csv", "origin": "here"})", "give keep, start or start_heading"},
        {R"({"source": "none.csv"})", "/clips/c/source: none.csv: no such file"},
        {R"({"source": "s.json"})", "s.json: no reader for this kind of file"},
        {"[]", "expected an object, found an array"},
        {"null", "expected an object, found null"},
    };
    for (const auto& [clip, message] : cases) {
        EXPECT_NE(scene_refusal(with_clip(clip)).find(message), std::string::npos)
            << clip << " gave " << scene_refusal(with_clip(clip));
    }
    EXPECT_NE(scene_refusal("{}").find("the key 'clips' is missing"), std::string::npos);
    EXPECT_NE(scene_refusal("{\"clips\": {}}").find("there is no clip"), std::string::npos);
    EXPECT_NE(scene_refusal("[]").find("looks like JSON, a list"), std::string::npos);
    EXPECT_NE(scene_refusal("{\"clips\": {\"\": {}}}").find("needs a name"), std::string::npos);
}

TEST(SceneErrors, GraphsAreChecked) {
    const std::string move = R"({"clip": "c", "from": 0, "to": 1, "entry": [0, 0, 0], "exit": [1, 0, 0]})";
    const auto graph = [](const std::string& hubs, const std::string& moves, const std::string& rest = "") {
        return with("\"graph\": {\"hubs\": " + hubs + ",\n\"moves\": [" + moves + "]" + rest + "}");
    };
    const std::string hubs = R"([{"name": "h"}, {"name": "g"}])";
    const std::string of_rig = R"({"clip": "c", "from": 0, "to": 1, "entry": [0, 0, 0], "exit": [1, 0, 0], "rig": 1})";
    EXPECT_NO_THROW(parse_scene(graph(hubs, move), "s.json", ""));
    EXPECT_NO_THROW(
        parse_scene(graph(hubs, of_rig, R"(, "rigs": [{"joints": ["a"]}, {"joints": ["a", "b"]}])"), "s.json", ""));
    EXPECT_NO_THROW(parse_scene(graph(hubs, move, ", \"bounds\": {\"pose_distance\": null}"), "s.json", ""));
    const std::pair<std::string, const char*> cases[] = {
        {graph("[]", move), "line 3, /graph/hubs: there is no hub; add one"},
        {graph(hubs, ""), "line 4, /graph/moves: there is no move; add one"},
        {graph(R"([{"name": ""}])", move), "/graph/hubs/0/name: a hub needs a name"},
        {graph(R"([{"name": "h"}, {"name": "h"}])", move), "/graph/hubs/1/name: another hub is named 'h'"},
        {graph(R"([{"nam": "h"}])", move), "unknown key 'nam'; the nearest known key is 'name'"},
        {graph(hubs, R"({"clip": "d", "from": 0, "to": 1, "entry": [0, 0, 0], "exit": [1, 0, 0]})"),
         "/graph/moves/0/clip: there is no clip 'd'; the nearest is 'c'"},
        {graph(hubs, R"({"clip": "c", "from": 0, "to": 2, "entry": [0, 0, 0], "exit": [1, 0, 0]})"),
         "/graph/moves/0/to: 2 is out of range"},
        {graph(hubs, R"({"clip": "c", "from": -1, "to": 0, "entry": [0, 0, 0], "exit": [1, 0, 0]})"),
         "/graph/moves/0/from: -1 is out of range"},
        {graph(hubs, R"({"clip": "c", "from": 0, "to": 1, "entry": [0, 0], "exit": [1, 0, 0]})"),
         "/graph/moves/0/entry: has 2 elements; give [x, y, heading in degrees]"},
        {graph(hubs, R"({"clip": "c", "from": 0, "to": 1, "entry": [0, 0, 0], "exit": [1e10, 0, 0]})"),
         "/graph/moves/0/exit/0: 1e+10 is out of range"},
        {graph(hubs, R"({"clip": "c", "from": 0, "to": 1, "entry": [0, 0, 0]})"), "the key 'exit' is missing"},
        {graph(hubs, move, R"(, "bounds": {"pose_distance": -1})"), "/graph/bounds/pose_distance: -1 is out of range"},
        {graph(hubs, move, R"(, "bounds": {"root_speed": "x"})"), "/graph/bounds/root_speed: expected a number"},
        {graph(hubs, move, R"(, "hub": 1)"), "unknown key 'hub'; the nearest known key is 'hubs'"},
        {graph(hubs, move, R"(, "rigs": [{"joints": []}])"), "/graph/rigs/0/joints: there is no joint; name those"},
        {graph(hubs, move, R"(, "rigs": [{"joints": ["a", "a"]}])"), "joints/1: the joint 'a' is given twice"},
        {graph(hubs, move, R"(, "rigs": [{"joints": [1]}])"), "/graph/rigs/0/joints/0: expected a string"},
        {graph(hubs, move, R"(, "rigs": [{}])"), "/graph/rigs/0: the key 'joints' is missing"},
        {graph(hubs, of_rig, R"(, "rigs": [{"joints": ["a"]}])"), "/graph/moves/0/rig: 1 is out of range"},
        {graph(hubs, of_rig), "/graph/moves/0/rig: the graph lists no rigs; add \"rigs\", or leave this out"},
        {with("\"graph\": []"), "/graph: expected an object, found an array"},
    };
    for (const auto& [scene, message] : cases) {
        EXPECT_NE(scene_refusal(scene).find(message), std::string::npos) << scene << " gave " << scene_refusal(scene);
    }
}

TEST(SceneErrors, EverythingElseIsChecked) {
    const std::pair<const char*, std::string> cases[] = {
        {R"("mobbscope": 2)", "/mobbscope: the file has version 2; this program reads version 1"},
        {R"("mobbscope": "1")", "expected a number"},
        {R"("$schema": 1)", "expected a string"},
        {R"("fit": {"tree": "oak"})", "'oak' is not a tree; give one of " + listed(mobb::tree_kind_names())},
        {R"("fit": {"tree": "brute"})", "is not a tree"},
        {R"("fit": {"tree": "production"})", "/fit/tree: `production` is called `blocks`"},
        {R"("fit": {"tree": "productoin"})", "'productoin' is not a tree"},
        {R"("fit": {"leaf": 0})", "/fit/leaf: 0 is out of range"},
        {R"("fit": {"leaf": 2.5})", "whole number"},
        {R"("fit": {"leaf": 1e30})", "out of range"},
        {R"("fit": {"levels": -1})", "out of range"},
        {R"("fit": {"axes": "mine"})", "is not a choice of axes; give one of endpoints"},
        {R"("fit": {"time_scale": 0})", "out of range"},
        {R"("queries": [{"a": "A"}])", "/queries/0: the key 'b' is missing"},
        {R"("queries": [{"a": "A", "b": "BB"}])", "there is no agent 'BB'; the nearest is 'B'"},
        {R"("queries": [{"a": "A", "b": {"clip": "d"}}])",
         "/queries/0/b/clip: there is no clip 'd'; the nearest is 'c'"},
        {R"("queries": [{"a": "A", "b": {"clip": "c", "name": "B"}}])", "unknown key 'name'"},
        {R"("queries": [{"a": "A", "b": {"clip": "c", "start": 1e13}}])", "out of range"},
        {R"("queries": [{"a": "A", "b": {"clip": "fine", "start": -1e12}}])",
         "/queries/0/b/start: start -1e+12 s is too far from 0: doubles tell these samples' times apart within "
         "2.25e+10 "
         "s; start nearer to 0, or give a larger dt"},
        {R"("queries": [{"a": "A", "b": {"clip": "c", "translate": [1, 2, 3]}}])", "give [x, y]"},
        {R"("queries": [{"a": "A", "b": 3}])", "expected an object, found a number"},
        {R"("queries": [{"a": "A", "b": "B", "expect": {}}])", "'collides' is missing"},
        {R"("queries": [{"a": "A", "b": "B", "expect": {"collides": 1}}])", "expected true or false"},
        {R"("queries": [{"a": "A", "b": "B", "expect": {"collides": true, "contact": {"time": 0, "a_sample": 3,
            "b_sample": 0, "distance": 0, "radii": 1}}}])",
         "/a_sample: 3 is out of range"},
        {R"("queries": [{"a": "A", "b": "B", "expect": {"collides": false, "contact": {"time": 0, "a_sample": 0,
            "b_sample": 0, "distance": 0, "radii": 1}}}])",
         "no contact without a collision"},
        {R"("view": {"levels": "3:1"})", "/view/levels: '3:1' is not a range of levels"},
        {R"("view": {"levels": 1001})", "levels go from 0 to 1000"},
        {R"("view": {"camera": {"target": [0, 0, 1e10], "distance": 1}})", "out of range"},
        {R"("view": {"step": "soon"})", "is not a step"},
        {R"("view": {"step": -1})", "out of range"},
        {R"("view": {"query": 1})", "/view/query: the scene has 1 queries"},
        {R"("view": {"color_by": "node"})", "give agent, level, volume"},
        {R"("view": {"theme": "blue"})", "give dark or light"},
        {R"("view": {"camera": {"preset": "under"}})", "give iso, top, front, side or free"},
        {R"("view": {"camera": {"pitch_deg": 91}})", "out of range"},
        {R"("view": {"camera": {"target": [0, 0, 0]}})", "'distance' is missing"},
        {R"("view": {"camera": {"distance": 3}})", "needs a target"},
        {R"("view": {"camera": {"shift": [0, 0]}})", "needs a target"},
        {R"("view": {"camera": {"target": [0, 0, 0], "distance": 1, "shift": [0, 1.5]}})", "out of range"},
        {R"("view": {"camera": {"target": [0, 0, 0], "distance": 1, "shift": 1}})", "array"},
        {R"("view": {"camera": {"fov_deg": 0.4}})", "out of range"},
        {R"("view": {"camera": {"fov_deg": 151}})", "out of range"},
        {R"("view": {"disks": 1})", "expected true or false"},
    };
    for (const auto& [rest, message] : cases) {
        EXPECT_NE(scene_refusal(with(rest)).find(message), std::string::npos)
            << rest << " gave " << scene_refusal(with(rest));
    }
}

TEST(SceneErrors, AgentsAreChecked) {
    const auto agents = [](const std::string& list) {
        return scene_refusal("{\"clips\": {\"walk\": {\"dt\": 1, \"samples\": [[0,0,1]]}}, \"agents\": " + list + "}");
    };
    EXPECT_NE(agents(R"([{"clip": "walk"}])").find("/agents/0: the key 'name' is missing"), std::string::npos);
    EXPECT_NE(agents(R"([{"name": "A", "clip": "wakl"}])").find("there is no clip 'wakl'; the nearest is 'walk'"),
              std::string::npos);
    EXPECT_NE(
        agents(R"([{"name": "A", "clip": "walk"}, {"name": "A", "clip": "walk"}])").find("another agent is named 'A'"),
        std::string::npos);
    EXPECT_NE(agents(R"([{"name": "", "clip": "walk"}])").find("needs a name"), std::string::npos);
    for (const char* color : {"red", "#12345", "#GGGGGG", "#1234567", "E69F00"}) {
        const std::string list = R"([{"name": "A", "clip": "walk", "color": ")" + std::string(color) + "\"}]";
        EXPECT_NE(agents(list).find("is not a colour"), std::string::npos) << color;
    }
    EXPECT_NE(agents("{}").find("expected an array"), std::string::npos);
}

TEST(SceneErrors, TracesAreChecked) {
    const auto trace = [](const std::string& events) {
        return scene_refusal(with("\"queries\": [{\"a\": \"A\", \"b\": \"B\", \"trace\": [" + events + "]}]"));
    };
    const std::string first =
        R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap"})";
    const std::pair<std::string, const char*> cases[] = {
        {R"({"step": 1, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap"})",
         "/trace/0/step"},
        {R"({"step": 0, "parent": 0, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap"})",
         "/trace/0/parent"},
        {first + R"(,{"step": 1, "parent": 0, "depth": 2, "a": 0, "b": 0, "test": "time", "outcome": "overlap"})",
         "/trace/1/depth"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 5, "b": 0, "test": "time", "outcome": "overlap"})",
         "/trace/0/a"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "tiem", "outcome": "overlap"})",
         "is not a kind of test; give time, obb2d, "},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "maybe"})",
         "is not an outcome"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "hit"})",
         "cannot end as hit"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "obb2d", "outcome": "separated", "axis": 4,
            "gap": 1})",
         "/trace/0/axis"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "moving", "outcome": "separated", "axis": 4,
            "gap": 1})",
         "/trace/0/axis"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "aabb", "outcome": "separated", "axis": 2,
            "gap": 1})",
         "/trace/0/axis"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "aabb", "outcome": "hit"})",
         "cannot end as hit"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "obb2d", "outcome": "separated", "axis": 1})",
         "'gap' is missing"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "obb2d", "outcome": "overlap", "axis": 1})",
         "only a separation has one"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap", "pairs": [[0,0,0]]})",
         "only a test of samples"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "samples", "outcome": "hit", "pairs": [[0,3,0]]})",
         "/pairs/0/1: 3 is out of range"},
        {R"({"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "samples", "outcome": "hit", "bears": []})",
         "nearest known key is 'pairs'"},
    };
    for (const auto& [events, message] : cases) {
        EXPECT_NE(trace(events).find(message), std::string::npos) << events << " gave " << trace(events);
    }
    const auto counted = [&](const std::string& keys) {
        return scene_refusal(with(R"("queries": [{"a": "A", "b": "B", )" + keys + "}]"));
    };
    EXPECT_NE(counted(R"("events": 3)").find("give the trace"), std::string::npos);
    for (const char* wrong : {"0", "1.5", "-1", "1e17", "\"2\""}) {
        const std::string said = counted(R"("trace": [)" + first + R"(], "events": )" + wrong);
        EXPECT_NE(said.find("/queries/0/events"), std::string::npos) << wrong << " gave " << said;
    }
}

TEST(SceneErrors, AnErrorInsideASourceNamesBothFilesAndBothPlaces) {
    const TempFolder folder;
    folder.write("bad.csv", "t,x,y,r\n0,0,0,0\n1,nan,0,0\n");
    const auto file = folder.write("s.json", "{\"clips\": {\n  \"c\": {\n    \"source\": \"bad.csv\"}}}");
    EXPECT_EQ(input_error([&] { load_scene(file); }),
              file.string() + ": line 3, /clips/c/source: " + (folder.path() / "bad.csv").string() +
                  ": line 3, column 2 (x): 'nan' is not a finite number; write it like 0.25");
}

TEST(SceneErrors, ATracksNumberIsItsDigits) {
    const TempFolder folder;
    folder.write("two.csv", "id,t,x,y,r\n100000,0,7,0,0\n2,0,0,0,0\n100000,1,0,0,0\n2,1,0,0,0\n");
    const auto file = folder.write("s.json", R"({"clips": {"c": {"source": "two.csv", "id": 100000}}})");
    EXPECT_EQ(load_scene(file).clips[0].clip->samples()[0].x, 7);
}

TEST(SceneErrors, WhatIsForOtherFormatsIsRefusedInTheSceneAndPassedOverFromOutside) {
    const TempFolder folder;
    folder.write("a.csv", "t,x,y,r\n0,0,0,0\n1,0.5,0,0\n");
    const auto file = folder.write("s.json", R"({"clips": {"c": {"source": "a.csv"}}})");
    ImportOptions overrides;
    overrides.up = "z";
    overrides.root = "Hips";
    overrides.radius = 0.5;
    const Scene scene = load_scene(file, overrides);
    EXPECT_EQ(scene.clips[0].clip->samples()[0].r, 0.5);
    EXPECT_EQ(scene.clips[0].facts.warnings,
              (std::vector<ImportWarning>{{"root does not apply to .csv files"}, {"up does not apply to .csv files"}}));
    EXPECT_EQ(load_scene(folder.path() / "a.csv", overrides).clips[0].facts.warnings.size(), 2u);
}

TEST(SceneErrors, AFileOfManyTracksNeedsAnId) {
    const TempFolder folder;
    folder.write("two.csv", "id,t,x,y,r\n1,0,0,0,0\n2,0,0,0,0\n1,1,0,0,0\n2,1,0,0,0\n");
    const auto file = folder.write("s.json", R"({"clips": {"c": {"source": "two.csv"}}})");
    EXPECT_NE(input_error([&] { load_scene(file); }).find("has 2 tracks; name one with id, such as '1'"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
