// Which axis of a BVH is up, told by how a body stands: made-up bodies, and published ones turned.
#include "expected_csv.h"

#include <base/file.h>
#include <import/bvh/bvh.h>
#include <import/import.h>
#include <import/skeleton/motion_clips.h>
#include <support/folders.h>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

enum class Written {
    y_up,    ///< as made
    z_up,    ///< offsets and channels have z up
    rooted,  ///< offsets have y up, the ROOT is turned and moved so that z is up
};

/// Where the hips are, with y up, and how they and the legs are turned. Lengths in cm, degrees.
struct MadePose {
    glm::dvec3 hips{0, 95, 0};
    double about_z = 0, about_x = 0, about_y = 0;  ///< in that order: facing +z where all are 0
    double thighs = 0;                             ///< of both legs, about x
};

/// A body 1.70 m tall, if `unit` is 1.
class MadeBody {
  public:
    Written written = Written::y_up;
    double unit = 1;  ///< file units per cm
    bool has_arms = true;
    double lift = 0;  ///< cm

    std::string text(int frames, const std::function<MadePose(double seconds)>& pose) const {
        std::ostringstream out;
        out << "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 " << names("XYZ", "position")
            << names("ZXY", "rotation") << "\nJOINT Spine\n{\n"
            << offset(0, 30, 0) << "JOINT Head\n{\n"
            << offset(0, 35, 0) << tip(0, 12, 0) << "}\n";
        for (const double side : {1, -1}) {
            if (has_arms) out << "JOINT Hand\n{\n" << offset(35 * side, -20, 10) << tip(2 * side, -10, 0) << "}\n";
        }
        out << "}\n";
        for (const double side : {1, -1}) {
            out << "JOINT Leg\n{\n"
                << offset(10 * side, -5, 0) << "CHANNELS 1 Xrotation\nJOINT Foot\n{\n"
                << offset(0, -88, 5) << tip(0, 0, 12) << "}\n}\n";
        }
        out << "}\nMOTION\nFrames: " << frames << "\nFrame Time: 0.033333\n";
        for (int i = 0; i < frames; ++i) row(out, pose(i / 30.0));
        return out.str();
    }

    SourceFacts facts(const std::function<MadePose(double)>& pose, int frames = 61) const {
        return clip(pose, frames).facts;
    }
    ImportedClip clip(const std::function<MadePose(double)>& pose, int frames = 61) const {
        return motion_clips(bvh_motion(parse_bvh(text(frames, pose), "body.bvh")), "body.bvh", {}).at(0);
    }

  private:
    /// Rotations about y become such about z, and so on: see `written`.
    std::string names(const std::string& axes, const std::string& kind) const {
        std::string out;
        for (const char axis : axes) {
            const bool swaps = written == Written::z_up && axis != 'X';
            out += (swaps ? (axis == 'Y' ? 'Z' : 'Y') : axis) + kind + ' ';
        }
        return out;
    }
    glm::dvec3 turned(const glm::dvec3& p) const { return written == Written::y_up ? p : glm::dvec3(p.x, -p.z, p.y); }
    std::string offset(double x, double y, double z) const {
        const glm::dvec3 p = unit * (written == Written::z_up ? turned({x, y, z}) : glm::dvec3(x, y, z));
        std::ostringstream out;
        out << "OFFSET " << p.x << ' ' << p.y << ' ' << p.z << '\n';
        return out.str();
    }
    std::string tip(double x, double y, double z) const { return "End Site\n{\n" + offset(x, y, z) + "}\n"; }
    void row(std::ostringstream& out, const MadePose& pose) const {
        const bool is_z_up = written == Written::z_up;
        const glm::dvec3 p = unit * (pose.hips + glm::dvec3(0, lift, 0));
        const glm::dvec3 at = turned(p);
        // Channels stand in the order X, Y, Z of the body as made.
        out << at.x << ' ' << (is_z_up ? at.z : at.y) << ' ' << (is_z_up ? at.y : at.z) << ' '
            << (is_z_up ? -pose.about_z : pose.about_z) << ' ' << pose.about_x + (written == Written::rooted ? 90 : 0)
            << ' ' << pose.about_y << ' ' << pose.thighs << ' ' << pose.thighs << '\n';
    }
};

