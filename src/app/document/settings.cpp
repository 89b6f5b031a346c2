#include <app/document/settings.h>
#include <base/descriptor.h>
#include <base/error.h>
#include <base/file.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/lock.h>
#include <base/text.h>
#include <scene/view_options.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostRecent = 20;

struct NumberSetting {
    const char* key;
    double Settings::*value;
    double least, most;  ///< others in the file do not count
};
constexpr std::array<NumberSetting, 5> kNumberSettings{{{"ui_scale", &Settings::ui_scale, 0.5, 4},
                                                        {"left_width", &Settings::left_width, 50, 5000},
                                                        {"right_width", &Settings::right_width, 50, 5000},
                                                        {"bottom_height", &Settings::bottom_height, 50, 5000},
                                                        {"events_height", &Settings::events_height, 50, 5000}}};

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 6> kFileOrders{"name", "-name", "size", "-size", "date", "-date"};
constexpr std::array<std::string_view, 4> kBottomTabs{"recursion", "events", "nodes", "curves"};
constexpr int kFarthest = 100'000;  // pixels from the corner of the displays

constexpr std::chrono::milliseconds kLockPatience{1000};  // with another window that is writing

constexpr int kVersion = 1;  // of what the keys mean; a file without one is of the first

/// What the file holds; an empty object where there is none, none where it is something else or cannot be opened.
std::optional<Json> read_object(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) return Json::object();
    try {
        if (std::filesystem::file_size(file, ignored) > SettingsFile::kMostBytes) return std::nullopt;
        const std::string text = read_file(file);
        if (trimmed(text).empty()) return Json::object();  // nothing is lost
        // Deep values grow as they are written, and take long to free.
        const auto check_depth = [&file](int depth, Json::parse_event_t, const Json&) {
            if (depth > SettingsFile::kDeepest) throw InputError(file.string(), "is nested too deep");
            return true;
        };
        Json json = Json::parse(text, check_depth, false);
        if (json.is_object()) return json;
    } catch (const InputError&) {
        // It is a folder, somebody else's, or no settings.
    }
    return std::nullopt;
}

bool is_newer(const Json& json) {
    const auto version = json.find("version");
    return version != json.end() && version->is_number() && version->get<double>() > kVersion;
}

/// Behind the file's name, one that is not taken.
std::filesystem::path unreadable_name(const std::filesystem::path& file) {
    std::filesystem::path out = file;
    out += ".unreadable";
    std::error_code ignored;
    for (int i = 2; std::filesystem::exists(out, ignored); ++i) {
        out = file;
        out += ".unreadable" + std::to_string(i);
    }
    return out;
}

std::string setting_text(const Json& json, const char* key) {
    const auto at = json.find(key);
    return at != json.end() && at->is_string() ? at->get<std::string>() : "";
}

/// The absolute paths of a list, at most so many; what is none is ignored.
std::vector<std::filesystem::path> paths_at(const Json& json, const char* key, std::size_t most) {
    std::vector<std::filesystem::path> out;
    const auto list = json.find(key);
    if (list == json.end() || !list->is_array()) return out;
    for (const Json& entry : *list) {
        if (out.size() == most) break;
        if (!entry.is_string()) continue;
        const std::filesystem::path path = entry.get<std::string>();
        if (path.is_absolute()) out.push_back(path);
    }
    return out;
}

std::vector<std::filesystem::path> read_recent(const Json& json) {
    Settings out;
    const std::vector<std::filesystem::path> listed = paths_at(json, "recent", kMostRecent);
    for (auto file = listed.rbegin(); file != listed.rend(); ++file) out.remember(*file);
    return out.recent;
}

Json texts_of(const std::vector<std::filesystem::path>& paths) {
    Json out = Json::array();
    for (const std::filesystem::path& path : paths) out.push_back(path.native());
    return out;
}

std::optional<int> integer_at(const Json& json, const char* key, int least, int most) {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number()) return std::nullopt;
    const double read = at->get<double>();
    if (!(read >= least && read <= most)) return std::nullopt;
    return static_cast<int>(read);
}

std::optional<WindowPlace> read_window(const Json& json) {
    const auto at = json.find("window");
    if (at == json.end() || !at->is_object()) return std::nullopt;
    const auto x = integer_at(*at, "x", -kFarthest, kFarthest);
    const auto y = integer_at(*at, "y", -kFarthest, kFarthest);
    const auto width = integer_at(*at, "width", 1, kFarthest);
    const auto height = integer_at(*at, "height", 1, kFarthest);
    if (!x || !y || !width || !height) return std::nullopt;
    const auto maximized = at->find("maximized");
    return WindowPlace{*x, *y, *width, *height,
                       maximized != at->end() && maximized->is_boolean() && maximized->get<bool>()};
}

