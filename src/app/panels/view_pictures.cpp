#include <app/document/document.h>
#include <app/panels/query_parts.h>
#include <app/ui/command_menu.h>
#include <render/drawlist/color_scale.h>
#include <render/image/image.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kLeastWidth = 96;           // of a picture, pixels at scale 1
constexpr float kAspect = 16.0f / 9;        // its width in heights
constexpr int kFiner = 3;                   // it is drawn so many times as large, for smooth edges
constexpr double kLineScale = 1.5;          // of lines then
constexpr std::size_t kFirstSlot = 10'000;  // of the painter's images

/// The view as a picture shows it that is too small for words.
ViewState without_words(const Workspace& workspace, const ViewState& named) {
    ViewState view = clamped(named, *workspace.document().fitted);
    view.theme = workspace.view().theme;
    view.labels = view.caption = view.legend = view.inset = false;
    return view;
}

}  // namespace

bool ViewPictures::Kept::shows(const Kept& wanted) const {
    return fitted && view == wanted.view && size == wanted.size && counted == wanted.counted &&
           (fitted == wanted.fitted || ask_the_same(*fitted, *wanted.fitted));
}

/// What has been counted of the scene's queries is shown, and nothing is for a picture: that takes long.
void ViewPictures::make(Session& session, std::size_t index, Kept wanted) {
    kept_.resize(std::max(kept_.size(), index + 1));
    try {
        KeptPaths paths(wanted.fitted, session.figures.known());
        const PictureOptions finer{.size = {kFiner * wanted.size.width, kFiner * wanted.size.height},
                                   .scale = kLineScale};
        const DrawList list = build_draw_list(paths, wanted.view, finer);
        wanted.image = std::make_shared<const Image>(shrunk(session.picture_maker->draw_coarse(list, 1), kFiner));
    } catch (const std::exception&) {
        // Its place stays empty: going there says why.
    }
    kept_[index] = std::move(wanted);
}

void ViewPictures::one(Ui& ui, std::size_t index, ImVec2 size) {
    const NamedView& named = ui.workspace.scene().debug.views[index];
    const std::string mark = "named_view." + std::to_string(index);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end{corner.x + size.x, corner.y + size.y};
    const float line = ImGui::GetTextLineHeight();
    ImGui::BeginGroup();
    if (ImGui::InvisibleButton(mark.c_str(), {size.x, size.y + line + ui.px(2)})) ui.invoke("view.go", named.name);
    ui.mark(mark, OwnKeys::none, named.name);
    const bool hovered = ImGui::IsItemHovered();
    if (hovered) ImGui::SetTooltip("%s\nClick to see the scene so", named.name.c_str());
    context_menu(ui, [&, name = named.name]() -> std::vector<MenuEntry> {
        // That of the menu is the present one, which is renamed.
        if (ui.workspace.named_view != name) ui.later([name](Workspace& workspace) { workspace.named_view = name; });
        return {{"view.go", name, "Go there"},
                {"view.save_as", name, "Make it as the scene is seen now"},
                {"view.rename"},
                {"view.remove", name, "Remove it"}};
    });
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(corner, end, ui.style.window, ui.px(3));
    const PictureSize drawn{static_cast<int>(size.x), static_cast<int>(size.y)};
    Kept wanted{
        .fitted = ui.workspace.document().fitted, .view = without_words(ui.workspace, named.view), .size = drawn};
    if (color_figure(wanted.view.color_by) || wanted.view.heat) wanted.counted = ui.session.figures.known()->revision();
    const Kept kept = index < kept_.size() ? kept_[index] : Kept{};
    if (!kept.shows(wanted) && makes_one_ && ImGui::IsRectVisible(corner, end)) {
        makes_one_ = false;
        ui.later([this, index, wanted](Session& session) { make(session, index, wanted); });
    }
    // Until then it is as it was before the scene was edited.
    if (kept.image && kept.view == wanted.view) {
        if (const ImTextureID texture = ui.painter.image(kFirstSlot + index, kept.image, true))
            draw.AddImage(texture, corner, end);
    }
    const bool present = ui.workspace.named_view == named.name;
    draw.AddRect(corner, end, present ? ui.style.accent : hovered ? ui.style.quiet : ui.style.border, ui.px(3));
    draw.AddText({corner.x, end.y + ui.px(2)}, present || hovered ? ui.style.text : ui.style.quiet,
                 fitted_name(named.name, size.x).c_str());
    ImGui::EndGroup();
}

void ViewPictures::section(Ui& ui) {
    const std::size_t count = ui.workspace.empty() ? 0 : ui.workspace.scene().debug.views.size();
    kept_.resize(std::min(kept_.size(), count));
    if (count == 0 || !app::section(ui, "VIEWS", std::to_string(count))) return;
    const float gap = ui.px(8);
    const float room = ImGui::GetContentRegionAvail().x;
    const auto columns = std::max<std::size_t>(1, static_cast<std::size_t>((room + gap) / (ui.px(kLeastWidth) + gap)));
    const float width =
        std::max(1.0f, std::floor((room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns)));
    const ImVec2 size{width, std::max(1.0f, std::floor(width / kAspect))};
    // Whoever drags does not wait for them.
    makes_one_ = !ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ui.workspace.history.has_open_group();
    for (std::size_t i = 0; i < count; ++i) {
        if (i % columns > 0) ImGui::SameLine(0, gap);
        one(ui, i, size);
    }
    command_button(ui, "save this view", "view.save_as", "view.save_as");
}

}  // namespace mobbscope::app
