/// What is known of a node of a fitted tree: the columns of the table of nodes, and what boxes are coloured by.
#pragma once

#include <scene/table_filter.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace mobbscope {

enum class NodeField : std::uint8_t {
    node,
    level,
    sample,
    count,
    time,
    leaf,
    volume,
    empty,
    waste,
    fill,
    floor,
    overhang,
    share,
    tests,
    avoidable,
};
inline constexpr std::size_t kNodeFieldCount = 15;

struct NodeFieldInfo : TableField {
    NodeField field;
    std::string_view heading;   ///< of a column, as short as is understood
    bool colors = false;        ///< boxes can be coloured by it
    bool low_is_worse = false;  ///< what wastes most has the least of it
};

/// In the order of the enumeration.
std::span<const NodeFieldInfo> node_fields();
const NodeFieldInfo& info(NodeField field);
FieldTable node_field_table();

/// `empty > 0.5 and not leaf`: which nodes are listed.
class NodeFilter : public TableFilter {
  public:
    /// Throws FilterError.
    explicit NodeFilter(std::string_view text) : TableFilter(node_field_table(), text) {}
    static NodeField field(const Term& term) { return static_cast<NodeField>(term.field); }
};

}  // namespace mobbscope
