#include <app/document/file_browser.h>
#include <base/file.h>
#include <base/text.h>

#include <sys/stat.h>
#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace mobbscope::app {

namespace {

/// "a/b" is the folder "a/" and the beginning "b".
std::pair<std::string, std::string> split_path(const std::string& typed) {
    const std::size_t slash = typed.rfind('/');
    if (slash == std::string::npos) return {"", typed};
    return {typed.substr(0, slash + 1), typed.substr(slash + 1)};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whatever the case, and "walk2" before "walk10".
bool before_by_name(const FileEntry& a, const FileEntry& b) {
    const std::string x = lower(a.name);
    const std::string y = lower(b.name);
    std::size_t i = 0;
    std::size_t j = 0;
    const auto number_at = [](const std::string& text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return std::string_view(text).substr(begin, at - begin);
    };
    while (i < x.size() && j < y.size()) {
        if (is_digit(x[i]) && is_digit(y[j])) {
            const std::string_view m = number_at(x, i);
            const std::string_view n = number_at(y, j);
            if (m.size() != n.size()) return m.size() < n.size();
            if (m != n) return m < n;
            continue;
        }
        if (x[i] != y[j]) return static_cast<unsigned char>(x[i]) < static_cast<unsigned char>(y[j]);
        ++i;
        ++j;
    }
    if (x.size() - i != y.size() - j) return x.size() - i < y.size() - j;
    return a.name < b.name;
}

/// Folders, and the files with these extensions.
std::vector<FileEntry> entries_in(const std::filesystem::path& folder, std::span<const std::string_view> extensions,
                                  std::error_code& error) {
    std::vector<FileEntry> out;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        FileEntry entry;
        entry.name = at->path().filename().string();
        struct stat facts {};
        if (::stat(at->path().c_str(), &facts) != 0) continue;  // it leads nowhere, or is gone already
        entry.folder = S_ISDIR(facts.st_mode);
        if (!entry.folder && std::ranges::find(extensions, unpacked_extension(at->path())) == extensions.end())
            continue;
        if (!entry.folder) entry.size = static_cast<std::uintmax_t>(facts.st_size);
        entry.written = facts.st_mtime;
        out.push_back(std::move(entry));
    }
    return out;
}

}  // namespace

std::string expanded(const std::string& text) {
    const std::size_t anew = std::max(text.rfind("//") + 1, text.rfind("/~") + 1);
    std::string typed = anew > 0 ? text.substr(anew) : text;
    const char* home = std::getenv("HOME");
    if (!home || (typed != "~" && !typed.starts_with("~/"))) return typed;
    return home + typed.substr(1);
}

std::filesystem::path with_extension(std::filesystem::path file, std::string_view extension) {
    if (file.has_filename() && !file.has_extension()) file += extension;
    const std::filesystem::path stem = file.stem();
    if (lower_extension(stem) == extension && lower_extension(file) == extension) file.replace_filename(stem);
    return file;
}

std::filesystem::path typed_path(const std::string& typed, const std::filesystem::path& folder) {
    return folder / expanded(typed);
}

std::string complete_path(const std::string& typed, const std::filesystem::path& folder,
                          std::span<const std::string_view> extensions) {
    const auto [parent, beginning] = split_path(typed);
    std::error_code error;
    std::vector<FileEntry> entries = entries_in(typed_path(parent, folder), extensions, error);
    std::erase_if(entries, [&typed_name = beginning](const FileEntry& entry) {
        return !entry.name.starts_with(typed_name) || (entry.name.front() == '.' && typed_name.empty());
    });
    if (entries.empty()) return typed;
    std::string common = entries.front().name;
    for (const FileEntry& entry : entries) {
        const auto differ = std::mismatch(common.begin(), common.end(), entry.name.begin(), entry.name.end()).first;
        common.resize(static_cast<std::size_t>(differ - common.begin()));
    }
    // Names that differ within a character agree up to it.
    while (!is_utf8(common) && is_utf8(entries.front().name)) common.pop_back();
    return parent + common + (entries.size() == 1 && entries.front().folder ? "/" : "");
}

void FileBrowser::begin(const std::filesystem::path& folder, std::span<const std::string_view> extensions,
                        const std::string& cursor) {
    extensions_ = extensions;
    filter_.clear();
    go(folder);
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (entries_[i].name == cursor) choose(i, Choose::only);
    }
    by_hand_ = false;
}

void FileBrowser::go(const std::filesystem::path& folder) {
    const std::filesystem::path from = whole_path(folder_);
    folder_ = listed_ = folder.empty() ? std::filesystem::path(".") : folder;
    filter_.clear();
    chosen_.clear();
    cursor_ = 0;
    read();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (whole_path(folder_ / entries_[i].name) == from) choose(i, Choose::only);
    }
    by_hand_ = false;
}

