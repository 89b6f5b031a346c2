#include <base/file.h>
#include <cases/case_scene.h>
#include <scene/scene_json.h>
#include <scene/view_options.h>

#include <string>
#include <utility>

namespace mobbscope::picture_tests {

std::filesystem::path read_path(const JsonPlace& place, const std::filesystem::path& folder) {
    const std::string& name = place.string();
    read_at(place, [&] { check_file_name(name); });
    return folder / name;
}

FitAndView FitAndView::over(const JsonPlace& place) const {
    FitAndView out = *this;
    if (const auto fit_place = place.find("fit")) out.fit = read_fit(*fit_place, fit);
    if (const auto view_place = place.find("view")) out.view = read_view(*view_place, view);
    return out;
}

CaseScene read_case_scene(const JsonPlace& place, const std::filesystem::path& folder) {
    const JsonPlace scene = place.require("scene");
    if (scene.is_object()) {
        Scene own = read_scene(scene, folder);
        // The folder alone: a picture must not depend on how its case is called.
        own.file = folder / "";
        FitAndView seen = FitAndView{own.fit, own.view}.over(place);
        return {place.file(), std::move(own), std::move(seen)};
    }
    const std::filesystem::path file = read_path(scene, folder).lexically_normal();
    Scene read = read_at(scene, [&] { return load_scene(file); });
    FitAndView seen = FitAndView{read.fit, read.view}.over(place);
    return {file, std::move(read), std::move(seen)};
}

Scene scene_of(const CaseFile& file) {
    const std::string name = file.file.string();
    const JsonText value = parse_json(read_file(file.file), name);
    const JsonPlace root(value, name);
    CaseScene read = read_case_scene(root, file.file.parent_path());
    if (const auto panels = root.find("panels"); panels && panels->size() > 0) {
        const JsonPlace first = (*panels)[0];
        read.seen = read.seen.over(first);
    }
    read.scene.file = read.file;
    read.scene.fit = read.seen.fit;
    read.scene.view = read.seen.view;
    return std::move(read.scene);
}

}  // namespace mobbscope::picture_tests
