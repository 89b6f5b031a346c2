// A run whose seed was edited: pictures of its choices say that they do not come out as the file says.
#include "run_program.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mobbscope {
namespace {

TEST(EditedRun, IsToldByThePictureOfAChoice) {
    const TempFolder folder;
    const std::filesystem::path walkers = kClips;
    const std::string run = (folder.path() / "run.json").string();
    ASSERT_EQ(run_program({"simulate", walkers.string(), "--whole", "--agents", "6", "--area", "30x30", "--seconds",
                           "14", "--seed", "1", "--inline", "-o", run})
                  .status,
              0);
    std::string text = slurp(run);
    const std::size_t seed = text.find("\"seed\": 1");
    ASSERT_NE(seed, std::string::npos);
    const std::string edited = folder.write("edited.json", text.replace(seed, 9, "\"seed\": 7"));
    const std::string out = (folder.path() / "list.json").string();
    int told = 0;
    for (const std::string agent : {"1", "2", "3", "4", "5", "6"}) {
        const auto draw = [&](const std::string& file) {
            return run_program({"render", file, "--time", "12", "--follow", agent, "--draw-list", out});
        };
        EXPECT_EQ(draw(run).err, "") << "as it was simulated";
        const Result result = draw(edited);
        EXPECT_EQ(result.status, 0);
        if (result.err.empty()) continue;
        ++told;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_NE(result.err.find("edited.json: " + agent + " plays "), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(": seed, grace, plays or clips were edited since, another version simulated it, or "
                                  "an answer was wrong"),
                  std::string::npos);
        EXPECT_NE(slurp(out).find("made again the choice is"), std::string::npos) << "in the caption";
    }
    EXPECT_GT(told, 0);
}

}  // namespace
}  // namespace mobbscope
