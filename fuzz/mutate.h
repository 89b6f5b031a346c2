/// Damage within a form: what is made still has the frame that a reader looks at first, with right offsets and sums.
#pragma once

#include <fuzz/targets.h>

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace mobbscope::fuzz {

/// What mutators draw from.
struct Mutation {
    std::mt19937 random;
    /// Whole files of the same form, of which parts are taken over.
    const std::vector<std::string>& donors;
    /// Changes bytes without any knowledge of them.
    std::function<std::string(const std::string&)> bytes;

    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random() % limit); }
    bool one_in(std::size_t many) { return below(many) == 0; }
    /// How many changes are made: mostly one, as many changes together are refused for the first of them.
    std::size_t edits() {
        std::size_t out = 1;
        while (out < 8 && one_in(3)) ++out;
        return out;
    }
    const std::string& donor() { return donors[below(donors.size())]; }
    /// A number that readers trip over, as text.
    std::string odd_number();
    /// A number that is another one: near it, or odd.
    double other_number(double number);
};

/// Bytes of that form with a few changes; bytes that are not of the form are changed as bytes.
std::string mutated(Form form, const std::string& bytes, Mutation& mutation);

// One form each; nothing where the bytes are not of it.
std::string mutated_json(const std::string& text, Mutation& mutation);
std::string mutated_lines(const std::string& text, Mutation& mutation);
std::string mutated_fbx(const std::string& bytes, Mutation& mutation);
std::string mutated_glb(const std::string& bytes, Mutation& mutation);
std::string mutated_png(const std::string& bytes, Mutation& mutation);
std::string mutated_gzip(const std::string& bytes, Mutation& mutation);
std::string mutated_sqlite(const std::string& bytes, Mutation& mutation);

}  // namespace mobbscope::fuzz
