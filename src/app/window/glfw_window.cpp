#include <app/window/glfw_window.h>
#include <app/window/picture_clipboard.h>
#include <base/error.h>
#include <render/drawlist/palette.h>
#include <render/gl/backends.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <opened_libraries.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

/// Where the display does not hold frames back, this does: a window that plays at 1000 frames a second helps nobody.
constexpr double kLeastFrame = 1.0 / 120;
/// Of the monitor's room, what a window takes at most.
constexpr double kShareOfMonitor = 0.9;
/// Pixels of a window's upper edge that must be on a monitor to take hold of it.
constexpr int kGrip = 48;

// What is used of GLFW: pointers that hide its functions. The library is opened with the first window, as loading it,
// and X11 with it, takes longer than many a command that opens none.
// clang-format off
#define MOBBSCOPE_GLFW_FUNCTIONS(X) \
    X(glfwCreateStandardCursor) X(glfwCreateWindow) X(glfwDestroyCursor) X(glfwDestroyWindow) \
    X(glfwGetClipboardString) X(glfwGetCurrentContext) X(glfwGetCursorPos) X(glfwGetFramebufferSize) X(glfwGetKeyName) \
    X(glfwGetMonitorContentScale) X(glfwGetMonitorWorkarea) X(glfwGetMonitors) X(glfwGetMouseButton) \
    X(glfwGetPrimaryMonitor) X(glfwGetProcAddress) X(glfwGetTime) X(glfwGetWindowAttrib) X(glfwGetWindowPos) \
    X(glfwGetWindowSize) X(glfwGetWindowUserPointer) X(glfwInit) X(glfwInitHint) X(glfwMakeContextCurrent) \
    X(glfwPollEvents) X(glfwPostEmptyEvent) X(glfwRestoreWindow) X(glfwSetCharCallback) X(glfwSetClipboardString) \
    X(glfwSetCursor) X(glfwSetCursorEnterCallback) X(glfwSetCursorPosCallback) X(glfwSetDropCallback) \
    X(glfwSetErrorCallback) X(glfwSetKeyCallback) X(glfwSetMouseButtonCallback) X(glfwSetScrollCallback) \
    X(glfwSetWindowCloseCallback) X(glfwSetWindowContentScaleCallback) X(glfwSetWindowFocusCallback) \
    X(glfwSetWindowIcon) X(glfwSetWindowMaximizeCallback) X(glfwSetWindowPos) X(glfwSetWindowPosCallback) \
    X(glfwSetWindowShouldClose) X(glfwSetWindowSize) X(glfwSetWindowSizeCallback) X(glfwSetWindowSizeLimits) \
    X(glfwSetWindowTitle) X(glfwSetWindowUserPointer) X(glfwShowWindow) X(glfwSwapBuffers) X(glfwSwapInterval) \
    X(glfwTerminate) X(glfwWaitEvents) X(glfwWaitEventsTimeout) X(glfwWindowHint) X(glfwWindowHintString)
// clang-format on
// What is declared cannot stand in parentheses. NOLINTNEXTLINE(bugprone-macro-parentheses)
#define MOBBSCOPE_DECLARE(function) decltype(&::function) function = nullptr;
MOBBSCOPE_GLFW_FUNCTIONS(MOBBSCOPE_DECLARE)
#undef MOBBSCOPE_DECLARE

std::string last_error;

[[noreturn]] void fail(const std::string& what) {
    throw MachineError(what + (last_error.empty() ? "" : " (" + last_error + ")") +
                       "; `mobbscope render` makes pictures and `mobbscope --script FILE --headless` runs the window "
                       "without a display");
}

/// Owns GLFW's window along with its context.
class WindowContext final : public GlContext {
  public:
    explicit WindowContext(GLFWwindow* window) : window_(window) {}
    ~WindowContext() override { glfwDestroyWindow(window_); }

    std::string_view name() const override { return "window"; }

  private:
    bool bind() noexcept override {
        // To make current what is current may cost a flush.
        if (glfwGetCurrentContext() != window_) glfwMakeContextCurrent(window_);
        return glfwGetCurrentContext() == window_;
    }
    Function function(const char* function_name) const noexcept override { return glfwGetProcAddress(function_name); }

