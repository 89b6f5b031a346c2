#include <app/commands/arguments.h>
#include <app/commands/palette_entries.h>
#include <app/document/agents.h>
#include <base/text.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Scores: the searched word is a whole word of the text, its beginning, or a part of it.
constexpr double kWhole = 1;
constexpr double kBegin = 0.8;
constexpr double kWithin = 0.3;
constexpr std::size_t kLeastWithin = 3;  // letters
// ... or its letters are scattered in the text: at most this.
constexpr double kFuzzy = 0.1;
// A title says more than the same word elsewhere.
constexpr double kAlsoShare = 0.7;
constexpr double kIdShare = 0.6;
constexpr double kDocShare = 0.3;
constexpr double kOtherPlaces = 0.05;  // of the same word in the other fields
constexpr double kNamed = 0.2;         // that a thing's whole name is looked for
constexpr double kPerLetter = 1e-3;    // shorter titles say more of what was meant
constexpr std::size_t kMostQueries = 2000;

// ... of the letters of fuzzy_score.
constexpr double kLetter = 1;
constexpr double kWordStart = 6;
constexpr double kRun = 7;
constexpr double kLeastPerLetter = 4;  // below, the match is fuzzy
constexpr double kPerLength = 0.02;    // shorter texts say more of what was meant
constexpr double kNone = -std::numeric_limits<double>::infinity();

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80; }

struct SearchField {
    std::string_view text;
    double share = 1;
    bool by_words = false;  ///< many words, in which a few letters would be found always
};

/// How the letters of a word match where no word begins with it: together, or scattered in order.
enum class Letters { together, fuzzy };

/// The score of a word in a field; 0: it is not found.
double found_in(std::string_view word, const SearchField& field, Letters letters) {
    if (const auto begun = word_score(word, field.text)) return *begun;
    if (field.by_words) return 0;
    const auto alike = [&](char a, char b) { return lower_letter(a) == lower_letter(b); };
    const bool within =
        std::search(field.text.begin(), field.text.end(), word.begin(), word.end(), alike) != field.text.end();
    if (within && word.size() >= kLeastWithin) return kWithin;
    if (letters == Letters::together) return 0;
    const double most = (kLetter + kRun) * static_cast<double>(word.size());
    return kFuzzy * std::max(fuzzy_score(word, field.text).value_or(0), 0.0) / most;
}

/// Every word must be found in some field, in any order.
std::optional<double> score(const std::vector<std::string>& words, std::initializer_list<SearchField> fields,
                            Letters letters) {
    double sum = 0;
    for (const std::string& word : words) {
        double best = 0;
        double all = 0;
        for (const SearchField& field : fields) {
            const double here = field.share * found_in(word, field, letters);
            best = std::max(best, here);
            all += here;
        }
        if (best == 0) return std::nullopt;
        sum += best + kOtherPlaces * (all - best);
    }
    return sum;
}

struct Scored {
    double score = 0;
    PaletteEntry entry;
};

class Collector {
  public:
    Collector(const Session& session, const std::string& text, Letters letters)
        : session_(session), text_(text), words_(words_of(text)), letters_(letters) {}

    /// A command by `words`; `extra` counts besides what is found of them.
    void add(const Command& command, std::string argument, std::string title, std::string_view detail,
             std::initializer_list<SearchField> fields, std::span<const std::string> words, double extra = 0) {
        const std::vector<std::string> looked_for(words.begin(), words.end());
        const auto found = score(looked_for, fields, letters_);
        if (!found) return;
        const bool in_title = score(looked_for, {{title}}, letters_).has_value();
        // Where nothing is looked for, commands stay as the menus have them.
        const double letters = looked_for.empty() ? 0 : static_cast<double>(title.size());
        const double points = *found + extra - kPerLetter * letters;
        found_.push_back({points,
                          {&command, std::move(argument), std::move(title), std::string(detail),
                           std::string(in_title ? std::string_view() : command.doc),
                           std::string(first_shortcut(command)), std::string(why_not(session_, command))}});
    }
    /// ... of a thing, before commands about it where its whole name is looked for.
    void add(std::string_view id, std::string argument, std::string title, std::string_view detail,
             std::initializer_list<SearchField> fields) {
        const double extra = std::ranges::equal(title, text_, {}, lower_letter, lower_letter) ? kNamed : 0;
        add(*find_command(id, commands(session_)), std::move(argument), std::move(title), detail, fields, words_,
            extra);
    }
    const std::vector<std::string>& words() const { return words_; }
    bool has_words() const { return !words_.empty(); }
    /// Whether one of the words is found in a text.
    bool is_any_in(std::string_view text) const {
        return std::ranges::any_of(words_,
                                   [&](const std::string& word) { return found_in(word, {text}, letters_) > 0; });
    }
    bool empty() const { return found_.empty(); }

