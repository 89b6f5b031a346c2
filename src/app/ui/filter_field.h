/// A field for a filter of the rows of a table.
#pragma once

#include <app/ui/command_menu.h>
#include <app/ui/ui.h>
#include <scene/table_filter.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

struct FilterField {
    std::string mark{};
    FieldTable fields;  ///< of the table
    std::string now{};  ///< the filter that holds; empty: none
    const char* hint = "";
    std::function<std::string(const std::string& filter)> hits;  ///< "12 of 830": said beside it, before it is applied
    float right = 0;  ///< pixels of its line that are left to what comes next
};

/// The field, which has the keys where Keys::field asks for that, and how many rows pass what is typed. Tab takes
/// what may follow, Up and Down choose among that; Enter gives the filter, of which an empty one is none, and Escape
/// takes all back.
std::optional<std::string> table_filter_field(Ui& ui, const FilterField& field);

/// Below the field, as wide as there is room: the filter in words, or where it is wrong and why; while it is typed,
/// what may follow.
void filter_words(Ui& ui, const FilterField& field);

/// All that stands above the table `of`, such as "events": the field "<of>.filter", a button for the command
/// "<of>.all", one that opens a menu, and the words. What is entered goes to the command "<of>.filter".
void filter_line(Ui& ui, const std::string& of, FilterField field, const char* menu_help,
                 const std::vector<MenuEntry>& menu);

}  // namespace mobbscope::app
