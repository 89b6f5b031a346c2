#include <app/commands/command.h>
#include <app/input/input_queue.h>
#include <app/panels/panels.h>
#include <app/window/shell.h>
#include <app/window/window_gl.h>
#include <base/file.h>
#include <render/gl/renderer.h>
#include <render/image/png.h>
#include <scene/load_files.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
/// Dear ImGui lays out with sizes of the frame before, so what happens is seen whole after so many frames.
constexpr int kFramesToSettle = 3;
/// A field that has not taken the keys by then never will.
constexpr int kFramesToFocus = 8;
/// Half a period of a text field's blinking cursor.
constexpr double kBlink = 0.4;
/// Playing goes on where it was, however long the machine was busy.
constexpr double kLongestStep = 0.25;

struct ImGuiContextDeleter {
    void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

std::unique_ptr<ImGuiContext, ImGuiContextDeleter> make_imgui() {
    IMGUI_CHECKVERSION();
    std::unique_ptr<ImGuiContext, ImGuiContextDeleter> context(ImGui::CreateContext());
    ImGui::SetCurrentContext(context.get());
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.BackendPlatformName = "mobbscope";
    io.BackendRendererName = "mobbscope";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    InputQueue::map_keys(io);
    return context;
}

/// What a text field does with a chord by itself.
bool edits_text(const Chord& chord) {
    const bool function_key = chord.key >= Key::f1 && chord.key <= Key::f12;
    if (!chord.ctrl) return !function_key;
    constexpr std::array kEditing{Key::a,     Key::c,    Key::v,   Key::x,         Key::y,   Key::z,    Key::left,
                                  Key::right, Key::home, Key::end, Key::backspace, Key::del, Key::enter};
    return std::ranges::find(kEditing, chord.key) != kEditing.end();
}

/// Clips that are dropped join what a person has opened, but not the demo.
bool opened_by_person(const Session& session) {
    if (session.empty()) return false;
    if (session.file() || session.modified()) return true;
    try {
        return session.scene().file != demo_scene_file();
    } catch (const MachineError&) {
        return true;
    }
}

/// Has textures of its own: the renderer's holds what else it draws soon.
class TexturePainter final : public Painter {
  public:
    explicit TexturePainter(Renderer& renderer) : renderer_(renderer) {}

    ImTextureID picture(std::size_t place, Changed changed, bool still) override {
        while (pictures_.size() <= place) pictures_.emplace_back();
        Picture& asked = pictures_[place];
        asked.changed = std::max(asked.changed, changed);
        asked.samples = still || !renderer_.is_software() ? kPictureSamples : 1;
        return texture_id(asked.copy.texture());
    }

    ImTextureID image(std::size_t slot, const std::shared_ptr<const Image>& image, bool smooth) override {
        while (images_.size() <= slot) images_.emplace_back();
        return images_[slot].take(image, smooth) ? texture_id(images_[slot].texture()) : ImTextureID{};
    }

    /// Paints what has changed since the last time.
    void paint_changes(std::size_t place, const DrawList& list) {
        if (place >= pictures_.size()) return;
        Picture& asked = pictures_[place];
        const Changed changed = std::exchange(asked.changed, Changed::nothing);
        if (changed == Changed::nothing) return;
        const bool all = changed == Changed::all;
        asked.copy.take(all ? renderer_.paint(list, asked.samples) : renderer_.paint_highlights(list, asked.samples),
                        list.size);
    }

  private:
    struct Picture {
        PictureCopy copy;
        Changed changed = Changed::nothing;
        int samples = kPictureSamples;
    };
    Renderer& renderer_;
    std::deque<Picture> pictures_;     ///< by place
    std::deque<ImageTexture> images_;  ///< by slot
};

}  // namespace

struct Shell::State {
    State(std::unique_ptr<GlContext> context, Session& of, double wanted_scale)
        : session(of),
          imgui(make_imgui()),
          renderer(std::move(context)),
          drawn(std::make_unique<Drawn>(renderer)),
          own_scale(wanted_scale) {
        ImGuiIO& io = ImGui::GetIO();
        io.UserData = this;
        io.ClipboardUserData = this;
        io.SetClipboardTextFn = [](void* self, const char* text) { static_cast<State*>(self)->copy(text); };
        io.GetClipboardTextFn = [](void* self) { return static_cast<State*>(self)->paste(); };
    }
    ~State() {
        ImGui::SetCurrentContext(imgui.get());
        // The names would be deleted in whichever context is current; see Renderer.
        if (!renderer.context().try_make_current()) static_cast<void>(drawn.release());
    }

