#include <app/commands/command.h>
#include <app/document/described.h>
#include <app/document/edit_names.h>
#include <app/document/shown_agents.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <app/viewport/selection_display.h>
#include <app/viewport/viewport.h>
#include <base/text.h>
#include <explain/query_findings.h>
#include <explain/query_sentence.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/pick.h>
#include <render/drawlist/picture_options.h>
#include <render/layout/annotations.h>
#include <render/parts/highlights.h>
#include <render/pictures/build_draw_list.h>
#include <scene/arrangement.h>
#include <scene/drawn_agent.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr double kSignAfter = 0.15;  // seconds that the picture is not yet what it will be
constexpr float kClickReach = 4;     // pixels at scale 1 that a click may slip
constexpr float kEndNear = 9;        // pixels at scale 1 to what an end of what is measured goes to
constexpr double kWheelZoom = 1.15;  // a notch of the wheel
constexpr float kPi = std::numbers::pi_v<float>;

glm::vec2 mouse_pixel(const ShownPicture& picture) { return picture.pixel(ImGui::GetIO().MousePos); }

/// Whether a pixel is at an edge of a box in the picture.
bool on_edge(const DrawList& list, const BoxInstance& box, glm::vec2 pixel, float reach) {
    const std::array<glm::vec3, 8> corners = box_corners(box);
    for (unsigned from = 0; from < 8; ++from) {
        for (const unsigned axis : {1u, 2u, 4u}) {
            if (from & axis) continue;
            const auto a = list.projection.project(corners[from]);
            const auto b = list.projection.project(corners[from | axis]);
            if (!a || !b) continue;
            const glm::vec2 side = *b - *a;
            const float along = glm::dot(pixel - *a, side) / std::max(glm::dot(side, side), 1e-6f);
            if (glm::length(pixel - (*a + std::clamp(along, 0.0f, 1.0f) * side)) <= reach) return true;
        }
    }
    return false;
}

/// What is under a pixel, nearest first. Nodes that are only outlined, as they were tested before, stand around
/// everything else: they come last, and are there where their outline is.
std::vector<Pick> picks(const DrawList& list, glm::vec2 pixel, float reach) {
    std::vector<Pick> hits = pick(list, pixel);
    const auto box_of = [&](const Pick& hit) {
        return std::ranges::find_if(list.boxes, [&](const BoxInstance& b) { return b.pickable && b.id == hit.id; });
    };
    const auto has_faces = [&](const Pick& hit) {
        return std::ranges::any_of(list.boxes,
                                   [&](const BoxInstance& b) { return b.pickable && b.id == hit.id && b.fill.a > 0; });
    };
    const auto stands_out = [&](const Pick& hit) { return hit.id.kind == ObjectId::Kind::disk || has_faces(hit); };
    const auto outlined = std::stable_partition(hits.begin(), hits.end(), stands_out);
    hits.erase(std::remove_if(outlined, hits.end(),
                              [&](const Pick& hit) {
                                  const auto box = box_of(hit);
                                  return box == list.boxes.end() || !on_edge(list, *box, pixel, reach);
                              }),
               hits.end());
    return hits;
}

/// What folds an overlay, and what shows all of a legend.
const char* fold_command(Overlay::Kind kind) {
    switch (kind) {
        case Overlay::Kind::caption:
            return "view.fold_caption";
        case Overlay::Kind::legend:
            return "view.fold_legend";
        case Overlay::Kind::inset:
            break;
    }
    return "view.fold_inset";
}

bool holds(const Rect& rect, glm::vec2 pixel) { return rect.contains({pixel, pixel}); }

/// The overlay under a pixel; null: none.
const Overlay* overlay_at(const DrawList& list, glm::vec2 pixel) {
    const auto at = std::ranges::find_if(list.overlays, [&](const Overlay& o) { return holds(o.rect, pixel); });
    return at == list.overlays.end() ? nullptr : &*at;
}

/// What a click on a pixel of an overlay does.
struct OverlayClick {
    Rect rect;                      ///< where it may be clicked
    const char* command = nullptr;  ///< null: nothing, as there is no room to unfold it
    const char* words = nullptr;
};

std::optional<OverlayClick> overlay_click(const DrawList& list, glm::vec2 pixel) {
    const Overlay* overlay = overlay_at(list, pixel);
    if (!overlay) return std::nullopt;
    if (holds(*overlay->fold, pixel)) {
        if (overlay->no_room) return OverlayClick{*overlay->fold, nullptr, "A larger picture has room for it"};
        return OverlayClick{*overlay->fold, fold_command(overlay->kind), overlay->folded ? "Unfold" : "Fold"};
    }
    if (!overlay->more || !holds(*overlay->more, pixel)) return std::nullopt;
    return OverlayClick{*overlay->more, "view.whole_legend", "Show all rows, or six"};
}

