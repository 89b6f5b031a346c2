#include <mobb/trace.h>
#include <scene/event_filter.h>

#include <string_view>
#include <vector>

namespace mobbscope {

namespace {

using mobb::Outcome;

/// In the order of mobb::Outcome.
const std::vector<std::string_view>& event_outcome_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> out;
        for (int i = 0; i <= static_cast<int>(Outcome::no_hit); ++i) out.push_back(name(static_cast<Outcome>(i)));
        return out;
    }();
    return names;
}

/// In the order of mobb::TestKind's indices.
const std::vector<std::string_view>& event_test_names() {
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> out;
        for (const mobb::TestKind test : mobb::kTestKinds) out.push_back(name(test));
        return out;
    }();
    return names;
}

std::vector<TableField> all_event_fields() {
    return {
        {.name = "step", .words = "the step", .doc = "Number of the event, from 0"},
        {.name = "time",
         .kind = FieldKind::range,
         .unit = "s",
         .words = "a moment of the pair",
         .doc = "The time that both nodes share: `time = 2.3` holds if 2.3 s is in it"},
        {.name = "shared",
         .unit = "s",
         .words = "the time that both nodes share",
         .doc = "How long the time that both nodes share is; 0 of nodes apart in time"},
        {.name = "depth", .words = "the depth", .doc = "Pairs above this one; 0 at the root"},
        {.name = "parent",
         .words = "the step that led to it",
         .doc = "Last event of the pair that called this one; none at the root"},
        {.name = "node",
         .kind = FieldKind::node,
         .of_side = true,
         .words = "A's node",
         .doc = "A node by its level and place (2.1) or by its index"},
        {.name = "level", .of_side = true, .words = "the level of A's node", .doc = "Level of the node; 0 is the root"},
        {.name = "sample",
         .kind = FieldKind::range,
         .of_side = true,
         .words = "a sample of A's node",
         .doc = "The samples in the node: `sample(a) = 113` holds if 113 is one of them"},
        {.name = "leaf", .kind = FieldKind::flag, .of_side = true, .words = "A's node is a leaf", .doc = "Leaves"},
        {.name = "test",
         .kind = FieldKind::word,
         .words = "the test",
         .doc = "What was tested",
         .values = event_test_names()},
        {.name = "outcome",
         .kind = FieldKind::word,
         .words = "the outcome",
         .doc = "What the test found",
         .values = event_outcome_names()},
        {.name = "axis", .words = "the separating axis", .doc = "Number of the axis that separated two boxes"},
        {.name = "gap",
         .unit = "m",
         .words = "the gap",
         .doc = "Between two boxes that are separated, along that axis"},
        {.name = "clearance",
         .unit = "m",
         .words = "the clearance",
         .doc = "Between the disks of the nearest pair of samples that was measured; below 0: they overlap"},
        {.name = "pairs", .words = "the number of measured pairs", .doc = "Pairs of samples that were measured"},
        {.name = "tests_below", .words = "the number of tests below", .doc = "Tests of all pairs below this one"},
        {.name = "hit_below",
         .kind = FieldKind::flag,
         .words = "a hit was found in it or below it",
         .doc = "Pairs that led to the hit"},
        {.name = "avoidable",
         .kind = FieldKind::flag,
         .words = "the overlap was avoidable",
         .doc = "Overlaps of boxes whose disks one line keeps apart, of those that were judged"},
    };
}

}  // namespace

std::span<const TableField> event_fields() {
    static const std::vector<TableField> fields = all_event_fields();
    return fields;
}

const TableField& info(EventField field) { return event_fields()[static_cast<std::size_t>(field)]; }

FieldTable event_field_table() {
    static const std::vector<const TableField*> fields = pointers_to(event_fields());
    return fields;
}

}  // namespace mobbscope
