#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <review/review_panels.h>
#include <review/review_screen.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr double kWheelStep = 1.25;
constexpr double kSharp = 2;        // from this zoom on each pixel is a square
constexpr double kGrid = 8;         // ... and squares have borders
constexpr float kDividerGrip = 10;  // to each side of the slider's line, pixels at scale 1

/// One place where pictures are seen; `second` right of the slider's line.
struct PictureView {
    std::string title;
    const std::shared_ptr<const Image>* picture;
    const char* why_none;
    const std::shared_ptr<const Image>* second = nullptr;
    std::string second_title{};
    ImVec2 min{}, max{};

    ImVec2 middle() const { return {std::floor((min.x + max.x) / 2), std::floor((min.y + max.y) / 2)}; }
    bool holds(ImVec2 p) const { return p.x >= min.x && p.x < max.x && p.y >= min.y && p.y < max.y; }
};

/// How the pictures lie in a view.
struct PicturePlace {
    glm::dvec2 size;    ///< of the pictures, pixels
    glm::dvec2 corner;  ///< on the window
    double scale = 1;

    ImVec2 at(double x, double y) const {
        return {static_cast<float>(corner.x + scale * x), static_cast<float>(corner.y + scale * y)};
    }
    glm::dvec2 pixel(ImVec2 p) const { return (glm::dvec2(p.x, p.y) - corner) / scale; }
};

void mode_buttons(Ui& ui, const Review& review) {
    for (std::size_t i = 0; i < kReviewModes.size(); ++i) {
        const ReviewModeWords& words = kReviewModes[i];
        const std::string id = "review." + std::string(words.name);
        const std::string title(words.title);
        if (i > 0) flow(button_width(title.c_str()));
        const bool on = review.look.mode == static_cast<ReviewMode>(i);
        if (on) {
            ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
            ImGui::PushStyleColor(ImGuiCol_Border, ImGui::ColorConvertU32ToFloat4(ui.style.accent));
        }
        command_button(ui, title.c_str(), id.c_str(), "mode." + std::string(words.name));
        if (on) ImGui::PopStyleColor(2);
    }
    const std::string zoom = review.look.zoom > 0
                                 ? formatted("%.*f %%", review.look.scale() < 0.1 ? 1 : 0, 100 * review.look.scale())
                                 : formatted("fits, %.0f %%", 100 * review.look.scale());
    flow(button_width("Whole") + button_width("1:1") + ui.px(8) + ImGui::CalcTextSize("fits, 100 %").x);
    command_button(ui, "Whole", "review.fit", "review.fit");
    ImGui::SameLine();
    command_button(ui, "1:1", "review.actual_size", "review.actual_size");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    text_line(ui.style.quiet, zoom);
    ui.mark("review.zoom");
}

const char* why_no_golden(const ReviewCase& one) {
    return one.drawn() || one.state == ReviewCase::State::waiting ? "There is no golden yet" : "There is no golden";
}

const char* why_no_actual(const ReviewCase& one) {
    if (one.state == ReviewCase::State::waiting) return "It is being drawn";
    if (!one.drawn()) return "It is not drawn yet: R draws it";
    return one.outcome() == picture_tests::CaseOutcome::skipped ? "It was skipped" : "There is no picture";
}

const char* why_no_difference(const ReviewCase& one, const ReviewPictures& pictures) {
    if (pictures.golden && pictures.actual) return "Pictures of different sizes cannot be compared by pixels";
    return pictures.actual ? why_no_golden(one) : why_no_actual(one);
}