Selection selection_of(const Workspace& workspace, const ObjectId& id) {
    return {id.kind == ObjectId::Kind::box ? Selection::Kind::node : Selection::Kind::sample,
            agent_in_view(workspace.fitted(), workspace.view(), id.agent), id.index};
}

/// Nothing is open: what to do.
void welcome(Ui& ui) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    ImGui::SetCursorPos({ImGui::GetCursorPosX() + 0.5f * room.x - ui.px(150), ImGui::GetCursorPosY() + 0.4f * room.y});
    ImGui::BeginGroup();
    ImGui::PushFont(ui.style.title);
    ImGui::TextUnformatted("Drop a scene or motion clips here");
    ImGui::PopFont();
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::TextUnformatted(openable_files_in_short().c_str());
    ImGui::PopStyleColor();
    ImGui::Dummy({0, ui.px(6)});
    if (ImGui::Button("Open...")) ui.invoke("file.open");
    ui.mark("welcome.open");
    ImGui::SameLine();
    if (ImGui::Button("Open the demo")) ui.invoke("file.demo");
    ui.mark("welcome.demo");
    if (ui.session.files.has_last()) {
        if (ImGui::Button(("Reopen last session: " + ui.session.files.last_title()).c_str())) {
            ui.invoke("file.reopen_last");
        }
        ui.mark("welcome.reopen");
    }
    ImGui::EndGroup();
}

/// The selected agent, where it changes the picture.
std::string standing_out(const Workspace& workspace) {
    if (workspace.view().query || !workspace.selection.on_path() || names_fit(agent_count(workspace))) {
        return "";
    }
    const AgentNames selected = selected_agents(workspace);
    return selected.empty() ? "" : selected.front();
}

}  // namespace

// --- the picture

KeptPaths& Viewport::paths_of(const Key& key) {
    if (!paths_ || paths_->fitted() != key.fitted) paths_.emplace(key.fitted, figures_);
    paths_->adopt_colors(key.colors);
    return *paths_;
}

PictureOptions Viewport::options_of(const Key& key) {
    return {.size = key.size, .scale = key.scale, .selected = key.selected, .controls = true};
}

void Viewport::build(const Key& key, const FollowedChoice* choice) {
    list_.reset();
    why_not_.clear();
    try {
        check(key.size);
        list_ = build_draw_list(paths_of(key), key.view, options_of(key), choice);
    } catch (const std::invalid_argument& error) {
        why_not_ = error.what();
    }
    unpainted_ = Changed::all;
}

Camera Viewport::shown_camera() const { return list_ ? list_->camera : key_->view.camera; }

/// The camera has jumped, by a command or by undo: it flies there instead, if somebody is looking.
void Viewport::take_off(Ui& ui, const Key& next) {
    const bool jumped = key_ && list_ && ui.session.options.attended && drag_ == Drag::none &&
                        key_->fitted == next.fitted && key_->size == next.size &&
                        !(key_->view.camera == next.view.camera);
    if (!jumped) {
        if (!key_ || key_->fitted != next.fitted || key_->size != next.size) flight_.reset();
        return;
    }
    Camera from = list_->camera;
    const PictureFrame there = picture_frame(paths_of(next), next.view, options_of(next));
    // Heights must mean the same all the way.
    if (there.space.time_height != list_->space.time_height || there.moment.has_value() != list_->moment.has_value()) {
        return;
    }
    // Targets may be counted from somebody else now: the way begins where the camera stands.
    const glm::dvec3 seen = list_->space.place(list_->space.from_target(*from.target));
    from.target = there.space.to_target(there.space.point(seen.x, seen.y, seen.z));
    flight_.emplace(from, there.camera, ui.now);
}

Viewport::Key Viewport::wanted(const Ui& ui, PictureSize size, const FollowedChoice* choice) const {
    // Text follows the panels where they are made larger than the picture would have it by itself.
    const double words = ui.style.scale > 1 ? std::max<double>(ui.style.scale, metrics_of(size).scale) : 0;
    SceneView seen = ui.session.views.at(view_place_);
    // The title over it says the same.
    const bool has_title = ui.session.views.count() > 1 && !seen.view.query && !ui.workspace.crowd();
    if (has_title && seen.view.show == Show::space_time) seen.view.caption = false;
    // The region that the drag began in stays in its place.
    if (drags_on_promise()) seen.view.free_region = false;
    const bool counts = seen.view.heat || color_figure(seen.view.color_by);
    return {std::move(seen.fitted),
            std::move(seen.view),
            size,
            words,
            choice ? std::pair(choice->agent, choice->play) : std::pair(-1, -1),
            is_active(ui) || ui.workspace.document().links.selection ? standing_out(ui.workspace) : "",
            counts ? figures_->revision() : 0,
            ui.session.figures.boxes(view_place_)};
}

