// What nobody does: jumps, pauses, places of who is lost, units and clocks that make no walk. Each is named and
// counted.
#include "imported.h"

#include <import/import.h>
#include <import/tracks/sanity.h>
#include <import/tracks/text_rows.h>
#include <mobb/random_motion.h>
#include <support/folders.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Where somebody is at a time in seconds.
struct Spot {
    double x = 0, y = 0;
};
using Walk = std::function<Spot(double)>;

/// A row every tenth of a second from `from` to `to`.
std::string rows_of_walk(const std::string& id, double from, double to, const Walk& walk) {
    std::string out;
    for (int i = 0; i <= std::lround((to - from) * 10); ++i) {
        const double t = from + i * 0.1;
        const Spot at = walk(t - from);
        out += id + ',' + formatted("%.1f,%.6g,%.6g\n", t, at.x, at.y);
    }
    return out;
}

const std::string kSanityHead = "id,t,x,y\n";

Walk along_x(double x, double y, double speed = 1) {
    return [=](double t) { return Spot{x + speed * t, y}; };
}

std::set<std::string> ids_of(const std::vector<ImportedClip>& clips) {
    std::set<std::string> out;
    for (const ImportedClip& clip : clips) out.insert(clip.id);
    return out;
}

const ImportWarning* finding(const ImportedClip& clip, const std::string& words) {
    for (const ImportWarning& warning : clip.facts.warnings) {
        if (warning.text.find(words) != std::string::npos) return &warning;
    }
    return nullptr;
}

ImportOptions keeping_jumps() {
    ImportOptions options;
    options.keep_jumps = true;
    return options;
}

TEST(Sanity, APauseSplitsATrackAndAShortGapDoesNot) {
    for (const double pause : {6.0, 60.0, 600.0}) {
        const std::string text = kSanityHead + rows_of_walk("17", 0, 4, along_x(0, 0)) +
                                 rows_of_walk("17", 4 + pause, 8 + pause, along_x(96, 0));
        const auto read = csv_clips(text);
        ASSERT_EQ(ids_of(read), (std::set<std::string>{"17", "17#2"})) << pause;
        EXPECT_EQ(read[0].clip->count(), 41);
        EXPECT_NEAR(read[1].start, 4 + pause, 1e-9);
        EXPECT_TRUE(read[1].facts.invented.empty());
        const ImportWarning* said = finding(read[0], "1 pause is longer than 5 s");
        ASSERT_NE(said, nullptr);
        EXPECT_EQ(said->line, 43);
        EXPECT_NE(said->text.find("track '17', which goes on 92 m off"), std::string::npos) << said->text;
        EXPECT_NE(said->text.find("give keep_jumps"), std::string::npos);
        ImportOptions second;
        second.id = "17#2";
        EXPECT_EQ(csv_clips(text, second).at(0).start, read[1].start);
        const auto whole = csv_clips(text, keeping_jumps());
        ASSERT_EQ(whole.size(), 1u);
        EXPECT_EQ(whole[0].clip->count(), 82 + std::lround(pause * 10) - 1) << "the gap is filled";
        ASSERT_EQ(whole[0].facts.invented.size(), 1u);
        EXPECT_NEAR(whole[0].facts.invented[0].first, 4, 1e-9);
        EXPECT_NEAR(whole[0].facts.invented[0].second, 4 + pause, 1e-9);
    }
    const auto gap =
        csv_clips(kSanityHead + rows_of_walk("a", 0, 4, along_x(0, 0)) + rows_of_walk("a", 6, 8, along_x(6, 0)));
    ASSERT_EQ(gap.size(), 1u);
    ASSERT_EQ(gap[0].facts.invented.size(), 1u) << "filled, and said to be";
    // 20 steps of two seconds are longer than five seconds.
    std::string slow = kSanityHead;
    for (const int t : {0, 2, 4, 6, 40, 42, 44}) slow += "a," + std::to_string(t) + ',' + std::to_string(t) + ",0\n";
    EXPECT_EQ(csv_clips(slow).size(), 1u);
    for (const int t : {90, 92, 94}) slow += "a," + std::to_string(t) + ',' + std::to_string(t) + ",0\n";
    EXPECT_EQ(csv_clips(slow).size(), 2u);
}

