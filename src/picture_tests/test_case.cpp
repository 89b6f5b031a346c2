#include <picture_tests/test_case.h>

#include <base/file.h>
#include <base/json.h>

namespace mobbscope::picture_tests {

namespace {

/// Of a case that draws nothing, a view says which query is held.
void refuse_other_views(const JsonPlace& place) {
    const auto view = place.find("view");
    for (int i = 0; view && i < view->members(); ++i) {
        const JsonPlace option = view->member(i);
        if (option.key() != "query") option.fail("the case holds no picture; remove this, or hold the picture too");
    }
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::optional<std::string>& text) {
    const std::string name = file.string();
    const JsonText value = parse_json(text ? *text : read_file(file), name);
    const JsonPlace root(value, name);
    root.allow_only({"$schema", "mobbscope_case", "hold", "tolerance", "threshold", "allowed",    "mask",
                     "state",   "time_limit",     "skip", "scene",     "fit",       "view",       "panels",
                     "columns", "select",         "size", "scale",     "samples",   "background", "window"});
    if (const auto schema = root.find("$schema")) schema->string();
    Case out;
    out.terms = read_terms(root, file.parent_path());
    if (!out.terms.holds(Held::picture)) {
        refuse_other_views(root);
        if (const auto panels = root.find("panels")) panels->each(refuse_other_views);
    }
    if (!out.terms.skip) {
        out.shot = read_shot(root, file.parent_path());
        out.shot.file = file;
    }
    return out;
}

}  // namespace mobbscope::picture_tests