    std::vector<PaletteEntry> sorted() && {
        std::stable_sort(found_.begin(), found_.end(), [](const Scored& a, const Scored& b) {
            if (a.entry.why_not.empty() != b.entry.why_not.empty()) return a.entry.why_not.empty();
            return a.score > b.score;
        });
        std::vector<PaletteEntry> out;
        out.reserve(found_.size());
        for (Scored& scored : found_) out.push_back(std::move(scored.entry));
        return out;
    }

  private:
    const Session& session_;
    std::string text_;
    std::vector<std::string> words_;
    Letters letters_;
    std::vector<Scored> found_;
};

// --- arguments in the text

std::string_view without_dots(std::string_view title) {
    return title.ends_with("...") ? title.substr(0, title.size() - 3) : title;
}

/// The parts of a text between the characters of `separators`.
std::vector<std::string_view> parts_of(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> out;
    while (true) {
        const std::size_t end = text.find_first_of(separators);
        out.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return out;
        text.remove_prefix(end + 1);
    }
}

/// Whether a word can stand for one of a command's argument: "N" for a whole number, "S", "DX" or "FACTOR" for a
/// number, "leaves" for itself. What stands for a name takes anything, and is not guessed.
bool fits_placeholder(std::string_view placeholder, std::string_view word) {
    static constexpr std::array<std::string_view, 14> kNumbers{
        "DEG", "DX", "DY", "FACTOR", "FROM", "LEAST", "MOST", "SECONDS", "T0", "T1", "TIME", "TIME_A", "TIME_B", "TO"};
    if (placeholder == "N" || placeholder == "K") return parse_int(word).has_value();
    if (placeholder.size() == 1 || std::ranges::find(kNumbers, placeholder) != kNumbers.end()) {
        return parse_double(word).has_value();
    }
    return placeholder == word && std::ranges::all_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
}

bool is_fit(std::string_view word) {
    try {
        parse_fit(word, {});
    } catch (const std::invalid_argument&) {
        return false;
    }
    return true;
}

/// "N", "A:B", "auto", "FIT", "OPTION=VALUE": one alternative of a word.
bool fits_word(std::string_view wanted, std::string_view word) {
    if (wanted == "FIT") return is_fit(word);
    if (wanted == "OPTION=VALUE")
        return parts_of(word, "=").size() == 2 && !word.starts_with('=') && !word.ends_with('=');
    const auto placeholders = parts_of(wanted, ":,");
    const auto words = parts_of(word, ":,");
    return std::ranges::equal(placeholders, words, fits_placeholder);
}

/// How many words at the end of a text are what a command takes; 0: none are.
std::size_t words_of_argument(std::string_view argument, const std::vector<std::string>& words) {
    if (argument.starts_with('[')) argument = argument.substr(1, argument.size() - 2);
    for (const std::string_view alternative : parts_of(argument, "|")) {
        std::vector<std::string> wanted = words_of(alternative);
        if (wanted.empty()) continue;
        // "FIT FIT..." takes more of the last one.
        const bool takes_more = wanted.back().ends_with("...");
        if (takes_more) wanted.back().resize(wanted.back().size() - 3);
        std::size_t count = 0;
        while (wanted.size() < words.size()) {
            const auto last = words.end() - static_cast<std::ptrdiff_t>(wanted.size());
            if (!std::equal(wanted.begin(), wanted.end(), last, fits_word)) break;
            count = wanted.size();
            if (!takes_more) break;
            wanted.push_back(wanted.back());
        }
        if (count > 0) return count;
    }
    return 0;
}

/// "step 400" is the command "Go to step..." with what it takes.
void add_with_argument(Collector& out, const Command& command) {
    const std::size_t count = words_of_argument(command.argument, out.words());
    if (count == 0) return;
    const std::span<const std::string> all(out.words());
    const auto head = all.first(all.size() - count);
    // A letter or two begin too many words.
    if (std::ranges::none_of(head, [](const std::string& word) { return word.size() >= 3; })) return;
    std::string argument;
    for (const std::string& word : all.last(count)) argument.append(argument.empty() ? "" : " ").append(word);
    const std::string title(without_dots(command.title));
    std::string with = title;
    with.append(": ").append(argument);
    out.add(command, argument, std::move(with), command.menu,
            {{title}, {command.also, kAlsoShare, true}, {command.id, kIdShare, true}}, head,
            static_cast<double>(count) * kWhole);
}

void add_command(Collector& out, const Session& session, const Command& command) {
    const std::string title(command.title);
    out.add(command, "", title, command.menu,
            {{title}, {command.also, kAlsoShare, true}, {command.id, kIdShare}, {command.doc, kDocShare, true}},
            out.words());
    // Those of `go` are the things themselves.
    if (!out.has_words() || command.id.starts_with("go.")) return;
    if (!command.choices) return add_with_argument(out, command);
    for (const std::string& choice : command.choices(session)) {
        std::string named(without_dots(title));
        named.append(": ").append(title_of_choice(command, choice));
        // What is said of the command alone is no more about this choice than about the next.
        if (!out.is_any_in(title_of_choice(command, choice)) && !out.is_any_in(choice)) continue;
        // Scripts' name for it is found too, where menus have another.
        out.add(command, choice, named, command.menu,
                {{named}, {command.also, kAlsoShare, true}, {command.id, kIdShare}, {choice, kIdShare}}, out.words());
    }
}

