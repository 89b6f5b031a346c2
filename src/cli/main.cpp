// mobbscope: see and debug bounding-volume trees in space-time.
#include <cli/commands.h>
#include <cli/exit_status.h>
#include <cli/messages.h>
#include <cli/window_command.h>
#include <import/error.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

/// Help and version are results; everything else that CLI11 throws is bad usage, whatever its own code is.
int end_of_parse(const CLI::App& program, const CLI::ParseError& end) {
    if (end.get_exit_code() == 0) {
        program.exit(end, std::cout, std::cerr);
        flush_results();
        return kDone;
    }
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const std::string command = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    complain(std::string(end.what()) + "; see mobbscope " + command + "--help");
    return kBadInput;
}

int run(int argc, char** argv) {
    CLI::App program("See and debug bounding-volume trees in space-time", "mobbscope");
    program.set_version_flag("--version", "mobbscope " MOBBSCOPE_VERSION);
    program.require_subcommand(0, 1);
    WindowArguments window;
    add_window_options(program, window);
    int status = kDone;
    add_bench_command(program, status);
    add_conflicts_command(program, status);
    add_convert_command(program);
    add_diff_command(program, status);
    add_fit_command(program);
    add_graph_command(program, status);
    add_info_command(program);
    add_query_command(program, status);
    add_render_command(program);
    add_simulate_command(program);
    add_test_command(program, status);
    for (CLI::App* command : program.get_subcommands({})) {
        command->set_version_flag("--version", "mobbscope " MOBBSCOPE_VERSION);
    }
    // Before any command runs: what stands in front of its name is no argument of it.
    program.parse_complete_callback([&program] { check_not_before_command(program); });
    try {
        program.parse(argc, argv);
        return program.get_subcommands().empty() ? open_window(program, window) : status;
    } catch (const CLI::ParseError& end) {
        return end_of_parse(program, end);
    }
}

}  // namespace

}  // namespace mobbscope::cli

int main(int argc, char** argv) {
    using namespace mobbscope;
    std::ios::sync_with_stdio(false);
    // A reader that goes away and a file that may not grow are errors to report, not signals to die of.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
        return cli::run(argc, argv);
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
        cli::complain(std::string("this should not happen, please report it: ") + error.what());
        return cli::kNoMachine;
    }
}
