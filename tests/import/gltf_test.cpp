// The glTF reader: what the specification says of samplers, accessors, nodes and skins, and what is refused.
#include "gltf_bytes.h"

#include <import/nodes/gltf.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mobbscope {
namespace {

constexpr double kHalf = std::numbers::sqrt2 / 2;  // sine and cosine of 45 degrees
const std::string kArm = R"([{"children":[1]},{"name":"tip","translation":[1,0,0]}])";

MotionFile parse(const std::string& bytes) { return parse_gltf(bytes, "clip.glb"); }

std::vector<glm::dvec3> pose_at(const Motion& motion, double seconds) {
    std::vector<glm::dvec3> positions(motion.joints().size());
    motion.pose(seconds, positions);
    return positions;
}

std::vector<glm::dvec3> pose_at(const GltfBytes& bytes, const std::string& nodes, double seconds) {
    return pose_at(*parse(bytes.glb(nodes)).motion(0, 0), seconds);
}

void expect_at(const glm::dvec3& place, double x, double y, double z, double tolerance = 1e-6) {
    EXPECT_NEAR(place.x, x, tolerance);
    EXPECT_NEAR(place.y, y, tolerance);
    EXPECT_NEAR(place.z, z, tolerance);
}

std::string gltf_refusal(const std::string& bytes, const std::string& name = "clip.glb") {
    return input_error([&] {
        const auto file = parse_gltf(bytes, name);
        for (std::size_t i = 0; i < file.animations.size(); ++i) file.motion(i, 0);
    });
}

void expect_refused(const std::string& bytes, const std::string& words, const std::string& name = "clip.glb") {
    const std::string message = gltf_refusal(bytes, name);
    EXPECT_TRUE(message.starts_with(name + ": ")) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
}

/// One node that moves 2 m along x in a second.
GltfBytes mover() {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 0, 0, 2, 0, 0})).animation();
    return bytes;
}

TEST(GltfSampler, LinearKeysAreJoinedByLinesAndRotationsBySlerp) {
    GltfBytes bytes = mover();
    expect_at(pose_at(bytes, "[{}]", 0.25)[0], 0.5, 0, 0);

    GltfBytes turn;
    const int times = turn.add_floats("SCALAR", {0, 1});
    const auto half = static_cast<float>(kHalf);
    turn.channel("0", "rotation", times, turn.add_floats("VEC4", {0, 0, 0, 1, 0, half, 0, half})).animation();
    const double third = std::numbers::pi / 6;  // a third of the quarter turn about y
    expect_at(pose_at(turn, kArm, 1 / 3.0)[1], std::cos(third), 0, -std::sin(third));
}

TEST(GltfSampler, SlerpTakesTheShorterWay) {
    GltfBytes turn;
    const int times = turn.add_floats("SCALAR", {0, 1});
    const auto half = static_cast<float>(kHalf);
    turn.channel("0", "rotation", times, turn.add_floats("VEC4", {0, 0, 0, 1, 0, -half, 0, -half})).animation();
    expect_at(pose_at(turn, kArm, 0.5)[1], kHalf, 0, -kHalf);
}

TEST(GltfSampler, StepHoldsEachKey) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1, 2});
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 0, 0, 5, 0, 0, 7, 0, 0}), "STEP").animation();
    expect_at(pose_at(bytes, "[{}]", 0.999)[0], 0, 0, 0);
    expect_at(pose_at(bytes, "[{}]", 1)[0], 5, 0, 0);
    expect_at(pose_at(bytes, "[{}]", 9)[0], 7, 0, 0);
}

TEST(GltfSampler, CubicSplinesFollowTheirTangents) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 2});
    // x = t^3: value and slope are 0 at 0, 8 and 12 at 2. Each key is in-tangent, value, out-tangent.
    const int values = bytes.add_floats("VEC3", {9, 0, 0, 0, 0, 0, 0, 0, 0, 12, 0, 0, 8, 0, 0, 9, 0, 0});
    bytes.channel("0", "translation", times, values, "CUBICSPLINE").animation();
    for (const double t : {0.0, 0.5, 1.0, 1.7, 2.0}) expect_at(pose_at(bytes, "[{}]", t)[0], t * t * t, 0, 0);
    expect_at(pose_at(bytes, "[{}]", 5)[0], 8, 0, 0);
}

