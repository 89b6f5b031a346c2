#include "run_program.h"

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace mobbscope {
inline namespace testing {

pid_t start_program(const std::vector<std::string>& arguments, const ProgramFiles& files,
                    const std::function<void()>& in_child) {
    std::vector<std::string> words{MOBBSCOPE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child != 0) return child;
    ::dup2(::open(files.in.c_str(), O_RDONLY), STDIN_FILENO);
    ::dup2(::open(files.out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
    ::dup2(::open(files.err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
    if (in_child) in_child();
    ::execv(argv[0], argv.data());
    ::_exit(127);
}

Result run_program(const std::vector<std::string>& arguments, const std::filesystem::path& stdout_to,
                   const std::filesystem::path& stdin_from, const std::function<void()>& in_child) {
    const TempFolder folder;
    const std::filesystem::path out = stdout_to.empty() ? folder.path() / "out" : stdout_to;
    const std::filesystem::path err = folder.path() / "err";
    const pid_t child = start_program(arguments, {stdin_from, out, err}, in_child);
    Result run;
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    constexpr std::int64_t kKilobyte = 1024;
    run.peak_memory = usage.ru_maxrss * kKilobyte;
    if (stdout_to.empty()) run.out = slurp(out);
    run.err = slurp(err);
    return run;
}

std::vector<std::string> with(std::vector<std::string> all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

json json_of(const std::vector<std::string>& arguments) {
    const Result run = run_program(with(arguments, {"--json"}));
    EXPECT_EQ(run.status, 0) << run.err;
    return run.status == 0 ? json::parse(run.out) : json();
}

bool is_one_line(const std::string& err) {
    return err.starts_with("mobbscope: ") && err.ends_with('\n') && std::count(err.begin(), err.end(), '\n') == 1;
}

void expect_refused(const Result& run, int status, const std::string& why) {
    EXPECT_EQ(run.status, status) << run.err;
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
}

}  // namespace testing
}  // namespace mobbscope
