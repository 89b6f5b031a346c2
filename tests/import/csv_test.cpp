#include "imported.h"

#include <import/import.h>
#include <import/tracks/text_rows.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

const mobb::Clip& only(const std::vector<ImportedClip>& clips) {
    EXPECT_EQ(clips.size(), 1u);
    return *clips.at(0).clip;
}

TEST(Csv, ColumnsAreTakenByName) {
    const auto read = csv_clips("r,y,t,x\n0.4,2,0,1\n0.5,4,0.5,3\n");
    const mobb::Clip& clip = only(read);
    EXPECT_EQ(clip.dt(), 0.5);
    EXPECT_EQ(clip.samples()[1].x, 3);
    EXPECT_EQ(clip.samples()[1].y, 4);
    EXPECT_EQ(clip.samples()[1].r, 0.5);
    EXPECT_EQ(read[0].name, "f");
}

TEST(Csv, FieldsInQuotesMayGoOverLines) {
    const std::string header = "id,t,x,y,\"a\nnote\"\r\n";
    const std::string rows = "a,0,0,0,\"one\r\n\r\n, \"\"two\"\"\n\"\r\na,1,3,0,\"\"\n";
    const std::string large = "b,0,5,0,\"" + std::string(200'000, '\n') + "\"\nb,1,6,0,x\"y\n";
    const auto read = csv_clips(header + rows + large);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].clip->samples()[1].x, 3);
    EXPECT_EQ(read[1].clip->samples()[1].x, 6);
    EXPECT_TRUE(csv_refusal(header + rows + "a,2,z,0,\n").starts_with("f.csv: line 8, column 3 (x): 'z' is not"));
    EXPECT_TRUE(csv_refusal(header + rows + large + "b,2,z,0,\n").starts_with("f.csv: line 200010, column 3"));
    EXPECT_TRUE(csv_refusal(header + "a,0,z,0,\"\n\"\n").starts_with("f.csv: line 3, column 3 (x)"))
        << "its first line";
    EXPECT_TRUE(csv_refusal(header + rows + "a,2,4,0,\"x\ny\n").starts_with("f.csv: line 8, column 5"));
    EXPECT_EQ(csv_clips("id;t;x;y\n\"a\nb\";0;0;0\n\"a\nb\";1;1;0\n").at(0).id, "a\nb");
    EXPECT_EQ(csv_clips("\"a\nnote\";id;t;x;y\n;1;0;0;0\n;1;1;1;0\n").at(0).id, "1");
}

TEST(Csv, BlanksBlankLinesQuotesLineEndsAndByteOrderMarkDoNotMatter) {
    const std::string_view plain = "t,x,y,r\n0,0,0,0.4\n1,0,1,0.4";
    const std::string_view odd = "\xef\xbb\xbf t , \"x\",\ty,r\r\n\r\n 0 , 0,0,\"0.4\" \r\n  \n1,0,+1,4e-1\r\n\r\n";
    const auto a = csv_clips(plain);
    const auto b = csv_clips(odd);
    ASSERT_EQ(only(a).count(), only(b).count());
    EXPECT_EQ(only(b).samples()[1].y, 1);
    EXPECT_EQ(only(b).samples()[1].r, 0.4);
}

/// Rows from `first` on, `step` apart, as text.
std::string rows_from(const std::vector<std::string>& times, const std::string& before) {
    std::string out = before.empty() ? "t [s],x,y,r\n" : "id,t [s],x,y,r\n";
    int x = 0;
    for (const std::string& time : times) out += before + time + ',' + std::to_string(x++) + ",0,0.4\n";
    return out;
}

