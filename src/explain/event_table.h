/// The list of a query's events: its columns, and rows as text.
#pragma once

#include <explain/event_values.h>

#include <span>
#include <string>
#include <string_view>

namespace mobbscope {

struct EventColumn {
    EventField field;
    int side = 0;              ///< of fields that each side has
    std::string_view heading;  ///< as short as is understood; A and B stand for the sides
};

/// In the order in which they are shown.
std::span<const EventColumn> event_columns();

/// As a filter names it: "level(a)".
std::string column_name(const EventColumn& column);

/// The rows of these steps with a heading: with commas between them, or tabs; numbers have all their
/// digits.
std::string event_rows(const EventValues& values, std::span<const int> steps, char separator);

}  // namespace mobbscope
