/// The one reader of rows: cells of text and of databases become points of tracks.
#pragma once

#include <import/clip/column_choice.h>
#include <import/tracks/tracks.h>

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace mobbscope {

/// The cells of the row in hand, by column, from 0.
class Cells {
  public:
    virtual ~Cells() = default;

    virtual double number(std::size_t column) const = 0;  ///< throws InputError if it holds none
    virtual std::string_view text(std::size_t column) const = 0;
    virtual bool is_empty(std::size_t column) const = 0;  ///< holds nothing, "nan" or "?"
    /// Nothing of a cell that holds no number.
    virtual std::optional<double> value(std::size_t column) const {
        return is_empty(column) ? std::nullopt : std::optional(number(column));
    }
    virtual int line() const = 0;                             ///< or row, from 1
    virtual std::string place(std::size_t column) const = 0;  ///< of the cell: "line 3, column 2 (y)"

    static constexpr std::size_t kNoColumn = ColumnFormula::kNone;  ///< the place is the row

    /// Throws InputError.
    [[noreturn]] void fail(std::size_t column, const std::string& message) const {
        throw InputError(file_, place(column), message);
    }
    /// What a cell names; `what` says what for a message: "the name". Throws InputError if it is no text.
    std::string_view name_in(std::size_t column, const char* what) const {
        const std::string_view name = text(column);
        if (!is_utf8(name)) fail(column, std::string(what) + " is not UTF-8 text; save the file as UTF-8");
        return name;
    }

  protected:
    /// `file` stands for the file in messages, and must outlive this.
    explicit Cells(const std::string& file) : file_(file) {}

    const std::string& file_;
};

/// Whom SUMO writes of.
inline constexpr std::string_view kSumoKinds[] = {"vehicle", "person", "container"};

/// Somebody that each row has columns of; nearly always there is one.
struct RowGroup {
    std::array<std::optional<ColumnFormula>, std::size(kColumns)> formulas{};  ///< in order of kColumns
    std::string id{};    ///< without a column of ids: whose all rows are; empty: nobody's
    std::string kind{};  ///< of SUMO: the class of who has none that is known, and ahead of an id that another kind has
    std::optional<std::size_t> vehicle{};  ///< column of who rides in a vehicle, which has a row of its own
};

/// Makes points of rows. Say which columns are which, then add row by row.
class RowReader {
  public:
    /// `file` stands for the file in messages, and must outlive this.
    explicit RowReader(const std::string& file) : tracks_(file) {}

    /// Of the group in hand: the last one, and of a row the one that is added.
    std::optional<ColumnFormula>& operator[](Column column) { return group().formulas[std::size_t(column)]; }
    const std::optional<ColumnFormula>& operator[](Column column) const {
        return groups_[at_].formulas[std::size_t(column)];
    }
    RowGroup& group() { return groups_[at_]; }
    void begin_group() {
        groups_.emplace_back();
        at_ = groups_.size() - 1;
    }
    std::vector<RowGroup>& groups() { return groups_; }
    bool has_ids() const { return has(Column::id) || !groups_[at_].id.empty(); }

    /// Each group of a row; false where nothing of it counts. Throws InputError naming the row and the column.
    bool add(const Cells& cells);
    bool add(const Cells& cells, std::size_t group);
    bool empty() const { return tracks_.empty(); }
    /// "the frame" or "the time".
    std::string time_word() const { return has(Column::frame) ? "the frame" : "the time"; }

    /// Tracks, what kind of times they have, and what was left out. Where there is an id they come in any order.
    TrackFile finish();

    std::string_view whole_in{};        ///< a format whose ids and frames are whole numbers; empty: any text is an id
    std::vector<std::size_t> scopes{};  ///< columns that stand before the id: it is one's within a recording alone
    std::vector<std::size_t> axes{};    ///< columns of semi-axes: the radius is the largest of them and of r
    std::string order_hint{};           ///< ends the message that rows without ids are not in order
    bool guesses_angles = false;        ///< headings are radians where all are small enough, else degrees
    std::string body_columns{};         ///< see TrackFile
    std::string heading_column{};       ///< likewise

  private:
    bool has(Column column) const { return (*this)[column].has_value(); }
    /// The first column that one is made of.
    std::size_t place(Column column) const { return has(column) ? (*this)[column]->first_column() : Cells::kNoColumn; }
    bool has_times() const { return has(Column::t) || has(Column::frame); }
    bool is_left_out(const Cells& cells);
    double value(const Cells& cells, Column column, double largest) const;
    double whole(const Cells& cells, Column column) const;
    double when(const Cells& cells) const;
    double radius(const Cells& cells) const;
    std::string_view identifier(const Cells& cells);
    std::string_view label(const Cells& cells) const;
    bool has_details() const;
    PointDetail detail(const Cells& cells);
    void tell_details(TrackFile& file);
    void check_order(const Cells& cells, double time) const;

    std::vector<RowGroup> groups_{1};
    std::size_t at_ = 0;
    std::unordered_map<std::string, std::size_t> kinds_{};  ///< by id, whose group it was first
    TrackCollector tracks_;
    double last_ = 0;         ///< the time or frame of the last row
    double last_of_all_ = 0;  ///< time or frame
    bool is_clock_ = false;   ///< times are of a day without a date
    bool has_morning_ = false, has_midday_ = false;
    bool in_milliseconds_ = true;  ///< all times
    std::optional<double> id_{};   ///< of the last row, where ids are whole numbers
    std::string id_text_{};
    std::string scoped_id_{};
    std::unordered_map<std::string, int> floors_{};  ///< numbers from 0, by name
    std::size_t scope_size_ = 0;                     ///< of that in front of the id
    std::size_t lost_ = 0, riding_ = 0, empty_ = 0;  ///< rows that are left out
    int first_empty_ = 0;                            ///< line
};

}  // namespace mobbscope
