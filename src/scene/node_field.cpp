#include <scene/node_field.h>

#include <array>
#include <vector>

namespace mobbscope {

std::span<const NodeFieldInfo> node_fields() {
    using enum NodeField;
    static constexpr std::array<NodeFieldInfo, kNodeFieldCount> all{{
        {{.name = "node",
          .kind = FieldKind::node,
          .words = "the node",
          .doc = "A node by its level and place (2.1) or by its index"},
         node,
         "node"},
        {{.name = "level", .words = "the level", .doc = "Level of the node; 0 is the root"}, level, "level", true},
        {{.name = "sample",
          .kind = FieldKind::range,
          .words = "a sample of the node",
          .doc = "The samples in the node: `sample = 113` holds if 113 is one of them"},
         sample,
         "samples"},
        {{.name = "count", .words = "the number of samples", .doc = "How many samples are in the node"},
         count,
         "count"},
        {{.name = "time",
          .kind = FieldKind::range,
          .unit = "s",
          .words = "a moment of the node",
          .doc = "Time of the node in its clip: `time = 2.3` holds if 2.3 s is in it"},
         time,
         "time"},
        {{.name = "leaf", .kind = FieldKind::flag, .words = "it is a leaf", .doc = "Nodes without children"},
         leaf,
         "leaf"},
        {{.name = "volume", .unit = "m\u00B2\u00B7s", .words = "the volume", .doc = "Volume of the box in space-time"},
         volume,
         "volume",
         true},
        {{.name = "empty",
          .unit = "m\u00B2\u00B7s",
          .words = "the empty space",
          .doc = "Volume of the box less that of the cylinders in it"},
         empty,
         "empty",
         true},
        {{.name = "waste",
          .unit = "m\u00B2\u00B7s",
          .words = "the wasted space",
          .doc = "Volume of the box less that of its children, of a leaf less that of the cylinders in it: what all "
                 "nodes waste adds up to the empty space of the root"},
         waste,
         "waste",
         true},
        {{.name = "fill", .unit = "%", .words = "the fill", .doc = "Volume of the cylinders over that of their box"},
         fill,
         "fill",
         true,
         true},
        {{.name = "floor",
          .unit = "m\u00B2",
          .words = "the area on the floor",
          .doc = "Area of the box's outline on the floor, over all its time"},
         floor,
         "floor",
         true},
        {{.name = "overhang",
          .unit = "%",
          .words = "the overhang in time",
          .doc = "Part of a free box's volume that lies outside the node's own time"},
         overhang,
         "overhang",
         true},
        {{.name = "share",
          .unit = "%",
          .words = "the part of the cost",
          .doc = "The node's part of all box tests that a query is expected to make under standard placements: its EV* "
                 "share"},
         share,
         "cost",
         true},
        {{.name = "tests",
          .words = "the number of tests",
          .doc = "Tests of the node's box, over all queries of the scene"},
         tests,
         "tests",
         true},
        {{.name = "avoidable",
          .words = "the number of avoidable overlaps",
          .doc = "Avoidable overlaps that the node's box is to blame for, over all queries of the scene"},
         avoidable,
         "avoidable",
         true},
    }};
    return all;
}

const NodeFieldInfo& info(NodeField field) { return node_fields()[static_cast<std::size_t>(field)]; }

FieldTable node_field_table() {
    static const std::vector<const TableField*> fields = pointers_to(node_fields());
    return fields;
}

}  // namespace mobbscope
