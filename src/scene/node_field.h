/// What is known of a node of a fitted tree: the columns of the table of nodes, and what boxes are coloured by.
#pragma once

#include <scene/event_filter.h>

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
    fill,
    floor,
    overhang,
    share,
    tests,
    avoidable,
};
inline constexpr std::size_t kNodeFieldCount = 14;

struct NodeFieldInfo {
    NodeField field;
    std::string_view name;  ///< as filters, files and commands have it
    FieldKind kind = FieldKind::number;
    std::string_view heading;    ///< of a column, as short as is understood
    std::string_view unit = "";  ///< "%": the value is a part, 0 to 1
    std::string_view words;      ///< in sentences: "the volume"
    std::string_view doc;        ///< for help
    bool low_is_worse = false;   ///< what wastes most has the least of it
    bool colors = false;         ///< boxes can be coloured by it
};

/// In the order of the enumeration.
std::span<const NodeFieldInfo> node_fields();
const NodeFieldInfo& info(NodeField field);

}  // namespace mobbscope
