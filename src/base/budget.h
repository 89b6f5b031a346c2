/// How much memory a process spends on what its files hold: one budget for all that is unpacked, parsed and made of
/// them, so that a small file never fills the memory.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace mobbscope {

/// Bytes that any process may spend, and more for each byte of the files that it has read: what is honest needs less.
inline constexpr std::size_t kFreeBytes = std::size_t{512} << 20;
inline constexpr std::size_t kBytesPerByteRead = 1000;

/// Raises the budget by a file that was read.
void raise_budget(std::size_t bytes_read);

/// A part of the budget, which is given back when this ends. Safe from any number of threads, each with its own.
class Spent {
  public:
    Spent() = default;
    ~Spent() { give_back(); }
    Spent(Spent&& other) noexcept : bytes_(std::exchange(other.bytes_, 0)) {}
    Spent& operator=(Spent&& other) noexcept {
        std::swap(bytes_, other.bytes_);
        return *this;
    }

    /// Spends more; false, and nothing is spent, if the budget does not suffice.
    bool try_add(std::size_t bytes);
    /// The same; throws InputError naming the file and what takes too much, such as "its rows".
    void add(std::size_t bytes, const char* what, const std::string& file);
    /// Sees to it that at least so many bytes are spent, more at a time the more there are: for what grows bit by bit.
    bool try_cover(std::size_t bytes) { return bytes <= bytes_ || grow(bytes); }
    void cover(std::size_t bytes, const char* what, const std::string& file) {
        if (!try_cover(bytes)) add(bytes - bytes_, what, file);
    }

    std::size_t bytes() const { return bytes_; }
    /// Of the whole process.
    static std::size_t all();

  private:
    bool grow(std::size_t bytes);
    void give_back();

    std::size_t bytes_ = 0;
};

}  // namespace mobbscope
