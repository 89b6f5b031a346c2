/// What an import makes of a text, refuses, and warns of.
#pragma once

#include <import/tracks/text_rows.h>
#include <support/input_error.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
inline namespace testing {

inline std::vector<ImportedClip> csv_clips(std::string_view text, const ImportOptions& options = {}) {
    return track_clips(parse_csv(text, "f.csv", options), "f.csv", options);
}

inline std::string csv_refusal(std::string_view text, const ImportOptions& options = {}) {
    return input_error([&] { csv_clips(text, options); });
}

/// Whether a warning has these words.
inline bool warns(const ImportedClip& clip, const std::string& words) {
    return std::ranges::any_of(clip.facts.warnings, [&](const ImportWarning& warning) {
        return warning.text.find(words) != std::string::npos;
    });
}

}  // namespace testing
}  // namespace mobbscope
