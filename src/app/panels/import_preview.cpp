// What an import makes of a file, beside the fields that change it.
#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <import/skeleton/disk_sampler.h>
#include <import/skeleton/motion.h>
#include <render/drawlist/palette.h>
#include <render/text/labels.h>
#include <scene/path_figures.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kPerson = 1.7;            // metres: a grown person, to compare with
constexpr double kHeadingWay = 0.1;        // metres from the start to where the heading is taken
constexpr std::size_t kMostPoints = 1500;  // of a line drawn
constexpr std::size_t kMostPoses = 60;     // looked at for the size of the body
constexpr double kLeastTrim = 0.01;        // seconds

struct Plot {
    ImVec2 min, max;
    float width() const { return max.x - min.x; }
    float height() const { return max.y - min.y; }
};

/// A ground of that size at the cursor.
Plot plot(Ui& ui, ImVec2 size, const std::string& mark) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ui.mark(mark);
    const Plot out{at, {at.x + size.x, at.y + size.y}};
    ImGui::GetWindowDrawList()->AddRectFilled(out.min, out.max, ui.style.raised, ui.px(4));
    return out;
}

void note(Ui& ui, ImVec2 at, ImU32 color, const std::string& text) {
    draw_text(*ImGui::GetWindowDrawList(), *ui.style.caption, at, color, text);
}

/// A length of the picture that is a round number of metres, at the lower left.
void metre_scale(Ui& ui, const Plot& in, double pixels_a_metre) {
    const double room = static_cast<double>(in.width()) / pixels_a_metre;
    const double metres = nice_step(room, 4);
    const float length = static_cast<float>(metres * pixels_a_metre);
    const float y = in.max.y - ui.px(8);
    const float x = in.min.x + ui.px(8);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({x, y}, {x + length, y}, ui.style.text, ui.px(1.5f));
    for (const float end : {x, x + length})
        list.AddLine({end, y - ui.px(3)}, {end, y + ui.px(3)}, ui.style.text, ui.px(1));
    note(ui, {x + length + ui.px(5), y - ui.style.caption->FontSize / 2}, ui.style.text, format_double(metres) + " m");
}

/// From the first sample to the first that is some way off, of length 1; none where none is.
std::optional<glm::dvec2> heading_of(std::span<const mobb::Disk> samples) {
    for (const mobb::Disk& disk : samples) {
        const glm::dvec2 way{disk.x - samples.front().x, disk.y - samples.front().y};
        const double length = std::hypot(way.x, way.y);
        if (length >= kHeadingWay) return way / length;
    }
    return std::nullopt;
}

/// Each of at most so many, evenly, the last included.
template <class Visit>
void thinned(std::size_t count, std::size_t most, const Visit& visit) {
    const std::size_t step = count <= most ? 1 : (count + most - 1) / most;
    for (std::size_t i = 0; i < count; i += step) visit(i);
    if (count > 0 && (count - 1) % step != 0) visit(count - 1);
}

int sample_at(const mobb::Clip& clip, double time) {
    return std::clamp(static_cast<int>(time / clip.dt()), 0, clip.count() - 1);
}

void heading_arrow(Ui& ui, ImVec2 from, glm::dvec2 heading) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const glm::vec2 along{static_cast<float>(heading.x), -static_cast<float>(heading.y)};
    const glm::vec2 across{-along.y, along.x};
    const glm::vec2 base = glm::vec2(from.x, from.y) + along * ui.px(18);
    const auto corner = [&](float forward, float sideways) {
        const glm::vec2 at = base + along * ui.px(forward) + across * ui.px(sideways);
        return ImVec2{at.x, at.y};
    };
    list.AddLine(from, {base.x, base.y}, ui.style.warning, ui.px(2));
    list.AddTriangleFilled(corner(8, 0), corner(0, 4), corner(0, -4), ui.style.warning);
}

