#include <app/commands/camera_commands.h>
#include <app/commands/render_line.h>
#include <base/text.h>
#include <render/drawlist/view_projection.h>

#include <initializer_list>
#include <stdexcept>

namespace mobbscope::app {

namespace {

[[noreturn]] void ask_to_save() {
    throw std::invalid_argument(
        "save the scene first (Ctrl+S): this picture shows more than its files and the options of a command say");
}

/// Numbers with commas between them.
std::string with_commas(std::initializer_list<double> numbers) {
    std::string out;
    for (const double number : numbers) out += (out.empty() ? "" : ",") + short_double(number);
    return out;
}

/// The options that lead from one camera to another; the file's is taken as it is.
std::string camera_options(const Camera& file, const Camera& now) {
    if (now == file) return "";
    Camera reached = file;  // as `render` applies the options
    reached.preset = now.preset;
    std::string out = " --view " + std::string(name(now.preset));
    if (now.preset == CameraPreset::free) {
        reached.yaw_deg = now.yaw_deg;
        reached.pitch_deg = now.pitch_deg;
        out += " --yaw " + short_double(now.yaw_deg) + " --pitch " + short_double(now.pitch_deg);
    }
    if (orientation(now).perspective != orientation(reached).perspective) {
        out += now.perspective ? " --perspective" : " --ortho";
    }
    if (now.fov_deg != file.fov_deg && (orientation(now).perspective || now.target)) {
        out += " --fov " + short_double(now.fov_deg);
    }
    if (!now.target) return out;
    out += " --target " + with_commas({now.target->x, now.target->y, now.target->z});
    out += " --distance " + short_double(now.distance);
    if (now.shift != glm::dvec2(0)) out += " --shift " + with_commas({now.shift.x, now.shift.y});
    return out;
}

struct Toggle {
    bool ViewState::*value;
    const char* on;
    const char* off;
};
constexpr Toggle kToggles[] = {{&ViewState::labels, " --labels", " --no-labels"},
                               {&ViewState::caption, " --caption", " --no-caption"},
                               {&ViewState::legend, " --legend", " --no-legend"},
                               {&ViewState::floor, " --floor", " --no-floor"},
                               {&ViewState::time_axis, " --time-axis", " --no-time-axis"},
                               {&ViewState::boxes, " --boxes", " --no-boxes"},
                               {&ViewState::disks, " --disks", " --no-disks"},
                               {&ViewState::candidates, " --candidates", " --no-candidates"},
                               {&ViewState::tested_before, " --tested-before", " --pair-only"}};

std::string view_options(const ViewState& file, const ViewState& now) {
    std::string out = camera_options(file.camera, now.camera);
    if (now.show != file.show) out += " --show " + std::string(name(now.show));
    if (now.query) {
        if (now.query != file.query) out += " --query " + std::to_string(*now.query);
        if (now.step != file.step) out += " --step " + to_string(now.step);
    } else if (now.levels != file.levels || file.query) {
        out += " --level " + to_string(now.levels);
    }
    if (now.projection != file.projection) ask_to_save();
    if (now.time != file.time) out += " --time " + (now.time ? short_double(*now.time) : "none");
    if (now.time_window != file.time_window) out += " --time-window " + short_double(now.time_window);
    if (now.follow != file.follow) out += " --follow " + (now.follow.empty() ? "none" : shell_word(now.follow));
    if (now.time_height != file.time_height) {
        out += " --time-height " + (now.time_height > 0 ? short_double(now.time_height) : "auto");
    }
    if (now.theme != file.theme) out += " --theme " + std::string(name(now.theme));
    if (now.color_by != file.color_by) out += " --color-by " + std::string(name(now.color_by));
    for (const Toggle& toggle : kToggles) {
        if (now.*toggle.value != file.*toggle.value) out += now.*toggle.value ? toggle.on : toggle.off;
    }
    return out;
}

}  // namespace

std::string render_line(const Session& session) {
    const std::filesystem::path& file = session.scene().file;
    const bool one_file =
        session.opened().empty() || (session.opened().size() == 1 && session.opened().front() == file);
    if (session.modified() || session.in_excerpt() || !one_file || file.empty()) ask_to_save();
    const PictureSize size = viewport_size(session);
    const std::string scale = session.hooks.ui_scale ? " --scale " + short_double(session.hooks.ui_scale()) : "";
    // Of an unchanged scene, its `view` is the one in the file.
    return "mobbscope render " + shell_word(file.string()) + view_options(session.scene().view, session.view()) +
           " --size " + std::to_string(size.width) + 'x' + std::to_string(size.height) + scale + " -o picture.png";
}

}  // namespace mobbscope::app
