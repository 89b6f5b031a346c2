// Bodies and floors of scenes: read, written, refused, and asked as their disks are.
#include "scene_refusal.h"

#include <import/import.h>
#include <mobb/capture.h>
#include <scene/answer.h>
#include <scene/clip_import.h>
#include <scene/fitted_scene.h>
#include <scene/scene_edits.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

const std::string kCar =
    R"({"dt": 1, "motion": "linear", "body": [[1, 0, 0.5], [-1, 0, 0.5]], "samples": [[0,0,2],[5,0,2],[5,5,2]]})";

std::string two_cars(const std::string& rest_of_a, const std::string& rest_of_b) {
    return R"({"clips": {"car": )" + kCar + R"(}, "agents": [{"name": "A", "clip": "car")" + rest_of_a +
           R"(}, {"name": "B", "clip": "car")" + rest_of_b + "}]}";
}

TEST(ClipBody, DisksStandAlongTheHeading) {
    const Scene scene = parse_scene(two_cars("", ""), "s.json", "");
    const SceneClip& clip = scene.clips[0];
    ASSERT_EQ(clip.members.size(), 2u);
    const auto at = [&](std::size_t member, std::size_t sample) { return clip.members[member]->samples()[sample]; };
    EXPECT_NEAR(at(0, 0).x, 1, 1e-12);
    EXPECT_NEAR(at(1, 0).x, -1, 1e-12);
    EXPECT_NEAR(at(0, 2).y, 6, 1e-12) << "north at the end";
    EXPECT_EQ(at(0, 1).r, 0.5);
    EXPECT_EQ(clip.members[0]->motion(), mobb::Motion::linear);
    EXPECT_EQ(placed_agents(scene).size(), 2u) << "one agent, however many disks";
}

TEST(ClipBody, StaysWhenWritten) {
    const TempFolder folder;
    folder.write("walk.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n2,2,0,1\n");
    const std::string text =
        R"({"clips": {"car": )" + kCar +
        R"(, "turned": {"dt": 0.5, "body": [[0.3, -0.1, 0.2]], "headings": [10, 400.25], "samples": [[0,0,1],[0,0,1]]},
            "read": {"source": "walk.csv", "body": [[0.1, 0, 0.2], [0, 0.1, 0.3]]}},
            "agents": [{"name": "A", "clip": "car", "floor": 2}, {"name": "B", "clip": "turned", "floor": "2 b"}]})";
    const Scene scene = parse_scene(text, "s.json", folder.path());
    EXPECT_EQ(scene.agents[0].floor, "2");
    EXPECT_EQ(scene.agents[1].floor, "2 b");
    for (const bool inside : {false, true}) {
        const Scene again = parse_scene(to_json(scene, inside), "s.json", folder.path());
        EXPECT_EQ(again.agents, scene.agents);
        for (std::size_t i = 0; i < scene.clips.size(); ++i) {
            EXPECT_EQ(again.clips[i].body, scene.clips[i].body);
            EXPECT_EQ(again.clips[i].headings, scene.clips[i].headings);
            ASSERT_EQ(again.clips[i].members.size(), scene.clips[i].body.size());
            for (std::size_t m = 0; m < again.clips[i].members.size(); ++m)
                EXPECT_EQ(mobb::digest(*again.clips[i].members[m]), mobb::digest(*scene.clips[i].members[m]));
        }
    }
    ImportOptions radius;
    radius.radius = 0.4;
    EXPECT_TRUE(parse_scene(text, "s.json", folder.path(), radius).clips[2].body.empty())
        << "a radius that is asked for is everyone's";
}

TEST(ClipBody, OfAPartLooksAsTheWholeSaysOfEverySource) {
    const TempFolder folder;
    // North for 0.5 s, then standing.
    std::string alone = "t,x,y\n", ids = "id,t,x,y\n", motion;
    for (int i = 0; i <= 60; ++i) {
        const double t = i / 30.0, way = std::min(t, 0.5);
        const std::string row = format_double(t) + ",0," + format_double(way) + '\n';
        alone += row;
        ids += "1," + row;
        motion += "0 1 " + format_double(-way) + " 0 0 0\n";
    }
    folder.write("alone.csv", alone);
    folder.write("ids.csv", ids);
    folder.write("walk.bvh",
                 "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition "
                 "Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 0.5 0.2\n}\n}\nMOTION\nFrames: 61\n"
                 "Frame Time: 0.0333333333333\n" +
                     motion);
    for (const std::string source : {"alone.csv", "ids.csv", "walk.bvh"}) {
        const std::string clip = R"("source": ")" + source + R"(", "body": [[1, 0, 0.5], [-1, 0, 0.25]], "trim": )";
        const auto front_of = [&](const std::string& trim) {
            const Scene scene = parse_scene(R"({"clips": {"c": {)" + clip + trim + "}}}", "s.json", folder.path());
            const mobb::Disk disk = scene.clips[0].members.at(0)->samples().back();
            return glm::dvec2(disk.x, disk.y);
        };
        EXPECT_NEAR(front_of("[1, 2]").x, 0, 1e-6) << source;
        EXPECT_NEAR(front_of("[1, 2]").y, 1.5, 1e-6) << source;
        EXPECT_NEAR(front_of("[0, 2]").y, 1.5, 1e-6) << source;
        EXPECT_NEAR(front_of(R"([1, 2], "origin": "start")").y, 1, 1e-6) << source;
    }
}