TEST(Csv, TimesThatDoublesCannotTellApartAreRefused) {
    const std::vector<std::string> equal{"1000000000000", "1000000000000.00001", "1000000000000.00002"};
    const std::vector<std::string> coarse{"900000000000", "900000000000.0002", "900000000000.0004"};
    for (const std::string before : {"", "a,"}) {
        EXPECT_NE(input_error([&] {
                      csv_clips(rows_from(equal, before));
                  }).find("doubles tell such times apart by 0.00012 s; count times from a later moment"),
                  std::string::npos)
            << input_error([&] { csv_clips(rows_from(equal, before)); });
        EXPECT_NE(input_error([&] {
                      csv_clips(rows_from(coarse, before));
                  }).find("its times reach 9e+11 s, where doubles tell times apart by 0.00012 s"),
                  std::string::npos)
            << input_error([&] { csv_clips(rows_from(coarse, before)); });
    }
    EXPECT_NO_THROW(csv_clips(rows_from({"1700000000.00", "1700000000.04", "1700000000.08"}, "")));
    EXPECT_NE(input_error([&] {
                  csv_clips(rows_from({"0", "1e-10", "2e-10"}, ""));
              }).find("dt must be"),
              std::string::npos);
}

TEST(Csv, TracksAreSplitById) {
    const std::string_view text =
        "id,t,x,y,r\n7,0,1,0,0.3\n\"a,\"\"b\",5,2,0,0.3\n7,1,3,0,0.3\n\"a,\"\"b\",7,4,0,0.3\n";
    const auto both = csv_clips(text);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[0].name, "7");
    EXPECT_EQ(both[1].id, "a,\"b");
    EXPECT_EQ(both[1].clip->dt(), 2);
    EXPECT_EQ(both[0].clip->samples()[1].x, 3);
    ImportOptions one;
    one.id = "7";
    EXPECT_EQ(only(csv_clips(text, one)).samples()[0].x, 1);
    one.id = "8";
    EXPECT_NE(csv_refusal(text, one).find("no track '8'"), std::string::npos);
    EXPECT_EQ(csv_field(both[1].id), "\"a,\"\"b\"");
}

TEST(Csv, RoundedTimesKeepTheRowsAndTheirSpan) {
    const auto read = csv_clips("t,x,y,r\n0,0,0,0.4\n0.033333,1,0,0.4\n0.066667,2,0,0.4\n0.1,3,0,0.4\n");
    EXPECT_EQ(only(read).count(), 4);
    EXPECT_EQ(only(read).dt(), 0.1 / 3);
    EXPECT_TRUE(read[0].facts.warnings.empty());
}

TEST(Csv, OtherTimesAreResampledFromTheFirstToTheLast) {
    const std::string_view text = "t,x,y,r\n10,0,0,0.4\n10.1,1,0,0.4\n10.35,2,0,0.6\n10.4,3,0,0.4\n";
    const auto read = csv_clips(text);
    EXPECT_EQ(only(read).count(), 13);
    EXPECT_EQ(only(read).dt(), 1.0 / 30);
    EXPECT_EQ(only(read).samples()[3].x, 1);
    EXPECT_EQ(only(read).samples()[12].x, 3);
    EXPECT_NEAR(only(read).samples()[6].x, 1 + 0.1 / 0.25, 1e-12);
    ImportOptions ten;
    ten.fps = 10;
    EXPECT_EQ(only(csv_clips(text, ten)).count(), 5);
    ASSERT_EQ(read[0].facts.warnings.size(), 1u);
    EXPECT_EQ(said(read[0].facts.warnings[0]), "the times are not uniform; the path is resampled at 30 fps (line 3)");
    EXPECT_NE(csv_clips(text, ten)[0].facts.warnings.at(0).text.find("resampled at 10 fps"), std::string::npos);
}

TEST(Csv, AWarningNamesTheLineInTheFileNotInTheTrack) {
    const auto read = csv_clips("id,t,x,y,r\na,0,0,0,0\nb,0,0,0,0\n\na,1,0,0,0\nb,1,0,0,0\nb,5.5,0,0,0\na,2,0,0,0\n");
    EXPECT_TRUE(read.at(0).facts.warnings.empty());
    ASSERT_EQ(read.at(1).facts.warnings.size(), 1u);
    EXPECT_EQ(said(read[1].facts.warnings[0]), "the times are not uniform; the path is resampled at 30 fps (line 7)");
}

