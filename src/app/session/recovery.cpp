#include <app/session/recovery.h>
#include <base/error.h>
#include <base/file.h>
#include <base/lock.h>
#include <base/text.h>

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <limits>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

namespace fs = std::filesystem;

constexpr double kWhenChanged = std::numeric_limits<double>::infinity();
constexpr const char* kGone = ".gone";            // of a window's folder that is being removed
constexpr const char* kScene = "scene";           // as unsaved_works calls it
constexpr std::chrono::seconds kCopyPatience{5};  // with a copy that is being written

/// "14:31"; of another day than `now` with its date.
std::string time_text(std::time_t time, std::time_t now) {
    std::tm at{};
    std::tm today{};
    ::localtime_r(&time, &at);
    ::localtime_r(&now, &today);
    const bool same_day = at.tm_yday == today.tm_yday && at.tm_year == today.tm_year;
    std::array<char, 64> text{};
    const std::size_t length = std::strftime(text.data(), text.size(), same_day ? "%H:%M" : "%Y-%m-%d %H:%M", &at);
    return {text.data(), length};
}

/// Whether that lock is on what has the name now.
bool is_on(const Descriptor& lock, const fs::path& folder) {
    struct stat locked {};
    struct stat named {};
    return lock.is_open() && ::fstat(lock.get(), &locked) == 0 && ::stat(folder.c_str(), &named) == 0 &&
           locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
}

}  // namespace

Recovery::~Recovery() = default;

std::map<std::string, UnsavedWork> Recovery::works() const {
    const Workspace* suspended = files_.suspended();
    std::map<std::string, UnsavedWork> out = unsaved_works(suspended ? *suspended : workspace_);
    if (!suspended) return out;
    for (auto& [name, work] : unsaved_works(workspace_)) out["visited-" + name] = std::move(work);
    return out;
}

double Recovery::poll(double now) {
    if (folder_.empty()) return kWhenChanged;
    if (writing_ && writing_->job->done()) end_writing(now);
    const std::map<std::string, UnsavedWork> wanted = works();
    if (!writing_) {
        std::erase_if(copies_, [&](const auto& known) {
            if (wanted.contains(known.first)) return false;
            remove(known.first);
            return true;
        });
    }
    double next = kWhenChanged;
    for (const auto& [name, work] : wanted) {
        Copy& copy = copies_[name];
        if (same_state(copy.written, work)) {
            copy.first_change.reset();
            continue;
        }
        if (!same_state(copy.seen, work)) {
            copy.seen = work;
            copy.changed = now;
        }
        if (!copy.first_change && !same_scene(copy.written, work)) copy.first_change = now;
        // Looking around and playing can wait until they end.
        const double due =
            std::min(copy.changed + kPause, copy.first_change ? *copy.first_change + kLongest : kWhenChanged);
        const double wait = std::max(due, copy.next_try) - now;
        if (wait > 0) {
            next = std::min(next, wait);
        } else if (!writing_) {
            begin_writing(name, work, now);
        }
    }
    return next;
}

void Recovery::make_own_folder() {
    std::error_code error;
    if (!own_.empty() && fs::exists(own_, error)) return;
    fs::create_directories(folder_, error);
    for (int i = 1;; ++i) {
        const fs::path own = folder_ / std::to_string(i);
        if (::mkdir(own.c_str(), S_IRWXU) != 0) {
            if (errno == EEXIST) continue;
            throw MachineError(own.string() + ": " + std::generic_category().message(errno));
        }
        // A window that looks for copies holds it for a moment, and may have removed it.
        Descriptor lock = lock_folder(own, std::chrono::seconds(1));
        if (lock.is_open() ? !is_on(lock, own) : !fs::exists(own, error)) continue;
        own_ = own;
        lock_ = std::move(lock);
        return;
    }
}

void Recovery::remove(const std::string& name) const {
    std::error_code ignored;
    if (!own_.empty()) fs::remove(file_of(name), ignored);
}

void Recovery::begin_writing(const std::string& name, const UnsavedWork& work, double now) {
    copies_[name].written = work;
    copies_[name].first_change.reset();
    try {
        make_own_folder();
    } catch (const MachineError& error) {
        return note_failure(name, error.what(), now);
    }
    const auto write = [work, file = file_of(name)](JobControl&) -> Job::Finish {
        write_to_disk(file, unsaved_text(work, std::time(nullptr)));
        return {};
    };
    const auto wake = [&desktop = *desktop_] { desktop.wake(); };
    writing_ = Writing{name, std::make_unique<Job>("Keeping a copy", write, wake)};
}

void Recovery::end_writing(double now) {
    const Writing done = std::move(*writing_);
    writing_.reset();
    try {
        done.job->finish();
        failed_ = false;
    } catch (const std::exception& error) {
        note_failure(done.name, error.what(), now);
    }
}

void Recovery::note_failure(const std::string& name, const std::string& why, double now) {
    copies_[name].written = {};
    copies_[name].next_try = now + kLongest;
    if (std::exchange(failed_, true)) return;
    notifications_.tell_of_window(MessageLevel::warning, "No copy of unsaved work can be kept, so save it: " + why);
}

bool Recovery::keep_now() {
    if (folder_.empty()) return false;
    if (writing_ && writing_->job->wait(kCopyPatience)) end_writing(0);
    bool any = false;
    for (const auto& [name, work] : works()) {
        if (!same_state(copies_[name].written, work)) {
            try {
                make_own_folder();
                write_to_disk(file_of(name), unsaved_text(work, std::time(nullptr)));
                copies_[name].written = work;
            } catch (const std::exception&) {
                // The copy before is left, if there is one.
            }
        }
        std::error_code ignored;
        any |= !own_.empty() && fs::exists(file_of(name), ignored);
    }
    return any;
}

