/// What a frame of the whole window costs while somebody uses it: process CPU time and frames a second, 1280x720.
#include "crowd.h"

#include <app/commands/command.h>
#include <app/window/shell.h>
#include <base/error.h>
#include <render/gl/gl_context.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobbscope::app {
namespace {

constexpr PictureSize kWindow{1280, 720};
constexpr double kFrame = 1.0 / 60;

/// Panels as wide as they are by themselves, or as narrow as they go.
enum class Panels { usual, narrow };

Settings settings_with(Panels panels) {
    Settings settings;
    settings.ui_scale = 1;
    if (panels == Panels::narrow) settings.left_width = settings.right_width = settings.bottom_height = 0;
    return settings;
}

/// An attended window that is not shown.
class BenchWindow {
  public:
    BenchWindow(Backend backend, const Scene& scene, Panels panels = Panels::usual)
        : session_(true, settings_with(panels)), shell_(GlContext::open(backend), session_, 1) {
        session_.open_scene(scene, {});
        do {
            frame();
        } while (session_.job());
        rest();
        if (session_.empty()) throw std::runtime_error("the scene was not opened");
    }

    void frame() {
        shell_.frame(kWindow, now_);
        shell_.read_back();  // a frame is drawn when it is looked at
        now_ += kFrame;
    }
    /// Until the picture has its smooth edges.
    void rest() {
        for (int i = 0; i < 30; ++i) frame();
    }
    void move(glm::vec2 to) { shell_.feed(MouseMove{to}); }
    void button(bool down) { shell_.feed(MouseButton{0, down}); }
    glm::vec2 middle_of(const std::string& mark) const { return shell_.marks().all().at(mark).center(); }
    Session& session() { return session_; }

  private:
    Session session_;
    Shell shell_;
    double now_ = 0;
};

/// Where the mouse is in a frame: around a circle.
glm::vec2 around(glm::vec2 middle, float radius, std::size_t frame) {
    const float angle = 0.05f * static_cast<float>(frame);
    return middle + radius * glm::vec2(std::cos(angle), std::sin(angle));
}

void measure(benchmark::State& state, BenchWindow& window, const std::function<glm::vec2(std::size_t)>& mouse) {
    std::size_t frame = 0;
    for (auto _ : state) {
        window.move(mouse(++frame));
        window.frame();
    }
    state.counters["fps"] = benchmark::Counter(static_cast<double>(frame), benchmark::Counter::kIsRate);
}

void orbit(benchmark::State& state, Backend backend, int agents, Panels panels) {
    BenchWindow window(backend, bench::crowd(agents), panels);
    const glm::vec2 middle = window.middle_of("viewport");
    window.move(around(middle, 150, 0));
    window.frame();
    window.button(true);
    window.frame();
    const Camera before = window.session().view().camera;
    measure(state, window, [&](std::size_t frame) { return around(middle, 150, frame); });
    if (window.session().view().camera == before) state.SkipWithError("the mouse did not turn the scene");
}

/// Two clips of `seconds`, their query in the view; the second agent is dragged by its handle.
void drag(benchmark::State& state, Backend backend, double seconds) {
    BenchWindow window(backend, bench::pair(seconds));
    window.session().select({Selection::Kind::path, {.agent = 1}, -1});
    window.rest();
    const glm::vec2 handle = window.middle_of("handle.move");
    window.move(handle);
    window.frame();
    window.button(true);
    window.frame();
    const auto before = window.session().document().fitted;
    measure(state, window, [&](std::size_t frame) { return around(handle - glm::vec2(30, 0), 30, 3 * frame); });
    if (window.session().document().fitted == before) state.SkipWithError("the mouse did not move the agent");
}

/// The mouse over the picture, no button held: the picture stays.
void hover(benchmark::State& state, Backend backend, int agents) {
    BenchWindow window(backend, bench::crowd(agents));
    const glm::vec2 middle = window.middle_of("viewport");
    measure(state, window, [&](std::size_t frame) { return around(middle, 150, frame); });
}

/// A run plays: everybody is elsewhere in each frame. `follows`: with somebody's choice, seen from near.
void play(benchmark::State& state, Backend backend, int agents, Show show, bool follows) {
    Scene scene = bench::run(agents, 20);
    scene.view.show = show;
    scene.view.time = 5;
    BenchWindow window(backend, scene);
    if (follows) run_command(window.session(), "crowd.follow", window.session().crowd()->agents.front().name);
    window.rest();
    run_command(window.session(), "time.play");
    window.frame();
    const double before = *window.session().view().time;
    measure(state, window, [&](std::size_t frame) { return around({120, 400}, 60, frame); });
    if (*window.session().view().time == before) state.SkipWithError("time stood still");
}

/// The mouse over a panel: neither picture nor what is under the mouse changes.
void panel(benchmark::State& state, Backend backend, int agents) {
    BenchWindow window(backend, bench::crowd(agents));
    measure(state, window, [&](std::size_t frame) { return around({120, 400}, 60, frame); });
}

template <class Body, class... Arguments>
void add(const std::string& name, Body body, Arguments... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), body, arguments...)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->MeasureProcessCPUTime();
}

void add_all() {
    for (const auto& [name, backend] : {std::pair("osmesa", Backend::osmesa), std::pair("egl", Backend::egl)}) {
        const std::string on = std::string("/") + name;
        try {
            GlContext::open(backend);
        } catch (const MachineError& error) {
            std::cerr << name << " is left out: " << error.what() << "\n";
            continue;
        }
        for (const int agents : {100, 1000}) {
            const std::string crowd = "/" + std::to_string(agents) + "_agents";
            add("orbit" + crowd + on, orbit, backend, agents, Panels::usual);
            add("orbit_narrow_panels" + crowd + on, orbit, backend, agents, Panels::narrow);
            add("hover" + crowd + on, hover, backend, agents);
            add("panel" + crowd + on, panel, backend, agents);
        }
        for (const int agents : {100, 1000}) {
            const std::string crowd = "/" + std::to_string(agents) + "_agents";
            add("play_moment" + crowd + on, play, backend, agents, Show::moment, false);
            add("play_space_time" + crowd + on, play, backend, agents, Show::space_time, false);
            add("follow_moment" + crowd + on, play, backend, agents, Show::moment, true);
            add("follow_space_time" + crowd + on, play, backend, agents, Show::space_time, true);
        }
        add("drag/2_clips_of_42_s" + on, drag, backend, 42.0);
    }
}

}  // namespace
}  // namespace mobbscope::app

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    mobbscope::app::add_all();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
