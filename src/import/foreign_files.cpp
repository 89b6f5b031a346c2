#include <base/json.h>
#include <base/text.h>
#include <import/foreign_files.h>
#include <import/tracks/xml_text.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace mobbscope {

namespace {

constexpr const char* kExport = "export the table as CSV";
constexpr const char* kPandas = "load it with pandas and write it with to_csv";
constexpr const char* kUnpack = "unpack it first (gzip is unpacked here)";
constexpr const char* kMotion = "export the motion as BVH, glTF or FBX";
constexpr const char* kDegrees = "project them to metres, as GIS programs do, and write id,t,x,y as CSV";
constexpr const char* kRunSumo = "run SUMO with --fcd-output and give what it writes";
constexpr const char* kDownload = "download the file itself, not the page about it";
constexpr const char* kPicture = "give the tracks, not a picture of them";

struct ForeignKind {
    std::string_view begins;  ///< text in small letters
    const char* what;
    const char* to_do;
    std::size_t at = 0;  ///< where that stands
};

using namespace std::string_view_literals;

constexpr ForeignKind kForeign[] = {
    {"version https://git-lfs"sv, "a Git LFS pointer, which only names the file", "run git lfs pull"},
    {"<!doctype html"sv, "an HTML page", kDownload},
    {"<html"sv, "an HTML page", kDownload},
    {"<"sv, "XML or HTML", kExport},
    {"{"sv, "JSON, but neither a scene, which has clips, nor tracks or motion that are known",
     "write it as CSV: id,t,x,y"},
    {"["sv, "JSON, a list", "write it as CSV (id,t,x,y), as pandas.read_json and to_csv do"},
    {"pk\x03\x04"sv, "a ZIP archive (as .xlsx, .ods and .npz are)", "unpack it, or export the table as CSV"},
    {"\xd0\xcf\x11\xe0"sv, "an old Excel or Word file", kExport},
    {"\x89hdf\r\n"sv, "an HDF5 file", kPandas},
    {"par1"sv, "a Parquet file", kPandas},
    {"arrow1"sv, "an Arrow or Feather file", kPandas},
    {"\x80\x02"sv, "a Python pickle", kPandas},
    {"\x80\x03"sv, "a Python pickle", kPandas},
    {"\x80\x04"sv, "a Python pickle", kPandas},
    {"\x80\x05"sv, "a Python pickle", kPandas},
    {"\x93numpy"sv, "a NumPy array", "write it with numpy.savetxt, with a header"},
    {"matlab 5.0"sv, "a MATLAB file", kExport},
    {"\x89png"sv, "an image (PNG)", kPicture},
    {"\xff\xd8\xff"sv, "an image (JPEG)", kPicture},
    {"gif8"sv, "an image (GIF)", kPicture},
    {"ii*\0"sv, "an image (TIFF)", kPicture},
    {"mm\0*"sv, "an image (TIFF)", kPicture},
    {"riff"sv, "a video, image or sound (RIFF)", kPicture},
    {"ftyp"sv, "a video (MP4)", kPicture, 4},
    {"%pdf"sv, "a PDF document", kExport},
    {"\x1f\x8b"sv, "packed by gzip twice", "unpack it once by hand"},
    {"bzh"sv, "packed by bzip2", kUnpack},
    {"\xfd"
     "7zxz"sv,
     "packed by xz", kUnpack},
    {"\x28\xb5\x2f\xfd"sv, "packed by Zstandard", kUnpack},
    {"7z\xbc\xaf"sv, "a 7-Zip archive", kUnpack},
    {"rar!"sv, "a RAR archive", kUnpack},
    {"ustar"sv, "a tar archive", "unpack it first", 257},
    {"#rosbag"sv, "a ROS bag", kExport},
    {"\x89mcap"sv, "a ROS bag (MCAP)", kExport},
    {"#usda"sv, "USD", kMotion},
    {"pxr-usdc"sv, "USD", kMotion},
    {"# ast/asf"sv, "ASF, a skeleton whose motion is in an AMC file", "convert both together to BVH"},
    {":version"sv, "ASF, a skeleton whose motion is in an AMC file", "convert both together to BVH"},
    {"#!oml:asf"sv, "AMC, a motion whose skeleton is in an ASF file", "convert both together to BVH"},
    {":fully-specified"sv, "AMC, a motion whose skeleton is in an ASF file", "convert both together to BVH"},
    {"pathfiletype"sv, "TRC, markers without a skeleton", kMotion},
    {"\x02p"sv, "C3D, markers without a skeleton", kMotion},
    {"blender"sv, "a Blender file", kMotion},
    {"%yaml 1.1\n%tag !u!"sv, "an asset of Unity", kMotion},
    {"ply"sv, "a cloud of points (PLY)", "give the tracks of what was seen"},
    {"# .pcd"sv, "a cloud of points (PCD)", "give the tracks of what was seen"},
    {"version 1"sv, "tasks for path finding (a Moving AI .scen)", "give the plan that was made for them"},
    {"type octile"sv, "a map for path finding (Moving AI)", "give the plan that was made on it"},
    {"\x7f"
     "elf"sv,
     "a program", "give a file of tracks"},
};

/// By the name of their outermost element.
constexpr ForeignKind kXml[] = {
    {"kml"sv, "KML, whose places are degrees", kDegrees},
    {"gpx"sv, "GPX, whose places are degrees", kDegrees},
    {"osm"sv, "OpenStreetMap, places without tracks", "give tracks"},
    {"html"sv, "an HTML page", kDownload},
    {"svg"sv, "an image (SVG)", kPicture},
    {"net"sv, "a SUMO network", kRunSumo},
    {"routes"sv, "SUMO's routes", kRunSumo},
    {"configuration"sv, "a SUMO configuration", kRunSumo},
    {"sumo-netstate"sv, "SUMO's raw dump, which has no places", kRunSumo},
    {"netstate"sv, "SUMO's raw dump, which has no places", kRunSumo},
    {"collada"sv, "COLLADA", kMotion},
    {"mvnx"sv, "MVNX of Xsens", kMotion},
    {"graphml"sv, "a graph", "give the plan that was made on it"},
    {"trajectories"sv, "trajectories of JuPedSim before 2023", "write their rows as text: id frame x y"},
    {"commonroad"sv, "CommonRoad", "write the states of its obstacles as CSV: id,t,x,y"},
    {"opendrive"sv, "OpenDRIVE, roads without tracks", "give tracks"},
    {"openscenario"sv, "OpenSCENARIO, not what came of it", "give tracks"},
};

/// For JSON by one of its keys.
constexpr ForeignKind kJson[] = {
    {"features"sv, "GeoJSON, whose places are degrees", kDegrees},
    {"geometry"sv, "GeoJSON, whose places are degrees", kDegrees},
    {"coordinates"sv, "GeoJSON, whose places are degrees", kDegrees},
    {"annotations"sv, "COCO annotations, boxes in pictures", "write their tracks as CSV: id,t,x,y"},
    {"mapFile"sv, "a problem for Robot Runners", "give the plan that was made for it"},
};

std::string looks(const ForeignKind& kind) { return "looks like " + std::string(kind.what) + "; " + kind.to_do; }

}  // namespace

