#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/described.h>
#include <base/text.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace mobbscope::app {

namespace {

std::vector<std::string> as_strings(std::span<const std::string_view> names) { return {names.begin(), names.end()}; }

/// Sets an option of the fit, which `text` says.
template <class Option>
void fit(Edits& edits, const std::string& doing, const std::string& text, Option mobb::FitOptions::*option,
         Option value) {
    edits.refit({doing + ": " + text, doing}, [=](mobb::FitOptions& options) { options.*option = value; });
}

/// What a name stands for.
template <class Option>
Option named(std::string_view what, const std::string& text, std::optional<Option> (*from_name)(std::string_view),
             std::span<const std::string_view> names) {
    if (const auto value = from_name(text)) return *value;
    throw std::invalid_argument(std::string(what) + " cannot be " + in_quotes(text) + ": give one of " + listed(names));
}

void set_kind(Edits& edits, const std::string& text) {
    fit(edits, "changing the kind of trees", text, &mobb::FitOptions::tree,
        named("the trees", text, find_tree_kind, mobb::tree_kind_names()));
}

void set_axes(Edits& edits, const std::string& text) {
    fit(edits, "changing the axes", text, &mobb::FitOptions::axes,
        named("the axes", text, mobb::axes_from_name, mobb::axes_names()));
}

void set_leaf(Edits& edits, const std::string& text) {
    fit(edits, "changing the leaves", text, &mobb::FitOptions::leaf,
        whole_number_in(text, "the samples of a leaf", 1, std::numeric_limits<int>::max()));
}

void set_tree_levels(Edits& edits, const std::string& text) {
    fit(edits, "changing the levels", text, &mobb::FitOptions::levels,
        whole_number_in(text, "the number of levels", 0, std::numeric_limits<int>::max()));
}

void set_time_scale(Edits& edits, const std::string& text) {
    fit(edits, "changing the time scale", text, &mobb::FitOptions::time_scale,
        number_in(text, "the time scale", 1 / mobb::kMaxTimeScale, mobb::kMaxTimeScale));
}

/// In the order of QueryWorkload::Kind.
constexpr std::array<std::string_view, 2> kCostOf{"placements", "queries"};

void choose_cost(Settings& settings, const std::string& text) {
    settings.cost_of = choice_named<QueryWorkload::Kind>(kCostOf, text, "the queries");
}

// --- what stands out

/// Does something with what was noticed about the tree in focus, once that is known.
template <class Use>
void with_noticed(Session& session, const Use& use) {
    const int clip = clip_in_focus(session.workspace);
    session.notices.look(clip, [&session, clip, use] {
        // It may be another by now.
        if (session.workspace.empty() || clip_in_focus(session.workspace) != clip) return;
        FitNotices::Noticed* const noticed = session.notices.of(clip);
        if (!noticed) return;
        if (noticed->findings.empty())
            return session.notifications.tell(MessageLevel::info, "Nothing stands out in this fit");
        use(session, clip, *noticed);
    });
}

int number_of_finding(const std::string& text) {
    return whole_number_in(text, "the number", 0, std::numeric_limits<int>::max());
}

/// Requires that there are findings; throws std::invalid_argument if it is none of them.
const FitFinding& finding_at(const FitNotices::Noticed& noticed, int index) {
    if (index >= static_cast<int>(noticed.findings.size()))
        throw std::invalid_argument("the last finding is " + std::to_string(noticed.findings.size() - 1));
    return noticed.findings[static_cast<std::size_t>(index)];
}

void see_finding(Session& session, int clip, FitNotices::Noticed& noticed, int index) {
    const FitFinding found = finding_at(noticed, index);
    noticed.seen = index;
    if (found.level >= 0) return run_command(session, "view.level", std::to_string(found.level));
    const auto path = player_of(session.workspace, clip);
    if (!path) throw std::invalid_argument("no agent plays that clip now");
    const std::string name = placed_agent_of(session.workspace.fitted(), *path)->name + ' ';
    found.node >= 0 ? run_command(session, "go.node", name + std::to_string(found.node))
                    : run_command(session, "go.sample", name + std::to_string(found.sample));
    run_command(session, "view.frame");
}

void see_finding_number(Session& session, const std::string& text) {
    with_noticed(session, [index = number_of_finding(text)](Session& at, int clip, FitNotices::Noticed& noticed) {
        see_finding(at, clip, noticed, index);
    });
}

void next_finding(Session& session) {
    with_noticed(session, [](Session& at, int clip, FitNotices::Noticed& noticed) {
        const int next = (noticed.seen + 1) % static_cast<int>(noticed.findings.size());
        at.notifications.tell(MessageLevel::info, finding_at(noticed, next).text);
        see_finding(at, clip, noticed, next);
    });
}

void mend_finding(Session& session, const std::string& text) {
    const std::optional<int> given = text.empty() ? std::nullopt : std::optional(number_of_finding(text));
    with_noticed(session, [given](Session& at, int, FitNotices::Noticed& noticed) {
        const std::optional<mobb::FitOptions> mend =
            finding_at(noticed, given.value_or(std::max(noticed.seen, 0))).mend;
        if (!mend) throw std::invalid_argument("no other fit helps: the clip itself would have to change");
        at.edits.refit({"mending the fit: " + mend_words(*mend, noticed.tree->options()), ""},
                       [mend](mobb::FitOptions& options) { options = *mend; });
    });
}

// --- a part of a tree alone

/// That of the selected node; none where the picture cannot show it. The agents of a run are others at every time.
std::optional<DrawnNode> part_of_selection(const Workspace& workspace) {
    const Selection& selected = workspace.selection;
    const bool is_node = selected.kind == Selection::Kind::node && selected.path.agent >= 0;
    if (!is_node || workspace.crowd()) return std::nullopt;
    return DrawnNode{selected.path.agent, selected.index};
}

bool shows_part(const Workspace& workspace) { return workspace.view().subtree.has_value(); }
std::string_view why_no_part(const Workspace& workspace) {
    return workspace.crowd() ? "the agents of a run are others at every time" : "no node is selected";
}

void show_all_nodes(Workspace& workspace) {
    workspace.change_view([](ViewState& view) { view.subtree.reset(); },
                          EditName{"showing all nodes again", "look part"});
}

void show_part(Workspace& workspace) {
    const std::optional<DrawnNode> part = part_of_selection(workspace);
    if (!part || workspace.view().subtree == part) return show_all_nodes(workspace);
    const auto show = [&](ViewState& view) {
        view.subtree = part;
        view.boxes = true;
        view.query.reset();
    };
    workspace.change_view(show,
                          EditName{"showing " + describe(workspace, workspace.selection).name + " alone", "look part"});
}

}  // namespace

