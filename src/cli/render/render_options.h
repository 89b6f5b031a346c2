/// The options of `render` that describe a picture: as given, and what they make of a scene's view.
#pragma once

#include <cli/options.h>
#include <cli/render_outputs.h>
#include <render/drawlist/picture_options.h>
#include <render/gl/gl_context.h>
#include <render/image/picture_names.h>
#include <render/parts/highlights.h>
#include <render/parts/measured_line.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <scene/view_state.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::cli {

/// An empty one leaves the scene's view.
struct ViewArguments {
    std::filesystem::path state;  ///< --view-state
    std::optional<CameraPreset> preset;
    std::string named;  ///< --view, where it is one of the scene's named views
    std::optional<double> yaw, pitch, fov;
    std::optional<bool> perspective;
    std::optional<glm::dvec3> target;
    std::optional<double> distance;
    std::optional<glm::dvec2> shift;
    /// The texts of those that the table of view options has (scene/view_options.h), by its keys; of a list several.
    std::map<std::string, std::vector<std::string>, std::less<>> shown;
    std::string subtree;  ///< --subtree: AGENT:NODE, or none

    bool says(std::string_view key) const { return shown.contains(key); }
};

/// Several pictures instead of one.
struct SequenceArguments {
    std::optional<std::pair<int, int>> frames;  ///< first and last
    bool play = false;
    std::optional<int> turntable;
    std::optional<double> rate;  ///< pictures per second, of the motion and of a film

    bool any() const { return frames || play || turntable; }
    /// The option that asks for them, if any does.
    const char* option() const { return turntable ? "--turntable" : play ? "--play" : "--frames"; }
};

struct RenderArguments {
    std::filesystem::path file;
    RenderOutputs outputs;
    PictureOptions picture;
    std::optional<Backend> backend;
    ViewArguments view;
    SequenceArguments sequence;
    std::optional<NamedPart> select;  ///< what is highlighted
    std::optional<MeasuredLine> measure;
    bool ui = false;
    std::optional<double> ui_scale;
    FitArguments fit;
    ImportOptions import_options;

    /// Whether its pictures are one film.
    bool is_film() const { return is_film_name(outputs.image); }
};

/// Adds them all, none of them required. `arguments` must live until the command has run; what it holds is the default.
void add_render_options(Command& command, RenderArguments& arguments);

/// Throws UsageError if there is no scene or nothing to write, InputError if the options given cannot all be
/// had, whatever the scene.
void check_together(const RenderArguments& arguments);

/// The scene's view, or one of its named ones, with the options given over it. Throws InputError if the view state's
/// file is none, the two do not go together, or the scene has no such view or node.
ViewState view_over(const FittedScene& fitted, const ViewArguments& arguments);

/// Throws InputError for a view that names what its scene does not have, at the place in the file that says it.
[[noreturn]] void refuse_view(const RenderArguments& arguments, const ViewMismatch& mismatch);

}  // namespace mobbscope::cli
