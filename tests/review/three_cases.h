/// Three picture tests of which two fail, for tests that look at them in the window.
#pragma once

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

namespace mobbscope::app {
inline namespace testing {

/// Two who walk, the second shifted by so many metres.
inline std::string walkers(const std::string& shift) {
    return R"({"clips": {"walk": {"dt": 0.5, "motion": "linear", "samples": [[0, 0, 0.4], [0.6, 0.1, 0.4], [1.2, 0, 0.4]]}},
               "agents": [{"name": "A", "clip": "walk"},
                          {"name": "B", "clip": "walk", "translate": [)" +
           shift + R"(, -1], "rotate_deg": 90}], "fit": {"leaf": 1}})";
}

/// `moved` is not its golden's, picture and numbers; `missing` has none; `same` passes. The program itself, of the
/// macro MOBBSCOPE_PROGRAM, takes the goldens.
class ThreeCases {
  public:
    /// In a folder that is there.
    explicit ThreeCases(std::filesystem::path folder) : folder_(std::move(folder)) {
        std::filesystem::create_directory(cases());
        write("moved.json", walkers("1"));
        write("same.json", walkers("1"));
        for (const std::string name : {"moved", "same"}) {
            write(name + ".case.json", R"({"mobbscope_case": 1, "scene": ")" + name + R"(.json", "size": "160x120",
                                           "view": {"levels": 1, "camera": {"target": [1, 0, 1], "distance": 8}}})");
        }
        EXPECT_EQ(run("test '" + cases().string() + "' --update all"), 0);
        write("moved.json", walkers("1.3"));
        write("missing.case.json", R"({"mobbscope_case": 1, "scene": "same.json", "size": "160x120"})");
    }

    /// What std::system gives for the program with these arguments; 0 is 0.
    static int run(const std::string& arguments) {
        return std::system(("'" MOBBSCOPE_PROGRAM "' " + arguments + " >/dev/null 2>&1").c_str());
    }
    std::filesystem::path cases() const { return folder_ / "cases"; }
    std::filesystem::path path() const { return folder_; }
    std::filesystem::path file(const std::string& name) const { return cases() / name; }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(file(name), std::ios::binary) << text;
    }
    std::string bytes(const std::string& name) const { return mobbscope::testing::slurp(file(name)); }

  private:
    std::filesystem::path folder_;
};

}  // namespace testing
}  // namespace mobbscope::app
