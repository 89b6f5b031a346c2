#include <picture_tests/goldens.h>

#include <base/error.h>
#include <base/file.h>
#include <render/image/png.h>

#include <system_error>

namespace mobbscope::picture_tests {

void make_folder_of(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    if (folder.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw MachineError(folder.string() + ": cannot be made: " + error.message());
}

std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder) {
    const std::filesystem::path stem = folder / result.file.name;
    if (result.outcome != CaseOutcome::passed && !result.actual.rgba.empty()) make_folder_of(stem);
    std::vector<std::filesystem::path> written;
    const auto keep = [&](const char* what, const Image* image) {
        const std::filesystem::path file = stem.string() + "." + what + ".png";
        if (result.outcome == CaseOutcome::passed || !image || image->rgba.empty()) {
            std::error_code ignored;
            std::filesystem::remove(file, ignored);
            return;
        }
        write_png(file, *image);
        written.push_back(file);
    };
    keep("actual", &result.actual);
    keep("golden", &result.golden);
    keep("heat", result.image ? &result.image->heat : nullptr);
    return written;
}

std::vector<std::filesystem::path> take(CaseResult& result) {
    std::vector<std::filesystem::path> written;
    for (const FreshGolden& golden : result.fresh) {
        write_file(golden.file, golden.bytes);
        written.push_back(golden.file);
    }
    result.fresh.clear();
    result.golden = {};
    result.image = diff(result.actual, result.actual, diff_options(result.tolerance));
    result.image->heat = {};
    result.outcome = CaseOutcome::passed;
    result.message.clear();
    return written;
}

}  // namespace mobbscope::picture_tests
