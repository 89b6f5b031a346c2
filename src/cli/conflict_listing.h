/// What `conflicts` found, as it is written: as text, JSON and CSV; and read again from the parts that `merge` puts
/// together.
#pragma once

#include <conflicts/plan_conflicts.h>
#include <mobb_tracks/conflict.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// Seconds, or why there are none.
struct ListedSeconds {
    std::optional<double> seconds;
    std::string undefined;  ///< the reason where there are none
};

/// Two agents who come too close.
struct ListedConflict {
    int a = 0, b = 0;  ///< in the order of agents
    std::string a_name, b_name;
    std::vector<mobb::Interval> intervals;  ///< at least one
    double least_clearance = 0, time = 0;
    int a_sample = 0, b_sample = 0;
    glm::dvec2 position{0};
    bool invented = false;                                              ///< nobody was seen to move so
    std::optional<std::vector<PlanConflict>> plan;                      ///< of agents of a plan
    std::optional<ListedSeconds> time_to_collision, post_encroachment;  ///< of encounters
};

inline constexpr int kMostParts = 1'000'000;

/// What one part of several has found.
struct ListedPart {
    int part = 0, parts = 0;  ///< from 1
};

enum class ListingFormat { text, json, csv };

struct ConflictListing {
    ListingFormat format = ListingFormat::text;  ///< of a part: of the whole
    std::string file;
    std::optional<double> t0;
    std::size_t agents = 0;
    std::optional<double> radius;
    std::size_t pairs = 0, pairs_tested = 0;
    double seconds = 0;
    std::vector<std::string> warnings{};  ///< see doubts_in
    std::optional<std::int64_t> unforced;
    std::optional<double> within;  ///< metres: these are encounters
    std::optional<double> least_seconds;
    std::optional<ListedPart> part;
    std::uint64_t digest = 0;             ///< of a part: of the crowd, as it is placed
    std::optional<std::size_t> left_out;  ///< conflicts that rest on invented motion, where they are not listed

    std::size_t size = 0;
    /// Worst first; each is asked for once, in order. `figures`: with times to collision and of post-encroachment,
    /// where these are encounters.
    std::function<ListedConflict(std::size_t, bool figures)> row;

    /// Whether two are parts of one whole.
    bool is_of_the_same(const ConflictListing& other) const;
};

/// To standard output; a part always as JSON.
void write_listing(const ConflictListing& listing);

/// The whole of files that write_listing has written of each part, in any order, of which a row each is in memory. The
/// files must stay as they are. Throws InputError, naming the file, for one that is cut off, belongs to another whole,
/// or is there twice, and if one is missing.
ConflictListing merged_listing(const std::vector<std::filesystem::path>& files);

}  // namespace mobbscope::cli
