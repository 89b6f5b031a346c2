/// Picture tests in your own test program: `mobbscope`, which runs beside it, draws a scene and compares the picture
/// with an approved one. Header only, C++17, POSIX only.
///
///     EXPECT_PICTURE(scene, "name");                                                    GoogleTest, Catch2, doctest
///     EXPECT_PICTURE(scene, "name", R"({"view": {"query": 0}, "size": "640x360"})");
///
/// Include it after the framework. With any other call mobbscope::check_picture.
///
/// `scene`: the name of a scene or clip file; the text of a scene, which begins with '{'; or what a function
/// `std::string scene_text(const T&)` beside T makes one of, as mobb::scene_text does of captured queries. The third
/// argument has further keys of the case as JSON.
///
/// In one run a name is for one scene with one set of keys. The goldens of "name" are NAME.case.json, NAME.png and
/// NAME.state.json in the folder MOBBSCOPE_GOLDENS, a macro. What is drawn otherwise goes to the folder
/// MOBBSCOPE_OUTPUT. CMake's mobbscope_target_goldens(TARGET DIR) defines both, and MOBBSCOPE_PROGRAM. Variables of the
/// environment go before macros of that name; MOBBSCOPE_UPDATE=all, or names with commas between them, takes what is
/// drawn as goldens.
#pragma once

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#ifndef MOBBSCOPE_PROGRAM
#define MOBBSCOPE_PROGRAM "mobbscope"
#endif
#ifndef MOBBSCOPE_GOLDENS
#define MOBBSCOPE_GOLDENS "goldens"
#endif
#ifndef MOBBSCOPE_OUTPUT
#define MOBBSCOPE_OUTPUT "mobbscope-test"
#endif

extern char** environ;

namespace mobbscope {

struct PictureResult {
    enum class Outcome { passed, failed, skipped };  ///< skipped: there is no OpenGL, or the case says so
    Outcome outcome = Outcome::failed;
    std::string message;  ///< lines for a person; may be empty if it passed

    bool passed() const { return outcome == Outcome::passed; }
};

struct PictureOptions {
    std::string program;  ///< a file, or a name to be looked for in PATH
    std::string goldens;  ///< their folder; made when the first is taken
    std::string output;   ///< the folder for pictures of what does not pass
};

namespace picture_tests_detail {

inline std::string from_environment(const char* name, const std::string& otherwise) {
    const char* value = std::getenv(name);
    return value && *value ? value : otherwise;
}

inline void add_json_text(std::string& out, std::string_view text) {
    out += '"';
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < ' ') {
            char escaped[8];
            std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
            out += escaped;
        } else {
            out += c;
        }
    }
    out += '"';
}

inline std::string whole_name(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    // mobbscope says what is wrong with it.
    return error ? path.string() : whole.string();
}

/// The text of the scene, or the whole name of its file.
template <class Scene>
std::string scene_of(const Scene& scene) {
    if constexpr (std::is_same_v<Scene, std::filesystem::path>) {
        return whole_name(scene);
    } else if constexpr (std::is_convertible_v<const Scene&, std::string_view>) {
        const std::string_view text = scene;
        const std::size_t first = text.find_first_not_of(" \t\r\n");
        if (first != text.npos && text[first] == '{') return std::string(text);
        return whole_name(std::filesystem::path(text));
    } else {
        return scene_text(scene);  // found beside Scene
    }
}

/// `mobbscope test DIR --asked` at work: it draws in a process of its own and watches over that, so that it answers
/// whatever a case does.
class Child {
  public:
    explicit Child(PictureOptions options) : options_(std::move(options)) {}
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() { end(); }

    PictureResult ask(const std::string& name, const std::string& request) {
        // After a fork, as for a death test, the other process goes on talking to it.
        if (process_ > 0 && owner_ != ::getpid()) forget();
        if (process_ <= 0) {
            const std::string why = start();
            if (!why.empty()) return {PictureResult::Outcome::failed, why};
        }
        std::string answer;
        if (send(request) && receive(answer)) return result_of(answer, name);
        const int status = end();
        std::string message = options_.program + " ended before it answered";
        if (WIFEXITED(status)) message += " (exit status " + std::to_string(WEXITSTATUS(status)) + ")";
        if (WIFSIGNALED(status)) message += " (signal " + std::to_string(WTERMSIG(status)) + ")";
        return {PictureResult::Outcome::failed, message + "\n" + complaints_text_};
    }

