#include <app/document/agents.h>
#include <app/ui/widgets.h>
#include <app/viewport/measuring.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <mobb/traversal.h>
#include <render/drawlist/pick.h>
#include <render/parts/measured_line.h>
#include <scene/drawn_agent.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kNearSamples = 2000;   // before and after the disk under the mouse, among which a centre is looked for
constexpr float kEndReach = 7;       // pixels at scale 1 around an end that take hold of it
constexpr float kEndSize = 4;        // its radius
constexpr float kSamePlace = 0.25f;  // pixels between what is seen in one place
constexpr float kFlat = 1e-3f;       // m and s: a drawn corner is that of its node within this

/// The nearest to a pixel of what was offered so far, within reach; of what is seen in one place what lies in front.
class Nearest {
  public:
    Nearest(const ViewProjection& projection, glm::vec2 pixel, float reach)
        : projection_(projection), pixel_(pixel), least_(reach) {}

    /// Whether it is the nearest now. In drawn space.
    bool offer(glm::vec3 point) {
        const auto at = projection_.project(point);
        if (!at) return false;
        const float away = glm::length(*at - pixel_);
        const float depth = projection_.depth(point);
        const bool in_one_place = found_ && std::abs(away - least_) < kSamePlace;
        if (in_one_place ? depth >= depth_ : away >= least_) return false;
        least_ = away;
        depth_ = depth;
        found_ = true;
        return true;
    }

  private:
    const ViewProjection& projection_;
    glm::vec2 pixel_;
    float least_;
    float depth_ = 0;
    bool found_ = false;
};

/// Who is drawn as ObjectId::agent has it, where it is drawn.
std::vector<DrawnAgent> drawn_in(const Workspace& workspace) {
    return drawn_agents(workspace.fitted(), workspace.view());
}

std::string agent_name_in(const DrawList& list, const ObjectId& id) {
    return list.agents.at(static_cast<std::size_t>(id.agent));
}

/// The box's corner as its node has it; the drawn one of a box that is cut.
glm::dvec3 exact_corner(const DrawnAgent& agent, int node, std::size_t corner, glm::dvec3 drawn) {
    const mobb::Box box = world_box(agent.placed, node);
    glm::dvec3 out = mobb::corners(box)[corner];
    out.z /= agent.placed.time_scale();
    return glm::length(out - drawn) < kFlat ? out : drawn;
}

/// Of several disks the one that the place is on.
const mobb::PlacedClip& path_at(const DrawnAgent& agent, int sample, double time, const glm::dvec3& place) {
    const auto beyond_rim = [&](const mobb::PlacedClip& path) {
        const mobb::Disk disk = mobb::swept(path, sample).at(time);
        return std::hypot(place.x - disk.x, place.y - disk.y) - disk.r;
    };
    return *std::ranges::min_element(agent.paths(), {}, beyond_rim);
}

/// A disk's centre, its rim, or where the mouse is on it.
MeasuredEnd on_disk(const DrawList& list, const DrawnAgent& agent, const Pick& hit, Nearest& nearest) {
    const std::string name = agent_name_in(list, hit.id);
    const int here = hit.id.index;
    const double time =
        list.moment ? *list.moment : std::clamp(hit.place.z, agent.clip().time(here), agent.clip().time(here + 1));
    const mobb::PlacedClip& clip = path_at(agent, here, time, hit.place);
    const mobb::Disk disk = mobb::swept(clip, here).at(time);
    const std::string sample = ", sample " + std::to_string(here);
    // A disk of a moment is as high as a person.
    MeasuredEnd out{{hit.place.x, hit.place.y, time}, name + sample};
    const glm::dvec2 from_centre = glm::dvec2(hit.place) - glm::dvec2(disk.x, disk.y);
    const double away = glm::length(from_centre);
    if (away > 0 && disk.r > 0) {
        const glm::dvec2 rim = glm::dvec2(disk.x, disk.y) + disk.r / away * from_centre;
        // The side is the rim wherever the mouse is on it: a centre that is near goes before.
        const bool on_side = std::abs(away - disk.r) < kFlat;
        if (on_side || nearest.offer(list.space.point(rim.x, rim.y, hit.place.z)))
            out = {{rim, time}, name + sample + ", edge"};
    }
    const int first = list.moment ? here : std::max(0, here - kNearSamples);
    const int end = list.moment ? here + 1 : std::min(clip.count(), here + kNearSamples + 1);
    for (int i = first; i < end; ++i) {
        const mobb::Disk centre = list.moment ? disk : clip.disk(i);
        const double then = list.moment ? time : clip.time(i);
        const double height = list.moment ? hit.place.z : then;
        const auto at = [&](double z) { return list.space.point(centre.x, centre.y, z); };
        const bool is_nearest = nearest.offer(at(height)) || (list.moment && nearest.offer(at(0)));
        if (is_nearest) out = {{centre.x, centre.y, then}, name + ", sample " + std::to_string(i) + ", centre"};
    }
    return out;
}

