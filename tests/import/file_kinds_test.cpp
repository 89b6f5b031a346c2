// Files by their content, whatever their names: packed ones, and those that no reader takes.
#include "gltf_bytes.h"

#include <base/error.h>
#include <base/file.h>
#include <import/import.h>
#include <support/bvh_text.h>
#include <support/folders.h>
#include <support/gzip.h>
#include <support/input_error.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope {
namespace {

const std::string kTableText = "id,t,x,y,r\n1,0,0,0,1\n1,1,1,0,1\n2,0,5,5,1\n2,1,5,6,1\n";
const std::string kTracksText = "10 1 1.5 2\n20 1 1.5 2.5\n20 2 0 0\n30 2 0 1\n";
const std::string kLinesText =
    "{\"track\": {\"f\": 0, \"p\": 1, \"x\": 0, \"y\": 0}}\n{\"track\": {\"f\": 1, \"p\": 1, \"x\": 1, \"y\": 0}}\n";
const std::string kPlanText = "cost: 3\nschedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 1, x: 1, y: 0}\n";

TEST(FileKinds, TextIsToldByItsContentWhateverItsName) {
    const TempFolder folder;
    for (const auto& [text, format] : std::initializer_list<std::pair<std::string, const char*>>{
             {kTableText, "csv"},
             {kTracksText, "trajnet"},
             {kLinesText, "trajnetpp"},
             {kPlanText, "mapf"},
             {"# framerate: 16\n1 0 0 0 1.7\n1 1 0 1 1.7\n", "petrack"},
             {"id x y t r\n1 0 0 0 1\n1 1 0 1 1\n", "csv"}}) {
        for (const char* name : {"a.csv", "a.txt", "a.tsv", "a.dat", "a", "a.ndjson", "a.yaml", "a.CSV", "a.csv.gz"}) {
            const auto file = folder.write(name, text);
            EXPECT_EQ(import_clips(file, {}).front().facts.format, format) << name;
        }
    }
    EXPECT_EQ(import_clips(folder.write("walk", kWalker), {}).front().facts.format, "bvh");
    EXPECT_EQ(contents_of(folder.path() / "walk"), Contents::skeletons);
    EXPECT_EQ(contents_of(folder.path() / "a.dat"), Contents::table);
    EXPECT_EQ(contents_of(folder.path() / "none"), std::nullopt);
    EXPECT_EQ(contents_by_name("x.txt.gz"), Contents::trajectories);
}

/// A node that goes 2 m along x in a second; its buffer lies in the text.
std::string gltf_text() {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 1});
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 0, 0, 2, 0, 0})).animation();
    return bytes.text(R"([{"name":"hips"}])", "",
                      "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAAAAAAABAAAAAAAAAAAA=");
}

TEST(FileKinds, MotChallengeIsReadWhereItHasPlacesOnTheGround) {
    const TempFolder folder;
    const std::string ground = "1,1,794.2,247.5,71.2,174.8,1,0.5,1.5,0\n2,1,-1,-1,-1,-1,1,1,1.5,0\n";
    ImportOptions options;
    options.fps = 10;
    for (const char* name : {"a.txt", "a.csv", "a"}) {
        const auto file = folder.write(name, ground);
        const ImportedClip clip = import_clips(file, options).front();
        EXPECT_EQ(clip.facts.format, "mot");
        EXPECT_EQ(clip.clip->dt(), 0.1);
        EXPECT_EQ(clip.clip->samples()[1].x, 1);
        EXPECT_NE(input_error([&] { import_clips(file, {}); }).find("frame numbers in place of times: give fps"),
                  std::string::npos);
        for (const char* boxes :
             {"1, 1, 794.2, 247.5, 71.2, 174.8, -1, -1, -1, -1\n", "1,1,794,247,71,174,1,1,0.9\n"}) {
            const std::string said = input_error([&] { import_clips(folder.write(name, boxes), options); });
            EXPECT_NE(said.find("line 1: is of the MOT Challenge, with boxes in an image"), std::string::npos) << said;
            const std::string rest = "frame,id,bb_left,bb_top,bb_width,bb_height,conf";
            EXPECT_NE(said.find(rest.substr(0, rest.rfind(',')) + " and the others"), std::string::npos);
            const std::string named =
                std::string(boxes).find("0.9") == std::string::npos ? ",_,_,_\n" : ",class,seen\n";
            EXPECT_EQ(
                import_clips(folder.write(name, rest + named + boxes + "2" + std::string(boxes).substr(1)), options)
                    .front()
                    .facts.format,
                "csv");
        }
    }
    EXPECT_EQ(import_clips(folder.write("xy.txt", "1,1,-1,-1,-1,-1,1,0.5,1.5\n2,1,-1,-1,-1,-1,1,1,1.5\n"), options)
                  .front()
                  .clip->samples()[1]
                  .x,
              1)
        << "where there is no box the last two of nine are the place";
    EXPECT_NE(input_error([&] {
                  import_clips(folder.write("b.csv", "0.5,1,2,3,4,5,6,7,8,9\n"), {});
              }).find("there is no header"),
              std::string::npos)
        << "numbers of something else";
}

