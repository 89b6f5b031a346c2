#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/program.h>
#include <cli/render_outputs.h>
#include <render/image/picture_names.h>

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
    if (!outputs.image.empty()) check_file_name(outputs.image);
    const bool is_named = outputs.image.empty() || is_picture_name(outputs.image) || is_film_name(outputs.image);
    if (!is_named) throw InputError(outputs.image, std::string(kPictureAndFilmNames));
    check_name(outputs.ids, ".png", "object ids");
    check_name(outputs.draw_list, ".json", "draw lists");
}

RenderOutputs numbered(const RenderOutputs& outputs, int number, int digits) {
    // A film has all of its pictures.
    const fs::path image = is_film_name(outputs.image) ? fs::path() : numbered(outputs.image, number, digits);
    return {image, numbered(outputs.ids, number, digits), numbered(outputs.draw_list, number, digits)};
}

void OutputCheck::writes(const RenderOutputs& outputs) {
    for (const fs::path& output : outputs.all()) {
        check_output(output);
        std::error_code ignored;
        const fs::file_status status = fs::status(output, ignored);
        const bool stream = fs::exists(status) && !fs::is_regular_file(status);
        if (!stream && !written_.insert(meant(output).string()).second) {
            throw InputError(output, "would be written twice; give each output a name of its own");
        }
    }
}

}  // namespace mobbscope::cli