/// The way over the floor from above, to scale, with the disk of the moment.
void path_from_above(Ui& ui, Imports& imports, const mobb::Clip& clip, ImVec2 size) {
    const Plot in = plot(ui, size, "import.path");
    const std::span<const mobb::Disk> samples = clip.samples();
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high = -low;
    for (const mobb::Disk& disk : samples) {
        low = {std::min(low.x, disk.x - disk.r), std::min(low.y, disk.y - disk.r)};
        high = {std::max(high.x, disk.x + disk.r), std::max(high.y, disk.y + disk.r)};
    }
    const glm::dvec2 span{std::max(high.x - low.x, 1e-6), std::max(high.y - low.y, 1e-6)};
    const float pad = ui.px(22);
    const double scale = std::min((in.width() - 2 * pad) / span.x, (in.height() - 2 * pad) / span.y);
    const glm::dvec2 middle = 0.5 * (low + high);
    const auto at = [&](double x, double y) {
        return ImVec2{0.5f * (in.min.x + in.max.x) + static_cast<float>((x - middle.x) * scale),
                      0.5f * (in.min.y + in.max.y) - static_cast<float>((y - middle.y) * scale)};
    };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(in.min, in.max, true);
    const Rgba accent = ui.style.palette.accent;
    thinned(samples.size(), 80, [&](std::size_t i) {
        list.AddCircle(at(samples[i].x, samples[i].y), static_cast<float>(samples[i].r * scale),
                       to_im(with_alpha(accent, 0.22f)), 0, ui.px(1));
    });
    std::vector<ImVec2> line;
    thinned(samples.size(), kMostPoints, [&](std::size_t i) { line.push_back(at(samples[i].x, samples[i].y)); });
    list.AddPolyline(line.data(), static_cast<int>(line.size()), ui.style.text, 0, ui.px(1.5f));
    const mobb::Disk& now = samples[static_cast<std::size_t>(sample_at(clip, imports.edited.time))];
    list.AddCircle(at(now.x, now.y), static_cast<float>(now.r * scale), ui.style.accent, 0, ui.px(2));
    list.AddCircleFilled(at(now.x, now.y), ui.px(3), ui.style.accent);
    const ImVec2 start = at(samples.front().x, samples.front().y);
    const std::optional<glm::dvec2> heading = heading_of(samples);
    if (heading) heading_arrow(ui, start, *heading);
    list.AddCircleFilled(start, ui.px(4), ui.style.warning);
    list.PopClipRect();
    note(ui, {in.min.x + ui.px(6), in.min.y + ui.px(4)}, ui.style.quiet, "from above");
    const std::string starts = heading ? "start and heading" : "start";
    const float width = text_size(*ui.style.caption, starts).x;
    note(ui, {in.max.x - width - ui.px(6), in.min.y + ui.px(4)}, ui.style.warning, starts);
    metre_scale(ui, in, scale);
}

/// How far the body below the root reaches over all times, metres.
struct BodySize {
    double low = 0, high = kPerson;
    double reach = 0.3;
};

BodySize size_of(const Skeleton& skeleton, const std::vector<bool>& inside, int samples) {
    BodySize out;
    thinned(static_cast<std::size_t>(samples), kMostPoses, [&](std::size_t i) {
        const auto positions = skeleton.at(static_cast<int>(i));
        for (std::size_t joint = 0; joint < positions.size(); ++joint) {
            if (!inside[joint]) continue;
            const glm::vec3& p = positions[joint];
            out.low = std::min<double>(out.low, p.z);
            out.high = std::max<double>(out.high, p.z);
            out.reach = std::max<double>(out.reach, std::hypot(p.x, p.y));
        }
    });
    return out;
}

