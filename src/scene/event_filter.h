/// What is known of the events of a query, and filters of them: `gap < 0.05 and level(a) >= 3 and outcome = overlap`.
#pragma once

#include <scene/table_filter.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace mobbscope {

/// What is known of an event.
enum class EventField : std::uint8_t {
    step,
    time,
    shared,
    depth,
    parent,
    node,
    level,
    sample,
    leaf,
    test,
    outcome,
    axis,
    gap,
    clearance,
    pairs,
    tests_below,
    hit_below,
    avoidable,
};

/// In the order of the enumeration.
std::span<const TableField> event_fields();
const TableField& info(EventField field);
FieldTable event_field_table();

class EventFilter : public TableFilter {
  public:
    /// Throws FilterError.
    explicit EventFilter(std::string_view text) : TableFilter(event_field_table(), text) {}
    static EventField field(const Term& term) { return static_cast<EventField>(term.field); }
};

}  // namespace mobbscope