/// Walks 2 m/s in the direction that it faces.
std::function<MadePose(double)> walks(double facing) {
    return [facing](double t) {
        const double angle = facing * std::acos(-1) / 180;
        return MadePose{{200 * t * std::sin(angle), 95, 200 * t * std::cos(angle)}, 0, 0, facing, 0};
    };
}
MadePose stands(double) { return {}; }
MadePose stands_elsewhere(double) { return {{-310, 95, 420}, 0, 0, 130, 0}; }
MadePose sways(double t) { return {{0, 95, 0}, 0, 8 * std::sin(3 * t), 20, 0}; }
MadePose jumps(double t) { return {{0, 95 + 40 * std::abs(std::sin(4 * t)), 50 * t}, 0, 0, 0, 0}; }
MadePose turns(double t) { return {{30, 95, 20}, 0, 0, 180 * t, 0}; }

constexpr Written kZUpWritten[] = {Written::z_up, Written::rooted};

TEST(BvhUp, WhoStandsAlongZHasZUp) {
    std::vector<std::function<MadePose(double)>> motions{stands, stands_elsewhere, sways, jumps, turns};
    for (const double facing : {0, 45, 90, 180, 270, 300}) motions.push_back(walks(facing));
    for (const Written written : kZUpWritten) {
        for (const double unit : {1.0, 0.01, 1 / 2.54, 10.0}) {
            for (std::size_t i = 0; i < motions.size(); ++i) {
                const SourceFacts facts = MadeBody{written, unit}.facts(motions[i]);
                EXPECT_EQ(facts.up, "z") << "motion " << i << " unit " << unit;
                EXPECT_EQ(facts.up_why, "guessed: the body stands along z");
                EXPECT_NEAR(facts.unit * unit, 0.01, 1e-9);
                EXPECT_NEAR(facts.guessed_from_height.value(), 1.7, 0.05);
            }
        }
    }
}

TEST(BvhUp, AWalkIsTheSameHoweverItIsWritten) {
    const ImportedClip made = MadeBody{}.clip(walks(30));
    EXPECT_EQ(made.facts.up, "y");
    EXPECT_EQ(made.facts.up_why, "guessed: the body stands along y");
    for (const Written written : kZUpWritten) {
        const ImportedClip other = MadeBody{written}.clip(walks(30));
        ASSERT_EQ(other.clip->count(), made.clip->count());
        for (std::size_t i = 0; i < made.clip->samples().size(); ++i) {
            const mobb::Disk &a = made.clip->samples()[i], &b = other.clip->samples()[i];
            EXPECT_NEAR(a.x, b.x, 1e-4);
            EXPECT_NEAR(a.y, b.y, 1e-4);
            EXPECT_NEAR(a.r, b.r, 1e-4);
        }
        EXPECT_TRUE(other.facts.warnings.empty());
    }
}

TEST(BvhUp, TheWholeBodyTellsWithoutArmsOrFloorToo) {
    for (const Written written : kZUpWritten) {
        EXPECT_EQ((MadeBody{written, 1, false}.facts(walks(60)).up), "z");
        EXPECT_EQ((MadeBody{written, 1, false}.facts(stands, 1).up), "z");
    }
    // Hips at the origin: no floor.
    EXPECT_EQ((MadeBody{Written::z_up, 1, true, -95}.facts(stands).up), "z");
    EXPECT_EQ((MadeBody{Written::rooted, 1, true, -95}.facts(walks(0)).up), "z");
}

