/// What tests of `render` have in common.
#pragma once

#include "run_program.h"

#include <render/image/png.h>
#include <support/temp_folder.h>

#include "render/backends.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// Two who walk for 1.5 seconds, one of them a second later.
inline std::string short_scene(const TempFolder& folder) {
    return folder.write(
        "s.json",
        R"({"clips": {"c": {"dt": 0.5, "motion": "linear", "samples": [[0,0,0.4],[1,0,0.4],[2,0,0.4],[3,0,0.4]]}},
        "agents": [{"name": "A", "clip": "c"}, {"name": "B", "clip": "c", "translate": [0, 3], "start": 1}]})");
}

/// A person who stands for a moment: the least that everything is drawn of.
inline constexpr const char* kStandingScene =
    R"({"mobbscope": 1, "clips": {"p": {"dt": 1, "samples": [[0, 0, 0.4], [0.1, 0, 0.4]]}}, "agents": [{"name": "A", "clip": "p"}]})";

/// The arguments of small pictures: "render", then those given.
inline Result render_small(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "render");
    arguments.insert(arguments.end(), {"--size", "320x240"});
    return run_program(arguments);
}

using Names = std::set<std::string>;

inline Names files_in(const std::filesystem::path& folder) {
    Names out;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) out.insert(entry.path().filename());
    return out;
}

/// Draws, which needs a context.
class DrawingTest : public ::testing::Test {
  protected:
    void SetUp() override { has_or_skip(Backend::automatic); }

    const TempFolder folder;

    /// The picture that a run wrote without a word.
    Image picture(const std::vector<std::string>& arguments) {
        const std::string out = folder.path() / "picture.png";
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"-o", out});
        const Result run = render_small(all);
        EXPECT_EQ(run.status, 0) << run.err;
        EXPECT_EQ(run.out + run.err, "");
        const Image image = run.status == 0 ? read_png(out) : Image();
        std::filesystem::remove(out);
        return image;
    }
};

}  // namespace testing
}  // namespace mobbscope
