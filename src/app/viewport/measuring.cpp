#include <app/document/agents.h>
#include <app/ui/widgets.h>
#include <app/viewport/measuring.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <mobb/traversal.h>
#include <render/drawlist/pick.h>
#include <render/parts/measured_line.h>
#include <scene/drawn_agent.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kNearSamples = 2000;  // before and after the disk under the mouse, among which a centre is looked for
constexpr float kEndReach = 7;      // pixels at scale 1 around an end that take hold of it
constexpr float kEnd = 4;           // its radius
constexpr float kFlat = 1e-3f;      // m: a drawn corner is that of its node within this

/// The nearest to a pixel of what was offered so far, within reach.
class Nearest {
  public:
    Nearest(glm::vec2 pixel, float reach) : pixel_(pixel), least_(reach) {}

    /// Whether it is the nearest now. `at`: where it is seen.
    bool offer(const std::optional<glm::vec2>& at) {
        const float away = at ? glm::length(*at - pixel_) : least_;
        if (!(away < least_)) return false;
        least_ = away;
        return true;
    }

  private:
    glm::vec2 pixel_;
    float least_;
};

/// Who is drawn as ObjectId::agent has it, where it is drawn.
std::vector<DrawnAgent> drawn_in(const Workspace& workspace) {
    return drawn_agents(workspace.fitted(), workspace.view());
}

std::string name_of(const DrawList& list, const ObjectId& id) {
    return list.agents.at(static_cast<std::size_t>(id.agent));
}

/// The box's corner as its node has it; the drawn one of a box that is cut.
glm::dvec3 exact_corner(const DrawnAgent& agent, int node, std::size_t corner, glm::dvec3 drawn) {
    const mobb::Box box = world_box(agent.placed, node);
    glm::dvec3 out = mobb::corners(box)[corner];
    out.z /= agent.placed.time_scale();
    return glm::length(glm::dvec2(out - drawn)) < kFlat ? out : drawn;
}

/// A disk's centre, its rim, or where the mouse is on it.
MeasuredEnd on_disk(const DrawList& list, const DrawnAgent& agent, const Pick& hit, Nearest& nearest) {
    const mobb::PlacedClip& clip = agent.clip();
    const std::string name = name_of(list, hit.id);
    const int here = hit.id.index;
    const double time = list.moment ? *list.moment : std::clamp(hit.place.z, clip.time(here), clip.time(here + 1));
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
        if (on_side || nearest.offer(list.projection.project(list.space.point(rim.x, rim.y, hit.place.z))))
            out = {{rim, time}, name + sample + ", edge"};
    }
    const int first = list.moment ? here : std::max(0, here - kNearSamples);
    const int end = list.moment ? here + 1 : std::min(clip.count(), here + kNearSamples + 1);
    for (int i = first; i < end; ++i) {
        const mobb::Disk centre = list.moment ? disk : clip.disk(i);
        const double then = list.moment ? time : clip.time(i);
        const double height = list.moment ? hit.place.z : then;
        const auto seen = [&](double at) { return list.projection.project(list.space.point(centre.x, centre.y, at)); };
        const bool is_nearest = nearest.offer(seen(height)) || (list.moment && nearest.offer(seen(0)));
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

void draw_end(const Ui& ui, ImVec2 at, bool lit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled(at, ui.px(lit ? kEnd + 1.5f : kEnd), to_im(ui.style.palette.background));
    draw.AddCircle(at, ui.px(lit ? kEnd + 1.5f : kEnd), ui.style.accent, 0, ui.px(1.8f));
}

std::string place_text(glm::dvec3 place) { return formatted("%.3f, %.3f m at %.3f s", place.x, place.y, place.z); }

}  // namespace

std::optional<MeasuredEnd> end_at(const Workspace& workspace, const DrawList& list, glm::vec2 pixel, float reach) {
    const std::vector<DrawnAgent> agents = drawn_in(workspace);
    Nearest nearest(pixel, reach);
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
            if (!nearest.offer(list.projection.project(corners[i]))) continue;
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
        draw_end(ui, *seen, held == which && which != LineEnd::none);
        ui.marks.add(mark, {{seen->x - 1, seen->y - 1}, {seen->x + 1, seen->y + 1}});
    };
    end(measuring.from, LineEnd::from, "measure.from");
    end(measuring.to, LineEnd::to, "measure.to");
    bool copied = false;
    const auto line = measuring.line();
    if (const auto middle = line ? middle_of(picture.list, *line) : std::nullopt) {
        const ImFont& font = *ui.style.mono;
        const std::string words = measured_words(*line);
        const ImVec2 size = text_size(font, words);
        const float pad = ui.px(5);
        const ImVec2 end_of{picture.corner.x + static_cast<float>(picture.list.size.width),
                            picture.corner.y + static_cast<float>(picture.list.size.height)};
        const auto within = [](float at, float low, float high) { return std::clamp(at, low, std::max(low, high)); };
        const ImVec2 at{
            within(picture.corner.x + middle->x + ui.px(12), picture.corner.x + pad, end_of.x - size.x - pad),
            within(picture.corner.y + middle->y - 0.5f * size.y, picture.corner.y + pad, end_of.y - size.y - pad)};
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        const ImVec2 low{at.x - pad, at.y - 0.6f * pad}, high{at.x + size.x + pad, at.y + size.y + 0.6f * pad};
        draw.AddRectFilled(low, high, ui.style.panel, ui.px(4));
        draw.AddRect(low, high, ui.style.accent, ui.px(4));
        draw_text(draw, font, at, ui.style.text, words);
        ui.marks.add("measure.words", {{at.x, at.y}, {at.x + size.x, at.y + size.y}});
        copied = !measuring.picks && copies_numbers(ui, words, at, font, numbers_of(*line));
    }
    const auto at = next ? seen_at(picture, *next) : std::nullopt;
    if (!at || !ImGui::IsItemHovered()) return copied;
    if (const auto from = measuring.from && !measuring.to ? seen_at(picture, *measuring.from) : std::nullopt)
        ImGui::GetWindowDrawList()->AddLine(*from, *at, ui.style.accent, ui.px(1.2f));
    draw_end(ui, *at, true);
    std::string told = next->what + "\n" + place_text(next->place);
    if (measuring.from && !measuring.to) told += "\n" + measured_words({measuring.from->place, next->place});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(9), ui.px(7)});
    ImGui::SetTooltip("%s", told.c_str());
    ImGui::PopStyleVar();
    return copied;
}

}  // namespace mobbscope::app
