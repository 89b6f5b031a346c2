/// The answer to one query for people.
#pragma once

#include <scene/answer.h>

#include <cstddef>
#include <iosfwd>

namespace mobbscope::cli {

/// A sentence, the counts, and what else was asked for.
void print_answer(std::ostream& out, std::size_t index, const SceneQuery& query, const Answer& answer);

}  // namespace mobbscope::cli
