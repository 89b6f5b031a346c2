// The table of import options, and what files offer to them.
#include <import/import.h>
#include <support/bvh_text.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

std::string complaint(const char* key, const char* text) {
    ImportOptions options;
    try {
        set_option(options, *import_option(key), text);
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(options, ImportOptions{}) << "what is refused changes nothing";
        return error.what();
    }
    return "";
}

TEST(ImportOption, TextsAreReadBackAsTheyWereWritten) {
    ImportOptions options;
    const std::vector<std::pair<const char*, const char*>> texts{
        {"animation", "Walk"}, {"root", "Left Hip"}, {"fps", "29.97"},     {"unit", "cm"},
        {"up", "z"},           {"trim", "0.5 3.2"},  {"id", "17"},         {"origin", "start_heading"},
        {"radius", "0"},       {"dt", "0.04"},       {"motion", "linear"}, {"columns", "t=frame/25"},
        {"keep_jumps", "yes"}};
    ASSERT_EQ(texts.size(), std::size(kImportOptions)) << "every option";
    for (const auto& [key, text] : texts) {
        const ImportOption& option = *import_option(key);
        EXPECT_FALSE(option.is_given(options));
        set_option(options, option, text);
        EXPECT_TRUE(option.is_given(options));
        EXPECT_EQ(option_text(options, option), text);
    }
    for (const auto& [key, text] : texts) set_option(options, *import_option(key), "");
    EXPECT_EQ(options, ImportOptions{});
    EXPECT_EQ(import_option("roof"), nullptr);
}

TEST(ImportOption, WhatIsNoneOrOutOfRangeIsNamed) {
    EXPECT_EQ(complaint("fps", "fast"), "fps is a number, not 'fast'");
    EXPECT_EQ(complaint("fps", "0"), "fps must be over 0 and at most 1000000");
    EXPECT_EQ(complaint("unit", "mile"),
              "unit must be m, cm, in, auto or metres per file unit (over 0, at most 1000000)");
    EXPECT_EQ(complaint("trim", "3"), "trim is two times in seconds, such as 0.5 3.2, not '3'");
    EXPECT_NE(complaint("trim", "3 2").find("0 <= A < B"), std::string::npos);
    EXPECT_EQ(complaint("origin", "here"), "origin is keep, start or start_heading, not 'here'");
    EXPECT_EQ(complaint("motion", "fast"), "motion is held or linear, not 'fast'");
    EXPECT_EQ(complaint("keep_jumps", "1"), "keep_jumps is yes or no, not '1'");
}

std::vector<std::string> values_of(const OptionOffer& offer) {
    std::vector<std::string> out;
    for (const OfferedChoice& choice : offer.choices) out.push_back(choice.value);
    return out;
}

std::string keys_of(const ImportOffer& offer) {
    std::string out;
    for (const OptionOffer& option : offer.options) out += option.key + (option.required ? "! " : " ");
    return out;
}

TEST(ImportOffer, OfASkeletonSaysWhatWasGuessedAndWhy) {
    const TempFolder folder;
    const ParsedFile file = parse_clip_file(folder.write("walk.bvh", kWalker));
    const ImportOffer offer = file.offer({});
    EXPECT_EQ(keys_of(offer), "root fps unit up trim origin radius motion ");
    const ImportedClip taken = file.clips({}).front();
    EXPECT_EQ(offer.find("root")->taken, taken.facts.root);
    EXPECT_EQ(offer.find("root")->why, taken.facts.root_why);
    EXPECT_FALSE(taken.facts.root_why.empty());
    EXPECT_EQ(metres_per_unit(offer.find("unit")->taken), taken.facts.unit);
    EXPECT_NE(offer.find("unit")->why.find("guessed: a body"), std::string::npos);
    EXPECT_EQ(offer.seconds, taken.facts.duration);
    // Every choice can be imported, and every joint is one.
    for (const OptionOffer& option : offer.options) {
        for (const std::string& value : values_of(option)) {
            ImportOptions options;
            set_option(options, *import_option(option.key), value);
            EXPECT_EQ(file.clips(options).size(), 1u) << option.key << ' ' << value;
            EXPECT_EQ(option_text(options, *import_option(option.key)), value);
        }
    }
    // Where an option says it nothing was guessed.
    ImportOptions given;
    given.root = taken.facts.root;
    EXPECT_EQ(file.clips(given).front().facts.root_why, "");
}

TEST(ImportOffer, OfATableAsksForWhatTheFileLacks) {
    const TempFolder folder;
    const auto offer_of = [&](const char* text) { return parse_clip_file(folder.write("a.csv", text)).offer({}); };
    EXPECT_EQ(keys_of(offer_of("t,x,y,r\n0,0,0,1\n1,0,0,1\n")), "unit trim origin radius columns motion ");
    EXPECT_EQ(keys_of(offer_of("x,y\n0,0\n1,0\n")), "unit origin radius! dt! columns motion ");
    EXPECT_EQ(keys_of(offer_of("t,x,y,r\n0,0,0,1\n1,0,0,1\n5,0,0,1\n")), "fps unit trim origin radius columns motion ");
    EXPECT_EQ(keys_of(offer_of("id,frame,x,y\n1,0,0,0\n1,1,0,1\n")), "fps! unit origin radius columns motion ");
    EXPECT_EQ(keys_of(offer_of("#fps: 5\nid,frame,x,y\n1,0,0,0\n1,1,0,1\n")),
              "fps unit trim origin radius columns motion ");
    const ImportOffer several = offer_of("id,t,x,y,r\na,0,0,0,1\na,1,0,0,1\nb,0,0,0,1\nb,3,0,0,1\n");
    EXPECT_EQ(values_of(*several.find("id")), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(several.seconds, 3);
    EXPECT_EQ(several.find("motion")->taken, "linear") << "tracks";
    EXPECT_EQ(offer_of("t,x,y,r\n0,0,0,1\n1,0,0,1\n").find("motion")->taken, "held");
}

TEST(ImportOffer, OfATableHasTheColumnsThatMayHoldRadii) {
    const TempFolder folder;
    const ParsedFile file = parse_clip_file(folder.write("a.csv", "t,x,y,big\n0,0,0,2\n1,1,0,3\n"));
    const ImportOffer offer = file.offer({});
    ASSERT_EQ(values_of(*offer.find("radius")), std::vector<std::string>{"big"});
    EXPECT_TRUE(offer.find("radius")->required);
    ImportOptions options;
    set_option(options, *import_option("radius"), "big");
    EXPECT_EQ(file.clips(options).front().clip->samples()[1].r, 3);
}

TEST(ImportOffer, OfTracksSaysWhatWasAssumed) {
    const TempFolder folder;
    const ParsedFile file = parse_clip_file(folder.write("a.txt", "0 1 0 0\n10 1 1 0\n0 2 0 1\n10 2 1 1\n"));
    const ImportOffer offer = file.offer({});
    EXPECT_EQ(keys_of(offer), "fps unit trim origin id! radius dt motion ");
    EXPECT_EQ(offer.find("dt")->taken, "0.04");
    EXPECT_NE(offer.find("dt")->why.find("2.5 points a second are assumed"), std::string::npos);
    EXPECT_EQ(offer.find("radius")->taken, "0.2");
    // The warnings of its clips lead to the same options.
    const std::vector<ImportedClip> clips = file.clips({});
    ASSERT_FALSE(clips.front().facts.warnings.empty());
    for (const ImportWarning& warning : clips.front().facts.warnings) {
        EXPECT_NE(offer.find(warning.option), nullptr) << warning.text;
    }
}

}  // namespace
}  // namespace mobbscope