/// Gives the view a camera that stands.
void Viewport::stand(Ui& ui, Key& next, const FollowedChoice* choice) {
    Camera& camera = next.view.camera;
    const std::optional<PictureSize> before = ui.workspace.picture_size;
    if (is_active(ui) && before != next.size) laid_out_.size = next.size;
    const bool has_other_size = std::exchange(size_, next.size) != next.size;
    if (has_other_size && next.view.follow.empty() && ui.workspace.is_framed(camera)) camera = without_target(camera);
    if (camera.target) {
        if (before && before->height != next.size.height) camera = resized(camera, *before, next.size);
        return;
    }
    try {
        check(next.size);
        laid_out_.framed = framed_in(paths_of(next), next.view, options_of(next), choice);
        camera = standing_as(camera, common_camera(std::span(&*laid_out_.framed, 1), next.size));
        // Targets are measured in it.
        if (next.view.show == Show::space_time) next.view.time_height = laid_out_.framed->space.time_height;
        laid_out_.camera = camera;
    } catch (const std::invalid_argument&) {
        // Nothing can be drawn; build says why.
    }
}

void Viewport::update_picture(Ui& ui, PictureSize size) {
    const FollowedChoice* choice =
        is_active(ui) && ui.workspace.view().candidates ? ui.session.crowds.choice() : nullptr;
    figures_ = ui.session.figures.known();
    Key next = wanted(ui, size, choice);
    if (const auto findings = is_active(ui) && next.view.query ? ui.session.queries.findings() : nullptr)
        paths_of(next).adopt_proof(next.view, {findings, &findings->proof});
    stand(ui, next, choice);
    if (key_ && *key_ == next && !flight_) return;
    if (!(key_ && *key_ == next)) take_off(ui, next);
    key_ = next;
    if (flight_ && !flight_->over(ui.now)) {
        Key on_the_way = next;
        on_the_way.view.camera = flight_->at(ui.now);
        build(on_the_way, choice);
        ui.want_frame_in(0);
        return;
    }
    flight_.reset();
    build(next, choice);
}

/// Lets the camera go to another step's pair, if it is to and the pair is not well seen beside the panels.
void Viewport::follow_test(Ui& ui) {
    const bool restored = std::exchange(restore_count_, ui.session.counts.restores) != ui.session.counts.restores;
    if (!ui.session.views.follow_test || !ui.workspace.recorded()) return test_looked_for_.reset();
    const std::pair test(*ui.workspace.view().query, ui.workspace.step());
    // The camera was restored too.
    if (restored) test_looked_for_ = test;
    if (flight_ || test_looked_for_ == test) return;
    test_looked_for_ = test;
    const std::optional<TestCorners> boxes = corners_of_test(ui.workspace);
    std::vector<Rect> panels;
    for (const Overlay& overlay : list_->overlays) panels.push_back(overlay.rect);
    if (!boxes || is_well_seen(*boxes, *list_, panels)) return;
    laid_out_.to_see = std::pair(*boxes, std::move(panels));
}

void Viewport::frame_together(std::span<Viewport> viewports) {
    std::vector<Framed> all;
    PictureSize size;
    for (const Viewport& one : viewports) {
        if (!one.laid_out_.framed) continue;
        all.push_back(*one.laid_out_.framed);
        size = *one.size_;
    }
    const bool alike = std::ranges::all_of(all, [&](const Framed& one) { return one.space == all.front().space; });
    if (all.size() < 2 || !alike) return;
    const Camera camera = common_camera(all, size);
    for (Viewport& one : viewports) {
        if (!one.laid_out_.framed) continue;
        one.laid_out_.camera = standing_as(one.laid_out_.camera, camera);
        one.key_.reset();
    }
}

bool Viewport::settle(Views& views, Workspace& workspace) {
    const LaidOut laid_out = std::exchange(laid_out_, {});
    if (laid_out.size) views.resize_pictures(*laid_out.size);
    if (laid_out.framed) {
        const bool in_space_time = views.at(view_place_).view.show == Show::space_time;
        views.frame_camera(view_place_, laid_out.camera, in_space_time ? laid_out.framed->space.time_height : 0);
    }
    if (laid_out.to_see) go_along_with(views, workspace, laid_out.to_see->first, laid_out.to_see->second);
    return laid_out.size || laid_out.framed || laid_out.to_see;
}