/// The bones at the moment from the side and from the front, on one floor, beside a person's height.
void body(Ui& ui, Imports& imports, const SceneClip& clip, ImVec2 size) {
    const Plot in = plot(ui, size, "import.body");
    const Skeleton& skeleton = *clip.skeleton;
    const std::vector<bool> inside = subtree(skeleton.joints, skeleton.root);
    const BodySize body = size_of(skeleton, inside, clip.clip->count());
    const float pad = ui.px(22);
    const float ruler = ui.px(44);
    const double scale =
        std::min((in.height() - 2 * pad) / (body.high - body.low), (in.width() - ruler - pad) / (4 * body.reach));
    const float floor = in.max.y - pad + static_cast<float>(body.low * scale);
    const float room = (in.width() - ruler) / 2;
    const auto y_of = [&](double z) { return floor - static_cast<float>(z * scale); };
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(in.min, in.max, true);
    list.AddLine({in.min.x + ui.px(6), floor}, {in.max.x - ui.px(6), floor}, ui.style.quiet, ui.px(1));
    const float x = in.min.x + ui.px(12);
    list.AddRectFilled({x - ui.px(1.5f), std::min(y_of(kPerson), floor - ui.px(2))}, {x + ui.px(1.5f), floor},
                       ui.style.warning);
    list.AddLine({x, y_of(kPerson)}, {in.max.x - ui.px(6), y_of(kPerson)},
                 to_im(with_alpha(ui.style.palette.text, 0.18f)), ui.px(1));
    const std::optional<glm::dvec2> heading = heading_of(clip.clip->samples());
    const glm::dvec2 ahead = heading.value_or(glm::dvec2(1, 0));
    const auto positions = skeleton.at(sample_at(*clip.clip, imports.edited.time));
    for (int view = 0; view < 2; ++view) {
        const glm::dvec2 across = view == 0 ? ahead : glm::dvec2(ahead.y, -ahead.x);
        const float middle = in.min.x + ruler + room * (static_cast<float>(view) + 0.5f);
        const auto at = [&](const glm::vec3& p) {
            return ImVec2{middle + static_cast<float>((p.x * across.x + p.y * across.y) * scale), y_of(p.z)};
        };
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const int parent = skeleton.joints[i].parent;
            if (parent < 0) continue;
            const bool counts = inside[i] && inside[static_cast<std::size_t>(parent)];
            list.AddLine(at(positions[static_cast<std::size_t>(parent)]), at(positions[i]),
                         counts ? ui.style.text : ui.style.border, ui.px(1.5f));
        }
        list.AddCircleFilled(at(positions[static_cast<std::size_t>(skeleton.root)]), ui.px(3.5f), ui.style.accent);
        const std::string name = view == 0 ? (heading ? "side" : "along x") : (heading ? "front" : "along y");
        note(ui, {middle - text_size(*ui.style.caption, name).x / 2, in.max.y - ui.px(16)}, ui.style.quiet, name);
    }
    list.PopClipRect();
    note(ui, {in.min.x + ui.px(6), in.min.y + ui.px(4)}, ui.style.quiet, "skeleton, root " + clip.facts.root);
    note(ui, {x + ui.px(5), std::max(y_of(kPerson) - ui.px(14), in.min.y + ui.px(18))}, ui.style.warning, "1.7 m");
}

/// The clip's moment under the mouse, while a button holds it there.
void scrub(Imports& imports, const ChartAxis& x, double duration) {
    if (!ImGui::IsItemActive()) return;
    imports.edited.time = std::clamp(x.value(ImGui::GetIO().MousePos.x), 0.0, duration);
}

