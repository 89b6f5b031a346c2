// KHR_animation_pointer: what a pointer to a node's property moves, what others are told of, and what is refused.
#include "gltf_bytes.h"
#include "imported.h"

#include <import/skeleton/motion_clips.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace mobbscope {
namespace {

const std::string kPointedArm = R"([{"name":"hips","children":[1]},{"name":"hand","translation":[1,0.5,0.25]}])";

std::vector<ImportedClip> pointed_clips(const std::string& bytes, const ImportOptions& options = {}) {
    return motion_clips(parse_gltf(bytes, "clip.glb"), "clip.glb", options);
}

std::string pointed_refusal(const std::string& bytes, const ImportOptions& options = {}) {
    return input_error([&] { pointed_clips(bytes, options); });
}

std::vector<std::string> warnings_of(const ImportedClip& clip) {
    std::vector<std::string> out;
    for (const ImportWarning& warning : clip.facts.warnings) out.push_back(warning.text);
    return out;
}

/// Keys of one property at 0, 1 and 2.5 s: as many numbers as an interpolation takes, none of them 0.
std::vector<float> some_keys(std::size_t width, bool is_cubic) {
    std::vector<float> out(3 * width * (is_cubic ? 3 : 1));
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = 0.2F + 0.1F * static_cast<float>(i * i % 7);
    return out;
}

std::string pointer_to(const std::string& node, const std::string& property) {
    std::string out = "/nodes/";
    return out.append(node).append("/").append(property);
}

TEST(GltfPointer, MovesANodeAsTheOrdinaryChannelDoes) {
    for (const std::string property : {"translation", "rotation", "scale"}) {
        for (const std::string interpolation : {"STEP", "LINEAR", "CUBICSPLINE"}) {
            for (const std::string node : {"0", "1"}) {
                const auto motion_by = [&](bool pointer) {
                    GltfBytes bytes;
                    const bool is_rotation = property == "rotation";
                    const int times = bytes.add_floats("SCALAR", {0, 1, 2.5F});
                    const int values = bytes.add_floats(is_rotation ? "VEC4" : "VEC3",
                                                        some_keys(is_rotation ? 4 : 3, interpolation == "CUBICSPLINE"));
                    if (pointer) {
                        bytes.pointer_channel(pointer_to(node, property), times, values, interpolation);
                    } else {
                        bytes.channel(node, property, times, values, interpolation);
                    }
                    return parse_gltf(bytes.animation().glb(kPointedArm), "clip.glb").motion(0, 0);
                };
                const auto by_pointer = motion_by(true);
                const auto ordinary = motion_by(false);
                ASSERT_EQ(by_pointer->joints().size(), ordinary->joints().size());
                EXPECT_EQ(by_pointer->times().last, 2.5);
                for (int eighth = 0; eighth <= 20; ++eighth) {
                    const double t = eighth / 8.0;
                    std::vector<glm::dvec3> a(ordinary->joints().size());
                    std::vector<glm::dvec3> b = a;
                    std::vector<glm::dquat> turned(a.size());
                    std::vector<glm::dquat> turned_too = turned;
                    by_pointer->pose(t, a, turned);
                    ordinary->pose(t, b, turned_too);
                    EXPECT_EQ(a, b) << property << ' ' << interpolation << ' ' << t;
                    EXPECT_EQ(turned, turned_too) << property << ' ' << interpolation << ' ' << t;
                }
            }
        }
    }
}

/// Node 0 goes 4 m along x in 2 s.
GltfBytes pointed_walk() {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 2});
    bytes.pointer_channel("/nodes/0/translation", times, bytes.add_floats("VEC3", {0, 1, 0, 4, 1, 0}));
    return bytes;
}

void expect_pointed_walk(const ImportedClip& clip) {
    ASSERT_EQ(clip.clip->count(), 61);
    EXPECT_NEAR(clip.clip->samples().back().x - clip.clip->samples().front().x, 4, 1e-9);
}

TEST(GltfPointer, StandsBesideOrdinaryChannelsAndOtherPointers) {
    GltfBytes bytes = pointed_walk();
    bytes.channel("1", "translation", 0, bytes.add_floats("VEC3", {1, 0, 0, 2, 0, 0}));
    const std::vector<ImportedClip> clips = pointed_clips(bytes.animation("walk").glb(kPointedArm));
    expect_pointed_walk(clips.at(0));
    EXPECT_NEAR(clips[0].clip->samples().back().r, 2, 1e-6);
    EXPECT_TRUE(clips[0].facts.warnings.empty()) << warnings_of(clips[0]).front();
    // Two pointers of one node, and a node that both the pointer and the specification's older readers name.
    GltfBytes two = pointed_walk();
    two.pointer_channel("/nodes/0/rotation", 0, two.add_floats("VEC4", {0, 0, 0, 1, 0, 1, 0, 0}));
    expect_pointed_walk(pointed_clips(two.animation().glb(kPointedArm)).at(0));
    GltfBytes named;
    const int times = named.add_floats("SCALAR", {0, 2});
    named.channel_to(
        R"("node":1,"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":"/nodes/0/translation"}})", times,
        named.add_floats("VEC3", {0, 1, 0, 4, 1, 0}));
    expect_pointed_walk(pointed_clips(named.animation().glb(kPointedArm)).at(0));
}

