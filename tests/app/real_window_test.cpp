// The real window, on a virtual display.
#include <render/png.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using testing::slurp;
using testing::TempFolder;

const std::string kHere = MOBBSCOPE_SOURCE_DIR "/tests/app/";
constexpr int kLacking = 77;

/// The exit status of a command line on a virtual display.
int under_xvfb(const std::string& command) {
    const int status = std::system(("'" + kHere + "under_xvfb.sh' " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(RealWindow, RunsAScript) {
    const TempFolder folder;
    const std::string picture = folder.path() / "window.png";
    const std::string script = folder.write(
        "a.script", "size 900x600\nexpect /title \"crossing\"\ndrag splitter.left 40 0\npicture " + picture + "\n");
    const int status = under_xvfb("'" MOBBSCOPE_PROGRAM "' --script '" + script + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb";
    ASSERT_EQ(status, 0);
    const Image image = read_png(picture);
    EXPECT_EQ(image.width, 900);
    EXPECT_EQ(image.height, 600);
}

TEST(RealWindow, AnExpectationThatFailsIsStatusOne) {
    const TempFolder folder;
    const std::string script = folder.write("a.script", "expect /title \"no\"\n");
    const int status = under_xvfb("'" MOBBSCOPE_PROGRAM "' --script '" + script + "' 2>/dev/null");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb";
    EXPECT_EQ(status, 1);
}

TEST(RealWindow, FollowsTheDisplaysMouse) {
    const TempFolder folder;
    const int status =
        under_xvfb("'" + kHere + "real_input.sh' '" MOBBSCOPE_PROGRAM "' '" + folder.path().string() + "'");
    if (status == kLacking) GTEST_SKIP() << "there is no Xvfb or no xdotool";
    ASSERT_EQ(status, 0);
    // The left border before and after, as the script printed it.
    std::istringstream out(slurp(folder.path() / "marks.txt"));
    std::vector<double> left;
    for (std::string line; std::getline(out, line);) {
        if (line.starts_with("splitter.left ")) left.push_back(std::stod(line.substr(14)));
    }
    ASSERT_EQ(left.size(), 2u);
    EXPECT_NEAR(left[1] - left[0], 60, 2);
}

}  // namespace
}  // namespace mobbscope