TEST(GltfSampler, CubicSplinesOfRotationsAreNormalised) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    const auto half = static_cast<float>(kHalf);
    const int values = bytes.add_floats("VEC4", {0, 0, 0, 0, 0, 0,    0, 1,    0, 0, 0, 0,  //
                                                 0, 0, 0, 0, 0, half, 0, half, 0, 0, 0, 0});
    bytes.channel("0", "rotation", times, values, "CUBICSPLINE").animation();
    const glm::dvec3 tip = pose_at(bytes, kArm, 0.5)[1];
    EXPECT_NEAR(std::hypot(tip.x, tip.z), 1, 1e-9);
    expect_at(tip, kHalf, 0, -kHalf);
}

TEST(GltfSampler, OutsideItsKeysAChannelStaysAndTheClipRunsFromTheEarliestToTheLast) {
    GltfBytes bytes;
    const int early = bytes.add_floats("SCALAR", {0.5F, 1});
    const int late = bytes.add_floats("SCALAR", {1, 3});
    bytes.channel("0", "translation", early, bytes.add_floats("VEC3", {1, 0, 0, 2, 0, 0}));
    bytes.channel("1", "translation", late, bytes.add_floats("VEC3", {0, 1, 0, 0, 2, 0})).animation();
    const auto motion = parse(bytes.glb(kArm)).motion(0, 0);
    EXPECT_EQ(motion->times().first, 0.5);
    EXPECT_EQ(motion->times().last, 3);
    EXPECT_EQ(motion->times().frames, 3);
    EXPECT_FALSE(motion->times().dt);
    EXPECT_FALSE(motion->times().frames_only);
    expect_at(pose_at(*motion, 0)[0], 1, 0, 0);
    expect_at(pose_at(*motion, 0)[1], 1, 1, 0);
    expect_at(pose_at(*motion, 2)[1], 2, 1.5, 0);
    expect_at(pose_at(*motion, 9)[1], 2, 2, 0);
}

TEST(GltfAccessor, NormalisedIntegersAreFractions) {
    const auto tip_after = [](auto most, int component, bool is_signed) {
        using T = decltype(most);
        GltfBytes bytes;
        const int times = bytes.add_floats("SCALAR", {0});
        const auto half = static_cast<T>(std::lround(kHalf * most));
        // Unsigned types have no negative part: a quarter turn the other way needs none.
        const std::vector<T> turn{0, half, 0, half};
        const std::vector<T> back{0, static_cast<T>(is_signed ? -half : half), 0, half};
        bytes.channel("0", "rotation", times,
                      bytes.add("VEC4", component, is_signed ? back : turn, ",\"normalized\":true"));
        return pose_at(bytes.animation(), kArm, 0)[1];
    };
    expect_at(tip_after(std::int8_t{127}, 5120, true), 0, 0, 1, 0.02);
    expect_at(tip_after(std::uint8_t{255}, 5121, false), 0, 0, -1, 0.01);
    expect_at(tip_after(std::int16_t{32767}, 5122, true), 0, 0, 1, 1e-4);
    expect_at(tip_after(std::uint16_t{65535}, 5123, false), 0, 0, -1, 1e-4);
}

TEST(GltfAccessor, TheLeastSignedIntegerIsMinusOne) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0});
    const std::vector<std::int8_t> values{-128, 127, 0};
    bytes.channel("0", "translation", times, bytes.add("VEC3", 5120, values, ",\"normalized\":true")).animation();
    expect_at(pose_at(bytes, "[{}]", 0)[0], -1, 1, 0);
}

