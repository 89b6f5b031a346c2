/// Random numbers that are the same on every machine: the standard's engines are, its distributions are not.
#pragma once

#include <cstdint>
#include <random>

namespace mobbscope {

class Uniform {
  public:
    explicit Uniform(std::uint64_t seed) : engine_(seed) {}

    std::uint64_t next() { return engine_(); }
    /// In [low, high).
    double within(double low, double high) {
        return low + (high - low) * (static_cast<double>(next() >> 11) * 0x1p-53);
    }
    /// In [0, count), count > 0.
    int below(int count) { return static_cast<int>(within(0, count)); }

  private:
    std::mt19937_64 engine_;
};

/// SplitMix64 (Steele, Lea and Flood 2014), begun anew for every (seed, agent, choice).
class CounterRandom {
  public:
    CounterRandom(std::uint64_t seed, std::uint64_t agent, std::uint64_t choice)
        : state_(mixed(mixed(mixed(seed) + agent) + choice)) {}

    std::uint64_t next() { return mixed(state_++); }
    /// In [0, 1).
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    /// In [0, count), 0 < count < 2^32; the bias is below count / 2^32.
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>((next() >> 32) * count >> 32); }

  private:
    static constexpr std::uint64_t mixed(std::uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }

    std::uint64_t state_;
};

}  // namespace mobbscope