TEST(BvhUp, WhoDoesNotStandAlongZHasYUp) {
    const auto lies = [](double about_z, double about_x, double roll) {
        return [=](double t) { return MadePose{{20 * t, 14, 150 + 10 * t}, about_z, about_x, roll, 0}; };
    };
    const std::vector<std::pair<const char*, std::function<MadePose(double)>>> motions{
        {"stands", stands},
        {"walks along z", walks(0)},
        {"walks along x", walks(90)},
        {"jumps", jumps},
        {"lies along z on the back", lies(0, -90, 0)},
        {"lies along z, head to +z", lies(0, 90, 180)},
        {"lies along z, face down", lies(0, 90, 0)},
        {"lies along x", lies(90, 0, 0)},
        {"rolls",
         [](double t) {
             return MadePose{{60 * t, 14, 0}, 0, 90, 180 * t, 0};
         }},
        {"crawls along z",
         [](double t) {
             return MadePose{{0, 45, 50 * t}, 0, 80, 0, -80};
         }},
        {"crawls in place",
         [](double) {
             return MadePose{{0, 45, 95}, 0, 80, 0, -80};
         }},
        {"crawls on the belly",
         [](double t) {
             return MadePose{{0, 12, 40 * t}, 0, 90, 0, 0};
         }},
        {"climbs",
         [](double t) {
             return MadePose{{0, 95 + 100 * t, 30}, 0, 10, 0, -40};
         }},
        {"hangs upside down",
         [](double) {
             return MadePose{{0, 200, 0}, 0, 180, 0, 0};
         }},
        {"walks upside down",
         [](double t) {
             return MadePose{{0, 95, 200 * t}, 0, 180, 0, 0};
         }},
        {"stands on the head",
         [](double) {
             return MadePose{{0, 80, 0}, 180, 0, 40, 0};
         }},
        {"bows",
         [](double t) {
             return MadePose{{0, 95, 0}, 0, 40 * t, 0, -40 * t};
         }},
        {"gets up",
         [](double t) {
             return MadePose{{0, 14 + 40 * t, 95}, 0, t < 1.2 ? 90.0 : 0.0, 0, 0};
         }},
    };
    for (const double unit : {1.0, 0.01, 1 / 5.64444}) {
        for (const auto& [name, motion] : motions)
            EXPECT_EQ((MadeBody{Written::y_up, unit}.facts(motion).up), "y") << name;
    }
}

TEST(BvhUp, WhoMayLieOrStandIsDoubted) {
    const auto lies = [](double) { return MadePose{{0, 14, 300}, 0, 90, 180, 0}; };
    const ImportedClip it = MadeBody{}.clip(lies);
    EXPECT_EQ(it.facts.up_why, "as in most files");
    ASSERT_FALSE(it.facts.warnings.empty());
    const auto doubt = std::ranges::find(it.facts.warnings, "up", &ImportWarning::option);
    ASSERT_NE(doubt, it.facts.warnings.end());
    EXPECT_EQ(doubt->text, "the body lies along z, as y is taken to be up; if it stands, give up z");

    // Who says it is not asked.
    ImportOptions options;
    options.up = "y";
    const auto told = motion_clips(bvh_motion(parse_bvh(MadeBody{}.text(3, lies), "body.bvh")), "body.bvh", options);
    EXPECT_EQ(std::ranges::find(told.at(0).facts.warnings, "up", &ImportWarning::option), told[0].facts.warnings.end());
    EXPECT_EQ(told[0].facts.up_why, "");
}

TEST(BvhUp, OffsetsAlongZAreNoProofThatZIsUp) {
    // As skeletons with z up are written into worlds with y up: the ROOT turns them.
    const auto turned_back = [](double height, double z) {
        return [=](double t) {
            // Of a body whose own y is z.
            return MadePose{{50 * t, z, -height}, 0, -90, 0, 0};
        };
    };
    EXPECT_EQ((MadeBody{Written::z_up}.facts(turned_back(95, 40)).up), "y");
    const auto lies = [](double) { return MadePose{{10, 200, -15}, 0, 0, 180, 0}; };
    EXPECT_EQ((MadeBody{Written::z_up}.facts(lies).up), "y");
}

TEST(BvhUp, AutoIsTheGuessAndTheOfferSaysIt) {
    ImportOptions options;
    options.up = "auto";
    for (const Written written : {Written::y_up, Written::z_up, Written::rooted}) {
        const MotionFile file = bvh_motion(parse_bvh(MadeBody{written}.text(61, walks(0)), "body.bvh"));
        const std::string axis = written == Written::y_up ? "y" : "z";
        EXPECT_EQ(motion_clips(file, "body.bvh", options).at(0).facts.up, axis);
        const ImportOffer offer = motion_offer(file, "body.bvh", options);
        const OptionOffer* const up = offer.find("up");
        ASSERT_NE(up, nullptr);
        EXPECT_EQ(up->taken, axis);
        EXPECT_EQ(up->why, "guessed: the body stands along " + axis);
    }
}

