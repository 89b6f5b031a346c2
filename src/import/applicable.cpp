#include <base/file.h>
#include <import/applicable.h>
#include <import/tracks/tracks.h>

namespace mobbscope {

std::string does_not_apply(const std::string& key, const std::filesystem::path& file) {
    // Of the units it is only this one.
    return (key == "unit" ? "unit auto" : key) + " does not apply to " + lower_extension(file) + " files";
}

ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file) {
    ApplicableOptions out{options, {}};
    const auto leave_out = [&out](auto& option, const char* key) {
        if (!option) return;
        option.reset();
        out.left_out.emplace_back(key);
    };
    const std::string extension = lower_extension(file);
    if (extension == ".csv" || is_track_extension(extension)) {
        leave_out(out.options.animation, "animation");
        leave_out(out.options.root, "root");
        leave_out(out.options.up, "up");
        // Without a body's height there is nothing to guess the unit from.
        if (extension == ".csv" && out.options.unit == "auto") leave_out(out.options.unit, "unit");
    } else {
        leave_out(out.options.id, "id");
        leave_out(out.options.dt, "dt");
    }
    return out;
}

}  // namespace mobbscope
