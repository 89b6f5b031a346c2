#include "run_program.h"

#include <support/temp_folder.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace mobbscope::testing {

Result run_program(const std::vector<std::string>& arguments, const std::filesystem::path& stdout_to,
                   const std::filesystem::path& stdin_from, const std::function<void()>& in_child) {
    const TempFolder folder;
    const std::string out = stdout_to.empty() ? (folder.path() / "out").string() : stdout_to.string();
    const std::string err = (folder.path() / "err").string();
    std::vector<std::string> words{MOBBSCOPE_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open(stdin_from.c_str(), O_RDONLY), STDIN_FILENO);
        ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
        ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
        if (in_child) in_child();
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    Result run;
    int status = 0;
    ::waitpid(child, &status, 0);
    run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (stdout_to.empty()) run.out = slurp(out);
    run.err = slurp(err);
    return run;
}

bool is_one_line(const std::string& err) {
    return err.starts_with("mobbscope: ") && err.ends_with('\n') && std::count(err.begin(), err.end(), '\n') == 1;
}

}  // namespace mobbscope::testing