/// Sets what is pointed out in the list, which is not built anew for that.
void Viewport::update_highlights(const Ui& ui) {
    const std::vector<HighlightLine> shown = std::exchange(list_->highlights, {});
    if (is_active(ui)) {
        const float scale = metrics_of(list_->size, key_->scale).scale;
        const FittedScene& fitted = ui.workspace.fitted();
        if (drag_ == Drag::handle && moved_) {
            if (const auto held = placed_agent_of(fitted, {handle_drag_.agent, -1, 0})) {
                const mobb::PlacedTree before(fitted.tree(*held), handle_drag_.start);
                add_ghost(*list_, before.placed_clip(), scale);
            }
        }
        add_highlights(*list_, ui.session, scale);
    } else if (ui.workspace.document().links.selection) {
        const float scale = metrics_of(list_->size, key_->scale).scale;
        add_highlights_beside(*list_, ui.workspace, ui.session.views.at(view_place_), scale);
    }
    if (list_->highlights != shown) unpainted_ = std::max(unpainted_, Changed::highlights);
}

void Viewport::show(Ui& ui, ImVec2 corner) {
    const Painter::Interaction interaction = !ui.session.options.attended ? Painter::Interaction::unattended
                                             : drag_ == Drag::none        ? Painter::Interaction::idle
                                                                          : Painter::Interaction::dragging;
    const Painter::Shown shown =
        ui.painter.picture(view_place_, std::exchange(unpainted_, Changed::nothing), interaction, ui.now);
    const ImVec2 end{corner.x + static_cast<float>(list_->size.width),
                     corner.y + static_cast<float>(list_->size.height)};
    ImGui::GetWindowDrawList()->AddImage(shown.texture, corner, end, {0, 1}, {1, 0});
    if (shown.coarse_for > kSignAfter && interaction == Painter::Interaction::idle) sign_of_work(ui, end);
}

/// In the lower right corner: an arc that goes round while the fine picture is being painted.
void Viewport::sign_of_work(Ui& ui, ImVec2 end) const {
    const ImVec2 middle{end.x - ui.px(20), end.y - ui.px(20)};
    const float radius = ui.px(6);
    const float begin = static_cast<float>(std::fmod(ui.now, 1.0) * 2 * kPi);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled(middle, ui.px(12), ui.style.panel);
    draw.AddCircle(middle, ui.px(12), ui.style.border);
    draw.PathArcTo(middle, radius, begin, begin + 1.5f * kPi);
    draw.PathStroke(ui.style.accent, 0, ui.px(2));
    ui.marks.add(is_active(ui) ? "viewport.working" : "viewport.working." + std::to_string(view_place_),
                 {{middle.x - radius, middle.y - radius}, {middle.x + radius, middle.y + radius}});
}

