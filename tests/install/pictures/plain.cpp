// No CMake, no library, C++17: the header alone.
#include <mobbscope/picture_tests.h>

void stands() {
    ASSERT_PICTURE(std::string("person.json"), "person");
    EXPECT_ANSWERS(std::filesystem::path("person.json"), "person");
}