TEST(Csv, WithoutTimesDtIsNeeded) {
    EXPECT_EQ(csv_refusal("x,y,r\n0,0,0.4\n"),
              "f.csv: line 1: the header names no column t; name one or give dt (seconds between rows)");
    ImportOptions options;
    options.dt = 0.25;
    EXPECT_EQ(only(csv_clips("x,y,r\n0,0,0.4\n1,0,0.4\n", options)).dt(), 0.25);
    EXPECT_NE(csv_refusal("t,x,y,r\n0,0,0,0.4\n").find("one row does not tell how long it lasts"), std::string::npos);
    const auto one = csv_clips("t,x,y,r\n3,0,0,0.4\n", options);
    EXPECT_EQ(only(one).dt(), 0.25);
    EXPECT_EQ(one[0].facts.warnings, (std::vector<ImportWarning>{{"there is one row: it holds for 0.25 s", "dt"}}));
    EXPECT_EQ(csv_clips("t,x,y,r\n0,0,0,0\n1,0,0,0\n", options)[0].facts.warnings.size(), 1u);
}

TEST(Csv, RadiusMayComeFromOutside) {
    EXPECT_NE(csv_refusal("t,x,y\n0,0,0\n1,0,0\n").find("no column r"), std::string::npos);
    ImportOptions options;
    options.radius = 0.3;
    EXPECT_EQ(only(csv_clips("t,x,y\n0,0,0\n1,0,0\n", options)).samples()[1].r, 0.3);
    EXPECT_EQ(only(csv_clips("t,x,y,r\n0,0,0,1\n1,0,0,1\n", options)).samples()[1].r, 0.3);
}

TEST(Csv, UnitScalesLengthsButNotTheRadiusGivenInMetres) {
    ImportOptions options;
    options.unit = "cm";
    const auto scaled = csv_clips("t,x,y,r\n0,100,-50,40\n1,0,0,0\n", options);
    EXPECT_EQ(only(scaled).samples()[0].x, 1);
    EXPECT_EQ(only(scaled).samples()[0].y, -0.5);
    EXPECT_DOUBLE_EQ(only(scaled).samples()[0].r, 0.4);
    options.radius = 0.3;
    EXPECT_EQ(only(csv_clips("t,x,y,r\n0,100,-50,40\n1,0,0,0\n", options)).samples()[0].r, 0.3);
    options.unit = "2.5";
    EXPECT_EQ(only(csv_clips("t,x,y,r\n0,2,0,0\n1,0,0,0\n", options)).samples()[0].x, 5);
    options.unit = "auto";
    EXPECT_NE(csv_refusal("t,x,y,r\n0,2,0,0\n1,0,0,0\n", options).find("unit 'auto' does not apply to CSV"),
              std::string::npos);
}

TEST(Csv, TrimTakesSecondsFromTheFirstRow) {
    std::string text = "t,x,y,r\n";
    for (int i = 0; i <= 10; ++i) text += std::to_string(100 + i) + ',' + std::to_string(i) + ",0,0.4\n";
    ImportOptions options;
    options.trim = {2, 5};
    const auto rows = csv_clips(text, options);
    EXPECT_EQ(only(rows).count(), 4);
    EXPECT_EQ(only(rows).samples()[0].x, 2);
    EXPECT_EQ(only(rows).dt(), 1);
    EXPECT_TRUE(rows[0].facts.warnings.empty());
    options.trim = {2.5, 99};
    EXPECT_EQ(
        csv_clips(text, options)[0].facts.warnings,
        (std::vector<ImportWarning>{{"trim ends at 99 s, but the file lasts 10 s; all to the end is taken", "trim"}}));
    EXPECT_EQ(only(csv_clips(text, options)).count(), 8);
    EXPECT_EQ(only(csv_clips(text, options)).samples()[0].x, 2.5);
    options.trim = {20, 30};
    EXPECT_NE(csv_refusal(text, options).find("nobody is there between 20 and 30 s of trim"), std::string::npos);
}