TEST(BvhUp, BodiesThatTellNothingHaveYUp) {
    const std::string pole =
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT b\n{\nOFFSET 0 0 "
        "170\n}\n}\n"
        "MOTION\nFrames: 2\nFrame Time: 0.1\n";
    for (const char* rows : {"0 0 0\n10 0 0\n", "0 0 0\n0 200 0\n", "1e9 1e9 1e9\n0 0 0\n"}) {
        const MotionFile file = bvh_motion(parse_bvh(pole + rows, "pole.bvh"));
        EXPECT_EQ(file.ground, kYUp);
        EXPECT_EQ(file.up_why, "as in most files");
        EXPECT_EQ(file.up_doubt, "");
    }
}

/// One file of several bodies: their hierarchies, and their rows side by side.
std::string together(const std::vector<std::string>& texts) {
    std::string hierarchy = "HIERARCHY\n";
    std::vector<std::istringstream> rows;
    for (const std::string& text : texts) {
        const std::size_t root = text.find("ROOT"), motion = text.find("MOTION");
        hierarchy += text.substr(root, motion - root);
        rows.emplace_back(text.substr(text.find('\n', text.find("Frame Time")) + 1));
    }
    std::string out, line;
    int count = 0;
    while (std::getline(rows.front(), line)) {
        out += line;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            std::getline(rows[i], line);
            out += ' ' + line;
        }
        out += '\n';
        ++count;
    }
    return hierarchy + "MOTION\nFrames: " + std::to_string(count) + "\nFrame Time: 0.033333\n" + out;
}

TEST(BvhUp, OneFileHasOneUpAxis) {
    // Who stands along z beside one who stands along y lies.
    const std::string along_z = MadeBody{Written::z_up}.text(3, stands);
    const std::string along_y = MadeBody{Written::y_up}.text(3, walks(0));
    const std::string box =
        "HIERARCHY\nROOT Box\n{\nOFFSET 1 1 1\nCHANNELS 1 Xposition\n}\nMOTION\nFrames: 3\nFrame "
        "Time: 0.03\n0\n0\n0\n";
    const auto ground = [](const std::vector<std::string>& texts) {
        return bvh_motion(parse_bvh(together(texts), "many.bvh")).ground;
    };
    EXPECT_EQ(ground({along_z, along_y}), kYUp);
    EXPECT_EQ(ground({along_y, along_z, along_z}), kYUp);
    EXPECT_EQ(ground({along_y, along_y}), kYUp);
    EXPECT_EQ(ground({along_z, along_z, along_z}), kZUp);
    EXPECT_EQ(ground({box, along_z}), kZUp);
}

TEST(BvhUp, SeveralRootsAreSeveralClipsOfOneUnit) {
    // A grown-up, a child and a ball, in cm: alone the ball would be metres.
    const std::string ball =
        "HIERARCHY\nROOT Ball\n{\nOFFSET 9 9 9\nCHANNELS 1 Xposition\n}\nMOTION\nFrames: 3\nFrame "
        "Time: 0.03\n0\n10\n20\n";
    const std::string child = MadeBody{Written::z_up, 0.5}.text(3, walks(90));
    const MotionFile file =
        bvh_motion(parse_bvh(together({ball, child, MadeBody{Written::z_up}.text(3, walks(0))}), "three.bvh"));
    const auto clips = motion_clips(file, "three.bvh", {});
    ASSERT_EQ(clips.size(), 3u);
    const std::vector<std::string> roots{"Ball", "Hips", "Hips #2"};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(clips[i].name, "#0 · " + roots[i]);
        EXPECT_EQ(clips[i].root, roots[i]);
        EXPECT_EQ(clips[i].facts.up, "z");
        EXPECT_EQ(clips[i].facts.unit, 0.01);
        EXPECT_NEAR(clips[i].facts.guessed_from_height.value(), 1.7, 1e-9);
        ImportOptions options;
        options.root = roots[i];
        const auto one = motion_clips(file, "three.bvh", options);
        ASSERT_EQ(one.size(), 1u);
        EXPECT_EQ(one[0].name, clips[i].name);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(one[0].clip->samples()[k].x, clips[i].clip->samples()[k].x);
            EXPECT_EQ(one[0].clip->samples()[k].y, clips[i].clip->samples()[k].y);
        }
        const ImportOffer offer = motion_offer(file, "three.bvh", options);
        EXPECT_EQ(offer.find("unit")->taken, "cm");
    }
    EXPECT_NEAR(clips[0].clip->samples().back().x, 0.2, 1e-9);
    EXPECT_NEAR(clips[1].clip->samples().back().x, 2.0 / 30, 1e-5);
    EXPECT_NEAR(clips[2].clip->samples().back().y, -4.0 / 30, 1e-5);
}

