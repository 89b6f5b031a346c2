/// What a session shows, as JSON: what scripts print, and what they expect of it.
///
///     {"title": "crossing.json", "file": "...", "modified": false, "empty": false,
///      "scene": {...}, "view": {...}, "selection": {"kind": "node", "name": "A", "path": {...}, "index": 3},
///      "hovered": {...}, "query": null, "time": null, "playing": false, "dialog": "none",
///      "messages": [{"level": "info", "text": "...", "offer": "file.open", "put_away": true}], "unread": 1, "undo":
///      null, "redo": null, "job": null}
///
/// `scene` is as in scene files, but clips say their number of `samples` and queries have no traces; `view` is as in
/// scene files, so what is as always is left out. `query` is what is asked in the view: {"index", "a", "b", "collides",
/// "contact_time", "step", "steps", "tests": one count for each kind of test, "outcome",
/// "sentence"}, the last two of the step. `undo` and `redo` are titles. Of a message `offer` is the command that it
/// offers first, and `put_away` says that it is behind the bell; `unread` counts warnings and errors that nobody has
/// looked at in the list. The three are left out where there is nothing to say. Screens add what there is of them
/// (Screen::add_state). Once a sweep has ended, `sweep` has for "warm" and "cold" queries what it says: {"recommended":
/// a fit such as "mobb,leaf=20" or null, "undecided": fits, "why": "..."}.
#pragma once

#include <app/session/session.h>

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace mobbscope::app {

nlohmann::ordered_json state_json(const Session& session);

/// It, or a part of it, as text; `indent` -1: on one line. File names may be no UTF-8: what is none is replaced.
std::string state_text(const nlohmann::ordered_json& json, int indent = -1);

/// What is there instead, in words; none if it is as expected.
using ScriptExpectation = std::function<std::optional<std::string>(const Session&)>;

/// `text`: "POINTER VALUE", "POINTER != VALUE" or "POINTER ~ NUMBER TOLERANCE", see script.h. Throws
/// std::invalid_argument, in words, if it is none of them.
ScriptExpectation parse_expectation(std::string_view text);

}  // namespace mobbscope::app
