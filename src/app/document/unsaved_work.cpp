#include <app/document/unsaved_work.h>
#include <base/file.h>
#include <base/input.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr int kCopyVersion = 1;
constexpr std::size_t kLongestHead = std::size_t{16} << 20;  // bytes

/// Names of files may be no UTF-8, which JSON texts are: then by their bytes.
void write_path(JsonWriter& out, const std::filesystem::path& path) {
    const std::string whole = path.empty() ? "" : whole_path(path).native();
    if (is_utf8(whole)) return out.value(whole);
    out.begin_array(JsonWriter::Layout::row);
    for (const char byte : whole) out.value(static_cast<int>(static_cast<unsigned char>(byte)));
    out.end_array();
}

std::filesystem::path read_path(const JsonPlace& place) {
    if (place.is_string()) return place.string();
    std::string bytes;
    place.each([&](const JsonPlace& byte) { bytes += static_cast<char>(byte.integer(1, 255)); });
    return bytes;
}

void write_time(JsonWriter& out, const std::optional<std::filesystem::file_time_type>& time) {
    // Beyond what a number of JSON keeps.
    if (time) out.member("file_time", std::to_string(time->time_since_epoch().count()));
}

std::optional<std::filesystem::file_time_type> read_time(const JsonPlace& head) {
    const auto place = head.find("file_time");
    if (!place) return std::nullopt;
    using Time = std::filesystem::file_time_type;
    Time::rep count{};
    const std::string& text = place->string();
    std::from_chars(text.data(), text.data() + text.size(), count);
    return Time(Time::duration(count));
}

void write_selection(JsonWriter& out, const Selection& selected) {
    out.key("selection");
    out.row("kind", kSelectionKinds[static_cast<std::size_t>(selected.kind)], "agent", selected.path.agent, "query",
            selected.path.query, "side", selected.path.side, "index", selected.index);
}

Selection read_selection(const JsonPlace& place) {
    const auto kind = std::ranges::find(kSelectionKinds, place.require("kind").string());
    if (kind == kSelectionKinds.end()) return {};
    const auto number = [&](const char* key) { return place.require(key).integer(-1, kMaxInt); };
    return {static_cast<Selection::Kind>(kind - kSelectionKinds.begin()),
            {number("agent"), number("query"), number("side")},
            number("index")};
}

void write_views(JsonWriter& out, const Document& document) {
    out.member("place", document.place);
    out.begin_object("links", JsonWriter::Layout::row);
    for (const ViewLink& link : kViewLinks) out.member(link.name, document.links.*link.on);
    out.end_object();
    out.list("beside", document.beside, [&](const SceneView& seen) {
        out.begin_object();
        out.member("name", seen.fitted->fits()[seen.fitted->fit_in_use()]->name);
        out.key("fit");
        write_fit(out, seen.fitted->options());
        out.key("view");
        write_view(out, seen.view);
        out.end_object();
    });
}

void read_views(const JsonPlace& head, Document& document) {
    const JsonPlace beside = head.require("beside");
    FittedScene fitted = *document.fitted;
    std::vector<std::pair<std::size_t, ViewState>> seen;
    beside.each([&](const JsonPlace& place) {
        const std::size_t fit = fit_with(fitted, place.require("name").string(), read_fit(place.require("fit")));
        seen.emplace_back(fit, read_view(place.require("view")));
    });
    document.fitted = std::make_shared<const FittedScene>(fitted);
    for (auto& [fit, view] : seen)
        document.beside.push_back({std::make_shared<const FittedScene>(fitted.using_fit(fit)), std::move(view)});
    document.place = static_cast<std::size_t>(head.require("place").integer(0, beside.size()));
    // Copies of older versions have none.
    const auto links = head.find("links");
    if (!links) return;
    for (const ViewLink& link : kViewLinks) document.links.*link.on = links->require(link.name).boolean();
}

/// The line about the work, and where the scene begins.
std::string_view head_of(std::string_view text, const std::filesystem::path& copy) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) throw InputError(copy.string(), "is not a whole copy of a scene");
    return text.substr(0, end);
}

void check_version(const JsonPlace& head) {
    const int version = head.require("mobbscope_unsaved").integer(1, kMaxInt);
    if (version > kCopyVersion) head.fail("it is of a newer version of Mobbscope");
}

