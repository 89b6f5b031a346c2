#include <base/budget.h>
#include <base/error.h>

#include <algorithm>
#include <atomic>

namespace mobbscope {

namespace {

std::atomic<std::size_t> budget{kFreeBytes};
std::atomic<std::size_t> held{0};   ///< now
std::atomic<std::size_t> spent{0};  ///< in all

/// False, and nothing is added, if that were more than `most`.
bool add_up_to(std::atomic<std::size_t>& sum, std::size_t bytes, std::size_t most) {
    std::size_t before = sum;
    do {
        if (bytes > most || before > most - bytes) return false;
    } while (!sum.compare_exchange_weak(before, before + bytes));
    return true;
}

}  // namespace

void raise_budget(std::size_t bytes_read) { budget += kBytesPerByteRead * bytes_read; }

bool Spent::try_add(std::size_t bytes) {
    if (!add_up_to(held, bytes, budget)) return false;
    if (!add_up_to(spent, bytes, kSpendings * budget)) {
        held -= bytes;
        return false;
    }
    bytes_ += bytes;
    return true;
}

void Spent::add(std::size_t bytes, const char* what, const std::string& file) {
    if (try_add(bytes)) return;
    throw InputError(file, std::string(what) + " would take more than " + bytes_text(budget) +
                               " of memory, which no file of this size needs; unpack it by hand, or split it");
}

bool Spent::grow(std::size_t bytes) {
    return try_add(std::max(bytes, 2 * bytes_) - bytes_) || try_add(bytes - bytes_);
}

void Spent::give_back() {
    held -= bytes_;
    bytes_ = 0;
}

std::size_t Spent::all() { return held; }

}  // namespace mobbscope
