// Damaged trajectory files give clips or an InputError, nothing else, and soon; and never much more than they hold.
#include <base/error.h>
#include <import/tracks/mapf_plan.h>
#include <import/tracks/text_rows.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

using Parser = TrackFile (*)(std::string_view, const std::string&);

/// Reads damaged copies of each seed in turn.
void fuzz(Parser parse, const std::vector<std::string>& seeds, int rounds) {
    std::mt19937 random(20240608);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::string text = mutated(seeds[static_cast<std::size_t>(round) % seeds.size()], random);
        ImportOptions options;
        if (round % 7 == 0) options.dt = 0.1;
        if (round % 5 == 0) options.trim = {0.05, 0.4};
        if (round % 5 == 1) options.origin = Origin::start_heading;
        if (round % 11 == 0) options.unit = "cm";
        try {
            std::size_t samples = 0;
            for (const ImportedClip& clip : track_clips(parse(text, "fuzz"), "fuzz", options))
                samples += static_cast<std::size_t>(clip.clip->count());
            ASSERT_LE(samples, 10'000 + 100 * text.size()) << text;
            ++read;
        } catch (const InputError& error) {
            ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, rounds / 40);
    EXPECT_GT(refused, rounds / 30);
}

TEST(TrajectoryFuzz, DamagedTextIsReadOrRefused) {
    fuzz([](std::string_view text, const std::string& file) { return parse_text_tracks(text, file); },
         {"1.0e+00 1.0e+00 -2.5 0.0 18.5 0.0 0.0 -1.3\n1.1e+01 1.0e+00 -2.5 0.0 18.0 0.0 0.0 -1.3\n",
          "10 1 1.5 2\n20 1 1.5 2.5\n20 2 0 0\n30\t2\t0\t1\n",
          "#framerate: 16 fps\r\n# ID frame X/m Y/m Z/m\r\n3 8 0 0 1.7\r\n3 9 0.5 0 1.7\r\n4 16 1 1 1.8\r\n",
          "#ID: the agent ID\n#framerate: 8.00\n#X,Y: (in "
          "metres)\n#ID\tFR\tX\tY\tZ\tA\tB\tANGLE\tCOLOR\n1\t0\t0.5\t0\t0\t0.1\t0.2\t0\t9\t\n1\t1\t0.6\t0\t0\t0.1\t0."
          "2\t0\t9\t\n",
          "1 43 100 200 183\n1 44 110 200 183\n2 43 0 0 165\n2 46 0 10 165\n",
          "0 10 20 30 60 5 0 0 0 \"Pedestrian\"\n0 12 20 32 60 6 0 0 1 \"Golf Cart\"\n0 0 0 0 0 7 1 0 1 \"Bus\"\n"},
         50'000);
}

TEST(TrajectoryFuzz, DamagedJsonLinesAreReadOrRefused) {
    fuzz(parse_trajnetpp, {R"({"scene": {"id": 0, "p": 1, "s": 1, "e": 21, "fps": 2.5, "tag": [1, []]}}
{"track": {"f": 1, "p": 1, "x": -0.5, "y": 2}}
{"track": {"f": 11, "p": 1, "x": 0.5, "y": 2, "prediction_number": null}}
{"track": {"f": 11, "p": "late", "x": 0, "y": 0}}
)"},
         20'000);
}

TEST(TrajectoryFuzz, DamagedPlansAreReadOrRefused) {
    fuzz(parse_mapf_plan,
         {"cost: 9\nschedule:\n  agent0:\n  - t: 0\n    x: 0\n    y: 0\n  - t: 1\n    x: 1\n    y: 0\n",
          "schedule: {a: [{t: 0, x: 1, y: 2}, &p {t: 1, x: 1, y: 2}], \"b\": [*p], ? c : [{t: 1.5, x: -1, y: .5}]}\n",
          "%YAML 1.2\n---\n# plan\nschedule: !!map\n  'a': |\n    text\n  b: >-\n    text\n"},
         20'000);
}

TEST(TrajectoryFuzz, DamagedTextPlansAreReadOrRefused) {
    fuzz(parse_mapf_text_plan,
         {"agents=2\nsolver=planner\nsolution=\n0:(5,6),(1,2),\n1:(6,6),(1,3),\n", "0:(5,6),(1,2),\n1:(6,6),(1,3),\n",
          "0:(5,6)->(9,9):0,(1,2)->(1,2):-1,\n1:(6,6)->(9,9):0,(1,3)->(1,2):-1,\n",
          "Agent 0: (6,5)->(6,6)->\nAgent 1: (2,1)->(3,1)->\n", "2\n12,13,14,\n7,7,7,\n"},
         50'000);
}

}  // namespace
}  // namespace mobbscope
