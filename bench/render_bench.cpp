/// What a frame of the window costs: a crowd on 30 x 40 m with boxes and disks, seen from another side each time.
#include "crowd.h"

#include <base/error.h>
#include <render/gl/renderer.h>
#include <render/pictures/build_draw_list.h>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <iostream>
#include <string>
#include <utility>

namespace mobbscope {
namespace {

/// Once around in 120 frames.
ViewState seen_from(std::size_t frame) {
    ViewState view;
    view.camera.preset = CameraPreset::free;
    view.camera.yaw_deg = 3.0 * static_cast<double>(frame);
    return view;
}

struct Case {
    int agents;
    PictureSize size;

    std::string name() const {
        return std::to_string(agents) + "_agents/" + std::to_string(size.width) + "x" + std::to_string(size.height);
    }
};

void build(benchmark::State& state, const Case& what) {
    const FittedScene fitted(bench::crowd(what.agents), {});
    std::size_t frame = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(build_draw_list(fitted, seen_from(frame++), what.size));
    }
}

void paint(benchmark::State& state, const Case& what, Backend backend) {
    const FittedScene fitted(bench::crowd(what.agents), {});
    Renderer renderer(backend);
    std::size_t frame = 0;
    for (auto _ : state) {
        state.PauseTiming();
        const DrawList list = build_draw_list(fitted, seen_from(frame++), what.size);
        state.ResumeTiming();
        renderer.paint(list, 1);
        glFinish();
    }
}

/// All that the window does to show the scene from another side.
void frame(benchmark::State& state, const Case& what, Backend backend) {
    const FittedScene fitted(bench::crowd(what.agents), {});
    Renderer renderer(backend);
    std::size_t frame = 0;
    for (auto _ : state) {
        renderer.paint(build_draw_list(fitted, seen_from(frame++), what.size), 1);
        glFinish();
    }
    state.counters["fps"] = benchmark::Counter(static_cast<double>(frame), benchmark::Counter::kIsRate);
}

template <class Body, class... Arguments>
void add(const std::string& name, Body body, Arguments... arguments) {
    benchmark::RegisterBenchmark(name.c_str(), body, arguments...)->Unit(benchmark::kMillisecond)->UseRealTime();
}

void add_all() {
    for (const Case& what : {Case{100, {1280, 720}}, Case{100, {850, 560}}, Case{1000, {1280, 720}}}) {
        add("build/" + what.name(), build, what);
        for (const auto& [name, backend] : {std::pair("osmesa", Backend::osmesa), std::pair("egl", Backend::egl)}) {
            try {
                const Renderer possible(backend);
            } catch (const MachineError& error) {
                std::cerr << name << " is left out: " << error.what() << "\n";
                continue;
            }
            add("paint/" + what.name() + "/" + name, paint, what, backend);
            add("frame/" + what.name() + "/" + name, frame, what, backend);
        }
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
