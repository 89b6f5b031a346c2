/// What a frame of the window costs: a crowd seen from another side each time, and two long walks scrubbed and stepped
/// through. Beside the whole frame's time on the clock, with drawing, the processor time of the draw list, and of
/// preparing and uploading what is drawn.
#include "crowd.h"

#include <base/error.h>
#include <render/drawlist/camera.h>
#include <render/gl/renderer.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>

#include <benchmark/benchmark.h>
#include <glad/gl.h>

#include <cstddef>
#include <ctime>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>

namespace mobbscope {
namespace {

double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

KeptPaths paths_of(Scene scene) {
    return KeptPaths(std::make_shared<const FittedScene>(std::move(scene), mobb::FitOptions{}));
}

/// While one exists OpenGL draws nothing: what is left of a picture is its preparation and upload.
class NoDrawing {
  public:
    NoDrawing() {
        glad_glDrawElementsInstanced = [](GLenum, GLsizei, GLenum, const void*, GLsizei) {};
        glad_glDrawArraysInstanced = [](GLenum, GLint, GLsizei, GLsizei) {};
    }
    ~NoDrawing() {
        glad_glDrawElementsInstanced = elements_;
        glad_glDrawArraysInstanced = arrays_;
    }

  private:
    PFNGLDRAWELEMENTSINSTANCEDPROC elements_ = glad_glDrawElementsInstanced;
    PFNGLDRAWARRAYSINSTANCEDPROC arrays_ = glad_glDrawArraysInstanced;
};

/// Draws a list for each frame, without multisampling; the first two, which fill the buffers, are not counted. Every
/// second picture is prepared alone, which is not part of the frame's time.
void frames(benchmark::State& state, Backend backend, const std::function<DrawList(std::size_t)>& list_of) {
    Renderer renderer(backend);
    for (std::size_t i = 0; i < 2; ++i) renderer.paint(list_of(i), 1);
    glFinish();
    std::size_t frame = 2;
    double listed = 0;
    double uploaded = 0;
    DrawStatistics last;
    for (auto _ : state) {
        renderer.paint(list_of(frame++), 1);
        glFinish();
        last = renderer.statistics();
        state.PauseTiming();
        const double begin = processor_ms();
        const DrawList list = list_of(frame++);
        const double built = processor_ms();
        {
            const NoDrawing nothing;
            renderer.paint(list, 1);
        }
        listed += built - begin;
        uploaded += processor_ms() - built;
        state.ResumeTiming();
    }
    const double count = static_cast<double>(state.iterations());
    state.counters["list_ms"] = listed / count;
    state.counters["upload_ms"] = uploaded / count;
    state.counters["fps"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
    state.counters["world_bytes"] = static_cast<double>(last.world_bytes);
    state.counters["state_bytes"] = static_cast<double>(last.state_bytes);
    state.counters["triangles"] = static_cast<double>(last.triangles);
    state.counters["calls"] = static_cast<double>(last.draw_calls);
}

constexpr PictureSize kSize{1280, 720};

/// Once around in 120 frames.
ViewState seen_from(std::size_t frame) {
    ViewState view;
    view.camera.preset = CameraPreset::free;
    view.camera.yaw_deg = 3.0 * static_cast<double>(frame);
    return view;
}

/// All that the window does to show the scene from another side.
void orbit(benchmark::State& state, int agents, Backend backend) {
    KeptPaths paths = paths_of(bench::crowd(agents));
    frames(state, backend,
           [&](std::size_t frame) { return build_draw_list(paths, seen_from(frame), {.size = kSize}); });
}

/// The least that it could do: the same buffers, passes, targets and blending, and nothing but another projection.
void bare(benchmark::State& state, int agents, Backend backend) {
    KeptPaths paths = paths_of(bench::crowd(agents));
    std::vector<DrawList> lists;
    for (std::size_t frame = 0; frame < 120; ++frame) {
        DrawList list = build_draw_list(paths, seen_from(frame), {.size = kSize});
        list.texts.clear();
        list.panels.clear();
        list.marks.clear();
        list.overlay_lines.clear();
        lists.push_back(std::move(list));
    }
    frames(state, backend, [&](std::size_t frame) { return lists[frame % lists.size()]; });
}

/// A notch of the wheel: where the camera is, and where it goes. No draw list is made of it.
void zoom_step(benchmark::State& state, int agents) {
    KeptPaths paths = paths_of(bench::crowd(agents));
    ViewState view;
    for (auto _ : state) {
        const PictureFrame frame = picture_frame(paths, view, {.size = kSize});
        benchmark::DoNotOptimize(zoomed(frame.camera, 1.15, {640, 360}, kSize));
    }
}

/// Two clips of 60,000 samples.
void scrub(benchmark::State& state, bool steps, Backend backend) {
    Scene scene = bench::pair(2000);
    if (!steps) scene.view.query.reset();
    KeptPaths paths = paths_of(std::move(scene));
    frames(state, backend, [&](std::size_t frame) {
        ViewState view = paths.fitted()->scene().view;
        if (steps) view.step = {Step::Unit::percent, static_cast<double>(frame % 100)};
        if (!steps) view.time = 100 + 0.1 * static_cast<double>(frame);
        return build_draw_list(paths, view, {.size = kSize});
    });
}

template <class Body, class... Arguments>
void add(const std::string& name, Body body, Arguments... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), body, arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void add_all() {
    add("zoom_step/1000_agents", zoom_step, 1000);
    for (const auto& [name, backend] : {std::pair("osmesa", Backend::osmesa), std::pair("egl", Backend::egl)}) {
        try {
            const Renderer possible(backend);
        } catch (const MachineError& error) {
            std::cerr << name << " is left out: " << error.what() << "\n";
            continue;
        }
        for (const int agents : {100, 1000}) {
            const std::string what = std::to_string(agents) + "_agents/" + name;
            add("orbit/" + what, orbit, agents, backend);
            add("bare/" + what, bare, agents, backend);
        }
        add(std::string("scrub/2x60000/") + name, scrub, false, backend);
        add(std::string("step/2x60000/") + name, scrub, true, backend);
    }
}

}  // namespace
}  // namespace mobbscope

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    mobbscope::add_all();
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return 0;
}
