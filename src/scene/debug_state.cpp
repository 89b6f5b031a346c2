#include <base/text.h>
#include <scene/debug_state.h>
#include <scene/event_filter.h>
#include <scene/scene_edits.h>
#include <scene/step_link.h>
#include <scene/view_options.h>

#include <algorithm>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

std::string read_where(const JsonPlace& place) {
    const JsonPlace where = place.require("where");
    const std::string& text = where.string();
    try {
        return EventFilter(text).text();
    } catch (const FilterError& error) {
        where.fail("at character " + std::to_string(code_points(text.substr(0, error.at())).size() + 1) + " of " +
                   in_quotes(text) + ": " + error.what());
    }
}

NamedFilter read_filter(const JsonPlace& place, const std::vector<NamedFilter>& others) {
    place.allow_only({"name", "where"});
    const JsonPlace name = place.require("name");
    NamedFilter out{std::string(trimmed(name.string())), read_where(place)};
    if (out.name.empty()) name.fail("a filter needs a name");
    if (std::ranges::find(others, out.name, &NamedFilter::name) != others.end())
        name.fail("another filter is named " + in_quotes(out.name) + "; rename one");
    return out;
}

Breakpoint read_breakpoint(const JsonPlace& place, const std::vector<Breakpoint>& others) {
    place.allow_only({"where", "on"});
    Breakpoint out{read_where(place), true};
    if (std::ranges::find(others, out.where, &Breakpoint::where) != others.end())
        place.fail("another breakpoint is the same; remove one");
    if (const auto on = place.find("on")) out.on = on->boolean();
    return out;
}

Bookmark read_bookmark(const JsonPlace& place, std::size_t queries) {
    place.allow_only({"name", "query", "step", "note"});
    Bookmark out;
    if (const auto name = place.find("name")) out.name = name->string();
    const JsonPlace query = place.require("query");
    out.query = query.integer(0, kMaxInt);
    if (static_cast<std::size_t>(out.query) >= queries)
        query.fail("the scene has " + counted(queries, "query", "queries") + ", counted from 0");
    out.step = place.require("step").integer(0, kMaxInt);
    if (const auto note = place.find("note")) out.note = note->string();
    return out;
}

NamedView read_named_view(const JsonPlace& place, const std::vector<NamedView>& others) {
    place.allow_only({"name", "view"});
    const JsonPlace name = place.require("name");
    NamedView out{std::string(trimmed(name.string())), {}};
    if (out.name.empty()) name.fail("a view needs a name");
    if (camera_preset(out.name)) name.fail(in_quotes(out.name) + " is a camera that every scene has; rename the view");
    if (std::ranges::find(others, out.name, &NamedView::name) != others.end())
        name.fail("another view is named " + in_quotes(out.name) + "; rename one");
    out.view = read_view(place.require("view"));
    return out;
}

}  // namespace

std::vector<std::string> names_of_bookmarks(const DebugState& debug) {
    std::vector<std::string> out;
    UnusedNames names;
    for (const Bookmark& bookmark : debug.bookmarks) {
        const std::string link = to_string(StepLink{bookmark.query, bookmark.step});
        out.push_back(names.take(bookmark.name.empty() ? link : bookmark.name));
    }
    return out;
}

DebugState read_debug_state(const JsonPlace& place, std::size_t queries) {
    place.allow_only({"filters", "breakpoints", "bookmarks", "views"});
    DebugState out;
    if (const auto filters = place.find("filters"))
        filters->each([&](const JsonPlace& each) { out.filters.push_back(read_filter(each, out.filters)); });
    if (const auto breakpoints = place.find("breakpoints"))
        breakpoints->each(
            [&](const JsonPlace& each) { out.breakpoints.push_back(read_breakpoint(each, out.breakpoints)); });
    if (const auto bookmarks = place.find("bookmarks"))
        bookmarks->each([&](const JsonPlace& each) { out.bookmarks.push_back(read_bookmark(each, queries)); });
    if (const auto views = place.find("views"))
        views->each([&](const JsonPlace& each) { out.views.push_back(read_named_view(each, out.views)); });
    return out;
}

void write_debug_state(JsonWriter& out, const DebugState& debug) {
    out.begin_object();
    if (!debug.filters.empty()) {
        out.list("filters", debug.filters, [&](const NamedFilter& filter) {
            out.begin_object(Layout::row);
            out.member("name", filter.name);
            out.member("where", filter.where);
            out.end_object();
        });
    }
    if (!debug.breakpoints.empty()) {
        out.list("breakpoints", debug.breakpoints, [&](const Breakpoint& breakpoint) {
            out.begin_object(Layout::row);
            out.member("where", breakpoint.where);
            out.member("on", breakpoint.on);
            out.end_object();
        });
    }
    if (!debug.bookmarks.empty()) {
        out.list("bookmarks", debug.bookmarks, [&](const Bookmark& bookmark) {
            out.begin_object(Layout::row);
            out.member("name", bookmark.name);
            out.member("query", bookmark.query);
            out.member("step", bookmark.step);
            if (!bookmark.note.empty()) out.member("note", bookmark.note);
            out.end_object();
        });
    }
    if (!debug.views.empty()) {
        out.list("views", debug.views, [&](const NamedView& named) {
            out.begin_object();
            out.member("name", named.name);
            out.key("view");
            write_view(out, named.view);
            out.end_object();
        });
    }
    out.end_object();
}

}  // namespace mobbscope
