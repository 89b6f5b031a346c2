#include <render/image/png.h>

#include "support/input_error.h"
#include "support/png_file.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope {
namespace {

Image pattern() {
    Image image(17, 9);
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = static_cast<std::uint8_t>(i * 37);
    return image;
}

TEST(Png, WhatIsWrittenIsRead) {
    const testing::TempFolder folder;
    write_png(folder.path() / "a.png", pattern());
    const Image read = read_png(folder.path() / "a.png");
    EXPECT_EQ(read.width, 17);
    EXPECT_EQ(read.height, 9);
    EXPECT_EQ(read.rgba, pattern().rgba);
}

TEST(Png, NothingElseIsLeftBehind) {
    const testing::TempFolder folder;
    write_png(folder.path() / "a.png", pattern());
    write_png(folder.path() / "a.png", pattern());
    const std::filesystem::directory_iterator files(folder.path());
    EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(Png, TextsThatUnpackToMuchAreNotUnpacked) {
    const std::string text =
        testing::png_chunk("zTXt", std::string("k\0\0", 3) + testing::packed(std::string(7'000'000, 'a')));
    std::string texts;
    for (int i = 0; i < 100; ++i) texts += text;
    const std::string file = testing::png_file({}, {0, 1, 2, 3, 255, 4, 5, 6, 255}, texts);
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    EXPECT_EQ(read_png_bytes(file, "a.png").width, 2);
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 200'000);  // kB, of the 700'000
}

TEST(Png, WhatCannotBeWrittenIsTheMachines) {
    const testing::TempFolder folder;
    EXPECT_THROW(write_png(folder.path() / "none" / "a.png", pattern()), MachineError);
    EXPECT_THROW(write_png(folder.path(), pattern()), MachineError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, LinksAndRightsStay) {
    const testing::TempFolder folder;
    const auto target = folder.write("target.png", "old");
    ::chmod(target.c_str(), 0640);
    std::filesystem::create_symlink("target.png", folder.path() / "link.png");
    write_png(folder.path() / "link.png", pattern());
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.png"));
    EXPECT_EQ(read_png(target).rgba, pattern().rgba);
    struct stat status {};
    ::stat(target.c_str(), &status);
    EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(Png, APipeGetsTheBytesAndStays) {
    const testing::TempFolder folder;
    const auto pipe = folder.path() / "pipe.png";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = testing::slurp(pipe); });
    write_png(pipe, pattern());
    reader.join();
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    write_png(folder.path() / "a.png", pattern());
    EXPECT_EQ(received, testing::slurp(folder.path() / "a.png"));
}

TEST(Png, ADeviceStaysAndMayBeFull) {
    const testing::TempFolder folder;
    for (const std::string device : {"null", "full"}) {
        std::filesystem::create_symlink("/dev/" + device, folder.path() / (device + ".png"));
    }
    EXPECT_NO_THROW(write_png(folder.path() / "null.png", pattern()));
    EXPECT_THROW(write_png(folder.path() / "full.png", pattern()), MachineError);
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "null.png"));
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(Png, ANameThatIsTooLongIsTheMachines) {
    const testing::TempFolder folder;
    EXPECT_THROW(write_png(folder.path() / (std::string(300, 'a') + ".png"), pattern()), MachineError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, EveryKindOfPixelBecomesRgba) {
    struct Case {
        const char* name;
        std::string bytes;
        std::vector<std::uint8_t> rgba;
    };
    using testing::png_chunk;
    using testing::png_file;
    // Two pixels each.
    const std::vector<Case> cases{
        {"grey", png_file({.color = 0}, {0, 10, 200}), {10, 10, 10, 255, 200, 200, 200, 255}},
        {"grey of one bit", png_file({.bits = 1, .color = 0}, {0, 64}), {0, 0, 0, 255, 255, 255, 255, 255}},
        {"grey of 16 bits",
         png_file({.bits = 16, .color = 0}, {0, 10, 99, 200, 255}),
         {10, 10, 10, 255, 200, 200, 200, 255}},
        {"grey with opacity", png_file({.color = 4}, {0, 10, 20, 200, 0}), {10, 10, 10, 20, 200, 200, 200, 0}},
        {"16 bits",
         png_file({.bits = 16}, {0, 1, 9, 2, 9, 3, 9, 4, 9, 5, 0, 6, 0, 7, 0, 8, 0}),
         {1, 2, 3, 4, 5, 6, 7, 8}},
        {"palette with opacity",
         png_file({.color = 3}, {0, 1, 0}, png_chunk("PLTE", {1, 2, 3, 4, 5, 6}) + png_chunk("tRNS", {77})),
         {4, 5, 6, 255, 1, 2, 3, 77}},
        {"one colour transparent",
         png_file({.color = 2}, {0, 1, 2, 3, 4, 5, 6}, png_chunk("tRNS", {0, 4, 0, 5, 0, 6})),
         {1, 2, 3, 255, 4, 5, 6, 0}},
        {"interlaced", png_file({.interlaced = true}, {0, 1, 2, 3, 4, 0, 5, 6, 7, 8}), {1, 2, 3, 4, 5, 6, 7, 8}},
        {"with a gamma",
         png_file({}, {0, 100, 50, 20, 40, 5, 6, 7, 8}, png_chunk("gAMA", {0, 1, -122, -96})),
         {100, 50, 20, 40, 5, 6, 7, 8}},
    };
    const testing::TempFolder folder;
    for (const Case& one : cases) {
        SCOPED_TRACE(one.name);
        const Image image = read_png(folder.write("a.png", one.bytes));
        EXPECT_EQ(image.width, 2);
        EXPECT_EQ(image.height, 1);
        EXPECT_EQ(image.rgba, one.rgba);
    }
}

TEST(Png, WhatIsCutShortIsRefused) {
    const testing::TempFolder folder;
    write_png(folder.path() / "a.png", pattern());
    const std::string whole = testing::slurp(folder.path() / "a.png");
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const auto file = folder.write("b.png", whole.substr(0, size));
        EXPECT_NE(testing::input_error([&] { read_png(file); }).find("b.png: "), std::string::npos) << size;
    }
    EXPECT_EQ(read_png(folder.write("b.png", whole + "more")).rgba, pattern().rgba) << "what follows is not ours";
}

TEST(Png, EveryDamagedByteIsNoticed) {
    const testing::TempFolder folder;
    write_png(folder.path() / "a.png", pattern());
    const std::string whole = testing::slurp(folder.path() / "a.png");
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        const auto file = folder.write("b.png", damaged);
        EXPECT_NE(testing::input_error([&] { read_png(file); }).find("b.png: "), std::string::npos) << at;
    }
}

