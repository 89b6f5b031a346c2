#include <explain/event_table.h>

#include <array>

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
    const EventFieldInfo& field = info(column.field);
    std::string out(field.name);
    if (field.of_side) out += column.side == 0 ? "(a)" : "(b)";
    return out;
}

std::string event_rows(const EventValues& values, std::span<const int> steps, char separator) {
    std::string out;
    const auto line = [&](const auto& cell) {
        for (const EventColumn& column : kColumns) {
            if (&column != kColumns.data()) out += separator;
            out += cell(column);
        }
        out += '\n';
    };
    line(column_name);
    for (const int step : steps)
        line([&](const EventColumn& column) { return values.text(column.field, column.side, step, true); });
    return out;
}

}  // namespace mobbscope
