#include <base/budget.h>
#include <base/error.h>

#include <algorithm>
#include <atomic>

namespace mobbscope {

namespace {

std::atomic<std::size_t> budget{kFreeBytes};
std::atomic<std::size_t> held{0};

}  // namespace

void raise_budget(std::size_t bytes_read) { budget += kBytesPerByteRead * bytes_read; }

bool Spent::try_add(std::size_t bytes) {
    std::size_t before = held;
    do {
        const std::size_t most = budget;
        if (bytes > most || before > most - bytes) return false;
    } while (!held.compare_exchange_weak(before, before + bytes));
    bytes_ += bytes;
    return true;
}

void Spent::add(std::size_t bytes, const char* what, const std::string& file) {
    if (try_add(bytes)) return;
    throw InputError(
        file, std::string(what) + " would take more than " + bytes_text(budget) +
                  " of memory, which no file of this size needs; split it, or unpack it by hand where it is packed");
}

bool Spent::grow(std::size_t bytes) { return try_add(std::max(bytes, 2 * bytes_) - bytes_) || try_add(bytes - bytes_); }

void Spent::give_back() {
    held -= bytes_;
    bytes_ = 0;
}

std::size_t Spent::all() { return held; }

}  // namespace mobbscope
