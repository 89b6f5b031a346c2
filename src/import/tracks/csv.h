/// Comma-separated tracks: a header row naming t,x,y,r or x,y,r (any order), optionally id; one disk a row.
#pragma once

#include <import/clip/import_options.h>
#include <import/clip/imported_clip.h>
#include <import/clip/sampling.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// The rows of one id, in the file's order; times increase.
struct CsvTrack {
    std::string id;  ///< empty without an id column
    std::vector<TimedDisk> rows;
    std::vector<int> lines;                        ///< of each row in the file, from 1
    std::vector<std::vector<std::string>> others;  ///< of each row: what stands in CsvTable::others

    int first_line() const { return lines.front(); }
};

/// A file as it stands: nothing scaled, nothing sampled.
struct CsvTable {
    bool has_id = false;
    bool has_time = false;    ///< else t of every row is 0
    bool has_radius = false;  ///< else r of every row is 0
    /// Columns that mean nothing unless the radius is in one of them: name, and number from 0.
    std::vector<std::pair<std::string, std::size_t>> others;
    std::vector<CsvTrack> tracks;  ///< at least one, each with at least one row; in order of first appearance
};

/// `file` stands for the file in messages. Throws InputError naming line and column.
CsvTable parse_csv(std::string_view text, const std::string& file);

/// The clips of a table. Throws InputError.
std::vector<ImportedClip> csv_clips(const CsvTable& table, const std::filesystem::path& file,
                                    const ImportOptions& options);

/// What a file has for each option; see ParsedFile::offer (import/import.h).
ImportOffer csv_offer(const CsvTable& table, const std::filesystem::path& file, const ImportOptions& options);

/// A field as it must stand in a file: quoted where it holds a comma, a quote or a blank at an end.
std::string csv_field(std::string_view text);

}  // namespace mobbscope