TEST(Sanity, AJumpSplitsATrackWhereItsClassCannotMakeIt) {
    for (const double far : {3.0, 30.0, 300.0}) {
        const std::string text =
            kSanityHead + rows_of_walk("a", 0, 4, along_x(0, 0)) + rows_of_walk("a", 4.1, 8, along_x(4 + far, 1));
        const auto read = csv_clips(text);
        ASSERT_EQ(ids_of(read), (std::set<std::string>{"a", "a#2"})) << far;
        const ImportWarning* said = finding(read[1], "1 jump is faster than its class can be");
        ASSERT_NE(said, nullptr);
        EXPECT_EQ(said->line, 43);
        EXPECT_EQ(said->option, "keep_jumps");
        const auto whole = csv_clips(text, keeping_jumps());
        ASSERT_EQ(whole.size(), 1u);
        ASSERT_EQ(whole[0].facts.invented.size(), 1u);
        EXPECT_NEAR(whole[0].facts.invented[0].first, 4, 1e-9);
    }
    // Two who swap their ids come out as four who walk on.
    const auto swapped =
        csv_clips(kSanityHead + rows_of_walk("a", 0, 4, along_x(0, 0)) + rows_of_walk("b", 0, 4, along_x(0, 20)) +
                  rows_of_walk("a", 4.1, 8, along_x(4.1, 20)) + rows_of_walk("b", 4.1, 8, along_x(4.1, 0)));
    EXPECT_EQ(ids_of(swapped), (std::set<std::string>{"a", "a#2", "b", "b#2"}));
    ASSERT_NE(finding(swapped[0], "2 jumps are"), nullptr);
}

/// Each kind with a seed; nobody is split, and where the ways are `far` apart who swap ids still are.
struct Tracker {
    const char* name;
    double dt, noise;   ///< seconds, metres
    int held = 0;       ///< rows that it stands still once in a while, and then catches up
    double far = 5;     ///< metres
    double to_row = 0;  ///< rows between places that it knows
};

std::string tracked(const Tracker& by, bool swaps) {
    mobb::test::Random random(11);
    const auto normal = [&random] {
        double sum = -6;
        for (int i = 0; i < 12; ++i) sum += random.real(0, 1);
        return sum;
    };
    std::string rows = "id,t,x,y\n";
    constexpr int kPairs = 25, kRows = 200;
    for (int pair = 0; pair < kPairs; ++pair) {
        std::vector<Spot> ways[2];
        for (int who = 0; who < 2; ++who) {
            const double heading = random.real(0, 6), turn = random.real(-0.1, 0.1), speed = random.real(0.7, 1.7);
            Spot at{random.real(0, 50), 500.0 * pair + who * (by.far + kRows * by.dt * 4)};
            if (swaps) at = {0, 500.0 * pair};
            int held = 0;
            for (int i = 0; i < kRows; ++i) {
                const double way = heading + turn * i * by.dt;
                at = {at.x + speed * by.dt * std::cos(way), at.y + speed * by.dt * std::sin(way)};
                const bool near_swap = std::abs(i - kRows / 2) <= 2 * by.held;
                if (by.held > 0 && held == 0 && !near_swap && random.integer(0, 40) == 0)
                    held = random.integer(2, by.held);
                const bool stands = i > 0 && (held > 0 || (by.to_row > 0 && std::fmod(i, by.to_row) != 0));
                if (held > 0) --held;
                ways[who].push_back(stands ? ways[who].back()
                                           : Spot{at.x + by.noise * normal(), at.y + by.noise * normal()});
            }
        }
        if (swaps) {
            // The other comes by far enough to the right of where the one is then.
            const Spot a = ways[0][kRows / 2], b = ways[1][kRows / 2];
            for (Spot& at : ways[1]) at = {at.x + a.x - b.x + by.far, at.y + a.y - b.y};
            std::swap_ranges(ways[0].begin() + kRows / 2, ways[0].end(), ways[1].begin() + kRows / 2);
        }
        for (int who = 0; who < 2; ++who) {
            for (int i = 0; i < kRows; ++i) {
                const Spot at = ways[who][static_cast<std::size_t>(i)];
                rows += formatted("%d,%.3f,%.3f,%.3f\n", 2 * pair + who, i * by.dt, at.x, at.y);
            }
        }
    }
    return rows;
}

