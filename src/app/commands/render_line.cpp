#include <app/commands/explicit_view.h>
#include <app/commands/render_line.h>
#include <import/text.h>
#include <render/lens.h>

#include <stdexcept>

namespace mobbscope::app {

namespace {

[[noreturn]] void ask_to_save() {
    throw std::invalid_argument(
        "save the scene first (Ctrl+S): this picture shows more than its files and the options of a command say");
}

/// The options that lead from one camera to another; the file's is taken as it is.
std::string camera_options(const Camera& file, const Camera& now) {
    if (now == file) return "";
    Camera reached = file;  // as `render` applies the options
    reached.target.reset();
    reached.preset = now.preset;
    std::string out = " --view " + std::string(name(now.preset));
    if (now.preset == CameraPreset::free) {
        reached.yaw_deg = now.yaw_deg;
        reached.pitch_deg = now.pitch_deg;
        out += " --yaw " + short_double(now.yaw_deg) + " --pitch " + short_double(now.pitch_deg);
    }
    if (orientation(reached).perspective && !now.perspective) {
        reached.perspective = false;
        out += " --ortho";
    }
    // What a named view does not look at does not count.
    const Orientation seen = orientation(reached);
    const Orientation wanted = orientation(now);
    const bool same_angles = seen.yaw_deg == wanted.yaw_deg && seen.pitch_deg == wanted.pitch_deg;
    const bool same_lens = seen.perspective == wanted.perspective && (!seen.perspective || file.fov_deg == now.fov_deg);
    if (now.target || now.shift != file.shift || !same_angles || !same_lens) ask_to_save();
    return out;
}

std::string view_options(const ViewState& file, const ViewState& now) {
    std::string out = camera_options(file.camera, now.camera);
    if (now.query) {
        if (now.query != file.query) out += " --query " + std::to_string(*now.query);
        if (now.step != file.step) out += " --step " + to_string(now.step);
    } else if (now.levels != file.levels || file.query) {
        out += " --level " + to_string(now.levels);
    }
    if (now.time != file.time) {
        if (!now.time) ask_to_save();
        out += " --time " + short_double(*now.time);
    }
    if (now.time_height != file.time_height) {
        if (now.time_height <= 0) ask_to_save();
        out += " --time-height " + short_double(now.time_height);
    }
    if (now.theme != file.theme) out += " --theme " + std::string(name(now.theme));
    if (now.color_by != file.color_by) out += " --color-by " + std::string(name(now.color_by));
    // The rest has no options.
    ViewState reached = now;
    reached.disks = file.disks;
    reached.boxes = file.boxes;
    reached.floor = file.floor;
    reached.time_axis = file.time_axis;
    reached.labels = file.labels;
    reached.caption = file.caption;
    reached.legend = file.legend;
    if (reached != now) ask_to_save();
    return out;
}

/// A word as a POSIX shell takes it literally.
std::string shell_quoted(const std::string& word) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + '\'';
}

}  // namespace

std::string render_line(const Session& session) {
    const std::filesystem::path& file = session.scene().file;
    const bool one_file =
        session.opened().empty() || (session.opened().size() == 1 && session.opened().front() == file);
    if (session.modified() || !one_file || file.empty()) ask_to_save();
    const PictureSize size = viewport_size(session);
    const std::string scale = session.hooks.ui_scale ? " --scale " + short_double(session.hooks.ui_scale()) : "";
    // Of an unchanged scene, its `view` is the one in the file.
    return "mobbscope render " + shell_quoted(file.string()) + view_options(session.scene().view, session.view()) +
           " --size " + std::to_string(size.width) + 'x' + std::to_string(size.height) + scale + " -o picture.png";
}

}  // namespace mobbscope::app