void FileBrowser::go_up() {
    folder_ = whole_path(listed_);
    go(folder_.parent_path());
}

void FileBrowser::follow(const std::string& typed, bool filters) {
    const auto [parent, last] = split_path(typed);
    const std::filesystem::path listed = parent.empty() ? folder_ : typed_path(parent, folder_);
    const std::string filter = filters ? last : "";
    std::error_code ignored;
    const bool moved = listed != listed_;
    if (!moved && filter == filter_) {
        if (std::filesystem::last_write_time(listed_, ignored) != read_at_) read();
        return;
    }
    listed_ = listed;
    filter_ = filter;
    chosen_.clear();
    moved ? read() : list();
    if (entries_.empty()) return;
    // What is called so is meant, else what begins so.
    const std::string wanted = lower(filter);
    const auto called = [&](const FileEntry& entry) { return entry.name == filter; };
    const auto begins = [&](const FileEntry& entry) { return lower(entry.name).starts_with(wanted); };
    auto best = std::ranges::find_if(entries_, called);
    if (best == entries_.end()) best = std::ranges::find_if(entries_, begins);
    choose(best == entries_.end() ? 0 : static_cast<std::size_t>(best - entries_.begin()), Choose::only);
    by_hand_ = !filter.empty();
}

void FileBrowser::order_by(const std::string& order) {
    if (order == order_) return;
    order_ = order;
    list();
}

void FileBrowser::show_hidden(bool shown) {
    hidden_ = shown;
    list();
}

void FileBrowser::read() {
    std::error_code error;
    read_at_ = std::filesystem::last_write_time(listed_, error);
    error.clear();
    all_ = entries_in(listed_, extensions_, error);
    error_ = error ? "This folder cannot be read: " + error.message() : "";
    list();
}

/// Filters and orders what was read; the cursor stays on its entry.
void FileBrowser::list() {
    const std::string at = cursor_ < entries_.size() ? entries_[cursor_].name : "";
    const std::string wanted = lower(filter_);
    const bool hidden = hidden_ || filter_.starts_with('.');
    entries_.clear();
    for (const FileEntry& entry : all_) {
        if (entry.name.front() == '.' && !hidden) continue;
        if (lower(entry.name).find(wanted) != std::string::npos) entries_.push_back(entry);
    }
    const bool last_first = order_.starts_with('-');
    const std::string by = last_first ? order_.substr(1) : order_;
    std::ranges::sort(entries_, before_by_name);
    std::ranges::stable_sort(entries_, [&](const FileEntry& a, const FileEntry& b) {
        if (a.folder != b.folder) return a.folder;
        const FileEntry& x = last_first ? b : a;
        const FileEntry& y = last_first ? a : b;
        if (by == "date") return x.written < y.written;
        if (by == "size") return x.size < y.size;
        return last_first && before_by_name(x, y);
    });
    std::set<std::string> left;
    cursor_ = 0;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        if (entries_[i].name == at) cursor_ = i;
        if (chosen_.contains(entries_[i].name)) left.insert(entries_[i].name);
    }
    anchor_ = cursor_;
    chosen_ = std::move(left);
    if (chosen_.empty() && !entries_.empty()) {
        choose(cursor_, Choose::only);
        by_hand_ = false;
    }
}

void FileBrowser::choose(std::size_t index, Choose how) {
    const std::string& name = entries_[index].name;
    cursor_ = index;
    by_hand_ = true;
    if (how == Choose::none) return;
    if (how == Choose::range) {
        chosen_.clear();
        const auto [first, last] = std::minmax({std::min(anchor_, entries_.size() - 1), index});
        for (std::size_t i = first; i <= last; ++i) chosen_.insert(entries_[i].name);
        return;
    }
    anchor_ = index;
    if (how == Choose::only) chosen_ = {name};
    if (how == Choose::toggle && chosen_.erase(name) == 0) chosen_.insert(name);
}

void FileBrowser::choose_all() {
    chosen_.clear();
    for (const FileEntry& entry : entries_) {
        if (!entry.folder) chosen_.insert(entry.name);
    }
}

std::vector<std::filesystem::path> FileBrowser::way() const {
    std::vector<std::filesystem::path> out;
    for (std::filesystem::path at = whole_path(listed_);; at = at.parent_path()) {
        out.insert(out.begin(), at);
        if (!at.has_relative_path()) return out;
    }
}

std::vector<std::filesystem::path> FileBrowser::chosen() const {
    std::vector<std::filesystem::path> out;
    for (const FileEntry& entry : entries_) {
        // A path relative to where the program runs stays as it was given.
        if (is_chosen(entry)) out.push_back((listed_ / entry.name).lexically_normal());
    }
    return out;
}

}  // namespace mobbscope::app
