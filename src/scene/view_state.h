/// What is seen of a scene, and from where. A plain value: JSON in, JSON out. The window edits it, `render` reads it,
/// and every picture is a function of (scene, view state, size).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope {

enum class CameraPreset { iso, top, front, side, free };
enum class Theme { dark, light };
/// What the colour of a level's boxes says: whose they are, or a figure of their node.
enum class ColorBy { agent, level, volume, empty, waste, fill, floor, overhang, share, tests, avoidable };

/// What a picture is of: the stacks and boxes in space-time; the floor at one moment, with people in their cylinders;
/// or a plan of it, the disks and the cross-sections of boxes at that moment.
enum class Show { space_time, moment, plan };

/// From one number to another that is not less.
struct ValueRange {
    double least = 0, most = 0;
    friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// With a query, which tests before the present one are drawn too.
enum class Past {
    pair,       ///< none: the pair under test alone
    ancestors,  ///< the pairs that called it, up to the roots
    siblings,   ///< ... and those that its parent called before it
    all,        ///< every pair tested before
};

/// Where agents are drawn: where they are, or apart from one another, each in a cell of a grid.
enum class Arrange { none, grid };

/// One disk and how far it reaches along the axes of a box around it (the paper's Fig. 6).
struct DiskProjection {
    int agent = 0;   ///< index into what is drawn
    int node = 0;    ///< of its tree
    int sample = 0;  ///< of its clip
    friend bool operator==(const DiskProjection&, const DiskProjection&) = default;
};

/// A node of what is drawn.
struct DrawnNode {
    int agent = 0;  ///< index into what is drawn
    int node = 0;   ///< of its tree
    friend bool operator==(const DrawnNode&, const DrawnNode&) = default;
};

/// Seconds.
inline constexpr double kLeastTimeWindow = 0.1;
inline constexpr double kMostTimeWindow = 60;

/// Metres drawn per second.
inline constexpr double kLeastTimeHeight = 1e-6;
inline constexpr double kMostTimeHeight = 1e6;

/// Degrees.
inline constexpr double kLeastFov = 0.5;
inline constexpr double kMostFov = 150;

struct Camera {
    CameraPreset preset = CameraPreset::iso;  ///< `free` takes the angles below; the others bring their own
    double yaw_deg = 45;                      ///< free: direction from the target to the eye, counter-clockwise from +x
    double pitch_deg = 25;                    ///< free: above the floor, -90..90
    bool perspective = true;                  ///< top, front and side are orthographic whatever this says
    double fov_deg = 12;                      ///< vertical, of the whole picture, kLeastFov..kMostFov
    /// What is looked at, world metres with time drawn as height; none: the camera frames the scene by itself. Of a run
    /// time is counted from the view's; where an agent is followed x and y are counted from it.
    std::optional<glm::dvec3> target;
    /// Metres from the target to the eye (> 0) when there is a target. Without perspective the scale is that which the
    /// target would have with it.
    double distance = 0;
    /// How far to the right and upwards of the picture's middle the target is seen, in widths and heights of the
    /// picture, each -1..1. The picture is shifted, not turned: what is parallel stays so.
    glm::dvec2 shift{0};
    friend bool operator==(const Camera&, const Camera&) = default;
};

/// Which boxes are drawn: those of levels first..last, with the leaves above `first` (so that a level covers the whole
/// clip).
struct LevelRange {
    int first = 2;
    int last = 2;
    bool leaves = false;  ///< the leaves alone, whatever their level
    friend bool operator==(const LevelRange&, const LevelRange&) = default;
};

/// Where in a query's trace we stand.
struct Step {
    enum class Unit {
        event,
        percent,
        end,
        // The event that is so many-th of its kind, from 1.
        separated,
        overlap,
        hit,
        avoidable,  ///< overlap
        leaf,       ///< the last test of a pair of leaves
        depth,      ///< the first event at a depth
    } unit = Unit::end;
    double value = 0;  ///< event number, percentage 0..100, which of its kind, or the depth
    friend bool operator==(const Step&, const Step&) = default;
};

struct ViewState {
    Show show = Show::space_time;  ///< the moment is `time`, or the beginning
    Camera camera;
    LevelRange levels;
    std::optional<int> query;  ///< index into the effective queries: its state at `step` is drawn instead of the levels
    Step step;
    /// With a query. Where the pair stands alone its boxes say by colour and line how its test ended, and the time axis
    /// when its nodes take place.
    Past past = Past::ancestors;
    std::optional<DiskProjection> projection;  ///< drawn instead of all else
    std::optional<double> time;  ///< global seconds: the time cursor, drawn as a plane with the disks that hold then
    /// Seconds before and after `time` that space-time shows of a crowd's run (kLeastTimeWindow..kMostTimeWindow).
    double time_window = 2;
    /// The agent that the camera goes along with: its target is counted from where that agent walks. Empty: nobody.
    std::string follow;
    // Agents by name; of a run its people, of a scene without agents its clips.
    std::vector<std::string> hidden;  ///< not in the picture; what is asked of them is answered as ever
    std::vector<std::string> pinned;  ///< stay in the picture when another one is shown alone, and keep their colour
    /// Drawn whole and named; of all others that are not pinned an outline is left. Empty: all are drawn alike.
    std::vector<std::string> foreground;
    Arrange arrange = Arrange::none;  ///< not of a run, nor of a query: these show where agents are
    bool candidates = true;  ///< of a run's followed agent: the moves of its last choice, and what became of each
    double time_height = 0;  ///< metres drawn per second; 0: chosen so that the scene is about as tall as wide
    ColorBy color_by = ColorBy::agent;  ///< of the boxes of levels; those of a query have their states' colours
    std::optional<ValueRange>
        color_range;                   ///< of the figure, from the first colour to the last; none: of what is shown
    std::optional<DrawnNode> subtree;  ///< of its agent the boxes of that node and below it alone
    std::optional<ValueRange> slab;    ///< global seconds: what is outside is cut away, disks cleanly
    bool cut_boxes = false;            ///< at the planes of the slab; else those that reach into it stay whole
    Theme theme = Theme::dark;
    bool disks = true;
    bool heat = false;  ///< disks have the colour of the tests of boxes that hold them
    bool boxes = true;
    bool slice = false;       ///< at the time cursor, the cross-sections of boxes on its plane
    bool ancestors = false;   ///< of the node of `subtree`, or one that is selected, as ghosts
    bool frame_boxes = true;  ///< a camera that frames the scene by itself has the boxes in it too
    bool cost = false;        ///< in the caption of trees: the tests of boxes that a query of them makes
    bool boundary = false;    ///< with a query, on the floor: within it B's path may not begin, or the two collide
    bool floor = true;        ///< grid in metres, and the paths' traces on it
    bool time_axis = true;    ///< ticks in seconds
    bool labels = true;       ///< all text
    bool caption = true;      ///< the sentences at the top; where a title says it they are not needed
    bool legend = true;
    bool inset = true;        ///< the small map of the floor
    bool proof = true;        ///< at the last step of a query: the lines that keep the two apart, as walls
    bool free_region = true;  ///< ... and where B may stand without ever meeting A, on the floor
    // Overlays fold to a header in their corner; where the picture has no room they do so by themselves.
    bool fold_caption = false;
    bool fold_legend = false;
    bool fold_inset = false;
    bool whole_legend = false;  ///< all its rows, not the first six
    friend bool operator==(const ViewState&, const ViewState&) = default;
};

/// "2", "1:3" or "leaves". Throws std::invalid_argument saying what is allowed.
LevelRange parse_level_range(const std::string& text);
/// An event number, "end", a percentage such as "40%", "separated:2" (the second that found boxes separated; "overlap",
/// "hit", "avoidable" and "leaf" likewise, and without a number the first), or "depth:4". Throws std::invalid_argument.
Step parse_step(const std::string& text);
/// "iso", "top", "front", "side" (and "free"); nothing for any other name.
std::optional<CameraPreset> camera_preset(const std::string& name);
/// The names as they stand in files and on the command line.
std::string_view name(CameraPreset preset);
std::string_view name(Theme theme);
std::optional<Theme> theme_from_name(std::string_view name);
std::string_view name(ColorBy color_by);
std::optional<ColorBy> color_by_from_name(std::string_view name);
std::string_view name(Past past);
std::optional<Past> past_from_name(std::string_view name);
/// "space-time" and "moment".
std::string_view name(Show show);
std::optional<Show> show_from_name(std::string_view name);
/// "none" and "grid".
std::string_view name(Arrange arrange);
std::optional<Arrange> arrange_from_name(std::string_view name);
/// What parse_level_range and parse_step read.
std::string to_string(const LevelRange& levels);
/// "0:2.5", "auto" or "none". Throws std::invalid_argument.
std::optional<ValueRange> parse_value_range(const std::string& text);
std::string to_string(const ValueRange& range);
std::string to_string(const Step& step);

/// A view names something that its scene does not have. what() says so, and what there is.
class ViewMismatch : public std::invalid_argument {
  public:
    /// `key`: that of the view's JSON, such as "query".
    ViewMismatch(std::string key, const std::string& message) : std::invalid_argument(message), key_(std::move(key)) {}
    const std::string& key() const { return key_; }

  private:
    std::string key_;
};

}  // namespace mobbscope