TEST(Sanity, NoiseAndTrackersThatCatchUpSplitNobodyAndSwappedIdsAreSplit) {
    const Tracker trackers[] = {{"clean", 0.1, 0.01},
                                {"0.2 m", 0.1, 0.2},
                                {"0.2 m at 25 Hz", 0.04, 0.2},
                                {"radio tags", 0.02, 0.3, 0, 8},
                                {"satellites, 1 m", 1, 1, 0, 40},
                                {"satellites, 3 m", 1, 3, 0, 90},
                                {"satellites, each place ten times", 0.1, 2, 0, 120, 10},
                                {"frozen", 0.04, 0.01, 30, 20},
                                {"frozen at 10 Hz", 0.1, 0.02, 15, 20},
                                {"six rows a place", 0.04, 0.05, 0, 8, 6}};
    for (const Tracker& by : trackers) {
        const auto whole = csv_clips(tracked(by, false));
        EXPECT_EQ(whole.size(), 50u) << by.name;
        for (const ImportedClip& clip : whole) {
            EXPECT_EQ(finding(clip, "row is left out"), nullptr) << by.name;
            EXPECT_EQ(clip.facts.doubt, "") << by.name;
        }
        // What is too fast in single steps is told, and marked.
        if (by.held > 0 || (by.noise >= 0.2 && by.dt < 0.1)) {
            EXPECT_NE(finding(whole[0], "faster than its class can be, the worst"), nullptr) << by.name;
            const auto is_marked = [](const ImportedClip& clip) { return !clip.facts.invented.empty(); };
            EXPECT_TRUE(std::ranges::any_of(whole, is_marked)) << by.name;
        }
        const auto split = csv_clips(tracked(by, true));
        // Of who is seen every tenth row alone it is seen in the next one.
        EXPECT_EQ(split.size(), 100u) << by.name;
    }
    // A row far off in noise is named; more of them too, and none splits anybody.
    mobb::test::Random random(3);
    std::string rows = kSanityHead;
    for (int i = 0; i < 200; ++i) {
        const double off = i % 50 == 20 ? 12 : i % 50 == 21 ? -9 : 0;
        rows +=
            formatted("a,%.1f,%.3f,%.3f\n", 0.1 * i, 0.14 * i + random.real(-0.2, 0.2), off + random.real(-0.2, 0.2));
    }
    const auto off = csv_clips(rows);
    ASSERT_EQ(off.size(), 1u);
    EXPECT_EQ(off[0].facts.frames, 192);
    ASSERT_NE(finding(off[0], "8 rows are left out"), nullptr);
}

TEST(Sanity, WhoIsInTwoPlacesByTurnsIsInOne) {
    std::string rows = kSanityHead;
    for (int i = 0; i < 60; ++i)
        rows += formatted("a,%.1f,%.2f,%d\n", 0.1 * i, 0.1 * i, i > 20 && i < 40 ? i % 2 * 9 : 0);
    for (const ImportedClip& clip : csv_clips(rows)) {
        for (const mobb::Disk& disk : clip.clip->samples()) EXPECT_EQ(disk.y, clip.clip->samples()[0].y);
    }
}

