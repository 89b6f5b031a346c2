#include <guard/goldens.h>

#include <import/error.h>
#include <render/png.h>

#include <system_error>

namespace mobbscope::guard {

std::vector<std::filesystem::path> keep_pictures(const CaseResult& result, const std::filesystem::path& folder) {
    const std::filesystem::path stem = folder / result.file.name;
    std::error_code error;
    std::filesystem::create_directories(stem.parent_path(), error);
    if (error) throw MachineError(stem.parent_path().string() + ": cannot be made: " + error.message());
    std::vector<std::filesystem::path> written;
    const auto keep = [&](const char* what, const Image* image) {
        const std::filesystem::path file = stem.string() + "." + what + ".png";
        if (!image || image->rgba.empty()) {
            std::filesystem::remove(file, error);
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

bool can_be_taken(const CaseResult& result) {
    return result.outcome == Outcome::different || result.outcome == Outcome::missing_golden;
}

std::vector<std::filesystem::path> take(CaseResult& result) {
    std::vector<std::filesystem::path> written;
    if (!result.image || !result.image->same) {
        write_png(result.file.golden(), result.actual);
        written.push_back(result.file.golden());
    }
    result.golden = result.actual;
    result.outcome = Outcome::passed;
    result.message.clear();
    return written;
}

}  // namespace mobbscope::guard
