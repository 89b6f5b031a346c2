/// Rows of text: tables, whose header names the columns, and the formats of rows of numbers alone.
#pragma once

#include <base/input.h>
#include <import/clip/import_options.h>
#include <import/tracks/tracks.h>

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

/// Whether a text begins like a table: with a line that names columns, or with numbers apart by commas.
bool looks_like_table(std::string_view text);

/// A table: a header row names columns, and one disk stands in each row after it; in tables of SUMO and of several
/// robots one of each. Of the options those that say what columns mean count: columns, and radius where it names one.
/// `file` stands for the file in messages. Throws InputError naming line and column.
TrackFile parse_csv(const Input& text, const std::string& file, const ImportOptions& options = {});

/// A file that is read anew where the options choose other columns than they did before. Safe from any number of
/// threads.
class TableFile {
  public:
    TableFile(const Input& text, const std::string& file) : text_(text), file_(file) {}
    TableFile(TableFile&& other) noexcept : text_(std::move(other.text_)), file_(std::move(other.file_)) {}

    /// `takes`: it is not kept here. Throws InputError.
    std::shared_ptr<TrackFile> table(const ImportOptions& options, bool takes = false) const;

  private:
    Input text_;
    std::string file_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<TrackFile> last_;
    mutable std::string last_choice_;
};

/// A format of rows of numbers.
struct RowFormat {
    std::string_view name;     ///< SourceFacts::format
    std::string_view columns;  ///< in their order, as a header would name them; "_" is ignored
    double rate;               ///< frames per second that are assumed where no comment tells it; 0: none are
    bool rate_of_steps;        ///< see TrackFile
    char separator;            ///< between numbers; ' ' stands for any number of blanks
    std::string_view as_in;    ///< why that rate
    std::string_view hint;     ///< what tells it, for a message
    FormatNote note;
    /// Of several with as many columns: whether the first rows are of this one; the last such counts.
    bool (*holds)(std::span<const std::vector<double>> rows) = nullptr;
    std::string_view refusal{};  ///< why it is not read, and what to do; empty: it is
};

/// All of them, told apart by how many columns a row has.
std::span<const RowFormat> row_formats();

/// Whether a text begins like one of those.
bool looks_like_text_tracks(std::string_view text);

/// Rows of one of those, or in the columns that a comment ahead of them names. Throws InputError naming the line.
TrackFile parse_text_tracks(const Input& text, const std::string& file);

/// A field as it must stand in a file (RFC 4180): quoted where it holds a comma, a quote, a line break, or a blank at
/// an end.
std::string csv_field(std::string_view text);

}  // namespace mobbscope