TEST(GltfPointer, TakesIntegersAndRequiredExtensions) {
    GltfBytes bytes = pointed_walk();
    const std::vector<std::int16_t> turn{0, 0, 0, 32767, 0, 32767, 0, 0};
    bytes.pointer_channel("/nodes/0/rotation", 0, bytes.add("VEC4", 5122, turn, ",\"normalized\":true"));
    const std::string rest =
        R"(,"extensionsUsed":["KHR_animation_pointer"],"extensionsRequired":["KHR_animation_pointer"])";
    expect_pointed_walk(pointed_clips(bytes.animation().glb(kPointedArm, rest)).at(0));
}

TEST(GltfPointer, MovesANodeWithAMatrixAlongAsThatAllows) {
    // Turned by a quarter about z and twice as large; what is moved is the place alone.
    const std::string nodes =
        R"([{"children":[1],"matrix":[0,2,0,0,-2,0,0,0,0,0,2,0,7,7,7,1]},{"translation":[0,0,1]}])";
    const auto motion = parse_gltf(pointed_walk().animation().glb(nodes), "clip.glb").motion(0, 0);
    std::vector<glm::dvec3> places(2);
    motion->pose(1, places);
    EXPECT_EQ(places[0], glm::dvec3(2, 1, 0));
    EXPECT_EQ(places[1], glm::dvec3(2, 1, 2));
    GltfBytes turn;
    turn.pointer_channel("/nodes/0/rotation", turn.add_floats("SCALAR", {0}), turn.add_floats("VEC4", {0, 0, 0, 1}));
    EXPECT_NE(pointed_refusal(turn.animation().glb(nodes)).find("node 0 'node0': is animated, so it needs translation"),
              std::string::npos);
}

TEST(GltfPointer, ToWeightsMovesMorphTargets) {
    for (const std::string weights : {"/nodes/1/weights", "/nodes/1/weights/0"}) {
        GltfBytes alone;
        const int times = alone.add_floats("SCALAR", {0, 1});
        alone.pointer_channel(weights, times, times).animation("smile");
        EXPECT_EQ(pointed_refusal(alone.glb(kPointedArm)),
                  "clip.glb: animation 'smile': moves morph targets only, so there is no joint to follow; give a clip "
                  "that moves nodes");
        GltfBytes both = pointed_walk();
        both.pointer_channel(weights, 0, 0);
        const ImportedClip clip = pointed_clips(both.animation().glb(kPointedArm)).at(0);
        expect_pointed_walk(clip);
        EXPECT_TRUE(warns(clip, "morph targets are animated too"));
        EXPECT_FALSE(warns(clip, "KHR_animation_pointer"));
    }
    GltfBytes each = pointed_walk();
    each.pointer_channel("/nodes/1/weights/0", 0, 0).pointer_channel("/nodes/1/weights/1", 0, 0);
    expect_pointed_walk(pointed_clips(each.animation().glb(kPointedArm)).at(0));
}

const std::vector<std::string> kElsewhere{
    "/materials/0/pbrMetallicRoughness/baseColorFactor",
    "/cameras/0/perspective/yfov",
    "/extensions/KHR_lights_punctual/lights/0/intensity",
    "/nodes/0/extensions/KHR_node_visibility/visible",
    "/nodes/0/translation/0",
    "/materials/1/extensions/KHR_texture_transform~1x/offset",
    "/meshes/0/weights",
    "/nodes/0/extras/speed",
};

TEST(GltfPointer, ElsewhereIsNamedInAWarning) {
    for (const std::string& pointer : kElsewhere) {
        GltfBytes bytes = pointed_walk();
        // It lasts longer, and is no number at all: it is not read.
        bytes.pointer_channel(pointer, bytes.add_floats("SCALAR", {0, 9}), bytes.add_floats("VEC3", {NAN, 0, 0}));
        const ImportedClip clip = pointed_clips(bytes.animation().glb(kPointedArm)).at(0);
        expect_pointed_walk(clip);
        EXPECT_EQ(warnings_of(clip), std::vector<std::string>{"KHR_animation_pointer leads to '" + pointer +
                                                              "', which moves no node: ignored"});
    }
}