    GLFWwindow* window_;
};

/// Keys that follow one another in GLFW and in Key.
struct KeyRow {
    int first, last;  ///< GLFW's
    Key ours;         ///< the first
};

constexpr bool as_far_apart(Key a, Key b, int glfw_a, int glfw_b) {
    return static_cast<int>(b) - static_cast<int>(a) == glfw_b - glfw_a;
}
static_assert(as_far_apart(Key::escape, Key::end, GLFW_KEY_ESCAPE, GLFW_KEY_END));
static_assert(as_far_apart(Key::escape, Key::del, GLFW_KEY_ESCAPE, GLFW_KEY_DELETE));
static_assert(as_far_apart(Key::comma, Key::slash, GLFW_KEY_COMMA, GLFW_KEY_SLASH));
static_assert(as_far_apart(Key::shift, Key::ctrl, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_CONTROL));
static_assert(as_far_apart(Key::shift, Key::super, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_SUPER));

Key physical_key(int key) {
    constexpr std::array<KeyRow, 18> kRows{{{GLFW_KEY_A, GLFW_KEY_Z, Key::a},
                                            {GLFW_KEY_0, GLFW_KEY_9, Key::n0},
                                            {GLFW_KEY_KP_0, GLFW_KEY_KP_9, Key::n0},
                                            {GLFW_KEY_F1, GLFW_KEY_F12, Key::f1},
                                            {GLFW_KEY_SPACE, GLFW_KEY_SPACE, Key::space},
                                            {GLFW_KEY_ESCAPE, GLFW_KEY_END, Key::escape},
                                            {GLFW_KEY_COMMA, GLFW_KEY_SLASH, Key::comma},
                                            {GLFW_KEY_EQUAL, GLFW_KEY_EQUAL, Key::equal},
                                            {GLFW_KEY_LEFT_BRACKET, GLFW_KEY_LEFT_BRACKET, Key::left_bracket},
                                            {GLFW_KEY_RIGHT_BRACKET, GLFW_KEY_RIGHT_BRACKET, Key::right_bracket},
                                            {GLFW_KEY_LEFT_SHIFT, GLFW_KEY_LEFT_SUPER, Key::shift},
                                            {GLFW_KEY_RIGHT_SHIFT, GLFW_KEY_RIGHT_SUPER, Key::shift},
                                            {GLFW_KEY_MENU, GLFW_KEY_MENU, Key::menu},
                                            {GLFW_KEY_KP_ENTER, GLFW_KEY_KP_ENTER, Key::enter},
                                            {GLFW_KEY_KP_DECIMAL, GLFW_KEY_KP_DECIMAL, Key::period},
                                            {GLFW_KEY_KP_DIVIDE, GLFW_KEY_KP_DIVIDE, Key::slash},
                                            {GLFW_KEY_KP_SUBTRACT, GLFW_KEY_KP_SUBTRACT, Key::minus},
                                            {GLFW_KEY_KP_ADD, GLFW_KEY_KP_ADD, Key::equal}}};
    for (const KeyRow& row : kRows) {
        if (key >= row.first && key <= row.last) return static_cast<Key>(static_cast<int>(row.ours) + key - row.first);
    }
    return Key::none;
}

/// What stands on the key; where that is no name of ours (Cyrillic, the digits of a French keyboard), what an American
/// keyboard has there.
Key key_of(int key, int scancode) {
    const char* printed = glfwGetKeyName(key, scancode);
    if (printed) {
        if (const std::optional<Key> named = key_from_name(printed)) return *named;
    }
    return physical_key(key);
}

int standard_cursor(ImGuiMouseCursor cursor) {
    switch (cursor) {
        case ImGuiMouseCursor_TextInput:
            return GLFW_IBEAM_CURSOR;
        case ImGuiMouseCursor_ResizeNS:
            return GLFW_VRESIZE_CURSOR;
        case ImGuiMouseCursor_ResizeEW:
            return GLFW_HRESIZE_CURSOR;
        case ImGuiMouseCursor_ResizeAll:
            return GLFW_CROSSHAIR_CURSOR;
        case ImGuiMouseCursor_Hand:
            return GLFW_HAND_CURSOR;
        default:
            return GLFW_ARROW_CURSOR;
    }
}

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