std::vector<PictureView> views_of(Ui& ui, const Review& review, const ReviewPictures& pictures) {
    const ReviewCase& one = review.shown();
    const PictureView golden{"golden", &pictures.golden, why_no_golden(one)};
    const PictureView actual{"actual", &pictures.actual, why_no_actual(one)};
    const PictureView difference{"difference", &pictures.difference, why_no_difference(one, pictures)};
    switch (review.look.mode) {
        case ReviewMode::side_by_side:
            return {golden, actual, difference};
        case ReviewMode::golden:
            return {golden};
        case ReviewMode::actual:
            return {actual};
        case ReviewMode::difference:
            return {difference};
        case ReviewMode::slider: {
            PictureView both = golden;
            both.second = &pictures.actual;
            both.second_title = "actual";
            return {both};
        }
        case ReviewMode::blink:
            break;
    }
    const double seconds = review.look.blink_seconds;
    const double turns = ui.now / seconds;
    ui.want_frame_in(std::max((std::floor(turns) + 1 - turns) * seconds, 0.001));
    PictureView now = std::fmod(std::floor(turns), 2) < 1 ? golden : actual;
    now.title += ", every " + format_double(seconds) + " s";
    return {now};
}

/// The larger of both, where they differ; none: nothing is there.
glm::dvec2 picture_size(const ReviewPictures& pictures) {
    glm::dvec2 size(0);
    for (const auto* picture : {&pictures.golden, &pictures.actual}) {
        if (*picture) size = glm::max(size, glm::dvec2((*picture)->width, (*picture)->height));
    }
    return size;
}

/// The scale at which pictures of this size fill a room; small ones are only made whole times as large.
double fitting_scale(glm::dvec2 size, ImVec2 room) {
    const double fits = std::min(std::max(room.x, 1.0f) / size.x, std::max(room.y, 1.0f) / size.y);
    return fits >= 1 ? std::floor(fits) : fits;
}

float title_height(const Ui& ui) { return ui.style.caption->FontSize + ui.px(6); }

/// Side by side or one below the other, whichever shows more.
void lay_out(std::vector<PictureView>& views, ImVec2 min, ImVec2 max, glm::dvec2 size, float gap, float title) {
    const float count = static_cast<float>(views.size());
    const ImVec2 room{max.x - min.x, max.y - min.y};
    const ImVec2 beside{std::floor((room.x - gap * (count - 1)) / count), room.y};
    const ImVec2 below{room.x, std::floor((room.y - gap * (count - 1)) / count)};
    const bool is_beside =
        fitting_scale(size, {beside.x, beside.y - title}) >= fitting_scale(size, {below.x, below.y - title});
    const ImVec2 each = is_beside ? beside : below;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const float at = static_cast<float>(i);
        views[i].min =
            is_beside ? ImVec2(min.x + at * (each.x + gap), min.y) : ImVec2(min.x, min.y + at * (each.y + gap));
        views[i].max = {views[i].min.x + each.x, views[i].min.y + each.y};
        views[i].min.y = std::min(views[i].min.y + title, views[i].max.y - 1);
    }
}

/// All of it stands in the middle.
PicturePlace place_in(const PictureView& view, const ReviewLook& look, glm::dvec2 size) {
    PicturePlace place{size, {}, look.scale()};
    const glm::dvec2 middle = look.zoom > 0 ? look.middle : glm::dvec2(0.5);
    const ImVec2 at = view.middle();
    place.corner = glm::floor(glm::dvec2(at.x, at.y) - middle * size * place.scale + 0.5);
    return place;
}

/// Above a picture, so that it covers nothing.
void title_over(Ui& ui, const PictureView& view) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float y = view.min.y - title_height(ui) + ui.px(2);
    draw_text(draw, *ui.style.caption, {view.min.x, y}, ui.style.quiet, view.title);
    if (view.second_title.empty()) return;
    const float width = text_size(*ui.style.caption, view.second_title).x;
    draw_text(draw, *ui.style.caption, {view.max.x - width, y}, ui.style.quiet, view.second_title);
}

void draw_image(Ui& ui, const PicturePlace& place, std::size_t slot, const std::shared_ptr<const Image>& image) {
    const bool smooth = place.scale != 1 && place.scale < kSharp;
    const ImTextureID texture = ui.painter.image(slot, image, smooth);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (!texture) {
        draw.AddText(place.at(0, 0), ui.style.text, "The picture is larger than OpenGL can show here");
        return;
    }
    draw.AddImage(texture, place.at(0, 0), place.at(image->width, image->height));
}

