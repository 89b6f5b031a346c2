// What goldens are drawn with: its file, and how it is told from another.
#include <base/error.h>
#include <picture_tests/reference.h>

#include "render/backends.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <string>

namespace mobbscope::picture_tests {
namespace {

const Reference kOurs{{{"Inter.otf", "0123456789abcdef"}, {"Mono.ttf", "fedc"}}, "1.86", "Mesa 22.3.6, llvmpipe"};

TEST(Reference, IsReadAsItWasWritten) {
    const TempFolder folder;
    EXPECT_FALSE(read_reference(folder.path()));
    write_reference(folder.path(), kOurs);
    const auto read = read_reference(folder.path());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->fonts, kOurs.fonts);
    EXPECT_EQ(read->imgui, kOurs.imgui);
    EXPECT_EQ(read->opengl, kOurs.opengl);
    EXPECT_EQ(what_is_other(*read, kOurs), "");
}

TEST(Reference, SaysWhatIsOther) {
    Reference here = kOurs;
    here.imgui = "1.90.1";
    EXPECT_EQ(what_is_other(here, kOurs), "Dear ImGui 1.90.1 for 1.86");
    here = kOurs;
    here.opengl = "Mesa 25.0.7, llvmpipe";
    EXPECT_EQ(what_is_other(here, kOurs), "Mesa 25.0.7, llvmpipe for Mesa 22.3.6, llvmpipe");
    here = kOurs;
    here.fonts["Inter.otf"] = "aaaaaaaaaaaa";
    EXPECT_EQ(what_is_other(here, kOurs), "Inter.otf aaaaaaaa for 01234567");
    here.fonts["Inter.otf"] = "0123456789abcdee";
    EXPECT_NE(what_is_other(here, kOurs), "") << "that the digits shown are the same says nothing";
    here = kOurs;
    here.fonts.erase("Mono.ttf");
    here.fonts["Other.ttf"] = "77";
    here.imgui = "2";
    EXPECT_EQ(what_is_other(here, kOurs), "Mono.ttf none for fedc, Other.ttf 77 for none, Dear ImGui 2 for 1.86");
}

TEST(Reference, IsTheProgramsOwn) {
    for (const Backend backend : {Backend::osmesa, Backend::egl}) {
        const auto renderer = mobbscope::testing::open_or_skip(backend);
        if (!renderer) return;
        const Reference here = reference_of(*renderer);
        EXPECT_EQ(here.fonts.size(), 2u);
        for (const auto& [name, hash] : here.fonts) EXPECT_EQ(hash.size(), 64u) << name;
        EXPECT_EQ(here.opengl.find('('), std::string::npos) << "the processor is all one: " << here.opengl;
        EXPECT_NE(here.opengl.find(", "), std::string::npos) << here.opengl;
    }
}

TEST(CoarsePicture, HasTheMeansOfFourPixelsIn64Levels) {
    Image image(5, 2);
    image.rgba.assign(image.rgba.size(), 255);
    for (int i = 0; i < 4; ++i) image.at(i % 2, i / 2)[0] = static_cast<std::uint8_t>(10 * i);
    const Image coarse = coarse_picture(image);
    EXPECT_EQ(coarse.width, 2);
    EXPECT_EQ(coarse.height, 1);
    EXPECT_EQ(coarse.at(0, 0)[0], 16) << "of 15";
    EXPECT_EQ(coarse.at(0, 0)[1], 255);
    EXPECT_EQ(coarse.at(0, 0)[3], 255) << "what is opaque stays so";
}

TEST(Reference, RefusesAFileThatIsNone) {
    const TempFolder folder;
    const auto refused = [&](const std::string& text, const std::string& why) {
        folder.write("reference.json", text);
        try {
            read_reference(folder.path());
            ADD_FAILURE() << text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
        }
    };
    refused("", "reference.json");
    refused("{}", "mobbscope_reference");
    refused(R"({"mobbscope_reference": 2})", "version 2; this program reads version 1");
    refused(R"({"mobbscope_reference": 1, "fonts": [], "imgui": "1", "opengl": "x"})", "/fonts");
    refused(R"({"mobbscope_reference": 1, "fonts": {}, "imgui": 1, "opengl": "x"})", "/imgui");
    refused(R"({"mobbscope_reference": 1, "fonts": {}, "imgui": "1"})", "opengl");
    refused(R"({"mobbscope_reference": 1, "fonts": {}, "imgui": "1", "open_gl": "x"})", "unknown key");
}

}  // namespace
}  // namespace mobbscope::picture_tests
