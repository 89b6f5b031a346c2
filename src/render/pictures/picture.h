/// The way that every picture of a scene is made: who is in it, from where it is seen, what is drawn, the words around.
#pragma once

#include <render/drawlist/cut.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/framing.h>
#include <render/layout/overlays.h>
#include <render/parts/floor_and_axes.h>
#include <render/pictures/played.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

struct FollowedChoice;  // crowd/simulation/choice.h
struct Framed;          // render/pictures/build_draw_list.h
class KeptPaths;        // render/pictures/kept_paths.h

class Picture {
  public:
    virtual ~Picture() = default;
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// Finds the place of the scene. All that a camera needs to know.
    const PictureFrame& aim();
    /// Aims and draws the rest; once.
    DrawList draw();
    /// As mobbscope::film_camera.
    Camera film_camera(Played played, std::span<const Rect> panels);
    /// What the camera has to have in the picture, and beside what.
    Framed framed();

  protected:
    /// Throws std::invalid_argument if there is nobody to draw.
    Picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options);

    /// Adds the boxes of all steps of the query to what the camera frames.
    virtual void frame_boxes_of_steps() {}
    /// What the picture says. Needs the projection.
    virtual OverlayContents words() = 0;
    /// Adds what is drawn; returns what is said beside it. Needs the projection.
    virtual std::vector<LabelRequest> content() { return {}; }
    /// What stands along the floor and the time axis.
    virtual std::vector<LabelRequest> floor_labels() const;
    /// Adds the floor's map within a rectangle of the size that words() asks for.
    virtual void add_map(const Rect&) {}
    /// Adds names, which come last.
    virtual void add_names_to(LabelLayout&) {}

    /// Calls `add`, and cuts the lines that it adds to the slab.
    template <class Add>
    void within_slab(const Add& add) {
        const std::size_t first = list_.lines.size();
        add();
        cut_lines(list_, first);
    }

    const FittedScene& fitted_;
    ViewState view_;
    PictureOptions options_;
    Metrics metrics_;
    std::vector<DrawnAgent> agents_;
    FloorExtent floor_extent_;
    ShownPoints framed_;  ///< what the camera frames where it has no target
    ShownPoints points_;  ///< all that is drawn: what is near and far
    double margin_ = kFrameMargin;
    DrawList list_;

  private:
    void dim_all_but_pointed_out();
    void mention_view(Caption& caption) const;
    /// Needs a projection that has in the picture what the last one will have.
    const OverlayContents& said();
    std::vector<Rect> panels();

    std::optional<OverlayContents> said_;  ///< once it is known
};

/// Paths and boxes of a scene in space-time. `kept`: of the scene; outlives the picture.
std::unique_ptr<Picture> space_time_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options);

/// Of a run that scene_at made a scene, in space-time. The plane of the view's time stays where it is while time runs,
/// and the stacks sink through it. `choice`: of the followed agent, or null. Both outlive the picture. Throws
/// std::invalid_argument if the view follows nobody there is, or asks for a query.
std::unique_ptr<Picture> crowd_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                                       const FollowedChoice* choice);

/// Boxes of more people would bury everything: those of the followed one are shown alone.
inline constexpr std::size_t kMostCrowdBoxes = 200;

/// Of the view's time, or without one of when the first path in it begins. With a query in the view only its two sides
/// are there. It is framed so that nothing moves but the people while time runs; of a run with its walls around it, and
/// the followed agent's `choice` on the floor (null: none). Scene and choice outlive the picture. Throws
/// std::invalid_argument if the scene has nothing to draw, or no such query.
std::unique_ptr<Picture> moment_picture(KeptPaths& kept, const ViewState& view, const PictureOptions& options,
                                        const FollowedChoice* choice);

}  // namespace mobbscope
