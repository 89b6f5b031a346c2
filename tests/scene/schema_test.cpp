// assets/scene.schema.json and the reader know the same keys.
#include "scene_refusal.h"

#include <base/file.h>
#include <scene/scene.h>
#include <scene/view_options.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace mobbscope {
namespace {

const nlohmann::json& schema() {
    static const nlohmann::json value = nlohmann::json::parse(slurp(kSource / "assets/scene.schema.json"));
    return value;
}

/// A scene with `object` at the place that a definition of the schema describes.
std::string scene_with(const std::string& definition, const nlohmann::json& object) {
    nlohmann::json scene = {{"clips", {{"c", {{"dt", 1}, {"samples", {{0, 0, 1}}}}}}}};
    const nlohmann::json placed = {{"clip", "c"}};
    if (definition == "") scene.update(object);
    if (definition == "imported" || definition == "inline") scene["clips"]["c"] = object;
    if (definition == "agent") scene["agents"] = nlohmann::json::array({object});
    const nlohmann::json move = {{"clip", "c"}, {"from", 0}, {"to", 0}, {"entry", {0, 0, 0}}, {"exit", {0, 0, 0}}};
    nlohmann::json graph = {{"hubs", {{{"name", "h"}}}}, {"moves", {move}}};
    if (definition == "graph") scene["graph"] = object;
    if (definition == "hub") graph["hubs"] = nlohmann::json::array({object});
    if (definition == "bounds") graph["bounds"] = object;
    if (definition == "rig") graph["rigs"] = nlohmann::json::array({object});
    if (definition == "move") graph["moves"] = nlohmann::json::array({object});
    const std::set<std::string> of_graph{"hub", "bounds", "rig", "move"};
    if (of_graph.contains(definition)) scene["graph"] = graph;
    const std::set<std::string> of_crowd{"crowd", "crowd_agent", "play"};
    if (of_crowd.contains(definition)) {
        scene["graph"] = graph;
        nlohmann::json agent = {{"name", "1"}, {"plays", nlohmann::json::array({object})}};
        if (definition == "crowd_agent") agent = object;
        nlohmann::json crowd = {{"area", {9, 9}}, {"seconds", 1}, {"seed", 1}};
        crowd["agents"] = nlohmann::json::array({agent});
        scene["crowd"] = definition == "crowd" ? object : crowd;
    }
    if (definition == "fit") scene["fit"] = object;
    if (definition == "view") scene["view"] = object;
    if (definition == "camera") scene["view"] = {{"camera", object}};
    if (definition == "query") scene["queries"] = nlohmann::json::array({object});
    if (definition == "participant") scene["queries"] = {{{"a", object}, {"b", placed}}};
    if (definition == "expect") scene["queries"] = {{{"a", placed}, {"b", placed}, {"expect", object}}};
    if (definition == "contact") {
        scene["queries"] = {{{"a", placed}, {"b", placed}, {"expect", {{"collides", true}, {"contact", object}}}}};
    }
    if (definition == "event")
        scene["queries"] = {{{"a", placed}, {"b", placed}, {"trace", nlohmann::json::array({object})}}};
    return scene.dump();
}

nlohmann::json properties(const std::string& definition) {
    if (definition == "") return schema()["properties"];
    const nlohmann::json& all = schema()["$defs"];
    if (definition == "camera") return all["view"]["properties"]["camera"]["properties"];
    if (definition == "expect") return all["query"]["properties"]["expect"]["properties"];
    if (definition == "participant") return all["participant"]["oneOf"][1]["properties"];
    return all[definition]["properties"];
}

TEST(Schema, EveryKeyOfTheSchemaIsKnownToTheReader) {
    for (const std::string definition :
         {"",     "imported", "inline", "agent", "fit",    "query", "participant", "expect", "contact",     "event",
          "view", "camera",   "graph",  "hub",   "bounds", "rig",   "move",        "crowd",  "crowd_agent", "play"}) {
        const nlohmann::json known = properties(definition);
        ASSERT_FALSE(known.empty()) << definition;
        for (const auto& [key, unused] : known.items()) {
            // A value of no type: whatever is complained about, it is not the key.
            nlohmann::json object = {{key, nlohmann::json::array({nullptr})}};
            if (definition == "imported") object["source"] = "none.csv";
            const std::string message = scene_refusal(scene_with(definition, object));
            EXPECT_EQ(message.find("unknown key"), std::string::npos) << definition << ": " << message;
        }
        nlohmann::json object = {{"unheard_of", 1}};
        if (definition == "imported") object["source"] = "none.csv";
        const std::string message = scene_refusal(scene_with(definition, object));
        EXPECT_NE(message.find("unknown key 'unheard_of'"), std::string::npos) << definition << ": " << message;
    }
}

/// Holds what stands between `begin`, the first behind `from`, and `end` against what a table makes of it, or writes
/// it.
void hold_part(const std::string& from, const std::string& begin, const std::string& end, const std::string& made) {
    const std::filesystem::path file = kSource / "assets/scene.schema.json";
    std::string text = slurp(file);
    const std::size_t first = text.find(begin, text.find(from)) + begin.size();
    const std::size_t last = text.find(end, first);
    ASSERT_NE(last, std::string::npos) << from;
    if (std::getenv("MOBBSCOPE_UPDATE_SCHEMA"))
        write_file(file, text.replace(first, last - first, made));
    else
        EXPECT_EQ(text.substr(first, last - first), made)
            << "MOBBSCOPE_UPDATE_SCHEMA=1 build/test/bin/test_scene --gtest_filter=Schema.Of* writes it anew";
}

/// The schema of a view is made from the table of view options.
TEST(Schema, OfAViewIsTheTableOfItsOptions) {
    std::string made;
    for (const ViewOption& option : view_options()) {
        made += (made.empty() ? "" : ",\n") + ("        \"" + std::string(option.key)) +
                "\": " + std::string(option.schema);
        const FormerToggle& former = option.former_toggle;
        if (former.key.empty()) continue;
        made += ",\n        \"" + std::string(former.key) + R"(": {"description": "Before there was `)" +
                std::string(option.key) + "`: true is " + std::string(former.on) + ", false is " +
                std::string(former.off) + R"(", "deprecated": true, "type": "boolean"})";
    }
    hold_part("    \"view\": {\n", "\"properties\": {\n", "\n      }\n    }\n  }\n}", made);
}