TEST(GltfAccessor, SparseElementsReplaceOthers) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1, 2, 3});
    const int base = bytes.add_view(std::vector<float>{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0});
    const int places = bytes.add_view(std::vector<std::uint16_t>{1, 3});
    const int values = bytes.add_view(std::vector<float>{10, 0, 0, 30, 0, 0});
    const std::string sparse =
        R"("componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":)" +
        std::to_string(places) + R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}";
    const int on_zeros = bytes.add_accessor(sparse);
    const int on_base = bytes.add_accessor("\"bufferView\":" + std::to_string(base) + "," + sparse);
    bytes.channel("0", "translation", times, on_base).channel("1", "translation", times, on_zeros).animation();
    const auto motion = parse(bytes.glb(kArm)).motion(0, 0);
    const double expected_base[] = {0, 10, 2, 30};
    const double expected_zeros[] = {0, 10, 0, 30};
    for (int i = 0; i < 4; ++i) {
        expect_at(pose_at(*motion, i)[0], expected_base[i], 0, 0);
        expect_at(pose_at(*motion, i)[1], expected_base[i] + expected_zeros[i], 0, 0);
    }
}

TEST(GltfAccessor, InterleavedElementsAreFoundByTheirStride) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    const int view = bytes.add_view(std::vector<float>{7, 7, 1, 2, 3, 7, 7, 4, 5, 6}, ",\"byteStride\":20");
    const int values = bytes.add_accessor("\"bufferView\":" + std::to_string(view) +
                                          R"(,"byteOffset":8,"componentType":5126,"count":2,"type":"VEC3")");
    bytes.channel("0", "translation", times, values).animation();
    expect_at(pose_at(bytes, "[{}]", 0)[0], 1, 2, 3);
    expect_at(pose_at(bytes, "[{}]", 1)[0], 4, 5, 6);
}

TEST(GltfNodes, TransformsOfAllParentsApply) {
    const GltfBytes bytes = mover();
    // Centimetres below a node turned by -90 degrees about x, below one that moves: (2, 3, 4) cm, z up.
    const std::string nodes =
        R"([{"children":[1]},{"children":[2],"rotation":[-0.70710678,0,0,0.70710678],"scale":[0.01,0.01,0.01]},)"
        R"({"translation":[2,3,4]}])";
    expect_at(pose_at(bytes, nodes, 0.5)[2], 1.02, 0.04, -0.03);
    // The same as a matrix, column after column.
    const std::string matrix =
        R"([{"children":[1]},{"children":[2],"matrix":[0.01,0,0,0, 0,0,-0.01,0, 0,0.01,0,0, 0,0,0,1]},)"
        R"({"translation":[2,3,4]}])";
    expect_at(pose_at(bytes, matrix, 0.5)[2], 1.02, 0.04, -0.03);
}

TEST(GltfNodes, ALongChainIsNoTrouble) {
    constexpr int kChain = 20'000;
    std::string nodes = "[";
    for (int i = 0; i + 1 < kChain; ++i) nodes += "{\"children\":[" + std::to_string(i + 1) + "]},";
    const auto positions = pose_at(mover(), nodes + "{}]", 1);
    ASSERT_EQ(positions.size(), static_cast<std::size_t>(kChain));
    expect_at(positions.back(), 2, 0, 0);
}

TEST(GltfNodes, NamesAreMadeWhereThereAreNone) {
    GltfBytes bytes = mover();
    bytes.channel("1", "translation", 0, 1).animation("second");
    const auto file = parse(bytes.glb(kArm));
    EXPECT_EQ(file.animations, (std::vector<std::string>{"#0", "second"}));
    EXPECT_EQ(file.format, "gltf");
    EXPECT_EQ(file.unit, 1);
    EXPECT_EQ(file.motion(0, 0)->joints()[0].name, "node0");
    EXPECT_EQ(file.motion(0, 0)->joints()[1].name, "tip");
}

