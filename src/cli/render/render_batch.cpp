#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/program.h>
#include <cli/render/render_job.h>

#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct BatchLine {
    int number = 0;
    std::vector<std::string> words;
};

/// Runs `what` for a line; what it throws names the line.
template <class What>
void at_line(const std::string& list, int number, const What& what) {
    const std::string place = list + ":" + std::to_string(number) + ": ";
    try {
        what();
    } catch (const MachineError& error) {
        throw MachineError(place + error.what());
    } catch (const UsageError& error) {
        throw InputError(place + error.what() + "; see mobbscope render --help");
    } catch (const InputError& error) {
        throw InputError(place + error.what());
    } catch (const std::invalid_argument& error) {
        throw InputError(place + error.what());
    }
}

std::string list_text(const std::filesystem::path& list) {
    if (list != "-") return read_file(list);
    return {std::istreambuf_iterator<char>(std::cin), {}};
}

/// Those that ask for something.
std::vector<BatchLine> lines_of(std::string_view text, const std::string& name) {
    std::vector<BatchLine> out;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view one = trimmed(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        at_line(name, number, [&] {
            std::vector<std::string> words = split_line(one).words;
            if (!words.empty()) out.push_back({number, std::move(words)});
        });
    }
    if (out.empty()) throw InputError(name, "asks for no picture; give the arguments of one on each line");
    return out;
}

/// What a line says takes the place of all that stands beside the list about the same thing.
void drop_contradicted(const Command& line, RenderArguments& arguments) {
    const auto says = [&](const char* option) { return line.is_given(option); };
    const auto drop = [&](const char* option, auto& value) {
        if (!says(option)) value = {};
    };
    ViewArguments& view = arguments.view;
    if (says("--level")) {
        if (!says("--query")) view.shown.erase("query");
        if (!says("--step")) view.shown.erase("step");
    }
    if (says("--query") && !says("--level")) view.shown.erase("levels");
    if (says("--view") || says("--yaw") || says("--pitch")) drop("--view", view.preset);
    if (says("--view")) {
        drop("--yaw", view.yaw);
        drop("--pitch", view.pitch);
        drop("--fov", view.fov);
        drop("--target", view.target);
        drop("--distance", view.distance);
        drop("--shift", view.shift);
    }
    SequenceArguments& sequence = arguments.sequence;
    if (says("--frames") || says("--play") || says("--turntable")) {
        drop("--frames", sequence.frames);
        drop("--play", sequence.play);
        drop("--turntable", sequence.turntable);
        drop("--rate", sequence.rate);
    }
}

RenderArguments parsed(std::vector<std::string> words, RenderArguments arguments) {
    Command command;
    add_render_options(command, arguments);
    command.parse(std::move(words));
    drop_contradicted(command, arguments);
    if (arguments.backend) throw InputError("--backend: one context draws the whole list; give it beside --batch");
    return arguments;
}

}  // namespace

void render_batch(const std::filesystem::path& list, const RenderArguments& defaults, bool progress) {
    const std::string name = list == "-" ? "standard input" : list.string();
    if (defaults.outputs.any()) {
        throw InputError("--batch: each line names its own outputs; leave out -o, --ids and --draw-list");
    }
    RenderArguments of_line = defaults;
    of_line.backend.reset();
    const std::vector<BatchLine> lines = lines_of(list_text(list), name);
    RenderPlan plan(progress);
    for (const BatchLine& line : lines) at_line(name, line.number, [&] { plan.add(parsed(line.words, of_line)); });
    OutputCheck outputs;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        at_line(name, lines[i].number, [&] { plan.check_outputs(i, outputs); });
    }
    plan.draw(defaults.backend.value_or(Backend::automatic));
}

}  // namespace mobbscope::cli