void Viewport::draw(Ui& ui, std::size_t place) {
    view_place_ = place;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const PictureSize size{static_cast<int>(room.x), static_cast<int>(room.y)};
    if (ui.workspace.empty()) {
        list_.reset();
        key_.reset();
        welcome(ui);
        return;
    }
    if (size.width < kMinSide || size.height < kMinSide) return;
    update_picture(ui, size);
    if (is_active(ui)) ui.session.views.picture = {size, key_->scale};
    if (!list_) {
        ImGui::TextWrapped("%s", why_not_.c_str());
        return;
    }
    if (is_active(ui)) follow_test(ui);
    const ShownPicture picture{*list_, corner};
    ImGui::InvisibleButton(
        "##picture", room,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
    ui.mark_only(is_active(ui) ? "viewport" : "viewport." + std::to_string(place));
    conflicts_ = is_active(ui) ? conflict_marks(ui, picture) : std::vector<ConflictMark>();
    mouse(ui, picture);
    update_highlights(ui);
    show(ui, corner);
    if (is_active(ui)) decorate(ui, {*list_, corner});
    if (is_active(ui) && ui.focus.opens_menu_of_picture()) {
        over_nothing_ = ui.workspace.selection.kind == Selection::Kind::none;
        open_menu_at(ImGui::GetID("what is here"), place_of_selection(ui.session, {*list_, corner}));
    }
    context_menu(ui, "what is here",
                 [&] { return over_nothing_ ? picture_menu(ui.session) : selection_menu(ui.session); });
}

const RecordedQuery* Viewport::recorded_in(const SceneView& seen) {
    const std::optional<int>& query = seen.view.query;
    recorded_ = query ? seen.fitted->recorded(static_cast<std::size_t>(*query)) : nullptr;
    return recorded_.get();
}

// --- the mouse

namespace {

/// The last event up to the present one that tested a node of the query in view; -1: none.
int event_of_node(const Workspace& workspace, const Selection& node) {
    if (!workspace.recorded() || node.kind != Selection::Kind::node) return -1;
    const auto side = index_in_view(workspace.fitted(), workspace.view(), node.path);
    const mobb::Trace& trace = workspace.recorded()->trace;
    for (int event = side ? workspace.step() : -1; event >= 0; --event) {
        const mobb::Trace::Event test = trace[event];
        if ((*side == 0 ? test.a : test.b) == node.index) return event;
    }
    return -1;
}

}  // namespace

void Viewport::move_camera(Ui& ui, const Camera& camera) {
    // The camera stands in a scene whose time is drawn so high.
    const std::optional<double> height = list_->moment ? std::nullopt : std::optional<double>(list_->space.time_height);
    ui.later([camera, height](Workspace& workspace) {
        workspace.change_view([&](ViewState& view) {
            view.camera = camera;
            if (height) view.time_height = *height;
        });
    });
    flight_.reset();
}

void Viewport::mouse(Ui& ui, const ShownPicture& picture) {
    const glm::vec2 pixel = mouse_pixel(picture);
    const bool over = ImGui::IsItemHovered();
    const bool turned = over && ImGui::GetIO().MouseWheel != 0;
    if (!is_active(ui) && (turned || ImGui::IsItemActivated())) {
        ui.later([place = view_place_](Views& views) { views.activate(place); });
    }
    if (turned) wheel(ui, pixel);
    if (ImGui::IsItemActivated()) press(ui, picture, pixel);
    if (ImGui::IsItemActive()) {
        drag(ui, pixel);
    } else if (drag_ != Drag::none) {
        release(ui, pixel);
    }
    if (drag_ == Drag::none) {
        const auto held = over && list_ && is_active(ui) ? handles(ui, picture) : std::nullopt;
        const bool on_overlay = over && list_ && overlay_at(*list_, pixel);
        lit_ = held ? handle_at(ui, held->places, ImGui::GetIO().MousePos) : Handle::none;
        const bool free = over && list_ && is_active(ui) && lit_ == Handle::none && !on_overlay;
        const ConflictMark* mark = free ? mark_at(ui, conflicts_, ImGui::GetIO().MousePos) : nullptr;
        lit_conflict_ = mark ? mark->conflict : -1;
        if (free && !mark) {
            hover(ui, pixel);
        } else {
            place_.reset();
        }
    }
    const bool picks = over && drag_ == Drag::none && list_ && is_active(ui) && ui.workspace.measuring.picks &&
                       can_measure(ui.workspace) && !overlay_at(*list_, pixel);
    next_end_ = picks ? end_at(ui.workspace, *list_, pixel, ui.px(kEndNear)) : std::nullopt;
    last_ = pixel;
}

/// Takes what is at a pixel as an end of what is measured.
void Viewport::take_end(Ui& ui, glm::vec2 pixel, LineEnd which) const {
    const std::optional<MeasuredEnd> end = end_at(ui.workspace, *list_, pixel, ui.px(kEndNear));
    if (!end) return;
    ui.later([end, which](Workspace& workspace) {
        Measuring& measuring = workspace.measuring;
        (which == LineEnd::from ? measuring.from : measuring.to) = end;
        if (which == LineEnd::to) measuring.picks = false;
    });
}

void Viewport::wheel(Ui& ui, glm::vec2 pixel) {
    const double factor = std::pow(kWheelZoom, ImGui::GetIO().MouseWheel);
    move_camera(ui, zoomed(shown_camera(), factor, pixel, list_->size));
}

std::optional<Viewport::Handles> Viewport::handles(Ui& ui, const ShownPicture& picture) {
    // They stand where a path begins, in space-time.
    if (picture.list.moment || !ui.workspace.selection.on_path() || ui.workspace.crowd()) return std::nullopt;
    // In a grid an agent is not where it is, and who is hidden is not to be seen.
    if (is_in_grid(ui.workspace.scene(), ui.workspace.view()) ||
        are_hidden(ui.workspace, selected_agents(ui.workspace))) {
        return std::nullopt;
    }
    const auto who = placed_agent_of(ui.workspace.fitted(), ui.workspace.selection.path);
    const bool in_view =
        index_in_view(ui.workspace.fitted(), ui.workspace.view(), ui.workspace.selection.path).has_value();
    if (!who || who->agent < 0 || !in_view) return std::nullopt;
    const mobb::PlacedTree placed = ui.workspace.fitted().placed(*who);
    return Handles{*who, handle_places(ui, picture, placed.placed_clip())};
}

std::optional<HandleDrag> Viewport::take_hold(Ui& ui, const ShownPicture& picture, glm::vec2 pixel) const {
    const auto held = handles(ui, picture);
    if (!held) return std::nullopt;
    const auto& [who, places] = *held;
    const Handle handle = handle_at(ui, places, ImGui::GetIO().MousePos);
    if (handle == Handle::none) return std::nullopt;
    return HandleDrag{handle, who.agent, who.placement, places.pivot, places.time, pixel};
}

std::optional<DragPromise> Viewport::promise_of(const Ui& ui, const HandleDrag& drag) {
    const std::shared_ptr<const QueryFindings> findings = ui.session.queries.findings();
    if (!findings || !findings->proof.margins) return std::nullopt;
    const SceneQuery query = ui.workspace.fitted().queries()[static_cast<std::size_t>(*ui.workspace.view().query)];
    const bool of_a = query.a.agent == drag.agent;
    if (of_a == (query.b.agent == drag.agent)) return std::nullopt;
    return DragPromise{findings->proof.certificate, *findings->proof.margins, of_a};
}

void Viewport::press(Ui& ui, const ShownPicture& picture, glm::vec2 pixel) {
    const ImGuiIO& io = ImGui::GetIO();
    pressed_at_ = pixel;
    last_ = pixel;
    moved_ = false;
    drag_ = Drag::orbit;
    asks_ = io.MouseDown[1];
    place_.reset();
    std::optional<OverlayClick> on_overlay;
    if (list_) on_overlay = overlay_click(*list_, pixel);
    const LineEnd end = list_ && is_active(ui) ? line_end_at(ui, picture) : LineEnd::none;
    // Handles stand over the panels.
    const auto hold = list_ && is_active(ui) ? take_hold(ui, picture, pixel) : std::nullopt;
    if (io.MouseDown[1] || io.MouseDown[2] || io.KeyShift) {
        drag_ = Drag::pan;
    } else if (end != LineEnd::none) {
        drag_ = Drag::measured;
        held_end_ = end;
    } else if (on_measured_) {
        drag_ = Drag::none;
    } else if (hold) {
        drag_ = Drag::handle;
        handle_drag_ = *hold;
        promise_ = promise_of(ui, *hold);
        lit_ = hold->handle;
    } else if (on_overlay) {
        drag_ = Drag::none;
        if (on_overlay->command) ui.invoke(on_overlay->command);
    } else if (const ConflictMark* mark = mark_at(ui, conflicts_, io.MousePos); mark && is_active(ui)) {
        drag_ = Drag::none;
        ui.invoke("conflicts.go", std::to_string(mark->conflict));
    }
}

void Viewport::drag(Ui& ui, glm::vec2 pixel) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!moved_ && glm::length(pixel - pressed_at_) <= ui.px(kClickReach)) return;
    const glm::vec2 by = moved_ ? pixel - last_ : pixel - pressed_at_;
    moved_ = true;
    if (by == glm::vec2(0)) return;
    if (drag_ == Drag::orbit) move_camera(ui, orbited(shown_camera(), by, list_->size));
    if (drag_ == Drag::pan) move_camera(ui, panned(shown_camera(), by, list_->size));
    if (drag_ == Drag::measured) take_end(ui, pixel, held_end_);
    if (drag_ != Drag::handle) return;
    const auto placement = dragged(handle_drag_, *list_, pixel, io.KeyCtrl);
    if (!placement) return;
    const Camera camera = shown_camera();
    const double height = list_->space.time_height;
    ui.later([drag = handle_drag_, placement, camera, height](Workspace& workspace) {
        const std::string& name = workspace.scene().agents.at(static_cast<std::size_t>(drag.agent)).name;
        workspace.edit({name_of_placing(name, drag.start, *placement).title, "drag"}, [&](Scene& scene) {
            place_agent(scene, drag.agent, *placement);
            scene.view.camera = camera;
            scene.view.time_height = height;
        });
    });
}