void open_glfw() {
    try {
        const SharedLibrary library(glfw_libraries());
#define MOBBSCOPE_FIND(name) name = library.function<decltype(name)>(#name);
        MOBBSCOPE_GLFW_FUNCTIONS(MOBBSCOPE_FIND)
#undef MOBBSCOPE_FIND
    } catch (const std::runtime_error& error) {
        last_error = error.what();
        fail("there is no GLFW to open a window with");
    }
}

// --- the display goes away

std::function<void()> when_display_is_lost;

/// Once: of several threads the first.
void lose_display() {
    static std::atomic_flag begun;
    if (begun.test_and_set()) {
        for (;;) ::pause();
    }
    when_display_is_lost();
}

/// Xlib ends a program with status 1 when its server goes away.
void watch_x11() {
    try {
        const SharedLibrary x11({"libX11.so.6"});
        using IoErrorHandler = int (*)(void* display);
        const auto set_handler = x11.function<IoErrorHandler (*)(IoErrorHandler)>("XSetIOErrorHandler");
        set_handler([](void*) {
            lose_display();
            return 0;
        });
    } catch (const std::runtime_error&) {
        // There is no X11, so the display is another.
    }
}

/// GLFW asks windows to close when it has lost a Wayland display.
bool has_lost_wayland() {
    try {
        const SharedLibrary glfw(glfw_libraries());
        const auto display = glfw.function<void* (*)()>("glfwGetWaylandDisplay");
        const SharedLibrary wayland({"libwayland-client.so.0"});
        const auto error_of = wayland.function<int (*)(void*)>("wl_display_get_error");
        void* of = display();
        return of && error_of(of) != 0;
    } catch (const std::runtime_error&) {
        return false;  // there is no Wayland
    }
}

/// GLFW from start to end.
struct Library {
    explicit Library(std::function<void()> display_lost) {
        when_display_is_lost = std::move(display_lost);
        open_glfw();
        glfwSetErrorCallback([](int, const char* message) { last_error = message; });
#ifdef GLFW_PLATFORM
        // From GLFW 3.4 on Wayland is tried first, whose library complains on standard error where there is none.
        if (!is_set("WAYLAND_DISPLAY") && !is_set("WAYLAND_SOCKET")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (!glfwInit()) fail("there is no display to open a window on");
        watch_x11();
    }
    ~Library() { glfwTerminate(); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

double monitor_scale() {
    float x = 1;
    float y = 1;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorContentScale(monitor, &x, &y);
    return x > 0 ? static_cast<double>(x) : 1.0;
}

PictureSize default_size(double scale) {
    const auto scaled = [&](int side) { return static_cast<int>(std::lround(side * scale)); };
    PictureSize size{scaled(kDefaultSize.width), scaled(kDefaultSize.height)};
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) {
        int x = 0;
        int y = 0;
        PictureSize room;
        glfwGetMonitorWorkarea(monitor, &x, &y, &room.width, &room.height);
        if (room.width > 0 && room.height > 0) {
            size.width = std::min(size.width, static_cast<int>(room.width * kShareOfMonitor));
            size.height = std::min(size.height, static_cast<int>(room.height * kShareOfMonitor));
        }
    }
    return {std::max(size.width, kLeastSize.width), std::max(size.height, kLeastSize.height)};
}

/// Where it stood last, if enough of that is still on a monitor to take hold of.
std::optional<WindowPlace> place_on_monitors(const std::optional<WindowPlace>& last) {
    if (!last) return std::nullopt;
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int x = 0;
        int y = 0;
        PictureSize room;
        glfwGetMonitorWorkarea(monitors[i], &x, &y, &room.width, &room.height);
        const int across = std::min(last->x + last->width, x + room.width) - std::max(last->x, x);
        const bool top_is_on = last->y >= y && last->y < y + room.height - kGrip;
        if (across < kGrip || !top_is_on) continue;
        WindowPlace place = *last;
        place.width = std::clamp(place.width, kLeastSize.width, std::max(room.width, kLeastSize.width));
        place.height = std::clamp(place.height, kLeastSize.height, std::max(room.height, kLeastSize.height));
        return place;
    }
    return std::nullopt;
}

GLFWwindow* open_window(PictureSize size, bool maximized) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);  // until there is something to see
    glfwWindowHint(GLFW_MAXIMIZED, maximized ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "mobbscope");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "mobbscope");
    GLFWwindow* window = glfwCreateWindow(size.width, size.height, "Mobbscope", nullptr, nullptr);
    if (!window) fail("no window with OpenGL 3.3 can be opened");
    return window;
}

