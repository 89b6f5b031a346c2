// FBX 6.1: objects are named, takes hold the keys.
#include "fbx_writer.h"

#include <import/fbx/fbx.h>
#include <support/input_error.h>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr std::int64_t kSecond = 46'186'158'000;

FbxWrite property(const std::string& name, const std::string& type, std::vector<FbxWritten> values) {
    FbxWrite out{"Property", {name, type, std::string("A+")}};
    out.values.insert(out.values.end(), values.begin(), values.end());
    return out;
}

FbxWrite limb(const std::string& name, double x, double y) {
    return {"Model",
            {"Model::" + name, std::string("LimbNode")},
            {{"Properties60", {}, {property("Lcl Translation", "Lcl Translation", {x, y, 0.0})}}}};
}

/// A channel with keys; none: fixed.
FbxWrite axis(const std::string& name, std::vector<FbxWritten> keys, double fixed = 0) {
    FbxWrite out{"Channel", {name}, {{"Default", {fixed}}}};
    if (!keys.empty()) {
        out.add({"KeyVer", {std::int64_t{4005}}});
        out.add({"KeyCount", {std::int64_t{2}}});
        out.add({"Key", std::move(keys)});
    }
    return out;
}

FbxWrite moves(const std::string& name, const std::string& what, std::vector<FbxWrite> axes) {
    return {
        "Model", {"Model::" + name}, {{"Channel", {std::string("Transform")}, {{"Channel", {what}, std::move(axes)}}}}};
}

std::vector<FbxWritten> straight(double from, double to) {
    return {std::int64_t{0}, from, std::string("L"), 2 * kSecond, to, std::string("L")};
}

/// Hips that go 4 m along x in two seconds, above them 0.9 m, with an arm of 60 cm that turns.
std::vector<FbxWrite> old_walk(std::vector<FbxWritten> keys = straight(0, 400)) {
    FbxWrite settings{"GlobalSettings", {}, {{"Properties60", {}, {property("UnitScaleFactor", "double", {1.0})}}}};
    const auto joined = [](const std::string& from, const std::string& to) {
        return FbxWrite{"Connect", {std::string("OO"), "Model::" + from, "Model::" + to}};
    };
    return {{"Objects", {}, {limb("Hips", 0, 90), limb("Arm", 0, 50), limb("Hand", 60, 0), settings}},
            {"Connections", {}, {joined("Hips", "Scene"), joined("Arm", "Hips"), joined("Hand", "Arm")}},
            {"Takes",
             {},
             {{"Current", {std::string("Walk")}},
              {"Take",
               {std::string("Walk")},
               {{"LocalTime", {std::int64_t{0}, 2 * kSecond}},
                moves("Hips", "T", {axis("X", std::move(keys)), axis("Y", {}, 90), axis("Z", {})}),
                moves("Arm", "R", {axis("X", {}), axis("Y", straight(0, 90)), axis("Z", {})})}}}}};
}

glm::dvec3 place_of(const std::string& bytes, std::size_t joint, double seconds) {
    const auto motion = parse_fbx(bytes, "old.fbx").motion(0, 0);
    std::vector<glm::dvec3> positions(motion->joints().size());
    motion->pose(seconds, positions);
    return positions[joint];
}

TEST(FbxOld, TakesMoveNamedModels) {
    for (const bool is_text : {false, true}) {
        const std::string bytes = fbx_bytes(old_walk(), {6100, is_text});
        const MotionFile file = parse_fbx(bytes, "old.fbx");
        EXPECT_EQ(file.animations, std::vector<std::string>{"Walk"});
        EXPECT_EQ(file.unit, 0.01);
        EXPECT_EQ(file.motion(0, 0)->times().last, 2);
        EXPECT_EQ(file.joints[0].name, "Hips");
        const glm::dvec3 hips = place_of(bytes, 0, 1);
        EXPECT_NEAR(hips.x, 200, 1e-9);
        EXPECT_NEAR(hips.y, 90, 1e-9);
        const glm::dvec3 hand = place_of(bytes, 2, 2);
        EXPECT_NEAR(hand.x, 400, 1e-9);
        EXPECT_NEAR(hand.y, 140, 1e-9);
        EXPECT_NEAR(hand.z, -60, 1e-9) << "a quarter turn about y";
    }
}

