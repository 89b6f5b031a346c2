// Damaged glTF files give clips or an InputError, nothing else, and soon.
#include "gltf_bytes.h"

#include <base/error.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion_clips.h>
#include <support/folders.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <array>

namespace mobbscope {
namespace {

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
    const GltfBytes bytes = everything_in_gltf();
    const std::string json = bytes.text(kEverythingNodes, kEverythingSkins);
    Outcomes outcomes;
    for (int round = 0; round < 12'000; ++round) {
        // The container stays whole, so that the damage gets past its checks.
        const std::string damaged = round % 2 == 0 ? mutated(json, random) : nudged(json, random);
        try_to_read(join_glb(damaged, bytes.binary()), "fuzz.glb", outcomes);
    }
    EXPECT_GT(outcomes.read, 300);
    EXPECT_GT(outcomes.refused, 1000);
}

TEST(GltfFuzz, DamagedFilesAreReadOrRefused) {
    std::mt19937 random(20250303);
    const GltfBytes bytes = everything_in_gltf();
    const std::string data = "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=";
    const std::array seeds{
        slurp(kClips / "stand.glb"),
        bytes.glb(kEverythingNodes, kEverythingSkins),
        GltfBytes(bytes).text(kEverythingNodes, "", data),
    };
    Outcomes outcomes;
    for (int round = 0; round < 6'000; ++round) {
        const std::string& seed = seeds[static_cast<std::size_t>(round) % seeds.size()];
        const std::string damaged = round % 4 < 2 ? mutated(seed, random) : nudged(seed, random);
        try_to_read(damaged, round % 3 == 2 ? "fuzz.gltf" : "fuzz.glb", outcomes);
    }
    EXPECT_GT(outcomes.read, 500);
    EXPECT_GT(outcomes.refused, 500);
}

TEST(GltfFuzz, EveryTruncationIsRefused) {
    const std::string bytes = everything_in_gltf().glb(kEverythingNodes);
    Outcomes outcomes;
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        try_to_read(bytes.substr(0, length), "fuzz.glb", outcomes);
    }
    EXPECT_EQ(outcomes.read, 0);
}

}  // namespace
}  // namespace mobbscope