TEST(Sanity, WhatIsResampledAroundAStepThatIsTooFastIsMarkedToo) {
    std::string rows = kSanityHead;
    for (int i = 0; i < 40; ++i)
        rows += formatted("a,%.3f,%.3f,0\n", 0.137 * i + 0.01 * (i % 3), 0.2 * i + (i > 20 ? 0.9 : 0));
    rows += formatted("a,%.3f,%.3f,0\n", 0.137 * 39 + 0.01 + 0.004, 0.2 * 39 + 1.5);
    const auto read = csv_clips(rows);
    ASSERT_EQ(read.size(), 1u);
    const mobb::Clip& clip = *read[0].clip;
    int fast = 0;
    for (int i = 1; i < clip.count(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (clip.samples()[at].x - clip.samples()[at - 1].x <= 8 * clip.dt()) continue;
        ++fast;
        EXPECT_TRUE(std::ranges::any_of(read[0].facts.invented, [&](const auto& of) {
            return of.first <= (i - 1) * clip.dt() && i * clip.dt() <= of.second;
        })) << i;
    }
    EXPECT_GT(fast, 0);
}

TEST(Sanity, AClockThatStepsIsToldAsThat) {
    for (const double step : {7.0, 3600.0}) {
        std::string text = kSanityHead;
        for (const char* id : {"a", "b", "c"}) text += rows_of_walk(id, 0, 4, along_x(0, 2.0 * *id));
        for (const char* id : {"b", "a", "d"}) text += rows_of_walk(id, 4 + step, 8 + step, along_x(5, 2.0 * *id));
        const auto read = csv_clips(text);
        EXPECT_EQ(ids_of(read), (std::set<std::string>{"a", "a#2", "b", "b#2", "c", "d"}));
        const ImportWarning* said =
            finding(read[0], "the clock steps by " + brief(step) + " s for all at once, track 'b'");
        ASSERT_NE(said, nullptr) << read[0].facts.warnings[0].text;
        EXPECT_EQ(said->line, 125);
        EXPECT_EQ(finding(read[0], "pause"), nullptr);
        // Who pauses while others are there.
        text += rows_of_walk("e", 0, 8 + step, along_x(0, 900, 0.5));
        EXPECT_EQ(finding(csv_clips(text)[0], "clock"), nullptr);
        EXPECT_NE(finding(csv_clips(text)[0], "2 pauses are longer"), nullptr);
    }
}

TEST(Sanity, TimesThatGoBackAreNamed) {
    std::string in_order = kSanityHead, back;
    for (int i = 0; i < 40; ++i)
        in_order += formatted("a,%.2f,%.2f,0\nb,%.2f,%.2f,5\n", 0.1 * i, 0.1 * i, 0.1 * i, 0.1 * i);
    for (int i = 0; i < 40; ++i)
        back += formatted("a,%.2f,%.2f,0\nb,%.2f,%.2f,5\n", 1.95 + 0.1 * i, 4 + 0.1 * i, 1.95 + 0.1 * i, 4 + 0.1 * i);
    EXPECT_EQ(finding(csv_clips(in_order)[0], "go back"), nullptr);
    const auto read = csv_clips(in_order + back);
    EXPECT_NE(finding(read[0], "times go back in line 82 and 1 row more: was the clock set back"), nullptr);
    // At the same moments again.
    std::string again = in_order;
    for (int i = 0; i < 40; ++i) again += formatted("a,%.2f,%.2f,0\n", 2 + 0.1 * i, 4 + 0.1 * i);
    const std::string refused = csv_refusal(again);
    EXPECT_NE(refused.find("remove one, or: times go back in line 82: was the clock"), std::string::npos) << refused;
    // Rows in any order do not go back.
    std::string backwards = kSanityHead;
    for (int i = 40; i > 0; --i) backwards += formatted("a,%.2f,%.2f,0\n", 0.1 * i, 0.1 * i);
    EXPECT_EQ(finding(csv_clips(backwards)[0], "go back"), nullptr);
}

TEST(Sanity, TheClassSaysHowFastItIsWhereThereIsOne) {
    const auto driven = [](const char* label, double speed) {
        std::string text = "id,t,x,y,class\n";
        for (int i = 0; i < 40; ++i) text += formatted("1,%.1f,%.1f,0,%s\n", 0.5 * i, 0.5 * speed * i, label);
        return text;
    };
    for (const auto& [label, speed] : std::initializer_list<std::pair<const char*, double>>{
             {"train", 90}, {"car", 70}, {"Car", 60}, {"truck", 25}, {"pedestrian", 1.4}}) {
        const auto read = csv_clips(driven(label, speed));
        ASSERT_EQ(read.size(), 1u) << label;
        EXPECT_EQ(read[0].facts.doubt, "") << label;
        EXPECT_TRUE(read[0].facts.invented.empty()) << label;
    }
    EXPECT_NE(csv_refusal(driven("unknown", 60)).find("the median speed of who moves is 60 m/s"), std::string::npos);
    EXPECT_NE(csv_refusal(driven("car", 140)).find("faster than its class is"), std::string::npos);
    EXPECT_NE(csv_refusal(driven("pedestrian", 60)).find("the median speed"), std::string::npos);
    EXPECT_NE(csv_clips(driven("pedestrian", 20))[0].facts.doubt, "");
}

TEST(Sanity, EightMetresASecondBindPeopleAlone) {
    std::string text = "id,t,x,y,class\n";
    const auto add = [&text](const std::string& label, double speed) {
        const std::string rows = rows_of_walk(label, 0, 4, along_x(0, 5 * speed, speed));
        for (std::size_t at = 0; at < rows.size();) {
            const std::size_t end = rows.find('\n', at);
            text += rows.substr(at, end - at) + ',' + label + '\n';
            at = end + 1;
        }
    };
    add("pedestrian", 1.4);
    add("Car", 30);
    add("bicycle", 9);
    add("bus", 20);
    const auto read = csv_clips(text);
    EXPECT_EQ(read.size(), 4u);
    for (const ImportedClip& clip : read) {
        EXPECT_TRUE(clip.facts.invented.empty()) << clip.id;
        EXPECT_EQ(finding(clip, "jump"), nullptr);
        EXPECT_EQ(clip.facts.doubt, "");
    }
    add("person", 12);
    for (const ImportedClip& clip : csv_clips(text))
        EXPECT_EQ(clip.facts.invented.size(), clip.id == "person" ? 1u : 0u) << "all of it is too fast";
    EXPECT_EQ(fastest_of("Pedestrian", 0), 8);
    EXPECT_EQ(fastest_of("", 1.2), 8);
    EXPECT_GT(fastest_of("", 20), 45);
    EXPECT_GT(fastest_of("motorcyclist", 0), 45);
}

TEST(Sanity, WhoIsLostIsNotWhereThatIsWritten) {
    for (const Spot lost : {Spot{-1, -1}, Spot{0, 0}, Spot{999, 999}}) {
        std::string text = kSanityHead;
        for (int who = 0; who < 2; ++who) {
            text += rows_of_walk(who == 0 ? "a" : "b", 0, 4, [&](double t) {
                return t > 1.45 + who * 0.5 && t < 2.05 + who * 0.5 ? lost : Spot{10 + t, 5 + 10.0 * who};
            });
        }
        const auto read = csv_clips(text);
        ASSERT_EQ(read.size(), 2u) << lost.x;
        for (const ImportedClip& clip : read) {
            EXPECT_EQ(clip.clip->count(), 41);
            for (const mobb::Disk& disk : clip.clip->samples()) EXPECT_TRUE(disk.x >= 10 && disk.x < 14.1) << disk.x;
            ASSERT_EQ(clip.facts.invented.size(), 1u);
            EXPECT_NEAR(clip.facts.invented[0].second - clip.facts.invented[0].first, 0.7, 1e-9);
        }
        const ImportWarning* said = finding(read[0], "12 rows are left out");
        ASSERT_NE(said, nullptr) << read[0].facts.warnings[0].text;
        const bool is_a = said->text.find("track 'a'") != std::string::npos;
        EXPECT_EQ(said->line, is_a ? 17 : 63) << said->text;
        EXPECT_EQ(finding(read[0], "jump is"), nullptr) << "nothing is split";
        EXPECT_EQ(csv_clips(text, keeping_jumps())[0].clip->samples()[16].x, lost.x);
        EXPECT_NE(finding(csv_clips(text, keeping_jumps())[0], "4 jumps are faster"), nullptr);
    }
    // Who is never seen is nobody, if others are lost there too.
    std::string never = kSanityHead + rows_of_walk("a", 0, 4, [](double t) {
                            return t > 1.45 && t < 2.05 ? Spot{-1, -1} : Spot{10 + t, 5};
                        });
    never += rows_of_walk("b", 0, 4, [](double) { return Spot{-1, -1}; });
    EXPECT_EQ(ids_of(csv_clips(never)), std::set<std::string>{"a"});
    // Who begins at the origin is there.
    const auto origin = csv_clips(kSanityHead + rows_of_walk("a", 0, 4, along_x(0, 0)));
    EXPECT_EQ(origin[0].clip->samples()[0].x, 0);
    EXPECT_EQ(origin[0].facts.warnings.size(), 1u) << "the radius alone";
}

TEST(Sanity, OnePointFarOffIsLeftOut) {
    for (const double far : {5.0, 90.0, 1e6}) {
        const auto read = csv_clips(kSanityHead + rows_of_walk("a", 0, 4, [&](double t) {
                                        return std::abs(t - 2) < 0.01 ? Spot{far, far} : Spot{t, 0};
                                    }));
        ASSERT_EQ(ids_of(read), std::set<std::string>{"a"});
        EXPECT_NEAR(read[0].clip->samples()[20].x, 2, 1e-9);
        const ImportWarning* said = finding(read[0], "1 row is left out");
        ASSERT_NE(said, nullptr);
        EXPECT_EQ(said->line, 22);
    }
}

TEST(Sanity, UnitsThatNobodyMovesInAreRefusedUntilTheyAreSaid) {
    const auto scaled = [](double places, double times) {
        std::string text = kSanityHead;
        for (int i = 0; i <= 40; ++i) text += "a," + formatted("%.9g,%.9g,0\n", i * 0.1 * times, i * 0.1 * places);
        return text;
    };
    const struct {
        double places, times;
        const char* remedy;
    } cases[] = {{100, 1, "if places are in cm, give unit cm"},
                 {1000, 1, "in mm, give unit 0.001"},
                 {1, 1e3, "if times are in ms, give columns t=t/1000"},
                 {1, 1e6, "if times are in us, give columns t=t/1000000"},
                 {1, 1.0 / 60, "if times are in minutes, give columns t=t*60"},
                 {1e-5, 1, "if places are degrees, project them to metres first"}};
    for (const auto& [places, times, remedy] : cases) {
        const std::string text = scaled(places, times);
        const std::string refused = csv_refusal(text);
        EXPECT_NE(refused.find(remedy), std::string::npos) << refused;
        EXPECT_NE(refused.find("track 'a', line "), std::string::npos) << refused;
        EXPECT_NE(refused.find("give unit m if it is right"), std::string::npos) << refused;
        ImportOptions insists;
        insists.unit = "m";
        const auto read = csv_clips(text, insists);
        EXPECT_EQ(read.size(), 1u) << "it is as it is";
        EXPECT_NE(read[0].facts.doubt, "");
        EXPECT_NE(finding(read[0], remedy), nullptr) << "but said";
    }
    ImportOptions cm;
    cm.unit = "cm";
    EXPECT_EQ(csv_clips(scaled(100, 1), cm)[0].facts.doubt, "");
    ImportOptions ms;
    ms.columns = "t=t/1000";
    EXPECT_EQ(csv_clips(scaled(1, 1e3), ms)[0].facts.doubt, "");
    // Slow or fast, but not beyond belief.
    for (const double factor : {0.05, 20.0}) {
        const auto read = csv_clips(scaled(factor, 1));
        EXPECT_NE(finding(read[0], "the median speed of who moves"), nullptr) << factor;
        EXPECT_NE(read[0].facts.doubt, "");
    }
    // Frames by a rate that is not theirs.
    std::string rows;
    for (int i = 0; i < 20; ++i) rows += formatted("1 %d %d 0\n", i, i);
    EXPECT_NE(input_error([&] {
                  track_clips(parse_text_tracks("# framerate: 1000\n# id frame x y\n" + rows, "f.txt"), "f.txt", {});
              }).find("1000 m/s"),
              std::string::npos);
}

/// Noise is no motion.
TEST(Sanity, ACrowdThatStandsIsRead) {
    mobb::test::Random random(7);
    for (const double noise : {0.0003, 0.002, 0.05}) {
        std::string rows = "id,t,x,y\n";
        for (int id = 0; id < 20; ++id) {
            for (int i = 0; i < 100; ++i)
                rows += formatted("%d,%.2f,%.5f,%.5f\n", id, 0.1 * i, 3 * id + random.real(-noise, noise),
                                  random.real(-noise, noise));
        }
        for (const ImportedClip& clip : csv_clips(rows)) EXPECT_EQ(clip.facts.doubt, "") << clip.id << ' ' << noise;
    }
}

TEST(Sanity, AColumnOfRadiiSaysTheirUnitAlone) {
    const auto read = csv_clips("id,t,x,y,radius_cm\n1,0,0,0,25\n1,1,1,0,25\n1,2,2,0,25\n");
    EXPECT_EQ(read[0].clip->samples()[2].x, 2);
    EXPECT_EQ(read[0].clip->samples()[2].r, 0.25);
}

TEST(Sanity, AClassIsAWord) {
    EXPECT_EQ(fastest_of("businessman", 1), fastest_of("person", 1));
    EXPECT_GT(fastest_of("bus", 1), fastest_of("person", 1));
    EXPECT_GT(fastest_of("Cars", 1), fastest_of("person", 1));
    EXPECT_EQ(fastest_of("bicyclist", 1), fastest_of("Biker", 1));
}

TEST(Sanity, RowsOfWhoIsNotActiveAreLeftOutInWords) {
    const auto points = [](const char* yes, const char* no) {
        const std::string text = formatted("id,t,x,y,active\n1,0,0,0,%s\n1,1,1,0,%s\n1,2,2,0,%s\n", yes, yes, no);
        return csv_clips(text)[0].facts.frames;
    };
    EXPECT_EQ(points("yes", "no"), 2);
    EXPECT_EQ(points("Y", "N"), 2);
    EXPECT_EQ(points("1.0", "0.00"), 2);
    EXPECT_NE(input_error([&] { points("yes", "perhaps"); }).find("line 4, column 5 (active): 'perhaps' is neither"),
              std::string::npos);
}

TEST(Sanity, RealPeopleWhoWereRecordedDoNotJump) {
    const auto folder = kSharedData / "trajectories";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!entry.is_regular_file()) continue;
        for (const ImportedClip& clip : import_clips(entry.path(), {})) {
            EXPECT_EQ(finding(clip, "jump"), nullptr) << entry.path() << said(*finding(clip, "jump"));
            EXPECT_EQ(finding(clip, "pause"), nullptr) << entry.path();
            EXPECT_EQ(finding(clip, "left out, as"), nullptr) << entry.path();
            // What is too fast for people is marked at least: of a drone's pixels all is.
            const auto samples = clip.clip->samples();
            for (std::size_t i = 1; i < samples.size(); ++i) {
                const double speed =
                    std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y) / clip.clip->dt();
                if (speed <= 8.01 || fastest_of(clip.facts.label, 0) > 8) continue;
                const double middle = (static_cast<double>(i) - 0.5) * clip.clip->dt();
                EXPECT_TRUE(std::ranges::any_of(
                    clip.facts.invented, [&](const auto& of) { return of.first <= middle && middle <= of.second; }))
                    << entry.path() << clip.id << ' ' << i;
            }
        }
    }
}

