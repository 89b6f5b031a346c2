/// What the whole window costs while somebody uses it, 1280x720: process CPU time and frames a second; and how soon it
/// answers a key.
#include "crowd.h"

#include <app/commands/command.h>
#include <app/window/shell.h>
#include <base/error.h>
#include <render/gl/gl_context.h>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <deque>
#include <functional>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
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
        session_.files.open_scene(scene, {});
        do {
            frame();
        } while (session_.jobs.job());
        rest();
        if (session_.workspace.empty()) throw std::runtime_error("the scene was not opened");
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
    const Camera before = window.session().workspace.view().camera;
    measure(state, window, [&](std::size_t frame) { return around(middle, 150, frame); });
    if (window.session().workspace.view().camera == before) state.SkipWithError("the mouse did not turn the scene");
}

/// Two clips of `seconds`, their query in the view; the second agent is dragged by its handle.
void drag(benchmark::State& state, Backend backend, double seconds) {
    BenchWindow window(backend, bench::pair(seconds));
    window.session().workspace.select({Selection::Kind::path, {.agent = 1}, -1});
    window.rest();
    const glm::vec2 handle = window.middle_of("handle.move");
    window.move(handle);
    window.frame();
    window.button(true);
    window.frame();
    const auto before = window.session().workspace.document().fitted;
    measure(state, window, [&](std::size_t frame) { return around(handle - glm::vec2(30, 0), 30, 3 * frame); });
    if (window.session().workspace.document().fitted == before) state.SkipWithError("the mouse did not move the agent");
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
    if (follows) run_command(window.session(), "crowd.follow", window.session().workspace.crowd()->agents.front().name);
    window.rest();
    run_command(window.session(), "time.play");
    window.frame();
    const double before = *window.session().workspace.view().time;
    measure(state, window, [&](std::size_t frame) { return around({120, 400}, 60, frame); });
    if (*window.session().workspace.view().time == before) state.SkipWithError("time stood still");
}

/// The mouse over a panel: neither picture nor what is under the mouse changes.
void panel(benchmark::State& state, Backend backend, int agents) {
    BenchWindow window(backend, bench::crowd(agents));
    measure(state, window, [&](std::size_t frame) { return around({120, 400}, 60, frame); });
}

/// Likewise, with one agent alone in the picture.
void panel_alone(benchmark::State& state, Backend backend, int agents) {
    BenchWindow window(backend, bench::crowd(agents));
    run_command(window.session(), "go.agent", "agent 1");
    run_command(window.session(), "agent.solo");
    window.rest();
    measure(state, window, [&](std::size_t frame) { return around({120, 400}, 60, frame); });
}

// --- how soon it answers

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A window in real time, as a person has it: it draws when there is something to draw.
class LiveWindow {
  public:
    LiveWindow(Backend backend, const Scene& scene)
        : session_(true, settings_with(Panels::usual)), shell_(GlContext::open(backend), session_, 1) {
        session_.files.open_scene(scene, {});
        rest();
        if (session_.workspace.empty()) throw std::runtime_error("the scene was not opened");
    }

    Session& session() { return session_; }

    /// Until nothing more is to be drawn.
    void rest() { answer_to({}, Key::none); }

    struct Answer {
        double changed = 0;  ///< seconds from the first press to another picture
        double fine = 0;     ///< ... from the last press to the one that stays
        double cpu = 0;      ///< of the process
        int frames = 0;
    };
    /// `presses`: of the key, at so many seconds from now.
    Answer answer_to(std::deque<double> presses, Key key) {
        const double last = presses.empty() ? 0 : presses.back();
        const Image before = shell_.frames_drawn() > 0 ? picture() : Image{};
        Image latest = before;
        const double begin = wall_seconds();
        const double cpu = cpu_seconds();
        const int drawn = shell_.frames_drawn();
        Answer out;
        for (double next = 0;;) {
            const double since = wall_seconds() - begin;
            bool pressed = false;
            for (; !presses.empty() && presses.front() <= since; presses.pop_front()) {
                for (const bool down : {true, false}) shell_.feed(KeyPress{key, down});
                pressed = true;
            }
            if (!pressed && next > 0) {
                if (std::isinf(next) && presses.empty() && !session_.jobs.job()) break;
                const double due = presses.empty() ? next : std::min(next, presses.front() - since);
                std::this_thread::sleep_for(std::chrono::duration<double>(std::min(due, 0.01)));
                next -= std::min(due, 0.01);
                continue;
            }
            next = shell_.frame(kWindow, wall_seconds());
            Image now = picture();
            // Panels go on for longer: a message goes after a while.
            if (now.rgba != latest.rgba) out.fine = wall_seconds() - begin - last;
            latest = std::move(now);
            if (out.changed == 0 && latest.rgba != before.rgba) out.changed = wall_seconds() - begin;
        }
        out.cpu = cpu_seconds() - cpu;
        out.frames = shell_.frames_drawn() - drawn;
        return out;
    }

