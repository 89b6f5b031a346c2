/// The subcommands. Each adds itself to the program; when it was asked for it runs while the arguments are parsed,
/// throws InputError or MachineError, or sets `status` if it ends with another exit status than 0.
#pragma once

#include <CLI/CLI.hpp>

namespace mobbscope::cli {

void add_bench_command(CLI::App& program, int& status);
void add_conflicts_command(CLI::App& program, int& status);
void add_convert_command(CLI::App& program);
void add_diff_command(CLI::App& program, int& status);
void add_fit_command(CLI::App& program);
void add_graph_command(CLI::App& program, int& status);
void add_info_command(CLI::App& program);
void add_query_command(CLI::App& program, int& status);
void add_render_command(CLI::App& program);
void add_simulate_command(CLI::App& program);
void add_test_command(CLI::App& program, int& status);

}  // namespace mobbscope::cli
