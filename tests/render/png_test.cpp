#include <render/png.h>

#include "support/input_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

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

TEST(Png, WhatIsNoPictureIsRefused) {
    const testing::TempFolder folder;
    const auto file = folder.write("a.png", "no picture");
    EXPECT_NE(testing::input_error([&] { read_png(file); }).find("a.png"), std::string::npos);
    EXPECT_NE(testing::input_error([&] { read_png(folder.path() / "b.png"); }).find("b.png"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