/// Lines between pixels that are large enough to be looked at one by one.
void draw_grid(Ui& ui, const PictureView& view, const PicturePlace& place) {
    if (place.scale < kGrid) return;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const glm::ivec2 first(glm::max(glm::floor(place.pixel(view.min)), 0.0));
    const glm::ivec2 last(glm::min(glm::ceil(place.pixel(view.max)), place.size));
    const ImU32 color = ui.style.palette.dark ? IM_COL32(255, 255, 255, 28) : IM_COL32(0, 0, 0, 36);
    for (int x = first.x; x <= last.x; ++x) draw.AddLine(place.at(x, first.y), place.at(x, last.y), color);
    for (int y = first.y; y <= last.y; ++y) draw.AddLine(place.at(first.x, y), place.at(last.x, y), color);
}

/// Where the slider's line may be: along what is seen of the picture.
ChartAxis divider_axis(const PictureView& view, const PicturePlace& place) {
    const float first = std::clamp(place.at(0, 0).x, view.min.x, view.max.x - 1);
    return {0, 1, first, std::clamp(place.at(place.size.x, 0).x, first + 1, view.max.x)};
}

float divider_pixel(const ReviewLook& look, const PictureView& view, const PicturePlace& place) {
    return std::round(divider_axis(view, place).pixel(look.divider));
}

void draw_divider(Ui& ui, const PictureView& view, float x) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled({x - ui.px(1), view.min.y}, {x + ui.px(1), view.max.y}, ui.style.accent);
    const ImVec2 knob{x, view.middle().y};
    draw.AddCircleFilled(knob, ui.px(11), ui.style.raised);
    draw.AddCircle(knob, ui.px(11), ui.style.accent, 0, ui.px(1.5f));
    for (const float side : {-1.0f, 1.0f}) {
        draw.AddTriangleFilled({knob.x + side * ui.px(7), knob.y}, {knob.x + side * ui.px(3), knob.y - ui.px(4)},
                               {knob.x + side * ui.px(3), knob.y + ui.px(4)}, ui.style.text);
    }
    ui.marks.add("review.divider", {{x - ui.px(kDividerGrip), view.min.y}, {x + ui.px(kDividerGrip), view.max.y}});
}

void draw_view(Ui& ui, const ReviewLook& look, const PictureView& view, const PicturePlace& place, std::size_t slot,
               const std::optional<glm::ivec2>& pointed) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(view.min, view.max, ui.style.window);
    draw.PushClipRect(view.min, view.max, true);
    const float line = view.second ? divider_pixel(look, view, place) : view.max.x;
    if (*view.picture) {
        draw.PushClipRect(view.min, {line, view.max.y}, true);
        draw_image(ui, place, slot, *view.picture);
        draw.PopClipRect();
    }
    if (view.second && *view.second) {
        draw.PushClipRect({line, view.min.y}, view.max, true);
        draw_image(ui, place, slot + 1, *view.second);
        draw.PopClipRect();
    }
    draw_grid(ui, view, place);
    if (pointed && place.scale >= kSharp) {
        draw.AddRect(place.at(pointed->x, pointed->y), place.at(pointed->x + 1, pointed->y + 1), ui.style.accent, 0, 0,
                     ui.px(1.5f));
    }
    if (!*view.picture && !view.second) {
        const ImVec2 size = ImGui::CalcTextSize(view.why_none);
        draw.AddText({view.middle().x - size.x / 2, view.middle().y - size.y / 2}, ui.style.quiet, view.why_none);
    }
    if (view.second) draw_divider(ui, view, line);
    draw.PopClipRect();
    draw.AddRect(view.min, view.max, ui.style.border);
    title_over(ui, view);
}

/// Changes how the pictures are looked at once the frame is drawn.
template <class Change>
void change_look(Ui& ui, const Change& change) {
    ui.later([change](ReviewScreen& screen) { change(screen.review()->look); });
}

