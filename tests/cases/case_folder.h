/// A folder with a scene, for cases to be written into.
#pragma once

#include <cases/case_file.h>
#include <support/temp_folder.h>

#include <filesystem>
#include <string>

namespace mobbscope {
inline namespace testing {

/// Whether a part stands in a message.
inline bool says(const std::string& message, const std::string& part) {
    return message.find(part) != std::string::npos;
}

/// Two short clips that cross.
inline const char* const kSmallScene = R"({
 "clips": {"walk": {"dt": 0.25, "samples": [[0, 0, 0.4], [0.3, 0, 0.4], [0.6, 0.1, 0.4], [0.9, 0.2, 0.45],
                                           [1.2, 0.2, 0.4], [1.5, 0.3, 0.4], [1.8, 0.3, 0.4], [2.1, 0.3, 0.4]]}},
 "agents": [{"name": "A", "clip": "walk"},
            {"name": "B", "clip": "walk", "translate": [1, -1], "rotate_deg": 90, "start": 0.5}],
 "fit": {"leaf": 2},
 "view": {"levels": 1}
})";

class CaseFolder {
  public:
    CaseFolder() { folder_.write("scene.json", kSmallScene); }

    const std::filesystem::path& path() const { return folder_.path(); }
    const TempFolder& folder() const { return folder_; }

    /// Writes NAME.case.json: the version, the scene, and `more` members after them.
    picture_tests::CaseFile add(const std::string& name, const std::string& more = "") const {
        const std::string keys = R"({"mobbscope_case": 1, "scene": "scene.json", "size": "160x120")";
        return write(name, keys + (more.empty() ? "" : ", " + more) + "}");
    }
    /// The same with the whole text.
    picture_tests::CaseFile write(const std::string& name, const std::string& text) const {
        return {name, folder_.write(name + ".case.json", text)};
    }

  private:
    TempFolder folder_;
};

}  // namespace testing
}  // namespace mobbscope