TEST(FileKinds, GltfIsToldByItsContentWhateverItsName) {
    const TempFolder folder;
    const std::string text = gltf_text();
    const std::string glb = join_glb(text, "");
    for (const char* name :
         {"a.gltf", "a.glb", "a.vrma", "a.vrm", "a.VRM", "a.GLB", "a.bin", "a", "a.txt", "a.fbx", "a.bvh"}) {
        for (const std::string& bytes :
             {text, glb, " \r\n" + text, "\xef\xbb\xbf" + text, gzipped(text), gzipped(glb)}) {
            const auto file = folder.write(name, bytes);
            const ImportedClip clip = import_clips(file, {}).front();
            EXPECT_EQ(clip.facts.format, "gltf") << name;
            EXPECT_EQ(clip.facts.root, "hips") << name;
            EXPECT_NEAR(clip.clip->samples().back().x, 2, 1e-6) << name;
        }
    }
    EXPECT_EQ(contents_of(folder.write("b", glb)), Contents::skeletons);
    EXPECT_EQ(contents_of(folder.write("b", text)), Contents::skeletons);
    EXPECT_EQ(contents_by_name("b.vrma"), Contents::skeletons);
    // What stands first does not matter, nor how long it is.
    std::string late = text;
    const std::string asset = R"("asset":{"version":"2.0"},)";
    ASSERT_EQ(late.find(asset), 1u);
    late.erase(1, asset.size());
    late.insert(late.size() - 1, "," + asset.substr(0, asset.size() - 1));
    EXPECT_EQ(import_clips(folder.write("late", late), {}).front().facts.format, "gltf");
    late.insert(late.size() - 1, R"(,"extras":")" + std::string(100'000, 'x') + '"');
    EXPECT_EQ(import_clips(folder.write("late", late), {}).front().facts.format, "gltf");
    late.insert(late.rfind("\"asset\""), R"("copies":[")" + std::string(100'000, 'x') + "\"],");
    EXPECT_EQ(import_clips(folder.write("late", late), {}).front().facts.format, "gltf") << "beyond what is looked at";
}

TEST(FileKinds, TheDocumentsListEveryFormatOfTracks) {
    const std::string document = slurp(kSource / "docs/trajectories.md");
    EXPECT_NE(document.find("\n" + documented_track_formats() + "\n"), std::string::npos)
        << "the table in docs/trajectories.md has to have these rows:\n"
        << documented_track_formats();
    for (const FileReader* reader : file_readers())
        EXPECT_EQ(reader->note.who.empty(), reader->contents == Contents::skeletons || reader->name == "text-tracks")
            << reader->name;
}

TEST(FileKinds, WhatIsNearlyGltfIsNot) {
    const TempFolder folder;
    const auto refusal = [&](const std::string& name, const std::string& bytes) {
        return input_error([&] { import_clips(folder.write(name, bytes), {}); });
    };
    for (const char* json : {"{}", R"({"asset":"2.0"})", R"({"asset":{"generator":"x"}})", R"({"version":"2.0"})",
                             R"([{"asset":{"version":"2.0"}}])", R"({"a":{"asset":{"version":"2.0"}}})",
                             R"({"accessors":[],"bufferViews":[]})"}) {
        EXPECT_NE(refusal("a", json).find("looks like JSON"), std::string::npos) << json;
    }
    EXPECT_NE(refusal("a", R"({"asset":{"version":"1.0"}})").find("/asset/version: is '1.0'"), std::string::npos);
    EXPECT_NE(refusal("a.vrm", "glTF").find("GLB header: the file ends after 4 bytes"), std::string::npos);
    EXPECT_NE(refusal("a.glb", "VRM!").find("does not begin with 'glTF'"), std::string::npos);
    EXPECT_NE(refusal("a.glb", "{\"asset\"").find("line 1, column 8: is not valid JSON"), std::string::npos);
}