  private:
    /// What the viewport shows; the panels may answer before it.
    Image picture() {
        const Image all = shell_.read_back();
        const auto mark = shell_.marks().all().find("viewport");
        if (mark == shell_.marks().all().end()) return {};
        const glm::ivec2 min(mark->second.min);
        const glm::ivec2 size(mark->second.size());
        Image out(size.x, size.y);
        for (int y = 0; y < size.y; ++y) std::copy_n(all.at(min.x, min.y + y), 4 * size.x, out.at(0, y));
        return out;
    }

    Session session_;
    Shell shell_;
};

constexpr double kLongWalk = 5000 / 30.0;  // seconds: 5,000 samples

/// What is looked at, and two keys that undo each other there.
struct Looked {
    std::string name;
    std::function<Scene()> scene;
    std::function<void(Session&)> look;
    Key on, back;
};

Scene long_pair() { return bench::pair(kLongWalk); }

void frame_pair_under_test(Session& session) {
    run_command(session, "step.percent", "60");
    const mobb::Trace::Event event = session.workspace.recorded()->trace[session.workspace.step()];
    session.workspace.select({Selection::Kind::node, {0, -1, 0}, event.a});
    run_command(session, "view.frame");
    session.workspace.select({});
}

std::vector<Looked> all_looked_at() {
    return {
        {"query_whole", long_pair, [](Session& s) { run_command(s, "step.percent", "60"); }, Key::left, Key::right},
        {"query_near", long_pair, frame_pair_under_test, Key::left, Key::right},
        {"leaves_whole", long_pair, [](Session& s) { run_command(s, "view.leaves"); }, Key::left_bracket,
         Key::right_bracket},
        {"leaves_near", long_pair,
         [](Session& s) {
             frame_pair_under_test(s);
             run_command(s, "view.leaves");
         },
         Key::left_bracket, Key::right_bracket},
        {"moment", long_pair,
         [](Session& s) {
             run_command(s, "view.moment");
             run_command(s, "time.at", "60");
         },
         Key::period, Key::comma},
        {"following", [] { return bench::run(100, 60); },
         [](Session& s) {
             run_command(s, "time.at", "30");
             run_command(s, "crowd.follow", s.workspace.crowd()->agents.front().name);
         },
         Key::period, Key::comma},
    };
}

/// The time of an iteration is that from the (last) press to the picture that stays.
void answer(benchmark::State& state, Backend backend, const Looked& looked, int presses) {
    LiveWindow window(backend, looked.scene());
    looked.look(window.session());
    window.rest();
    LiveWindow::Answer sum;
    bool back = false;
    for (auto _ : state) {
        std::deque<double> at;
        for (int i = 0; i < presses; ++i) at.push_back(0.1 * i);
        const LiveWindow::Answer one = window.answer_to(at, back ? looked.back : looked.on);
        back = !back;
        state.SetIterationTime(std::max(one.fine, 1e-9));
        sum = {sum.changed + one.changed, 0, sum.cpu + one.cpu, sum.frames + one.frames};
    }
    const auto mean = [&](double of) { return of / static_cast<double>(state.iterations()); };
    state.counters["changed_ms"] = 1000 * mean(sum.changed);
    state.counters["cpu_ms"] = 1000 * mean(sum.cpu);
    state.counters["frames"] = mean(sum.frames);
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
            add("panel_alone" + crowd + on, panel_alone, backend, agents);
        }
        for (const int agents : {100, 1000}) {
            const std::string crowd = "/" + std::to_string(agents) + "_agents";
            add("play_moment" + crowd + on, play, backend, agents, Show::moment, false);
            add("play_space_time" + crowd + on, play, backend, agents, Show::space_time, false);
            add("follow_moment" + crowd + on, play, backend, agents, Show::moment, true);
            add("follow_space_time" + crowd + on, play, backend, agents, Show::space_time, true);
        }
        add("drag/2_clips_of_42_s" + on, drag, backend, 42.0);
        for (const Looked& looked : all_looked_at()) {
            for (const auto& [presses, count] : {std::pair("press/", 1), std::pair("ten_presses/", 10)}) {
                const std::string row = presses + looked.name + on;
                benchmark::RegisterBenchmark(row.c_str(), answer, backend, looked, count)
                    ->Unit(benchmark::kMillisecond)
                    ->UseManualTime();
            }
        }
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
