/// Every action of the window, by name: menus, palette, help sheet, shortcuts, scripts and tests are made from one
/// table.
#pragma once

#include <app/input/key.h>
#include <app/session/session.h>
#include <scene/view_options.h>

#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// What a parameter stands for: the text that a command was given, the desktop, a part or a screen of the session, or
/// all of it.
template <class Parameter, class AnySession>
Parameter given(AnySession& session, const std::string& text) {
    using Type = std::remove_cvref_t<Parameter>;
    if constexpr (std::is_same_v<Type, std::string>) {
        return text;
    } else if constexpr (std::is_same_v<Type, Session>) {
        return session;
    } else if constexpr (std::is_same_v<Type, Desktop>) {
        return *session.desktop;
    } else if constexpr (std::is_base_of_v<Screen, Type>) {
        return session.template the<Type>();
    } else if constexpr (std::is_const_v<AnySession>) {
        return std::get<const Type&>(Session::parts(session));
    } else {
        return std::get<Type&>(Session::parts(session));
    }
}

/// A function of a session that names only the parts that it takes, in any order, and the text if it wants that:
/// `[](Workspace& workspace, const std::string& name) { ... }`.
template <class Result, class AnySession>
class OfParts {
  public:
    OfParts() = default;
    template <class Function>
    requires(!std::is_same_v<std::remove_cvref_t<Function>, OfParts>) OfParts(Function function)
        : OfParts(std::in_place, std::function(std::move(function))) {}

    /// A function of one part.
    template <class Returned, class Part>
    OfParts(Returned (Part::*function)())
        : OfParts([function](Part& part) { return static_cast<Result>((part.*function)()); }) {}
    template <class Returned, class Part>
    OfParts(Returned (Part::*function)() const)
        : OfParts([function](const Part& part) { return static_cast<Result>((part.*function)()); }) {}

    Result operator()(AnySession& session, const std::string& text = {}) const { return call_(session, text); }
    explicit operator bool() const { return static_cast<bool>(call_); }

  private:
    template <class Returned, class... Parameters>
    OfParts(std::in_place_t, std::function<Returned(Parameters...)> function)
        : call_([function = std::move(function)](AnySession& session, const std::string& text) {
              return static_cast<Result>(function(given<Parameters>(session, text)...));
          }) {}

    std::function<Result(AnySession&, const std::string&)> call_;
};

/// The rule of commands that need nothing but a scene.
inline bool has_scene(const Workspace& workspace) { return !workspace.empty(); }
inline bool always() { return true; }

/// Why a command that says no more cannot be done.
inline constexpr std::string_view kNotNow = "not now";

/// Whether a command can be done; and why not, where a scene is open and no job under way.
struct Condition {
    template <class Holds, class WhyNot>
    Condition(Holds if_, WhyNot else_) : holds(if_), why_not(else_) {}
    template <class Holds>
    Condition(Holds if_) : Condition(if_, [] { return kNotNow; }) {}
    bool operator()(const Session& session) const { return holds(session); }

    OfParts<bool, const Session> holds;
    OfParts<std::string_view, const Session> why_not;
};

/// What a command does. Throws InputError, MachineError or std::invalid_argument, in words for the person.
using Action = OfParts<void, Session>;

/// Where a command can be done: with what its table is of, the scene or a screen (home); with the scene; or whatever is
/// shown.
enum class Where { home, scene, everywhere };

/// What a command may have besides.
struct CommandTraits {
    /// "File", "Edit", "View", "Tree", "Query", "Go", a screen's or "Help", and behind a slash the submenu;
    /// empty in a row: that of its part; kNoMenu: none
    std::string_view menu{};
    std::string_view behind{};    ///< of a screen's command in another menu: the command after which it stands there
    std::string_view shortcut{};  ///< "Ctrl+O"; several separated by a blank; empty: none
    bool repeats = false;         ///< while its key is held
    std::string_view argument{};  ///< what it takes: "FILE", "N"; in brackets if it can do without; empty: nothing
    Condition enabled = has_scene;
    Where where = Where::home;
    OfParts<bool, const Session> checked{};                      ///< of a toggle: whether it is on
    OfParts<std::vector<std::string>, const Session> choices{};  ///< arguments to choose from
    /// What menus call a choice. Null: as it is given.
    std::function<std::string(const std::string& choice)> choice_title{};
    /// Without choices: the argument that would leave all as it is now, with which a prompt for another one begins;
    /// empty where nothing is. Null: there is no such argument.
    OfParts<std::string, const Session> present{};
    /// Of a command with choices: whether this one is what is now. Null: no choice is.
    OfParts<bool, const Session> chosen{};
    OfParts<std::string, const Session> title_end{};  ///< what its title goes on with in menus: " moving A"
    /// Synonyms beside the words of the title, by which the palette finds the command.
    std::string_view also{};
};

