/// What a command works on: a file, standard input or bytes, packed or not, whole or piece by piece.
#pragma once

#include <base/budget.h>
#include <base/text.h>

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace mobbscope {

/// Bytes, and what unpacking them takes of the budget.
struct InputBytes {
    std::string bytes;
    Spent spent{};
};

/// Bytes that are read any number of times, and by any number of threads. What gzip packed comes unpacked. Where that
/// is damaged, cut off, or grows beyond what a table would, reading throws InputError. Of a large file little is in
/// memory.
class Input {
  public:
    /// A file, or standard input ("-"), which is read once; if it is large it is kept in a file without a name. Throws
    /// InputError as read_file does, and MachineError if standard input cannot be kept.
    static Input open(const std::filesystem::path& file);
    /// Copies the bytes.
    template <std::convertible_to<std::string_view> Bytes>
    Input(const Bytes& bytes) : Input(std::string_view(bytes)) {}
    Input(std::string_view bytes);

    /// Throws InputError also if unpacking takes more than the budget.
    InputBytes all() const;
    /// At most the first `most` bytes of all.
    std::string beginning(std::size_t most) const;
    /// From the beginning on.
    TextPieces pieces() const;
    /// Whether over 100 MB, or over 1 MB of what is packed, are stored.
    bool is_large() const;

  private:
    friend class InputReader;
    struct Source;
    explicit Input(std::shared_ptr<const Source> source) : source_(std::move(source)) {}
    static Input standard_input();

    std::shared_ptr<const Source> source_;
};

/// Input::all of a file.
InputBytes read_input(const std::filesystem::path& file);

/// Input::beginning of a file; "" if there is no such file, or none that can be read.
std::string read_beginning(const std::filesystem::path& file, std::size_t most);

}  // namespace mobbscope
