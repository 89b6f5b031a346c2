#include <app/commands/arguments.h>
#include <app/commands/palette_entries.h>
#include <app/document/agents.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace mobbscope::app {

namespace {

// A word that a title has says more than the same in the id or the explanation.
constexpr double kIdShare = 0.8;
constexpr double kDocShare = 0.3;
constexpr std::size_t kMostQueries = 2000;

struct SearchField {
    std::string_view text;
    double share = 1;
    bool sentence = false;
};

/// Every word must be found in some field, in any order.
std::optional<double> score(const std::vector<std::string>& words, std::initializer_list<SearchField> fields) {
    double sum = 0;
    for (const std::string& word : words) {
        std::optional<double> best;
        for (const SearchField& field : fields) {
            const auto found = field.sentence ? word_score(word, field.text) : fuzzy_score(word, field.text);
            if (found) best = std::max(best.value_or(0), *found * field.share);
        }
        if (!best) return std::nullopt;
        sum += *best;
    }
    return sum;
}

struct Scored {
    double score = 0;
    PaletteEntry entry;
};

class Collector {
  public:
    Collector(const Session& session, const std::string& text) : session_(session), words_(words_of(text)) {}

    void add(std::string_view id, std::string argument, std::string title, std::string detail,
             std::initializer_list<SearchField> fields) {
        const auto found = score(words_, fields);
        if (!found) return;
        const Command* command = find_command(id, commands(session_));
        found_.push_back({*found,
                          {command, std::move(argument), std::move(title), std::move(detail),
                           std::string(first_shortcut(*command)), std::string(why_not(session_, *command))}});
    }
    bool has_words() const { return !words_.empty(); }

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
    std::vector<std::string> words_;
    std::vector<Scored> found_;
};

void add_command(Collector& out, const Session& session, const Command& command) {
    const std::string title(command.title);
    const std::string menu(command.menu);
    out.add(command.id, "", title, menu, {{title}, {command.id, kIdShare}, {command.doc, kDocShare, true}});
    // Those of `go` are the things themselves.
    if (!out.has_words() || !command.choices || command.id.starts_with("go.")) return;
    for (const std::string& choice : command.choices(session)) {
        std::string named = title;
        named.append(": ").append(title_of_choice(command, choice));
        // Scripts' name for it is found too, where menus have another.
        out.add(command.id, choice, named, menu, {{named}, {command.id, kIdShare}, {choice, kIdShare}});
    }
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// "A 2.1".
void add_node(Collector& out, const Session& session, const std::string& text) {
    try {
        const auto [name, place] = name_and_word(text, "the node");
        for (const PlacedAgent& who : session.workspace.fitted().placed_agents()) {
            if (!std::ranges::equal(who.name, name, {}, lower, lower)) continue;
            static_cast<void>(node_at(session.workspace.fitted().tree(who.clip), place));
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

constexpr double kLetter = 1;
constexpr double kWordStart = 6;
constexpr double kRun = 7;
constexpr double kLeastPerLetter = 4;  // below, the letters are strewn about
constexpr double kPerLength = 0.02;    // shorter texts say more of what was meant
constexpr double kNone = -std::numeric_limits<double>::infinity();

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80; }

}  // namespace

std::vector<PaletteEntry> palette_entries(const Session& session, const std::string& text) {
    Collector out(session, text);
    const bool names = out.has_words();
    if (names && !session.screen) add_node(out, session, text);
    for (const Command& command : commands(session)) {
        if (belongs_here(session, command)) add_command(out, session, command);
    }
    if (!names) return std::move(out).sorted();
    if (!session.screen) add_things(out, session);
    for (const NamedThing& thing : session.screen ? session.screen->things() : std::vector<NamedThing>()) {
        out.add(thing.command, thing.name, thing.name, std::string(thing.kind), {{thing.name}, {thing.kind}});
    }
    return std::move(out).sorted();
}

std::vector<std::string> matching_choices(const Session& session, const Command& command, const std::string& text) {
    std::vector<std::pair<double, std::string>> found;
    if (command.choices) {
        for (std::string& choice : command.choices(session)) {
            if (const auto points = score(words_of(text), {{choice}})) found.emplace_back(*points, std::move(choice));
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> out;
    for (auto& [points, choice] : found) out.push_back(std::move(choice));
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
            if (lower(text[j]) != lower(word[i])) continue;
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
    for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
        if (at > 0 && in_word(text[at - 1])) continue;
        const std::string_view here = text.substr(at, word.size());
        if (std::ranges::equal(word, here, {}, lower, lower)) return fuzzy_score(word, here);
    }
    return std::nullopt;
}

}  // namespace mobbscope::app