TEST(FbxOld, KeysOfEveryKindAreRead) {
    const auto x_at = [](std::vector<FbxWritten> keys, double seconds) {
        return place_of(fbx_bytes(old_walk(std::move(keys)), {6100, true}), 0, seconds).x;
    };
    const auto key = [](std::vector<FbxWritten> how) {
        std::vector<FbxWritten> out{std::int64_t{0}, 0.0};
        out.insert(out.end(), how.begin(), how.end());
        out.emplace_back(2 * kSecond);
        out.emplace_back(400.0);
        out.insert(out.end(), how.begin(), how.end());
        return out;
    };
    const auto letters = [](const std::string& of) {
        std::vector<FbxWritten> out;
        for (const char c : of) out.emplace_back(std::string(1, c));
        return out;
    };
    EXPECT_NEAR(x_at(key(letters("Cs")), 1), 0, 1e-9);
    EXPECT_NEAR(x_at(key(letters("Cn")), 1), 400, 1e-9);
    EXPECT_NEAR(x_at(key(letters("Uan")), 1), 200, 1e-9);
    const std::string u = "U", s = "s", n = "n", a = "a", r = "r", l = "l", t = "t";
    // Flat at both ends: slow, fast, slow.
    EXPECT_NEAR(x_at(key({u, s, 0.0, 0.0, n}), 1), 200, 1e-9);
    EXPECT_NEAR(x_at(key({u, s, 0.0, 0.0, n}), 0.5), 400 * (3 * 0.0625 - 2 * 0.015625), 1e-9);
    EXPECT_GT(x_at(key({u, s, 0.0, 0.0, r, 0.01}), 0.5), x_at(key({u, s, 0.0, 0.0, n}), 0.5));
    EXPECT_LT(x_at(key({u, s, 0.0, 0.0, l, 0.01}), 1.5), x_at(key({u, s, 0.0, 0.0, n}), 1.5));
    EXPECT_NEAR(x_at(key({u, s, 0.0, 0.0, a, 0.3333, 0.3333}), 0.5), x_at(key({u, s, 0.0, 0.0, n}), 0.5), 0.1);
    EXPECT_NEAR(x_at(key({u, t, 0.0, 0.0, 0.0}), 1), 200, 1e-9);
}

TEST(FbxOld, BadKeysAreNamed) {
    const auto refusal_of = [](std::vector<FbxWritten> keys) {
        return input_error([&] { parse_fbx(fbx_bytes(old_walk(std::move(keys)), {6100, true}), "old.fbx"); });
    };
    const std::string u = "U", x = "X", l = "L";
    const std::string otherwise = "; export the file again as FBX 7.4 (FBX 2014/2015) or newer";
    const auto ends_with = [](const std::string& text, const std::string& end) {
        EXPECT_TRUE(text.ends_with(end)) << text << "\n" << end;
    };
    ends_with(refusal_of({std::int64_t{0}, 1.0, x}), "Key has a key of a kind that is not known, 'X'" + otherwise);
    ends_with(refusal_of({std::int64_t{0}, 1.0, u, x}), "Key has a key of a kind that is not known, 'X'" + otherwise);
    ends_with(refusal_of({std::int64_t{0}, 1.0}), "Key has a key that is cut off" + otherwise);
    ends_with(refusal_of({std::int64_t{0}, l, l}), "Key has 'L' where a number is expected" + otherwise);
    ends_with(refusal_of({kSecond, 1.0, l, std::int64_t{0}, 1.0, l}),
              "Key has key 1 before the one before it; export the file again");
    std::string old = fbx_bytes(old_walk(), {6100, true});
    old.replace(old.find("KeyVer: 4005"), 12, "KeyVer: 4001");
    ends_with(input_error([&] { parse_fbx(old, "old.fbx"); }),
              "KeyVer is 4001, and such keys are not read" + otherwise);
    ends_with(input_error([&] {
                  parse_fbx(fbx_bytes({}, {6100, true}), "old.fbx");
              }),
              "holds no animation; export the clip with its animation");
}

}  // namespace
}  // namespace mobbscope
