#include <app/commands/command.h>
#include <app/input/input_queue.h>
#include <app/panels/panels.h>
#include <app/window/shell.h>
#include <app/window/texture_painter.h>
#include <app/window/window_gl.h>
#include <base/error.h>
#include <render/gl/renderer.h>
#include <render/vector/vector_picture.h>

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mobbscope::app {

namespace {

/// Dear ImGui lays out with sizes of the frame before, so what happens is seen whole after so many frames.
constexpr int kFramesToSettle = 3;
/// A field that has not taken the keys by then never will.
constexpr int kFramesToFocus = 8;
/// Half a period of a text field's blinking cursor.
constexpr double kBlink = 0.4;
/// Playing goes on where it was, however long the machine was busy.
constexpr double kLongestStep = 0.25;
/// While a fine picture is painted, seconds between frames in which the sign of it moves.
constexpr double kSignFrame = 0.1;

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

/// A dialog has the keys, but for the one that explains it; what is edited in one is undone in it too.
bool works_under(Dialog dialog, const Command& command) {
    if (dialog == Dialog::none || command.id == "help.shortcuts") return true;
    return std::ranges::find(row_of(dialog).lets_through, command.id) != row_of(dialog).lets_through.end();
}

}  // namespace

struct Shell::State final : PictureMaker {
    State(std::unique_ptr<GlContext> context, Session& of, double wanted_scale, Clock measures)
        : session(of),
          clock(std::move(measures)),
          imgui(make_imgui()),
          renderer(std::move(context)),
          drawn(std::make_unique<Drawn>(renderer, clock)),
          maker_before(of.picture_maker) {
        session.window_scale = wanted_scale;
        ImGuiIO& io = ImGui::GetIO();
        io.UserData = this;
        io.ClipboardUserData = this;
        io.SetClipboardTextFn = [](void* self, const char* text) { static_cast<State*>(self)->copy(text); };
        io.GetClipboardTextFn = [](void* self) { return static_cast<State*>(self)->paste(); };
    }
    ~State() override {
        ImGui::SetCurrentContext(imgui.get());
        // The names would be deleted in whichever context is current; see Renderer.
        if (!renderer.context().try_make_current()) static_cast<void>(drawn.release());
    }

    Image draw(const DrawList& list, int samples) override {
        renderer.check_samples(samples);
        return renderer.draw(list, samples);
    }
    std::string file_bytes(const std::filesystem::path& file, const DrawList& list, int samples) override {
        renderer.check_samples(samples);
        return picture_bytes(file, list, samples, [this]() -> Renderer& { return renderer; });
    }
    Image draw_coarse(const DrawList& list, int divisor) override { return renderer.draw_coarse(list, divisor); }
    std::string why_no_samples(int samples) override {
        try {
            renderer.check_samples(samples);
            return "";
        } catch (const MachineError& error) {
            return error.what();
        }
    }

    /// What is made in the context.
    struct Drawn {
        Drawn(Renderer& renderer, const Clock& clock) : painter(renderer, clock), ui(renderer.context()) {}
        TexturePainter painter;
        UiPass ui;
        std::optional<WindowTarget> target;
    };

    void copy(const char* text) {
        clipboard = text;
        session.desktop->set_clipboard(clipboard);
    }
    const char* paste() {
        if (std::optional<std::string> there = session.desktop->clipboard()) clipboard = std::move(*there);
        return clipboard.c_str();
    }

    /// Runs the command of a chord, unless the keys are somebody else's.
    InputQueue::Taken press(const Chord& chord, bool repeated) {
        using Taken = InputQueue::Taken;
        // A drag ends on what it began on, or is broken off.
        if (input.any_button_down()) {
            if (chord.key == Key::escape && before_drag) break_off();
            return chord.key == Key::escape ? Taken::opened : Taken::nobodys;
        }
        if (focus.press(chord, repeated)) return Taken::opened;
        const Command* command = command_for(session, chord);
        if (!command || (repeated && !command->repeats)) return Taken::nobodys;
        if (!works_under(session.dialogs.now, *command)) return Taken::nobodys;
        if (ImGui::GetIO().WantTextInput && edits_text(chord)) return Taken::nobodys;
        const bool busy = ImGui::IsAnyItemActive() || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
        if (busy && !chord.ctrl && edits_text(chord)) return Taken::nobodys;
        // Each press is undone by itself, also of those that one frame takes in.
        if (!ImGui::IsAnyItemActive()) session.workspace.close_group();
        if (command->enabled(session)) {
            invoke(session, command->id);
        } else if (const std::string_view why = why_not(session, *command);
                   !session.workspace.empty() && why != kNotNow) {
            std::string title(command->title);
            if (title.ends_with("...")) title.resize(title.size() - 3);
            session.notifications.tell(MessageLevel::info, title.append(": ").append(why));
        }
        // No panel is being drawn: what comes next from the keyboard meets what this one has done.
        session.queue.run();
        const bool opened = session.dialogs.now != Dialog::none || session.keys.move != FocusMove::none;
        return opened ? Taken::opened : Taken::command;
    }

    void break_off() {
        ImGui::ClearActiveID();
        field = {};
        session.restore(*std::exchange(before_drag, std::nullopt));
    }

    /// Remembers how all was before a button went down.
    void follow_drag() {
        const bool down = input.any_button_down();
        if (down && !was_down) before_drag = session.before_drag();
        if (!down) before_drag.reset();
        was_down = down;
    }

    void drop(const Drop& dropped) {
        session.queue.push([this, dropped] { session.files.drop(dropped.paths); });
        session.queue.run();
    }

    /// A field of a dialog or of a panel does not have the keys yet: what is typed meanwhile is meant for it.
    bool waits_for_field() {
        const bool in_dialog = row_of(session.dialogs.now).has_field && session.dialogs.input.fresh;
        if (!in_dialog && !field.waits_for_keys())
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
                    [this](const Drop& dropped) { drop(dropped); }, [this] { session.files.request_close(); }});
        follow_drag();
    }

    void follow_time(double now) {
        const double passed = time ? std::max(now - *time, 0.0) : 0.0;
        time = now;
        // Dear ImGui wants time to pass.
        ImGui::GetIO().DeltaTime = std::max(static_cast<float>(passed), 1e-5f);
        if (std::exchange(was_playing, session.playback.playing()) && session.playback.playing()) {
            session.playback.advance(std::min(passed, kLongestStep));
        }
    }

    void follow_look() {
        const auto wanted = std::pair(session.workspace.view().theme, static_cast<float>(session.ui_scale()));
        if (look_made_for == wanted) return;
        style = make_style(wanted.first, wanted.second);
        drawn->ui.upload(*ImGui::GetIO().Fonts);
        look_made_for = wanted;
        settling = kFramesToSettle;
    }

    double lay_out(double now) {
        marks.clear();
        Ui ui{session, session.workspace, style, marks, focus, field, drawn->painter, now, kNever};
        if (session.options.attended) ui.frame_seconds = frame_seconds;
        focus.follow_commands();
        ImGui::NewFrame();
        focus.begin_frame();
        viewports.resize(session.views.count());
        window_layout(ui, viewports, pictures);
        session.keys.section.clear();
        focus.end_frame(style);
        const ImGuiIO& io = ImGui::GetIO();
        if (io.WantTextInput) ui.want_frame_in(kBlink);
        ImGui::Render();
        drawn->painter.drop_images();
        return ui.next_frame;
    }

    /// Seconds until a fine picture is to be gone on with, and of which place.
    std::pair<double, std::size_t> fine_due(double now) const {
        std::pair<double, std::size_t> out{kNever, 0};
        for (std::size_t place = 0; place < viewports.size(); ++place) {
            if (!viewports[place].shown()) continue;
            out = std::min(out, {drawn->painter.fine_due_in(place, now), place});
        }
        return out;
    }

    /// Whether another frame would show nothing new, but for what is being painted.
    bool only_paints(PictureSize wanted_size, double now) const {
        return fine_due(now).first <= 0 && now < laid_out_until && input.empty() && settling == 0 &&
               wanted_size == size && !session.playback.playing() && !session.jobs.job();
    }

    /// The last frame, once somebody looks at it.
    void draw_frame() {
        ImGui::SetCurrentContext(imgui.get());
        renderer.context().make_current();
        if (!std::exchange(undrawn, false)) return;
        const double began = clock();
        for (std::size_t place = 0; place < viewports.size(); ++place) {
            if (const DrawList* picture = viewports[place].shown()) drawn->painter.paint_changes(place, *picture);
        }
        const auto [due, of] = fine_due(*time);
        if (due <= 0) drawn->painter.paint_on(of, *viewports[of].shown());
        if (std::exchange(told, renderer.notice()) != renderer.notice())
            session.notifications.tell_of_window(MessageLevel::warning, renderer.notice());
        if (!std::exchange(laid_out, false)) return;
        ++frames_drawn;
        if (!drawn->target || drawn->target->size() != size) drawn->target.emplace(size);
        const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(style.window);
        drawn->target->clear({ground.x, ground.y, ground.z, 1});
        drawn->ui.draw(*ImGui::GetDrawData(), size);
        renderer.context().check("drawing the window");
        frame_seconds = laid_out_in + clock() - began;
    }

    Session& session;
    Clock clock;
    std::unique_ptr<ImGuiContext, ImGuiContextDeleter> imgui;
    Renderer renderer;
    std::unique_ptr<Drawn> drawn;
    std::vector<Viewport> viewports;  ///< by place
    QueryPictures pictures;
    PictureSize size;  ///< of the last frame
    bool undrawn = false;
    bool laid_out = false;      ///< since the last was drawn: more than a picture has changed
    double laid_out_until = 0;  ///< the time at which another frame may show something new
    int frames_drawn = 0;
    double laid_out_in = 0;    ///< seconds that the last frame's panels and draw lists took
    double frame_seconds = 0;  ///< ... with its drawing
    InputQueue input;
    Focus focus{session};
    FieldInput field;
    std::optional<Session::BeforeDrag> before_drag;
    bool was_down = false;  ///< a button of the mouse
    Marks marks;
    Style style{};
    std::optional<std::pair<Theme, float>> look_made_for;
    PictureMaker* maker_before;
    std::optional<double> time;
    std::string clipboard;
    std::string told;  ///< of the renderer's notices
    int settling = kFramesToSettle;
    int waited = 0;  ///< frames for a field
    bool settled = false;
    bool was_playing = false;
    ImGuiMouseCursor cursor = ImGuiMouseCursor_Arrow;
};