float distance_to_segment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const float t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
    return glm::length(p - (a + t * (b - a)));
}

float distance_to_rounded_square(glm::vec2 p, float radius) {
    const glm::vec2 q = glm::abs(p - 0.5f) - 0.5f + radius;
    return glm::length(glm::max(q, 0.0f)) + std::min(std::max(q.x, q.y), 0.0f) - radius;
}

}  // namespace

bool has_display() { return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY"); }

struct GlfwWindow::State final : Desktop {
    /// A size that was asked for holds this once, and so it goes where the display puts it.
    State(Session& of, std::optional<PictureSize> size, std::function<void()> display_lost)
        : library(std::move(display_lost)),
          session(of),
          desktop_before(of.desktop),
          place(size ? std::nullopt : place_on_monitors(of.settings.window)),
          keeps_place(!size),
          window(open_window(
              size.value_or(place ? PictureSize{place->width, place->height}
                                  : default_size(of.settings.ui_scale > 0 ? of.settings.ui_scale : monitor_scale())),
              place && place->maximized)),
          shell(std::make_unique<WindowContext>(window), of, monitor_scale()) {
        glfwSwapInterval(1);
        glfwSetWindowSizeLimits(window, kLeastSize.width, kLeastSize.height, GLFW_DONT_CARE, GLFW_DONT_CARE);
        if (place) glfwSetWindowPos(window, place->x, place->y);
        set_icon();
        set_callbacks();
        session.desktop = this;
    }
    ~State() override {
        session.end_work();  // it would wake a window that is gone
        session.desktop = desktop_before;
        for (const auto& [shape, cursor] : cursors) glfwDestroyCursor(cursor);
    }

    void wake() override { glfwPostEmptyEvent(); }
    void set_clipboard(const std::string& text) override { glfwSetClipboardString(window, text.c_str()); }
    std::optional<std::string> clipboard() override {
        const char* text = glfwGetClipboardString(window);
        return text ? text : "";
    }
    void set_clipboard_picture(std::string_view png) override { copy_picture_to_clipboard(png); }
    std::string_view why_no_clipboard_picture() override { return why_no_picture_clipboard(); }

    static State& state_of(GLFWwindow* of) { return *static_cast<State*>(glfwGetWindowUserPointer(of)); }
    static Shell& shell_of(GLFWwindow* of) { return state_of(of).shell; }

    void set_icon() const {
        std::array<Image, 3> icons{window_icon(16), window_icon(32), window_icon(64)};
        std::array<GLFWimage, 3> images{};
        for (std::size_t i = 0; i < icons.size(); ++i) {
            images[i] = {icons[i].width, icons[i].height, icons[i].rgba.data()};
        }
        glfwSetWindowIcon(window, static_cast<int>(images.size()), images.data());
    }

    /// Positions come in the window's coordinates, which on some displays are not pixels.
    static void mouse_is_at(GLFWwindow* of, double x, double y) {
        PictureSize points;
        PictureSize pixels;
        glfwGetWindowSize(of, &points.width, &points.height);
        glfwGetFramebufferSize(of, &pixels.width, &pixels.height);
        const glm::dvec2 scale(static_cast<double>(pixels.width) / std::max(points.width, 1),
                               static_cast<double>(pixels.height) / std::max(points.height, 1));
        shell_of(of).feed(MouseMove{glm::vec2(glm::dvec2(x, y) * scale)});
    }

    void set_callbacks() {
        glfwSetWindowUserPointer(window, this);
        glfwSetWindowPosCallback(window, [](GLFWwindow* of, int, int) { state_of(of).moved = true; });
        glfwSetWindowSizeCallback(window, [](GLFWwindow* of, int, int) { state_of(of).moved = true; });
        glfwSetWindowMaximizeCallback(window, [](GLFWwindow* of, int) { state_of(of).moved = true; });
        glfwSetCursorPosCallback(window, mouse_is_at);
        glfwSetCursorEnterCallback(window, [](GLFWwindow* of, int entered) {
            bool held = false;
            for (int button = 0; button < 3; ++button) held |= glfwGetMouseButton(of, button) == GLFW_PRESS;
            // Dear ImGui's way to say that there is no mouse.
            if (!entered && !held) shell_of(of).feed(MouseMove{glm::vec2(-FLT_MAX)});
            // Where it comes back to the place that it left, GLFW tells of no move.
            if (entered) {
                double x = 0, y = 0;
                glfwGetCursorPos(of, &x, &y);
                mouse_is_at(of, x, y);
            }
        });
        glfwSetMouseButtonCallback(window, [](GLFWwindow* of, int button, int action, int) {
            if (button < 3) shell_of(of).feed(MouseButton{button, action == GLFW_PRESS});
        });
        glfwSetScrollCallback(window,
                              [](GLFWwindow* of, double x, double y) { shell_of(of).feed(Wheel{glm::vec2(x, y)}); });
        glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int scancode, int action, int) {
            const Key known = key_of(key, scancode);
            if (known != Key::none) shell_of(of).feed(KeyPress{known, action != GLFW_RELEASE});
        });
        glfwSetCharCallback(window, [](GLFWwindow* of, unsigned int code) {
            shell_of(of).feed(TypedText{static_cast<char32_t>(code)});
        });
        glfwSetDropCallback(window, [](GLFWwindow* of, int count, const char** paths) {
            shell_of(of).feed(Drop{{paths, paths + count}});
        });
        glfwSetWindowFocusCallback(window, [](GLFWwindow* of, int focused) {
            if (!focused) return shell_of(of).feed(KeysLost{});
            // Scripts find the same everywhere.
            Session& focused_on = state_of(of).session;
            if (!focused_on.options.attended) return;
            focused_on.files.tell_of_changed_files();
            focused_on.recovery.look();
        });
        glfwSetWindowCloseCallback(window, [](GLFWwindow* of) {
            glfwSetWindowShouldClose(of, GLFW_FALSE);
            if (has_lost_wayland()) lose_display();
            // No frame is drawn of a minimised window, and it may have to ask about unsaved changes.
            if (glfwGetWindowAttrib(of, GLFW_ICONIFIED)) glfwRestoreWindow(of);
            shell_of(of).feed(CloseRequest{});
        });
        glfwSetWindowContentScaleCallback(
            window, [](GLFWwindow* of, float x, float) { shell_of(of).set_scale(static_cast<double>(x)); });
    }

    bool is_seen() const {
        PictureSize size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        return size.width > 0 && size.height > 0 && !glfwGetWindowAttrib(window, GLFW_ICONIFIED);
    }

    /// Where it stands now is where it opens the next time.
    void note_place() {
        if (!keeps_place || !std::exchange(moved, false)) return;
        WindowPlace now = place.value_or(WindowPlace{});
        now.maximized = glfwGetWindowAttrib(window, GLFW_MAXIMIZED) != 0;
        // What it goes back to when it is no longer maximised.
        if (!now.maximized) {
            glfwGetWindowPos(window, &now.x, &now.y);
            glfwGetWindowSize(window, &now.width, &now.height);
        }
        place = now;
        if (now.width > 0 && now.height > 0) session.settings.window = now;
    }

    /// Draws, and notes when to draw again.
    void draw() {
        if (!is_seen()) {
            session.poll();
            next = std::numeric_limits<double>::infinity();
            return;
        }
        PictureSize size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        last_drawn = glfwGetTime();
        next = shell.frame(size, last_drawn);
        shell.present();
        glfwSwapBuffers(window);
        show_title();
        show_cursor();
        if (!std::exchange(shown, true)) glfwShowWindow(window);
        note_place();
    }

    void show_title() {
        const std::string wanted = session.shown_title() + (session.shows_unsaved() ? "*" : "") + " - Mobbscope";
        if (wanted == title) return;
        glfwSetWindowTitle(window, wanted.c_str());
        title = wanted;
    }

    void show_cursor() {
        const int shape = standard_cursor(shell.cursor());
        if (shape == cursor_shape) return;
        auto [at, is_new] = cursors.try_emplace(shape, nullptr);
        if (is_new) at->second = glfwCreateStandardCursor(shape);
        glfwSetCursor(window, at->second);
        cursor_shape = shape;
    }

    /// Sleeps until something happens or the next frame is due, at most so long.
    void wait(double most) const {
        const double due = std::max(next, kLeastFrame - (glfwGetTime() - last_drawn));
        const double seconds = std::min(due, most);
        if (seconds <= 0) {
            glfwPollEvents();
        } else if (std::isinf(seconds)) {
            glfwWaitEvents();
        } else {
            glfwWaitEventsTimeout(seconds);
        }
    }

    Library library;
    Session& session;
    Desktop* desktop_before;
    std::optional<WindowPlace> place;  ///< as settings have it; none: it was nowhere yet
    bool keeps_place;
    bool moved = true;  ///< or resized, since its place was noted
    GLFWwindow* window;
    Shell shell;
    std::string title;
    std::map<int, GLFWcursor*> cursors;
    int cursor_shape = GLFW_ARROW_CURSOR;
    double last_drawn = 0;
    double next = 0;
    bool shown = false;
};

