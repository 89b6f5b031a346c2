#include <picture_tests/held_answers.h>

#include <base/error.h>
#include <base/json.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/trace_comparison.h>
#include <explain/tree_json.h>
#include <mobb/query.h>
#include <mobb/trace.h>
#include <scene/scene_json.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

namespace mobbscope::picture_tests {

namespace {

using Fit = HeldAnswers::Fit;
using Query = HeldAnswers::Query;

constexpr int kVersion = 1;

std::vector<std::string> titles_of(const Shot& shot) {
    std::vector<std::string> out;
    for (const PicturePanel& panel : shot.panels) out.push_back(panel.title);
    return out;
}

/// "panel 'fine', ", or with its index in the golden: "panel 1, "
std::string panel_words(const std::vector<std::string>& titles, std::size_t panel) {
    const bool has_title = panel < titles.size() && !titles[panel].empty();
    return "panel " + (has_title ? in_quotes(titles[panel]) : std::to_string(panel)) + ", ";
}

/// The different fits of the panels.
std::vector<Fit> fits_of(const Shot& shot) {
    std::vector<Fit> out;
    for (std::size_t i = 0; i < shot.panels.size(); ++i) {
        const auto& fitted = shot.panels[i].fitted;
        if (std::ranges::find(out, fitted, &Fit::fitted) == out.end()) out.push_back({i, "", fitted});
    }
    if (out.size() == 1) return out;
    const std::vector<std::string> titles = titles_of(shot);
    for (Fit& fit : out) fit.words = panel_words(titles, fit.panel);
    return out;
}

/// Those that the panels of a fit name, or all of the scene.
std::vector<std::size_t> asked(const Shot& shot, const Fit& fit) {
    const std::size_t count = fit.fitted->queries().size();
    std::vector<std::size_t> out;
    for (const PicturePanel& panel : shot.panels) {
        if (panel.fitted != fit.fitted) continue;
        for (std::size_t i = 0; i < count; ++i) {
            if (!panel.query || i == static_cast<std::size_t>(*panel.query)) out.push_back(i);
        }
        if (panel.query && static_cast<std::size_t>(*panel.query) >= count) {
            throw InputError(shot.file.string(), "",
                             "there is no query " + std::to_string(*panel.query) + ": the scene has " +
                                 counted(count, "query", "queries"));
        }
    }
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

std::string pair_words(const std::string& a, const std::string& b) { return cleaned(a) + " and " + cleaned(b); }

// --- goldens as they are written

/// An object with the version of its kind and a list.
std::string golden_text(Held held, const char* list, const std::function<void(JsonWriter&)>& write) {
    std::ostringstream text;
    JsonWriter json(text);
    json.begin_object();
    json.member("mobbscope_" + std::string(name(held)), kVersion);
    json.begin_array(list);
    write(json);
    json.end_array();
    json.end_object();
    return std::move(text).str();
}

void write_panel(JsonWriter& json, const Fit& fit) {
    if (fit.panel > 0) json.member("panel", fit.panel);
}

std::string answers_text(const std::vector<Fit>& fits) {
    return golden_text(Held::answers, "answers", [&](JsonWriter& json) {
        for (const Fit& fit : fits) {
            for (const Query& one : fit.queries) {
                json.begin_object(JsonWriter::Layout::row);
                write_panel(json, fit);
                Answer bare;
                bare.contact = one.answer.contact;
                bare.tests = one.answer.tests;
                write_answer(json, one.index, one.query, bare);
                json.end_object();
            }
        }
    });
}

std::string traces_text(const std::vector<Fit>& fits) {
    return golden_text(Held::trace, "traces", [&](JsonWriter& json) {
        for (const Fit& fit : fits) {
            for (const Query& one : fit.queries) {
                json.begin_object();
                write_panel(json, fit);
                json.members("query", one.index, "a", one.query.a.name, "b", one.query.b.name);
                json.member("events", one.answer.trace->events());
                json.key("trace");
                write_trace(json, *one.answer.trace);
                json.end_object();
            }
        }
    });
}

std::string trees_text(const std::vector<Fit>& fits) {
    return golden_text(Held::fit, "trees", [&](JsonWriter& json) {
        for (const Fit& fit : fits) {
            const std::vector<SceneClip>& clips = fit.fitted->scene().clips;
            for (std::size_t i = 0; i < clips.size(); ++i) {
                json.begin_object();
                write_panel(json, fit);
                write_fitted_nodes(json, clips[i].name, fit.fitted->tree(static_cast<int>(i)));
                json.end_object();
            }
        }
    });
}

// --- goldens as they are read

/// The entries of a golden of a kind; throws InputError if it is none.
JsonPlace entries_of(const JsonPlace& root, Held held, const char* list) {
    const std::string key = "mobbscope_" + std::string(name(held));
    root.allow_only({key, list});
    const JsonPlace version = root.require(key);
    if (version.number() != kVersion) {
        version.fail("the golden has version " + format_double(version.number()) + "; this program reads version " +
                     std::to_string(kVersion));
    }
    return root.require(list);
}

std::size_t panel_of(const JsonPlace& entry) {
    const auto panel = entry.find("panel");
    return panel ? static_cast<std::size_t>(panel->integer(0, kMaxInt)) : 0;
}

/// What an entry of a golden is of: panel, and query or clip.
template <class Of>
using Key = std::pair<std::size_t, Of>;

/// A query of a golden.
struct GoldenQuery {
    std::string a, b;
    std::optional<mobb::Contact> contact;
    mobb::TestCounts tests;
    mobb::Trace trace{};
};

GoldenQuery read_answer(const JsonPlace& entry) {
    entry.allow_only({"panel", "query", "a", "b", "collides", "contact", "tests"});
    GoldenQuery out{entry.require("a").string(), entry.require("b").string(), {}, {}};
    const JsonPlace contact = entry.require("contact"), tests = entry.require("tests");
    out.contact = read_contact(contact, kMaxInt, kMaxInt);
    if (entry.require("collides").boolean() != out.contact.has_value()) contact.fail("it does not fit collides");
    const ExpectedTests counts = read_test_counts(tests);
    for (const mobb::TestKind test : mobb::kTestKinds) {
        if (!counts[test.index()]) tests.fail("the key " + in_quotes(mobb::name(test)) + " is missing");
        out.tests[test] = *counts[test.index()];
    }
    return out;
}

GoldenQuery read_stored_trace(const JsonPlace& entry) {
    entry.allow_only({"panel", "query", "a", "b", "events", "trace"});
    GoldenQuery out{entry.require("a").string(), entry.require("b").string(), {}, {}};
    const JsonPlace trace = entry.require("trace");
    out.trace = read_trace(trace, kMaxInt, kMaxInt);
    out.trace.leave_out(entry.require("events").count(out.trace.size()) - out.trace.size());
    return out;
}

using GoldenQueries = std::map<Key<std::size_t>, GoldenQuery>;

GoldenQueries read_queries(const std::string& golden, const std::string& file, Held held, const char* list,
                           const std::function<GoldenQuery(const JsonPlace&)>& read) {
    const JsonText value = parse_json(golden, file);
    const JsonPlace root(value, file);
    const JsonPlace entries = entries_of(root, held, list);
    GoldenQueries out;
    entries.each([&](const JsonPlace& entry) {
        const JsonPlace query = entry.require("query");
        const Key<std::size_t> key{panel_of(entry), static_cast<std::size_t>(query.integer(0, kMaxInt))};
        if (!out.emplace(key, read(entry)).second) query.fail("the query is given twice");
    });
    return out;
}

// --- what differs

/// Lines with what they are sorted by: the least first, and of these the one that is the farthest off.
class RankedLines {
  public:
    enum Rank { whole, contact, tests };
    void add(Rank rank, std::string line, double off = 0) { lines_.emplace_back(rank, -off, std::move(line)); }
    Differences sorted() {
        std::ranges::stable_sort(lines_, {},
                                 [](const auto& one) { return std::pair(std::get<0>(one), std::get<1>(one)); });
        Differences out;
        for (auto& line : lines_) out.push_back(std::move(std::get<2>(line)));
        return out;
    }

  private:
    std::vector<std::tuple<Rank, double, std::string>> lines_;
};

/// "1.4500000000000002 s instead of 1.45 s"
std::string instead(double now, double before, const char* unit) {
    return format_double(now) + unit + " instead of " + format_double(before) + unit;
}

/// "they collide at ...", all that differs of two contacts; empty if nothing does.
std::string contact_words(const mobb::Contact& now, const mobb::Contact& before) {
    std::string out;
    const auto add = [&](bool same, const char* what, const auto& words) {
        if (same) return;
        out.append(out.empty() ? "" : ", ").append(what).append(words());
    };
    const auto samples = [](const mobb::Contact& contact) {
        return std::to_string(contact.a_sample) + " and " + std::to_string(contact.b_sample);
    };
    add(now.time == before.time, "they collide at ", [&] { return instead(now.time, before.time, " s"); });
    add(now.a_sample == before.a_sample && now.b_sample == before.b_sample, "in samples ",
        [&] { return samples(now) + " instead of " + samples(before); });
    add(now.distance == before.distance, "in contact they are apart by ",
        [&] { return instead(now.distance, before.distance, " m"); });
    add(now.radii == before.radii, "their radii add up to ", [&] { return instead(now.radii, before.radii, " m"); });
    return out;
}

/// "31 tests of time instead of 10 (3.1 times as many), 2 of samples instead of 4 (2 times fewer)"; empty if none
/// differs. `off`: how far the number that is the farthest off is, as a factor.
std::string tests_words(const mobb::TestCounts& now, const mobb::TestCounts& before, double& off) {
    std::string out;
    for (const mobb::TestKind test : mobb::kTestKinds) {
        if (now[test] == before[test]) continue;
        const double times = static_cast<double>(now[test]) / static_cast<double>(before[test]);
        off = std::max(off, std::max(times, 1 / times));
        out += out.empty() ? counted(now[test], "test", "tests") : ", " + std::to_string(now[test]);
        out.append(" of ").append(mobb::name(test)).append(" instead of ").append(std::to_string(before[test]));
        const std::string ratio = ratio_words(static_cast<double>(now[test]), static_cast<double>(before[test]));
        if (!ratio.empty()) out.append(" (").append(ratio).append(")");
    }
    return out;
}

/// "query 0, A and B: "
std::string query_words(const Fit& fit, const Query& one) {
    return fit.words + "query " + std::to_string(one.index) + ", " + pair_words(one.query.a.name, one.query.b.name) +
           ": ";
}

/// Before what is said of a panel of the golden.
std::string words_of_panel(const HeldAnswers::Fits& fits, std::size_t panel) {
    const auto fit = std::ranges::find(fits.fits, panel, &Fit::panel);
    return fit == fits.fits.end() ? panel_words(fits.titles, panel) : fit->words;
}

/// Calls with each query that a golden has too, and tells of those that only one side has.
void each_pair(const HeldAnswers::Fits& fits, GoldenQueries golden, RankedLines& lines,
               const std::function<void(const Fit&, const Query&, const GoldenQuery&)>& compare) {
    for (const Fit& fit : fits.fits) {
        for (const Query& one : fit.queries) {
            const std::string query = query_words(fit, one);
            const auto stored = golden.extract({fit.panel, one.index});
            if (stored.empty()) {
                lines.add(RankedLines::whole, query + "the golden has no such query");
                continue;
            }
            const GoldenQuery& before = stored.mapped();
            if (one.query.a.name != before.a || one.query.b.name != before.b)
                lines.add(RankedLines::whole, query + "the golden has " + pair_words(before.a, before.b));
            compare(fit, one, before);
        }
    }
    for (const auto& [key, before] : golden) {
        lines.add(RankedLines::whole, words_of_panel(fits, key.first) + "query " + std::to_string(key.second) + ", " +
                                          pair_words(before.a, before.b) +
                                          ": only the golden has it, now it is not asked");
    }
}

Differences answers_that_differ(const HeldAnswers::Fits& fits, GoldenQueries golden) {
    RankedLines lines;
    each_pair(fits, std::move(golden), lines, [&](const Fit& fit, const Query& one, const GoldenQuery& before) {
        const std::string query = query_words(fit, one);
        const std::optional<mobb::Contact>& now = one.answer.contact;
        if (now && !before.contact) {
            return lines.add(RankedLines::whole,
                             query + "they collide at " + format_double(now->time) + " s; in the golden they never do");
        }
        if (!now && before.contact) {
            return lines.add(RankedLines::whole, query + "no collision; the golden has one at " +
                                                     format_double(before.contact->time) + " s");
        }
        const std::string contact = now ? contact_words(*now, *before.contact) : "";
        if (!contact.empty()) lines.add(RankedLines::contact, query + contact);
        double off = 0;
        const std::string tests = tests_words(one.answer.tests, before.tests, off);
        if (!tests.empty()) lines.add(RankedLines::tests, query + tests, off);
    });
    return lines.sorted();
}

Differences traces_that_differ(const HeldAnswers::Fits& fits, GoldenQueries golden) {
    RankedLines lines;
    each_pair(fits, std::move(golden), lines, [&](const Fit& fit, const Query& one, const GoldenQuery& before) {
        const std::string query = query_words(fit, one);
        const TraceCheck check = check_trace(before.trace, *one.answer.trace);
        if (check.agrees() && before.trace.size() == one.answer.trace->size()) return;
        if (check.agrees()) {
            // Both are recorded with one limit.
            return lines.add(RankedLines::tests, query + "the golden has only " + std::to_string(before.trace.size()) +
                                                     " of " + counted(check.stored_events, "event", "events") +
                                                     ", now there are " + std::to_string(one.answer.trace->size()) +
                                                     "; it was cut");
        }
        lines.add(RankedLines::tests,
                  query + check_words(check, named_sides(*fit.fitted, one.query), before.trace, *one.answer.trace));
    });
    return lines.sorted();
}

/// Whether two numbers, words or truth values of a tree are the same but for rounding, which whole numbers do not have.
bool same_scalar(const JsonPlace& now, const JsonPlace& before, bool whole) {
    if (now.is_number() && before.is_number()) {
        if (whole) return now.number() == before.number();
        const double size = std::max(1.0, std::abs(before.number()));
        return std::abs(now.number() - before.number()) <= kFitAgreement * size;
    }
    if (now.is_string() && before.is_string()) return now.string() == before.string();
    return now.is_boolean() && before.is_boolean() && now.boolean() == before.boolean();
}

std::string shown(const JsonPlace& value) {
    if (value.is_number()) return format_double(value.number());
    if (value.is_boolean()) return value.boolean() ? "true" : "false";
    if (value.is_array()) return counted(value.size(), "value", "values");
    if (value.is_null()) return "null";
    return value.is_string() ? cleaned(value.string()) : "an object";
}

/// The same with the type, of values of two types: "the text '10'"
std::string shown_with_type(const JsonPlace& value) {
    return value.is_string() ? "the text " + in_quotes(value.string()) : shown(value);
}

/// "half[1] 0.41 instead of 0.4": the first that differs of two values, which may be arrays; empty if nothing does.
std::string value_words(const JsonPlace& now, const JsonPlace& before, const std::string& what, bool whole) {
    if (!now.is_array() || !before.is_array() || now.size() != before.size()) {
        if (same_scalar(now, before, whole)) return "";
        if (now.is_string() != before.is_string())
            return what + ' ' + shown_with_type(now) + " instead of " + shown_with_type(before);
        return what + ' ' + shown(now) + " instead of " + shown(before);
    }
    for (int i = 0; i < now.size(); ++i) {
        const JsonPlace one = now[i], other = before[i];
        std::string words = value_words(one, other, what + '[' + std::to_string(i) + ']', whole);
        if (!words.empty()) return words;
    }
    return "";
}

/// The same of the members of two objects, of each that differs, but for their nodes. Throws InputError if the golden
/// has others.
std::string members_words(const JsonPlace& now, const JsonPlace& before) {
    constexpr std::array<std::string_view, 6> kWhole{"leaf", "first", "count", "index", "parent", "level"};
    const auto kind = now.find("kind"), golden_kind = before.find("kind");
    // Boxes of two kinds have other members.
    if (kind && golden_kind) {
        std::string words = value_words(*kind, *golden_kind, "kind", false);
        if (!words.empty()) return words;
    }
    std::vector<std::string_view> keys;
    if (now.find("nodes")) keys.push_back("panel");
    for (int i = 0; i < now.members(); ++i) {
        const JsonPlace member = now.member(i);
        keys.push_back(member.key());
    }
    before.allow_only(keys);
    std::string out;
    for (int i = 0; i < now.members(); ++i) {
        const JsonPlace member = now.member(i);
        if (member.key() == "nodes") continue;
        const JsonPlace other = before.require(member.key());
        const bool whole = std::ranges::find(kWhole, member.key()) != kWhole.end();
        const std::string words = value_words(member, other, member.key(), whole);
        if (!words.empty()) out.append(out.empty() ? "" : ", ").append(words);
    }
    return out;
}

/// What differs between a tree and the golden's; empty if nothing does.
std::string tree_words(const JsonPlace& now, const JsonPlace& before) {
    std::string out = members_words(now, before);
    const auto add = [&](const std::string& more) { out.append(out.empty() ? "" : "; ").append(more); };
    const JsonPlace nodes = now.require("nodes"), golden_nodes = before.require("nodes");
    if (nodes.size() != golden_nodes.size())
        add(counted(nodes.size(), "node", "nodes") + " instead of " + std::to_string(golden_nodes.size()));
    int differing = 0;
    for (int i = 0; i < std::min(nodes.size(), golden_nodes.size()); ++i) {
        const JsonPlace node = nodes[i], golden_node = golden_nodes[i];
        const std::string words = members_words(node, golden_node);
        if (!words.empty() && differing++ == 0) add("node " + std::to_string(i) + ": " + words);
    }
    // Of a tree with another number of nodes the others say nothing.
    if (differing > 1 && nodes.size() == golden_nodes.size())
        out += ", and " + counted(differing - 1, "node", "nodes") + " more";
    return out;
}

Differences trees_that_differ(const HeldAnswers::Fits& fits, const std::string& golden, const std::string& file) {
    const std::string name = "the fit";
    const JsonText value = parse_json(golden, file), now_value = parse_json(trees_text(fits.fits), name);
    const JsonPlace root(value, file), now_root(now_value, name);
    const JsonPlace stored = entries_of(root, Held::fit, "trees"), now = now_root.require("trees");
    std::map<Key<std::string>, int> golden_trees;
    for (int i = 0; i < stored.size(); ++i) {
        const JsonPlace entry = stored[i];
        const JsonPlace clip = entry.require("clip");
        if (!golden_trees.emplace(Key<std::string>{panel_of(entry), clip.string()}, i).second)
            clip.fail("the tree of " + in_quotes(clip.string()) + " is given twice");
    }
    RankedLines lines;
    for (int i = 0; i < now.size(); ++i) {
        const JsonPlace entry = now[i];
        const std::string& clip = entry.require("clip").string();
        const std::string tree = words_of_panel(fits, panel_of(entry)) + "fit of " + in_quotes(clip) + ": ";
        const auto at = golden_trees.extract({panel_of(entry), clip});
        if (at.empty()) {
            lines.add(RankedLines::whole, tree + "the golden has no such tree");
            continue;
        }
        const JsonPlace before = stored[at.mapped()];
        const std::string words = tree_words(entry, before);
        if (!words.empty()) lines.add(RankedLines::tests, tree + words);
    }
    for (const auto& [key, unused] : golden_trees) {
        lines.add(RankedLines::whole, words_of_panel(fits, key.first) + "fit of " + in_quotes(key.second) +
                                          ": only the golden has it, now there is no such tree");
    }
    return lines.sorted();
}

}  // namespace

HeldAnswers::HeldAnswers(const Shot& shot, const CaseTerms& terms) : fits_{fits_of(shot), titles_of(shot)} {
    if (!terms.holds(Held::answers) && !terms.holds(Held::trace)) return;
    for (Fit& fit : fits_.fits) {
        for (const std::size_t index : asked(shot, fit)) {
            const SceneQuery query = fit.fitted->queries()[index];
            fit.queries.push_back({index, query, answer(*fit.fitted, query, {.trace = terms.holds(Held::trace)})});
        }
        if (fit.queries.empty()) {
            throw InputError(shot.file.string(), "",
                             "the scene has no query whose answer could be held; give it queries or two agents, or "
                             "take answers and trace out of hold");
        }
    }
}

std::string HeldAnswers::golden(Held held) const {
    if (held == Held::answers) return answers_text(fits_.fits);
    return held == Held::trace ? traces_text(fits_.fits) : trees_text(fits_.fits);
}

Differences HeldAnswers::differences(Held held, const std::string& golden, const std::string& file) const {
    if (held == Held::answers)
        return answers_that_differ(fits_, read_queries(golden, file, held, "answers", read_answer));
    if (held == Held::trace)
        return traces_that_differ(fits_, read_queries(golden, file, held, "traces", read_stored_trace));
    return trees_that_differ(fits_, golden, file);
}

Differences unexpected_answers(const Shot& shot) {
    Differences out;
    for (const Fit& fit : fits_of(shot)) {
        const std::vector<SceneQuery>& queries = fit.fitted->scene().queries;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            if (!queries[i].expect) continue;
            auto words = disagreement(queries[i], answer(*fit.fitted, queries[i], {}));
            if (!words) continue;
            // Other words follow.
            if (words->ends_with('.')) words->pop_back();
            out.push_back(fit.words + "query " + std::to_string(i) + ": " + *words);
        }
    }
    return out;
}

}  // namespace mobbscope::picture_tests