double Shell::steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Shell::Shell(std::unique_ptr<GlContext> context, Session& session, double scale, Clock clock)
    : state_(std::make_unique<State>(std::move(context), session, scale, std::move(clock))) {
    session.picture_maker = state_.get();
}

Shell::~Shell() {
    Session& session = state_->session;
    if (session.picture_maker == state_.get()) session.picture_maker = state_->maker_before;
    session.views.picture.reset();
}

void Shell::feed(const InputEvent& event) { state_->input.push(event); }

double Shell::frame(PictureSize size, double now) {
    State& s = *state_;
    ImGui::SetCurrentContext(s.imgui.get());
    s.renderer.context().make_current();
    s.undrawn = true;
    if (s.only_paints(size, now)) return 0;
    s.laid_out = true;
    ImGuiIO& io = ImGui::GetIO();
    if (io.DisplaySize.x != static_cast<float>(size.width) || io.DisplaySize.y != static_cast<float>(size.height)) {
        io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
        s.settling = kFramesToSettle;
    }
    s.follow_time(now);
    const std::size_t jobs = s.session.jobs.count();
    s.session.poll();
    if (s.session.jobs.count() != jobs) s.settling = kFramesToSettle;
    s.feed();
    s.follow_look();
    const double began = s.clock();
    const double wanted = s.lay_out(now);
    s.laid_out_in = s.clock() - began;
    s.size = size;
    s.laid_out_until = now + std::min(wanted, kSignFrame);
    bool changed = false;
    if (s.session.workspace.document().links.camera) Viewport::frame_together(s.viewports);
    // The active one first: it says of which size pictures are, and what the others frame is of that size already.
    for (std::size_t i = 0; i < s.viewports.size(); ++i) {
        Viewport& viewport = s.viewports[(s.session.views.active() + i) % s.viewports.size()];
        changed |= viewport.settle(s.session.views, s.session.workspace);
    }
    if (s.session.queue.run() || changed) s.settling = kFramesToSettle;
    if (!ImGui::IsAnyItemActive() && !s.input.any_button_down()) s.session.workspace.close_group();
    s.cursor = ImGui::GetMouseCursor();
    if (s.settling > 0) --s.settling;
    s.settled = s.input.empty() && s.settling == 0 && wanted > 0;
    return s.session.playback.playing() || !s.settled ? 0 : std::min(wanted, s.fine_due(now).first);
}

