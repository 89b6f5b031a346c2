#include <render/png.h>

#include "support/input_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <initializer_list>
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

/// One chunk of a PNG file; its sum as zlib counts it.
std::string chunk(const std::string& type, const std::string& data, unsigned sum) {
    const auto number = [](std::size_t value) {
        std::string out;
        for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 255u);
        return out;
    };
    return number(data.size()) + type + data + number(sum);
}

TEST(Png, EveryKindOfPixelBecomesRgba) {
    struct Kind {
        const char* name;
        std::string bytes;
        std::vector<std::uint8_t> rgba;
    };
    const std::string signature = "\x89PNG\r\n\x1a\n";
    const std::string end = chunk("IEND", "", 0xAE426082u);
    const auto bytes = [](std::initializer_list<int> list) {
        std::string out;
        for (const int b : list) out += static_cast<char>(b);
        return out;
    };
    // Two pixels each, stored without compression; from zlib and its crc32.
    const std::vector<Kind> kinds{
        {"grey",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 8, 0, 0, 0, 0}), 0xD1492056u) +
             chunk("IDAT", bytes({120, 1, 1, 3, 0, 252, 255, 0, 10, 200, 0, 223, 0, 211}), 0x3EB71A2Eu) + end,
         {10, 10, 10, 255, 200, 200, 200, 255}},
        {"grey of one bit",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 1, 0, 0, 0, 0}), 0xDC594227u) +
             chunk("IDAT", bytes({120, 1, 1, 2, 0, 253, 255, 0, 64, 0, 66, 0, 65}), 0x20B099CBu) + end,
         {0, 0, 0, 255, 255, 255, 255, 255}},
        {"grey of 16 bits",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 16, 0, 0, 0, 0}), 0x81D9FC15u) +
             chunk("IDAT", bytes({120, 1, 1, 5, 0, 250, 255, 0, 10, 99, 200, 1, 2, 231, 1, 55}), 0x59F3027Cu) + end,
         {10, 10, 10, 255, 200, 200, 200, 255}},
        {"grey with opacity",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 8, 4, 0, 0, 0}), 0x5E2BB701u) +
             chunk("IDAT", bytes({120, 1, 1, 5, 0, 250, 255, 0, 10, 20, 200, 0, 1, 249, 0, 231}), 0xD6990768u) + end,
         {10, 10, 10, 20, 200, 200, 200, 0}},
        {"16 bits",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 16, 6, 0, 0, 0}), 0xA4B2A3C9u) +
             chunk("IDAT", bytes({120, 1, 1, 17, 0, 238, 255, 0, 1, 9, 2, 9,   3, 9,
                                  4,   9, 5, 0,  6, 0,   7,   0, 8, 0, 2, 177, 0, 73}),
                   0x654FA513u) +
             end,
         {1, 2, 3, 4, 5, 6, 7, 8}},
        {"palette with opacity",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 8, 3, 0, 0, 0}), 0xC3FC8FB8u) +
             chunk("PLTE", bytes({1, 2, 3, 4, 5, 6}), 0x95536F48u) + chunk("tRNS", bytes({77}), 0x488BE54Bu) +
             chunk("IDAT", bytes({120, 1, 1, 3, 0, 252, 255, 0, 1, 0, 0, 5, 0, 2}), 0xFCDF1B53u) + end,
         {4, 5, 6, 255, 1, 2, 3, 77}},
        {"one colour transparent",
         signature + chunk("IHDR", bytes({0, 0, 0, 2, 0, 0, 0, 1, 8, 2, 0, 0, 0}), 0x7B40E8DDu) +
             chunk("tRNS", bytes({0, 4, 0, 5, 0, 6}), 0x748EC68Fu) +
             chunk("IDAT", bytes({120, 1, 1, 7, 0, 248, 255, 0, 1, 2, 3, 4, 5, 6, 0, 63, 0, 22}), 0x68415F8Du) + end,
         {1, 2, 3, 255, 4, 5, 6, 0}},
    };
    const testing::TempFolder folder;
    for (const Kind& kind : kinds) {
        const Image image = read_png(folder.write("a.png", kind.bytes));
        EXPECT_EQ(image.width, 2) << kind.name;
        EXPECT_EQ(image.height, 1) << kind.name;
        EXPECT_EQ(image.rgba, kind.rgba) << kind.name;
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

TEST(Png, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
    const testing::TempFolder folder;
    const auto refused = [&](const std::string& header, unsigned sum, const std::string& why) {
        const auto file = folder.write("a.png", "\x89PNG\r\n\x1a\n" + chunk("IHDR", header, sum));
        EXPECT_NE(testing::input_error([&] { read_png(file); }).find(why), std::string::npos);
    };
    refused(std::string("\x00\x00\x00\x00\x00\x00\x00\x05\x08\x06\x00\x00\x00", 13), 0x6B46EDA1u, "no pixels");
    refused(std::string("\x00\x00\x00\x05\x00\x00\x00\x00\x08\x06\x00\x00\x00", 13), 0xDDA2B756u, "no pixels");
    refused(std::string("\xff\xff\xff\xff\xff\xff\xff\xff\x08\x06\x00\x00\x00", 13), 0xD2F62E3Eu, "too large");
    refused(std::string("\x00\x00\x4e\x20\x00\x00\x4e\x20\x08\x06\x00\x00\x00", 13), 0xE3704639u, "20000x20000");
    refused(std::string("\x00\x00\x00\x02\x00\x00\x00\x01\x08\x06\x00\x00\x00", 13), 0xF4227F8Au, "cut short");
}

TEST(Png, WhatIsNoPictureIsRefused) {
    const testing::TempFolder folder;
    const auto file = folder.write("a.png", "no picture");
    EXPECT_NE(testing::input_error([&] { read_png(file); }).find("a.png"), std::string::npos);
    EXPECT_NE(testing::input_error([&] { read_png(folder.path() / "b.png"); }).find("b.png"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
