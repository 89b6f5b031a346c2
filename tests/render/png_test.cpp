#include <render/png.h>

#include "support/input_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>
#include <thread>

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

TEST(Png, WhatIsNoPictureIsRefused) {
    const testing::TempFolder folder;
    const auto file = folder.write("a.png", "no picture");
    EXPECT_NE(testing::input_error([&] { read_png(file); }).find("a.png"), std::string::npos);
    EXPECT_NE(testing::input_error([&] { read_png(folder.path() / "b.png"); }).find("b.png"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
