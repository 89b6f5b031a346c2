/// A case of picture tests, and what is known of it.
#pragma once

#include <cases/case_file.h>
#include <cases/case_result.h>
#include <render/image/image.h>
#include <render/image/image_diff.h>
#include <review/held_table.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

/// One case, and what is known of it.
struct ReviewCase {
    enum class State { not_drawn, waiting, drawn };

    picture_tests::CaseFile file;
    State state = State::not_drawn;
    picture_tests::CaseResult result{};  ///< of what is drawn
    bool from_output = false;            ///< the picture is one that an earlier run left
    bool accepted = false;               ///< its fresh goldens are written
    bool viewed = false;                 ///< somebody has seen its pictures
    bool marked = false;                 ///< chosen, among several

    bool drawn() const { return state == State::drawn; }
    /// As after `take`, if its goldens were taken; only of what is drawn.
    picture_tests::CaseOutcome outcome() const;
    /// Drawn, and neither passed nor skipped.
    bool failing() const;
    /// Share of the pixels that differ, 0..1, also of one that passed; 1 where there is nothing to compare.
    double difference() const;
};

/// The pictures of one case. Null where there is none.
struct ReviewPictures {
    std::shared_ptr<const Image> golden, actual, difference;
    std::optional<ImageDiff> diff;                    ///< without its heat map
    std::filesystem::path golden_file;                ///< that is compared: the case's own, or the one without text
    std::vector<std::filesystem::path> number_files;  ///< goldens of answers, traces and fits
    std::map<std::filesystem::path, std::vector<HeldRow>> numbers;  ///< of those that are others now
    std::string why_not;                                            ///< a picture cannot be read; else empty
};

}  // namespace mobbscope::app
