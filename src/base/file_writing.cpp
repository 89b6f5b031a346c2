// Whole files are written: into unfinished ones first, which then take their names.
#include <base/descriptor.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kUnfinished = ".mobbscope-";
constexpr std::time_t kLeftBehind = 60;  // seconds after which nobody is about to lock an unfinished file

// --- what was read

struct ReadFiles {
    std::mutex mutex;
    std::map<std::pair<dev_t, ino_t>, fs::path> names;
    std::vector<fs::path> not_taken;
};

ReadFiles& read_files() {
    static ReadFiles files;
    return files;
}

std::optional<std::pair<dev_t, ino_t>> identity(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return std::pair(status.st_dev, status.st_ino);
}

/// By which name a file was read, if it was.
std::optional<fs::path> name_when_read(const fs::path& file) {
    const auto present = identity(meant(file));
    if (!present) return std::nullopt;
    const std::lock_guard lock(read_files().mutex);
    const auto found = read_files().names.find(*present);
    // Of a file that is gone, a new one may have the number.
    if (found == read_files().names.end() || identity(found->second) != present) return std::nullopt;
    return found->second;
}

// --- names of unfinished files

}  // namespace

/// A name for a signal handler, which may neither allocate nor lock.
struct NameSlot {
    enum State : int { empty, changing, full };
    std::atomic<int> state{empty};
    pid_t process = 0;  ///< a child that was forked has the slots too, and not the files
    std::array<char, PATH_MAX> name{};
};
static_assert(std::atomic<int>::is_always_lock_free);

namespace {

constinit std::array<NameSlot, 16> slots;

/// Null if there is no room: then a signal leaves the file.
NameSlot* put_in_slot(const std::string& name) {
    if (name.size() >= PATH_MAX) return nullptr;
    for (NameSlot& slot : slots) {
        int expected = NameSlot::empty;
        if (!slot.state.compare_exchange_strong(expected, NameSlot::changing)) continue;
        slot.process = ::getpid();
        std::copy_n(name.c_str(), name.size() + 1, slot.name.begin());
        slot.state = NameSlot::full;
        return &slot;
    }
    return nullptr;
}

}  // namespace

/// A name that no file in the folder has. What has it is removed with this, unless it took another name.
class UnfinishedName {
  public:
    /// `make` creates the file and returns whether it could; EEXIST leads to another name.
    template <class Make>
    UnfinishedName(const fs::path& folder, const Make& make) {
        do {
            free_slot();
            name_ = folder / (std::string(kUnfinished) + std::to_string(::getpid()) + '-' + std::to_string(made_++));
            slot_ = put_in_slot(name_.native());
            if (make(name_.c_str())) return;
        } while (errno == EEXIST);
        error_ = errno;
        free_slot();
        name_.clear();
    }
    ~UnfinishedName() {
        if (!name_.empty()) ::unlink(name_.c_str());
        free_slot();
    }
    UnfinishedName(const UnfinishedName&) = delete;
    UnfinishedName& operator=(const UnfinishedName&) = delete;

    /// Why nothing was made; 0: it was.
    int error() const { return error_; }

    /// Takes the place of another file; false if it cannot: errno says why.
    bool rename_to(const fs::path& target) {
        if (std::rename(name_.c_str(), target.c_str()) != 0) return false;
        name_.clear();
        return true;
    }

