#include <picture_tests/shot.h>

#include <base/file.h>
#include <base/text.h>
#include <cases/case_scene.h>
#include <render/drawlist/picture_options.h>
#include <review/review_screen.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

constexpr int kMostColumns = 64;

/// A scene under several fits; equal ones are shared.
class Fits {
  public:
    explicit Fits(Scene scene) : scene_(std::move(scene)) {}

    std::shared_ptr<const FittedScene> with(const mobb::FitOptions& options) {
        for (const auto& fitted : made_) {
            if (fitted->options() == options) return fitted;
        }
        return made_.emplace_back(std::make_shared<const FittedScene>(scene_, options));
    }

  private:
    Scene scene_;
    std::vector<std::shared_ptr<const FittedScene>> made_;
};

/// The query that a `view` names, if it says something of it; else `otherwise`.
std::optional<int> query_in(const JsonPlace& place, std::optional<int> otherwise = {}) {
    const auto view = place.find("view");
    const auto query = view ? view->find("query") : std::nullopt;
    if (!query) return otherwise;
    return query->is_null() ? std::nullopt : std::optional(query->integer(0, kMaxInt));
}

std::vector<PicturePanel> read_panels(const JsonPlace& place, const FitAndView& common, std::optional<int> query,
                                      Fits& fits) {
    if (place.size() == 0) place.fail("there are no panels; give one or more, or leave the key out");
    std::vector<PicturePanel> panels;
    for (int i = 0; i < place.size(); ++i) {
        const JsonPlace one = place[i];
        one.allow_only({"title", "view", "fit"});
        const FitAndView chosen = common.over(one);
        PicturePanel panel{{}, fits.with(chosen.fit), chosen.view, query_in(one, query)};
        if (const auto title = one.find("title")) panel.title = title->string();
        panels.push_back(std::move(panel));
    }
    return panels;
}

WindowShot read_window(const JsonPlace& place, const std::filesystem::path& folder) {
    place.allow_only({"script", "scale"});
    WindowShot window;
    if (const auto script = place.find("script")) {
        const std::filesystem::path file = read_path(*script, folder);
        window.script = read_at(*script, [&] {
            return app::Script::parse(read_file(file), file.string(), app::ScriptOutput::refused,
                                      app::commands_with_review());
        });
    }
    if (const auto scale = place.find("scale")) window.scale = scale->number(app::kLeastUiScale, app::kMostUiScale);
    return window;
}

/// As the option of `render` reads it.
template <class Parse>
auto read_option(const JsonPlace& place, const Parse& parse, const std::string& text) {
    return read_at(place, [&] { return parse(text); });
}

PictureOptions read_picture_options(const JsonPlace& place) {
    PictureOptions picture;
    if (const auto size = place.find("size")) picture.size = read_option(*size, parse_size, size->string());
    if (const auto scale = place.find("scale")) picture.scale = scale->number(kLeastScale, kMostScale);
    if (const auto samples = place.find("samples")) {
        picture.samples = read_option(*samples, parse_samples, std::to_string(samples->integer(1, 8)));
    }
    if (const auto background = place.find("background")) {
        picture.background = read_option(*background, parse_background, background->string());
    }
    return picture;
}

/// Where a window is drawn, no panels are.
void refuse_with_window(const JsonPlace& place) {
    for (const char* key : {"panels", "columns", "select", "scale", "samples", "background"}) {
        if (const auto found = place.find(key)) found->fail("a picture of the window has no such key; remove it");
    }
}

}  // namespace

Shot read_shot(const JsonPlace& place, const std::filesystem::path& folder) {
    Shot shot;
    shot.picture = read_picture_options(place);
    read_at(place, [&] { check(shot.picture); });
    if (const auto select = place.find("select")) {
        shot.select = read_at(*select, [&] { return parse_named_part(select->string()); });
    }
    if (const auto window = place.find("window")) {
        refuse_with_window(place);
        shot.window = read_window(*window, folder);
    }

    CaseScene read = read_case_scene(place, folder);
    shot.scene_file = read.file;
    const FitAndView common = std::move(read.seen);
    Fits fits(std::move(read.scene));
    if (const auto panels = place.find("panels")) {
        shot.panels = read_panels(*panels, common, query_in(place), fits);
    } else {
        shot.panels.push_back({{}, fits.with(common.fit), common.view, query_in(place)});
    }
    shot.columns = static_cast<int>(shot.panels.size());
    if (const auto columns = place.find("columns")) {
        shot.columns = std::min(shot.columns, columns->integer(1, kMostColumns));
    }
    return shot;
}

}  // namespace mobbscope::picture_tests