void Recovery::end_work() {
    if (writing_) writing_->job->cancel();
}

void Recovery::discard_own() {
    writing_.reset();
    copies_.clear();
    if (own_.empty()) return;
    std::error_code error;
    fs::path gone = own_;
    gone += kGone;
    // A copy that is still being written finds no folder.
    fs::rename(own_, gone, error);
    fs::remove_all(error ? own_ : gone, error);
    own_.clear();
    lock_.close();
}

void Recovery::look() {
    std::vector<fs::path> folders;
    std::error_code error;
    for (fs::directory_iterator at(folder_, error); !error && at != fs::directory_iterator(); at.increment(error))
        folders.push_back(at->path());
    std::ranges::sort(folders);
    std::vector<Left> found;
    for (const fs::path& of_window : folders) look_in(of_window, found);
    // What another window has taken is offered no more.
    for (const Left& before : std::exchange(left_, found)) {
        if (std::ranges::find(found, before.copy, &Left::copy) == found.end()) forget(before.name);
    }
}

void Recovery::look_in(const fs::path& of_window, std::vector<Left>& found) {
    if (of_window == own_) return;
    const Descriptor lock = lock_folder(of_window, {});
    // It lives.
    if (!is_on(lock, of_window)) return;
    std::error_code error;
    if (of_window.extension() == kGone) fs::remove_all(of_window, error);
    std::vector<fs::path> copies;
    for (fs::directory_iterator at(of_window, error); !error && at != fs::directory_iterator(); at.increment(error)) {
        if (at->path().extension() == kExtension) copies.push_back(at->path());
    }
    std::ranges::sort(copies);
    for (const fs::path& copy : copies) {
        const auto known = std::ranges::find(left_, copy, &Left::copy);
        found.push_back(known != left_.end() ? *known : offered(copy, found));
    }
    // Not where it holds anything else.
    if (copies.empty()) fs::remove(of_window, error);
}

Recovery::Left Recovery::offered(const fs::path& copy, const std::vector<Left>& others) {
    Left out{"", copy};
    std::string wrong;
    try {
        const UnsavedHead head = read_unsaved_head(copy);
        out.name = head.title + " from " + time_text(head.time, std::time(nullptr));
    } catch (const InputError& error) {
        out.name = copy.string();
        wrong = error.what();
    }
    const std::string name = out.name;
    const auto taken = [&](const std::vector<Left>& in) {
        return std::ranges::find(in, out.name, &Left::name) != in.end();
    };
    for (int i = 2; taken(others) || taken(left_); ++i) out.name = name + " (" + std::to_string(i) + ")";
    const MessageOffer discard{"file.discard_unsaved", out.name, "Discard"};
    if (!wrong.empty()) {
        notifications_.tell_of_window(MessageLevel::warning,
                                      "A copy of unsaved work cannot be read, and is kept: " + wrong, {discard});
    } else {
        notifications_.tell_of_window(MessageLevel::warning, "Unsaved work on " + out.name,
                                      {{"file.recover", out.name, "Restore"}, discard});
    }
    return out;
}

const Recovery::Left& Recovery::find(const std::string& name) const {
    const auto left = std::ranges::find(left_, name, &Left::name);
    if (left == left_.end()) throw InputError("there is no unsaved work " + in_quotes(name));
    return *left;
}

void Recovery::forget(const std::string& name) {
    std::erase_if(left_, [&](const Left& left) { return left.name == name; });
    notifications_.dismiss_offers("file.discard_unsaved", name);
}

void Recovery::restore(const std::string& name) {
    const fs::path copy = find(name).copy;
    const auto lock = std::make_shared<Descriptor>(taken(name));
    files_.open_unsaved(copy, name, [this, name, copy, lock] {
        adopt(copy);
        forget(name);
        notifications_.tell(MessageLevel::info, "Restored " + name + "; it is not saved yet");
    });
}

void Recovery::discard(const std::string& name) {
    const fs::path copy = find(name).copy;
    const Descriptor lock = taken(name);
    std::error_code error;
    fs::remove(copy, error);
    if (error) throw MachineError(copy.string() + ": cannot be removed: " + error.message());
    fs::remove(copy.parent_path(), error);
    forget(name);
    notifications_.tell(MessageLevel::info, "Discarded the unsaved work on " + name);
}

Descriptor Recovery::taken(const std::string& name) {
    const fs::path copy = find(name).copy;
    std::error_code ignored;
    if (!fs::exists(copy, ignored)) {
        forget(name);
        throw InputError(name + ": another window has taken it");
    }
    Descriptor lock = lock_folder(copy.parent_path(), {});
    if (!lock.is_open()) throw InputError(name + ": it is being restored already");
    return lock;
}

void Recovery::adopt(const fs::path& copy) {
    if (writing_ && writing_->job->wait(kCopyPatience)) end_writing(0);
    try {
        make_own_folder();
    } catch (const MachineError&) {
        return;  // said when the next copy is written
    }
    std::error_code error;
    fs::rename(copy, file_of(kScene), error);
    if (!error) copies_[kScene].written = works()[kScene];
    fs::remove(copy.parent_path(), error);
}

}  // namespace mobbscope::app
