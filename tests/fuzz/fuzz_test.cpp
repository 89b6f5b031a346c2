// What fuzzers begin with, what they once found, and what they make of it: read or refused in one line, nothing else.
#include <fuzz/mutate.h>
#include <fuzz/targets.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace mobbscope::fuzz {
namespace {

class EveryReader : public ::testing::TestWithParam<Target> {};

TEST_P(EveryReader, ReadsItsSeeds) {
    const Target& target = GetParam();
    std::size_t read = 0;
    for (const std::string& seed : all_seeds(target)) {
        if (accepts(target, seed)) ++read;
    }
    EXPECT_GT(read, 0u);
}

TEST_P(EveryReader, ReadsOrRefusesMutants) {
    const Target& target = GetParam();
    const std::vector<std::string> seeds = all_seeds(target);
    std::mt19937 random(20261126);
    Mutation mutation{random, seeds, [&](const std::string& bytes) { return testing::mutated(bytes, random); }};
    constexpr std::size_t kRounds = 60;
    std::size_t read = 0;
    for (std::size_t round = 0; round < kRounds; ++round) {
        const std::string& seed = seeds[round % seeds.size()];
        if (accepts(target, mutated(target.form, seed, mutation))) ++read;
    }
    EXPECT_GT(read, kRounds / 30) << "most mutants die at the door";
}

INSTANTIATE_TEST_SUITE_P(Fuzz, EveryReader, ::testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& target) {
                             std::string name(target.param.name);
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace mobbscope::fuzz