TEST(GltfSkin, OnlyItsJointsCount) {
    // 0 armature > 1 hips > 2 no joint > 3 hand; 4 no joint below hips.
    const std::string nodes =
        R"([{"children":[1]},{"name":"hips","children":[2,4]},{"children":[3]},{"name":"hand","translation":[1,0,0]},)"
        R"({"translation":[9,0,0]}])";
    const auto file = parse(mover().glb(nodes, R"(,"skins":[{"joints":[3,1,3]}])"));
    const auto motion = file.motion(0, 0);
    ASSERT_EQ(motion->joints().size(), 2u);
    EXPECT_EQ(motion->joints()[0].name, "hips");
    EXPECT_EQ(motion->joints()[1].name, "hand");
    EXPECT_EQ(motion->joints()[1].parent, 0);
    EXPECT_EQ(motion->topmost(), 0);
    expect_at(pose_at(*motion, 1)[1], 3, 0, 0);
    EXPECT_TRUE(motion->warnings().empty());
}

TEST(GltfSkin, OfSeveralTopmostJointsTheSkinsFirstIsTaken) {
    const std::string nodes = R"([{"name":"a"},{"name":"b"},{"name":"c"}])";
    const auto motion = parse(mover().glb(nodes, R"(,"skins":[{"joints":[2,0,1]}])")).motion(0, 0);
    EXPECT_EQ(motion->joints()[static_cast<std::size_t>(motion->topmost())].name, "c");
}

TEST(GltfSkin, WithoutOneTheTopmostAnimatedNodeBegins) {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    const int places = bytes.add_floats("VEC3", {0, 0, 0, 2, 0, 0});
    // The first animation moves the leaf alone; both have one root.
    bytes.channel("3", "translation", times, places).animation("leaf");
    bytes.channel("2", "translation", times, places).channel("3", "scale", times, places).animation("both");
    const std::string nodes = R"([{"name":"still"},{"children":[2]},{"name":"top","children":[3]},{"name":"leaf"}])";
    const auto file = parse(bytes.glb(nodes));
    for (const std::size_t animation : {0u, 1u}) {
        const auto motion = file.motion(animation, 0);
        ASSERT_EQ(motion->joints().size(), 2u);
        EXPECT_EQ(motion->topmost(), 0);
        EXPECT_EQ(motion->joints()[0].name, "top");
    }
}

TEST(GltfFile, WhatIsNotNeededNeedNotBeThere) {
    const GltfBytes bytes = mover();
    const std::string rest =
        R"(,"images":[{"uri":"missing.png"},{"bufferView":99}],"materials":[7],"textures":"none","meshes":[{"primitives":)"
        R"([{"attributes":{"POSITION":88}}]}],"scenes":[{"nodes":[55]}],"extensionsRequired":["KHR_materials_unlit"])";
    expect_at(pose_at(*parse(bytes.glb("[{\"mesh\":0,\"extras\":[1,{}]}]", rest)).motion(0, 0), 1)[0], 2, 0, 0);
}

TEST(GltfFile, ChannelsWithoutATargetNodeAreIgnored) {
    GltfBytes bytes = mover();
    const int times = bytes.add_floats("SCALAR", {0, 9});
    bytes.channel("", "translation", times, 1).channel("0", "translation", 0, 1).animation();
    const auto file = parse(bytes.glb("[{}]"));
    EXPECT_EQ(file.motion(1, 0)->times().last, 1);
}

TEST(GltfFile, BuffersLieBesideItOrBelow) {
    const TempFolder folder;
    const GltfBytes bytes = mover();
    std::filesystem::create_directory(folder.path() / "the data");
    folder.write("the data/a+b.bin", bytes.binary() + "more than is needed");
    const auto file = folder.write("clip.gltf", bytes.text("[{}]", "", "the%20data/a+b.bin"));
    expect_at(pose_at(*parse_gltf(slurp(file), file).motion(0, 0), 1)[0], 2, 0, 0);

    for (const char* uri :
         {"../clip.bin", "/etc/passwd", "http://host/a.bin", "a/../../b.bin", "%2e%2e/b.bin", "a\\\\b"}) {
        const std::string message = gltf_refusal(bytes.text("[{}]", "", uri), "clip.gltf");
        EXPECT_NE(message.find("/buffers/0/uri"), std::string::npos) << message;
    }
    const std::string missing =
        input_error([&] { parse_gltf(bytes.text("[{}]", "", "gone.bin"), folder.path() / "b.gltf"); });
    EXPECT_NE(missing.find("b.gltf: buffer 0: "), std::string::npos) << missing;
    EXPECT_NE(missing.find("gone.bin: no such file"), std::string::npos) << missing;
    folder.write("short.bin", bytes.binary().substr(1));
    const std::string cut =
        input_error([&] { parse_gltf(bytes.text("[{}]", "", "short.bin"), folder.path() / "c.gltf"); });
    EXPECT_NE(cut.find("buffer 0"), std::string::npos) << cut;
}

