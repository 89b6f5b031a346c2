#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <mobb/level_figures.h>
#include <scene/fit_json.h>
#include <scene/fitted_scene.h>

#include <iomanip>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct FitCommandArguments {
    std::filesystem::path file;
    bool json = false;
    FitArguments fit;
    ImportOptions import_options;
};

void print_json(const FittedScene& fitted) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.begin_array("trees");
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        write_tree(out, fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i));
    }
    out.end_array();
    out.end_object();
}

void print_tree(const std::string& clip, const mobb::Tree& tree) {
    const mobb::FitOptions& options = tree.options();
    std::cout << cleaned(clip) << ": " << counted(tree.clip().count(), "sample", "samples") << " in "
              << brief(tree.clip().duration()) << " s; " << mobb::name(options.tree) << " tree of "
              << counted(static_cast<long long>(tree.nodes().size()), "node", "nodes") << " (leaf " << options.leaf
              << ", axes " << mobb::name(options.axes) << ", time scale " << brief(options.time_scale) << " m/s)\n";
    std::vector<std::string> heads;
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        heads.push_back(std::string(heads.empty() ? "  " : "   ") + column.key);
        if (*column.unit != '\0') heads.back() += std::string(" ") + column.unit;
        std::cout << heads.back();
    }
    std::cout << '\n';
    for (const mobb::LevelFigures& figures : mobb::level_figures(tree)) {
        for (std::size_t i = 0; i < heads.size(); ++i) {
            std::cout << std::setw(static_cast<int>(heads[i].size())) << level_text(mobb::kLevelColumns[i], figures);
        }
        std::cout << '\n';
    }
}

void run_fit(const FitCommandArguments& arguments) {
    Scene scene = load(arguments.file, arguments.import_options);
    const mobb::FitOptions options = arguments.fit.over(scene.fit);
    const FittedScene fitted(std::move(scene), options);
    if (arguments.json) {
        print_json(fitted);
    } else {
        for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
            print_tree(fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i));
        }
    }
    flush_results();
}

}  // namespace

void add_fit_command(Command& program) {
    Command& command = program.add_subcommand("fit", "Fit a tree to every clip and show how tight its levels are");
    const auto arguments = std::make_shared<FitCommandArguments>();
    add_scene_file(command, arguments->file);
    command.add_flag("--json", arguments->json, "Levels and nodes as JSON");
    add_fit_options(command, arguments->fit);
    add_import_options(command, arguments->import_options);
    command.callback([arguments] { run_fit(*arguments); });
}

}  // namespace mobbscope::cli
