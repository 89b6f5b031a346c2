#include <cli/command_line.h>
#include <cli/render_case.h>
#include <cli/usage_error.h>
#include <guard/case_file.h>
#include <guard/picture_maker.h>
#include <import/error.h>
#include <render/png.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace mobbscope::cli {

namespace {

void refuse_other_options(const Command& command) {
    for (const GivenOption& given : command.given()) {
        if (given.name == "FILE" || given.name == "--output" || given.name == "--backend") continue;
        throw InputError(given.name + ": a case says by itself how it is drawn; leave it out");
    }
}

}  // namespace

bool is_case(const std::filesystem::path& file) { return file.filename().string().ends_with(".case.json"); }

void render_case(const Command& command, const RenderArguments& arguments) {
    check_names(arguments.outputs);
    refuse_other_options(command);
    if (arguments.outputs.image.empty()) throw UsageError("--output is required");
    const guard::Case drawn = guard::read_case(arguments.file);
    if (drawn.skip) throw InputError(arguments.file.string(), "", "the case is skipped: " + *drawn.skip);
    OutputCheck outputs;
    outputs.reads(arguments.file);
    outputs.reads(drawn.shot.panels.front().fitted->scene());
    outputs.writes(arguments.outputs);
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.outputs.image, guard::CaseFile{{}, arguments.file}.golden(), ignored)) {
        throw InputError(arguments.outputs.image.string(), "",
                         "is the golden of this case; mobbscope test --update takes it, or give another output");
    }
    guard::PictureMaker maker(arguments.backend.value_or(Backend::automatic));
    write_png(arguments.outputs.image, maker.make(drawn.shot));
}

}  // namespace mobbscope::cli