TEST(GltfFile, BuffersMayBeDataUris) {
    // The keys 0 and 1, then (0, 0, 0) and (2, 0, 0), as base64.
    const std::string base64 = "AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=";
    for (const char* type : {"application/octet-stream", "application/gltf-buffer", "", "model/whatever"}) {
        const std::string json = mover().text("[{}]", "", std::string("data:") + type + ";base64," + base64);
        expect_at(pose_at(*parse_gltf(json, "clip.gltf").motion(0, 0), 1)[0], 2, 0, 0);
    }
    expect_refused(mover().text("[{}]", "", "data:;base64,AAAA"), "buffer 0", "clip.gltf");
    expect_refused(mover().text("[{}]", "", "data:,AAAA"), "/buffers/0/uri", "clip.gltf");
}

TEST(GltfRefusal, NamesTheJsonPointer) {
    const GltfBytes bytes = mover();
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string json = bytes.text("[{}]");
        const std::size_t at = json.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return join_glb(json.replace(at, from.size(), to), bytes.binary());
    };
    expect_refused(with("\"2.0\"", "\"1.0\""), "/asset/version");
    expect_refused(with("[{}]", "{}"), "/nodes: must be an array");
    expect_refused(with("[{}]", "[0]"), "/nodes/0: must be an object");
    expect_refused(with("[{}]", "[{\"children\":[1]}]"), "/nodes/0/children/0: refers to nodes/1");
    expect_refused(with("[{}]", "[{\"children\":[4294967296]}]"), "/nodes/0/children/0");
    expect_refused(with("[{}]", "[{\"children\":[-1]}]"), "/nodes/0/children/0");
    expect_refused(with("[{}]", "[{\"translation\":[0,1]}]"), "/nodes/0/translation: must be an array of 3 numbers");
    expect_refused(with("[{}]", "[{\"matrix\":[1]}]"), "/nodes/0/matrix");
    expect_refused(with("\"target\":{\"node\":0", "\"target\":{\"node\":3"), "/animations/0/channels/0/target/node");
    expect_refused(with("\"sampler\":0", "\"sampler\":1"), "/animations/0/channels/0/sampler");
    expect_refused(with("\"input\":0", "\"input\":2"), "/animations/0/samplers/0/input");
    expect_refused(with("\"output\":1", "\"output\":\"1\""), "/animations/0/samplers/0/output");
    expect_refused(with("\"bufferView\":1", "\"bufferView\":2"), "/accessors/1/bufferView");
    expect_refused(with("\"buffer\":0", "\"buffer\":1"), "/bufferViews/0/buffer");
    expect_refused(with("\"type\":\"VEC3\"", "\"type\":\"VEC5\""), "/accessors/1/type");
    expect_refused(with("\"componentType\":5126", "\"componentType\":5130"), "/accessors/0/componentType");
    expect_refused(with("\"byteLength\":8", "\"byteLength\":-8"), "/bufferViews/0/byteLength");
    expect_refused(bytes.glb("[{}]", R"(,"skins":[{"joints":[]}])"), "/skins/0/joints");
    expect_refused(bytes.glb("[{}]", R"(,"skins":[{"joints":[0],"skeleton":1}])"),
                   "/skins/0/skeleton: refers to nodes/1");
    expect_refused(bytes.glb("[{}]", R"(,"extensionsRequired":["EXT_meshopt_compression"])"), "/extensionsRequired/0");
}

