#include <base/file.h>
#include <base/input.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/certificate_file.h>
#include <explain/proof_words.h>
#include <scene/answer.h>

#include <iostream>

namespace mobbscope::cli {

namespace {

struct VerifyCommandArguments {
    std::filesystem::path file, certificate;
    ImportOptions import_options;
};

int run_verify(VerifyCommandArguments& arguments) {
    Scene loaded = load(arguments.file, arguments.import_options);
    refuse_bodies(loaded, "a proof");
    const mobb::FitOptions fit = loaded.fit;
    const FittedScene scene(std::move(loaded), fit);
    const std::string name = shown_name(arguments.certificate);
    const std::vector<QueryCertificate> all = read_certificates(read_input(arguments.certificate).bytes, name, scene);
    std::size_t failed = 0, doubtful = 0;
    for (const QueryCertificate& each : all) {
        const SceneQuery query = scene.queries()[static_cast<std::size_t>(each.query)];
        const mobb::PlacedTree a = scene.placed(query.a), b = scene.placed(query.b);
        const std::string why = why_not_proven(a.placed_clip(), b.placed_clip(), each.proof);
        const std::string number = std::to_string(each.query);
        if (why.empty()) {
            std::cout << number << ": " << sentence(query, each.proof.contact) << ' ' << proof_words(each.proof, {})
                      << '\n';
            const std::string doubt =
                doubt_words(cleaned(query.a.name), a.placed_clip(), cleaned(query.b.name), b.placed_clip());
            if (doubt.empty()) continue;
            std::cout << "   Not proven: " << doubt << ".\n";
            ++doubtful;
        } else {
            std::string message = name;
            message.append(": query ").append(number).append(" is not proven: ").append(why);
            complain(message);
            ++failed;
        }
    }
    std::cout << all.size() - failed << " of " << counted(scene.queries().size(), "query", "queries") << " proven"
              << (doubtful > 0 ? ", " + std::to_string(doubtful) + " of them as far as doubles hold their times" : "")
              << '\n';
    flush_results();
    return failed == 0 ? kDone : kFailed;
}

void add_verify_options(Command& command, VerifyCommandArguments& arguments) {
    add_scene_file(command, arguments.file);
    command.add_option("CERT", arguments.certificate, "What query --certificate wrote; - is standard input").required();
    add_import_options(command, arguments.import_options);
}

}  // namespace

void add_verify_command(Command& program) {
    program.add_subcommand("verify",
                           "Check the proofs of answers against the samples alone. Status 1 if one proves nothing",
                           add_verify_options, run_verify);
}

}  // namespace mobbscope::cli
