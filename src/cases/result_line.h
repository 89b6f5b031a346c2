/// A result as JSON: how `mobbscope test --json-lines` tells programs what it finds as it finds it, a line each, how
/// the window hears of it, and how a report keeps it (case_report.h).
///
///     {"name", "outcome", "message", "remarks": [...], "tolerance", "decided_by", "other_here", "backend", "renderer",
///      "diff": {...} | null,                             as `mobbscope diff --json`
///      "findings": [{"golden": ".draw.json", "message", "words": [...]}],
///      "shown": ".png",                                  the golden that the pictures are of
///      "mask": FILE | null,                              relative to the case
///      "actual": PNG | null, "golden": PNG | null,       in base64; the golden of a case that did not pass
///      "fresh": [{"golden": ".png", "bytes": ... | null, "replaces": ... | null}]}   in base64; null: no such file
///
/// Goldens are told by what follows the case's name.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <cases/case_file.h>
#include <cases/case_result.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// What drew the pictures.
struct DrawnBy {
    std::string backend;   ///< "osmesa", "egl"; empty without OpenGL
    std::string renderer;  ///< what OpenGL calls itself
};

/// Of a picture and its golden, what a list shows: as in ImageDiff.
struct DiffFigures {
    bool same_size = false;
    std::int64_t pixels = 0;
    std::int64_t differing = 0;
    int largest = 0;
    double mean = 0;
    DiffOptions options{};

    double fraction() const { return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0; }
};
DiffFigures figures_of(const ImageDiff& diff);

/// A result whose pictures are packed as PNG: a run may have hundreds.
struct PackedResult {
    CaseOutcome outcome = CaseOutcome::passed;
    std::string message;
    std::vector<std::string> remarks;
    std::vector<Finding> findings;
    Tolerance tolerance = Tolerance::tight;
    DecidedBy decided_by = DecidedBy::pixels;
    std::string other_here;
    std::filesystem::path shown;
    std::optional<std::filesystem::path> mask;
    DrawnBy drawn_by;
    std::optional<DiffFigures> figures;
    std::string actual, golden;  ///< empty where there is none
    std::vector<GoldenChange> fresh;
};

struct NamedResult {
    std::string name;
    PackedResult result;
};

/// Which pictures an object holds: where `fresh` has those that are shown, they need not be there twice.
enum class Pictures { all, not_in_fresh };
void write_result(JsonWriter& json, const CaseResult& result, const DrawnBy& drawn_by, Pictures pictures);
/// `cases`: those that it may be of. Throws InputError if it is no result.
NamedResult read_result(const JsonPlace& place, const std::vector<CaseFile>& cases);

/// On one line, with its end.
void write_result_line(std::ostream& out, const CaseResult& result, const DrawnBy& drawn_by);
NamedResult read_result_line(std::string_view line, const std::vector<CaseFile>& cases);

}  // namespace mobbscope::picture_tests
