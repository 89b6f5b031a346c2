/// What is fuzzed: every reader of the program, by name.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::fuzz {

/// How bytes are laid out, so that they can be changed within (mutate.h).
enum class Form { fbx, json, glb, lines, sqlite, gzip, png };

struct Target {
    std::string_view name;
    Form form;
    /// Reads the bytes and goes on as the program does. Throws InputError where it refuses them; what else it throws is
    /// a fault, and so is an answer that does not hold (std::logic_error).
    std::function<void(const std::string& bytes)> read;
    /// Sound files of the project and made ones, to begin with.
    std::vector<std::string> (*seeds)();
};

std::span<const Target> targets();

/// Throws std::invalid_argument, listing all, if there is none of that name.
const Target& target_named(std::string_view name);

/// Reads the bytes; false if they were refused. Throws std::logic_error if the refusal is not one line.
bool accepts(const Target& target, const std::string& bytes);

/// The target's seeds and the files in fuzz/seeds/NAME, those that once were a fault among them.
std::vector<std::string> all_seeds(const Target& target);

}  // namespace mobbscope::fuzz