std::optional<std::string> foreign_kind(std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    constexpr std::size_t kHead = 512, kJsonHead = std::size_t{1} << 16, kLongestName = 40;
    const std::string whole = lower(bytes.substr(0, kHead));
    const std::string_view text =
        std::string_view(whole).substr(std::min(whole.find_first_not_of(" \t\r\n"), whole.size()));
    if (text.starts_with('<')) {
        const std::string root = lower(xml_root(bytes));
        const std::string_view name = std::string_view(root).substr(root.find(':') + 1);
        const auto* const kind = std::ranges::find(kXml, name, &ForeignKind::begins);
        if (kind != std::end(kXml)) return looks(*kind);
        if (text.starts_with("<?xml"))
            return "looks like XML (" + shortened(cleaned(root), kLongestName) + "); " + kExport;
    }
    for (const ForeignKind& kind : kJson) {
        if (text.starts_with('{') && json_head(bytes.substr(0, kJsonHead)).has_any({kind.begins})) return looks(kind);
    }
    for (const ForeignKind& kind : kForeign) {
        const bool is =
            kind.at == 0 ? text.starts_with(kind.begins)
                         : whole.size() > kind.at && std::string_view(whole).substr(kind.at).starts_with(kind.begins);
        if (is) return looks(kind);
    }
    return std::nullopt;
}

}  // namespace mobbscope
