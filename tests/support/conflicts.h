/// All conflicts of a crowd at once: those of tests are few.
#pragma once

#include <conflicts/conflicts.h>

#include <cstddef>
#include <vector>

namespace mobbscope {
inline namespace testing {

inline std::vector<PeopleConflict> all_of(const PeopleConflicts& conflicts) {
    std::vector<PeopleConflict> out;
    for (std::size_t i = 0; i < conflicts.size(); ++i) out.push_back(conflicts[i]);
    return out;
}

}  // namespace testing
}  // namespace mobbscope
