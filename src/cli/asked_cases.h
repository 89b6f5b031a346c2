/// Cases that the tests of another program ask for, and the answers (the other side is in test_frameworks).
///
///     {"name": "meeting", "scene": TEXT, "keys": TEXT}
///
/// `scene`: the JSON of a scene if it begins with '{', else the name of a scene or clip file; `keys`, which may be left
/// out: an object with further keys of the case. The answer is a line with the outcome (case_result.h) and the name,
/// "missing golden meeting", what is to be said of it on further lines, and an empty line. A name may be asked for
/// again with the same texts, as a test that is repeated does.
#pragma once

#include <base/json.h>
#include <cases/case_result.h>
#include <cases/drawing_child.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::cli {

struct AskedCasesOptions {
    std::filesystem::path folder;  ///< of the goldens; need not be there
    std::filesystem::path output;  ///< for pictures of what does not pass, and the report
    std::string backend = "auto";
    std::vector<std::string> update_names{};  ///< goldens that are taken, whatever they are: exact or with wildcards
    bool update_all = false;                  ///< those that do not pass
};

class AskedCases {
  public:
    explicit AskedCases(AskedCasesOptions options);

    /// Without the empty line. What is wrong with a case or a line is its answer. Throws MachineError.
    std::string answer(std::string_view line);

    /// Into the report of `output`. Throws MachineError.
    void keep_report();

  private:
    std::string answer_to(const JsonPlace& request);
    picture_tests::CaseResult drawn(const picture_tests::CaseFile& file, const std::string& asked);

    AskedCasesOptions options_;
    picture_tests::LastingDrawer drawer_;
    std::vector<picture_tests::CaseResult> results_;  ///< the last of each case
    std::map<std::string, std::string> asked_;        ///< by name, the text of the case
};

}  // namespace mobbscope::cli
