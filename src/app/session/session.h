/// The program behind the window, in parts with one job each. Panels show them, commands change them; they know
/// neither.
#pragma once

#include <app/document/node_figures.h>
#include <app/document/query_inspector.h>
#include <app/document/views.h>
#include <app/session/cost_inspector.h>
#include <app/session/crowd_maker.h>
#include <app/session/excerpts.h>
#include <app/session/files.h>
#include <app/session/fit_costs.h>
#include <app/session/fit_notices.h>
#include <app/session/map_inspector.h>
#include <app/session/node_inspector.h>
#include <app/session/query_answers.h>
#include <app/session/recovery.h>
#include <app/session/sweep_inspector.h>

#include <any>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope::app {

/// What is done between frames: panels may keep references into the document while they are drawn.
class CommandQueue {
  public:
    explicit CommandQueue(Notifications& notifications) : notifications_(notifications) {}

    /// Does `something` once the frame is drawn. What it throws becomes a message.
    void push(std::function<void()> something) { queue_.push_back(std::move(something)); }
    /// Does what was enqueued, in order, and what that enqueues; whether there was anything. Not while panels are
    /// drawn.
    bool run();

  private:
    Notifications& notifications_;
    std::deque<std::function<void()>> queue_;
};

/// Where a command sends the keys.
/// `menu_of_this`: what has the focus, or else what is selected in the picture, opens its menu; `picture`: they go back
/// to the picture, where arrows step.
enum class FocusMove { none, next_panel, previous_panel, menu_bar, menu_of_this, picture };
struct Keys {
    std::string focus;                 ///< the widget that has them, by its mark; empty: the viewport
    FocusMove move = FocusMove::none;  ///< asked for, and done in the next frame
    std::string field{};               ///< to be typed into, by its mark: likewise
    std::string section{};             ///< to be unfolded and scrolled to, by its title in lower case: likewise
};

/// Of text and panels.
inline constexpr double kLeastUiScale = 0.5;
inline constexpr double kMostUiScale = 4;

class Session {
  public:
    explicit Session(bool attended, Settings settings = {});
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    SessionOptions options;
    Settings settings;
    SettingsFile settings_file;   ///< of an attended session; none: nothing is kept
    Desktop* desktop;             ///< never null
    PictureMaker* picture_maker;  ///< likewise
    double window_scale = 1;      ///< of text and panels where the settings say none
    Screen* screen = nullptr;     ///< shown in place of the scene; null: the scene is shown
    Counts counts;

    Workspace workspace{settings};
    Views views{workspace};
    QueryInspector queries{workspace};
    NodeFigures figures{workspace, views};
    NodeInspector nodes{workspace, figures};
    Notifications notifications;
    CommandQueue queue{notifications};
    Keys keys;
    Dialogs dialogs;
    Jobs jobs{workspace, notifications, counts, options, desktop};
    Playback playback{workspace};
    Edits edits{workspace, jobs, playback, counts};
    Imports imports{workspace, jobs, edits, dialogs, notifications};
    CrowdInspector crowds{workspace, jobs, notifications};
    MapInspector maps{workspace, notifications, options, desktop};
    QueryAnswers answers{workspace, options, desktop};
    CostInspector costs{workspace, jobs, answers};
    FitCosts fit_costs{workspace, notifications, options, desktop};
    SweepInspector sweeps{workspace, notifications, options, desktop};
    FitNotices notices{workspace, notifications, options, desktop};
    Excerpts excerpts{workspace, jobs, playback, crowds, counts};
    Files files{{workspace, jobs, edits, imports, dialogs, notifications, playback, settings, settings_file, counts,
                 options, screen}};
    CrowdMaker crowd_maker{workspace, files, notifications};
    Recovery recovery{workspace, files, notifications, desktop};
    std::vector<std::unique_ptr<Screen>> screens;          ///< that there are (add_screen)
    std::shared_ptr<const std::vector<Command>> commands;  ///< the table with theirs; null: without

    /// All parts, for what takes some of them (OfParts).
    template <class AnySession>
    static auto parts(AnySession& s) {
        return std::tie(s.options, s.settings, s.workspace, s.views, s.queries, s.figures, s.nodes, s.notifications,
                        s.queue, s.keys, s.dialogs, s.jobs, s.playback, s.edits, s.imports, s.crowds, s.maps, s.answers,
                        s.costs, s.fit_costs, s.sweeps, s.notices, s.excerpts, s.files, s.crowd_maker, s.recovery);
    }

    /// The screen of a type, which add_screen was given.
    template <class AScreen>
    AScreen& the() const {
        for (const auto& each : screens) {
            if (auto* found = dynamic_cast<AScreen*>(each.get())) return *found;
        }
        throw std::logic_error("the session has no such screen");
    }

    /// Of text and panels, kLeastUiScale..kMostUiScale.
    double ui_scale() const;
    /// What the window shows, for its title.
    std::string shown_title() const { return screen ? screen->title() : workspace.title(); }
    /// Whether it has changes that are not saved.
    bool shows_unsaved() const { return !screen && workspace.modified(); }

    /// Takes in what was done beside the window. Call it before each frame.
    void poll();
    /// Ends all work beside the window: nothing calls Desktop::wake any more, unless other work is begun.
    void end_work();

    /// What a drag may change, as it is now.
    struct BeforeDrag {
        History history;
        Settings settings;
        int arrivals = 0;
        std::optional<PictureSize> picture_size;
        std::vector<Camera> framings;
        std::map<std::string_view, Camera> other_cameras;
        std::any look;  ///< of the screen that is shown
    };
    BeforeDrag before_drag() const;
    /// Brings it back, as if nothing had been dragged; not where a job or another document has come meanwhile.
    void restore(BeforeDrag before);
};

}  // namespace mobbscope::app