TEST(ClipBody, TheSameBackwardsReversesWithoutFolding) {
    const Scene scene = parse_scene(R"({"clips": {"c": {"dt": 1, "motion": "linear", "body": [[5, 0, 1], [-5, 0, 1]],
        "samples": [[0,0,6],[2,0,6],[0,0,6]]}}})",
                                    "s.json", "");
    for (const mobb::Disk& disk : scene.clips[0].members[0]->samples()) EXPECT_GT(disk.x, 4);
    for (const mobb::Disk& disk : scene.clips[0].members[1]->samples()) EXPECT_LT(disk.x, -2);
}

TEST(ClipBody, WhoseHeadingNobodyTellsIsWarnedOf) {
    const auto warnings = [](const std::string& rest) {
        return parse_scene(R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[0,0,1]])" + rest + "}}}", "s.json", "")
            .clips[0]
            .facts.warnings;
    };
    ASSERT_EQ(warnings(R"(, "body": [[0.5, 0, 1], [-0.5, 0, 1]])").size(), 1u);
    EXPECT_NE(warnings(R"(, "body": [[0.5, 0, 1]])").front().text.find("it lies along x; give"), std::string::npos);
    EXPECT_TRUE(warnings("").empty());
    EXPECT_TRUE(warnings(R"(, "body": [[0, 0, 1]])").empty()) << "it looks the same from all sides";
    EXPECT_TRUE(warnings(R"(, "body": [[0.5, 0, 1]], "headings": [90, 90])").empty());
}

TEST(ClipBody, ARadiusThatIsAskedForIsThatOfSamplesToo) {
    ImportOptions radius;
    radius.radius = 0.25;
    const std::string text = R"({"clips": {"car": )" + kCar + R"(, "walk": {"dt": 1, "samples": [[0,0,1],[1,0,1]]}}})";
    const Scene scene = parse_scene(text, "s.json", "", radius);
    for (const SceneClip& clip : scene.clips) {
        EXPECT_TRUE(clip.body.empty() && clip.members.empty());
        for (const mobb::Disk& disk : clip.clip->samples()) EXPECT_EQ(disk.r, 0.25);
    }
    EXPECT_EQ(scene.clips[0].clip->motion(), mobb::Motion::linear);
    radius.radius = RadiusColumn{"width"};
    EXPECT_NE(
        input_error([&] { parse_scene(text, "s.json", "", radius); }).find("/clips/car: radius 'width' names a column"),
        std::string::npos);
}

TEST(ClipBody, IsRefusedInOneLine) {
    const auto clip = [](const std::string& rest) {
        return scene_refusal("{\"clips\": {\n\"c\": {\"dt\": 1, \"samples\": [[0,0,1],[1,0,1]]" + rest + "}}}");
    };
    std::string many = R"(, "body": [[0,0,1])";
    for (int i = 0; i < 64; ++i) many += ",[0,0,1]";
    const std::pair<std::string, std::string> cases[] = {
        {clip(R"(, "body": [])"), "s.json: line 2, /clips/c/body: a body has from 1 to 64 disks"},
        {clip(many + "]"), "/clips/c/body: a body has from 1 to 64 disks"},
        {clip(R"(, "body": [[0, 1]])"), "/clips/c/body/0: has 2 elements; give [forward, left, r] in metres"},
        {clip(R"(, "body": [[0, 1, -1]])"), "/clips/c/body/0/2: -1 is out of range"},
        {clip(R"(, "body": 3)"), "/clips/c/body: expected an array, found a number"},
        {clip(R"(, "bodi": 3)"), "the nearest known key is 'body'"},
        {clip(R"(, "body": [[0,1,1]], "headings": [1])"),
         "/clips/c/headings: has 1 elements; give degrees, one a sample"},
        {clip(R"(, "headings": [1, 2])"), "they are those of a body; give a body, or remove them"},
        {scene_refusal(two_cars(R"(, "floor": "")", "")), "/agents/0/floor: a floor has a name or a number"},
        {scene_refusal(two_cars(R"(, "flor": 1)", "")), "the nearest known key is 'floor'"},
        {scene_refusal(two_cars(R"(, "floor": true)", "")), "expected a string, found true"},
    };
    for (const auto& [is, wanted] : cases) EXPECT_NE(is.find(wanted), std::string::npos) << is << "\n" << wanted;
    std::string asked = two_cars(R"(, "floor": 1)", R"(, "floor": 2)");
    asked.back() = ',';
    EXPECT_NE(scene_refusal(asked + R"("queries": [{"a": "A", "b": "B"}]})").find("they never meet; remove the query"),
              std::string::npos);
}

