#include <picture_tests/test_case.h>

#include <base/file.h>
#include <base/json.h>

namespace mobbscope::picture_tests {

Case read_case(const std::filesystem::path& file, const std::optional<std::string>& text) {
    const std::string name = file.string();
    const JsonText value = parse_json(text ? *text : read_file(file), name);
    const JsonPlace root(value, name);
    root.allow_only({"$schema",    "mobbscope_case", "tolerance", "threshold", "allowed",    "mask",   "draw_list",
                     "time_limit", "skip",           "scene",     "fit",       "view",       "panels", "columns",
                     "select",     "size",           "scale",     "samples",   "background", "window"});
    if (const auto schema = root.find("$schema")) schema->string();
    Case out;
    out.terms = read_terms(root, file.parent_path());
    if (!out.terms.skip) {
        out.shot = read_shot(root, file.parent_path());
        out.shot.file = file;
    }
    return out;
}

}  // namespace mobbscope::picture_tests
