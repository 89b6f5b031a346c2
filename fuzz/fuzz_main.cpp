// libFuzzer's side: the environment names the target. See docs/fuzzing.md.
#include <fuzz/mutate.h>
#include <fuzz/targets.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <unordered_set>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace mobbscope::fuzz {
namespace {

constexpr std::size_t kLargest = 100'000;  // bytes of an input

struct Chosen {
    const Target* target = nullptr;
    std::vector<std::string> seeds;
    bool plain = false;  ///< bytes are changed without any knowledge of them, to compare
    std::size_t accepted = 0, refused = 0;
    std::unordered_set<std::size_t> accepted_hashes;
    /// Inputs that were read, and that libFuzzer kept. Refusals are of many kinds, so it keeps more that were refused,
    /// and what is made of those is mostly refused for the same reason.
    std::vector<std::string> sound;
};

Chosen& chosen() {
    static Chosen of;
    return of;
}

const char* variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

/// FOLDER/TARGET/N for every target, whose names are printed.
void write_all_seeds(const std::filesystem::path& folder) {
    for (const Target& target : targets()) {
        const std::filesystem::path into = folder / target.name;
        std::filesystem::create_directories(into);
        std::size_t number = 0;
        for (const std::string& seed : all_seeds(target))
            std::ofstream(into / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
        std::printf("%s\n", std::string(target.name).c_str());
    }
}

void print_shares() {
    const std::size_t all = std::max<std::size_t>(chosen().accepted + chosen().refused, 1);
    std::fprintf(stderr, "%s: %zu of %zu inputs read (%.0f %%)\n", std::string(chosen().target->name).c_str(),
                 chosen().accepted, all, 100.0 * static_cast<double>(chosen().accepted) / static_cast<double>(all));
}

}  // namespace
}  // namespace mobbscope::fuzz

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    using namespace mobbscope::fuzz;
    try {
        if (const std::string folder = variable("MOBBSCOPE_FUZZ_SEEDS"); !folder.empty()) {
            write_all_seeds(folder);
            std::exit(0);
        }
        chosen().target = &target_named(variable("MOBBSCOPE_FUZZ_TARGET"));
        chosen().seeds = all_seeds(*chosen().target);
        chosen().plain = *variable("MOBBSCOPE_FUZZ_PLAIN") != '\0';
        std::atexit(print_shares);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        std::exit(2);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mobbscope::fuzz;
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    if (accepts(*chosen().target, bytes)) {
        ++chosen().accepted;
        chosen().accepted_hashes.insert(std::hash<std::string>{}(bytes));
    } else {
        ++chosen().refused;
    }
    return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
    using namespace mobbscope::fuzz;
    if (chosen().plain) return LLVMFuzzerMutate(data, size, most);
    const auto as_bytes = [](std::string bytes) {
        const std::size_t used = bytes.size();
        bytes.resize(std::min(used + 64, kLargest));
        bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), std::min(used, bytes.size()),
                                      bytes.size()));
        return bytes;
    };
    Mutation mutation{std::mt19937(seed), chosen().seeds, as_bytes};
    // Now and then what a reader looks at first is damaged too.
    if (mutation.one_in(10)) return LLVMFuzzerMutate(data, size, most);
    std::string from(reinterpret_cast<const char*>(data), size);
    std::vector<std::string>& sound = chosen().sound;
    if (chosen().accepted_hashes.contains(std::hash<std::string>{}(from))) {
        constexpr std::size_t kMostSound = 500;
        if (sound.size() < kMostSound) sound.emplace_back();
        sound[sound.size() < kMostSound ? sound.size() - 1 : mutation.below(kMostSound)] = from;
    } else if (!sound.empty() && !mutation.one_in(4)) {
        from = sound[mutation.below(sound.size())];
    }
    const std::string out = mutated(chosen().target->form, from, mutation);
    if (out.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::ranges::copy(out, data);
    return out.size();
}