std::vector<Command> tree_commands() {
    const std::vector<Command> rows{
        Command("tree.kind", "Tree kind",
                "Fits boxes upright in time (mobb), free boxes (umobb), or one kind at the root and the other below.",
                set_kind,
                {.argument = "K",
                 .choices = [] { return as_strings(mobb::tree_kind_names()); },
                 .chosen = [](const Workspace& workspace,
                              const std::string& kind) { return name(workspace.fitted().options().tree) == kind; },
                 .also = "tight tighter loose bvh builder algorithm hierarchy obb aabb bounding volume"}),
        Command("tree.axes", "Axes",
                "Chooses the directions of boxes: from first to last sample, the principal axes, or the tightest.",
                set_axes,
                {.argument = "K",
                 .choices = [] { return as_strings(mobb::axes_names()); },
                 .chosen = [](const Workspace& workspace,
                              const std::string& axes) { return name(workspace.fitted().options().axes) == axes; },
                 .also = "tight orientation rotation obb pca principal"}),
        Command(
            "tree.leaf", "Samples in a leaf...", "Makes a node of at most N samples a leaf; 10 is the usual number.",
            set_leaf,
            {.argument = "N",
             .present = [](const Workspace& workspace) { return std::to_string(workspace.fitted().options().leaf); },
             .also = "size granularity split primitives"}),
        Command(
            "tree.levels", "Levels of the trees...",
            "Ends the trees after N levels; 0 lets them go down to their leaves.", set_tree_levels,
            {.argument = "N",
             .present = [](const Workspace& workspace) { return std::to_string(workspace.fitted().options().levels); },
             .also = "depth height"}),
        Command("tree.time_scale", "Time scale...", "Mixes time with space in free boxes at so many metres per second.",
                set_time_scale,
                {.argument = "W",
                 .present =
                     [](const Workspace& workspace) { return format_double(workspace.fitted().options().time_scale); },
                 .also = "metric weight"}),
        Command("tree.cost_of", "Cost of",
                "Chooses the queries that costs of trees are about: standard placements, or those of the scene.",
                choose_cost,
                {.argument = "placements|queries",
                 .enabled = {has_queries, [] { return std::string_view("there is no query"); }},
                 .choices = [] { return as_strings(kCostOf); },
                 .choice_title =
                     [](const std::string& kind) {
                         return kind == kCostOf[0] ? "Standard placements" : "The scene's queries";
                     },
                 .chosen = [](const Workspace& workspace,
                              const std::string& kind) { return name(workspace.workload()) == kind; },
                 .also = "sah price expected workload"}),
        Command("node.isolate", "Show this node alone",
                "Of the selected node's agent draws only that node's box and those below it; again: shows all.",
                show_part,
                {.shortcut = "Shift+I",
                 .enabled = {[](const Workspace& workspace) {
                                 return part_of_selection(workspace).has_value() || shows_part(workspace);
                             },
                             why_no_part},
                 .checked = shows_part,
                 .also = "isolate solo subtree only"}),
        Command("node.show_all", "Show all nodes", "Draws all boxes again after those of a node alone.", show_all_nodes,
                {.enabled = {shows_part, [] { return std::string_view("no node is shown alone"); }}}),
        Command("tree.next_finding", "Next finding",
                "Says what stands out in the tree in focus, one after the other, and shows where.", next_finding,
                {.also = "waste loose tight problem warning lint noticed worst advice check"}),
        Command("tree.see_finding", "See a finding", "Shows where something stands out, by its number from 0.",
                see_finding_number, {.menu = kNoMenu, .argument = "N"}),
        Command("tree.mend", "Mend the fit",
                "Fits the trees as what was noticed suggests: the finding of that number, else the one seen last.",
                mend_finding, {.argument = "[N]", .also = "fix repair improve tight"}),
    };
    return in_menu("Tree", rows);
}

}  // namespace mobbscope::app
