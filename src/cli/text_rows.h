/// Lists as text end after a million rows, which nobody reads; JSON and CSV are whole.
#pragma once

#include <cstddef>
#include <ostream>

namespace mobbscope::cli {

class TextRows {
  public:
    static constexpr std::size_t kMost = 1'000'000;

    /// Whether one more may be written; then it counts.
    bool take() { return written_ < kMost && ++written_ > 0; }

  private:
    std::size_t written_ = 0;
};

/// "... and 5 more; --json has all", behind `indent`; nothing if none is left out.
inline void tell_left_out(std::ostream& out, std::size_t left_out, const char* indent = "") {
    if (left_out > 0) out << indent << "... and " << left_out << " more; --json has all\n";
}

}  // namespace mobbscope::cli