Json json_of(const WindowPlace& window) {
    return {{"x", window.x},
            {"y", window.y},
            {"width", window.width},
            {"height", window.height},
            {"maximized", window.maximized}};
}

/// A session whose files or view cannot be read is none.
LastSession read_last(const Json& json) {
    const auto at = json.find("last_session");
    if (at == json.end() || !at->is_object()) return {};
    LastSession last{paths_at(*at, "files", std::string::npos), {}};
    const auto view = at->find("view");
    if (view == at->end()) return last;
    try {
        const std::string name = "settings";
        const JsonText value = parse_json(view->dump(), name);
        last.view = read_view(JsonPlace(value, name));
    } catch (const std::exception&) {
        // Another version's: the files are seen as they say themselves.
        last.view = {};
    }
    return last;
}

Json json_of(const LastSession& last) {
    std::ostringstream view;
    JsonWriter out(view);
    write_view(out, last.view);
    return {{"files", texts_of(last.files)}, {"view", Json::parse(view.str())}};
}

/// Older versions said only whether events were listed.
BottomTab read_bottom_tab(const Json& json) {
    if (const auto tab = enumerator_named<BottomTab>(kBottomTabs, setting_text(json, "bottom_tab"))) return *tab;
    const auto events = json.find("shows_events");
    const bool lists = events != json.end() && events->is_boolean() && events->get<bool>();
    return lists ? BottomTab::events : BottomTab::recursion;
}

/// What cannot be read is as at first.
PictureExport read_export(const Json& json) {
    PictureExport out;
    const auto at = json.find("export");
    if (at == json.end() || !at->is_object()) return out;
    for (const ExportOption& option : export_options()) {
        const std::string text = setting_text(*at, std::string(option.key).c_str());
        try {
            if (!text.empty()) option.parse(text, out);
        } catch (const std::invalid_argument&) {
            // Another version's.
        }
    }
    return out;
}

Json json_of(const PictureExport& wanted) {
    Json out = Json::object();
    for (const ExportOption& option : export_options()) out[option.key] = option.text(wanted);
    return out;
}

Json json_of(const Settings& settings) {
    Json json;
    for (const NumberSetting& number : kNumberSettings) json[number.key] = settings.*number.value;
    json["recent"] = texts_of(settings.recent);
    json["folder"] = settings.folder.native();
    json["file_order"] = settings.file_order;
    if (settings.theme) json["theme"] = name(*settings.theme);
    if (settings.window) json["window"] = json_of(*settings.window);
    json["folded"] = settings.folded;
    json["bottom_tab"] = kBottomTabs[static_cast<std::size_t>(settings.bottom_tab)];
    json["cost_of"] = name(settings.cost_of);
    json["last_session"] = json_of(settings.last);
    json["export"] = json_of(settings.picture_export);
    return json;
}

/// How many files were opened since the list was `before`: each came first.
std::size_t opened_since(const std::vector<std::filesystem::path>& before,
                         const std::vector<std::filesystem::path>& now) {
    for (std::size_t opened = 0; opened < now.size(); ++opened) {
        std::vector<std::filesystem::path> rest = before;
        for (std::size_t i = 0; i < opened; ++i) std::erase(rest, now[i]);
        // The last ones may have fallen off.
        const auto begin = now.begin() + static_cast<std::ptrdiff_t>(opened);
        if (std::mismatch(begin, now.end(), rest.begin(), rest.end()).first == now.end()) return opened;
    }
    return now.size();
}

/// Puts into `json` what differs in two objects, of objects in it by their members; whether anything does.
bool put_changes(const Json& before, const Json& now, Json& json) {
    bool any = false;
    for (const auto& [key, value] : now.items()) {
        const auto was = before.find(key);
        if (was != before.end() && *was == value) continue;
        any = true;
        // A place or a session is one thing; sections and export options stand alone.
        const bool of_members = key == "folded" || key == "export";
        if (of_members && was != before.end() && json.contains(key) && json[key].is_object())
            put_changes(*was, value, json[key]);
        else
            json[key] = value;
    }
    return any;
}