#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test data at " << (path)

/// A published text with y up, written with z up: rotations about y become such about z, those about z such about -y.
std::string with_z_up(const std::string& text) {
    std::istringstream in(text);
    std::ostringstream out;
    std::vector<bool> negated;
    bool in_rows = false;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "OFFSET") {
            double x, y, z;
            words >> x >> y >> z;
            out << "OFFSET " << x << ' ' << -z << ' ' << y << '\n';
        } else if (word == "CHANNELS") {
            out << word;
            words >> word;
            out << ' ' << word;
            while (words >> word) {
                negated.push_back(word[0] == 'Z');
                word[0] = word[0] == 'X' ? 'X' : word[0] == 'Y' ? 'Z' : 'Y';
                out << ' ' << word;
            }
            out << '\n';
        } else if (in_rows && !word.empty()) {
            std::istringstream values(line);
            double value = 0;
            for (std::size_t i = 0; values >> value; ++i) out << (negated[i] ? -value : value) << ' ';
            out << '\n';
        } else {
            out << line << '\n';
            in_rows = in_rows || word == "Frame";
        }
    }
    return out.str();
}

TEST(BvhUp, PublishedFilesKeepYAndHaveZWhereTheyAreTurned) {
    const auto table = kSharedData / "expected.csv";
    SKIP_WITHOUT(table);
    int upright = 0, turned = 0;
    for (const Row& row : read_rows(table)) {
        const std::string& file = row.at("file");
        if (!file.ends_with(".bvh")) continue;
        const std::string text = read_file(kSharedData / file);
        const MotionFile as_it_is = bvh_motion(parse_bvh(text, file));
        EXPECT_EQ(as_it_is.ground, kYUp) << file;
        EXPECT_EQ(as_it_is.up_doubt, "") << file;
        ++upright;
        const bool z = bvh_motion(parse_bvh(with_z_up(text), file)).ground == kZUp;
        // Four joints made by hand are no body.
        EXPECT_EQ(z, !file.ends_with("rotation_first_root.bvh")) << file;
        turned += z ? 1 : 0;
    }
    EXPECT_EQ(upright, 74);
    EXPECT_EQ(turned, 73);
}

double length_of(const mobb::Clip& clip) {
    double sum = 0;
    for (std::size_t i = 1; i < clip.samples().size(); ++i) {
        const mobb::Disk &a = clip.samples()[i - 1], &b = clip.samples()[i];
        sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
}

TEST(BvhUp, PublicCases) {
    const auto folder = kSharedData / "public";
    SKIP_WITHOUT(folder);
    const ImportedClip rows = import_clips(folder / "bvh_one_row_more_than_frames.bvh", {}).at(0);
    EXPECT_EQ(rows.facts.frames, 61);
    EXPECT_NEAR(length_of(*rows.clip), 4.00, 0.005);
    ASSERT_EQ(rows.facts.warnings.size(), 1u);
    EXPECT_NE(rows.facts.warnings[0].text.find("Frames says 60, but 61 rows follow"), std::string::npos);

    const ImportedClip up = import_clips(folder / "bvh_z_up_cm.bvh", {}).at(0);
    EXPECT_EQ(up.facts.up, "z");
    EXPECT_NEAR(length_of(*up.clip), 4.000, 0.005);
    for (const mobb::Disk& disk : up.clip->samples()) EXPECT_NEAR(disk.r, 0.383, 0.0005);
}

}  // namespace
}  // namespace mobbscope
