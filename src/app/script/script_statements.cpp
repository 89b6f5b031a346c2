#include <app/commands/command.h>
#include <app/script/script_statements.h>
#include <app/script/state_json.h>
#include <base/file.h>
#include <base/text.h>
#include <render/drawlist/picture_options.h>
#include <render/image/png.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>
#include <variant>

namespace mobbscope::app {

namespace {

/// Two clicks further apart are no double click (ImGuiIO::MouseDoubleClickTime is 0.3 s).
constexpr double kNoDoubleClick = 0.4;
constexpr int kStepsOfDrag = 8;
constexpr double kLookAgain = 0.05;  // seconds
constexpr double kLongestWait = 3600;

// --- reading

using Place = std::variant<glm::vec2, std::string>;

/// The words behind the statement's name, taken one after the other.
class StatementWords {
  public:
    StatementWords(const ScriptLine& line, std::span<const Command> known_) : known(known_), line_(line) {}

    const std::span<const Command> known;  ///< commands

    bool done() const { return at_ == line_.words.size(); }
    std::string next(const std::string& what) {
        if (done()) throw std::invalid_argument("\"" + line_.words.front() + "\" needs " + what);
        return line_.words[at_++];
    }
    /// All that is left, as it stands.
    std::string_view rest() {
        std::string_view text = line_.rest;
        for (std::size_t i = 1; i < at_; ++i) text.remove_prefix(text.find(line_.words[i]) + line_.words[i].size());
        at_ = line_.words.size();
        return trimmed(text);
    }
    double number(const char* what) {
        const std::string word = next(what);
        const std::optional<double> value = parse_double(word);
        if (!value) {
            throw std::invalid_argument(in_quotes(word) + " is not a number: " + line_.words.front() + " needs " +
                                        what);
        }
        return *value;
    }
    int count(const char* what, int most) {
        const std::string word = next(what);
        const std::optional<int> value = parse_int(word);
        if (!value || *value < 0 || *value > most) {
            throw std::invalid_argument(in_quotes(word) + " is not a whole number from 0 to " + std::to_string(most));
        }
        return *value;
    }
    Place place() {
        if (done() || !parse_double(line_.words[at_])) return next("a place: X Y, or a widget's name");
        const double x = number("a place");
        return glm::vec2(x, number("Y behind X"));
    }
    /// One of these words if any is left; its index, else 0.
    template <std::size_t N>
    int choice(const std::array<std::string_view, N>& of) {
        if (done()) return 0;
        const std::string word = next("");
        const auto at = std::find(of.begin(), of.end(), word);
        if (at == of.end()) throw std::invalid_argument(in_quotes(word) + " is not one of " + listed(of));
        return static_cast<int>(at - of.begin());
    }
    /// All that is left, a file's name with this extension.
    std::string file(const char* extension) {
        if (done()) throw std::invalid_argument("\"" + line_.words[0] + "\" needs a file name");
        // A single word may have stood in quotes.
        std::string name = line_.words.size() == 2 ? next("") : std::string(rest());
        if (lower_extension(name) != extension) {
            throw std::invalid_argument(in_quotes(name) + " must end in " + extension);
        }
        return name;
    }
    /// The same; empty if nothing is left.
    std::string file_if_any(const char* extension) { return done() ? "" : file(extension); }
    void end() const {
        if (!done()) throw std::invalid_argument(in_quotes(line_.words[at_]) + " is too much here");
    }

