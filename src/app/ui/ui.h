/// What panels are drawn with: one frame of Dear ImGui over the session.
#pragma once

#include <app/document/session.h>
#include <app/ui/style.h>
#include <render/drawlist/draw_list.h>
#include <render/image/image.h>

#include <imgui.h>

#include <map>
#include <memory>
#include <string>

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
    /// The texture of what the viewport at that place shows, upper row first at v = 1 (OpenGL's way up). What has
    /// changed since the last call is painted anew when a frame is next looked at. `still`: it will stay a while, so it
    /// is worth smooth edges.
    virtual ImTextureID picture(std::size_t place, Changed changed, bool still) = 0;
    /// The texture of a picture, its upper row at v = 0, transparent parts on a grey chequer. What was in the slot
    /// before is gone. `smooth`: blended between pixels, not each a square. Null if it is larger than OpenGL can hold.
    virtual ImTextureID image(std::size_t slot, const std::shared_ptr<const Image>& image, bool smooth) = 0;
};

/// All that a panel gets.
struct Ui {
    Session& session;
    const Style& style;
    Marks& marks;
    Painter& painter;
    double now = 0;  ///< seconds, only ever more
    double next_frame =
        0;  ///< in so many seconds another frame is wanted, whatever happens; infinity: none. Panels lower it

    /// Names the last widget for scripts.
    void mark(const std::string& name) const {
        const ImVec2 min = ImGui::GetItemRectMin();
        const ImVec2 max = ImGui::GetItemRectMax();
        marks.add(name, {{min.x, min.y}, {max.x, max.y}});
    }
    void want_frame_in(double seconds) { next_frame = next_frame < seconds ? next_frame : seconds; }
    float px(float at_scale_1) const { return at_scale_1 * style.scale; }
};

}  // namespace mobbscope::app