TEST(Sanity, PublicReportsAreSplitOrNamed) {
    const auto folder = kSharedData / "public2";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no test data at " << folder;
    const auto ids = [&](const char* name) { return ids_of(import_clips(folder / name, {})); };
    using Ids = std::set<std::string>;
    EXPECT_EQ(ids("id_used_again_after_10s.csv"), (Ids{"1", "1#2", "2"}));
    EXPECT_EQ(ids("id_used_again_after_3600s.csv"), (Ids{"1", "1#2", "2"}));
    EXPECT_EQ(ids("ngsim_id_used_again.csv"), (Ids{"2", "2#2", "3"}));
    EXPECT_EQ(ids("gap_stop_long.csv"), (Ids{"1", "1#2"}));
    EXPECT_EQ(ids("one_point_far_off.csv"), (Ids{"1", "2"}));
    const auto lost = import_clips(folder / "lost_as_minus_one.csv", {});
    EXPECT_EQ(ids_of(lost), (Ids{"1", "2"}));
    for (const ImportedClip& clip : lost) {
        for (const mobb::Disk& disk : clip.clip->samples()) EXPECT_GE(disk.x, 9.9);
        EXPECT_NE(finding(clip, "rows are left out, as nobody is there"), nullptr);
    }
    for (const auto& [name, remedy] : std::initializer_list<std::pair<const char*, const char*>>{
             {"places_mm.csv", "in mm, give unit 0.001"},
             {"time_us_from_zero.csv", "times are in us, give columns t=time/1000000"},
             {"time_minutes.csv", "times are in minutes, give columns t=time*60"},
             {"degrees_called_xy.csv", "places are degrees"}}) {
        const char* const file = name;
        const std::string said = input_error([&] { import_clips(folder / file, {}); });
        EXPECT_NE(said.find(remedy), std::string::npos) << name << ' ' << said;
    }
    EXPECT_NE(finding(import_clips(folder / "frame_called_time_every_10.csv", {})[0],
                      "times count frames, give columns frame=time and fps"),
              nullptr);
    EXPECT_EQ(ids("empty_cells.csv"), (Ids{"1", "2"}));
    EXPECT_EQ(ids("active_column.csv").size(), 2u);
    EXPECT_EQ(import_clips(folder / "ngsim_overlap.csv", {})[0].facts.doubt, "") << "Vehicle_ID names cars";
    EXPECT_FALSE(ids("trajnet_nan.txt").empty());
}

}  // namespace
}  // namespace mobbscope