    /// What is made in the context.
    struct Drawn {
        explicit Drawn(Renderer& renderer) : painter(renderer), ui(renderer.context()) {}
        TexturePainter painter;
        UiPass ui;
        std::optional<WindowTarget> target;
    };

    void copy(const char* text) {
        clipboard = text;
        if (session.hooks.set_clipboard) session.hooks.set_clipboard(clipboard);
    }
    const char* paste() {
        if (session.hooks.clipboard) clipboard = session.hooks.clipboard();
        return clipboard.c_str();
    }

    /// Runs the command of a chord, unless the keys are somebody else's; whether it did.
    bool press(const Chord& chord, bool repeated) {
        const Command* command = command_for(session, chord);
        if (!command || (repeated && !command->repeats) || session.dialog != Dialog::none) {
            return false;
        }
        // A drag ends on what it began on.
        if (input.any_button_down()) return false;
        if (ImGui::GetIO().WantTextInput && edits_text(chord)) return false;
        const bool busy = ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
        if (busy && !chord.ctrl && edits_text(chord)) return false;
        // A key that has nothing to do now says nothing.
        if (command->enabled(session)) invoke(session, command->id);
        // No panel is being drawn: what comes next from the keyboard meets what this one has done.
        session.run_queue();
        return true;
    }

    void drop(const Drop& dropped) {
        if (dropped.paths.empty()) return;
        const bool clips = std::none_of(dropped.paths.begin(), dropped.paths.end(),
                                        [](const auto& path) { return lower_extension(path) == ".json"; });
        session.enqueue([this, clips, dropped] {
            clips&& opened_by_person(session) ? session.add(dropped.paths) : session.open(dropped.paths);
        });
        session.run_queue();
    }

    /// A dialog has opened whose field does not have the keys yet: what is typed meanwhile is meant for it.
    bool waits_for_field() {
        const Dialog open = session.dialog;
        const bool has_field = open == Dialog::open || open == Dialog::add || open == Dialog::save_as ||
                               open == Dialog::export_picture || open == Dialog::review || open == Dialog::palette;
        if (!has_field || !session.input.fresh || ImGui::GetIO().WantTextInput)
            waited = 0;
        else if (++waited <= kFramesToFocus)
            return true;
        return false;
    }

    void feed() {
        if (!input.empty()) settling = kFramesToSettle;
        if (waits_for_field()) return;
        input.feed(ImGui::GetIO(),
                   {[this](const Chord& chord, bool repeated) { return press(chord, repeated); },
                    [this](const Drop& dropped) { drop(dropped); }, [this] { session.request_close(); }});
    }

    void follow_time(double now) {
        const double passed = time ? std::max(now - *time, 0.0) : 0.0;
        time = now;
        // Dear ImGui wants time to pass.
        ImGui::GetIO().DeltaTime = std::max(static_cast<float>(passed), 1e-5f);
        if (std::exchange(was_playing, session.playing()) && session.playing()) {
            session.advance(std::min(passed, kLongestStep));
        }
    }

    double scale() const {
        return std::clamp(session.settings.ui_scale > 0 ? session.settings.ui_scale : own_scale, kLeastUiScale,
                          kMostUiScale);
    }

    void follow_look() {
        const auto wanted = std::pair(session.view().theme, static_cast<float>(scale()));
        if (look_made_for == wanted) return;
        style = make_style(wanted.first, wanted.second);
        drawn->ui.upload(*ImGui::GetIO().Fonts);
        look_made_for = wanted;
        settling = kFramesToSettle;
    }

