/// The views of the document's scene, side by side. Places count from left to right.
#pragma once

#include <app/document/workspace.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

class Views {
  public:
    explicit Views(Workspace& workspace) : workspace_(workspace) {}

    std::size_t count() const { return workspace_.document().beside.size() + 1; }
    /// The place of the view that commands and panels are about.
    std::size_t active() const { return workspace_.document().place; }
    /// What is seen at a place, < count(); of a run as Workspace::shown.
    SceneView at(std::size_t place) const { return {fitted(place), view(place)}; }
    std::shared_ptr<const FittedScene> fitted(std::size_t place) const;
    const ViewState& view(std::size_t place) const;
    /// Shows the scene once more, to the right of all, as the active view does but with the fit of those options; makes
    /// it if there is none, under that name or with a number behind it. Throws std::invalid_argument for options out of
    /// range or already in view, an empty name, or if there are kMostViews.
    void split(const std::string& name, const mobb::FitOptions& options);
    /// Shows the scene with each of these fits, from left to right, as the active view does; the first is active. At
    /// those levels, if any are given, and with no query then. Throws std::invalid_argument for options out of range,
    /// two fits alike, fewer than two or more than kMostViews.
    void compare(const std::vector<mobb::FitOptions>& fits, const std::optional<LevelRange>& levels = {});
    /// Closes the view at that place, if it is not the only one; beside an active one that is closed its neighbour is
    /// active. No effect if out of range.
    void close(std::size_t place);
    /// Only the active view is left, and of the fits its own and the scene's first.
    void close_others();
    /// Commands and panels are about the view at that place from now on; no effect if out of range.
    void activate(std::size_t place);
    /// Whether all views have that in common.
    void link(bool ViewLinks::*what, bool linked);

    /// Says where the camera of the view at a place stands, and how high a second is drawn (metres; 0: as before). No
    /// step of its own for undo.
    void settle_camera(std::size_t place, const Camera& camera, double time_height);
    /// The same of one that framed the scene by itself.
    void frame_camera(std::size_t place, const Camera& camera, double time_height);
    /// Whether the height of a second is one that somebody has chosen, not that of the last framing.
    bool has_chosen_height() const { return workspace_.view().time_height != workspace_.settled_height; }
    /// The pictures are of this size now. Cameras that framed the scene by themselves frame it again, others that stand
    /// keep their scale; also those that undo and the way back from an excerpt lead to. A suspended workspace follows
    /// when it is back.
    void resize_pictures(PictureSize to);

    bool follow_test = false;  ///< the camera goes to the pair under test where that is not well in the picture
    /// As the window shows the active view; none: no window does.
    struct Picture {
        PictureSize size;
        double scale = 0;  ///< of its text and lines, as build_draw_list takes it
    };
    std::optional<Picture> picture;

  private:
    Workspace& workspace_;
    mutable std::vector<ShownRun> shown_beside_;  ///< by place
};

}  // namespace mobbscope::app
