#include <base/error.h>
#include <cli/command_line.h>
#include <cli/commands.h>
#include <cli/render/list_backends.h>
#include <cli/render/render_batch.h>
#include <cli/render/render_job.h>
#include <cli/render/render_options.h>

#include <filesystem>
#include <memory>

namespace mobbscope::cli {

namespace {

struct RenderCommandArguments {
    RenderArguments render;
    std::filesystem::path batch;
    bool list_backends = false;
    bool json = false;
};

void render_one(const RenderArguments& arguments) {
    RenderPlan plan;
    plan.add(arguments);
    OutputCheck outputs = plan.sources();
    RenderPlan::check_outputs(plan.jobs().front(), outputs);
    plan.draw(arguments.backend.value_or(Backend::automatic));
}

void run_render(const Command& command, const RenderCommandArguments& arguments) {
    if (arguments.json && !arguments.list_backends) throw InputError("--json: it is of --list-backends");
    if (arguments.list_backends) {
        list_backends(arguments.json);
    } else if (!arguments.batch.empty()) {
        render_batch(arguments.batch, arguments.render);
    } else if (is_case(arguments.render.file)) {
        render_case(command, arguments.render);
    } else {
        render_one(arguments.render);
    }
}

}  // namespace

void add_render_command(Command& program) {
    Command& command = program.add_subcommand("render", "Draw a scene into pictures, without a display");
    const auto arguments = std::make_shared<RenderCommandArguments>();
    add_render_options(command, arguments->render);
    constexpr const char* kGroup = "Many pictures in one process";
    command
        .add_option("--batch", arguments->batch,
                    "A text file with the arguments of one picture a line; - is standard input. Options beside it hold "
                    "for every line",
                    "LIST")
        .group(kGroup);
    command.add_flag("--list-backends", arguments->list_backends, "Say what this machine can draw with, and stop");
    command.add_flag("--json", arguments->json, "With --list-backends: as JSON");
    command.callback([&command, arguments] { run_render(command, *arguments); });
}

}  // namespace mobbscope::cli
