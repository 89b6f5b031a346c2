/// What a case holds besides pictures: the answers to its queries, every test of them, and the trees.
///
/// Goldens are JSON with a line for each query, test or node:
///
///     {"mobbscope_answers": 1, "answers": [{"query": 0, "a", "b", "collides", "contact", "tests": {...}}, ...]}
///     {"mobbscope_trace": 1, "traces": [{"query": 0, "a", "b", "events": 12, "trace": [...]}, ...]}
///     {"mobbscope_fit": 1, "trees": [{"clip", "tree", "axes", "leaf", "time_scale", "nodes": [...]}, ...]}
///
/// as `query --json`, `query --trace --json` and `fit --json` write them. An entry of a panel with another fit than the
/// panels before it has "panel", its index, too.
#pragma once

#include <cases/case_file.h>
#include <picture_tests/shot.h>
#include <scene/answer.h>
#include <scene/fitted_scene.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {

/// How far the numbers of nodes may be from the golden's, times the number if that is over 1: metres, seconds. Other
/// processors and compilers round otherwise. Answers are held to the last digit, gaps and distances of a trace to
/// kTraceAgreement.
inline constexpr double kFitAgreement = 1e-9;

/// What differs, one line each, the most important first; empty: nothing does.
using Differences = std::vector<std::string>;

/// A case's queries, answered with the fits of its panels.
class HeldAnswers {
  public:
    /// Asks only what is held. Throws InputError if there is no query to ask.
    HeldAnswers(const Shot& shot, const CaseTerms& terms);

    /// The golden as it would be now, of anything but a picture.
    std::string golden(Held held) const;
    /// Compares with a golden; `file` stands for it in messages. Throws InputError if it is none.
    Differences differences(Held held, const std::string& golden, const std::string& file) const;

    struct Query {
        std::size_t index = 0;
        SceneQuery query;
        Answer answer;
    };
    /// A fit, and what is asked with it.
    struct Fit {
        std::size_t panel = 0;  ///< the first that has it
        std::string words;      ///< before what is said of it, "panel 1, "; empty where there is only one fit
        std::shared_ptr<const FittedScene> fitted;
        std::vector<Query> queries{};
    };

    struct Fits {
        std::vector<Fit> fits;
        std::vector<std::string> titles;  ///< of the panels
    };

  private:
    Fits fits_;
};

/// The answers to all queries of the scene that are not those that it expects, in the words of `mobbscope query`, with
/// the fits of the panels.
Differences unexpected_answers(const Shot& shot);

}  // namespace mobbscope::picture_tests