    /// The other file has this name then, and is removed with it; false if they cannot.
    bool swap_with(const fs::path& other) const {
        return ::renameat2(AT_FDCWD, name_.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
    }

  private:
    void free_slot() {
        if (slot_) slot_->state = NameSlot::empty;
        slot_ = nullptr;
    }

    static inline std::atomic<unsigned> made_{0};
    fs::path name_;
    NameSlot* slot_ = nullptr;
    int error_ = 0;
};

namespace {

bool is_unfinished_name(std::string_view name) {
    if (!name.starts_with(kUnfinished)) return false;
    name.remove_prefix(kUnfinished.size());
    const std::size_t dash = name.find('-');
    if (dash == 0 || dash == std::string_view::npos || dash + 1 == name.size()) return false;
    return name.find('-', dash + 1) == std::string_view::npos &&
           name.find_first_not_of("-0123456789") == std::string_view::npos;
}

/// Whether nobody writes it any more: who does holds a lock, on whatever machine, until its process ends.
bool is_left_behind(int folder, const char* name) {
    struct stat status {};
    if (::fstatat(folder, name, &status, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(status.st_mode)) return false;
    if (status.st_uid != ::geteuid() || std::time(nullptr) - status.st_mtime < kLeftBehind) return false;
    const Descriptor file(::openat(folder, name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    return file.is_open() && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
}

/// What killed processes left in a folder; once for each folder.
void remove_left_behind(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    {
        const std::lock_guard lock(mutex);
        if (!seen.insert(folder).second) return;
    }
    const std::unique_ptr<DIR, int (*)(DIR*)> listed(::opendir(folder.c_str()), ::closedir);
    if (!listed) return;
    const int descriptor = ::dirfd(listed.get());
    while (const dirent* entry = ::readdir(listed.get())) {
        if (is_unfinished_name(entry->d_name) && is_left_behind(descriptor, entry->d_name))
            ::unlinkat(descriptor, entry->d_name, 0);
    }
}

// --- one file

MachineError unwritable(const fs::path& file, const std::string& why) {
    return MachineError(file.string() + ": cannot be written: " + why);
}

MachineError unwritable(const fs::path& file, int error) {
    return unwritable(file, std::generic_category().message(error));
}

void write_all(int descriptor, const FileBytes& wanted) {
    for (std::size_t done = 0; done < wanted.bytes.size();) {
        const ssize_t count = ::write(descriptor, wanted.bytes.data() + done, wanted.bytes.size() - done);
        if (count >= 0) {
            done += static_cast<std::size_t>(count);
        } else if (errno == EPIPE) {
            throw ReaderGone(wanted.file.string() + ": nobody reads from it any more");
        } else if (errno != EINTR) {
            throw unwritable(wanted.file, errno);
        }
    }
}

/// Of a pipe or a device; -1: errno says why it cannot be opened.
int open_waiting(const fs::path& file) {
    constexpr std::chrono::milliseconds kAskEvery{5};
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    for (;;) {
        const int descriptor = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
        if (descriptor >= 0 || errno != ENXIO || std::chrono::steady_clock::now() >= end) return descriptor;
        std::this_thread::sleep_for(kAskEvery);
    }
}

/// A pipe or a device, which must not be replaced by a file.
void write_stream(const FileBytes& wanted) {
    // Without a reader, opening a pipe would wait for ever; one that was started together with this is soon there.
    const Descriptor out(open_waiting(wanted.file));
    if (!out.is_open())
        throw errno == ENXIO ? unwritable(wanted.file, "nobody reads from it") : unwritable(wanted.file, errno);
    ::fcntl(out.get(), F_SETFL, O_WRONLY);
    write_all(out.get(), wanted);
}

/// The owner, and the rights of those that open the file; not those of its process, which set-user-id bits give.
void keep_owner_and_rights(int descriptor, const fs::path& file, const struct stat& replaced) {
    struct stat present {};
    if (::fstat(descriptor, &present) != 0) throw unwritable(file, errno);
    const bool same_owner = replaced.st_uid == present.st_uid && replaced.st_gid == present.st_gid;
    // Whoever may not give files away may still give them to a group.
    const bool kept_group = same_owner || ::fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0 ||
                            ::fchown(descriptor, static_cast<uid_t>(-1), replaced.st_gid) == 0;
    mode_t mode = replaced.st_mode & 0777;
    // Another group gets no more than everybody.
    if (!kept_group) mode &= ~static_cast<mode_t>(070) | (mode & 07) << 3;
    if (mode != (present.st_mode & 07777) && ::fchmod(descriptor, mode) != 0) throw unwritable(file, errno);
}

bool is_stream(const fs::path& file) {
    std::error_code ignored;
    const fs::file_status status = fs::status(file, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

/// A file that is written and does not yet stand where it is wanted.
class UnfinishedFile {
  public:
    UnfinishedFile(const fs::path& file, bool to_disk) : file_(file), target_(meant(file)), to_disk_(to_disk) {
        replaces_ = ::stat(target_.c_str(), &replaced_) == 0;
        if (!replaces_ && errno != ENOENT) throw unwritable(file_, errno);
        if (replaces_ && S_ISDIR(replaced_.st_mode)) throw unwritable(file_, "is a folder");
        // Renaming asks for rights over the folder alone, so a protected file would be replaced too.
        if (replaces_ && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) throw unwritable(file_, errno);
        remove_left_behind(folder());
        open();
        ::flock(descriptor_.get(), LOCK_EX | LOCK_NB);  // see is_left_behind
    }

    int descriptor() const { return descriptor_.get(); }

    /// All is written.
    void complete() {
        if (replaces_) keep_owner_and_rights(descriptor_.get(), file_, replaced_);
        // Else a loss of power after the renaming may leave an empty file in the place of the old one.
        if (is_synced() && ::fsync(descriptor_.get()) != 0 && errno != EINVAL) throw unwritable(file_, errno);
    }

    /// Gives it a name in its folder, which a file needs that is to replace another.
    void name_it() {
        if (name_) return;
        const std::string open_file = "/proc/self/fd/" + std::to_string(descriptor_.get());
        name_.emplace(folder(), [&](const char* name) {
            return ::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
        });
        if (name_->error() != 0) throw unwritable(file_, name_->error());
    }

    /// `with_return`: so that put_back can take it back, where the file system lets two files swap their names.
    void take_place(bool with_return) {
        if (with_return && replaces_) {
            // Under its other name it must not be taken for one that was left behind.
            old_ = Descriptor(::open(target_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
            if (old_.is_open()) ::flock(old_.get(), LOCK_SH | LOCK_NB);
        }
        if (with_return && replaces_ && name_->swap_with(target_)) {
            swapped_ = true;
        } else if (!name_->rename_to(target_)) {
            throw unwritable(file_, errno);
        }
        // The name is the folder's. What cannot be said of it now is no reason to say that nothing was written.
        if (is_synced()) ::fsync(Descriptor(::open(folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)).get());
    }

    /// After take_place: what was there before.
    void put_back() {
        if (!replaces_) {
            ::unlink(target_.c_str());
        } else if (swapped_) {
            name_->swap_with(target_);
        }
    }

  private:
    fs::path folder() const { return target_.parent_path(); }
    bool is_synced() const { return replaces_ || to_disk_; }

    void open() {
        // Without a name it goes with its process, however that ends.
        if (::access("/proc/self/fd", X_OK) == 0)
            descriptor_ = Descriptor(::open(folder().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
        if (descriptor_.is_open()) return;
        name_.emplace(folder(), [this](const char* name) {
            descriptor_ = Descriptor(::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
            return descriptor_.is_open();
        });
        if (name_->error() != 0) throw unwritable(file_, name_->error());
    }

    fs::path file_;
    fs::path target_;
    bool to_disk_;
    bool replaces_ = false;
    struct stat replaced_ {};
    Descriptor descriptor_;
    std::optional<UnfinishedName> name_;
    Descriptor old_;
    bool swapped_ = false;
};

bool is_standard_output(const fs::path& file) {
    struct stat out {};
    const bool is_file = ::fstat(STDOUT_FILENO, &out) == 0 && S_ISREG(out.st_mode);
    return is_file && identity(file) == std::pair(out.st_dev, out.st_ino);
}

void note_read(const fs::path& file) {
    const auto present = identity(file);
    if (!present) return;
    if (is_standard_output(file))
        throw InputError(file, "is where standard output goes, which would replace it; redirect that to another file");
    const std::lock_guard lock(read_files().mutex);
    // The present folder may be another later.
    const auto [at, is_new] = read_files().names.insert_or_assign(*present, whole_path(file));
    if (is_new) read_files().not_taken.push_back(at->second);
}

std::vector<fs::path> take_files_read() {
    const std::lock_guard lock(read_files().mutex);
    return std::exchange(read_files().not_taken, {});
}

void check_not_read(const fs::path& file) {
    const std::optional<fs::path> read = name_when_read(file);
    if (!read) return;
    throw InputError(file,
                     "would replace " + in_quotes(read->string()) + ", which it is made from; give another output");
}

fs::path meant(const fs::path& file) {
    constexpr int kMostLinks = 40;  // as many as the system follows
    std::error_code error;
    // A bare name has no folder of its own until it is made absolute.
    fs::path at = fs::absolute(file, error);
    if (error) at = file;
    // A link that leads to nothing yet.
    for (int i = 0; i < kMostLinks && !fs::exists(at, error) && fs::is_symlink(at, error); ++i)
        at = at.parent_path() / fs::read_symlink(at, error);
    // Behind a folder that is not there stands what no link was followed for: "none/../link".
    fs::path target = fs::weakly_canonical(at, error);
    if (!error) target = fs::weakly_canonical(target, error);
    if (error) return at;
    return target.has_filename() ? target : target.parent_path();  // "folder/" means the folder
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    const fs::path meant_a = meant(a), meant_b = meant(b);
    const auto number = identity(meant_a);
    return meant_a == meant_b || (number && number == identity(meant_b));
}

void check_stays_in_folder(const fs::path& file) {
    const fs::path target = meant(file);
    const fs::path folder = meant(file.has_parent_path() ? file.parent_path() : ".");
    if (target.parent_path() == folder) return;
    throw InputError(file,
                     "is a link that leads out of its folder, to " + in_quotes(target.string()) + "; remove the link");
}

void write_files(std::span<const FileBytes> files) {
    std::list<UnfinishedFile> unfinished;
    for (const FileBytes& wanted : files) {
        check_file_name(wanted.file);
        if (is_stream(wanted.file)) continue;
        UnfinishedFile& file = unfinished.emplace_back(wanted.file, wanted.to_disk);
        write_all(file.descriptor(), wanted);
        file.complete();
    }
    for (const FileBytes& wanted : files) {
        if (is_stream(wanted.file)) write_stream(wanted);
    }
    for (UnfinishedFile& file : unfinished) file.name_it();
    for (auto file = unfinished.begin(); file != unfinished.end(); ++file) {
        try {
            file->take_place(std::next(file) != unfinished.end());
        } catch (const MachineError&) {
            std::for_each(unfinished.begin(), file, [](UnfinishedFile& done) { done.put_back(); });
            throw;
        }
    }
}

void write_file(const fs::path& file, std::string_view bytes) {
    const FileBytes wanted{file, bytes};
    write_files({&wanted, 1});
}

void write_to_disk(const fs::path& file, std::string_view bytes) {
    const FileBytes wanted{file, bytes, true};
    write_files({&wanted, 1});
}

NewFile::NewFile(const fs::path& file) {
    check_file_name(file);
    if (is_stream(file)) throw unwritable(file, "is a pipe or a device; give a file");
    file_ = std::make_unique<UnfinishedFile>(file, false);
}

NewFile::~NewFile() = default;

int NewFile::descriptor() const { return file_->descriptor(); }

std::size_t NewFile::take_place() {
    struct stat written {};
    ::fstat(file_->descriptor(), &written);
    file_->complete();
    file_->name_it();
    file_->take_place(false);
    return static_cast<std::size_t>(written.st_size);
}

void remove_unfinished_files() noexcept {
    for (NameSlot& slot : slots) {
        if (slot.state == NameSlot::full && slot.process == ::getpid()) ::unlink(slot.name.data());
    }
}

}  // namespace mobbscope
