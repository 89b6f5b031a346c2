/// The subcommands. Each adds itself to the program; when it was asked for it runs while the arguments are parsed,
/// throws InputError or MachineError, or sets `status` if it ends with another exit status than 0.
#pragma once

namespace mobbscope::cli {

class Command;

void add_bench_command(Command& program, int& status);
void add_conflicts_command(Command& program, int& status);
void add_convert_command(Command& program);
void add_diff_command(Command& program, int& status);
void add_fit_command(Command& program);
void add_graph_command(Command& program, int& status);
void add_info_command(Command& program);
void add_query_command(Command& program, int& status);
void add_render_command(Command& program);
void add_simulate_command(Command& program);
void add_test_command(Command& program, int& status);

}  // namespace mobbscope::cli
