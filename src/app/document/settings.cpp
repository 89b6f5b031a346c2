#include <app/document/settings.h>
#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>

#include <nlohmann/json.hpp>

#include <array>
#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostRecent = 12;

struct NumberSetting {
    const char* key;
    double Settings::*value;
    double least, most;  ///< others in the file do not count
};
constexpr std::array<NumberSetting, 4> kNumberSettings{{{"ui_scale", &Settings::ui_scale, 0.5, 4},
                                                        {"left_width", &Settings::left_width, 50, 5000},
                                                        {"right_width", &Settings::right_width, 50, 5000},
                                                        {"bottom_height", &Settings::bottom_height, 50, 5000}}};

std::filesystem::path folder_named_by(const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path folder = value ? value : "";
    // The XDG rules ignore relative ones.
    return folder.is_absolute() ? folder : std::filesystem::path();
}

}  // namespace

void Settings::remember(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::path absolute = std::filesystem::absolute(file, error).lexically_normal();
    if (error) absolute = file;
    std::erase(recent, absolute);
    recent.insert(recent.begin(), std::move(absolute));
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

std::filesystem::path settings_file() {
    std::filesystem::path folder = folder_named_by("XDG_CONFIG_HOME");
    if (folder.empty()) {
        folder = folder_named_by("HOME");
        if (folder.empty()) return {};
        folder /= ".config";
    }
    return folder / "mobbscope" / "settings.json";
}

Settings load_settings(const std::filesystem::path& file) {
    Settings settings;
    std::string text;
    try {
        text = read_file(file);
    } catch (const InputError&) {
        return settings;
    }
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return settings;
    for (const NumberSetting& number : kNumberSettings) {
        const auto at = json.find(number.key);
        if (at == json.end() || !at->is_number()) continue;
        const double read = at->get<double>();
        if (read >= number.least && read <= number.most) settings.*number.value = read;
    }
    if (const auto folded = json.find("folded"); folded != json.end() && folded->is_array()) {
        for (const nlohmann::json& section : *folded) {
            if (section.is_string()) settings.folded.insert(section.get<std::string>());
        }
    }
    const auto recent = json.find("recent");
    if (recent == json.end() || !recent->is_array()) return settings;
    for (const nlohmann::json& entry : *recent) {
        if (settings.recent.size() == kMostRecent) break;
        if (!entry.is_string()) continue;
        const std::filesystem::path path = entry.get<std::string>();
        if (path.is_absolute()) settings.recent.push_back(path);
    }
    return settings;
}

void save_settings(const std::filesystem::path& file, const Settings& settings) {
    if (file.empty()) return;
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object();
    for (const NumberSetting& number : kNumberSettings) out.member(number.key, settings.*number.value);
    out.begin_array("folded");
    for (const std::string& section : settings.folded) out.value(section);
    out.end_array();
    out.begin_array("recent");
    for (const std::filesystem::path& path : settings.recent) out.value(std::string_view(path.native()));
    out.end_array();
    out.end_object();
    std::error_code ignored;
    std::filesystem::create_directories(file.parent_path(), ignored);
    try {
        write_file(file, text.str());
    } catch (const MachineError&) {
        // Nothing that was worked on is lost.
    }
}

}  // namespace mobbscope::app
