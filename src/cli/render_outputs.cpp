#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/program.h>
#include <cli/render_outputs.h>

#include <algorithm>
#include <system_error>

namespace mobbscope::cli {

namespace {

namespace fs = std::filesystem;

void check_name(const fs::path& file, const char* extension, const char* what) {
    if (file.empty()) return;
    check_file_name(file);
    check_extension(file, extension, std::string(what) + " are written as " + extension + "; rename the output");
}

fs::path numbered(const fs::path& file, int number, int digits) {
    if (file.empty()) return {};
    const std::string text = std::to_string(number);
    const std::size_t zeros =
        static_cast<std::size_t>(digits) - std::min(static_cast<std::size_t>(digits), text.size());
    return file.parent_path() /
           (file.stem().string() + '_' + std::string(zeros, '0') + text + file.extension().string());
}

}  // namespace

std::vector<fs::path> RenderOutputs::all() const {
    std::vector<fs::path> out{image, ids, draw_list};
    std::erase_if(out, [](const fs::path& file) { return file.empty(); });
    return out;
}

void check_names(const RenderOutputs& outputs) {
    check_name(outputs.image, ".png", "pictures");
    check_name(outputs.ids, ".png", "object ids");
    check_name(outputs.draw_list, ".json", "draw lists");
}

RenderOutputs numbered(const RenderOutputs& outputs, int number, int digits) {
    return {numbered(outputs.image, number, digits), numbered(outputs.ids, number, digits),
            numbered(outputs.draw_list, number, digits)};
}

void OutputCheck::reads(const fs::path& file) { sources_.push_back(file); }

void OutputCheck::reads(const Scene& scene) {
    reads(scene.file);
    for (const SceneClip& clip : scene.clips) {
        if (clip.source) reads(scene.file.parent_path() / *clip.source);
    }
}

void OutputCheck::writes(const RenderOutputs& outputs) {
    for (const fs::path& output : outputs.all()) {
        std::error_code ignored;
        // Most outputs are new: those replace nothing.
        const bool there = fs::exists(output, ignored);
        for (const fs::path& source : sources_) {
            if (!there || !fs::equivalent(output, source, ignored)) continue;
            throw InputError(output.string(), "",
                             "the picture would replace " + in_quotes(source.string()) +
                                 ", which it is made from; give another output");
        }
        const bool stream = there && !fs::is_regular_file(output, ignored) && !fs::is_directory(output, ignored);
        if (!stream && !written_.insert(meant(output).string()).second) {
            throw InputError(output.string(), "", "would be written twice; give each output a name of its own");
        }
        check_writable(output);
    }
}

}  // namespace mobbscope::cli
