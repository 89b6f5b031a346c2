// Damaged glTF files give clips or an InputError, nothing else, and soon.
#include "gltf_bytes.h"

#include <base/error.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion_clips.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <array>

namespace mobbscope {
namespace {

/// A bit of everything: all interpolations, integers, sparse and interleaved elements, skins, morph targets, pointers.
testing::GltfBytes everything() {
    testing::GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 0.5F, 1});
    const int places = bytes.add_floats("VEC3", {0, 1, 0, 1, 1, 0, 2, 1, 0});
    const std::vector<std::int16_t> turns{0, 0, 0, 32767, 0, 23170, 0, 23170, 0, 32767, 0, 0};
    const int rotations = bytes.add("VEC4", 5122, turns, ",\"normalized\":true");
    const int splines = bytes.add_floats("VEC3", std::vector<float>(27, 0.5F));
    const int indices = bytes.add_view(std::vector<std::uint8_t>{0, 2});
    const int values = bytes.add_view(std::vector<float>{0, 1, 0, 0, 2, 0}, ",\"byteStride\":12");
    const int sparse = bytes.add_accessor(
        R"("componentType":5126,"count":3,"type":"VEC3","sparse":{"count":2,"indices":{"bufferView":)" +
        std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" + std::to_string(values) + "}}");
    bytes.channel("1", "translation", times, places).channel("1", "rotation", times, rotations);
    bytes.channel("2", "translation", times, splines, "CUBICSPLINE").channel("2", "scale", times, sparse, "STEP");
    bytes.channel("0", "weights", times, times).pointer_channel("/nodes/0/translation", times, places);
    bytes.pointer_channel("/nodes/2/weights/0", times, times).pointer_channel("/materials/0/alphaCutoff", times, times);
    bytes.animation("walk");
    return bytes;
}

const std::string kNodes =
    R"([{"children":[1],"scale":[1,1,1],"rotation":[0,0,0,1]},{"name":"hips","children":[2,3]},)"
    R"({"name":"hand","translation":[0.3,0,0]},{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0.1,0.2,0.3,1]}])";

const std::string kSkins = R"(,"skins":[{"joints":[2]},{"joints":[1,2],"skeleton":0},{"joints":[3]}])";

/// One byte, or a number in the text, is another.
std::string nudged(std::string bytes, std::mt19937& random) {
    for (int edits = 1 + static_cast<int>(random() % 3); edits > 0; --edits) {
        std::size_t at = random() % bytes.size();
        if (random() % 2 == 0) {
            static constexpr std::array kNumbers{"0", "1", "2", "7", "99", "1e9", "-1", "4294967295", "0.5", "1e308"};
            at = bytes.find_first_of("0123456789", at);
            if (at == std::string::npos) continue;
            bytes.replace(at, 1, kNumbers[random() % kNumbers.size()]);
        } else {
            bytes[at] = static_cast<char>(random());
        }
    }
    return bytes;
}

struct Outcomes {
    int read = 0;
    int refused = 0;
};

void try_to_read(const std::string& bytes, const std::string& name, Outcomes& outcomes) {
    try {
        ImportOptions options;
        options.fps = 10;
        motion_clips(parse_gltf(bytes, name), name, options);
        ++outcomes.read;
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        ASSERT_TRUE(message.starts_with(name + ": ")) << message;
        ASSERT_EQ(message.find('\n'), std::string_view::npos) << message;
        ++outcomes.refused;
    }
}

TEST(GltfFuzz, DamagedTextIsReadOrRefused) {
    std::mt19937 random(20250302);
    const testing::GltfBytes bytes = everything();
    const std::string json = bytes.json(kNodes, kSkins);
    Outcomes outcomes;
    for (int round = 0; round < 12'000; ++round) {
        // The container stays whole, so that the damage gets past its checks.
        const std::string damaged = round % 2 == 0 ? testing::mutated(json, random) : nudged(json, random);
        try_to_read(testing::join_glb(damaged, bytes.binary()), "fuzz.glb", outcomes);
    }
    EXPECT_GT(outcomes.read, 300);
    EXPECT_GT(outcomes.refused, 1000);
}

TEST(GltfFuzz, DamagedFilesAreReadOrRefused) {
    std::mt19937 random(20250303);
    const testing::GltfBytes bytes = everything();
    const std::string data = "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=";
    const std::array seeds{
        testing::slurp(std::filesystem::path(MOBBSCOPE_SOURCE_DIR) / "assets/clips/stand.glb"),
        bytes.glb(kNodes, kSkins),
        testing::GltfBytes(bytes).json(kNodes, "", data),
    };
    Outcomes outcomes;
    for (int round = 0; round < 6'000; ++round) {
        const std::string& seed = seeds[static_cast<std::size_t>(round) % seeds.size()];
        const std::string damaged = round % 4 < 2 ? testing::mutated(seed, random) : nudged(seed, random);
        try_to_read(damaged, round % 3 == 2 ? "fuzz.gltf" : "fuzz.glb", outcomes);
    }
    EXPECT_GT(outcomes.read, 500);
    EXPECT_GT(outcomes.refused, 500);
}

TEST(GltfFuzz, EveryTruncationIsRefused) {
    const std::string bytes = everything().glb(kNodes);
    Outcomes outcomes;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        try_to_read(bytes.substr(0, length), "fuzz.glb", outcomes);
    }
    EXPECT_EQ(outcomes.read, 0);
}

}  // namespace
}  // namespace mobbscope