    double lay_out(double now) {
        marks.clear();
        Ui ui{session, style, marks, drawn->painter, now, kNever};
        ImGui::NewFrame();
        viewports.resize(session.view_count());
        window_layout(ui, viewports, pictures);
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantTextInput) ui.want_frame_in(kBlink);
        ImGui::Render();
        return ui.next_frame;
    }

    /// The last frame, once somebody looks at it.
    void draw() {
        ImGui::SetCurrentContext(imgui.get());
        renderer.context().make_current();
        if (!std::exchange(undrawn, false)) return;
        ++frames_drawn;
        for (std::size_t place = 0; place < viewports.size(); ++place) {
            if (const DrawList* picture = viewports[place].shown()) drawn->painter.paint_changes(place, *picture);
        }
        if (!drawn->target || drawn->target->size() != size) drawn->target.emplace(size);
        const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(style.window);
        drawn->target->clear({ground.x, ground.y, ground.z, 1});
        drawn->ui.draw(*ImGui::GetDrawData(), size);
        renderer.context().check("drawing the window");
    }

    Session& session;
    std::unique_ptr<ImGuiContext, ImGuiContextDeleter> imgui;
    Renderer renderer;
    std::unique_ptr<Drawn> drawn;
    std::vector<Viewport> viewports;  ///< by place
    QueryPictures pictures;
    PictureSize size;  ///< of the last frame
    bool undrawn = false;
    int frames_drawn = 0;
    InputQueue input;
    Marks marks;
    Style style{};
    std::optional<std::pair<Theme, float>> look_made_for;
    double own_scale;
    std::optional<double> time;
    std::string clipboard;
    int settling = kFramesToSettle;
    int waited = 0;  ///< frames for a field
    bool settled = false;
    bool was_playing = false;
    ImGuiMouseCursor cursor = ImGuiMouseCursor_Arrow;
};

Shell::Shell(std::unique_ptr<GlContext> context, Session& session, double scale)
    : state_(std::make_unique<State>(std::move(context), session, scale)) {
    session.hooks.export_picture = [this](const std::filesystem::path& file) { write_png(file, viewport_picture()); };
    session.hooks.ui_scale = [this] { return state_->scale(); };
}

Shell::~Shell() {
    Hooks& hooks = state_->session.hooks;
    hooks.export_picture = nullptr;
    hooks.ui_scale = nullptr;
    hooks.viewport_size = nullptr;
    hooks.viewport_scale = nullptr;
}

void Shell::feed(const InputEvent& event) { state_->input.push(event); }

double Shell::frame(PictureSize size, double now) {
    State& s = *state_;
    ImGui::SetCurrentContext(s.imgui.get());
    s.renderer.context().make_current();
    ImGuiIO& io = ImGui::GetIO();
    if (io.DisplaySize.x != static_cast<float>(size.width) || io.DisplaySize.y != static_cast<float>(size.height)) {
        io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
        s.settling = kFramesToSettle;
    }
    s.follow_time(now);
    const std::size_t jobs = s.session.job_count();
    s.session.poll();
    if (s.session.job_count() != jobs) s.settling = kFramesToSettle;
    s.feed();
    s.follow_look();
    const double wanted = s.lay_out(now);
    s.size = size;
    s.undrawn = true;
    if (s.session.run_queue()) s.settling = kFramesToSettle;
    if (!ImGui::IsAnyItemActive() && !s.input.any_button_down()) s.session.close_group();
    s.cursor = ImGui::GetMouseCursor();
    if (s.settling > 0) --s.settling;
    s.settled = s.input.empty() && s.settling == 0 && wanted > 0;
    return s.session.playing() || !s.settled ? 0 : wanted;
}

bool Shell::settled() const { return state_->settled; }

int Shell::frames_drawn() const { return state_->frames_drawn; }

Image Shell::read_back() {
    State& s = *state_;
    s.draw();
    Image image = s.drawn->target->read();
    s.renderer.context().check("reading the window");
    return image;
}

void Shell::present() {
    State& s = *state_;
    s.draw();
    s.drawn->target->present();
    s.renderer.context().check("showing the window");
}

const Marks& Shell::marks() const { return state_->marks; }

const DrawList* Shell::shown() const {
    const std::size_t place = state_->session.active_place();
    return place < state_->viewports.size() ? state_->viewports[place].shown() : nullptr;
}

const DrawStatistics& Shell::statistics() const { return state_->renderer.statistics(); }

Image Shell::viewport_picture() {
    if (!shown()) throw std::invalid_argument("there is no picture yet: open a scene or a clip first");
    DrawList picture = *shown();
    std::erase_if(picture.highlights,
                  [](const HighlightLine& line) { return line.role != HighlightLine::Role::selection; });
    return state_->renderer.draw(picture);
}

void Shell::set_scale(double scale) { state_->own_scale = scale; }

ImGuiMouseCursor Shell::cursor() const { return state_->cursor; }

}  // namespace mobbscope::app
