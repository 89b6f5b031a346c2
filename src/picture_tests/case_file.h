/// A picture test: a shot, and what its picture must look like. `NAME.case.json` holds the keys of a shot (shot.h) and
///
///      "mobbscope_case": 1,
///      "tolerance": "tight",          or "loose"
///      "skip": "why"                  the case is reported as skipped
///
/// Beside it stand its golden `NAME.png` and, if the numbers are to be held too, `NAME.draw.json` (draw_list_json.h);
/// where the folder has a reference, the goldens `NAME.plain.*` too (reference.h).
#pragma once

#include <picture_tests/shot.h>
#include <render/image/image_diff.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::picture_tests {

/// How far a picture may be from its golden; there are no others.
enum class Tolerance {
    tight,  ///< one rasteriser on any processor: 3/255 a channel, 0.1 % of the pixels beyond
    loose,  ///< across rasterisers: edges may lie a pixel aside, 8/255 a channel, 0.5 % of the pixels beyond
};
std::string_view name(Tolerance tolerance);
DiffOptions diff_options(Tolerance tolerance);

/// What is known of a case before its scene is read.
struct CaseFile {
    std::string name;  ///< of the file relative to the folder of the cases, without ".case.json"
    std::filesystem::path file;
    std::filesystem::path golden() const;       ///< NAME.png
    std::filesystem::path draw() const;         ///< NAME.draw.json
    std::filesystem::path plain() const;        ///< NAME.plain.png
    std::filesystem::path plain_draw() const;   ///< NAME.plain.draw.json
    std::filesystem::path plain_state() const;  ///< NAME.plain.state.json
};

/// All cases in a folder and the folders in it, by name. Throws InputError if there is no such folder, or no case in
/// it.
std::vector<CaseFile> find_cases(const std::filesystem::path& folder);

struct Case {
    Shot shot;
    Tolerance tolerance = Tolerance::tight;
    std::optional<std::string> skip;  ///< why; the shot is then not read
};

/// Throws InputError.
Case read_case(const std::filesystem::path& file);

}  // namespace mobbscope::picture_tests
