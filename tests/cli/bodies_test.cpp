// Scenes with bodies of several disks, and with floors, as the commands answer them.
#include "run_program.h"

#include <mobb/body.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// A car of 4.6 x 1.9 m that drives 20 m east within 4 s.
json car() {
    json clip{{"dt", 0.5}, {"motion", "linear"}};
    const auto body = mobb::rectangle_body(4.6, 1.9);
    for (const mobb::BodyDisk& disk : body) clip["body"].push_back({disk.forward, disk.left, disk.r});
    for (int i = 0; i <= 8; ++i) clip["samples"].push_back({2.5 * i, 0, mobb::body_reach(body)});
    return clip;
}

json agent(const std::string& name, double x, double y, double degrees = 0) {
    return {{"name", name}, {"clip", "car"}, {"translate", {x, y}}, {"rotate_deg", degrees}};
}

/// Cars side by side, 2.2 m apart, and one that comes across.
json three_cars() {
    json scene;
    scene["clips"]["car"] = car();
    scene["agents"] = {agent("left", 0, 2.2), agent("right", 0, 0), agent("across", 10, -12, 90)};
    return scene;
}

TEST(BodiesCommand, SideBySideIsNoConflict) {
    const TempFolder folder;
    const std::string file = folder.write("cars.json", three_cars().dump());
    const json found = json_of({"conflicts", file});
    EXPECT_EQ(found["agents"], 3);
    EXPECT_EQ(found["pairs"], 3);
    ASSERT_EQ(found["conflicts"].size(), 2u) << "one for a pair, however many disks touch";
    for (const json& conflict : found["conflicts"]) {
        EXPECT_EQ(conflict["b"], "across");
        EXPECT_EQ(conflict["intervals"].size(), 1u);
    }
    json alone = three_cars();
    alone["clips"]["car"].erase("body");
    EXPECT_EQ(json_of({"conflicts", folder.write("disks.json", alone.dump())})["conflicts"].size(), 3u)
        << "the disks around the cars overlap side by side";
    for (const char* tree : {"brute", "umobb", "blocks"}) {
        json other = json_of({"conflicts", file, "--tree", tree});
        EXPECT_EQ(other["conflicts"], found["conflicts"]) << tree;
    }
    EXPECT_EQ(json_of({"conflicts", file, "--radius", "0.3"})["radius"], 0.3);
}

TEST(BodiesCommand, QueriesAreAnsweredByTheMembersThatMeetFirst) {
    const TempFolder folder;
    const std::string file = folder.write("cars.json", three_cars().dump());
    const json found = json_of({"query", file, "--trace", "--all-contacts"});
    const json conflicts = json_of({"conflicts", file});
    ASSERT_EQ(found["results"].size(), 3u);
    for (const json& result : found["results"]) {
        ASSERT_EQ(result["members"].size(), 2u);
        const bool meets = result["b"] == "across";
        EXPECT_EQ(result["collides"], meets);
        if (!meets) continue;
        for (const json& conflict : conflicts["conflicts"]) {
            if (conflict["a"] != result["a"]) continue;
            EXPECT_EQ(conflict["intervals"], result["contacts"]) << "all members count";
            EXPECT_NEAR(result["contact"]["time"].get<double>(), conflict["intervals"][0][0].get<double>(), 0.5);
        }
        EXPECT_GT(result["trace"].size(), 0u);
    }
    json brute = json_of({"query", file, "--tree", "brute", "--all-contacts"});
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(brute["results"][i]["contact"], found["results"][i]["contact"]);
        EXPECT_EQ(brute["results"][i]["contacts"], found["results"][i]["contacts"]);
    }
    const Result text = run_program({"query", file});
    EXPECT_NE(text.out.find("left and right never collide."), std::string::npos) << text.out;
    EXPECT_NE(text.out.find(" of across (disk "), std::string::npos) << text.out;
}

TEST(BodiesCommand, InfoSaysThem) {
    const TempFolder folder;
    const std::string file = folder.write("cars.json", three_cars().dump());
    EXPECT_EQ(json_of({"info", file})["clips"][0]["body"], car()["body"]);
    EXPECT_NE(run_program({"info", file}).out.find(" disks along the way it moves\n"), std::string::npos);
}

TEST(BodiesCommand, ExpectationsAreChecked) {
    const TempFolder folder;
    json scene = three_cars();
    scene["queries"] = {{{"a", "left"}, {"b", "right"}, {"expect", {{"collides", false}}}},
                        {{"a", "right"}, {"b", "across"}, {"expect", {{"collides", true}}}}};
    EXPECT_EQ(run_program({"query", folder.write("right.json", scene.dump()), "--check"}).status, 0);
    scene["queries"][0]["expect"]["collides"] = true;
    EXPECT_EQ(run_program({"query", folder.write("wrong.json", scene.dump()), "--check"}).status, 1);
}