TEST(GltfRefusal, NamesTheAccessor) {
    const auto refused = [](const std::vector<float>& times, const std::vector<float>& places, const std::string& words,
                            const std::string& interpolation = "LINEAR") {
        GltfBytes bytes;
        const int input = bytes.add_floats("SCALAR", times);
        bytes.channel("0", "translation", input, bytes.add_floats("VEC3", places), interpolation).animation();
        expect_refused(bytes.glb("[{}]"), words);
    };
    refused({1, 0}, {0, 0, 0, 0, 0, 0}, "accessor 0: key time 1 is not after");
    refused({0, 0}, {0, 0, 0, 0, 0, 0}, "accessor 0: key time 1 is not after");
    refused({0, NAN}, {0, 0, 0, 0, 0, 0}, "accessor 0: element 1 is not finite");
    refused({0, 1}, {0, 0, 0, 0, 0, INFINITY}, "accessor 1: element 1 is not finite");
    refused({0, 1}, {0, 0, 0}, "accessor 1: has 1 elements");
    refused({0, 1}, {0, 0, 0, 0, 0, 0}, "accessor 1: has 2 elements", "CUBICSPLINE");
    refused({0, 1}, {0, 0, 0, 0, 0, 0}, "interpolation 'SMOOTH'", "SMOOTH");

    const auto described = [](const std::string& accessor, const std::string& words, const std::string& view = "") {
        GltfBytes bytes;
        const int times = bytes.add_floats("SCALAR", {0, 1});
        bytes.add_view(std::vector<float>(6), view);
        bytes.channel("0", "translation", times, bytes.add_accessor(accessor)).animation();
        expect_refused(bytes.glb("[{}]"), words);
    };
    const std::string on_view = R"("bufferView":1,"componentType":5126,"type":"VEC3","count":)";
    described(on_view + "3", "accessor 1: 3 elements do not fit");
    described(on_view + "2,\"byteOffset\":4", "accessor 1: 2 elements do not fit");
    described(on_view + "2,\"byteOffset\":400", "accessor 1: 2 elements do not fit");
    described(on_view + "2,\"byteOffset\":2", "accessor 1: bufferView 1: its data is not aligned");
    described(on_view + "2", "accessor 1: bufferView 1: byteStride 8", ",\"byteStride\":8");
    described(on_view + "2", "accessor 1: 2 elements do not fit", ",\"byteStride\":16");
    described(on_view + "0", "accessor 1: has no element");
    described(on_view + "2147483647", "accessor 1: has 2147483647 elements");
    described(R"("componentType":5126,"type":"VEC3","count":2147483647)",
              "accessor 1: has no bufferView for 2147483647");
    described(R"("bufferView":1,"componentType":5126,"type":"SCALAR","count":2)", "accessor 1: must be of type VEC3");
    described(R"("name":"path","bufferView":1,"componentType":5126,"type":"VEC4","count":1)", "accessor 1 'path'");
    const auto sparse = [&](const std::string& count, const std::string& indices) {
        return R"("componentType":5126,"type":"VEC3","count":2,"sparse":{"count":)" + count + R"(,"indices":)" +
               indices + R"(,"values":{"bufferView":1}})";
    };
    described(sparse("0", R"({"bufferView":0,"componentType":5123})"), "accessor 1: sparse: a count of 0");
    described(sparse("3", R"({"bufferView":0,"componentType":5123})"), "accessor 1: sparse: a count of 3");
    described(sparse("2", R"({"bufferView":0,"componentType":5126})"), "accessor 1: sparse: indices must be");
    described(sparse("2", R"({"bufferView":0,"componentType":5123})"), "accessor 1: sparse: index 1");
    described(sparse("2", R"({"bufferView":0,"byteOffset":6,"componentType":5123})"),
              "accessor 1: 2 elements do not fit");
}