TEST(Csv, OptionsOutOfRangeOrForOtherFormatsAreRefused) {
    const TempFolder folder;
    const auto file = folder.write("a.csv", "t,x,y,r\n0,0,0,0\n1,0,0,0\n");
    const auto with = [&](auto set) {
        ImportOptions options;
        set(options);
        return input_error([&] { import_clips(file, options); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(with([](auto& o) { o.fps = 0; }).find("fps"), std::string::npos);
    EXPECT_NE(with([&](auto& o) { o.fps = nan; }).find("fps"), std::string::npos);
    EXPECT_NE(with([&](auto& o) { o.dt = nan; }).find("dt"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.radius = -1.0; }).find("radius"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.trim = {3, 2}; }).find("trim"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.unit = "furlong"; }).find("unit"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.up = "z"; }).find("up does not apply"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.root = "Hips"; }).find("root does not apply"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.animation = "0"; }).find("animation does not apply"), std::string::npos);
    EXPECT_NE(with([](auto& o) { o.id = "0"; }).find("no column id"), std::string::npos);
}

TEST(Csv, MessagesNameLineColumnAndRemedy) {
    EXPECT_EQ(csv_refusal("x,y,t,r\n0,0,0,0.4\n0,abc,1,0.4\n"),
              "f.csv: line 3, column 2 (y): 'abc' is not a finite number; write it like 0.25");
    EXPECT_EQ(csv_refusal("x,y,t,r\n\n0,0,0,\n"), "f.csv: line 3, column 4 (r): the field is empty; give a number");
    EXPECT_NE(csv_refusal("x,y,t,speed\n0,0,0,1\n").find("line 1: the header names no column r"), std::string::npos);
    EXPECT_NE(csv_refusal("x,y,x,r\n").find("stands twice"), std::string::npos);
    EXPECT_NE(csv_refusal("t,x,r\n").find("no column y"), std::string::npos);
    EXPECT_NE(csv_refusal("t,x,y,r\n0,0,0,\"0.4\n").find("quote is not closed"), std::string::npos);
    EXPECT_NE(csv_refusal("t,x,y,r\n0,0,0,\"0.4\"5\n").find("comma must follow"), std::string::npos);
    EXPECT_NE(csv_refusal("id,t,x,y,r\n,0,0,0,0\n").find("name the track"), std::string::npos);
    EXPECT_NE(csv_refusal("id,t,x,y,r\ncaf\xe9,0,0,0,0\n").find("not UTF-8 text"), std::string::npos);
    EXPECT_NE(csv_refusal("t,x,y,r\r0,0,0,0\r").find("carriage returns"), std::string::npos);
}

TEST(Csv, AColumnThatTheRadiusNamesHoldsTheRadii) {
    const std::string text = "id,t,x,y,width,r\na,0,0,0,30,1\na,1,5,0,40,1\nb,0,9,9,50,1\nb,1,9,9,60,1\n";
    ImportOptions options;
    options.radius = radius_from_text("width");
    options.unit = "cm";
    const auto read = csv_clips(text, options);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_DOUBLE_EQ(read[0].clip->samples()[1].r, 0.4) << "in the file's unit, as r is";
    EXPECT_DOUBLE_EQ(read[1].clip->samples()[0].r, 0.5);
    options.radius = radius_from_text("r");
    EXPECT_DOUBLE_EQ(csv_clips(text, options)[0].clip->samples()[0].r, 0.01);
    EXPECT_EQ(csv_clips("t,x,y,r\n0,0,0,7\n1,0,0,7\n", options)[0].clip->samples()[0].r, 0.07);
    options.radius = radius_from_text("widht");
    EXPECT_NE(csv_refusal(text, options).find("names no column 'widht' of radii (did you mean 'width'?)"),
              std::string::npos);
    options.radius = radius_from_text("width");
    EXPECT_EQ(csv_refusal("t,x,y,width\n0,0,0,1\n1,0,0,-2\n", options),
              "f.csv: line 3, column 4 (width): the radius is negative; give 0 or more");
    EXPECT_NE(csv_refusal("t,x,y,width,width\n0,0,0,1,1\n", options).find("stands twice"), std::string::npos);
    const ImportOffer offer = track_offer(parse_csv(text, "f.csv", options), "f.csv", options);
    ASSERT_EQ(offer.find("radius")->choices.size(), 1u);
    EXPECT_EQ(offer.find("radius")->choices[0].value, "r");
}