TEST(BodiesCommand, FloorsKeepApart) {
    const TempFolder folder;
    json scene = three_cars();
    scene["agents"][0]["floor"] = 1;
    scene["agents"][2]["floor"] = 2;
    const std::string file = folder.write("floors.json", scene.dump());
    const json found = json_of({"conflicts", file});
    EXPECT_EQ(found["pairs"], 2);
    ASSERT_EQ(found["conflicts"].size(), 1u);
    EXPECT_EQ(found["conflicts"][0]["a"], "right") << "of no floor: meets everybody";
    const json brute = json_of({"conflicts", file, "--tree", "brute"});
    EXPECT_EQ(brute["conflicts"], found["conflicts"]);
    EXPECT_EQ(brute["pairs_tested"], 2);
    const json queries = json_of({"query", file});
    ASSERT_EQ(queries["results"].size(), 2u);
    EXPECT_EQ(queries["results"][1]["a"], "right");
    EXPECT_EQ(queries["results"][1]["query"], 1);
}

TEST(BodiesCommand, ConvertKeepsThemInAScene) {
    const TempFolder folder;
    json scene = three_cars();
    scene["agents"][0]["floor"] = "ground";
    const std::string file = folder.write("cars.json", scene.dump()), out = (folder.path() / "out.json").string();
    EXPECT_EQ(run_program({"convert", file, "-o", out}).err, "");
    EXPECT_EQ(json_of({"conflicts", out})["conflicts"], json_of({"conflicts", file})["conflicts"]);
    const Result csv = run_program({"convert", file, "-o", (folder.path() / "out.csv").string()});
    EXPECT_NE(csv.err.find("1 clip has a body of disks along the heading, which a CSV does not hold"),
              std::string::npos)
        << csv.err;
    EXPECT_NE(csv.err.find("1 agent is on a floor, which a CSV does not hold"), std::string::npos) << csv.err;
}

TEST(BodiesCommand, WhatIsOfSingleDisksIsRefused) {
    const TempFolder folder;
    const std::string file = folder.write("cars.json", three_cars().dump());
    const std::string why = "of single disks; remove the body, or leave the clip out";
    expect_refused(
        run_program({"query", file, "--proof"}), 2,
        "clip 'car': it has a body of " + std::to_string(car()["body"].size()) + " disks, and a proof is " + why);
    expect_refused(run_program({"query", file, "--certificate", (folder.path() / "c.json").string()}), 2, why);
    expect_refused(run_program({"map", file, "--query", "0", "--over", "dx=-5:5,dy=-5:5", "--json"}), 2, why);
    expect_refused(run_program({"sweep", file}), 2, why);
    expect_refused(run_program({"bench", "table1", file}), 2, why);
}

TEST(BodiesCommand, EncountersAreTheLeastOverMembers) {
    const TempFolder folder;
    const std::string file = folder.write("cars.json", three_cars().dump());
    // Every member as an agent of its own.
    json members;
    const json body = car()["body"], agents = three_cars()["agents"];
    for (std::size_t i = 0; i < body.size(); ++i) {
        json clip = car();
        clip.erase("body");
        for (json& sample : clip["samples"]) {
            sample[0] = sample[0].get<double>() + body[i][0].get<double>();
            sample[2] = body[i][2];
        }
        const std::string name = "car" + std::to_string(i);
        members["clips"][name] = clip;
        for (json one : agents) {
            one["name"] = one["name"].get<std::string>() + "." + std::to_string(i);
            one["clip"] = name;
            members["agents"].push_back(one);
        }
    }
    const std::vector<std::string> options{"--within", "1.5"};
    const json whole = json_of(with({"conflicts", file}, options));
    const json apart = json_of(with({"conflicts", folder.write("members.json", members.dump())}, options));
    ASSERT_EQ(whole["conflicts"].size(), 3u);
    const auto agent_of = [](const std::string& name) { return name.substr(0, name.find('.')); };
    const auto agents_of = [&](const json& conflict) {
        return std::set{agent_of(conflict["a"]), agent_of(conflict["b"])};
    };
    for (const json& conflict : whole["conflicts"]) {
        double clearance = 1e9, course = 1e9;
        for (const json& one : apart["conflicts"]) {
            if (agents_of(one) != agents_of(conflict)) continue;
            clearance = std::min(clearance, one["least_clearance"].get<double>());
            if (one["time_to_collision"].is_number()) course = std::min(course, one["time_to_collision"].get<double>());
        }
        EXPECT_NEAR(conflict["least_clearance"].get<double>(), clearance, 1e-9);
        if (conflict["time_to_collision"].is_number()) {
            EXPECT_NEAR(conflict["time_to_collision"].get<double>(), course, 1e-9);
        } else {
            EXPECT_EQ(course, 1e9);
        }
    }
}

}  // namespace
}  // namespace mobbscope
