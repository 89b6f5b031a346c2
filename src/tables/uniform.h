/// Random numbers that are the same on every machine: the standard's engines are, its distributions are not.
#pragma once

#include <cstdint>
#include <random>

namespace mobbscope {

class Uniform {
  public:
    explicit Uniform(std::uint64_t seed) : engine_(seed) {}

    /// In [low, high).
    double within(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    /// In [0, count), count > 0.
    int below(int count) { return static_cast<int>(within(0, count)); }

  private:
    std::mt19937_64 engine_;
};

}  // namespace mobbscope
