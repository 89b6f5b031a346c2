#include <app/commands/arguments.h>
#include <base/text.h>
#include <cli/columns.h>
#include <cli/options.h>
#include <cli/what_if_table.h>
#include <scene/fit_text.h>

#include <array>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::cli {

ClipWhatIf what_if_of(const std::string& clip, const std::shared_ptr<const mobb::Tree>& tree, const std::string& node) {
    ClipWhatIf out{clip, standard_workload(std::array{tree->shared_clip()}, kWhatIfQueries, kWhatIfSeed), {}};
    out.found = what_if(out.workload, std::array{tree}, 0, app::node_at(*tree, node), tell("asked", "queries"));
    return out;
}

void print_what_if(const ClipWhatIf& of) {
    const WhatIf& found = of.found;
    const NodeVariant& present = found.variants.front();
    const mobb::Tree& tree = *present.tree;
    const mobb::Node& node = tree.node(found.node);
    std::cout << cleaned(of.clip) << ", node " << found.node << " (level " << tree.level(found.node) << "): samples "
              << node.first << ".." << node.end() - 1 << " of a tree " << fit_words(tree.options(), {}) << '\n'
              << "  against itself at " << counted(found.queries, "placement", "placements") << " (shift over "
              << figure(of.workload.area, 3) << " m^2, start within +-" << brief(of.workload.offset) << " s, seed "
              << of.workload.seed << "); nothing is changed\n";
    Column what{"what if"}, volume{"volume m^2*s"}, children{"children m^2*s"}, boxes{"box tests"},
        pairs{"sample pairs"}, cost{"cost ns"}, change{"cost %"};
    for (const NodeVariant& variant : found.variants) {
        const bool is_best = &variant == &found.best() && &variant != &present;
        what.push_back((is_best ? "* " : "  ") + change_words(tree, variant.change));
        volume.push_back(figure(variant.volume));
        children.push_back(variant.children > 0 ? figure(variant.children) : "-");
        boxes.push_back(figure(variant.tests.boxes()));
        pairs.push_back(figure(variant.tests[mobb::TestKind::samples]));
        cost.push_back(figure(variant.cost));
        change.push_back(&variant == &present ? "-" : change_in_per_cent(found, variant, " +- "));
    }
    print_columns({what, volume, children, boxes, pairs, cost, change}, true);
    if (&found.best() == &present) std::cout << "  nothing costs less by more than 3 standard errors\n";
}

void write_what_if(JsonWriter& out, const ClipWhatIf& of) {
    const WhatIf& found = of.found;
    const mobb::Tree& tree = *found.variants.front().tree;
    out.begin_object();
    out.members("clip", of.clip, "node", found.node, "tree", mobb::name(tree.options().tree));
    out.members("queries", found.queries, "workload", name(of.workload.kind), "area", of.workload.area, "offset",
                of.workload.offset, "seed", of.workload.seed);
    out.member("best", &found.best() - found.variants.data());
    out.begin_array("variants");
    for (const NodeVariant& variant : found.variants) {
        const mobb::NodeChange& change = variant.change;
        std::optional<std::string_view> axes, kind;
        if (change.axes) axes = mobb::name(*change.axes);
        if (change.kind) kind = mobb::info(*change.kind).name;
        out.row("axes", axes, "kind", kind, "split", change.split, "volume", variant.volume, "children",
                variant.children, "box_tests", variant.tests.boxes(), "sample_pairs",
                variant.tests[mobb::TestKind::samples], "cost", variant.cost, "difference", variant.difference.mean,
                "error", variant.difference.standard_error);
    }
    out.end_array();
    out.end_object();
}

}  // namespace mobbscope::cli
