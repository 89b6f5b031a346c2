// Comments of texts: what they say of frame rate and unit is taken, anything else is ignored.
#include <import/tracks/remarks.h>

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

namespace mobbscope {
namespace {

Remarks remarks_of(const char* comment) {
    Remarks out;
    out.read(comment);
    return out;
}

TEST(Remarks, TellTheFrameRate) {
    for (const auto& [comment, rate] :
         std::initializer_list<std::pair<const char*, double>>{{" The frame rate was 25 fps.", 25},
                                                               {"framerate: 8.00", 8},
                                                               {" framerate = 29.97 fps", 29.97},
                                                               {"framerate:16", 16},
                                                               {"frame rate 10 Hz", 10},
                                                               {"fps: 12.5", 12.5},
                                                               {" recorded at 50fps", 50},
                                                               {"The camera took 30 frames per second.", 30},
                                                               {"frame rate is about 15/s", 15},
                                                               {" 1000 frames; the frame rate was set to 5", 5},
                                                               {"Framerate [fps]: 20", 20},
                                                               {"frame rate [1/s]: 16", 16},
                                                               {"frame rate (Hz) = 12", 12},
                                                               {"frames per second: 25", 25}}) {
        const Remarks read = remarks_of(comment);
        EXPECT_EQ(read.rate(), std::optional(rate)) << comment;
        EXPECT_TRUE(read.warnings().empty()) << comment;
        EXPECT_FALSE(read.unit()) << comment;
    }
}

TEST(Remarks, WhatTellsNoFrameRateIsPassedOverAndSaid) {
    for (const char* comment : {"framerate: unknown", "framerate: 0", "frame rate: -5", "the frame rate varies",
                                "framerate: see table 3", "frame rate 1e9", "fps:", "framerate: nan"}) {
        const Remarks read = remarks_of(comment);
        EXPECT_FALSE(read.rate()) << comment;
        ASSERT_EQ(read.warnings().size(), 1u) << comment;
        EXPECT_NE(read.warnings()[0].find("does not tell a frame rate and is ignored"), std::string::npos);
    }
    EXPECT_TRUE(remarks_of("the first frame is 25").warnings().empty());
}

TEST(Remarks, ThePlainerWordCounts) {
    Remarks read;
    read.read("The cameras ran at 50 fps.");
    read.read("framerate: 25");
    EXPECT_EQ(read.rate(), 25);
    EXPECT_TRUE(read.warnings().empty());
    read.read("framerate: 16");
    EXPECT_EQ(read.rate(), 25);
    ASSERT_EQ(read.warnings().size(), 1u);
    EXPECT_EQ(read.warnings()[0], "comments tell two frame rates, 25 and 16: the first is taken");
}

TEST(Remarks, TellTheUnit) {
    for (const auto& [comment, unit] :
         std::initializer_list<std::pair<const char*, double>>{{"X,Y,Z: the agents coordinates (in metres)", 1},
                                                               {" id frame x/m y/m z/m", 1},
                                                               {"ID FR X/cm Y/cm Z/cm", 0.01},
                                                               {"x [mm] y [mm]", 0.001},
                                                               {"x[cm]", 0.01},
                                                               {"all positions are given in cm.", 0.01},
                                                               {"[in m]", 1},
                                                               {"(in cm)", 0.01},
                                                               {"units: centimeters", 0.01},
                                                               {"unit is m", 1},
                                                               {"speed in m/s, positions in cm", 0.01},
                                                               {"heights in cm; x and y in m", 1}}) {
        EXPECT_EQ(remarks_of(comment).unit(), std::optional(unit)) << comment;
    }
}

TEST(Remarks, OfSomethingElseAreNoUnit) {
    for (const char* comment : {"speed in m/s", "V: speed of the pedestrian (in m/s)", "Vx in m per s", "heights in cm",
                                "camera height in m: 8", "people in motion", "in mid-air", "radius in m",
                                "x in the image", "made in metro stations", "z/cm"}) {
        EXPECT_FALSE(remarks_of(comment).unit()) << comment;
    }
    Remarks both;
    both.read("all lengths in cm");
    both.read("id frame x/m y/m");
    EXPECT_EQ(both.unit(), 1) << "that of the columns";
}

TEST(Remarks, AnyBytesWillDo) {
    for (const std::string& comment :
         {std::string(), std::string(100'000, 'x'), std::string("frame rate \xff\xfe"), std::string("in"),
          std::string("unit"), std::string("frame"), std::string("x [")}) {
        Remarks read;
        read.read(comment);
        EXPECT_FALSE(read.unit());
    }
}

}  // namespace
}  // namespace mobbscope
