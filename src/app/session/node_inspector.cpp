#include <app/document/agents.h>
#include <app/session/node_inspector.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace mobbscope::app {

void NodeInspector::sort_by(NodeField field) {
    descending = by == field ? !descending : is_worse_if_more(field);
    by = field;
}

std::shared_ptr<const NodeValues> NodeInspector::values() const {
    const int clip = clip_in_focus(workspace_);
    const std::shared_ptr<const FittedScene>& fitted = workspace_.document().fitted;
    const std::shared_ptr<SceneFigures>& known = figures_.known();
    Kept now{fitted->shared_tree(clip), known->revision()};
    if (values_ && now == kept_) return values_;
    for (const NodeField field : {NodeField::share, NodeField::tests}) known->of(fitted, clip, field);
    values_ = std::make_shared<const NodeValues>(known->of(fitted, clip, NodeField::avoidable));
    kept_ = std::move(now);
    return values_;
}

bool NodeInspector::can_count() const {
    const std::shared_ptr<const NodeValues> known = values();
    const auto lacks = [&](NodeField field) { return !known->has(field); };
    return !workspace_.fitted().queries().empty() && (lacks(NodeField::tests) || lacks(NodeField::avoidable));
}

std::vector<NodeField> NodeInspector::columns() const {
    const std::shared_ptr<const NodeValues> known = values();
    const bool asks = !workspace_.fitted().queries().empty();
    std::vector<NodeField> out;
    for (const NodeField field : node_columns()) {
        const bool counted = field == NodeField::tests || field == NodeField::avoidable;
        if (counted ? asks : known->has(field)) out.push_back(field);
    }
    return out;
}

std::shared_ptr<const std::vector<int>> NodeInspector::listed() const {
    Order wanted{values(), filter ? filter->text() : "", by, descending};
    if (listed_ && wanted == order_) return listed_;
    std::vector<int> nodes = nodes_that_pass(*wanted.of, filter ? &*filter : nullptr);
    sort_nodes(nodes, *wanted.of, by, descending);
    order_ = std::move(wanted);
    return listed_ = std::make_shared<const std::vector<int>>(std::move(nodes));
}

int NodeInspector::hits(const NodeFilter& of) const {
    std::pair wanted(values(), of.text());
    if (wanted != hits_of_) {
        hits_ = static_cast<int>(nodes_that_pass(*wanted.first, &of).size());
        hits_of_ = std::move(wanted);
    }
    return hits_;
}

int NodeInspector::node_of(const Selection& selection) const {
    if (selection.kind != Selection::Kind::node) return -1;
    const auto who = placed_agent_of(workspace_.fitted(), selection.path);
    return who && clip_played(workspace_, *who) == clip_in_focus(workspace_) ? selection.index : -1;
}

std::optional<Selection> NodeInspector::selection_of(int node) const {
    const auto path = player_of(workspace_, clip_in_focus(workspace_));
    return path ? std::optional(Selection{Selection::Kind::node, *path, node}) : std::nullopt;
}

std::optional<int> NodeInspector::beside(int by_rows) const {
    const std::vector<int>& rows = *listed();
    if (rows.empty()) return std::nullopt;
    const auto at = std::ranges::find(rows, selected());
    if (at == rows.end()) return by_rows > 0 ? rows.front() : rows.back();
    const std::ptrdiff_t place = at - rows.begin() + by_rows;
    if (place < 0 || place >= std::ssize(rows)) return std::nullopt;
    return rows[static_cast<std::size_t>(place)];
}

}  // namespace mobbscope::app