TEST(Png, WhatCannotBeReadIsSaidWithPlaceAndReason) {
    const testing::TempFolder folder;
    const auto refused = [&](const std::string& bytes, const std::string& why) {
        const std::string message = testing::input_error([&] { read_png(folder.write("a.png", bytes)); });
        EXPECT_NE(message.find("a.png: "), std::string::npos) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
    };
    using testing::png_header;
    refused(png_header({.width = 0, .height = 5}),
            "byte 33: the PNG picture cannot be read up to here: Image width is zero");
    refused(png_header({.width = 5, .height = 0}), "Image height is zero");
    refused(png_header({.color = 7}), "Invalid color type");
    // Before memory is taken.
    refused(png_header({.width = -1, .height = -1}), "PNG unsigned integer out of range");
    refused(png_header({.width = 20'000, .height = 20'000}) + testing::png_chunk("IDAT", ""), "20000x20000");
    refused(png_header({}), "cut short");
    refused(testing::png_file({}, {0, 1, 2, 3}), "Not enough image data");
    refused(testing::png_file({}, {9, 1, 2, 3, 4, 5, 6, 7, 8}), "bad adaptive filter value");
    refused(testing::png_file({.color = 3}, {0, 1, 0}), "Missing PLTE before IDAT");
    refused("no picture", "is not a PNG picture; give a .png file");
    refused("", "is not a PNG picture");
}

// stb_image refuses this without a reason, and what it refused before lends its reason: a test of its own.
TEST(Png, PackedBytesOfNoKindAreRefused) {
    const testing::TempFolder folder;
    const std::string reserved_block = testing::png_chunk("IDAT", {0x78, 0x01, 0x07});
    const auto file = folder.write("a.png", testing::png_header({}) + reserved_block + testing::png_chunk("IEND", ""));
    const std::string message = testing::input_error([&] { read_png(file); });
    EXPECT_NE(message.find("invalid block type"), std::string::npos) << message;
}

TEST(Png, AFileThatIsNotThereIsNamed) {
    const testing::TempFolder folder;
    EXPECT_NE(testing::input_error([&] { read_png(folder.path() / "b.png"); }).find("b.png"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