void radius_over_time(Ui& ui, Imports& imports, const mobb::Clip& clip, const PathFigures& figures, ImVec2 size) {
    const Plot in = plot(ui, size, "import.radius_chart");
    const float caption = ui.style.caption->FontSize;
    const std::pair<std::string, double> levels[] = {
        {formatted("max %.3g m", figures.max_radius), figures.max_radius},
        {formatted("mean %.3g m", figures.mean_radius), figures.mean_radius},
        {formatted("min %.3g m", figures.min_radius), figures.min_radius}};
    float label = 0;
    for (const auto& level : levels) label = std::max(label, text_size(*ui.style.caption, level.first).x);
    const ChartAxis x{0, clip.duration(), in.min.x + ui.px(6), in.max.x - label - ui.px(12)};
    const double top = figures.max_radius > 0 ? 1.1 * figures.max_radius : 1;
    const ChartAxis y{0, top, in.max.y - ui.px(4), in.min.y + caption + ui.px(6)};
    ImGui::SetCursorScreenPos(in.min);
    ImGui::InvisibleButton("radius", size);
    scrub(imports, x, clip.duration());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    // Labels one below the other, however near the values are.
    float least = in.min.y;
    float most = in.max.y - static_cast<float>(std::size(levels)) * caption;
    for (const auto& [text, value] : levels) {
        const float level = y.pixel(value);
        list.AddLine({x.first, level}, {x.last, level}, to_im(with_alpha(ui.style.palette.text, 0.25f)), ui.px(1));
        const float at = std::min(std::max(level - caption / 2, least), most);
        note(ui, {x.last + ui.px(6), at}, ui.style.quiet, text);
        least = at + caption;
        most += caption;
    }
    std::vector<ImVec2> curve;
    const std::span<const mobb::Disk> samples = clip.samples();
    thinned(samples.size(), kMostPoints, [&](std::size_t i) {
        curve.push_back({x.pixel((static_cast<double>(i) + 0.5) * clip.dt()), y.pixel(samples[i].r)});
    });
    list.AddPolyline(curve.data(), static_cast<int>(curve.size()), ui.style.text, 0, ui.px(1.5f));
    const float now = x.pixel(imports.edited.time);
    list.AddLine({now, in.min.y}, {now, in.max.y}, ui.style.accent, ui.px(1.5f));
    note(ui, {in.min.x + ui.px(10), in.min.y + ui.px(3)}, ui.style.quiet, "radius over time");
}

