#include <app/document/file_preview.h>

#include <chrono>
#include <exception>
#include <limits>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

/// Who goes through a list does not want every file read.
constexpr double kMoment = 0.12;
constexpr std::size_t kMostKnown = 500;

}  // namespace

const FileSummary* FilePreview::ask(const std::filesystem::path& file, double now, bool wait,
                                    const std::function<void()>& wake) {
    if (reading_ && (wait || reading_->done())) take_in();
    std::error_code ignored;
    Known facts;
    facts.written = std::filesystem::last_write_time(file, ignored);
    if (!std::filesystem::is_directory(file, ignored)) facts.size = std::filesystem::file_size(file, ignored);
    const auto same = [&](const Known& known) { return known.size == facts.size && known.written == facts.written; };
    const auto known = known_.find(file);
    if (known != known_.end() && same(known->second)) return &known->second.summary;
    if (std::exchange(asked_, file) != file) asked_at_ = now;
    // One that is under way cannot be stopped in the midst of a file: the next one waits for it.
    if (reading_ || (!wait && now < asked_at_ + kMoment)) return nullptr;
    const auto work = [this, file, facts](JobControl& control) -> Job::Finish {
        Known read = facts;
        try {
            read.summary = summary_of(file, [&](std::size_t done, std::size_t all) { control.step(done, all); });
        } catch (const Cancelled&) {
            throw;
        } catch (const std::exception& error) {
            read.summary.readable = false;
            read.summary.title = error.what();
        }
        return [this, file, read] {
            if (known_.size() >= kMostKnown) known_.clear();
            known_[file] = read;
        };
    };
    reading_ = std::make_unique<Job>("Reading " + file.filename().string(), work, wake);
    if (!wait) return nullptr;
    take_in();
    const auto found = known_.find(file);
    return found == known_.end() ? nullptr : &found->second.summary;
}

double FilePreview::ask_again_in(double now) const {
    const double left = asked_at_ + kMoment - now;
    return !reading_ && left > 0 ? left : std::numeric_limits<double>::infinity();
}

void FilePreview::take_in() {
    while (!reading_->wait(std::chrono::hours(1))) continue;
    std::exchange(reading_, nullptr)->finish();
}

}  // namespace mobbscope::app
