#include <explain/event_table.h>
#include <explain/table_rows.h>

#include <array>
#include <cstddef>

namespace mobbscope {

namespace {

constexpr std::array kColumns{
    EventColumn{EventField::step, 0, "step"},          EventColumn{EventField::node, 0, "node A"},
    EventColumn{EventField::node, 1, "node B"},        EventColumn{EventField::test, 0, "test"},
    EventColumn{EventField::outcome, 0, "outcome"},    EventColumn{EventField::gap, 0, "gap, m"},
    EventColumn{EventField::clearance, 0, "clear, m"}, EventColumn{EventField::tests_below, 0, "below"},
    EventColumn{EventField::time, 0, "time, s"},       EventColumn{EventField::level, 0, "level A"},
    EventColumn{EventField::level, 1, "level B"},      EventColumn{EventField::axis, 0, "axis"},
    EventColumn{EventField::pairs, 0, "pairs"},        EventColumn{EventField::depth, 0, "depth"},
};

}  // namespace

std::span<const EventColumn> event_columns() { return kColumns; }

std::string column_name(const EventColumn& column) {
    const TableField& field = info(column.field);
    std::string out(field.name);
    if (field.of_side) out += column.side == 0 ? "(a)" : "(b)";
    return out;
}

std::string event_rows(const EventValues& values, std::span<const int> steps, char separator) {
    return rows_text(
        kColumns.size(), steps, separator, [](std::size_t column) { return column_name(kColumns.at(column)); },
        [&](std::size_t column, int step) {
            const EventColumn& of = kColumns.at(column);
            return values.text(of.field, of.side, step, true);
        });
}

}  // namespace mobbscope
