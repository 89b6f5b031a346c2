/// The answer to one query of a scene, and how it is told.
#pragma once

#include <scene/fitted_scene.h>
#include <scene/json_writer.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// What is asked for besides the answer.
struct Details {
    bool brute = false;  ///< by the direct search, without trees
    bool trace = false;
    bool all_contacts = false;
};

struct Answer {
    std::optional<mobb::Contact> contact;
    mobb::TestCounts tests;
    std::optional<mobb::Trace> trace;
    std::optional<std::vector<mobb::Interval>> contacts;
};

Answer answer(const FittedScene& fitted, const SceneQuery& query, const Details& details);

/// One element of `results` (contract, `query --json`).
void write_answer(JsonWriter& out, int index, const SceneQuery& query, const Answer& answer);

/// The same for people: a sentence, the counts, and what else was asked for.
void print_answer(std::ostream& out, int index, const SceneQuery& query, const Answer& answer);

/// How the answer disagrees with what the file expects of it; nothing if it agrees or nothing is expected.
std::optional<std::string> disagreement(const SceneQuery& query, const Answer& answer);

}  // namespace mobbscope::cli
