// mobbscope: see and debug bounding-volume trees in space-time.
#include <base/error.h>
#include <base/file.h>
#include <base/threads.h>
#include <cli/command_line.h>
#include <cli/program.h>
#include <cli/window_command.h>
#include <render/gl/driver_watch.h>

#include <malloc.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

namespace mobbscope::cli {

namespace {

/// Memory that is freed is soon asked for again, and to have it from the system each time takes longer than most
/// commands work. glibc comes to these thresholds by itself once it frees a block that is so large.
void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int kLargestKept = 32 << 20;
    mallopt(M_MMAP_THRESHOLD, kLargestKept);
    mallopt(M_TRIM_THRESHOLD, 2 * kLargestKept);
    mallopt(M_TOP_PAD, 1 << 20);
#endif
}

bool is_lack_of_threads(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return system && system->code() == std::errc::resource_unavailable_try_again;
}

/// Ends by the signal, without the files that are being written.
void end_by_signal(int signal) {
    remove_unfinished_files();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void leave_no_unfinished_files() {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        // Whoever ignores one, as nohup does, goes on.
        if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

int run(int argc, char** argv) {
    Command program("mobbscope", "See and debug bounding-volume trees in space-time");
    program.add_version("mobbscope " MOBBSCOPE_VERSION);
    WindowArguments window;
    add_window_options(program, window);
    for (const auto add : {add_bench_command, add_conflicts_command, add_convert_command, add_diff_command,
                           add_fit_command, add_graph_command, add_info_command, add_map_command, add_merge_command,
                           add_query_command, add_render_command, add_review_command, add_simulate_command,
                           add_sweep_command, add_test_command, add_verify_command}) {
        add(program);
    }
    // Before any command runs: what stands in front of its name is no argument of it.
    program.before_subcommand([&program] { check_not_before_command(program); });
    try {
        const std::string answer = program.parse({argv + std::min(argc, 1), argv + argc});
        if (answer.empty()) return program.chosen().empty() ? open_window(program, window) : program.status();
        std::cout << answer;
        flush_results();
        return kDone;
    } catch (const UsageError& error) {
        const std::string command = program.chosen().empty() ? "" : program.chosen() + " ";
        complain(std::string(error.what()) + "; see mobbscope " + command + "--help");
        return kBadInput;
    }
}

}  // namespace

}  // namespace mobbscope::cli

int main(int argc, char** argv) {
    using namespace mobbscope;
    cli::keep_freed_memory();
    std::ios::sync_with_stdio(false);
    // Output is finished or removed before the program ends because a reader went away; a file that may not grow is an
    // error to report.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // Who is started with it ignored would never hear how a child ended.
    std::signal(SIGCHLD, SIG_DFL);
    watch_drivers({cli::complain, end_worker_threads, cli::kNoMachine});
    cli::leave_no_unfinished_files();
    try {
        return cli::run(argc, argv);
    } catch (const ReaderGone&) {
        // As head leaves the programs it reads from; a shell calls that 141.
        cli::end_by_signal(SIGPIPE);
        return cli::kNoMachine;
    } catch (const InputError& error) {
        cli::complain(error.what());
        return cli::kBadInput;
    } catch (const MachineError& error) {
        cli::complain(error.what());
        return cli::kNoMachine;
    } catch (const std::bad_alloc&) {
        cli::complain("there is not enough memory for this");
        return cli::kNoMachine;
    } catch (const std::exception& error) {
        cli::complain(
            cli::is_lack_of_threads(error)
                ? "the system cannot start more threads or processes; end some, or raise the limit (ulimit -u)"
                : std::string("this should not happen, please report it: ") + error.what());
        return cli::kNoMachine;
    }
}
