/// The answer to one query of a scene, as the contract has it.
#pragma once

#include <base/json_writer.h>
#include <scene/fitted_scene.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

/// What is asked for besides the answer.
struct Details {
    Search search = Search::trees;
    bool trace = false;
    bool all_contacts = false;
};

struct Answer {
    std::optional<mobb::Contact> contact;
    mobb::TestCounts tests;
    std::optional<mobb::Trace> trace;                     ///< if it was asked for
    std::optional<std::vector<int>> steps{};              ///< of the trace that are told of; none: all
    std::optional<std::vector<int>> avoidable{};          ///< events that are avoidable overlaps, from who judges them
    std::optional<std::vector<mobb::Interval>> contacts;  ///< likewise; of all members of bodies
    Search search = Search::trees;                        ///< that found it
};

Answer answer(const FittedScene& fitted, const SceneQuery& query, const Details& details);

/// The members of one element of `results` in the output of `query --json`; of bodies `members` are the two disks
/// asked.
void write_answer(JsonWriter& out, std::size_t index, const SceneQuery& query, const Answer& answer);

/// The answer in words: who collides when and where, or that they never do.
std::string sentence(const SceneQuery& query, const std::optional<mobb::Contact>& contact);

/// Whether the file says how many tests of some kind the answer is to take.
bool expects_tests(const SceneQuery& query);

/// How the answer disagrees with what the file expects of it; nothing if it agrees or nothing is expected. Tests are
/// those of trees, and not compared where pairs of samples were measured directly.
std::optional<std::string> disagreement(const SceneQuery& query, const Answer& answer);

}  // namespace mobbscope
