// Scripts that are none.
#include <app/script/script.h>
#include <base/error.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

TEST(Script, WhatIsNoStatementNamesFileAndLine) {
    for (const auto& [script, says] : std::vector<std::pair<std::string, std::string>>{
             {"\n\nclik 1 2", "s: line 3: 'clik' is not a statement (did you mean 'click'?)"},
             {"click", "line 1: \"click\" needs a place"},
             {"click 1", "needs Y behind X"},
             {"click 1 2 up", "'up' is not one of left, right, middle, double"},
             {"click 1 2 left 3", "'3' is too much here"},
             {"# fine\nmove 1 2\nkey Ctrl+", "line 3: 'Ctrl+' is not a chord"},
             {"frames -1", "'-1' is not a whole number"},
             {"frames", "needs a number of frames"},
             {"size 10x10", "10x10"},
             {"picture a.jpg", "must end in .png"},
             {"picture", "needs a file name"},
             {"state a.txt", "must end in .json"},
             {"expect /a", "'' is not JSON"},
             {"expect a 1", "'a' is not a JSON pointer"},
             {"expect /a yes", "'yes' is not JSON"},
             {"expect /a ~ 1", "needs a tolerance"},
             {"expect /scene/fit/tree \"production\"", "line 1: `production` is called `blocks`"},
             {"run no.such.command", "there is no command 'no.such.command'"},
             {"wait -1", "from 0 to 3600"},
             {"until 1", "needs a JSON pointer"},
             {"until x /a 1", "'x' cannot be waited for"},
             {"until 1 /a", "'' is not JSON"},
             {"until 1 a b", "'a' is not a JSON pointer"},
             {"drop", "needs files or folders"},
             {"marks a.json", "must end in .txt"},
             {std::string("run view.top\nmo\0ve 1 2", 22), "line 2: 'mo\\u0000ve' is not a statement"},
             {"move \"a", "a quote is not closed"},
             {"type", "needs a text"}}) {
        try {
            Script::parse(script, "s");
            ADD_FAILURE() << script;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
        }
    }
}

TEST(Script, BlankLinesCommentsAndQuotesAreRead) {
    Script::parse("\r\n  # nothing\n\tmove \"a b\" # there\nclick a double\nexpect /x \"#1\"\ndrag a 1 2 middle\n",
                  "s");
}

}  // namespace
}  // namespace mobbscope::app
