/// A result on one line of JSON: how `mobbscope test --json-lines` tells programs what it finds as it finds it, and how
/// the window hears of it.
///
///     {"name", "outcome", "message", "tolerance", "other_here", "backend", "renderer",
///      "diff": {...} | null,                             as `mobbscope diff --json`
///      "findings": [{"golden": ".draw.json", "message", "words": [...]}],
///      "actual": PNG | null, "golden": PNG | null,       in base64; the golden of a case that did not pass
///      "fresh": [{"golden": ".png", "bytes", "replaces": ... | null}]}   in base64
///
/// Goldens are told by what follows the case's name.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>

#include <cstdint>
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

    double fraction() const { return pixels > 0 ? static_cast<double>(differing) / static_cast<double>(pixels) : 0; }
};
DiffFigures figures_of(const ImageDiff& diff);

/// A result whose pictures are packed as PNG: a run may have hundreds.
struct PackedResult {
    CaseOutcome outcome = CaseOutcome::passed;
    std::string message;
    std::vector<Finding> findings;
    Tolerance tolerance = Tolerance::tight;
    std::string other_here;
    DrawnBy drawn_by;
    std::optional<DiffFigures> figures;
    std::string actual, golden;  ///< empty where there is none
    std::vector<GoldenChange> fresh;
};

/// With the line's end.
void write_result_line(std::ostream& out, const CaseResult& result, const DrawnBy& drawn_by);

struct NamedResult {
    std::string name;
    PackedResult result;
};
/// `cases`: those that it may be of. Throws InputError if the line is no result.
NamedResult read_result_line(std::string_view line, const std::vector<CaseFile>& cases);

}  // namespace mobbscope::picture_tests
