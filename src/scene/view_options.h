/// The options of a view, one row each. From the table come the JSON of a view, the options of `render`, "Copy as
/// command", and the window's commands with their menu items and help; a test writes and compares its part of
/// assets/scene.schema.json. For example:
///
///     {"show": "space-time", "camera": {"preset": "iso", "yaw_deg": 45, "pitch_deg": 25, "perspective": true,
///     "fov_deg": 12,
///                 "target": [0, 0, 1], "distance": 12, "shift": [0, 0.1]},
///      "levels": "1:3", "query": 0, "step": "40%", "past": "ancestors",
///      "projection": {"participant": 0, "node": 0, "sample": 3}, "time": 1.5, "time_height": 2,
///      "hidden": ["B"], "pinned": [], "foreground": [], "arrange": "none", "color_by": "agent", "theme": "dark",
///      "disks": true, "boxes": true, "floor": true, "time_axis": true, "labels": true, "legend": true,
///      "inset": true}
///
/// `levels` is a level or what `--level` takes, `step` an event number or what `--step` takes.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <scene/view_state.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// How a choice was written when it was a toggle: files that have it are still read.
struct FormerToggle {
    std::string_view key{};  ///< of the view's JSON; empty: it never was one
    std::string_view on{};   ///< what true means
    std::string_view off{};  ///< what false means
};

/// An option of `render` that is short for another one with a value.
struct ShortForm {
    std::string_view option{};  ///< "--pair-only"; empty: there is none
    std::string_view value{};
};

/// What a toggle shows or leaves out: the rest of the picture stays as it is.
enum class DrawnPart {
    agents,        ///< what lies where an agent is when it is there; of a hidden one nothing
    surroundings,  ///< what stands around, with its words
    words,         ///< text, and the panels that it stands on
    colors,        ///< nothing else: what is drawn anyway has other colours, which words explain
};

struct ViewOption {
    std::string_view key;  ///< of the view's JSON: ViewState's name for it
    std::string_view
        what;  ///< "The upright scale in seconds": help of `render`, and what the schema and the window say
    /// JSON Schema of its value. In the table what stands there beside `what`, unless its kind says it.
    std::string schema{};

    // Of `render`; without `option` only a file says it.
    std::string option{};  ///< "--theme"; of a toggle "--floor,!--no-floor", which is made from the key
    std::string_view placeholder{};
    ShortForm short_form{};

    FormerToggle former_toggle{};

    // In the window: a toggle, or a choice, has a command; those of the menus "View/Show" and
    // "View/Overlays" stand in them by themselves.
    std::string command{};  ///< its id: "view.floor", of a toggle made from the key; empty: none is made from the row
    std::string_view title{};
    std::string_view menu{};
    std::string_view shortcut{};
    std::string_view also{};  ///< other words that people have for it
    bool at_hand = false;     ///< of a toggle: in the toolbar and the menu of the picture, too

    DrawnPart draws = DrawnPart::agents;  ///< of a toggle

    // Where an exported picture can be without it.
    std::string_view without{};  ///< the text that leaves it out; empty: it stays
    /// Whether a view's picture can have it; empty: every one.
    std::function<bool(const ViewState&)> may_be_seen{};

    // Of a choice: its names, what menus call them (empty: the names), and what is said of another one ({}) in a file
    // and in the window.
    std::vector<std::string_view> choices{};
    std::vector<std::string_view> choice_titles{};
    std::string_view refused_in_file{};
    std::string_view refused_in_window{};

    // What table rows leave to toggle(), choice() and field() in view_options.cpp.
    std::string doc{};       ///< of the command: "Shows the upright scale in seconds."
    std::string argument{};  ///< of a choice, as Command has it: "[dark|light]"
    bool ViewState::*toggle = nullptr;
    std::vector<std::string> ViewState::*names = nullptr;        ///< of a list of agents' names
    std::function<void(const JsonPlace&, ViewState&)> read{};    ///< throws InputError
    std::function<void(JsonWriter&, const ViewState&)> write{};  ///< its value, null where the view has none
    std::function<bool(const ViewState&, const ViewState&)> same{};
    std::function<void(const ViewState& from, ViewState& to)> copy{};
    /// Reads an option's text, of a toggle "true" or "false"; throws std::invalid_argument. Of agents one of them,
    /// which a list adds, or kNobody or an empty text for none.
    std::function<void(const std::string&, ViewState&)> parse{};
    std::function<void(const std::string&, ViewState&)> take_agent{};  ///< of agents: `parse`, but of any name
    std::function<std::string(const ViewState&)> text{};               ///< what `parse` reads; empty for a list
    /// Whether a command line that says `from` needs the option to say `to`; empty: where the two are not the same.
    std::function<bool(const ViewState& from, const ViewState& to)> needed{};
};

/// The table, in the order of files, menus and help.
std::span<const ViewOption> view_options();

/// Requires that there is one.
const ViewOption& view_option(std::string_view key);

/// Whether the picture of a view has something that an exported one can be without.
bool can_leave_out(const ViewOption& option, const ViewState& view);

/// The word for no agent in options, where no agent is called so.
inline constexpr std::string_view kNobody = "none";

/// What an option's text says about a view of a scene with these agents (names_in_view): one called kNobody is meant by
/// that. Throws as ViewOption::parse.
void parse_option(const ViewOption& option, const std::string& text, const std::vector<std::string>& agents,
                  ViewState& view);

/// " --theme dark", " --no-floor", " --hide A B": the option that says what the view has, for a shell and a scene with
/// these agents.
std::string in_command_line(const ViewOption& option, const ViewState& view,
                            const std::vector<std::string>& agents = {});

/// `refused` with the text in quotes for its {}.
std::string refusal_of(std::string_view refused, std::string_view text);

/// The `view` of a scene file, every key of which is optional: what the keys say, over `base`. A key that is not there
/// keeps its value, a camera replaces the whole camera, and null takes a query or a time out. Throws InputError.
ViewState read_view(const JsonPlace& place, ViewState base = {});

/// An object with what differs from the default.
void write_view(JsonWriter& out, const ViewState& view);

}  // namespace mobbscope
