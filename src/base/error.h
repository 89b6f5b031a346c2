/// What goes wrong outside the program's control, said in one line.
#pragma once

#include <base/text.h>

#include <stdexcept>
#include <string>

namespace mobbscope {

/// A file or value given by the user cannot be used. what() is one line: the file (and, where one file names another,
/// both), the place in it, and what to do. The program exits with 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    /// "file: place: message"; an empty place is left out, and the file "-" is called standard input. Names are
    /// cleaned.
    InputError(const std::string& file, const std::string& place, const std::string& message)
        : std::runtime_error((file == "-" ? "standard input" : cleaned(file)) + ": " +
                             (place.empty() ? "" : place + ": ") + message) {}
    InputError(const std::string& file, const std::string& message) : InputError(file, "", message) {}
};

/// What `work` gives. A std::invalid_argument that it throws becomes an InputError at this place of the file.
template <class Work>
auto at_place(const std::string& file, const std::string& place, const Work& work) {
    try {
        return work();
    } catch (const std::invalid_argument& error) {
        throw InputError(file, place, error.what());
    }
}

/// The machine lacks something: no GL, a file that cannot be written. The program exits with 3.
class MachineError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Whoever read standard output, or a pipe that is written, has gone away. The program ends quietly, by SIGPIPE.
class ReaderGone : public MachineError {
  public:
    using MachineError::MachineError;
};

}  // namespace mobbscope
