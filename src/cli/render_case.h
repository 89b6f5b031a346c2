/// `render NAME.case.json -o OUT.png`: the picture of a test case.
#pragma once

#include <cli/render_options.h>

#include <filesystem>

namespace mobbscope::cli {

/// By the file's name.
bool is_case(const std::filesystem::path& file);

/// Draws it as `mobbscope test` does. Throws InputError if `command` was given options that the case decides on.
void render_case(const Command& command, const RenderArguments& arguments);

}  // namespace mobbscope::cli
