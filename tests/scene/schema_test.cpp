// assets/scene.schema.json and the reader know the same keys.
#include <scene/scene.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mobbscope {
namespace {

const nlohmann::json& schema() {
    static const nlohmann::json value =
        nlohmann::json::parse(testing::slurp(std::filesystem::path(MOBBSCOPE_SOURCE_DIR) / "assets/scene.schema.json"));
    return value;
}

/// A scene with `object` at the place that a definition of the schema describes.
std::string scene_with(const std::string& definition, const nlohmann::json& object) {
    nlohmann::json scene = {{"clips", {{"c", {{"dt", 1}, {"samples", {{0, 0, 1}}}}}}}};
    const nlohmann::json placed = {{"clip", "c"}};
    if (definition == "") scene.update(object);
    if (definition == "imported" || definition == "inline") scene["clips"]["c"] = object;
    if (definition == "agent") scene["agents"] = {object};
    if (definition == "fit") scene["fit"] = object;
    if (definition == "view") scene["view"] = object;
    if (definition == "camera") scene["view"] = {{"camera", object}};
    if (definition == "query") scene["queries"] = {object};
    if (definition == "participant") scene["queries"] = {{{"a", object}, {"b", placed}}};
    if (definition == "expect") scene["queries"] = {{{"a", placed}, {"b", placed}, {"expect", object}}};
    if (definition == "contact") {
        scene["queries"] = {{{"a", placed}, {"b", placed}, {"expect", {{"collides", true}, {"contact", object}}}}};
    }
    if (definition == "event") scene["queries"] = {{{"a", placed}, {"b", placed}, {"trace", {object}}}};
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

TEST(Schema, EveryKeyOfTheSchemaIsKnownAndNoOther) {
    for (const std::string definition : {"", "imported", "inline", "agent", "fit", "query", "participant", "expect",
                                         "contact", "event", "view", "camera"}) {
        const nlohmann::json known = properties(definition);
        ASSERT_FALSE(known.empty()) << definition;
        for (const auto& [key, unused] : known.items()) {
            // A value of no type: whatever is complained about, it is not the key.
            nlohmann::json object = {{key, nlohmann::json::array({nullptr})}};
            if (definition == "imported") object["source"] = "none.csv";
            const std::string message =
                testing::input_error([&] { parse_scene(scene_with(definition, object), "s.json", ""); });
            EXPECT_EQ(message.find("unknown key"), std::string::npos) << definition << ": " << message;
        }
        nlohmann::json object = {{"unheard_of", 1}};
        if (definition == "imported") object["source"] = "none.csv";
        const std::string message =
            testing::input_error([&] { parse_scene(scene_with(definition, object), "s.json", ""); });
        // The nearest key that the reader names must stand in the schema: so both lists are the same in kind.
        EXPECT_NE(message.find("unknown key 'unheard_of'"), std::string::npos) << definition << ": " << message;
    }
}

}  // namespace
}  // namespace mobbscope