void Viewport::release(Ui& ui, glm::vec2 pixel) {
    // With a button still down it was broken off.
    const bool was_click = !moved_ && drag_ != Drag::pan && drag_ != Drag::measured && !ImGui::IsAnyMouseDown();
    const bool asked = !moved_ && asks_ && !ImGui::IsAnyMouseDown();
    drag_ = Drag::none;
    ui.later(&Workspace::close_group);
    if (was_click && list_ && is_active(ui)) click(ui, pixel);
    if (asked && list_ && is_active(ui)) ask(ui, pixel);
}

/// A right click: a menu of what is there, which is selected; what is selected already stays so, also behind something.
void Viewport::ask(Ui& ui, glm::vec2 pixel) {
    if (overlay_at(*list_, pixel)) return;
    std::optional<Selection> nearest;
    bool stays = false;
    for (const Pick& hit : picks(*list_, pixel, ui.px(kClickReach))) {
        const Selection here = selection_of(ui.workspace, hit.id);
        if (!nearest) nearest = here;
        stays = stays || here == ui.workspace.selection;
    }
    over_nothing_ = !nearest;
    if (nearest && !stays) ui.workspace.select(*nearest);
    ImGui::OpenPopup("what is here");
}

/// Pixels of the window: the middle of what is selected, or of the picture where it is not to be seen.
ImVec2 Viewport::place_of_selection(const Session& session, const ShownPicture& picture) const {
    const glm::vec2 size(picture.list.size.width, picture.list.size.height);
    glm::vec2 at = 0.5f * size;
    const bool is_something = session.workspace.selection.kind != Selection::Kind::none;
    if (const std::optional<Bounds> box =
            is_something ? box_of(session.workspace, session.workspace.selection) : std::nullopt) {
        const glm::dvec3 middle = box->middle();
        const auto pixel = picture.list.projection.project(picture.list.space.point(middle.x, middle.y, middle.z));
        if (pixel) at = glm::clamp(*pixel, glm::vec2(0), size);
    }
    return {picture.corner.x + at.x, picture.corner.y + at.y};
}