  private:
    /// Why it cannot be; empty if it is.
    std::string start() {
        int ends[2];
        complaints_ = std::tmpfile();
#ifdef SOCK_CLOEXEC
        // Another thread may start a program meanwhile, which must not hold this end open.
        constexpr int kType = SOCK_STREAM | SOCK_CLOEXEC;
#else
        constexpr int kType = SOCK_STREAM;
#endif
        if (!complaints_ || ::socketpair(AF_UNIX, kType, 0, ends) != 0) {
            const std::string why = std::strerror(errno);
            close_complaints();
            return "no process can be started: " + why;
        }
        for (const int descriptor : {ends[0], ends[1], ::fileno(complaints_)}) {
            ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
        }
        std::vector<std::string> words{options_.program, "test", "--asked", "--output", options_.output};
        const std::string backend = from_environment("MOBBSCOPE_BACKEND", "");
        if (!backend.empty()) words.insert(words.end(), {"--backend", backend});
        add_updates(words);
        words.insert(words.end(), {"--", options_.goldens});
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);

        posix_spawn_file_actions_t files;
        posix_spawnattr_t how;
        ::posix_spawn_file_actions_init(&files);
        ::posix_spawn_file_actions_adddup2(&files, ends[1], 0);
        ::posix_spawn_file_actions_adddup2(&files, ends[1], 1);
        ::posix_spawn_file_actions_adddup2(&files, ::fileno(complaints_), 2);
        ::posix_spawnattr_init(&how);
        // Ctrl+C ends the test program, and this one writes its report then.
        ::posix_spawnattr_setpgroup(&how, 0);
        ::posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP);
        const int error = ::posix_spawnp(&process_, options_.program.c_str(), &files, &how, arguments.data(), environ);
        ::posix_spawn_file_actions_destroy(&files);
        ::posix_spawnattr_destroy(&how);
        ::close(ends[1]);
        if (error != 0) {
            ::close(ends[0]);
            process_ = 0;
            close_complaints();
            return "cannot start " + options_.program + ": " + std::strerror(error) +
                   "; install Mobbscope, or name the program in the environment variable MOBBSCOPE_PROGRAM";
        }
        talk_ = ends[0];
        owner_ = ::getpid();
        return {};
    }

    static void add_updates(std::vector<std::string>& words) {
        const std::string update = from_environment("MOBBSCOPE_UPDATE", "");
        if (update.empty()) return;
        words.push_back("--update");
        if (update == "1" || update == "all") return words.push_back("all");
        for (std::size_t begin = 0; begin <= update.size();) {
            const std::size_t end = std::min(update.find(',', begin), update.size());
            if (end > begin) words.push_back(update.substr(begin, end - begin));
            begin = end + 1;
        }
    }

    bool send(std::string_view bytes) const {
#ifdef MSG_NOSIGNAL
        constexpr int kFlags = MSG_NOSIGNAL;
#else
        constexpr int kFlags = 0;
        const int yes = 1;
        ::setsockopt(talk_, SOL_SOCKET, SO_NOSIGPIPE, &yes, sizeof yes);
#endif
        while (!bytes.empty()) {
            const ssize_t sent = ::send(talk_, bytes.data(), bytes.size(), kFlags);
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) return false;
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        }
        return true;
    }

    /// Up to the empty line. Its own cases have limits of time, so there is none here.
    bool receive(std::string& answer) const {
        char buffer[4096];
        while (answer.size() < 2 || answer.compare(answer.size() - 2, 2, "\n\n") != 0) {
            const ssize_t count = ::recv(talk_, buffer, sizeof buffer, 0);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            answer.append(buffer, static_cast<std::size_t>(count));
        }
        return true;
    }

    /// The first line is the outcome and the name, the rest the message.
    PictureResult result_of(const std::string& answer, const std::string& name) {
        const std::size_t end_of_line = answer.find('\n');
        const std::string first = answer.substr(0, end_of_line);
        PictureResult out;
        out.message = answer.substr(end_of_line + 1, answer.size() - end_of_line - 2);
        const std::string ending = ' ' + name;
        const std::size_t length = first.size() - std::min(first.size(), ending.size());
        if (first.compare(length, first.npos, ending) != 0) {
            // What it would answer next is not known either.
            end();
            out.message = options_.program + " answered '" + first + "' when asked for '" + name + "'\n" + out.message;
            return out;
        }
        const std::string outcome = first.substr(0, length);
        if (outcome == "passed") out.outcome = PictureResult::Outcome::passed;
        if (outcome == "skipped") out.outcome = PictureResult::Outcome::skipped;
        return out;
    }

    /// Lets it write its report, and takes what it complained of. How it ended.
    int end() {
        int status = 0;
        if (process_ <= 0) return status;
        if (owner_ != ::getpid()) {
            forget();
            return status;
        }
        ::shutdown(talk_, SHUT_WR);
        constexpr int kTries = 3000;  // of 10 ms
        pid_t ended = 0;
        for (int i = 0; i < kTries && ended == 0; ++i) {
            ended = ::waitpid(process_, &status, WNOHANG);
            if (ended == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        if (ended == 0) {
            ::kill(process_, SIGKILL);
            ::waitpid(process_, &status, 0);
        }
        complaints_text_.clear();
        std::rewind(complaints_);
        char buffer[4096];
        for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, complaints_)) > 0;)
            complaints_text_.append(buffer, count);
        forget();
        return status;
    }

    void forget() {
        ::close(talk_);
        talk_ = -1;
        process_ = 0;
        close_complaints();
    }
    void close_complaints() {
        if (complaints_) std::fclose(complaints_);
        complaints_ = nullptr;
    }

    PictureOptions options_;
    pid_t process_ = 0, owner_ = 0;
    int talk_ = -1;
    std::FILE* complaints_ = nullptr;
    std::string complaints_text_;
};

