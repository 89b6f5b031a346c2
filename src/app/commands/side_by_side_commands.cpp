// Several views of the scene side by side, each with a fit of its own, and what they have in common.
#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <scene/fit_text.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

namespace {

bool is_split(const Views& views) { return views.count() > 1; }
std::string_view why_not_split() { return "there is one view"; }
bool has_room(const Workspace& workspace, const Views& views) {
    return has_scene(workspace) && views.count() < kMostViews;
}
std::string_view why_no_room() { return "there are no more than four views"; }

mobb::FitOptions with_kind(mobb::FitOptions fit, mobb::TreeKind kind) {
    fit.tree = kind;
    return fit;
}

/// How a new view's fit is called.
std::string name_of_view(const mobb::FitOptions& fit) { return std::string(mobb::info(fit.tree).label); }

void toggle_split(Views& views, Workspace& workspace) {
    if (is_split(views)) return views.close_others();
    const mobb::FitOptions& now = workspace.fitted().options();
    const mobb::FitOptions other =
        with_kind(now, now.tree == mobb::TreeKind::umobb ? mobb::TreeKind::mobb : mobb::TreeKind::umobb);
    views.split(name_of_view(other), other);
}

mobb::FitOptions parsed_fit(const std::string& text, const mobb::FitOptions& base) {
    const mobb::FitOptions fit = parse_fit(text, base);
    mobb::check(fit);
    return fit;
}

void add_fit(Views& views, Workspace& workspace, const std::string& text) {
    const mobb::FitOptions fit = parsed_fit(text, workspace.fitted().options());
    views.split(name_of_view(fit), fit);
}

void compare_fits_of(Views& views, Workspace& workspace, const std::string& text) {
    std::vector<mobb::FitOptions> fits;
    for (const std::string& word : words_of(text)) fits.push_back(parsed_fit(word, workspace.fitted().options()));
    views.compare(fits);
}

/// As text that compare_fits_of reads.
std::string present_fits(const Views& views, const Workspace& workspace) {
    std::string out;
    for (std::size_t place = 0; place < views.count(); ++place) {
        if (place > 0) out += ' ';
        out += fit_text(views.at(place).fitted->options(), workspace.fitted().options());
    }
    return out;
}

/// The deepest level of Figures 2 and 5.
void compare_as_the_paper(Views& views, Workspace& workspace) {
    const mobb::FitOptions& now = workspace.fitted().options();
    views.compare({with_kind(now, mobb::TreeKind::mobb), with_kind(now, mobb::TreeKind::umobb)},
                  LevelRange{2, 2, false});
}

void close_view(Views& views, const std::string& text) {
    const int last = static_cast<int>(views.count()) - 1;
    views.close(text.empty() ? views.active()
                             : static_cast<std::size_t>(whole_number_in(text, "the number of the view", 0, last)));
}

bool is_in_view(const Views& views, const mobb::FitOptions& fit) {
    for (std::size_t place = 0; place < views.count(); ++place) {
        if (views.at(place).fitted->options() == fit) return true;
    }
    return false;
}

/// Kinds of trees that would be a fit which is not in view yet.
std::vector<std::string> kinds_to_add(const Views& views, const Workspace& workspace) {
    std::vector<std::string> out;
    for (const std::string_view kind : mobb::tree_kind_names()) {
        if (!is_in_view(views, with_kind(workspace.fitted().options(), *find_tree_kind(kind)))) out.emplace_back(kind);
    }
    return out;
}

Command link_command(const ViewLink& link) {
    return {link.command,
            link.title,
            link.doc,
            [on = link.on](Views& views, Workspace& workspace) { views.link(on, !(workspace.document().links.*on)); },
            {.menu = "View/Links",
             .enabled = {is_split, why_not_split},
             .checked = [on = link.on](const Views& views, const Workspace& workspace) {
                 return is_split(views) && workspace.document().links.*on;
             }}};
}

}  // namespace

std::vector<Command> side_by_side_commands() {
    const std::vector<Command> rows{
        Command("view.split", "Split",
                "Shows the scene twice, side by side: beside these trees UMOBB trees, or MOBB trees where these are "
                "UMOBB. Of several views, closes all but the active one.",
                toggle_split, {.menu = "View", .checked = is_split, .also = "compare dual two"}),
        Command("view.other", "Go to the other view",
                "Of several views: makes the next one active, for commands and panels.",
                [](Views& views) { views.activate((views.active() + 1) % views.count()); },
                {.menu = "View", .shortcut = "F6", .enabled = {is_split, why_not_split}}),
        Command("compare.paper", "Compare MOBB with UMOBB",
                "Shows both kinds side by side at level 2, as Figures 2 and 5 of the paper do, and says which is "
                "tighter and which costs less.",
                compare_as_the_paper, {.also = "side by side versus tighter better best figure"}),
        Command("compare.fits", "Compare two to four fits...",
                "Shows two to four fits side by side, as mobb,leaf=10 moving,leaf=40, with a table by level: which is "
                "tighter, and which costs less.",
                compare_fits_of,
                {.argument = "FIT FIT...", .present = present_fits, .also = "side by side versus tighter better best"}),
        Command("compare.add", "Compare with another fit",
                "Shows one more fit side by side: other trees, or all of a fit, as moving,leaf=40.", add_fit,
                {.argument = "FIT",
                 .enabled = {has_room, why_no_room},
                 .choices = kinds_to_add,
                 .also = "side by side versus"}),
        Command("view.close", "Close the view",
                "Of several views: closes the active one, or that of a number, from 0 at the left.", close_view,
                {.argument = "[N]", .enabled = {is_split, why_not_split}}),
    };
    std::vector<Command> links;
    for (const ViewLink& link : kViewLinks) links.push_back(link_command(link));
    return joined({in_menu("View/Compare fits", rows), links});
}

}  // namespace mobbscope::app