/// "A 2.1".
void add_node(Collector& out, const Session& session, const std::string& text) {
    try {
        const auto [name, place] = name_and_word(text, "the node");
        for (const PlacedAgent& who : session.workspace.fitted().placed_agents()) {
            if (!std::ranges::equal(who.name, name, {}, lower_letter, lower_letter)) continue;
            static_cast<void>(node_at(session.workspace.fitted().tree(who), place));
            const std::string named = who.name + ' ' + std::string(place);
            out.add("go.node", named, named, "Node", {{named}});
        }
    } catch (const std::invalid_argument&) {
        // What was typed is no node.
    }
}

void add_things(Collector& out, const Session& session) {
    for (const std::string& name : path_names(session.workspace))
        out.add("go.agent", name, name, "Agent", {{name}, {"agent"}});
    for (const SceneClip& clip : session.workspace.scene().clips) {
        out.add("go.clip", clip.name, clip.name, "Clip", {{clip.name}, {"clip"}});
    }
    // All pairs of a crowd would take seconds with each letter; they are found from their agents.
    const std::size_t count = session.workspace.fitted().queries().size();
    for (std::size_t i = 0; i < (count <= kMostQueries ? count : 0); ++i) {
        const SceneQuery query = session.workspace.fitted().queries()[i];
        const std::string title = query.a.name + " against " + query.b.name;
        out.add("query.select", std::to_string(i), title, "Query", {{title}, {"query " + std::to_string(i)}});
    }
}

void collect(Collector& out, const Session& session, const std::string& text) {
    const bool names = out.has_words();
    if (names && !session.screen) add_node(out, session, text);
    for (const Command& command : commands(session)) {
        if (belongs_here(session, command)) add_command(out, session, command);
    }
    if (!names) return;
    if (!session.screen) add_things(out, session);
    for (const NamedThing& thing : session.screen ? session.screen->things() : std::vector<NamedThing>()) {
        out.add(thing.command, thing.name, thing.name, thing.kind, {{thing.name}, {thing.kind}});
    }
}

}  // namespace

std::vector<PaletteEntry> palette_entries(const Session& session, const std::string& text) {
    Collector out(session, text, Letters::together);
    collect(out, session, text);
    if (!out.empty()) return std::move(out).sorted();
    // Fuzzy matches are found nearly everywhere, so words go first.
    Collector fuzzy(session, text, Letters::fuzzy);
    collect(fuzzy, session, text);
    return std::move(fuzzy).sorted();
}

std::vector<std::string> matching_choices(const Session& session, const Command& command, const std::string& text) {
    if (!command.choices) return {};
    const std::vector<std::string> all = command.choices(session);
    std::vector<std::pair<double, std::string>> matching;
    for (const Letters letters : {Letters::together, Letters::fuzzy}) {
        for (const std::string& choice : all) {
            const auto points = score(words_of(text), {{choice}, {title_of_choice(command, choice)}}, letters);
            if (points) matching.emplace_back(*points, choice);
        }
        if (!matching.empty()) break;
    }
    std::stable_sort(matching.begin(), matching.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> out;
    for (auto& [points, choice] : matching) out.push_back(std::move(choice));
    return out;
}

std::optional<double> fuzzy_score(std::string_view word, std::string_view text) {
    if (word.empty()) return 0;
    // best[j]: of the letters so far with the last of them at text[j].
    std::vector<double> best(text.size(), kNone);
    for (std::size_t i = 0; i < word.size(); ++i) {
        std::vector<double> next(text.size(), kNone);
        double before = kNone;  // the best of those that end before j
        for (std::size_t j = 0; j < text.size(); ++j) {
            if (j > 0) before = std::max(before, best[j - 1]);
            if (lower_letter(text[j]) != lower_letter(word[i])) continue;
            const bool starts = in_word(text[j]) && (j == 0 || !in_word(text[j - 1]));
            const double here = kLetter + (starts ? kWordStart : 0);
            if (i == 0) {
                next[j] = here;
            } else {
                next[j] = std::max(before + here,
                                   j > 0 ? best[j - 1] + kLetter + std::max(starts ? kWordStart : 0, kRun) : kNone);
            }
        }
        best = std::move(next);
    }
    const double score = text.empty() ? kNone : *std::max_element(best.begin(), best.end());
    if (score < kLeastPerLetter * static_cast<double>(word.size())) return std::nullopt;
    return score - kPerLength * static_cast<double>(text.size());
}

std::optional<double> word_score(std::string_view word, std::string_view text) {
    std::optional<double> best;
    for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
        if (at > 0 && in_word(text[at - 1])) continue;
        if (!std::ranges::equal(word, text.substr(at, word.size()), {}, lower_letter, lower_letter)) continue;
        const std::size_t end = at + word.size();
        if (end == text.size() || !in_word(text[end])) return kWhole;
        best = kBegin;
    }
    return best;
}

}  // namespace mobbscope::app
