/// Programs that this one starts, and the pipes to them.
#pragma once

#include <base/descriptor.h>

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The program that a shell would start by that name; nothing if PATH has none.
std::optional<std::filesystem::path> program_in_path(std::string_view name);

/// Both ways, between two ends, neither of which a program that is started gets by itself.
struct Connection {
    Descriptor here, there;
    /// Throws MachineError.
    static Connection make();
};

/// Appends some of what has come to the end of a Connection, and waits for nothing; false where no more will come.
bool read_some(const Descriptor& from, std::string& bytes);

/// Sends all to the end of a Connection; false, and no signal, if the reader has gone, or takes nothing for so many
/// seconds.
bool send_all(const Descriptor& to, std::string_view bytes, std::optional<double> patience = {});
/// No more will be sent.
void send_end(const Descriptor& to);

/// A file without a name, in memory, for what a program says. Throws MachineError.
Descriptor memory_file();
/// At most so many bytes of its beginning.
std::string beginning_of(const Descriptor& file, std::size_t most);

/// A program at work. It is killed when this ends, when the thread that started it does, and with this program, however
/// that ends.
class Process {
  public:
    /// Its standard input, output and error: descriptors; -1: nothing, /dev/null.
    struct Streams {
        int in = -1, out = -1, err = -1;
    };
    /// Throws MachineError naming the program if it cannot be started.
    Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, const Streams& streams);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void kill() const;
    /// How it ended, as waitpid tells it; nothing while it works.
    std::optional<int> ended();
    /// The same, waiting so long at most.
    std::optional<int> wait(double seconds);

  private:
    pid_t child_ = 0;
    std::optional<int> status_;
};

/// As fork; the child is killed when the thread that forked ends.
pid_t fork_tied();

/// How a child process ended, as waitpid tells it, waiting so long at most; nothing if it still works.
std::optional<int> wait_for_child(pid_t child, double seconds);
/// The same, however long it works.
int wait_for_child(pid_t child);

/// "crashed: Segmentation fault", "ended with status 2".
std::string how_it_ended(int status);

}  // namespace mobbscope
