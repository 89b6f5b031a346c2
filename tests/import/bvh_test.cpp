#include <import/bvh/bvh.h>
#include <support/bvh_text.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mobbscope {
namespace {

const std::string kFile = "walk.bvh";

/// Where the joints of a text's only animation are at a stored frame.
std::vector<glm::dvec3> pose(const std::string& text, int frame) {
    const auto motion = bvh_motion(parse_bvh(text, kFile)).motion(0, 0);
    std::vector<glm::dvec3> positions(motion->joints().size());
    motion->pose(frame * *motion->times().dt, positions);
    return positions;
}

void expect_near(const glm::dvec3& p, double x, double y, double z) {
    EXPECT_NEAR(p.x, x, 1e-9);
    EXPECT_NEAR(p.y, y, 1e-9);
    EXPECT_NEAR(p.z, z, 1e-9);
}

std::string bvh_refusal(const std::string& text) {
    return input_error([&] { parse_bvh(text, kFile); });
}

TEST(Bvh, HierarchyAndRows) {
    const BvhData data = parse_bvh(kWalker, kFile);
    ASSERT_EQ(data.joints.size(), 4u);
    EXPECT_EQ(data.joints[1].name, "Left Arm");
    EXPECT_EQ(data.joints[1].parent, 0);
    EXPECT_TRUE(data.joints[2].end_site);
    EXPECT_EQ(data.joints[2].parent, 1);
    EXPECT_EQ(data.joints[3].parent, 0);
    EXPECT_EQ(data.row_length, 12u);
    EXPECT_EQ(data.frames(), 2u);
    EXPECT_EQ(data.frame_time, 0.1);
}

TEST(Bvh, PosesFollowOffsetsAndRotations) {
    expect_near(pose(kWalker, 0)[2], 0, 170, 100);
    // A quarter turn about Y takes Z to X.
    expect_near(pose(kWalker, 1)[1], 60, 170, 30);
    expect_near(pose(kWalker, 1)[2], 80, 170, 30);
    expect_near(pose(kWalker, 1)[3], 10, 0, 30);
}

TEST(Bvh, DecimalsMayHaveCommas) {
    std::string text = replaced(kWalker, "0 95 30 0 0 0 0", "0,5 95,25 30,0 0 -0,0 +0,0 0e0");
    text = replaced(text, "OFFSET 0 75 50", "OFFSET 0,0 75,5 50");
    text = replaced(text, "Frame Time: 0.1", "Frame Time: 0,1");
    expect_near(pose(text, 0)[1], 0.5, 170.75, 80);
    const BvhData data = parse_bvh(text, kFile);
    EXPECT_EQ(data.frame_time, 0.1);
    EXPECT_EQ(
        bvh_refusal(replaced(text, "0,5 95,25", "0.5 95,25")),
        "walk.bvh: line 24: '95,25' is not a finite number; write decimals with a point and separate numbers with "
        "blanks");
    EXPECT_EQ(data.warnings.at(0), "commas within numbers are read as decimal points: 0,5 is a half");
}

TEST(Bvh, RowsMayGoOverLines) {
    const BvhData rows = parse_bvh(kWalker, kFile);
    for (const char* parted : {"0 95 30\n0 0 0 0 0 0 0 0 0\n", "0\n95 30 0 0 0\n\n0 0 0 0 0 0\n"}) {
        const BvhData data = parse_bvh(replaced(kWalker, "0 95 30 0 0 0 0 0 0 0 0 0\n", parted), kFile);
        EXPECT_EQ(data.values, rows.values) << parted;
    }
    // Two short rows are no whole one where Frames says that there are two.
    const std::string short_twice =
        replaced(kWalker, "0 95 30 0 0 0 0 0 0 0 0 0\n10 95 30 0 0 90 0 0 0 0 0 0", "0 95 30 0 0 0\n10 95 30 0 0 90");
    EXPECT_EQ(bvh_refusal(short_twice),
              "walk.bvh: line 24: the row has 6 values, but there are 12 channels; correct the row");
}

TEST(Bvh, ScaleChannelsScaleWhatIsBelow) {
    std::string text = replaced(kWalker, "CHANNELS 6 Xposition", "CHANNELS 9 Zscale Yscale Xscale Xposition");
    text = replaced(text, "\n0 95 30", "\n1 1 1 0 95 30");
    text = replaced(text, "\n10 95 30", "\n2 1 0.5 10 95 30");
    expect_near(pose(text, 0)[2], 0, 170, 100);
    expect_near(pose(text, 1)[0], 10, 95, 30);
    // Z, 50 long, becomes X by the turn.
    expect_near(pose(text, 1)[1], 110, 170, 30);
    expect_near(pose(text, 1)[2], 150, 170, 30);
}

TEST(Bvh, CommentsAndEndSitesInOneWordAreRead) {
    std::string text = "# made by hand\n" + replaced(kWalker, "MOTION\n", "# a remark {\nMOTION # here\n");
    text = replaced(text, "End Site", "EndSite");
    EXPECT_EQ(parse_bvh(text, kFile).values, parse_bvh(kWalker, kFile).values);
    EXPECT_TRUE(parse_bvh(text, kFile).joints[2].end_site);
}

TEST(Bvh, RotationsApplyInTheOrderOfTheChannels) {
    const std::string turned = replaced(kWalker, "0 95 30 0 0 0 0", "0 95 30 90 0 90 0");
    // Z first: Rz * Ry takes (0, 75, 50) to Rz (50, 75, 0) = (-75, 50, 0).
    expect_near(pose(turned, 0)[1], -75, 145, 30);
    // Y first: Ry * Rz takes it to Ry (-75, 0, 50) = (50, 0, 75).
    const std::string other = replaced(turned, "Zrotation Xrotation Yrotation", "Yrotation Xrotation Zrotation");
    expect_near(pose(other, 0)[1], 50, 95, 105);
}

TEST(Bvh, PositionChannelsReplaceTheirCoordinateOfTheOffset) {
    std::string text = replaced(kWalker, "OFFSET 0 0 0", "OFFSET 1000 2000 3000");
    expect_near(pose(text, 0)[0], 0, 95, 30);
    text = replaced(text, "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation",
                    "CHANNELS 6 Zrotation Xposition Xrotation Yrotation Yposition Xrotation");
    // Row 0 is now: 0 about Z, x = 95, 30 about X, 0 about Y, y = 0, 0 about X; z stays that of the OFFSET.
    expect_near(pose(text, 0)[0], 95, 0, 3000);
}

TEST(Bvh, AnyJointMayHavePositionChannels) {
    std::string text = replaced(kWalker, "CHANNELS 3 Zrotation", "CHANNELS 4 Xposition Zrotation");
    text = replaced(text, "0 95 30 0 0 0 0 0 0", "0 95 30 0 0 0 -7 0 0 0");
    text = replaced(text, "10 95 30 0 0 90 0 0 0", "10 95 30 0 0 90 -7 0 0 0");
    expect_near(pose(text, 0)[1], -7, 170, 80);
}

TEST(Bvh, LayoutDoesNotMatter) {
    const auto expected = parse_bvh(kWalker, kFile);
    std::string crlf, cr;
    for (const char c : kWalker) {
        if (c == '\n') crlf += '\r';
        crlf += c;
        cr += c == '\n' ? '\r' : c;
    }
    std::string flat = kWalker;
    std::replace(flat.begin(), flat.begin() + static_cast<std::ptrdiff_t>(flat.find("MOTION")), ' ', '\t');
    flat = replaced(flat, "Left\tArm", "Left Arm");
    std::string lower = kWalker;
    for (const char* word : {"HIERARCHY", "ROOT", "OFFSET", "CHANNELS", "JOINT", "End Site", "MOTION", "Frames"}) {
        std::string small = word;
        for (char& c : small) c = static_cast<char>(std::tolower(c));
        lower = replaced(lower, word, small);
    }
    for (const std::string& text :
         {crlf, cr, flat, lower, "\xef\xbb\xbf" + kWalker, kWalker.substr(0, kWalker.size() - 1), kWalker + "\n \n\t\n",
          replaced(kWalker, "Left Arm\n  {", "Left Arm {"), replaced(kWalker, "ROOT Hips\n", "ROOT Hips\n\n\n"),
          replaced(kWalker, "10 95 30", "+1e1 9.5E+1 30."), replaced(kWalker, "0 95 30", "1e-400 95 3e1"),
          replaced(kWalker, "Frame Time: 0.1", "Frame  Time :\t.1"), replaced(kWalker, "Frames: 2", "Frames:2")}) {
        const BvhData data = parse_bvh(text, kFile);
        EXPECT_EQ(data.values, expected.values) << text;
        EXPECT_EQ(data.joints.size(), expected.joints.size());
        EXPECT_EQ(data.joints[1].name, "Left Arm");
        EXPECT_EQ(data.frame_time, 0.1);
    }
}

/// kWalker with that many rows; the hips go 10 cm a row.
std::string walker_of(int rows) {
    std::string text = kWalker.substr(0, kWalker.find("0 95 30"));
    for (int i = 0; i < rows; ++i) text += std::to_string(10 * i) + " 95 30 0 0 0 0 0 0 0 0 0\n";
    return text;
}

TEST(Bvh, RowsThatAreThereAreBelieved) {
    const std::string end = ": all that are there are taken";
    const std::string cut = "; fetch the file again if it was cut off";
    const struct {
        int said, rows;
        std::string warning;
    } kinds[] = {
        {60, 61, "Frames says 60, but 61 rows follow" + end + " (line 22)"},
        {1, 2, "Frames says 1, but 2 rows follow" + end + " (line 22)"},
        {10, 200, "Frames says 10, but 200 rows follow" + end + " (line 22)"},
        {61, 60, "Frames says 61, but 60 rows follow" + end + cut + " (line 22)"},
        {60, 30, "Frames says 60, but 30 rows follow" + end + cut + " (line 22)"},
        {2, 1, "Frames says 2, but 1 row follows" + end + cut + " (line 22)"},
        {10'000'000, 3, "Frames says 10000000, but 3 rows follow" + end + cut + " (line 22)"},
        {0, 2, "Frames says 0, but 2 rows follow" + end + " (line 22)"},
        {7, 7, ""},
    };
    for (const auto& [said, rows, warning] : kinds) {
        const std::string text = replaced(walker_of(rows), "Frames: 2", "Frames: " + std::to_string(said));
        for (const char* tail : {"", "\n\n", " \n\t\n"}) {
            const BvhData data = parse_bvh(text + tail, kFile);
            EXPECT_EQ(data.frames(), static_cast<std::size_t>(rows));
            EXPECT_EQ(data.warnings, warning.empty() ? std::vector<std::string>{} : std::vector{warning});
            EXPECT_EQ(data.values[static_cast<std::size_t>(rows - 1) * 12], 10.0 * (rows - 1));
        }
        const auto motion = bvh_motion(parse_bvh(text, kFile)).motion(0, 0);
        EXPECT_EQ(motion->times().frames, rows);
        EXPECT_EQ(motion->warnings().size(), warning.empty() ? 0u : 1u);
        // However many rows there are, each is whole.
        EXPECT_NE(bvh_refusal(text.substr(0, text.size() - 3)), "");
    }
}

TEST(Bvh, FrameTimesThatAreNoSecondsAreDoubted) {
    const auto doubt = [](const std::string& time) {
        BvhData data = parse_bvh(replaced(kWalker, "Frame Time: 0.1", "Frame Time: " + time), kFile);
        EXPECT_EQ(data.frame_time, std::stod(time));  // it is not changed
        const std::string doubt_of_data = data.time_doubt;
        EXPECT_EQ(bvh_motion(std::move(data)).motion(0, 0)->times().doubt, doubt_of_data);
        return doubt_of_data;
    };
    const auto looks_like = [](const std::string& time, const std::string& what, const std::string& write) {
        return "Frame Time is " + time + " seconds, which looks like " + what + "; if so, write " + write +
               " there (line 23)";
    };
    for (const auto& [time, write] : {std::pair{"30", "0.0333333"},
                                      {"24", "0.0416667"},
                                      {"25", "0.04"},
                                      {"60", "0.0166667"},
                                      {"120", "0.00833333"},
                                      {"29.97", "0.0333667"},
                                      {"59.94", "0.0166834"},
                                      {"240", "0.00416667"},
                                      {"1000", "0.001"}}) {
        EXPECT_EQ(doubt(time), looks_like(time, "frames a second", write));
    }
    for (const auto& [time, write] : {std::pair{"33.3333", "0.0333333"},
                                      {"33", "0.033"},
                                      {"16.6667", "0.0166667"},
                                      {"41.6667", "0.0416667"},
                                      {"8.33333", "0.00833333"},
                                      {"40", "0.04"}}) {
        EXPECT_EQ(doubt(time), looks_like(time, "milliseconds", write));
    }
    EXPECT_EQ(doubt("45"),
              looks_like("45", "frames a second or milliseconds", "the seconds from one frame to the next"));
    for (const char* time : {"0.0083333", "0.033333", "0.1", "0.5", "1", "2"}) EXPECT_EQ(doubt(time), "") << time;
}

TEST(Bvh, EveryRootIsACharacter) {
    const std::string dog = "ROOT Dog\n{\nOFFSET 5 6 7\nCHANNELS 1 Yposition\nJOINT Tail\n{\nOFFSET 0 0 -3\n}\n}\n";
    std::string text = replaced(kWalker, "MOTION", dog + "ROOT Hips\n{\nOFFSET 1 2 3\nCHANNELS 1 Xposition\n}\nMOTION");
    text = replaced(text, "0 0 0\n10", "0 0 0 1 70\n10");
    text = text.substr(0, text.size() - 1) + " 2 80\n";
    BvhData data = parse_bvh(text, kFile);
    EXPECT_EQ(data.joints[4].parent, -1);
    EXPECT_EQ(data.joints[5].parent, 4);
    EXPECT_EQ(data.row_length, 14u);

    const MotionFile file = bvh_motion(std::move(data));
    EXPECT_EQ(file.characters, (std::vector<std::string>{"Hips", "Dog", "Hips #2"}));
    EXPECT_EQ(file.moved(0).characters, (std::vector<std::size_t>{0, 1, 2}));
    std::vector<int> owners;
    for (const NamedJoint& joint : file.joints) owners.push_back(joint.character);
    EXPECT_EQ(owners, (std::vector{0, 0, 0, 0, 1, 1, 2}));

    const auto second = file.motion(0, 1);
    ASSERT_EQ(second->joints().size(), 2u);
    EXPECT_EQ(second->joints()[1].parent, 0);
    EXPECT_EQ(second->in_file(1), 5u);
    std::vector<glm::dvec3> positions(2);
    second->pose(0.1, positions);
    expect_near(positions[0], 5, 2, 7);
    expect_near(positions[1], 5, 2, 4);
    const RootedMotion tail = file.rooted(0, 5);
    EXPECT_EQ(tail.motion, second);
    EXPECT_EQ(tail.root, 1);
    positions.resize(1);
    file.motion(0, 2)->pose(0, positions);
    expect_near(positions[0], 70, 2, 3);
}

TEST(Bvh, ARootWithoutChannelsDoesNotMove) {
    const std::string text = replaced(kWalker, "MOTION", "ROOT Box\n{\nOFFSET 5 6 7\n}\nMOTION");
    EXPECT_EQ(bvh_motion(parse_bvh(text, kFile)).moved(0).characters, (std::vector<std::size_t>{0}));
}

TEST(Bvh, DeepHierarchiesNeedNoStack) {
    constexpr int kDepth = 90'000;
    std::string text = "HIERARCHY\n";
    for (int i = 0; i < kDepth; ++i)
        text += i == 0 ? "ROOT r\n{OFFSET 0 1 0\nCHANNELS 1 Xposition\n" : "JOINT j\n{OFFSET 0 1 0\n";
    for (int i = 0; i < kDepth; ++i) text += "}\n";
    expect_near(pose(text + "MOTION\nFrames: 1\nFrame Time: 1\n5\n", 0).back(), 5, kDepth, 0);
}

TEST(Bvh, MessagesNameLineAndRemedy) {
    const auto expect = [](const std::string& text, const std::string& message) {
        EXPECT_EQ(bvh_refusal(text), "walk.bvh: " + message);
    };
    const auto with = [](const std::string& what, const std::string& instead) {
        return replaced(kWalker, what, instead);
    };
    expect("", "line 1: the file is empty; a BVH begins with HIERARCHY");
    expect("\xff\xfeH", "line 1: is UTF-16 text; save it as UTF-8");
    expect("glTF", "line 1: a BVH begins with HIERARCHY, but there is 'glTF'; is this another kind of file?");
    expect("HIERARCHY\nMOTION", "line 2: there is no ROOT before MOTION");
    expect("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\n",
           "line 6: no joint has a channel, so nothing moves; give CHANNELS to one");
    expect(with("MOTION", "}\nMOTION"), "line 21: this } closes nothing; remove it");
    expect(
        with("}\nMOTION", "MOTION"),
        "line 20: in 'Hips' of line 2, OFFSET, CHANNELS, JOINT, End Site or } must stand here, but there is 'MOTION'");
    expect(with("  OFFSET 0 0 0\n", ""), "line 19: 'Hips' of line 2 has no OFFSET; give it one");
    expect(with("OFFSET 0 -95 0", "OFFSET 0 -95"), "line 17: OFFSET needs three numbers, but has 2");
    expect(with("OFFSET 0 -95 0", "OFFSET 0 -95 0 0"), "line 17: OFFSET takes three numbers; there is '0'");
    expect(with("Hips", ""), "line 2: ROOT needs a name on its line");
    expect(with("CHANNELS 6", "CHANNELS 10"), "line 5: CHANNELS needs their number, 0 to 9, but there is '10'");
    expect(with("CHANNELS 6", "CHANNELS 5"), "line 5: CHANNELS says 5, but names more; there is 'Yrotation'");
    expect(with("CHANNELS 3", "CHANNELS 4"), "line 9: CHANNELS says 4, but names only 3");
    expect(with("Zposition", "Xposition"), "line 5: 'Xposition' stands twice in CHANNELS; remove one");
    expect(with("Zposition", "Zmove"),
           "line 5: 'Zmove' is not a channel; give Xposition, Xrotation or Xscale, or such of Y or Z");
    for (const char* count : {"two", "", "-2", "2.5", "10000001", "2147483647", "99999999999999999999"}) {
        expect(with("Frames: 2", "Frames: " + std::string(count)),
               "line 22: Frames needs a whole number from 1 to 10000000, but has '" + std::string(count) + "'");
    }
    expect(replaced(kWalker.substr(0, kWalker.find("0 95 30")), "Frames: 2", "Frames: 0"),
           "line 22: Frames says 0: the file holds a body and no motion; export the motion with it");
    expect(kWalker.substr(0, kWalker.find("0 95 30")),
           "line 22: Frames says 2, but no row follows; fetch the file again if it was cut off");
    expect(kWalker + "20 95 30\n", "line 26: the row has 3 values, but there are 12 channels; correct the row");
    expect(kWalker + "END\n", "line 26: 'END' is not a finite number; write it like 12.5");
    expect(with("Frame Time: 0.1", "Frame Time: 0"),
           "line 23: Frame Time needs seconds, over 0 and at most 1000, such as 0.033333, but has '0'");
    expect(with("Frame Time: 0.1", "Frame Time: 33333"),
           "line 23: Frame Time needs seconds, over 0 and at most 1000, such as 0.033333, but has '33333'");
    expect(with("Frame Time: 0.1\n", ""),
           "line 23: 'Frame Time: <number>' must stand here, but there is '0 95 30 0 0 0 0 0 0 0 0 0'");
    expect(with("0 95 30", "0 nan 30"), "line 24: 'nan' is not a finite number; write it like 12.5");
    expect(with("0 95 30", "0 1e300 30"), "line 24: '1e300' is beyond 1e9; the file is damaged");
    expect(with("0 95 30", "0 1e999 30"), "line 24: '1e999' is beyond 1e9; the file is damaged");
    expect(with("0 95 30", "0, 95, 30"),
           "line 24: '0,' is not a finite number; write decimals with a point and separate numbers with blanks");
    for (const char* word : {"0,95,30", "9,5.5", "9,", ",5"}) {
        expect(with("0 95 30", word),
               "line 24: '" + std::string(word) +
                   "' is not a finite number; write decimals with a point and separate numbers with blanks");
    }
    expect(with("0 95 30", "0 30"), "line 24: the row has 11 values, but there are 12 channels; correct the row");
    expect(with("0 95 30", "0 0 95 30"), "line 24: the row has 13 values, but there are 12 channels; correct the row");
    expect(kWalker.substr(0, kWalker.size() - 5),
           "line 25: the row has 10 values, but there are 12 channels; the file is cut off");
}

}  // namespace
}  // namespace mobbscope
