#include <cli/commands.h>
#include <cli/messages.h>
#include <cli/options.h>
#include <scene/fitted_scene.h>
#include <scene/json_writer.h>

#include <iomanip>
#include <iostream>
#include <memory>
#include <utility>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

struct Arguments {
    std::filesystem::path file;
    bool json = false;
    FitArguments fit;
    ImportOptions import_options;
};

/// The first `count` coordinates of a vector.
void write_vector(JsonWriter& out, const glm::dvec3& v, int count) {
    out.begin_array(Layout::row);
    for (int i = 0; i < count; ++i) out.value(v[i]);
    out.end_array();
}

void write_node(JsonWriter& out, const mobb::Tree& tree, int index) {
    const mobb::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
    const int dimensions = node.box.kind == mobb::BoxKind::obb2d ? 2 : 3;
    out.begin_object(Layout::row);
    out.member("index", index);
    out.member("parent", node.parent);
    out.member("level", node.level);
    out.member("first", node.first);
    out.member("count", node.count);
    out.member("leaf", node.is_leaf());
    out.member("kind", mobb::name(node.box.kind));
    out.key("center");
    write_vector(out, node.box.center, dimensions);
    out.key("axes");
    out.begin_array();
    for (int i = 0; i < dimensions; ++i) write_vector(out, node.box.axes[static_cast<std::size_t>(i)], dimensions);
    out.end_array();
    out.key("half");
    write_vector(out, node.box.half, dimensions);
    out.member("t0", tree.t0(node));
    out.member("t1", tree.t1(node));
    out.end_object();
}

void write_level(JsonWriter& out, const mobb::LevelFigures& figures) {
    out.begin_object(Layout::row);
    out.member("level", figures.level);
    out.member("nodes", figures.nodes);
    out.member("volume", figures.volume);
    out.key("tightness");
    figures.tightness ? out.value(*figures.tightness) : out.null();
    out.end_object();
}

void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree) {
    out.begin_object();
    out.member("clip", clip);
    out.member("tree", mobb::name(tree.options().tree));
    out.member("axes", mobb::name(tree.options().axes));
    out.member("leaf", tree.options().leaf);
    out.member("time_scale", tree.options().time_scale);
    out.key("levels");
    out.begin_array();
    for (const mobb::LevelFigures& figures : mobb::level_figures(tree)) write_level(out, figures);
    out.end_array();
    out.key("nodes");
    out.begin_array();
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) write_node(out, tree, i);
    out.end_array();
    out.end_object();
}

void print_json(const FittedScene& fitted) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.key("trees");
    out.begin_array();
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        write_tree(out, fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i));
    }
    out.end_array();
    out.end_object();
}

void print_tree(const std::string& clip, const mobb::Tree& tree) {
    const mobb::FitOptions& options = tree.options();
    std::cout << clip << ": " << counted(tree.clip().count(), "sample", "samples") << " in "
              << brief(tree.clip().duration()) << " s; " << mobb::name(options.tree) << " tree of "
              << counted(static_cast<long long>(tree.nodes().size()), "node", "nodes") << " (leaf " << options.leaf
              << ", axes " << mobb::name(options.axes) << ", time scale " << brief(options.time_scale) << " m/s)\n"
              << "  level   nodes   volume m^2*s   tightness\n";
    for (const mobb::LevelFigures& figures : mobb::level_figures(tree)) {
        std::cout << std::setw(7) << figures.level << std::setw(8) << figures.nodes << std::setw(15)
                  << brief(figures.volume) << std::setw(12) << (figures.tightness ? brief(*figures.tightness) : "-")
                  << '\n';
    }
}

void run(const Arguments& arguments) {
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

void add_fit_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("fit", "Fit a tree to every clip and show how tight its levels are");
    const auto arguments = std::make_shared<Arguments>();
    add_scene_file(*command, arguments->file);
    command->add_flag("--json", arguments->json, "Levels and nodes as JSON");
    add_fit_options(*command, arguments->fit);
    add_import_options(*command, arguments->import_options);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace mobbscope::cli