inline std::mutex& children_mutex() {
    static std::mutex mutex;
    return mutex;
}

/// One child for each folder of goldens, until the program ends.
inline PictureResult ask(const PictureOptions& options, const std::string& name, const std::string& request) {
    // A process that is forked while another thread asks would wait for that thread, which it does not have.
    static const int forks = ::pthread_atfork([] { children_mutex().lock(); }, [] { children_mutex().unlock(); },
                                              [] { children_mutex().unlock(); });
    static_cast<void>(forks);
    std::mutex& mutex = children_mutex();
    static std::map<std::tuple<std::string, std::string, std::string>, Child> children;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto key = std::make_tuple(options.program, options.goldens, options.output);
    return children.try_emplace(key, options).first->second.ask(name, request);
}

}  // namespace picture_tests_detail

/// What the environment says, or else the macros where this is called: `static`, as they may differ between the files
/// of one program.
[[maybe_unused]] static PictureOptions picture_options() {
    using picture_tests_detail::from_environment;
    return {from_environment("MOBBSCOPE_PROGRAM", MOBBSCOPE_PROGRAM),
            from_environment("MOBBSCOPE_GOLDENS", MOBBSCOPE_GOLDENS),
            from_environment("MOBBSCOPE_OUTPUT", MOBBSCOPE_OUTPUT)};
}

/// Draws `scene` and holds it against the golden `name`. Any thread may call it; one at a time draws. `keys`: a JSON
/// object with further keys of the case (docs/picture_tests.md), such as "fit", "view" and "size". Never throws for
/// what is wrong with them: that is the message.
template <class Scene>
[[maybe_unused]] static PictureResult check_picture(const Scene& scene, std::string_view name,
                                                    std::string_view keys = {},
                                                    const PictureOptions& options = picture_options()) {
    namespace detail = picture_tests_detail;
    std::string request = "{\"name\": ";
    detail::add_json_text(request, name);
    request += ", \"scene\": ";
    detail::add_json_text(request, detail::scene_of(scene));
    if (!keys.empty()) {
        request += ", \"keys\": ";
        detail::add_json_text(request, keys);
    }
    PictureResult result = detail::ask(options, std::string(name), request + "}\n");
    while (!result.message.empty() && result.message.back() == '\n') result.message.pop_back();
    if (result.passed() && !result.message.empty()) std::printf("%s\n", result.message.c_str());
    return result;
}

}  // namespace mobbscope

// What each framework calls a failure after which the test goes on, one after which it does not, and a test that was
// skipped. Where it cannot skip the test fails, as nobody has drawn the picture.
#if defined(GTEST_SKIP)
namespace mobbscope::picture_tests_detail {
inline bool skips_in_googletest(const PictureResult& result) {
    if (result.outcome != PictureResult::Outcome::skipped) return false;
    [&] { GTEST_SKIP() << result.message; }();
    return true;
}
}  // namespace mobbscope::picture_tests_detail
#define MOBBSCOPE_CHECK_(call, fail)                                                                                 \
    switch (0)                                                                                                       \
    case 0:                                                                                                          \
    default:                                                                                                         \
        if (const ::mobbscope::PictureResult mobbscope_result = call;                                                \
            mobbscope_result.passed() || ::mobbscope::picture_tests_detail::skips_in_googletest(mobbscope_result)) { \
        } else                                                                                                       \
            fail << mobbscope_result.message << '\n'