TEST(ClipBody, IsNotPlayedByARun) {
    const std::string text = R"({"clips": {"car": )" + kCar + R"(}, "graph": {"hubs": [{"name": "h"}],
        "moves": [{"clip": "car", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [5, 5, 0]}]}})";
    EXPECT_NE(scene_refusal(text).find("its clips have no body; remove the body"), std::string::npos)
        << scene_refusal(text);
}

/// Agents with bodies and without, placed at random.
Scene random_bodies(std::mt19937_64& random) {
    const auto real = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Scene scene;
    for (int c = 0; c < 4; ++c) {
        std::vector<mobb::Disk> samples;
        double x = 0, y = 0;
        for (int i = 0; i < 20; ++i) samples.push_back({x += real(-0.5, 1), y += real(-0.5, 0.5), 0.2});
        const mobb::Motion motion = c % 2 == 0 ? mobb::Motion::held : mobb::Motion::linear;
        SceneClip clip{"c" + std::to_string(c), {}, {}, std::make_shared<mobb::Clip>(real(0.1, 0.3), samples, motion)};
        for (int disk = 0; disk < c; ++disk) clip.body.push_back({real(-1, 1), real(-1, 1), real(0, 0.4)});
        make_members(clip);
        scene.clips.push_back(std::move(clip));
    }
    for (int a = 0; a < 8; ++a) {
        scene.agents.push_back(
            {"a" + std::to_string(a), a % 4, {{real(-4, 4), real(-4, 4)}, real(0, 360), real(0, 2)}, {}});
        if (a % 3 > 0) scene.agents.back().floor = std::to_string(a % 3);
    }
    return scene;
}

TEST(ClipBody, IsAskedAsItsDisksAreTheEarliestFirst) {
    std::mt19937_64 random(3);
    int hits = 0, misses = 0;
    for (int round = 0; round < 40; ++round) {
        const Scene scene = random_bodies(random);
        const FittedScene fitted(scene, {});
        std::set<std::pair<int, int>> asked;
        for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
            const SceneQuery query = fitted.queries()[i];
            asked.insert({query.a.agent, query.b.agent});
            const auto disks = [&](const PlacedAgent& who) {
                const SceneClip& clip = scene.clips[static_cast<std::size_t>(who.clip)];
                std::vector<mobb::PlacedClip> out;
                for (const auto& member : clip.members) out.emplace_back(*member, who.placement);
                if (out.empty()) out.emplace_back(*clip.clip, who.placement);
                return out;
            };
            std::optional<mobb::Contact> earliest;
            for (const mobb::PlacedClip& a : disks(query.a)) {
                for (const mobb::PlacedClip& b : disks(query.b)) {
                    const auto contact = mobb::direct_search(a, b);
                    if (contact && (!earliest || contact->time < earliest->time)) earliest = contact;
                }
            }
            for (const Search search : {Search::trees, Search::direct})
                EXPECT_EQ(answer(fitted, query, {search}).contact, earliest) << query.a.name << ' ' << query.b.name;
            EXPECT_EQ(fitted.recorded(i)->contact, earliest);
            ++(earliest ? hits : misses);
        }
        for (int a = 0; a < 8; ++a) {
            for (int b = a + 1; b < 8; ++b) {
                const bool apart = a % 3 > 0 && b % 3 > 0 && a % 3 != b % 3;
                EXPECT_NE(asked.contains({a, b}), apart);
                const AskedPairs pairs(scene);
                const auto index = pairs.index_of(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
                EXPECT_EQ(index.has_value(), !apart);
                if (!index) continue;
                EXPECT_EQ(pairs[*index], (std::pair<std::size_t, std::size_t>(a, b)));
                EXPECT_EQ(query_at(scene, *index).b.agent, b);
            }
        }
        EXPECT_EQ(asked.size(), query_count(scene));
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(misses, 50);
}

TEST(ClipBody, FollowsEdits) {
    Scene scene = parse_scene(two_cars(R"(, "floor": 1)", R"(, "floor": 2)"), "s.json", "");
    EXPECT_EQ(query_count(scene), 0u) << "they are on different floors";
    EXPECT_THROW(add_query(scene, 0, 1), std::invalid_argument);
    Scene held = scene;
    replace_clips(held, {with_motion(held, 0, mobb::Motion::held)});
    EXPECT_EQ(held.clips[0].members[1]->motion(), mobb::Motion::held);
    merge(scene, held);
    ASSERT_EQ(scene.clips.size(), 2u);
    EXPECT_EQ(scene.clips[1].members.size(), 2u);
    EXPECT_EQ(query_count(scene), 2u) << "two on each floor";
    EXPECT_EQ(query_at(scene, 0).b.agent, 2);
    remove_agent(scene, 0);
    EXPECT_EQ(query_count(scene), 1u);
}

}  // namespace
}  // namespace mobbscope
