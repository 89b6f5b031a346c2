/// Which columns of a table are which, and what is said of that.
#pragma once

#include <import/clip/import_options.h>
#include <import/tracks/rows.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

inline constexpr std::string_view kRobot = "robot";  ///< the id of the only one, and the class

/// A name within a message.
std::string shown(const std::string& name);

/// The columns of a header. Name them, choose, then read rows.
class TableColumns {
  public:
    /// `file` stands for the file in messages; all must outlive this. `scoped`: columns that tell recordings or scenes
    /// belong to the ids.
    TableColumns(const std::string& file, const ImportOptions& of, RowReader& reader, bool has_scopes)
        : options(of), scoped(has_scopes), file_(file), rows_(reader) {}

    /// Tells the reader of rows which are which; of tables of which each row has several, of each of them. Throws
    /// InputError naming the header.
    void choose_groups();
    void choose_columns();

    std::optional<std::size_t> column_with(std::string_view word) const;  ///< a PlainName::word
    /// See RowReader.
    std::string order_hint() const;
    /// Names of columns that nothing was made of, with a warning.
    std::vector<std::string> tell_ignored();

    const ImportOptions& options;
    bool scoped;
    std::vector<std::string> names{};
    int header_line = 0;              ///< 0: there is no header
    std::string_view format = "csv";  ///< or what program's it is
    double unit = 1;                  ///< metres per unit of lengths
    std::string unit_why{};           ///< who says so: "the column x/cm"; empty: nobody
    std::vector<ImportWarning> warnings{};
    bool counts_time = false, is_weak_time = false;  ///< t has no unit; its name may mean something else
    bool frames_are_chosen = false;                  ///< the option columns says that t is a column of frames
    std::optional<std::size_t> date{};               ///< the column of dates beside times of day
    std::optional<std::size_t> height{};             ///< the column z of a table with x and y
    std::optional<std::size_t> spot{};               ///< the column whose cells hold x and y, which are two more
    std::vector<std::size_t> scopes{};               ///< columns within which ids are one's
    bool is_weak_scope = false;                      ///< they may be something else

  private:
    void choose_kinds_of_sumo();
    void choose_of_vissim();
    void take_by_name(Column column);
    void take_stamp();
    void take_boxes();
    void settle_bodies();
    void find_scopes();
    void name_radius_column();
    bool has_word(std::string_view word) const { return column_with(word).has_value(); }
    std::string likely_column(Column needed) const;
    std::string also_by_option(Column needed) const;
    [[noreturn]] void fail_in_header(const std::string& message) const;
    [[noreturn]] void fail_at_name(std::size_t column, const std::string& message) const;

    const std::string& file_;
    RowReader& rows_;
};

}  // namespace mobbscope
