#include <base/text.h>
#include <mobb/clip.h>
#include <scene/view_json.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace mobbscope {

namespace {

constexpr double kSmallestDistance = 1e-6;  // metres
constexpr double kMaxHeight = 1e6;          // metres drawn per second

struct Toggle {
    const char* key;
    bool ViewState::*value;
};
constexpr Toggle kToggles[] = {{"tested_before", &ViewState::tested_before},
                               {"candidates", &ViewState::candidates},
                               {"disks", &ViewState::disks},
                               {"boxes", &ViewState::boxes},
                               {"floor", &ViewState::floor},
                               {"time_axis", &ViewState::time_axis},
                               {"labels", &ViewState::labels},
                               {"caption", &ViewState::caption},
                               {"legend", &ViewState::legend}};

CameraPreset read_preset(const JsonPlace& place) {
    if (const auto preset = camera_preset(place.string())) return *preset;
    place.fail(in_quotes(place.string()) + " is no camera; give iso, top, front, side or free");
}

Camera read_camera(const JsonPlace& place) {
    place.allow_only({"preset", "yaw_deg", "pitch_deg", "perspective", "fov_deg", "target", "distance", "shift"});
    Camera camera;
    if (const auto preset = place.find("preset")) camera.preset = read_preset(*preset);
    if (const auto yaw = place.find("yaw_deg")) camera.yaw_deg = yaw->number(-1e9, 1e9);
    if (const auto pitch = place.find("pitch_deg")) camera.pitch_deg = pitch->number(-90, 90);
    if (const auto perspective = place.find("perspective")) camera.perspective = perspective->boolean();
    if (const auto fov = place.find("fov_deg")) camera.fov_deg = fov->number(kLeastFov, kMostFov);
    if (const auto target = place.find("target")) {
        target->require_size(3, "[x, y, height] in metres");
        glm::dvec3 point;
        for (int i = 0; i < 3; ++i) point[i] = (*target)[i].number(-mobb::kMaxLength, mobb::kMaxLength);
        camera.target = point;
        camera.distance = place.require("distance").number(kSmallestDistance, mobb::kMaxLength);
        if (const auto shift = place.find("shift")) {
            shift->require_size(2, "[right, up] in widths and heights of the picture");
            for (int i = 0; i < 2; ++i) camera.shift[i] = (*shift)[i].number(-1, 1);
        }
    } else if (const auto distance = place.find("distance")) {
        distance->fail("a distance needs a target; add one, or leave both out and the camera frames the scene");
    } else if (const auto shift = place.find("shift")) {
        shift->fail("a shift needs a target; add one, or leave it out and the camera frames the scene");
    }
    return camera;
}

DiskProjection read_projection(const JsonPlace& place) {
    place.allow_only({"participant", "node", "sample"});
    DiskProjection projection;
    if (const auto participant = place.find("participant")) projection.participant = participant->integer(0, kMaxInt);
    if (const auto node = place.find("node")) projection.node = node->integer(0, kMaxInt);
    if (const auto sample = place.find("sample")) projection.sample = sample->integer(0, kMaxInt);
    return projection;
}

/// A whole number, or text that `parse` understands.
template <class Parse>
auto read_number_or_text(const JsonPlace& place, const Parse& parse) {
    try {
        return parse(place.is_number() ? std::to_string(place.integer(0, kMaxInt)) : place.string());
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
}

void write_camera(JsonWriter& out, const Camera& camera) {
    const Camera standard;
    out.begin_object(JsonWriter::Layout::row);
    out.member("preset", name(camera.preset));
    if (camera.yaw_deg != standard.yaw_deg) out.member("yaw_deg", camera.yaw_deg);
    if (camera.pitch_deg != standard.pitch_deg) out.member("pitch_deg", camera.pitch_deg);
    if (camera.perspective != standard.perspective) out.member("perspective", camera.perspective);
    if (camera.fov_deg != standard.fov_deg) out.member("fov_deg", camera.fov_deg);
    if (camera.target) {
        out.key("target");
        out.numbers({camera.target->x, camera.target->y, camera.target->z});
        out.member("distance", camera.distance);
        if (camera.shift != standard.shift) {
            out.key("shift");
            out.numbers({camera.shift.x, camera.shift.y});
        }
    }
    out.end_object();
}

}  // namespace

ViewState read_view(const JsonPlace& place, ViewState view) {
    place.allow_only({"show",  "camera",      "levels", "query",      "step",        "tested_before", "projection",
                      "time",  "time_window", "follow", "candidates", "time_height", "color_by",      "theme",
                      "disks", "boxes",       "floor",  "time_axis",  "labels",      "caption",       "legend"});
    if (const auto show = place.find("show")) {
        const auto value = show_from_name(show->string());
        if (!value) show->fail("a picture cannot show " + in_quotes(show->string()) + "; give space-time or moment");
        view.show = *value;
    }
    if (const auto camera = place.find("camera")) view.camera = read_camera(*camera);
    if (const auto levels = place.find("levels")) view.levels = read_number_or_text(*levels, parse_level_range);
    if (const auto query = place.find("query")) {
        view.query = query->is_null() ? std::nullopt : std::optional(query->integer(0, kMaxInt));
    }
    if (const auto step = place.find("step")) view.step = read_number_or_text(*step, parse_step);
    if (const auto time = place.find("time")) {
        view.time = time->is_null() ? std::nullopt : std::optional(time->number(-mobb::kMaxTime, mobb::kMaxTime));
    }
    if (const auto window = place.find("time_window")) {
        view.time_window = window->number(kLeastTimeWindow, kMostTimeWindow);
    }
    if (const auto follow = place.find("follow")) view.follow = follow->is_null() ? "" : follow->string();
    if (const auto projection = place.find("projection")) {
        view.projection = projection->is_null() ? std::nullopt : std::optional(read_projection(*projection));
    }
    if (const auto height = place.find("time_height")) view.time_height = height->number(0, kMaxHeight);
    if (const auto color_by = place.find("color_by")) {
        const auto value = color_by_from_name(color_by->string());
        if (!value)
            color_by->fail("boxes cannot be coloured by " + in_quotes(color_by->string()) + "; give agent or level");
        view.color_by = *value;
    }
    if (const auto theme = place.find("theme")) {
        const auto value = theme_from_name(theme->string());
        if (!value) theme->fail(in_quotes(theme->string()) + " is no theme; give dark or light");
        view.theme = *value;
    }
    for (const Toggle& toggle : kToggles) {
        if (const auto value = place.find(toggle.key)) view.*toggle.value = value->boolean();
    }
    return view;
}

void write_view(JsonWriter& out, const ViewState& view) {
    const ViewState standard;
    out.begin_object();
    if (view.show != standard.show) out.member("show", name(view.show));
    if (view.camera != standard.camera) {
        out.key("camera");
        write_camera(out, view.camera);
    }
    if (view.levels != standard.levels) out.member("levels", to_string(view.levels));
    if (view.query) out.member("query", *view.query);
    if (view.step != standard.step) out.member("step", to_string(view.step));
    if (view.projection) {
        out.key("projection");
        out.begin_object(JsonWriter::Layout::row);
        out.member("participant", view.projection->participant);
        out.member("node", view.projection->node);
        out.member("sample", view.projection->sample);
        out.end_object();
    }
    if (view.time) out.member("time", *view.time);
    if (view.time_window != standard.time_window) out.member("time_window", view.time_window);
    if (!view.follow.empty()) out.member("follow", view.follow);
    if (view.time_height != standard.time_height) out.member("time_height", view.time_height);
    if (view.color_by != standard.color_by) out.member("color_by", name(view.color_by));
    if (view.theme != standard.theme) out.member("theme", name(view.theme));
    for (const Toggle& toggle : kToggles) {
        if (view.*toggle.value != standard.*toggle.value) out.member(toggle.key, view.*toggle.value);
    }
    out.end_object();
}

}  // namespace mobbscope
