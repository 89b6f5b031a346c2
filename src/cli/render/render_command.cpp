#include <base/error.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/program.h>
#include <cli/render/render_job.h>
#include <cli/render/render_options.h>
#include <render/gl/backends.h>
#include <render/pictures/draw_a_little.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

namespace mobbscope::cli {

namespace {

struct RenderCommandArguments {
    RenderArguments render;
    std::filesystem::path batch;
    bool list_backends = false;
    bool json = false;
    bool progress = false;
};

void print_words(const std::vector<BackendReport>& backends) {
    for (const BackendReport& backend : backends) {
        std::cout << backend.name << ": "
                  << cleaned(backend.works ? "OpenGL " + backend.version + ", " + backend.renderer
                                           : "not here: " + backend.why_not)
                  << '\n';
    }
}

void print_backends_json(const std::vector<BackendReport>& backends) {
    JsonWriter json(std::cout);
    json.begin_object();
    json.list("backends", backends, [&](const BackendReport& backend) {
        json.begin_object();
        json.members("name", backend.name, "works", backend.works);
        if (backend.works) {
            json.members("version", backend.version, "renderer", backend.renderer);
        } else {
            json.member("why_not", backend.why_not);
        }
        json.end_object();
    });
    json.end_object();
}

/// On standard output, in words or as JSON. Throws MachineError if none works.
void list_backends(bool json) {
    const std::vector<BackendReport> backends = report_backends(draw_a_little);
    json ? print_backends_json(backends) : print_words(backends);
    flush_results();
    const bool any = std::any_of(backends.begin(), backends.end(), [](const BackendReport& b) { return b.works; });
    if (!any) throw MachineError("no OpenGL 3.3 context without a display; see above which libraries were tried");
}

void render_one(const RenderArguments& arguments, bool progress) {
    RenderPlan plan(progress);
    plan.add(arguments);
    OutputCheck outputs;
    plan.check_outputs(0, outputs);
    plan.draw(arguments.backend.value_or(Backend::automatic));
}

void run_render(const Command& command, const RenderCommandArguments& arguments) {
    if (arguments.json && !arguments.list_backends) throw InputError("--json needs --list-backends");
    if (arguments.list_backends) {
        list_backends(arguments.json);
    } else if (!arguments.batch.empty()) {
        render_batch(arguments.batch, arguments.render, arguments.progress);
    } else if (is_case(arguments.render.file)) {
        render_case(command, arguments.render);
    } else {
        render_one(arguments.render, arguments.progress);
    }
}

void add_options_of_render(Command& command, RenderCommandArguments& arguments) {
    add_render_options(command, arguments.render);
    constexpr const char* kGroup = "Many pictures in one process";
    command
        .add_option("--batch", arguments.batch,
                    "A text file with the arguments of one picture a line; - is standard input. Options beside it hold "
                    "for every line",
                    "LIST")
        .group(kGroup);
    command
        .add_flag("--progress", arguments.progress,
                  "Say several times a second how many pictures are drawn, for a program that waits")
        .group(kGroup);
    command.add_flag("--list-backends", arguments.list_backends, "Say what this machine can draw with, and stop");
    command.add_flag("--json", arguments.json, "With --list-backends: as JSON");
}

}  // namespace

void add_render_command(Command& program) {
    program.add_subcommand("render", "Draw a scene into pictures, without a display", add_options_of_render,
                           run_render);
}

}  // namespace mobbscope::cli