/// The pixel under the mouse stays where it is.
void zoom_at_mouse(Ui& ui, const PictureView& view, const PicturePlace& place, float notches) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const glm::dvec2 pixel = place.pixel(mouse);
    const double wanted = place.scale * std::pow(kWheelStep, static_cast<double>(notches));
    const double scale = std::clamp(wanted, kLeastReviewZoom, kMostReviewZoom);
    const ImVec2 at = view.middle();
    const glm::dvec2 middle =
        (glm::dvec2(at.x, at.y) - glm::dvec2(mouse.x, mouse.y) + pixel * scale) / (place.size * scale);
    change_look(ui, [scale, middle](ReviewLook& look) {
        look.zoom = scale;
        look.middle = glm::clamp(middle, 0.0, 1.0);
    });
}

void drag_pictures(Ui& ui, const ReviewLook& look, const PictureView& view, const PicturePlace& place) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    bool& moves_divider = *ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("moves divider"), false);
    if (ImGui::IsItemActivated()) {
        const bool near = view.second && std::abs(mouse.x - divider_pixel(look, view, place)) <= ui.px(kDividerGrip);
        // Where all is seen there is nothing else to drag.
        moves_divider = near || (view.second && look.zoom == 0);
    }
    if (moves_divider) {
        const double share = std::clamp(divider_axis(view, place).value(mouse.x), 0.0, 1.0);
        return change_look(ui, [share](ReviewLook& changed) { changed.divider = share; });
    }
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (look.zoom == 0 || (moved.x == 0 && moved.y == 0)) return;
    const glm::dvec2 by = glm::dvec2(moved.x, moved.y) / (place.size * place.scale);
    change_look(ui, [by](ReviewLook& changed) { changed.middle = glm::clamp(changed.middle - by, 0.0, 1.0); });
}

// --- of a case without a picture

/// A cell that a line has no room for is told whole by its tooltip.
void held_cell(const Ui& ui, ImU32 color, const std::string& text) {
    ImGui::TableNextColumn();
    fitted_line(ui, color, text.empty() ? "-" : text, ImGui::GetContentRegionAvail().x);
}

/// Golden and actual numbers side by side; what changed stands out.
void held_table(Ui& ui, const std::string& id, const std::vector<HeldRow>& rows) {
    constexpr std::size_t kMostRows = 60;
    const std::size_t shown = std::min(rows.size(), kMostRows);
    for (std::size_t first = 0; first < shown;) {
        std::size_t end = first;
        while (end < shown && rows[end].of == rows[first].of) ++end;
        ImGui::Dummy({0, ui.px(4)});
        text_line(ui.style.text, rows[first].of);
        ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {ui.px(4), ui.px(1)});
        const std::string name = id + std::to_string(first);
        if (ImGui::BeginTable(name.c_str(), 4, ImGuiTableFlags_SizingStretchProp)) {
            for (const float share : {0.28f, 0.24f, 0.24f, 0.24f})
                ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, share);
            for (const char* head : {"", "golden", "actual", ""}) {
                ImGui::TableNextColumn();
                text_line(ui.style.quiet, head, ui.style.caption);
            }
            for (; first < end; ++first) {
                const HeldRow& row = rows[first];
                ImGui::TableNextRow();
                held_cell(ui, row.changed ? ui.style.text : ui.style.quiet, row.what);
                held_cell(ui, row.changed ? ui.style.text : ui.style.quiet, row.golden);
                held_cell(ui, row.changed ? ui.style.warning : ui.style.quiet, row.actual);
                ImGui::TableNextColumn();
                if (!row.ratio.empty()) text_line(ui.style.quiet, row.ratio);
            }
            ImGui::EndTable();
        }
        ImGui::PopStyleVar();
        first = end;
    }
    if (rows.size() > shown)
        text_line(ui.style.quiet, "and " + counted(rows.size() - shown, "number", "numbers") + " more");
}

