#include <render/drawlist/draw_list_json.h>
#include <render/pictures/build_draw_list.h>

#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"
#include "support/json_keys.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using nlohmann::json;

/// Levels or a query, both with a time cursor: disks, boxes of nodes and others, lines of all kinds.
DrawList levels() {
    ViewState view;
    view.levels = {0, 3, false};
    view.time = 1;
    return build_draw_list(testing::hit_scene(), view, kGoldenSize);
}

DrawList query() {
    ViewState view;
    view.query = 0;
    view.time = 1;  // at the last step the hit is ringed
    return build_draw_list(testing::hit_scene(mobb::TreeKind::umobb), view, kGoldenSize);
}

TEST(DrawListJson, SaysAllThatIsDrawn) {
    const DrawList list = levels();
    const json value = json::parse(text_of(list));
    EXPECT_EQ(testing::keys(value),
              (std::set<std::string>{"size", "background", "participants", "camera", "disks", "boxes", "lines",
                                     "headline", "legend", "overlays", "panels", "overlay_lines", "marks", "texts"}));
    EXPECT_EQ(value["size"], json({640, 360}));
    EXPECT_EQ(value["background"], "#14181DFF");
    EXPECT_EQ(value["participants"], json({"A", "B"}));
    EXPECT_EQ(value["disks"].size(), list.disks.size());
    EXPECT_EQ(value["boxes"].size(), list.boxes.size());
    EXPECT_EQ(value["lines"].size(), list.lines.size());
    EXPECT_EQ(value["legend"].size(), list.legend.size());
    EXPECT_EQ(value["panels"].size(), list.panels.size());
    EXPECT_EQ(value["overlay_lines"].size(), list.overlay_lines.size());
    EXPECT_EQ(value["marks"].size(), list.marks.size());
    EXPECT_EQ(value["texts"].size(), list.texts.size());
    EXPECT_EQ(value["headline"], list.headline);
    EXPECT_NEAR(value["camera"]["eye"][2].get<double>(), list.projection.eye.z, 1e-4);
    EXPECT_NEAR(value["camera"]["clip_from_world"][4].get<double>(), list.projection.clip_from_world[1][0], 1e-4);

    const json& disk = value["disks"][61];
    EXPECT_EQ(disk["participant"], 1);
    EXPECT_EQ(disk["sample"], 1);
    EXPECT_NEAR(disk["radius"].get<double>(), 0.4, 1e-6);
    EXPECT_NEAR(disk["base"][1].get<double>(), list.disks[61].base.y, 1e-5);
    EXPECT_EQ(disk["on_screen"], true);
    EXPECT_FALSE(disk.contains("pixels"));

    const json& box = value["boxes"][0];
    EXPECT_EQ(box["node"], 0);
    EXPECT_EQ(box["level"], 0);
    EXPECT_EQ(box["state"], "level");
    EXPECT_EQ(box["extents"].size(), 3u);
    const json& sheet = value["boxes"].back();
    EXPECT_EQ(sheet["id"], 0);
    EXPECT_EQ(sheet["state"], "annotation");
    EXPECT_TRUE(sheet["node"].is_null());
}

TEST(DrawListJson, NumbersAreShort) {
    DrawList list = levels();
    list.disks.edit()[0].base = {1.0f / 3, -1e-9f, 123456.7f};
    list.disks.edit()[0].radius = std::numeric_limits<float>::infinity();
    const std::string text = text_of(list);
    EXPECT_NE(text.find("\"base\": [0.333333, 0, 123457], \"radius\": null"), std::string::npos);
    EXPECT_EQ(text.find("-0,"), std::string::npos);
    EXPECT_FALSE(std::regex_search(text, std::regex("[0-9]\\.[0-9]{7}")));
}

TEST(DrawListJson, ADiskThatLeansSaysWhereItEnds) {
    const DrawList list = build_draw_list({testing::running_scene({{}}), {}}, {}, kGoldenSize);
    const json disks = json::parse(text_of(list))["disks"];
    for (std::size_t i = 0; i + 1 < disks.size(); ++i) {
        EXPECT_EQ(disks[i]["top"], disks[i + 1]["base"]) << i;
        EXPECT_EQ(disks[i]["top_radius"], disks[i + 1]["radius"]) << i;
    }
    EXPECT_FALSE(json::parse(text_of(levels()))["disks"][0].contains("top"));
}

