/// Which elements of two arrays belong together.
#pragma once

#include <render/compare/elements.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::compare {

/// An array, and what each of its elements stands for; empty: nothing by itself.
struct NamedElements {
    const Elements& elements;
    std::vector<std::string> names;
};

struct Alignment {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< places in the golden, the actual array; by the former
    std::vector<std::size_t> missing;                        ///< places in the golden
    std::vector<std::size_t> added;                          ///< places in the actual array

    bool all_there() const { return missing.empty() && added.empty(); }
    /// One of the golden that comes before another, and that other one, where in the actual array it comes after it.
    std::optional<std::pair<std::size_t, std::size_t>> out_of_order() const;
};

/// Elements belong together where they have the same name and all is equal, or nearly, or what is beside them belongs
/// together, or they are the most alike; then also where only their names differ.
Alignment align(const NamedElements& actual, const NamedElements& golden, const ElementTerms& terms);

}  // namespace mobbscope::compare
