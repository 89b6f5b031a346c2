#include <cli/render_outputs.h>
#include <import/error.h>
#include <import/file.h>
#include <import/text.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

namespace mobbscope::cli {

namespace {

namespace fs = std::filesystem;

void check_name(const fs::path& file, const char* extension, const char* what) {
    if (file.empty()) return;
    check_file_name(file);
    if (lower_extension(file) == extension) return;
    throw InputError(file.string(), "", std::string(what) + " are written as " + extension + "; rename the output");
}

fs::path numbered(const fs::path& file, int number, int digits) {
    if (file.empty()) return {};
    const std::string text = std::to_string(number);
    const std::size_t zeros =
        static_cast<std::size_t>(digits) - std::min(static_cast<std::size_t>(digits), text.size());
    return file.parent_path() /
           (file.stem().string() + '_' + std::string(zeros, '0') + text + file.extension().string());
}

/// The file that a name means, through links; the name itself where that cannot be told.
fs::path meant(const fs::path& file) {
    // A bare name has no folder of its own until it is made absolute.
    const fs::path absolute = fs::absolute(file);
    std::error_code error;
    const fs::path target = fs::weakly_canonical(absolute, error);
    return error ? absolute : target;
}

void check_writable(const fs::path& output) {
    const auto refuse = [&](const std::string& why) {
        throw MachineError(output.string() + ": cannot be written: " + why);
    };
    std::error_code error;
    if (fs::is_directory(output, error)) refuse("is a folder");
    const fs::path target = meant(output);
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, error)) refuse("there is no folder " + in_quotes(folder.string()));
    const bool there = fs::exists(target, error);
    if (there && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) refuse("it is write-protected");
    // What is no regular file is written in place.
    if (there && !fs::is_regular_file(target, error)) return;
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
        refuse("its folder " + in_quotes(folder.string()) + " is write-protected");
    }
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