/// What is said of a golden, and its numbers beside those that are there now.
void held_finding(Ui& ui, const ReviewPictures& pictures, const picture_tests::Finding& finding) {
    const std::string title = finding.golden.empty() ? "scene" : finding.golden.filename().string();
    heading(ui, title.c_str());
    ui.mark("held." + title);
    if (finding.words.empty()) words(ui.style.text, cleaned(finding.message) + '.');
    for (const std::string& line : finding.words) words(ui.style.text, cleaned(line));
    const auto numbers = pictures.numbers.find(finding.golden);
    if (numbers == pictures.numbers.end() || numbers->second.empty()) return;
    held_table(ui, title, numbers->second);
    ui.mark_only("held." + title + ".table");
}

/// In the place of pictures.
void held_words(Ui& ui, const ReviewCase& one, const ReviewPictures& pictures) {
    ImGui::BeginChild("held", {0, 0}, false, ImGuiWindowFlags_NoBackground);
    const std::vector<picture_tests::Finding> findings = one.accepted ? unmended(one.result) : one.result.findings;
    if (findings.empty()) {
        words(ui.style.quiet, one.outcome() == picture_tests::CaseOutcome::passed
                                  ? "The case holds no picture. All that it holds agrees with its goldens."
                              : one.accepted ? "The picture was not drawn: " + cleaned(one.result.not_drawn)
                                             : cleaned(one.result.message));
    }
    for (const picture_tests::Finding& finding : findings) held_finding(ui, pictures, finding);
    ImGui::EndChild();
}

}  // namespace

std::optional<glm::ivec2> review_pictures(Ui& ui, Review& review) {
    const ReviewPictures& pictures = review.pictures();
    if (review.shown().drawn() && draws_nothing(review.shown().result)) {
        held_words(ui, review.shown(), pictures);
        return std::nullopt;
    }
    mode_buttons(ui, review);
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 max{min.x + std::max(room.x, 8.0f), min.y + std::max(room.y, 8.0f)};
    ImGui::InvisibleButton("##pictures", {max.x - min.x, max.y - min.y},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle);
    ui.mark("review.pictures");
    const bool hovered = ImGui::IsItemHovered();
    const bool active = ImGui::IsItemActive();
    const glm::dvec2 size = picture_size(pictures);
    if (!pictures.why_not.empty()) {
        ImGui::SetCursorScreenPos({min.x + ui.px(12), min.y + ui.px(12)});
        words(ui.style.error, pictures.why_not);
        return std::nullopt;
    }
    std::vector<PictureView> views = views_of(ui, review, pictures);
    lay_out(views, min, max, glm::max(size, 1.0), ui.px(6), title_height(ui));
    const PictureView& first = views.front();
    review.look.fits =
        std::clamp(fitting_scale(glm::max(size, 1.0), {first.max.x - first.min.x, first.max.y - first.min.y}),
                   kLeastReviewZoom, kMostReviewZoom);

    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::optional<glm::ivec2> pointed;
    for (const PictureView& view : views) {
        if (!view.holds(mouse) || size.x == 0) continue;
        const PicturePlace place = place_in(view, review.look, size);
        const glm::dvec2 pixel = glm::floor(place.pixel(mouse));
        if (hovered && glm::all(glm::greaterThanEqual(pixel, glm::dvec2(0))) && glm::all(glm::lessThan(pixel, size))) {
            pointed = glm::ivec2(pixel);
        }
        const float notches = ImGui::GetIO().MouseWheel;
        if (hovered && notches != 0) zoom_at_mouse(ui, view, place, notches);
        if (view.second && hovered &&
            std::abs(mouse.x - divider_pixel(review.look, view, place)) <= ui.px(kDividerGrip)) {
            ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        }
    }
    if (active && size.x > 0) drag_pictures(ui, review.look, first, place_in(first, review.look, size));
    for (std::size_t i = 0; i < views.size(); ++i) {
        ui.marks.add("picture." + std::to_string(i),
                     {{views[i].min.x, views[i].min.y}, {views[i].max.x, views[i].max.y}});
        draw_view(ui, review.look, views[i], place_in(views[i], review.look, glm::max(size, 1.0)), 2 * i, pointed);
    }
    return pointed;
}

}  // namespace mobbscope::app