TEST(Csv, RadiiByIdAreMetres) {
    const TempFolder folder;
    ImportOptions options;
    options.unit = "cm";
    options.radius = radius_from_text(folder.write("radii.csv", "id,radius\n\"a, left\",0.3\nb,0.4\n").string());
    const auto read = csv_clips("id,t,x,y\n\"a, left\",0,0,0\n\"a, left\",1,0,0\nb,0,1,1\nb,1,1,1\n", options);
    EXPECT_EQ(read[0].clip->samples()[0].r, 0.3);
    EXPECT_EQ(read[1].clip->samples()[1].r, 0.4);
    EXPECT_NE(csv_refusal("t,x,y\n0,0,0\n1,0,0\n", options).find("has no ids; give metres"), std::string::npos);
}

TEST(Csv, WhatLooksLikeAMistypedNumberIsNoColumn) {
    for (const char* bad : {"", " 5", "5m", "0x10", "1,5", "nan", "inf", "-", "#r", "width "}) {
        EXPECT_THROW(radius_from_text(bad), std::invalid_argument) << bad;
    }
    EXPECT_EQ(radius_from_text("0.5"), Radius(0.5));
    EXPECT_EQ(radius_from_text("_w"), Radius(RadiusColumn{"_w"}));
    EXPECT_NE(input_error([] { radius_from_text("no_such.csv"); }).find("no_such.csv"), std::string::npos);
}

TEST(Csv, AbsurdCountsAreRefusedBeforeTheyAreMade) {
    EXPECT_NE(csv_refusal("t,x,y,r\n0,0,0,0\n1,0,0,0\n1e12,0,0,0\n").find("more than 2000006 samples"),
              std::string::npos);
    std::string many_commas = "t,x,y,r\n" + std::string(5'000'000, ',') + "\n";
    EXPECT_NE(csv_refusal(many_commas).find("more than 4 values"), std::string::npos);
    // The limit is for the file, not for each of its tracks.
    std::string tracks = "id,t,x,y,r\n";
    for (char id = 'a'; id < 'd'; ++id) {
        for (const char* t : {"0", "1", "1.37", "25000"}) tracks += std::string(1, id) + ',' + t + ",0,0,0\n";
    }
    ImportOptions whole;
    whole.keep_jumps = true;
    EXPECT_NE(csv_refusal(tracks, whole).find("track 'c'"), std::string::npos);
    // A gap may hold a hundred times what the file holds, and ten thousand.
    EXPECT_NE(csv_refusal("id,t,x,y,r\na,0,0,0,0\na,1,0,0,0\na,20000,0,0,0\n", whole).find("more than 10300 samples"),
              std::string::npos);
}

TEST(Csv, OtherExtensionsAreRefusedByName) {
    EXPECT_EQ(
        input_error([] { import_clips("walk.xyz", {}); }),
        "walk.xyz: no reader for this kind of file; clips can be .bvh, .gltf, .glb, .fbx and .csv, trajectories .txt, "
        ".ndjson, .yaml, .xml and .sqlite, scenes .json");
}

}  // namespace
}  // namespace mobbscope
