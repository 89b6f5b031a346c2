/// What the file dialog looks at: a folder, what of it is listed in which order, and what is chosen there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

struct FileEntry {
    std::string name;
    bool folder = false;
    std::uintmax_t size = 0;  ///< bytes, of a file
    std::time_t written = 0;  ///< last
};

/// "~" and "~/..." in the person's home; a path that begins anew behind another, as typed into a field that was filled
/// in, is that one; nothing else changes.
std::string expanded(const std::string& text);

/// What a person types, relative to a folder.
std::filesystem::path typed_path(const std::string& typed, const std::filesystem::path& folder);

/// A file that is to be written, with the extension (".png") that its name lacks; one that was typed before an
/// extension that stood there already is meant once.
std::filesystem::path with_extension(std::filesystem::path file, std::string_view extension);

/// What was typed, as far as all agree that begin so among the folders and the files with these extensions (".json").
std::string complete_path(const std::string& typed, const std::filesystem::path& folder,
                          std::span<const std::string_view> extensions);

class FileBrowser {
  public:
    /// How a click or a key chooses.
    enum class Choose {
        only,    ///< this one alone
        toggle,  ///< this one too, or no longer
        range,   ///< from the one that was chosen last to this one
        none     ///< the cursor goes there, and what is chosen stays
    };

    /// Lists a folder, with the cursor on the entry of that name if there is one. Files with these extensions are
    /// listed; they must outlive this.
    void begin(const std::filesystem::path& folder, std::span<const std::string_view> extensions,
               const std::string& cursor = "");
    /// Goes into another folder; of an upper one, the cursor is on where one came from.
    void go(const std::filesystem::path& folder);
    void go_up();
    /// Follows what is typed: it may lead into another folder, and, if it filters, only names that hold its last part
    /// are listed, whatever their case. The folder is read again when it has changed.
    void follow(const std::string& typed, bool filters);
    /// "name", "size" or "date", with "-" before it from the last to the first; folders stand before files.
    void order_by(const std::string& order);
    void show_hidden(bool shown);
    bool shows_hidden() const { return hidden_; }

    /// Where one is; what is typed is relative to it.
    const std::filesystem::path& folder() const { return folder_; }
    /// What is listed: the folder, or that which is typed.
    const std::filesystem::path& listed() const { return listed_; }
    /// The folders that lead there, the topmost first; whole paths.
    std::vector<std::filesystem::path> way() const;
    const std::vector<FileEntry>& entries() const { return entries_; }
    /// Why the folder cannot be read; empty if it can.
    const std::string& error() const { return error_; }
    /// Where keys go on from; < entries().size(), or 0 if there are none.
    std::size_t cursor() const { return cursor_; }

    /// `index` < entries().size().
    void choose(std::size_t index, Choose how);
    void choose_all();
    bool is_chosen(const FileEntry& entry) const { return chosen_.contains(entry.name); }
    /// Whether what is chosen was chosen by the person, and not as the first there is.
    bool is_chosen_by_hand() const { return by_hand_; }
    std::size_t chosen_count() const { return chosen_.size(); }
    /// In the order of the list.
    std::vector<std::filesystem::path> chosen() const;

  private:
    void read();
    void list();

    std::span<const std::string_view> extensions_;
    std::filesystem::path folder_, listed_;
    std::filesystem::file_time_type read_at_{};  ///< of the folder, when it was read
    std::vector<FileEntry> all_, entries_;
    std::string error_, filter_;
    std::string order_ = "name";
    bool hidden_ = false;
    std::size_t cursor_ = 0, anchor_ = 0;
    std::set<std::string> chosen_;
    bool by_hand_ = false;
};

}  // namespace mobbscope::app