/// Metres, seconds and metres a second, each with its digits.
std::vector<double> numbers_of(const MeasuredLine& line) {
    return {line.metres(), line.seconds(), line.speed().value_or(0)};
}

std::optional<ImVec2> seen_at(const ShownPicture& picture, const MeasuredEnd& end) {
    const double height = picture.list.moment ? 0 : end.place.z;
    return picture.at(picture.list.space.point(end.place.x, end.place.y, height));
}

/// From the middle of the line to that of words of a size beside it: above it or to its right.
glm::vec2 beside_line(const ShownPicture& picture, const Measuring& measuring, glm::vec2 size, float gap) {
    const auto from = seen_at(picture, *measuring.from), to = seen_at(picture, *measuring.to);
    const glm::vec2 way = from && to ? glm::vec2(to->x - from->x, to->y - from->y) : glm::vec2(1, 0);
    const glm::vec2 along = glm::length(way) > 1 ? glm::normalize(way) : glm::vec2(1, 0);
    glm::vec2 across(along.y, -along.x);
    if (across.y > 0.05f || (across.y > -0.05f && across.x < 0)) across = -across;
    return across * (0.5f * glm::dot(glm::abs(across), size) + gap);
}

void draw_end(const Ui& ui, ImVec2 at, bool lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled(at, ui.px(lit ? kEndSize + 1.5f : kEndSize), to_im(ui.style.palette.background));
    draw.AddCircle(at, ui.px(lit ? kEndSize + 1.5f : kEndSize), ui.style.accent, 0, ui.px(1.8f));
}

std::string place_text(glm::dvec3 place) { return formatted("%.3f, %.3f m at %.3f s", place.x, place.y, place.z); }

/// The numbers beside the line, which copy themselves; whether the mouse is on one.
bool measured_label(Ui& ui, const ShownPicture& picture, const MeasuredLine& line) {
    const auto middle = middle_in_view(picture.list, line);
    if (!middle) return false;
    const ImFont& font = *ui.style.mono;
    const std::string words = measured_words(line);
    const ImVec2 text = text_size(font, words);
    const glm::vec2 size(text.x, text.y), pad(ui.px(5), ui.px(3));
    const glm::vec2 low = glm::vec2(picture.corner.x, picture.corner.y) + pad;
    const glm::vec2 high = low + glm::vec2(picture.list.size.width, picture.list.size.height) - 2.0f * pad - size;
    const glm::vec2 wanted =
        low - pad + *middle + beside_line(picture, ui.workspace.measuring, size, ui.px(12)) - 0.5f * size;
    const glm::vec2 at = glm::clamp(wanted, low, glm::max(low, high)), from = at - pad, to = at + size + pad;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({from.x, from.y}, {to.x, to.y}, ui.style.panel, ui.px(4));
    draw.AddRect({from.x, from.y}, {to.x, to.y}, ui.style.accent, ui.px(4));
    draw_text(draw, font, {at.x, at.y}, ui.style.text, words);
    ui.marks.add("measure.words", {at, at + size});
    return copies_numbers(ui, words, {at.x, at.y}, font, numbers_of(line));
}