void Viewport::hover(Ui& ui, glm::vec2 pixel) {
    const std::vector<Pick> hits = picks(*list_, pixel, ui.px(kClickReach));
    place_.reset();
    if (hits.empty()) return;
    const ObjectId& id = hits.front().id;
    place_ = hits.front().place;
    ui.hovered = selection_of(ui.workspace, id);
    ui.hovered_event = event_of_node(ui.workspace, ui.hovered);
}

/// The first click takes what is in front, one more at the same place what lies behind it; on nothing, nothing.
void Viewport::click(Ui& ui, glm::vec2 pixel) {
    if (overlay_at(*list_, pixel)) return;
    const Measuring& measuring = ui.workspace.measuring;
    if (measuring.picks && can_measure(ui.workspace))
        return take_end(ui, pixel, measuring.from ? LineEnd::to : LineEnd::from);
    const std::vector<Pick> hits = picks(*list_, pixel, ui.px(kClickReach));
    const bool again = glm::length(pixel - clicked_at_) <= ui.px(kClickReach);
    depth_ = again ? depth_ + 1 : 0;
    clicked_at_ = pixel;
    if (hits.empty()) {
        ui.workspace.select({});
        return;
    }
    const ObjectId& id = hits[depth_ % hits.size()].id;
    ui.workspace.select(selection_of(ui.workspace, id));
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) ui.invoke("view.frame");
}

// --- over the picture

void Viewport::tooltip(Ui& ui) const {
    if (!place_ || ui.workspace.hovered.kind == Selection::Kind::none) return;
    const Described what = describe(ui.workspace, ui.workspace.hovered);
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(what.name.c_str());
    ImGui::PushFont(ui.style.mono);
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    for (const auto& [key, value] : what.facts) {
        if (key == "samples" || key == "time" || key == "radius") ImGui::Text("%-8s%s", key.c_str(), value.c_str());
    }
    glm::dvec3 place = *place_;
    if (const auto who = placed_agent_of(ui.workspace.fitted(), ui.workspace.hovered.path)) {
        const mobb::Placement shown = shown_placement(ui.workspace.fitted(), ui.workspace.view(), *who);
        place -= glm::dvec3(shown.translate - who->placement.translate, 0);
    }
    const char* here = list_->moment ? "%-8s%.3f, %.3f m, %.3f m high" : "%-8s%.3f, %.3f m at %.3f s";
    ImGui::Text(here, "here", place.x, place.y, place.z);
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::EndTooltip();
}

void Viewport::handle_tooltip(Ui& ui, const mobb::Placement& placement) const {
    if (drag_ != Drag::handle || !moved_) {
        const char* words = lit_ == Handle::move   ? "Drag to move on the floor. Ctrl: in steps"
                            : lit_ == Handle::turn ? "Drag to turn about the start. Ctrl: in steps"
                                                   : "Drag to begin earlier or later. Ctrl: in steps";
        ImGui::SetTooltip("%s", words);
        return;
    }
    ImGui::BeginTooltip();
    ImGui::PushFont(ui.style.mono);
    if (lit_ == Handle::move) ImGui::Text("x %.2f  y %.2f m", placement.translate.x, placement.translate.y);
    if (lit_ == Handle::turn) ImGui::Text("%.1f\u00B0", static_cast<double>(placement.rotate_deg));
    if (lit_ == Handle::shift) ImGui::Text("starts at %.2f s", placement.start);
    ImGui::PopFont();
    promise_words(ui, placement);
    ImGui::EndTooltip();
}