std::string scene_title(const Workspace& workspace, const Scene& scene) {
    return workspace.file ? own_name(*workspace.file) : scene.file.empty() ? "untitled" : own_name(scene.file);
}

bool same_view(const SceneView& a, const SceneView& b) { return a.fitted == b.fitted && a.view == b.view; }

}  // namespace

std::map<std::string, UnsavedWork> unsaved_works(const Workspace& workspace) {
    std::map<std::string, UnsavedWork> out;
    if (!workspace.modified()) return out;
    const Document& now = workspace.document();
    const auto differ = [](const auto& a, const auto& b) { return &a->scene() != &b->scene(); };
    const std::shared_ptr<const ExcerptSource> origin = now.excerpt_of;
    const Document whole = origin ? whole_of(*origin) : now;
    if (differ(whole.fitted, workspace.saved)) {
        out["scene"] = {whole,
                        origin ? Selection{} : workspace.selection,
                        scene_title(workspace, whole.fitted->scene()),
                        workspace.file,
                        workspace.file_time,
                        workspace.opened};
    }
    if (origin && differ(now.fitted, origin->saved)) {
        out["excerpt"] = {now, workspace.selection, workspace.title(), {}, {}, {}};
        out["excerpt"].document.excerpt_of = nullptr;
    }
    return out;
}

bool same_scene(const UnsavedWork& a, const UnsavedWork& b) {
    return a.document.fitted && b.document.fitted && &a.document.fitted->scene() == &b.document.fitted->scene();
}

bool same_state(const UnsavedWork& a, const UnsavedWork& b) {
    return a.document.fitted == b.document.fitted && a.document.view == b.document.view && a.file == b.file &&
           a.selection == b.selection && a.document.place == b.document.place && a.document.links == b.document.links &&
           std::ranges::equal(a.document.beside, b.document.beside, same_view);
}

std::string unsaved_text(const UnsavedWork& work, std::time_t now) {
    Scene scene = work.document.fitted->scene();
    scene.view = work.document.view;
    scene.fit = work.document.fitted->options();
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object(JsonWriter::Layout::row);
    out.members("mobbscope_unsaved", kCopyVersion, "title", cleaned(work.title), "time", now);
    out.key("scene_file");
    write_path(out, scene.file);
    if (work.file) {
        out.key("file");
        write_path(out, *work.file);
    }
    write_time(out, work.file_time);
    out.list("opened", work.opened, [&](const std::filesystem::path& path) { write_path(out, path); });
    write_selection(out, work.selection);
    write_views(out, work.document);
    out.end_object();
    text << to_json(scene);
    return std::move(text).str();
}

UnsavedHead read_unsaved_head(const std::filesystem::path& copy) {
    const std::string text = read_beginning(copy, kLongestHead);
    const std::string name = copy.string();
    const JsonText value = parse_json(head_of(text, copy), name);
    const JsonPlace head(value, name);
    check_version(head);
    constexpr double kLatest = 1e12;
    return {head.require("title").string(), static_cast<std::time_t>(head.require("time").number(0, kLatest))};
}

UnsavedWork read_unsaved(const std::filesystem::path& copy, const Progress& progress) {
    const std::string text = read_file(copy);
    const std::string name = copy.string();
    const std::string_view line = head_of(text, copy);
    const JsonText value = parse_json(line, name);
    const JsonPlace head(value, name);
    check_version(head);
    UnsavedWork out;
    out.title = head.require("title").string();
    if (const auto file = head.find("file")) out.file = read_path(*file);
    out.file_time = read_time(head);
    head.require("opened").each([&](const JsonPlace& path) { out.opened.push_back(read_path(path)); });
    out.selection = read_selection(head.require("selection"));
    const std::filesystem::path scene_file = read_path(head.require("scene_file"));
    const std::string_view rest = std::string_view(text).substr(line.size() + 1);
    Scene scene = parse_scene(rest, name, scene_file.parent_path(), {}, progress);
    scene.file = scene_file;
    out.document = document_of(std::move(scene), nullptr, progress);
    read_views(head, out.document);
    return out;
}

void put_in(Workspace& workspace, const UnsavedWork& work) {
    workspace.saved = document_of({}, nullptr).fitted;
    workspace.file = work.file;
    workspace.file_time = work.file_time;
    workspace.select(work.selection);
}

}  // namespace mobbscope::app