TEST(GltfRefusal, NamesTheNode) {
    const GltfBytes bytes = mover();
    expect_refused(bytes.glb(R"([{"children":[1]},{"name":"a","children":[2]},{"children":[1]}])"), "node 1 'a'");
    expect_refused(bytes.glb(R"([{},{"children":[2]},{"children":[1]}])"), "node 1 'node1': is its own ancestor");
    expect_refused(bytes.glb(R"([{"children":[0]}])"), "node 0 'node0': is its own ancestor");
    expect_refused(bytes.glb(R"([{"children":[1]},{"children":[1]}])"), "node 1 'node1': is a child of both");
    expect_refused(bytes.glb(R"([{"rotation":[0,0,0,0]}])"), "node 0 'node0': its rotation");
    expect_refused(bytes.glb(R"([{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}])"), "node 0 'node0': is animated");
    expect_refused(bytes.glb(R"([{},{"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}])"), "node 1 'node1': its matrix");
}

TEST(GltfRefusal, SaysWhyAClipHasNoPath) {
    GltfBytes bytes;
    expect_refused(GltfBytes(mover()).text("[{}]", "").substr(0, 0), "GLB header");
    bytes.add_floats("SCALAR", {0, 1});
    expect_refused(bytes.glb("[{}]"), "holds no animation");
    bytes.channel("0", "weights", 0, 0).animation("smile");
    expect_refused(bytes.glb("[{}]"), "animation 'smile': moves morph targets only");
    GltfBytes twice = mover();
    twice.channel("0", "translation", 0, 1).channel("0", "translation", 0, 1).animation("double");
    expect_refused(twice.glb("[{}]"), "animation 'double': has two channels for 'translation' of node 0");
}

TEST(GltfRefusal, OfWhatCannotBeTextOrGlb) {
    const std::string good = mover().glb("[{}]");
    for (const std::size_t length : {0u, 3u, 11u, 12u, 19u, 21u, 40u}) gltf_refusal(good.substr(0, length));
    expect_refused(good.substr(0, good.size() - 1), "announces " + std::to_string(good.size()) + " bytes");
    const auto changed = [&](std::size_t at, char byte) {
        std::string bytes = good;
        bytes[at] = byte;
        return bytes;
    };
    expect_refused(changed(0, 'x'), "does not begin with 'glTF'");
    expect_refused(changed(4, 1), "is version 1");
    expect_refused(changed(13, 127), "GLB chunk 0: announces");
    expect_refused(changed(16, 'X'), "GLB chunk 0: the first chunk");
    expect_refused(changed(20, '!'), "JSON chunk, line 1, column 1");
    expect_refused("{\"asset\":\n{,}}", "line 2, column 2", "clip.gltf");
    expect_refused("[]", "is not a JSON object", "clip.gltf");
    expect_refused("{\"a\":1e999}", "JSON: ", "clip.gltf");
    expect_refused(std::string(1'000'000, '['), "JSON: nests more than", "clip.gltf");
    // What comes after the announced length is none of ours; an empty chunk is as good as none.
    EXPECT_NO_THROW(parse(good + "tail"));
}

TEST(GltfRefusal, OfLittleDataReadManyTimes) {
    GltfBytes bytes;
    std::vector<float> times(200'000);
    for (std::size_t i = 0; i < times.size(); ++i) times[i] = static_cast<float>(i);
    const int view = bytes.add_view(times);
    // Each accessor begins a little later, so that none is another.
    for (int i = 0; i < 2'000; ++i) {
        const int input =
            bytes.add_accessor("\"bufferView\":" + std::to_string(view) + ",\"byteOffset\":" + std::to_string(4 * i) +
                               R"(,"componentType":5126,"type":"SCALAR","count":150000)");
        bytes.channel("0", "weights", input, input).animation();
    }
    // 24 times 150,000 numbers are left to twice its 800,000 bytes and 2,000,000 more.
    expect_refused(bytes.glb("[{}]"), "accessor 24: has 150000 elements, more than the file's bytes can mean");
}

}  // namespace
}  // namespace mobbscope
