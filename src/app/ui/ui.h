/// What panels are drawn with: one frame of Dear ImGui over the session.
#pragma once

#include <app/commands/command.h>
#include <app/session/session.h>
#include <app/ui/focus.h>
#include <app/ui/style.h>
#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <imgui.h>
#include <imgui_internal.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

/// Where widgets stand in the last frame, by name: scripts and tests click on names, not on pixels.
class Marks {
  public:
    void clear() { rects_.clear(); }
    void add(const std::string& name, const Rect& rect) { rects_[name] = rect; }
    const std::map<std::string, Rect>& all() const { return rects_; }

  private:
    std::map<std::string, Rect> rects_;
};

/// Paints the viewports' pictures for the panels to show.
class Painter {
  public:
    virtual ~Painter() = default;
    enum class Changed { nothing, highlights, all };  ///< each includes those before it
    /// `unattended`: nobody looks, and only the fine picture counts. `dragging`: all pictures are as coarse as they
    /// must be to follow.
    enum class Interaction { unattended, idle, dragging };
    struct Shown {
        ImTextureID texture;  ///< upper row first at v = 1 (OpenGL's way up)
        double coarse_for;    ///< seconds that the fine picture has not come
    };
    /// What the viewport at that place shows. What has changed since the last call is painted anew when a frame is next
    /// looked at. `now`: seconds.
    virtual Shown picture(std::size_t place, Changed changed, Interaction interaction, double now) = 0;
    /// The texture of a picture, its upper row at v = 0, transparent parts on a grey chequer. What was in the slot
    /// before is gone, and what is not asked for in a frame. `smooth`: blended between pixels, not each a square. Null
    /// if it is larger than OpenGL can hold.
    virtual ImTextureID image(std::size_t slot, const std::shared_ptr<const Image>& image, bool smooth) = 0;
};

/// What is under way in a field of a panel: a text that is typed, or a number that is dragged.
struct FieldInput {
    std::string mark;  ///< of the field; empty: nothing is
    std::string text{}, before{};
    double value = 0;     ///< of the number, before it is rounded
    double given = 0;     ///< what the field has given last
    bool fresh = false;   ///< the field does not have the keys yet
    int waits = 2;        ///< frames until it must have them
    bool typing = false;  ///< else it is dragged
    int picked = 0;       ///< of the words that may go on with the text

    /// Keys that are pressed meanwhile are for the field.
    bool waits_for_keys() const { return typing && waits > 0; }
};

/// All that a panel gets.
struct Ui {
    Session& session;      ///< for commands
    Workspace& workspace;  ///< what is shown; changed by commands and by `later` alone
    const Style& style;
    Marks& marks;
    Focus& focus;
    FieldInput& field;
    Painter& painter;
    double now = 0;  ///< seconds, only ever more
    double next_frame =
        0;  ///< in so many seconds another frame is wanted, whatever happens; infinity: none. Panels lower it

    Selection hovered{};       ///< what is under the mouse in this frame, in any panel: the session's in the next
    int hovered_event = -1;    ///< likewise, of the query in view
    double frame_seconds = 0;  ///< that the last frame took; 0: not to be shown, as it is never the same

    /// Names the last widget for scripts.
    void mark_only(const std::string& name) const { marks.add(name, last_rect()); }
    /// ... and for the keys: they come to it where it can be pressed.
    void mark(const std::string& name, OwnKeys own = OwnKeys::none, std::string_view label = {}) const {
        mark_only(name);
        focus.add(name, last_rect(), ImGui::GetItemID(), own, label);
    }
    /// Where the last widget stands.
    static Rect last_rect() {
        const ImVec2 min = ImGui::GetItemRectMin();
        const ImVec2 max = ImGui::GetItemRectMax();
        return {{min.x, min.y}, {max.x, max.y}};
    }
    /// Runs a command once the frame is drawn.
    void invoke(std::string_view id, const std::string& argument = "") const { app::invoke(session, id, argument); }
    /// Does it once the frame is drawn, with the parts of the session that it names. What it throws becomes a message.
    void later(Action action) const {
        session.queue.push([&at = session, action = std::move(action)] { action(at); });
    }
    void want_frame_in(double seconds) { next_frame = next_frame < seconds ? next_frame : seconds; }
    float px(float at_scale_1) const { return at_scale_1 * style.scale; }
};

}  // namespace mobbscope::app