TEST(DrawListJson, IdsCountFromOneByParticipantKindAndIndex) {
    const json value = json::parse(text_of(levels()));
    // All disks of A, its boxes, then those of B.
    std::vector<int> ids;
    for (const json& disk : value["disks"]) ids.push_back(disk["id"]);
    EXPECT_EQ(ids.front(), 1);
    EXPECT_EQ(ids[59], 60);
    const json& boxes = value["boxes"];
    const auto of_a =
        std::count_if(boxes.begin(), boxes.end(), [](const json& box) { return box["participant"] == 0; });
    EXPECT_EQ(boxes[0]["id"], 61);
    EXPECT_EQ(ids[60], 61 + of_a);
    for (const json& box : boxes) {
        if (!box["node"].is_null()) ids.push_back(box["id"]);
    }
    std::sort(ids.begin(), ids.end());
    for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], static_cast<int>(i) + 1);
}

TEST(DrawListJson, TheOrderOfTheListDoesNotShow) {
    for (DrawList list : {levels(), query()}) {
        const std::string text = text_of(list);
        std::mt19937 random(7);
        for (int round = 0; round < 5; ++round) {
            std::shuffle(list.disks.edit().begin(), list.disks.edit().end(), random);
            std::shuffle(list.boxes.begin(), list.boxes.end(), random);
            std::shuffle(list.lines.begin(), list.lines.end(), random);
            ASSERT_EQ(text_of(list), text);
        }
    }
}

TEST(DrawListJson, SaysWhatIsBesideThePicture) {
    for (const bool perspective : {true, false}) {
        ViewState view;
        view.camera.preset = CameraPreset::free;
        view.camera.perspective = perspective;
        // The camera looks at one end of the paths from close by, so that the other end is elsewhere.
        view.camera.target = glm::dvec3(0, 0, 0);
        view.camera.distance = 1;
        const DrawList list = build_draw_list(testing::hit_scene(), view, kGoldenSize);
        const json value = json::parse(text_of(list));
        int beside = 0;
        for (std::size_t i = 0; i < list.disks.size(); ++i) {
            const DiskInstance& disk = list.disks[i];
            const auto at = list.projection.project(disk.base);
            const bool centre = at && at->x >= 0 && at->y >= 0 && at->x <= 640 && at->y <= 360;
            const bool told = value["disks"][i]["on_screen"];
            EXPECT_TRUE(told || !centre) << i;
            beside += told ? 0 : 1;
        }
        EXPECT_GT(beside, 0);
        EXPECT_LT(beside, 120);
    }
}

class DrawListIdsTest : public testing::OnEachBackend {};

TEST_P(DrawListIdsTest, PixelsAreCountedByObject) {
    const DrawList list = query();
    const IdImage ids = renderer().draw_ids(list);
    const Image picture = id_picture(list, ids);
    std::map<int, int> seen;
    for (int y = 0; y < kGoldenSize.height; ++y) {
        for (int x = 0; x < kGoldenSize.width; ++x) {
            const std::uint8_t* p = picture.at(x, y);
            EXPECT_EQ(p[3], 255);
            ++seen[p[0] * 65536 + p[1] * 256 + p[2]];
        }
    }
    EXPECT_GT(seen.size(), 5u);
    const json value = json::parse(text_of(list, &ids));
    int hidden = 0;
    for (const char* kind : {"disks", "boxes"}) {
        for (const json& object : value[kind]) {
            if (object["id"] == 0) {
                EXPECT_TRUE(object["pixels"].is_null());
                continue;
            }
            EXPECT_EQ(object["pixels"], seen[object["id"]]);
            hidden += object["pixels"] == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(hidden, 0);
    EXPECT_EQ(ids.at(0, 0), std::nullopt);
    EXPECT_EQ(picture.at(0, 0)[2], 0);
}

INSTANTIATE_TEST_SUITE_P(All, DrawListIdsTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(IdPicture, HasRoomForEveryNumber) {
    DrawList list;
    for (int i = 0; i < 70000; ++i) list.disks.edit().emplace_back().id = {0, ObjectId::Kind::disk, i};
    IdImage ids{2, 1, {}};
    for (const ObjectId id : {ObjectId{0, ObjectId::Kind::disk, 69999}, ObjectId{7, ObjectId::Kind::box, 0}}) {
        ids.rg.push_back(id.r());
        ids.rg.push_back(id.g());
    }
    const Image picture = id_picture(list, ids);
    EXPECT_EQ(picture.rgba, (std::vector<std::uint8_t>{1, 0x11, 0x70, 255, 0, 0, 0, 255})) << "a stranger is nothing";
}

}  // namespace
}  // namespace mobbscope
