#include <app/panels/path_completion.h>
#include <base/file.h>
#include <base/text.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace mobbscope::app {

namespace {

/// "a/b" is the folder "a/" and the beginning "b".
std::pair<std::string, std::string> split(const std::string& typed) {
    const std::size_t slash = typed.rfind('/');
    if (slash == std::string::npos) return {"", typed};
    return {typed.substr(0, slash + 1), typed.substr(slash + 1)};
}

std::size_t common_length(const std::string& a, const std::string& b) {
    return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::string expanded(const std::string& text) {
    // A path that begins anew behind another, as typed into a field that was filled in.
    const std::size_t anew = std::max(text.rfind("//") + 1, text.rfind("/~") + 1);
    std::string typed = anew > 0 ? text.substr(anew) : text;
    const char* home = std::getenv("HOME");
    if (!home || (typed != "~" && !typed.starts_with("~/"))) return typed;
    return home + typed.substr(1);
}

PathCompletion complete_path(const std::string& typed, std::span<const std::string_view> extensions) {
    const auto [folder, beginning] = split(typed);
    PathCompletion out;
    out.folder = folder.empty() ? std::filesystem::path(".") : std::filesystem::path(expanded(folder));
    out.completed = typed;
    std::error_code error;
    for (std::filesystem::directory_iterator at(out.folder, error), end; !error && at != end; at.increment(error)) {
        PathEntry entry;
        entry.name = at->path().filename().string();
        if (!entry.name.starts_with(beginning) || (entry.name.front() == '.' && beginning.empty())) continue;
        std::error_code ignored;
        entry.folder = at->is_directory(ignored);
        const std::string extension = lower_extension(at->path());
        if (!entry.folder && std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) continue;
        if (!entry.folder) entry.size = at->file_size(ignored);
        out.entries.push_back(std::move(entry));
    }
    std::sort(out.entries.begin(), out.entries.end(),
              [](const PathEntry& a, const PathEntry& b) { return a.folder != b.folder ? a.folder : a.name < b.name; });
    if (out.entries.empty()) return out;
    std::string common = out.entries.front().name;
    for (const PathEntry& entry : out.entries) common.resize(common_length(common, entry.name));
    // Names that differ within a character agree up to it.
    while (!is_utf8(common) && is_utf8(out.entries.front().name)) common.pop_back();
    out.completed = folder + common + (out.entries.size() == 1 && out.entries.front().folder ? "/" : "");
    return out;
}

std::string with_entry(const std::string& typed, const PathEntry& entry) {
    return split(typed).first + entry.name + (entry.folder ? "/" : "");
}

}  // namespace mobbscope::app