/// The end that a click would take.
void next_end(Ui& ui, const ShownPicture& picture, const MeasuredEnd& next) {
    const Measuring& measuring = ui.workspace.measuring;
    const auto at = seen_at(picture, next);
    if (!at) return;
    std::string told = next.what + "\n" + place_text(next.place);
    if (measuring.from) {
        if (const auto from = seen_at(picture, *measuring.from))
            ImGui::GetWindowDrawList()->AddLine(*from, *at, ui.style.accent, ui.px(1.2f));
        told += "\n" + measured_words({measuring.from->place, next.place});
    }
    draw_end(ui, *at, true);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(9), ui.px(7)});
    ImGui::SetTooltip("%s", told.c_str());
    ImGui::PopStyleVar();
}

}  // namespace

std::optional<MeasuredEnd> end_at(const Workspace& workspace, const DrawList& list, glm::vec2 pixel, float reach) {
    const std::vector<DrawnAgent> agents = drawn_in(workspace);
    Nearest nearest(list.projection, pixel, reach);
    std::optional<MeasuredEnd> out;
    const auto of_agent = [&](const ObjectId& id) -> const DrawnAgent& {
        return agents.at(static_cast<std::size_t>(id.agent));
    };
    const std::vector<Pick> hits = pick(list, pixel);
    const auto disk = std::ranges::find_if(hits, [](const Pick& hit) { return hit.id.kind == ObjectId::Kind::disk; });
    if (disk != hits.end()) {
        out = on_disk(list, of_agent(disk->id), *disk, nearest);
    } else {
        const double time = list.moment ? *list.moment : list.space.origin.z;
        const double height = list.moment ? 0 : time;
        if (const auto floor = floor_at(list, pixel, height)) out = MeasuredEnd{{*floor, time}, "the floor"};
    }
    // Of a moment the height is no time, and boxes are people's.
    if (list.moment) return out;
    for (const BoxInstance& box : list.boxes) {
        if (!box.pickable || box.id.kind != ObjectId::Kind::box || box.edge.a == 0) continue;
        const auto corners = box_corners(box);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (!nearest.offer(corners[i])) continue;
            const glm::dvec3 drawn = list.space.place(corners[i]);
            const DrawnAgent& agent = of_agent(box.id);
            out = MeasuredEnd{exact_corner(agent, box.id.index, i, drawn), node_name(agent, box.id.index) + ", corner"};
        }
    }
    return out;
}

LineEnd line_end_at(const Ui& ui, const ShownPicture& picture) {
    const Measuring& measuring = ui.workspace.measuring;
    if (measuring.picks || !measured_in_view(ui.workspace)) return LineEnd::none;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    for (const auto& [end, which] : {std::pair(&measuring.to, LineEnd::to), {&measuring.from, LineEnd::from}}) {
        const auto at = seen_at(picture, **end);
        if (at && std::hypot(at->x - mouse.x, at->y - mouse.y) <= ui.px(kEndReach)) return which;
    }
    return LineEnd::none;
}

bool draw_measuring(Ui& ui, const ShownPicture& picture, const std::optional<MeasuredEnd>& next) {
    const Measuring& measuring = ui.workspace.measuring;
    if (!can_measure(ui.workspace)) return false;
    const LineEnd held = line_end_at(ui, picture);
    const auto end = [&](const std::optional<MeasuredEnd>& at, LineEnd which, const char* mark) {
        const auto seen = at ? seen_at(picture, *at) : std::nullopt;
        if (!seen) return;
        draw_end(ui, *seen, held == which);
        ui.marks.add(mark, {{seen->x - 1, seen->y - 1}, {seen->x + 1, seen->y + 1}});
    };
    end(measuring.from, LineEnd::from, "measure.from");
    end(measuring.to, LineEnd::to, "measure.to");
    const auto line = measuring.line();
    const bool on_number = line && measured_label(ui, picture, *line);
    if (next && ImGui::IsItemHovered()) next_end(ui, picture, *next);
    return on_number && !measuring.picks;
}

}  // namespace mobbscope::app