#define EXPECT_PICTURE(...) MOBBSCOPE_CHECK_(::mobbscope::check_picture(__VA_ARGS__), ADD_FAILURE())
#define ASSERT_PICTURE(...) MOBBSCOPE_CHECK_(::mobbscope::check_picture(__VA_ARGS__), FAIL())
#elif defined(CATCH_VERSION_MAJOR) || defined(CATCH_TEST_MACROS_HPP_INCLUDED) || defined(DOCTEST_LIBRARY_INCLUDED)
#if defined(DOCTEST_LIBRARY_INCLUDED)
#define MOBBSCOPE_SUCCEED_() CHECK(true)
// FAIL of doctest is not in its JUnit reports.
#define MOBBSCOPE_FAIL_CHECK_(message) CHECK_MESSAGE(mobbscope_result.passed(), message)
#define MOBBSCOPE_FAIL_(message) REQUIRE_MESSAGE(mobbscope_result.passed(), message)
#else
#include <iostream>
namespace mobbscope::picture_tests_detail {
/// Catch2 breaks long lines on a terminal, and with them names of files and commands. These are printed whole as well.
inline const std::string& with_long_lines_printed(const std::string& message) {
    constexpr std::size_t kUnbroken = 70;
    for (std::size_t begin = 0; begin < message.size();) {
        const std::size_t end = std::min(message.find('\n', begin), message.size());
        if (end - begin > kUnbroken) std::cerr << message.substr(begin, end - begin) << '\n';
        begin = end + 1;
    }
    std::cerr.flush();
    return message;
}
}  // namespace mobbscope::picture_tests_detail
#if defined(CATCH_CONFIG_PREFIX_ALL)
#define MOBBSCOPE_SUCCEED_() CATCH_SUCCEED()
#define MOBBSCOPE_FAIL_CHECK_(message) \
    CATCH_FAIL_CHECK(::mobbscope::picture_tests_detail::with_long_lines_printed(message))
#define MOBBSCOPE_FAIL_(message) CATCH_FAIL(::mobbscope::picture_tests_detail::with_long_lines_printed(message))
#else
#define MOBBSCOPE_SUCCEED_() SUCCEED()
#define MOBBSCOPE_FAIL_CHECK_(message) FAIL_CHECK(::mobbscope::picture_tests_detail::with_long_lines_printed(message))
#define MOBBSCOPE_FAIL_(message) FAIL(::mobbscope::picture_tests_detail::with_long_lines_printed(message))
#endif
#endif
#if defined(CATCH_SKIP)
#define MOBBSCOPE_SKIP_ CATCH_SKIP
#elif defined(SKIP) && defined(CATCH_TEST_MACROS_HPP_INCLUDED)
#define MOBBSCOPE_SKIP_ SKIP
#else
#define MOBBSCOPE_SKIP_ MOBBSCOPE_FAIL_CHECK_
#endif
#define MOBBSCOPE_CHECK_(call, fail)                                                           \
    do {                                                                                       \
        const ::mobbscope::PictureResult mobbscope_result = call;                              \
        if (mobbscope_result.passed()) {                                                       \
            MOBBSCOPE_SUCCEED_();                                                              \
        } else if (mobbscope_result.outcome == ::mobbscope::PictureResult::Outcome::skipped) { \
            MOBBSCOPE_SKIP_(mobbscope_result.message);                                         \
        } else {                                                                               \
            fail(mobbscope_result.message);                                                    \
        }                                                                                      \
    } while (false)
#define EXPECT_PICTURE(...) MOBBSCOPE_CHECK_(::mobbscope::check_picture(__VA_ARGS__), MOBBSCOPE_FAIL_CHECK_)
#define ASSERT_PICTURE(...) MOBBSCOPE_CHECK_(::mobbscope::check_picture(__VA_ARGS__), MOBBSCOPE_FAIL_)
#endif

#ifdef EXPECT_PICTURE
/// Holds the answers to the scene's queries, and no picture.
#define EXPECT_ANSWERS(scene, name) EXPECT_PICTURE(scene, name, "{\"hold\": [\"answers\"]}")
#endif