std::string settings_text(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::filesystem::path folder_named_by(const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path folder = value ? value : "";
    // The XDG rules ignore relative ones.
    return folder.is_absolute() ? folder : std::filesystem::path();
}

/// Which the variable names, else that one at home; empty where there is neither.
std::filesystem::path folder_of_person(const char* variable, const char* at_home) {
    std::filesystem::path named = folder_named_by(variable);
    if (!named.empty()) return named;
    const std::filesystem::path home = folder_named_by("HOME");
    return home.empty() ? home : home / at_home;
}

}  // namespace

void Settings::remember(const std::filesystem::path& file) {
    std::filesystem::path whole = whole_path(file);
    std::erase(recent, whole);
    recent.insert(recent.begin(), std::move(whole));
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

std::span<const std::string_view> bottom_tab_names() { return kBottomTabs; }

std::filesystem::path settings_file() {
    const std::filesystem::path folder = folder_of_person("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "mobbscope" / "settings.json";
}

std::filesystem::path unsaved_folder() {
    const std::filesystem::path folder = folder_of_person("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "mobbscope" / "unsaved";
}

Settings load_settings(const std::filesystem::path& file) {
    Settings settings;
    const Json json = read_object(file).value_or(Json::object());
    for (const NumberSetting& number : kNumberSettings) {
        const auto at = json.find(number.key);
        if (at == json.end() || !at->is_number()) continue;
        const double read = at->get<double>();
        if (read >= number.least && read <= number.most) settings.*number.value = read;
    }
    settings.recent = read_recent(json);
    const std::filesystem::path folder = setting_text(json, "folder");
    if (folder.is_absolute()) settings.folder = folder;
    settings.theme = theme_from_name(setting_text(json, "theme"));
    settings.window = read_window(json);
    if (const auto folded = json.find("folded"); folded != json.end() && folded->is_object()) {
        for (const auto& [name, is] : folded->items()) {
            if (is.is_boolean()) settings.folded[name] = is.get<bool>();
        }
    }
    settings.bottom_tab = read_bottom_tab(json);
    if (setting_text(json, "cost_of") == name(QueryWorkload::Kind::queries))
        settings.cost_of = QueryWorkload::Kind::queries;
    const std::string order = setting_text(json, "file_order");
    if (std::ranges::find(kFileOrders, order) != kFileOrders.end()) settings.file_order = order;
    settings.last = read_last(json);
    settings.picture_export = read_export(json);
    return settings;
}

std::string keep_unreadable_settings(const std::filesystem::path& file) {
    const std::string left = "; it is not changed, and settings are not saved";
    const std::optional<Json> json = read_object(file);
    if (json) return is_newer(*json) ? file.string() + " is of a newer version of Mobbscope" + left : "";
    const std::filesystem::path kept = unreadable_name(file);
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) std::filesystem::rename(file, kept, error);
    if (error || std::filesystem::exists(file)) return file.string() + " cannot be read" + left;
    return file.string() + " cannot be read; it is kept as " + kept.filename().string() +
           ", and the settings begin anew";
}

Settings SettingsFile::load() { return known_ = load_settings(file_); }

void SettingsFile::save(Settings& settings) {
    if (file_.empty()) return;
    std::error_code ignored;
    std::filesystem::create_directories(file_.parent_path(), ignored);
    // Who cannot have it writes all the same: another window may have been stopped while it had it.
    const Descriptor lock = lock_folder(file_.parent_path(), kLockPatience);
    std::optional<Json> present = read_object(file_);
    if (!present || is_newer(*present)) return;
    Settings merged = settings;
    merged.recent = read_recent(*present);
    const std::size_t opened = opened_since(known_.recent, settings.recent);
    for (std::size_t i = opened; i-- > 0;) merged.remember(settings.recent[i]);
    Json before = json_of(known_);
    // Another version's list stays until there is more to say.
    before["recent"] = opened > 0 ? Json() : texts_of(merged.recent);
    if (!put_changes(before, json_of(merged), *present)) return;
    (*present)["version"] = kVersion;
    std::string text = settings_text(*present, 2);
    // What is nested grows by blanks, and what was open may be long.
    if (text.size() > kMostBytes) text = settings_text(*present, -1);
    if (text.size() > kMostBytes && present->erase("last_session") > 0) text = settings_text(*present, -1);
    if (text.size() > kMostBytes) return;
    try {
        // Whole or not at all.
        write_file(file_, text);
    } catch (const MachineError&) {
        return;  // nothing that was worked on is lost
    }
    settings = known_ = std::move(merged);
}

}  // namespace mobbscope::app