bool Shell::settled() const { return state_->settled; }

int Shell::frames_drawn() const { return state_->frames_drawn; }

Shell::Painted Shell::painted() const { return state_->drawn->painter.painted(); }

Image Shell::read_back() {
    State& s = *state_;
    s.draw_frame();
    Image image = s.drawn->target->read();
    s.renderer.context().check("reading the window");
    return image;
}

void Shell::present() {
    State& s = *state_;
    s.draw_frame();
    s.drawn->target->present();
    s.renderer.context().check("showing the window");
}

const Marks& Shell::marks() const { return state_->marks; }

const DrawList* Shell::shown() const {
    const std::size_t place = state_->session.views.active();
    return place < state_->viewports.size() ? state_->viewports[place].shown() : nullptr;
}

const DrawStatistics& Shell::statistics() const { return state_->renderer.statistics(); }

Image Shell::viewport_picture() {
    if (!shown()) throw std::invalid_argument("there is no picture yet: open a scene or a clip first");
    DrawList picture = *shown();
    std::erase_if(picture.highlights, [](const HighlightLine& line) {
        return line.role != HighlightLine::Role::selection && line.role != HighlightLine::Role::ancestor;
    });
    return state_->renderer.draw(picture);
}

void Shell::set_scale(double scale) { state_->session.window_scale = scale; }

ImGuiMouseCursor Shell::cursor() const { return state_->cursor; }

}  // namespace mobbscope::app
