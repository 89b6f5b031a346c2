/// Arguments that make no command line.
#pragma once

#include <stdexcept>

namespace mobbscope::cli {

/// Bad usage: the program says what is wrong, names --help, and exits with 2.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace mobbscope::cli