struct Command : CommandTraits {
    Command(std::string_view id_, std::string_view title_, std::string_view doc_, Action run_,
            CommandTraits traits = {})
        : CommandTraits(std::move(traits)), id(id_), title(title_), doc(doc_), run(std::move(run_)) {}

    std::string_view id;     ///< "view.top": for scripts
    std::string_view title;  ///< "View from above": for menus and the palette
    std::string_view doc;    ///< one sentence
    Action run;
    const Screen* screen = nullptr;  ///< that it is about; null: the scene

    bool needs_argument() const { return !argument.empty() && !argument.starts_with('['); }
};

/// The table, in the order of the menus: without screens, or with those of a session.
std::span<const Command> commands();
std::span<const Command> commands(const Session& session);
/// ... with these rows of screens.
std::vector<Command> commands_with(std::vector<Command> of_screens);
/// The session can show it from now on.
void add_screen(Session& session, std::unique_ptr<Screen> screen);

/// Why a command cannot be done now; empty if it can.
std::string_view why_not(const Session& session, const Command& command);
/// ... of a command that looks for a step of the query in view.
std::string_view why_no_step(const Workspace& workspace);
/// ... of a command about the tests of the query in view, and whether there are any.
std::string_view why_no_tests(const Workspace& workspace);
bool has_tests(const Workspace& workspace);
/// Whether the query in view has made tests that are listed.
bool has_events(const QueryInspector& queries);
/// Whether the scene asks anything.
bool has_queries(const Workspace& workspace);

/// Null if there is none.
const Command* find_command(std::string_view id, std::span<const Command> table = commands());
/// Throws std::invalid_argument, with the nearest id, if there is none.
const Command& command_named(std::string_view id, std::span<const Command> table = commands());

/// Runs a command by id at once, as a script does between frames: throws std::invalid_argument if there is none, it is
/// not enabled, or it is given an argument that it does not take or none where it needs one; and what the command
/// throws.
void run_command(Session& session, std::string_view id, const std::string& argument = "");

/// Runs a command for a person once the frame is drawn (CommandQueue).
void invoke(Session& session, std::string_view id, const std::string& argument = "");

/// Opens the palette for the argument of a command.
void ask_for_argument(Session& session, const Command& command);

/// The command that a chord calls where the session is: with the scene or with a screen; null if none.
const Command* command_for(const Session& session, const Chord& chord);

/// Whether a command is about what is shown, the scene or a screen: menus have no others.
bool belongs_here(const Session& session, const Command& command);

/// What menus call a choice of a command.
std::string title_of_choice(const Command& command, const std::string& choice);

/// The first of a command's shortcuts, as menus show it; empty if it has none.
std::string_view first_shortcut(const Command& command);

/// The command of a toggle or a choice, from its row in the table of view options.
Command option_command(const ViewOption& option);

// The parts of the table, one file each.
std::vector<Command> file_commands();
std::vector<Command> export_commands();  ///< among those of files
std::vector<Command> edit_commands();
std::vector<Command> clip_commands();
std::vector<Command> view_commands();
std::vector<Command> named_view_commands();    ///< among those of the view
std::vector<Command> side_by_side_commands();  ///< among those of views
std::vector<Command> shown_commands();
std::vector<Command> tree_commands();
std::vector<Command> node_commands();   ///< among those of trees: their nodes as a table
std::vector<Command> sweep_commands();  ///< among those of trees
std::vector<Command> query_commands();
std::vector<Command> step_commands();
std::vector<Command> reason_commands();
std::vector<Command> proof_commands();    ///< among those of queries
std::vector<Command> compare_commands();  ///< among those of queries
std::vector<Command> map_commands();      ///< among those of queries
std::vector<Command> debug_commands();    ///< among those of queries: events, breakpoints, bookmarks
std::vector<Command> go_commands();
std::vector<Command> row_commands();  ///< among those of where to go: rows of the table below the picture
std::vector<Command> crowd_commands();

/// Rows of a part: those that say no menu stand in this one.
std::vector<Command> in_menu(std::string_view menu, std::vector<Command> rows);
inline constexpr std::string_view kNoMenu = "none";  ///< of a row there: it stands in no menu
/// The rows of all these parts.
std::vector<Command> joined(std::initializer_list<std::vector<Command>> parts);

}  // namespace mobbscope::app
