/// How the queries of a scene are debugged: filters, breakpoints, bookmarks and named views, saved with the scene.
///
///     {"filters": [{"name": "tight", "where": "gap < 0.05"}], "breakpoints": [{"where": "outcome = hit", "on": true}],
///      "bookmarks": [{"name": "the turn", "query": 0, "step": 412, "note": "B's box is loose here"}],
///      "views": [{"name": "from behind", "view": {"camera": {"preset": "front"}}}]}
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <scene/view_state.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

struct NamedFilter {
    std::string name;   ///< not empty; no two have the same
    std::string where;  ///< an EventFilter
    friend bool operator==(const NamedFilter&, const NamedFilter&) = default;
};

struct Breakpoint {
    std::string where;  ///< an EventFilter; no two are the same
    bool on = true;
    friend bool operator==(const Breakpoint&, const Breakpoint&) = default;
};

/// A step of a query that is found again. A trace of other trees may be shorter: then it means the last step.
struct Bookmark {
    std::string name;
    int query = 0;
    int step = 0;
    std::string note;
    friend bool operator==(const Bookmark&, const Bookmark&) = default;
};

/// How the scene is seen, to come back to.
struct NamedView {
    std::string name;  ///< not empty; no two have the same
    ViewState view;
    friend bool operator==(const NamedView&, const NamedView&) = default;
};

struct DebugState {
    std::vector<NamedFilter> filters;
    std::vector<Breakpoint> breakpoints;
    std::vector<Bookmark> bookmarks;
    std::vector<NamedView> views;
    friend bool operator==(const DebugState&, const DebugState&) = default;
};

/// What bookmarks are chosen by: their names, or the step as it is quoted; of several alike with a number behind.
std::vector<std::string> names_of_bookmarks(const DebugState& debug);

/// Of a scene with so many queries. Throws InputError.
DebugState read_debug_state(const JsonPlace& place, std::size_t queries);
void write_debug_state(JsonWriter& out, const DebugState& debug);

}  // namespace mobbscope
