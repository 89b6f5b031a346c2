/// Tables of text: a header row names columns, and one disk stands in each row after it.
#pragma once

#include <import/clip/import_options.h>
#include <import/clip/imported_clip.h>
#include <import/tracks/tracks.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The rows of a file: nothing scaled, nothing sampled.
struct CsvTable {
    int header_line = 1;  ///< in the file, from 1
    bool has_id = false;
    bool has_time = false;    ///< seconds in TrackPoint::frame of each row
    bool has_frame = false;   ///< frame numbers there; without either it is 0
    bool has_radius = false;  ///< else r of every row is 0
    double rounding = 0;      ///< seconds: what all times are rounded to; 0: that is not known

    std::optional<double> rate{};           ///< frames per second, where a comment tells
    double unit = 1;                        ///< metres per unit of x, y and r
    std::string unit_why{};                 ///< who says so: "the column x/cm"; empty: nobody
    std::vector<ImportWarning> warnings{};  ///< what was ignored or taken for something
    std::vector<std::string> others{};      ///< names of columns that were ignored, each once
    /// The rows of each id, "" without an id column; frames increase where there are any. In order of first appearance.
    std::vector<Track> tracks{};
    Spent spent{};  ///< of the budget
};

/// Of the options those that say what columns mean count: columns, and radius where it names one. `file` stands for the
/// file in messages. Throws InputError naming line and column.
CsvTable parse_csv(std::string_view text, const std::string& file, const ImportOptions& options = {});

/// A file that is read anew where the options choose other columns than they did before. Safe from any number of
/// threads.
class CsvFile {
  public:
    CsvFile(std::string text, const std::string& file);
    CsvFile(CsvFile&& other) noexcept : text_(std::move(other.text_)), file_(std::move(other.file_)) {}

    /// Throws InputError.
    std::shared_ptr<const CsvTable> table(const ImportOptions& options) const;

  private:
    std::string text_;
    std::string file_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const CsvTable> last_;
    mutable std::string last_choice_;
};

/// Whether a text begins like a table: with a line that names columns, or with numbers apart by commas.
bool looks_like_table(std::string_view text);

/// The clips of a table. Throws InputError.
std::vector<ImportedClip> csv_clips(const CsvTable& table, const std::filesystem::path& file,
                                    const ImportOptions& options);

/// What a file has for each option; see ParsedFile::offer (import/import.h).
ImportOffer csv_offer(const CsvTable& table, const std::filesystem::path& file, const ImportOptions& options);

/// A field as it must stand in a file (RFC 4180): quoted where it holds a comma, a quote, a line break, or a blank at
/// an end.
std::string csv_field(std::string_view text);

}  // namespace mobbscope