TEST(FileKinds, PackedTextIsReadAsItIs) {
    const TempFolder folder;
    for (const auto& [name, text] :
         std::initializer_list<std::pair<const char*, std::string>>{{"walk.csv.gz", kTableText},
                                                                    {"walk.txt.gz", kTracksText},
                                                                    {"walk.ndjson.gz", kLinesText},
                                                                    {"walk.yaml.gz", kPlanText},
                                                                    {"walk.bvh.gz", kWalker},
                                                                    {"walk.gz", kTableText},
                                                                    {"walk.csv", kTableText}}) {
        const auto packed = import_clips(folder.write(name, gzipped(text)), {});
        const auto plain = import_clips(folder.write("plain", text), {});
        ASSERT_EQ(packed.size(), plain.size()) << name;
        EXPECT_TRUE(
            std::ranges::equal(packed[0].clip->samples(), plain[0].clip->samples(), {}, &mobb::Disk::x, &mobb::Disk::x))
            << name;
        if (packed.size() == 1) {
            EXPECT_EQ(packed[0].name, "walk");
        }
    }
    // In several pieces, as parallel packers write it, and padded.
    const auto pieces = folder.write(
        "p.csv.gz", gzipped(kTableText.substr(0, 20)) + gzipped(kTableText.substr(20)) + std::string(512, '\0'));
    EXPECT_EQ(import_clips(pieces, {}).size(), 2u);
}