TEST(GltfPointer, OfManyElsewhereAFewAreNamed) {
    GltfBytes bytes = pointed_walk();
    for (const std::string& pointer : kElsewhere) bytes.pointer_channel(pointer, 0, 0);
    const ImportedClip clip = pointed_clips(bytes.animation().glb(kPointedArm)).at(0);
    EXPECT_TRUE(warns(clip, "'" + kElsewhere[0] + "', '" + kElsewhere[1] + "', '" + kElsewhere[2] +
                                "' and 5 more places, which move no node: ignored"))
        << warnings_of(clip).front();
}

TEST(GltfPointer, ElsewhereAloneMakesNoClip) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    bytes.pointer_channel(kElsewhere[0], times, times).animation("glow");
    EXPECT_EQ(pointed_refusal(bytes.glb(kPointedArm)),
              "clip.glb: animation 'glow': moves no node, as KHR_animation_pointer leads to '" + kElsewhere[0] +
                  "'; give a clip that does");
    // Beside a walk it is left out, and that is said; who names it is told why there is none.
    bytes.pointer_channel("/nodes/0/translation", times, bytes.add_floats("VEC3", {0, 1, 0, 4, 1, 0}))
        .animation("walk");
    const std::vector<ImportedClip> clips = pointed_clips(bytes.glb(kPointedArm));
    ASSERT_EQ(clips.size(), 1u);
    EXPECT_EQ(clips[0].name, "walk");
    EXPECT_TRUE(warns(clips[0], "animation 'glow' is left out: it moves no node, as KHR_animation_pointer"));
    EXPECT_FALSE(warns(clips[0], "ignored")) << "that is about the other animation";
    ImportOptions named;
    named.animation = "glow";
    EXPECT_NE(pointed_refusal(bytes.glb(kPointedArm), named)
                  .find("animation 'glow': moves no node, as KHR_animation_pointer"),
              std::string::npos);
}

TEST(GltfPointer, MalformedIsOneClearLine) {
    const auto refuse = [](const std::string& target, const std::string& words, const std::string& type = "VEC3") {
        GltfBytes bytes;
        const int times = bytes.add_floats("SCALAR", {0});
        const int values = bytes.add_floats(type, {0, 0, 0, 1});
        bytes.channel_to(R"("path":"pointer",)" + target, times, values).animation();
        const std::string message = pointed_refusal(bytes.glb(kPointedArm));
        EXPECT_NE(message.find(words), std::string::npos) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    };
    const auto extension = [](const std::string& inside) {
        return R"("extensions":{"KHR_animation_pointer":)" + inside + "}";
    };
    const std::string place = "/animations/0/channels/0/target/extensions";
    refuse(R"("extras":0)", place + ": must be an object");
    refuse(R"("extensions":[])", place + ": must be an object");
    refuse(R"("extensions":{})", place + "/KHR_animation_pointer: must be an object");
    refuse(extension("7"), place + "/KHR_animation_pointer: must be an object");
    refuse(extension("{}"), place + "/KHR_animation_pointer/pointer: must be a string");
    refuse(extension(R"({"pointer":["nodes",0]})"), place + "/KHR_animation_pointer/pointer: must be a string");
    refuse(extension(R"({"pointer":""})"), "'' must begin with '/', as in '/nodes/0/rotation'");
    refuse(extension(R"({"pointer":"nodes/0/translation"})"), "'nodes/0/translation' must begin with '/'");
    for (const std::string node : {"2", "-1", "00", "hips", "", "18446744073709551616", "0.5", "+0"}) {
        refuse(extension(R"({"pointer":"/nodes/)" + node + R"(/translation"})"),
               "'/nodes/" + node + "/translation' leads to no node; there are 2");
    }
    refuse(extension(R"({"pointer":"/nodes/0/rotation"})"), "accessor 1: must be of type VEC4");
    refuse(extension(R"({"pointer":"/nodes/0/scale"})"), "accessor 1: must be of type VEC3", "VEC4");
    for (const bool pointer_first : {true, false}) {
        GltfBytes twice = pointer_first ? pointed_walk() : GltfBytes();
        const int times = twice.add_floats("SCALAR", {0, 2});
        const int places = twice.add_floats("VEC3", {0, 1, 0, 4, 1, 0});
        twice.channel("0", "translation", times, places);
        if (!pointer_first) twice.pointer_channel("/nodes/0/translation", times, places);
        EXPECT_NE(pointed_refusal(twice.animation().glb(kPointedArm))
                      .find("has two channels for 'translation' of node 0 'hips'; keep one"),
                  std::string::npos);
    }
    // What a pointer says is shown as one line, and not all of it.
    GltfBytes odd;
    odd.pointer_channel("/materials/0/\\n\\u001b" + std::string(100'000, 'x'), odd.add_floats("SCALAR", {0}), 0);
    const std::string message = pointed_refusal(odd.animation().glb(kPointedArm));
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_LT(message.size(), 300u);
}

}  // namespace
}  // namespace mobbscope