  private:
    const ScriptLine& line_;
    std::size_t at_ = 1;
};

// --- mouse and keys

glm::vec2 resolve(const ScriptRun& run, const Place& place) {
    if (const auto* at = std::get_if<glm::vec2>(&place)) return *at;
    const std::string& name = std::get<std::string>(place);
    const std::map<std::string, Rect>& marks = run.host.shell().marks().all();
    const auto at = marks.find(name);
    if (at != marks.end()) return at->second.center();
    std::vector<std::string> names;
    for (const auto& mark : marks) names.push_back(mark.first);
    throw std::invalid_argument("there is no " + in_quotes(name) + " in the window now" + did_you_mean(name, names));
}

void move_to(ScriptRun& run, glm::vec2 at) {
    run.host.shell().feed(MouseMove{at});
    run.host.settle();
}

void press(ScriptRun& run, int button, bool down) {
    run.host.shell().feed(MouseButton{button, down});
    run.host.frame();
}

void click(ScriptRun& run, glm::vec2 at, int button, int times) {
    if (std::exchange(run.clicked, true)) run.host.run_for(kNoDoubleClick);
    move_to(run, at);
    for (int i = 0; i < times; ++i) {
        press(run, button, true);
        press(run, button, false);
    }
    run.host.settle();
}

void drag(ScriptRun& run, glm::vec2 from, glm::vec2 to, int button) {
    if (std::exchange(run.clicked, false)) run.host.run_for(kNoDoubleClick);
    move_to(run, from);
    press(run, button, true);
    for (int i = 1; i <= kStepsOfDrag; ++i) {
        run.host.shell().feed(MouseMove{from + (to - from) * (static_cast<float>(i) / kStepsOfDrag)});
        run.host.frame();
    }
    press(run, button, false);
    run.host.settle();
}

void press_chord(ScriptRun& run, const Chord& chord) {
    Shell& shell = run.host.shell();
    std::vector<Key> keys;
    if (chord.ctrl) keys.push_back(Key::ctrl);
    if (chord.alt) keys.push_back(Key::alt);
    if (chord.shift) keys.push_back(Key::shift);
    keys.push_back(chord.key);
    for (const Key key : keys) shell.feed(KeyPress{key, true});
    run.host.settle();
    for (auto key = keys.rbegin(); key != keys.rend(); ++key) shell.feed(KeyPress{*key, false});
    run.host.settle();
}

ScriptAction make_move(StatementWords& words) {
    const Place place = words.place();
    return [place](ScriptRun& run) { move_to(run, resolve(run, place)); };
}

ScriptAction make_click(StatementWords& words) {
    const Place place = words.place();
    const int how = words.choice(std::array<std::string_view, 4>{"left", "right", "middle", "double"});
    return [place, how](ScriptRun& run) { click(run, resolve(run, place), how == 3 ? 0 : how, how == 3 ? 2 : 1); };
}

ScriptAction make_drag(StatementWords& words) {
    const Place from = words.place();
    const double x = words.number("where to");
    const glm::vec2 to(x, words.number("where to"));
    const int button = words.choice(std::array<std::string_view, 3>{"left", "right", "middle"});
    return [from, to, button](ScriptRun& run) {
        const glm::vec2 begin = resolve(run, from);
        drag(run, begin, std::holds_alternative<std::string>(from) ? begin + to : to, button);
    };
}

ScriptAction make_scroll(StatementWords& words) {
    const Place place = words.place();
    const double notches = words.number("a number of notches");
    return [place, notches](ScriptRun& run) {
        move_to(run, resolve(run, place));
        run.host.shell().feed(Wheel{{0, notches}});
        run.host.settle();
    };
}

ScriptAction make_key(StatementWords& words) {
    const std::string name = words.next("a chord, such as Ctrl+S");
    const std::optional<Chord> chord = chord_from_name(name);
    if (!chord) throw std::invalid_argument(in_quotes(name) + " is not a chord; write it like Ctrl+Shift+S");
    return [chord](ScriptRun& run) { press_chord(run, *chord); };
}

ScriptAction make_type(StatementWords& words) {
    if (words.done()) throw std::invalid_argument("\"type\" needs a text");
    return [text = std::string(words.rest())](ScriptRun& run) {
        for (const char32_t code : code_points(text)) run.host.shell().feed(TypedText{code});
        run.host.settle();
    };
}

ScriptAction make_drop(StatementWords& words) {
    Drop drop;
    do {
        drop.paths.emplace_back(words.next("files or folders"));
    } while (!words.done());
    return [drop](ScriptRun& run) {
        run.host.shell().feed(drop);
        run.host.settle();
    };
}

// --- the window

ScriptAction make_run(StatementWords& words) {
    const std::string id = words.next("a command");
    const std::string argument(words.rest());
    command_named(id, words.known);
    return [id, argument](ScriptRun& run) {
        run_command(run.session, id, argument);
        run.host.settle();
    };
}

ScriptAction make_frames(StatementWords& words) {
    const int count = words.count("a number of frames", 100'000);
    return [count](ScriptRun& run) {
        for (int i = 0; i < count; ++i) run.host.frame();
    };
}

double seconds_in(const std::string& word) {
    const std::optional<double> seconds = parse_double(word);
    if (!seconds || !(*seconds >= 0 && *seconds <= kLongestWait)) {
        throw std::invalid_argument(in_quotes(word) + " cannot be waited for: give from 0 to 3600 seconds");
    }
    return *seconds;
}

ScriptAction make_wait(StatementWords& words) {
    const double seconds = seconds_in(words.next("seconds"));
    return [seconds](ScriptRun& run) {
        run.host.run_for(seconds);
        run.clicked = false;
    };
}

ScriptAction make_size(StatementWords& words) {
    const PictureSize size = parse_size(words.next("a size: WxH"));
    check(PictureOptions{.size = size});
    return [size](ScriptRun& run) {
        run.host.resize(size);
        run.host.settle();
    };
}

ScriptAction make_picture(StatementWords& words) {
    return [file = words.file(".png")](ScriptRun& run) {
        check_not_read(file);
        write_png(file, run.host.shell().read_back());
    };
}

ScriptAction make_viewport(StatementWords& words) {
    return [file = words.file(".png")](ScriptRun& run) {
        check_not_read(file);
        write_png(file, run.host.shell().viewport_picture());
    };
}

/// To a file, or where the script prints.
void put(ScriptRun& run, const std::string& file, const std::string& text) {
    if (file.empty()) {
        run.out << text;
    } else {
        check_not_read(file);
        write_file(file, text);
    }
}

ScriptAction make_marks(StatementWords& words) {
    const std::string file = words.file_if_any(".txt");
    return [file](ScriptRun& run) {
        std::ostringstream text;
        for (const auto& [name, rect] : run.host.shell().marks().all()) {
            text << name << ' ' << rect.min.x << ' ' << rect.min.y << ' ' << rect.max.x << ' ' << rect.max.y << '\n';
        }
        put(run, file, text.str());
    };
}

// --- the state

ScriptAction make_state(StatementWords& words) {
    const std::string file = words.file_if_any(".json");
    return [file](ScriptRun& run) { put(run, file, state_text(state_json(run.session), 2) + '\n'); };
}

/// What is there instead, in words; none if it is as wanted.
using Check = std::function<std::optional<std::string>(ScriptRun&)>;

/// Frames until it is as wanted, for so many seconds.
std::optional<std::string> await(ScriptRun& run, const Check& check, double seconds) {
    run.clicked = false;
    std::optional<std::string> instead = check(run);
    const int looks = static_cast<int>(std::ceil(seconds / kLookAgain));
    for (int i = 0; i < looks && instead && !run.session.files.closed(); ++i) {
        run.host.run_for(kLookAgain);
        instead = check(run);
    }
    return instead;
}

/// That there is a widget of this name.
Check widget_appears(const std::string& name) {
    return [name](ScriptRun& run) -> std::optional<std::string> {
        if (run.host.shell().marks().all().contains(name)) return std::nullopt;
        return "there is no " + in_quotes(name) + " in the window";
    };
}

ScriptAction make_expect(StatementWords& words) {
    return [expected = parse_expectation(words.rest())](ScriptRun& run) {
        if (const auto instead = expected(run.session)) throw ExpectationError(*instead);
    };
}

ScriptAction make_until(StatementWords& words) {
    const std::string for_so_long = words.next("seconds");
    const double seconds = seconds_in(for_so_long);
    const std::string_view rest = words.rest();
    Check check;
    if (!rest.empty() && !rest.starts_with('/') && !rest.starts_with('"') && rest.find_first_of(" \t") == rest.npos) {
        check = widget_appears(std::string(rest));
    } else {
        check = [expected = parse_expectation(rest)](ScriptRun& run) { return expected(run.session); };
    }
    return [check, seconds, for_so_long](ScriptRun& run) {
        if (const auto instead = await(run, check, seconds)) {
            throw ExpectationError(*instead + ", also after " + for_so_long + " s");
        }
    };
}

struct Verb {
    std::string_view name;
    ScriptAction (*make)(StatementWords& words);
    bool writes = false;
};

constexpr std::array<Verb, 17> kVerbs{{{"run", make_run},
                                       {"move", make_move},
                                       {"click", make_click},
                                       {"drag", make_drag},
                                       {"scroll", make_scroll},
                                       {"key", make_key},
                                       {"type", make_type},
                                       {"drop", make_drop},
                                       {"frames", make_frames},
                                       {"size", make_size},
                                       {"picture", make_picture, true},
                                       {"viewport", make_viewport, true},
                                       {"state", make_state, true},
                                       {"expect", make_expect},
                                       {"until", make_until},
                                       {"marks", make_marks, true},
                                       {"wait", make_wait}}};

const Verb* find_verb(std::string_view name) {
    const auto at = std::find_if(kVerbs.begin(), kVerbs.end(), [&](const Verb& verb) { return verb.name == name; });
    return at == kVerbs.end() ? nullptr : &*at;
}

}  // namespace

bool writes_output(const ScriptLine& line) {
    const Verb* verb = find_verb(line.words.front());
    return verb && verb->writes;
}

ScriptAction make_action(const ScriptLine& line, std::span<const Command> known) {
    const std::string& name = line.words.front();
    if (const Verb* verb = find_verb(name)) {
        StatementWords words(line, known);
        ScriptAction action = verb->make(words);
        words.end();
        return action;
    }
    std::vector<std::string> names;
    for (const Verb& verb : kVerbs) names.emplace_back(verb.name);
    throw std::invalid_argument(in_quotes(name) + " is not a statement" + did_you_mean(name, names));
}

}  // namespace mobbscope::app
