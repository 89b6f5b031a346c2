#include <app/document/debug_texts.h>
#include <explain/query_sentence.h>

#include <algorithm>

namespace mobbscope::app {

std::string node_filter(const mobb::Tree& tree, int side, int node) {
    return std::string(side == 0 ? "node(a) = " : "node(b) = ") + std::to_string(tree.level(node)) + '.' +
           std::to_string(tree.place_in_level(node));
}

std::string pair_filter(const QueryInspector& queries, int event) {
    const QueryFindings& found = *queries.findings();
    const RecursionPair& pair = found.recursion.pair_at(event);
    return node_filter(found.sides[0].placed.tree(), 0, pair.a) + " and " +
           node_filter(found.sides[1].placed.tree(), 1, pair.b);
}

std::string name_of_event(const QueryInspector& queries, int event) {
    const QueryFindings& found = *queries.findings();
    const RecursionPair& pair = found.recursion.pair_at(event);
    return node_name(found.sides[0], pair.a) + ", " + node_name(found.sides[1], pair.b);
}

std::optional<std::size_t> present_bookmark(const Workspace& workspace) {
    const RecordedQuery* query = workspace.recorded();
    if (!query || query->trace.empty()) return std::nullopt;
    // One behind the end means the last step.
    const int last = query->trace.size() - 1;
    const std::vector<Bookmark>& all = workspace.scene().debug.bookmarks;
    const auto at = std::ranges::find_if(all, [&](const Bookmark& bookmark) {
        return bookmark.query == *workspace.view().query && std::min(bookmark.step, last) == workspace.step();
    });
    return at == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - all.begin()));
}

}  // namespace mobbscope::app
