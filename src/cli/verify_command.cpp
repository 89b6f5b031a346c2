#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/certificate_file.h>

#include <algorithm>
#include <iostream>
#include <limits>

namespace mobbscope::cli {

namespace {

struct VerifyCommandArguments {
    std::filesystem::path file, certificate;
    ImportOptions import_options;
};

/// "A and B never collide: 2 lines keep them at least 0.183 m apart."
std::string proven(const SceneQuery& query, const Certificate& proof) {
    std::string out = cleaned(query.a.name) + " and " + cleaned(query.b.name);
    out +=
        proof.contact ? " collide at " + to_thousandth(proof.contact->time) + " s, and not before" : " never collide";
    if (proof.tiles.empty()) return out + (proof.contact ? "." : ": they share no time.");
    double gap = std::numeric_limits<double>::infinity();
    for (const Tile& tile : proof.tiles) gap = std::min(gap, tile.gap);
    const bool one = proof.tiles.size() == 1;
    return out + ": " + counted(proof.tiles.size(), "line", "lines") + (one ? " keeps" : " keep") + " them at least " +
           figure(std::max(gap, 0.0)) + " m apart.";
}

int run_verify(VerifyCommandArguments& arguments) {
    Scene loaded = load(arguments.file, arguments.import_options);
    const mobb::FitOptions fit = loaded.fit;
    const FittedScene scene(std::move(loaded), fit);
    const std::string name = shown_name(arguments.certificate);
    const std::vector<QueryCertificate> all = read_certificates(read_input(arguments.certificate), name, scene);
    std::size_t failed = 0;
    for (const QueryCertificate& each : all) {
        const SceneQuery query = scene.queries()[static_cast<std::size_t>(each.query)];
        const mobb::PlacedTree a = scene.placed(query.a), b = scene.placed(query.b);
        const std::string why = why_not_proven(a.placed_clip(), b.placed_clip(), each.proof);
        const std::string number = std::to_string(each.query);
        if (why.empty()) {
            std::cout << number << ": " << proven(query, each.proof) << '\n';
        } else {
            complain(name + ": query " + number + " is not proven: " + why);
            ++failed;
        }
    }
    std::cout << all.size() - failed << " of " << counted(scene.queries().size(), "query", "queries") << " proven\n";
    flush_results();
    return failed == 0 ? kDone : kFailed;
}

void add_verify_options(Command& command, VerifyCommandArguments& arguments) {
    add_parsed(command, "FILE", arguments.file, parse_file_name, "The scene", "FILE").required();
    add_parsed(command, "CERT", arguments.certificate, parse_file_name, "What query --certificate wrote", "CERT")
        .required();
    add_import_options(command, arguments.import_options);
}

}  // namespace

void add_verify_command(Command& program) {
    program.add_subcommand("verify",
                           "Check the proofs of answers against the samples alone. Status 1 if one proves nothing",
                           add_verify_options, run_verify);
}

}  // namespace mobbscope::cli