TEST(FileKinds, DamagedPackedFilesAreRefusedInOneLine) {
    const TempFolder folder;
    std::string text = "t,x,y,r\n";
    for (int i = 0; i < 2000; ++i) text += std::to_string(i) + ',' + std::to_string(i * i % 977) + ",0,1\n";
    const std::string packed = gzipped(text);
    const auto refusal = [&](const std::string& bytes) {
        const auto file = folder.write("f.csv.gz", bytes);
        return input_error([&] { import_clips(file, {}); });
    };
    for (std::size_t size = 2; size < packed.size(); size += 97)
        EXPECT_NE(refusal(packed.substr(0, size)).find("ends within what gzip packed; get the whole file"),
                  std::string::npos)
            << size;
    EXPECT_NE(refusal(packed + "more").find("other bytes follow what gzip packed"), std::string::npos);
    std::string sum = packed;
    sum[sum.size() - 6] ^= 1;
    EXPECT_NE(refusal(sum).find("what gzip packed is damaged"), std::string::npos) << "its sum is wrong";
    std::string length = packed;
    length[length.size() - 2] ^= 1;
    EXPECT_NE(refusal(length).find("what gzip packed is damaged"), std::string::npos);
    // A bomb: a thousandth of what it becomes.
    const std::string bomb = gzipped("t,x,y,r\n" + std::string(std::size_t{100} << 20, '0'));
    EXPECT_LT(bomb.size(), std::size_t{1} << 20);
    EXPECT_NE(refusal(bomb).find("unpacks to more than 67.1 MB"), std::string::npos) << refusal(bomb);
    // Of a large one what was read counts, not what is still to come.
    std::string large = bomb + gzipped(std::string(std::size_t{1} << 16, 'a'));
    for (int i = 0; i < 3; ++i) large += large;
    EXPECT_NE(refusal(large).find("unpacks to more than 67.1 MB"), std::string::npos) << refusal(large);
    EXPECT_NE(refusal(gzipped(gzipped(text))).find("packed by gzip twice"), std::string::npos);
    std::mt19937 random(20240610);
    for (int round = 0; round < 300; ++round) {
        const auto file = folder.write("m.csv.gz", mutated(packed, random));
        try {
            import_clips(file, {});
        } catch (const InputError& error) {
            ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
}

TEST(FileKinds, WhatNoReaderTakesIsToldByItsLooks) {
    const TempFolder folder;
    using namespace std::string_literals;
    for (const auto& [bytes, looks] : std::initializer_list<std::pair<std::string, const char*>>{
             {"{\"a\": 1}", "looks like JSON"},
             {"[[1,2],[3,4]]", "looks like JSON"},
             {"\x89PNG\r\n\x1a\n\0\0"s, "looks like an image (PNG)"},
             {"\xff\xd8\xff\xe0\0\x10JFIF"s, "looks like an image (JPEG)"},
             {"PK\x03\x04\x14\0\x06\0"s, "looks like a ZIP archive (as .xlsx"},
             {"\x89HDF\r\n\x1a\n"s, "looks like an HDF5 file"},
             {"\x80\x04\x95\0\0"s, "looks like a Python pickle"},
             {"PAR1\x15\x04"s, "looks like a Parquet file"},
             {"\x93NUMPY\x01\0v\0{'descr'"s, "looks like a NumPy array"},
             {"<!DOCTYPE html>\n<html><body>", "looks like an HTML page"},
             {"  <html>", "looks like an HTML page"},
             {"<?xml version=\"1.0\"?>\n<tracks>", "looks like XML (tracks); export the table as CSV"},
             {"<?xml version=\"1.0\"?>\n<kml xmlns=\"a\">", "looks like KML, whose places are degrees; project them"},
             {"\xef\xbb\xbf<!-- <svg> --><gpx>", "looks like GPX, whose places are degrees"},
             {"<d:COLLADA version=\"1\">", "looks like COLLADA; export the motion as BVH, glTF or FBX"},
             {"<net>", "looks like a SUMO network; run SUMO with --fcd-output"},
             {"[{\"x\": 1}]", "looks like JSON, a list; write it as CSV"},
             {R"({"type": "FeatureCollection", "features": []})", "looks like GeoJSON, whose places are degrees"},
             {R"({"type": "Point", "coordinates": [1, 2]})", "looks like GeoJSON"},
             {R"({"mapFile": "a.map", "teamSize": 2})", "looks like a problem for Robot Runners"},
             {"#usda 1.0\n(\n)\n", "looks like USD; export the motion"},
             {"# AST/ASF file generated\n:version 1.10\n", "looks like ASF, a skeleton whose motion is in an AMC file"},
             {":version 1.10\n:name x\n", "looks like ASF"},
             {"#!OML:ASF\n:FULLY-SPECIFIED\n", "looks like AMC, a motion whose skeleton is in an ASF file"},
             {"version 1\n0\tm.map\t32\t32\t0\t0\t4\t0\t4\n", "looks like tasks for path finding"},
             {"type octile\nheight 2\nwidth 2\nmap\n..\n..\n", "looks like a map for path finding"},
             {"\x02P\x01\0"s, "looks like C3D"},
             {"PathFileType\t4\t(X/Y/Z)\n", "looks like TRC"},
             {"version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 3\n", "looks like a Git LFS pointer"},
             {"%PDF-1.5\n", "looks like a PDF"},
             {"BZh91AY&SY\x01", "looks like packed by bzip2"},
             {"7z\xbc\xaf\x27\x1c", "looks like a 7-Zip archive"}}) {
        for (const char* name : {"a.csv", "a.txt", "a.dat", "a.yaml", "a"}) {
            const auto file = folder.write(name, bytes);
            const std::string said = input_error([&] { import_clips(file, {}); });
            EXPECT_NE(said.find(looks), std::string::npos) << name << ' ' << said;
        }
    }
    const std::string said = input_error([&] { import_clips(folder.write("a.dat", "hello world\n"), {}); });
    EXPECT_NE(said.find("looks like text, but no table with a header such as id,t,x,y"), std::string::npos) << said;
    const std::string bytes = input_error([&] { import_clips(folder.write("b.dat", "a\x01"), {}); });
    EXPECT_NE(bytes.find("no reader for this kind of file"), std::string::npos) << bytes;
    EXPECT_NE(input_error([&] { import_clips(folder.write("b", ""), {}); }).find("is empty"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
