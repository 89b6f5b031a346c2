#include <base/error.h>
#include <base/file.h>
#include <cases/golden_change.h>

#include <cstddef>
#include <exception>
#include <string>
#include <system_error>

namespace mobbscope::picture_tests {

namespace {

void write_one(const GoldenChange& change) {
    if (change.bytes) {
        make_folder_of(change.file);  // of a new case it may be new too
        return write_file(change.file, *change.bytes);
    }
    std::error_code error;
    std::filesystem::remove(change.file, error);
    if (error) throw MachineError(change.file.string() + ": cannot be removed: " + error.message());
}

/// Takes back what was written, the last first. Returns the files that could not be: "a.png, b.png"; empty if all were.
std::string put_back(std::span<const GoldenChange> written) {
    std::string left;
    const std::vector<GoldenChange> changes = taken_back(written);
    for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
        try {
            write_one(*change);
        } catch (const std::exception&) {
            left += (left.empty() ? "" : ", ") + change->file.string();
        }
    }
    return left;
}

}  // namespace

std::optional<std::string> golden_bytes(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return std::nullopt;
    return read_file(file);
}

void make_folder_of(const std::filesystem::path& file) {
    const std::filesystem::path folder = file.parent_path();
    if (folder.empty()) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw MachineError(folder.string() + ": cannot be made: " + error.message());
}

std::vector<GoldenChange> taken_back(std::span<const GoldenChange> changes) {
    std::vector<GoldenChange> out;
    for (const GoldenChange& change : changes) out.push_back({change.file, change.replaces, change.bytes});
    return out;
}

void write_goldens(std::span<const GoldenChange> changes) {
    for (const GoldenChange& change : changes) {
        check_stays_in_folder(change.file);
        if (golden_bytes(change.file) == change.replaces) continue;
        throw InputError(change.file.string(), "",
                         "has changed on the disk since the case was drawn; run the case again and look at it");
    }
    for (std::size_t done = 0; done < changes.size(); ++done) {
        try {
            write_one(changes[done]);
        } catch (const std::exception& error) {
            const std::string left = put_back(changes.first(done));
            if (left.empty()) throw;
            throw MachineError(std::string(error.what()) + "; changed already, and cannot be put back: " + left);
        }
    }
}

}  // namespace mobbscope::picture_tests
