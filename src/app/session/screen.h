/// What the window can show in place of the scene.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <any>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

struct Command;
class Job;
struct Situation;
struct Ui;

struct ScreenWords {
    std::string_view shown;      ///< why what is about the scene cannot be done while it is shown
    std::string_view not_shown;  ///< why what is about it cannot be done while it is not
    const char* search;          ///< what the palette finds while it is shown
};

struct ScreenPanel {
    std::string_view name;
    std::function<void(Ui&)> draw;
};

/// What the palette finds by its name, and the command that is given it.
struct NamedThing {
    std::string_view command;
    std::string name;
    std::string_view kind;  ///< "Case"
};

class Screen {
  public:
    virtual ~Screen() = default;
    virtual const ScreenWords& words() const = 0;
    /// For the window's title.
    virtual std::string title() const = 0;
    /// How many there are of what, for the status bar.
    virtual std::string counts() const = 0;
    /// Its rows of the table of commands.
    virtual std::vector<Command> commands() const = 0;
    /// What a person is in the midst of while it is shown.
    virtual const Situation& situation() const = 0;
    virtual std::vector<NamedThing> things() const = 0;
    /// Left, in the middle and right.
    virtual std::array<ScreenPanel, 3> panels() = 0;
    /// Above the panels of the scene: the way back, where that was opened from here.
    virtual void draw_above_scene(Ui& ui) = 0;
    /// What a script sees of it, shown or not.
    virtual void add_state(nlohmann::ordered_json& state) const = 0;

    /// What a drag may change; and that it is as it was.
    virtual std::any look() const = 0;
    virtual void restore(const std::any& look) = 0;

    /// Takes in what was done beside the window.
    virtual void poll() = 0;
    /// What is under way; null: nothing.
    virtual const Job* work() const = 0;
    /// Ends it, for a person.
    virtual void cancel() = 0;
    /// Ends it with the program.
    virtual void end_work() = 0;
};

}  // namespace mobbscope::app
