/// The way that every picture of a scene is made: who is in it, from where it is seen, what is drawn, the words around.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/block_layout.h>
#include <render/layout/caption.h>
#include <render/parts/floor_and_axes.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <glm/vec2.hpp>

#include <memory>
#include <vector>

namespace mobbscope {

struct FollowedChoice;  // crowd/simulation/choice.h
class KeptPaths;        // render/pictures/kept_paths.h

class Picture {
  public:
    virtual ~Picture() = default;
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    /// Finds the place of scene, caption, legend and map. All that a camera needs to know.
    const PictureFrame& aim();
    /// Aims and draws the rest; once.
    DrawList draw();

  protected:
    struct Words {
        Caption caption;
        std::vector<LegendEntry> legend;
        glm::vec2 map{0};  ///< size of the floor map, pixels; 0: none
    };

    /// Throws std::invalid_argument if there is nobody to draw.
    Picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options);

    /// What the picture says. The caption is left out where the view has none.
    virtual Words words() = 0;
    /// Sets projection and frame below `top` (pixels); returns the places of the legend and a map of that size.
    virtual Blocks find_places(float top, glm::vec2 map);
    /// What legend and map had better not cover. Needs the projection.
    virtual std::vector<Rect> busy() const { return {}; }
    /// Adds what is drawn; returns what is said beside it. Needs the projection.
    virtual std::vector<LabelRequest> content() { return {}; }
    /// What stands along the floor and the time axis.
    virtual std::vector<LabelRequest> floor_labels() const;
    /// Adds the floor map with its upper left corner at a point.
    virtual void add_map(glm::vec2) {}
    /// Adds names, which come last.
    virtual void add_names_to(LabelLayout&) {}

    /// The floor whose labels the picture leaves room for.
    virtual FloorExtent widest_floor() const { return floor_extent_; }

    const FittedScene& fitted_;
    ViewState view_;
    PictureOptions options_;
    Metrics metrics_;
    std::vector<DrawnAgent> agents_;
    FloorExtent floor_extent_;
    ShownPoints points_;  ///< all that must be inside the picture
    DrawList list_;

  private:
    void let_stand_out();
    void say_what_view_does(Caption& caption) const;

    LabelLayout layout_;
    Blocks blocks_;
};

/// The points of a grid in the box from `low` to `high` that are seen, as small rectangles around their pixels.
/// `cells`: along each side.
std::vector<Rect> seen_grid(const ViewProjection& projection, glm::vec3 low, glm::vec3 high, glm::ivec3 cells);

/// The middle of those points.
glm::dvec3 middle_of(const ShownPoints& points);

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
std::unique_ptr<Picture> moment_picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                                        const FollowedChoice* choice);

}  // namespace mobbscope