/// The file's time with the part that is taken, and the moment that is shown: a bar to scrub on, and below it a handle
/// at each end of the part.
void time_bar(Ui& ui, Imports& imports, const SceneClip& clip, double seconds) {
    ClipImport& now = imports.edited;
    const auto trim = clip.options.trim;
    const double begin = trim ? trim->first : 0;
    const double end = trim ? std::min(trim->second, seconds) : seconds;
    const double offset = clip.facts.t0 ? clip.start : begin;
    const float handle = ui.px(12);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 bar{width, ui.px(16)};
    const ChartAxis x{0, std::max(seconds, 1e-6), corner.x + handle / 2, corner.x + width - handle / 2};
    ImGui::InvisibleButton("time", bar);
    ui.mark("import.time");
    if (ImGui::IsItemActive()) {
        now.time = std::clamp(x.value(ImGui::GetIO().MousePos.x) - offset, 0.0, clip.clip->duration());
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({x.first, corner.y}, {x.last, corner.y + bar.y}, ui.style.window, ui.px(3));
    list.AddRectFilled({x.pixel(begin), corner.y}, {x.pixel(std::max(end, begin)), corner.y + bar.y},
                       to_im(with_alpha(ui.style.palette.accent, 0.4f)), ui.px(3));
    const float at = x.pixel(std::min(offset + now.time, seconds));
    list.AddLine({at, corner.y}, {at, corner.y + bar.y}, ui.style.accent, ui.px(2));
    const float y = corner.y + bar.y + ui.px(1);
    const auto hold = [&](const char* name, double value) {
        const float middle = x.pixel(value);
        ImGui::SetCursorScreenPos({middle - handle / 2, y});
        ImGui::InvisibleButton(name, {handle, handle});
        ui.mark(std::string("import.trim.") + name);
        const bool active = ImGui::IsItemActive();
        const bool lit = active || ImGui::IsItemHovered();
        if (lit) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        list.AddTriangleFilled({middle, y}, {middle - handle / 2, y + handle}, {middle + handle / 2, y + handle},
                               lit ? ui.style.text : ui.style.accent);
        if (!active || ImGui::GetIO().MouseDelta.x == 0) return value;
        return std::round(1000 * std::clamp(x.value(ImGui::GetIO().MousePos.x), 0.0, seconds)) / 1000;
    };
    const double first = std::min(hold("begin", begin), end - kLeastTrim);
    const double last = std::max(hold("end", end), begin + kLeastTrim);
    const std::string left = formatted("%.2f s", begin);
    const std::string right = formatted("%.2f s of %.2f s", end, seconds);
    const float caption = y + handle;
    const float right_x = corner.x + width - text_size(*ui.style.caption, right).x;
    note(ui, {corner.x, caption}, ui.style.quiet, left);
    note(ui, {right_x, caption}, ui.style.quiet, right);
    const std::string moment = formatted("shown: %.2f s", now.time);
    const float moment_width = text_size(*ui.style.caption, moment).x;
    const float moment_x = corner.x + 0.5f * (width - moment_width);
    // Where there is no room for all three, the bar shows it.
    if (moment_x + moment_width + ui.px(8) < right_x) note(ui, {moment_x, caption}, ui.style.accent, moment);
    ImGui::SetCursorScreenPos(corner);
    ImGui::Dummy({width, caption + ui.style.caption->FontSize - corner.y});
    if (first == begin && last == end) return;
    const bool all = first <= 0 && last >= seconds;
    ui.invoke("clip.set", all ? "trim" : formatted("trim %.6g %.6g", std::max(first, 0.0), last));
}

void figures_of_clip(Ui& ui, const mobb::Clip& clip, const PathFigures& figures) {
    const std::pair<const char*, std::string> cells[] = {
        {"samples", std::to_string(clip.count())},
        {"lasts", formatted("%.2f s", clip.duration())},
        {"path", formatted("%.3g m", figures.length)},
        {"speed", formatted("%.3g m/s", figures.mean_speed)},
        {"radius", formatted("%.3g m", figures.mean_radius)},
    };
    const float left = ImGui::GetCursorPosX();
    const float cell = ImGui::GetContentRegionAvail().x / static_cast<float>(std::size(cells));
    for (std::size_t i = 0; i < std::size(cells); ++i) {
        if (i > 0) ImGui::SameLine(left + cell * static_cast<float>(i));
        ImGui::BeginGroup();
        text_line(ui.style.quiet, cells[i].first, ui.style.caption);
        text_line(ui.style.text, cells[i].second, ui.style.mono);
        ImGui::EndGroup();
        ui.mark(std::string("import.figure.") + cells[i].first);
    }
}

}  // namespace

void import_preview(Ui& ui, Imports& imports, const SceneClip& clip) {
    ClipImport& now = imports.edited;
    const PathFigures figures = figures_of(*clip.clip);
    now.time = std::clamp(now.time, 0.0, clip.clip->duration());
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float gap = ui.px(8);
    const float bar = ui.px(46);
    const float words = 2 * ImGui::GetTextLineHeightWithSpacing();
    const float chart = std::clamp(0.22f * room.y, ui.px(48), ui.px(104));
    const float height = std::max(ui.px(80), room.y - bar - words - chart - 4 * gap);
    const float half = std::floor((room.x - gap) / 2);
    path_from_above(ui, imports, *clip.clip, {clip.skeleton ? half : room.x, height});
    if (clip.skeleton) {
        ImGui::SameLine(0, gap);
        body(ui, imports, clip, {room.x - half - gap, height});
    }
    radius_over_time(ui, imports, *clip.clip, figures, {room.x, chart});
    const double seconds = now.offer && now.offer->find("trim") ? now.offer->seconds : 0;
    if (seconds > 0) time_bar(ui, imports, clip, seconds);
    figures_of_clip(ui, *clip.clip, figures);
}

}  // namespace mobbscope::app