TEST(Schema, OfKindsOfTreesAndTestsIsTheirTable) {
    const auto names = [](const auto& kinds) {
        std::string out;
        for (const auto kind : kinds) out += (out.empty() ? "\"" : ", \"") + std::string(mobb::name(kind)) + '"';
        return out;
    };
    hold_part("    \"fit\": {\n", "\"tree\": {\"enum\": [", "]}", names(mobb::kTreeKinds));
    hold_part("    \"event\": {\n", "\"test\": {\"enum\": [", "]}", names(mobb::kTestKinds));
}

/// Whether parse_scene takes a scene with this value for a key of its view.
bool view_is_read(const char* key, const std::string& text) {
    const nlohmann::json view = {{key, text}};
    try {
        parse_scene(scene_with("view", view), "s.json", "");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

TEST(Schema, PatternsTakeWhatTheReaderTakes) {
    const std::string texts[] = {
        "",      "0",           "12",          "1:3",     "leaves",  "end",   "40%",    "33.5%",  "+4%",
        "1e1%",  ".5%",         "5.%",         "%",       "-1",      "-1%",   "1.5",    "nan%",   "x",
        "2 ",    "1:",          "0x1",         "all",     "1e-5%",   "hit",   "leaf:3", "leaf:0", "leaf:03",
        "leaf:", "separated:2", "avoidable:3", "overlap", "depth:0", "depth", "end:1",  ":1"};
    for (const char* key : {"levels", "step"}) {
        const std::regex pattern(properties("view")[key]["pattern"].get<std::string>());
        for (const std::string& text : texts) {
            EXPECT_EQ(std::regex_match(text, pattern), view_is_read(key, text)) << key << " '" << text << "'";
        }
    }
    const std::regex unit(properties("imported")["unit"]["pattern"].get<std::string>());
    for (const std::string text : {"m", "cm", "in", "auto", "ell", "", "0.01", "+2", "1e-3", ".5", "1m", "-1", "nan"}) {
        ImportOptions options;
        options.unit = text;
        bool taken = true;
        try {
            check(options);
        } catch (const std::invalid_argument&) {
            taken = false;
        }
        EXPECT_EQ(std::regex_match(text, unit), taken) << text;
    }
}

TEST(Schema, BoundsAreTheReaders) {
    EXPECT_TRUE(properties("view")["levels"]["maximum"] == 1000 && view_is_read("levels", "1000"));
    EXPECT_FALSE(view_is_read("levels", "1001"));
}

/// Every key of every "properties" below `value`.
void collect_properties(const nlohmann::json& value, std::set<std::string>& keys) {
    if (!value.is_structured()) return;
    if (value.is_object() && value.contains("properties")) {
        for (const auto& [key, unused] : value["properties"].items()) keys.insert(key);
    }
    for (const auto& element : value) collect_properties(element, keys);
}

void expect_known(const nlohmann::json& value, const std::set<std::string>& keys) {
    if (!value.is_structured()) return;
    for (const auto& [key, element] : value.items()) {
        if (value.is_object()) {
            EXPECT_TRUE(keys.contains(key)) << key;
        }
        expect_known(element, keys);
    }
}

TEST(Schema, EveryKeyThatIsWrittenIsInTheSchema) {
    const TempFolder folder;
    folder.write("a.csv", "id,t,x,y,r\n1,0,0,0,0\n1,1,0,0,0\n1,5,0,0,0\n");
    Scene scene = parse_scene(R"({"clips": {"root": {"dt": 1, "samples": [[0, 0, 1]]},
        "source": {"source": "a.csv", "id": 1, "fps": 9, "unit": "m", "trim": [0, 3], "origin": "start", "radius": 1, "dt": 1}},
        "graph": {"hubs": [{"name": "h"}], "bounds": {"pose_distance": 0.1, "root_speed": null},
          "rigs": [{"joints": ["root"]}],
          "moves": [{"clip": "root", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [1, 0, 0], "rig": 0}]},
        "agents": [{"name": "A", "clip": "root", "color": "#000000"}],
        "queries": [{"a": "A", "b": {"clip": "root"}, "expect": {"collides": true, "contact":
          {"time": 0, "a_sample": 0, "b_sample": 0, "distance": 0, "radii": 2}}, "trace":
          [{"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "samples", "outcome": "hit", "pairs": [[0, 0, 0]]}]}],
        "view": {"camera": {"preset": "free", "yaw_deg": 1, "pitch_deg": 1, "perspective": false, "fov_deg": 50,
          "target": [0, 0, 0], "distance": 1, "shift": [0, 0.1]}, "levels": 1, "query": 0, "step": 0, "time": 0, "time_height": 1, "color_by": "level", "theme": "light"}})",
                              "s.json", folder.path());
    for (const ViewOption& option : view_options()) {
        if (option.toggle) scene.view.*option.toggle = !(scene.view.*option.toggle);
    }
    std::set<std::string> keys;
    collect_properties(schema(), keys);
    expect_known(nlohmann::json::parse(to_json(scene)), keys);
    const Scene run = parse_scene(R"({"clips": {"root": {"dt": 1, "samples": [[0, 0, 1]]}},
        "graph": {"hubs": [{"name": "h"}],
          "moves": [{"clip": "root", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [1, 0, 0]}]},
        "crowd": {"area": [9, 9], "seconds": 1, "seed": 1, "ahead": 2, "grace": 0, "agents": [{"name": "1", "plays":
          [{"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "chosen_at": -1, "kind": "forced"}]}]}})",
                                  "s.json", "");
    expect_known(nlohmann::json::parse(to_json(run)), keys);
}

}  // namespace
}  // namespace mobbscope
