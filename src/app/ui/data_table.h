/// A table of things by their numbers, such as events and nodes: sorted by a click on a heading, each row to be picked.
#pragma once

#include <app/ui/command_menu.h>
#include <app/ui/ui.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope::app {

struct TableColumn {
    std::string name;     ///< as filters and commands have it
    std::string heading;  ///< as short as is understood
    std::string doc;
    std::string widest;      ///< as wide as any of its values
    bool is_number = false;  ///< stands at the right
};

struct TableCell {
    std::string text;
    ImU32 color = 0;
    std::vector<double> exact{};  ///< its numbers with all their digits, to copy
};

/// What a table shows in this frame.
struct TableContent {
    std::string mark;  ///< "events": headings are "events.sort.gap" for scripts, rows "events.row.12"
    std::span<const TableColumn> columns;
    std::shared_ptr<const std::vector<int>> rows;  ///< the things, in order; never null
    int present = -1;                              ///< a thing: its row is lit and scrolled to
    int hovered = -1;                              ///< likewise, under the mouse elsewhere
    std::string sorted_by{};
    bool descending = false;
    std::string filter{};  ///< what rows have passed

    std::function<TableCell(std::size_t column, int thing)> cell;
    std::function<void(const std::string& column)> sort;
    std::function<void(int thing)> pick;
    std::function<void(int thing)> hover;
    std::function<std::vector<MenuEntry>(int thing)> menu;
    std::function<bool(int thing)> is_marked{};  ///< has a dot
    std::string marked{};                        ///< the dot of thing 12 is "events.<this>.12" for scripts
};

class DataTable {
  public:
    /// In what room there is. Only the rows that are seen are drawn.
    void draw(Ui& ui, const TableContent& content);
    /// Pixels that so many rows take with the headings.
    static float height(const Ui& ui, int rows);

  private:
    void row(Ui& ui, const TableContent& content, std::size_t index) const;
    /// Scrolls to the row of the present thing, where that has changed or rows have.
    void follow(int thing, float row_height, float head_height);

    std::shared_ptr<const std::vector<int>> rows_;  ///< as they were drawn last
    int thing_ = -1;                                ///< the present one, likewise
    std::optional<std::size_t> present_;            ///< its row
    bool rows_are_new_ = false;
    std::string order_;  ///< by what they are filtered and sorted
};

}  // namespace mobbscope::app
