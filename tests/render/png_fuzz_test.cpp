// Damaged PNG files give a picture or an InputError, nothing else, and soon.
#include <render/image/png.h>

#include <base/error.h>
#include <support/mutate.h>
#include <support/png_file.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

struct PngChunk {
    std::string type;
    std::string data;
};

std::vector<PngChunk> chunks_of(const std::string& file) {
    std::vector<PngChunk> out;
    for (std::size_t at = testing::kPngSignature.size(); at < file.size();) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(file[at + i]);
        out.push_back({file.substr(at + 4, 4), file.substr(at + 8, size)});
        at += 12 + size;
    }
    return out;
}

/// Chunks are damaged within, left out, doubled or swapped; the sums are right all the same, and pixels well packed
/// half of the time.
std::string mutated_with_right_sums(const std::string& file, std::mt19937& random) {
    std::vector<PngChunk> chunks = chunks_of(file);
    const auto below = [&random](std::size_t limit) { return static_cast<std::size_t>(random() % limit); };
    for (std::size_t edits = 1 + below(3); edits > 0 && !chunks.empty(); --edits) {
        const std::size_t at = below(chunks.size());
        const auto place = chunks.begin() + static_cast<std::ptrdiff_t>(at);
        switch (below(8)) {
            case 0:
                chunks.erase(place);
                break;
            case 1:
                chunks.insert(place, PngChunk(chunks[at]));
                break;
            case 2:
                std::swap(chunks[at], chunks[below(chunks.size())]);
                break;
            case 3:
                chunks[at].type = testing::mutated(chunks[at].type, random).substr(0, 4);
                chunks[at].type.resize(4, 'x');
                break;
            case 4:
                if (chunks[at].type == "IDAT")
                    chunks[at].data = testing::packed(testing::mutated("\0\1\2\3\4", random));
                break;
            default:
                chunks[at].data = testing::mutated(chunks[at].data, random);
        }
    }
    std::string out(testing::kPngSignature);
    for (const PngChunk& chunk : chunks) out += png_chunk(chunk.type, chunk.data);
    return out;
}

TEST(PngFuzz, DamagedFilesAreReadOrRefused) {
    const std::string palette = png_chunk("PLTE", {1, 2, 3, 4, 5, 6, 7, 8, 9});
    const std::vector<std::string> seeds{
        testing::png_file({5, 3, 8, 6, false}, std::vector<int>(3 * 21, 0)),
        testing::png_file({5, 3, 8, 6, true}, std::vector<int>(5 * 3 * 4 + 9, 0)),
        testing::png_file({4, 2, 16, 2, false}, std::vector<int>(2 * 25, 1), png_chunk("tRNS", {0, 1, 0, 2, 0, 3})),
        testing::png_file({8, 2, 2, 3, false}, {0, 0x12, 0x01, 0, 0x21, 0x10}, palette + png_chunk("tRNS", {9, 8})),
        testing::png_file({8, 2, 1, 0, false}, {0, 0x55, 2, 0x33}, png_chunk("gAMA", {0, 0, 1, 2})),
        testing::png_file({2, 2, 8, 4, false}, {3, 1, 2, 3, 4, 4, 1, 2, 3, 4}, png_chunk("eXIf", {})),
    };
    const testing::TempFolder folder;
    std::mt19937 random(20240608);
    int read = 0;
    int refused = 0;
    for (std::size_t round = 0; round < 4000; ++round) {
        const std::string& seed = seeds[round % seeds.size()];
        const bool right_sums = round % 4 != 0;
        const auto file = folder.write(
            "fuzz.png", right_sums ? mutated_with_right_sums(seed, random) : testing::mutated(seed, random));
        try {
            const Image image = read_png(file);
            ASSERT_EQ(image.rgba.size(), 4u * static_cast<std::size_t>(image.width * image.height));
            ++read;
        } catch (const InputError& error) {
            const std::string_view why = error.what();
            ASSERT_TRUE(why.starts_with(file.string() + ": ")) << why;
            ASSERT_EQ(why.find('\n'), std::string_view::npos) << why;
            ++refused;
        }
    }
    EXPECT_GT(read, 300);
    EXPECT_GT(refused, 1500);
}

}  // namespace
}  // namespace mobbscope
