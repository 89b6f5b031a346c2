#include <base/text.h>
#include <import/foreign_files.h>

#include <algorithm>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr const char* kExport = "export the table as CSV";
constexpr const char* kPandas = "load it with pandas and write it with to_csv";
constexpr const char* kUnpack = "unpack it first (gzip is unpacked here)";
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
    {"<!doctype html"sv, "an HTML page", "download the file itself, not the page about it"},
    {"<html"sv, "an HTML page", "download the file itself, not the page about it"},
    {"<?xml"sv, "XML", kExport},
    {"<"sv, "XML or HTML", kExport},
    {"{"sv, "JSON", "scenes are .json, TrajNet++ is a JSON object a line (.ndjson); other JSON: write it as CSV"},
    {"["sv, "JSON", "scenes are .json, TrajNet++ is a JSON object a line (.ndjson); other JSON: write it as CSV"},
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
    {"\x7f"
     "elf"sv,
     "a program", "give a file of tracks"},
};

}  // namespace

std::optional<std::string> foreign_kind(std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    constexpr std::size_t kHead = 512;
    const std::string whole = lower(bytes.substr(0, kHead));
    const std::string_view text =
        std::string_view(whole).substr(std::min(whole.find_first_not_of(" \t\r\n"), whole.size()));
    for (const ForeignKind& kind : kForeign) {
        const bool is =
            kind.at == 0 ? text.starts_with(kind.begins)
                         : whole.size() > kind.at && std::string_view(whole).substr(kind.at).starts_with(kind.begins);
        if (is) return "looks like " + std::string(kind.what) + "; " + kind.to_do;
    }
    return std::nullopt;
}

}  // namespace mobbscope