/// Whether the answer can have changed, and how far it is until then.
void Viewport::promise_words(Ui& ui, const mobb::Placement& now) const {
    if (!drags_on_promise()) return;
    const std::optional<double> room = promise_->room(handle_drag_, now);
    if (!room) return;
    const bool in_time = handle_drag_.handle == Handle::shift;
    if (*room > 0) {
        const std::string still =
            in_time ? "for another " + with_unit(*room, "s") : with_unit(*room, "m") + " to the edge";
        text_line(mark_text(ui.style, EventMark::separated),
                  "The answer cannot change" + (std::isinf(*room) ? std::string() : ": " + still));
    } else {
        text_line(mark_text(ui.style, EventMark::overlap), in_time ? "Farther than is proven: the answer may change"
                                                                   : "Outside the region: the answer may change");
    }
    ui.mark_only(*room > 0 ? "drag.answer_stays" : "drag.answer_may_change");
}

/// Says where overlays can be clicked, and lights what is under the mouse.
void Viewport::decorate_overlays(Ui& ui, const ShownPicture& picture) const {
    const glm::vec2 corner(picture.corner.x, picture.corner.y);
    for (const Overlay& overlay : list_->overlays) {
        const std::string name = "overlay." + std::string(std::string_view(fold_command(overlay.kind)).substr(10));
        ui.marks.add(name, {corner + overlay.fold->min, corner + overlay.fold->max});
        if (overlay.more) ui.marks.add(name + ".more", {corner + overlay.more->min, corner + overlay.more->max});
    }
    if (drag_ != Drag::none || !ImGui::IsItemHovered()) return;
    const auto lit = overlay_click(*list_, mouse_pixel(picture));
    if (!lit) {
        const Overlay* overlay = overlay_at(*list_, mouse_pixel(picture));
        if (overlay && !overlay->whole.empty()) ImGui::SetTooltip("%s", overlay->whole.c_str());
        return;
    }
    if (lit->command) {
        const glm::vec2 min = corner + lit->rect.min;
        const glm::vec2 max = corner + lit->rect.max;
        ImGui::GetWindowDrawList()->AddRect({min.x, min.y}, {max.x, max.y}, ui.style.accent, ui.px(3));
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    }
    const Overlay& overlay = *overlay_at(*list_, mouse_pixel(picture));
    const bool tells = overlay.folded && !overlay.whole.empty();
    ImGui::SetTooltip("%s%s%s", tells ? overlay.whole.c_str() : "", tells ? "\n\n" : "", lit->words);
}

void Viewport::decorate(Ui& ui, const ShownPicture& picture) {
    const ImVec2 end{picture.corner.x + static_cast<float>(list_->size.width),
                     picture.corner.y + static_cast<float>(list_->size.height)};
    ImGui::GetWindowDrawList()->PushClipRect(picture.corner, end, true);
    const auto held = handles(ui, picture);
    if (held && drags_on_promise() && handle_drag_.handle == Handle::move) {
        const std::optional<double> room = promise_->room(handle_drag_, held->who.placement);
        draw_promise(ui, picture, *promise_, handle_drag_, room && *room > 0);
    }
    if (held) {
        draw_handles(ui, picture, held->places, lit_);
        const auto mark = [&](const char* name, const std::optional<ImVec2>& at) {
            if (at) ui.marks.add(name, {{at->x - 4, at->y - 4}, {at->x + 4, at->y + 4}});
        };
        mark("handle.move", held->places.move);
        mark("handle.turn", held->places.turn);
        mark("handle.shift", held->places.shift);
    }
    draw_conflict_marks(ui, conflicts_, lit_conflict_);
    on_measured_ = draw_measuring(ui, picture, next_end_);
    ImGui::GetWindowDrawList()->PopClipRect();
    // The picture has no padding, what is said of it has.
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(9), ui.px(7)});
    const bool is_measured = on_measured_ || next_end_ || drag_ == Drag::measured;
    if (drag_ == Drag::none && line_end_at(ui, picture) != LineEnd::none && ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        ImGui::SetTooltip("Drag to another place");
    } else if (is_measured) {
        // It says what is there itself.
    } else if (held && lit_ != Handle::none) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        handle_tooltip(ui, held->who.placement);
    } else if (lit_conflict_ >= 0) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
        const auto& found = *ui.session.crowds.conflicts();
        ImGui::SetTooltip("%s\nClick shows the two alone",
                          sentence(found[static_cast<std::size_t>(lit_conflict_)]).c_str());
    } else if (drag_ == Drag::none && ImGui::IsItemHovered()) {
        tooltip(ui);
    }
    decorate_overlays(ui, picture);
    ImGui::PopStyleVar();
}

}  // namespace mobbscope::app