GlfwWindow::GlfwWindow(Session& session, std::optional<PictureSize> size, std::function<void()> display_lost)
    : state_(std::make_unique<State>(session, size, std::move(display_lost))) {}

GlfwWindow::~GlfwWindow() = default;

void GlfwWindow::run(const std::function<bool()>& interrupted) {
    Session& session = state_->session;
    while (!session.files.closed()) {
        state_->wait(session.recovery.poll(glfwGetTime()));
        if (interrupted()) return;
        state_->draw();
    }
}

Shell& GlfwWindow::shell() { return state_->shell; }

void GlfwWindow::frame() {
    glfwPollEvents();
    state_->draw();
}

void GlfwWindow::run_for(double seconds) {
    for (const double end = glfwGetTime() + seconds; glfwGetTime() < end && !state_->session.files.closed();) {
        state_->wait(end - glfwGetTime());
        state_->draw();
    }
}

void GlfwWindow::resize(PictureSize size) {
    glfwSetWindowSize(state_->window, size.width, size.height);
    // The display answers in its own time.
    run_for(0.1);
}

void GlfwWindow::settle() {
    frame();
    // What still wants frames after that long is an animation.
    for (const double end = glfwGetTime() + 2; state_->next == 0 && !shell().settled() && glfwGetTime() < end;) frame();
}

Image window_icon(int side) {
    const Palette& colors = palette(Theme::dark);
    const Rgba orange(0.902f, 0.624f, 0, 1);
    const float pixel = 1.0f / static_cast<float>(side);
    const auto covered = [&](float outside) { return glm::clamp(0.5f - outside / pixel, 0.0f, 1.0f); };
    Image icon(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5f) * pixel;
            Rgba color = colors.panel_border;
            color = mix_colors(color, colors.accent,
                               covered(distance_to_segment(p, {0.25f, 0.25f}, {0.75f, 0.75f}) - 0.11f));
            // The one that is in front leaves a gap.
            const float front = distance_to_segment(p, {0.75f, 0.25f}, {0.25f, 0.75f});
            color = mix_colors(color, colors.panel_border, covered(front - 0.16f));
            color = mix_colors(color, orange, covered(front - 0.11f));
            color.a = covered(distance_to_rounded_square(p, 0.2f));
            for (int c = 0; c < 4; ++c) {
                icon.at(x, y)[c] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
            }
        }
    }
    return icon;
}

}  // namespace mobbscope::app
