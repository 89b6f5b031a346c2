#include <base/json.h>
#include <base/json_writer.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace mobbscope {
namespace {

std::string json_refusal(std::string_view text) {
    return input_error([&] { parse_json(text, "f.json"); });
}

TEST(Json, ValuesKnowTheirLineAndPointer) {
    const std::string file = "f.json";
    const JsonText value = parse_json("{\n \"a/b\": [\n  1,\n  {\"c~\":\n   true}]\n}\n", file);
    const JsonPlace root(value, file);
    const JsonPlace list = root.require("a/b");
    EXPECT_EQ(list.line(), 2);
    const JsonPlace one = list[0];
    EXPECT_EQ(one.description(), "line 3, /a~1b/0");
    const JsonPlace object = list[1];
    const JsonPlace flag = object.require("c~");
    EXPECT_EQ(flag.description(), "line 4, /a~1b/1/c~0");
    EXPECT_EQ(input_error([&] { flag.number(); }),
              "f.json: line 4, /a~1b/1/c~0: expected a number, found true or false");
    EXPECT_EQ(input_error([&] { list.require_size(3, "three"); }), "f.json: line 2, /a~1b: has 2 elements; give three");
    EXPECT_EQ(input_error([&] { one.integer(2, 5); }),
              "f.json: line 3, /a~1b/0: 1 is out of range; give a whole number from 2 to 5");
}

TEST(Json, MembersKeepTheirOrder) {
    const std::string file = "f.json";
    const JsonText value = parse_json(R"({"z": 1, "a": 2, "m": 3})", file);
    const JsonPlace root(value, file);
    EXPECT_EQ(root.member(0).key(), "z");
    EXPECT_EQ(root.member(2).key(), "m");
}

TEST(Json, ValuesArePacked) {
    // Of a million events of a trace, each an object of ten, these are 0.43 GB.
    EXPECT_LE(sizeof(JsonValue), 32u);
    EXPECT_LE(sizeof(JsonMember), 40u);
    const std::string file = "f.json";
    const JsonText text = parse_json(R"([{"test": "obb2d"}, {"test": "obb2d"}])", file);
    const JsonPlace root(text, file);
    const JsonPlace first = root[0], second = root[1];
    const JsonPlace a = first.member(0), b = second.member(0);
    EXPECT_EQ(&a.key(), &b.key()) << "kept once";
    EXPECT_EQ(&a.string(), &b.string());
}

TEST(Json, NestedListsKeepTheirOrder) {
    const std::string file = "f.json";
    const JsonText text = parse_json(R"([1, [2, [], {"a": [3, 4], "b": {}}], 5])", file);
    const JsonPlace root(text, file);
    ASSERT_EQ(root.size(), 3);
    EXPECT_EQ(root[0].number(), 1);
    EXPECT_EQ(root[2].number(), 5);
    const JsonPlace inner = root[1];
    ASSERT_EQ(inner.size(), 3);
    EXPECT_EQ(inner[0].number(), 2);
    EXPECT_EQ(inner[1].size(), 0);
    const JsonPlace object = inner[2];
    ASSERT_EQ(object.members(), 2);
    const JsonPlace a = object.require("a");
    ASSERT_EQ(a.size(), 2);
    EXPECT_EQ(a[1].number(), 4);
    EXPECT_EQ(object.require("b").members(), 0);
}

TEST(Json, SyntaxErrorsNameLineAndColumn) {
    EXPECT_TRUE(
        json_refusal("{\n  \"a\": 1,\n  }").starts_with("f.json: line 3, column 3: this is not JSON: unexpected '}'"))
        << json_refusal("{\n  \"a\": 1,\n  }");
    EXPECT_TRUE(json_refusal("").starts_with("f.json: line 1, column 1: this is not JSON"));
    EXPECT_TRUE(json_refusal("{\"a\": NaN}").starts_with("f.json: line 1, column 7: this is not JSON"))
        << json_refusal("{\"a\": NaN}");
    EXPECT_TRUE(json_refusal("[1]\n2").starts_with("f.json: line 2")) << json_refusal("[1]\n2");
    EXPECT_TRUE(json_refusal("[1\n,\n1e999]").starts_with("f.json: line 3")) << json_refusal("[1\n,\n1e999]");
    EXPECT_NE(json_refusal("[1e999]").find("too large for a double"), std::string::npos);
    EXPECT_NE(json_refusal(std::string("[\"a\0\"]", 6)).find("line 1"), std::string::npos);
    EXPECT_NE(json_refusal("[\"\xff\"]").find("UTF-8"), std::string::npos) << json_refusal("[\"\xff\"]");
    EXPECT_NE(json_refusal(std::string("\xff\xfe{\0", 4)).find("UTF-16"), std::string::npos);
}

TEST(Json, NothingHidesBehindANulByte) {
    EXPECT_EQ(json_refusal(std::string("[1]\n\0[2]", 8)),
              "f.json: line 2: holds a NUL byte; this is not a text file, or a damaged one");
}

TEST(Json, ALineBreakAfterANumberIsNotItsLine) {
    const std::string file = "f.json";
    const JsonText value = parse_json("[1\n,2\n]", file);
    const JsonPlace root(value, file);
    EXPECT_EQ(root[0].line(), 1);
    EXPECT_EQ(root[1].line(), 2);
}

TEST(Json, AKeyThatStandsTwiceIsRefused) {
    EXPECT_EQ(json_refusal("{\"a\": 1,\n\"b\": 2,\n\"a\": 3}"),
              "f.json: line 3, /a: the key 'a' is given twice, first in line 1; remove one");
    EXPECT_TRUE(
        json_refusal("{\"x\": [0, {\"y/\": {\"b\": 1, \"b\": 2}}]}").starts_with("f.json: line 1, /x/1/y~1/b: "))
        << json_refusal("{\"x\": [0, {\"y/\": {\"b\": 1, \"b\": 2}}]}");
}

TEST(Json, AKeyDoesNotBreakTheLineOfARefusal) {
    const std::string file = "f.json";
    const JsonText value = parse_json(R"({"a\n\u001b[1m": 1})", file);
    const JsonPlace root(value, file);
    EXPECT_EQ(root.require("a\n\x1b[1m").description(), "line 1, /a\\u000a\\u001b[1m");
    EXPECT_TRUE(json_refusal(R"({"\n": 1, "\n": 2})").starts_with("f.json: line 1, /\\u000a: the key '\\u000a'"));
}

TEST(Json, DeepNestingIsRefusedNotFatal) {
    EXPECT_NE(json_refusal(std::string(1'000'000, '[')).find("nested more than 64 deep"), std::string::npos);
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    EXPECT_NE(json_refusal(objects).find("nested more than 64 deep"), std::string::npos);
}

TEST(Json, MessagesStayShort) {
    EXPECT_LT(json_refusal("[" + std::string(1'000'000, 'x')).size(), 300u);
    EXPECT_LT(json_refusal("[\"" + std::string(1'000'000, 'x')).size(), 300u);
}

TEST(Json, WriterMakesWhatAnIndependentParserReads) {
    std::ostringstream text;
    JsonWriter out(text);
    out.begin_object();
    out.member("tenth", 0.1);
    out.member("count", 3);
    out.member("flag", true);
    out.member("name", "a\"\\\n\x01\xc3\xa9");
    out.key("none");
    out.null();
    out.member("endless", std::numeric_limits<double>::infinity());
    out.key("empty");
    out.begin_array();
    out.end_array();
    out.key("rows");
    out.begin_array();
    out.tuple(1, -0.5);
    out.begin_object(JsonWriter::Layout::row);
    out.key("inner");
    out.begin_array();
    out.tuple(2);
    out.end_array();
    out.end_object();
    out.end_array();
    out.end_object();
    const auto read = nlohmann::json::parse(text.str());
    EXPECT_EQ(read["tenth"], 0.1);
    EXPECT_EQ(read["name"], "a\"\\\n\x01\xc3\xa9");
    EXPECT_TRUE(read["endless"].is_null());
    EXPECT_EQ(read["rows"][1]["inner"][0][0], 2);
    EXPECT_NE(text.str().find("{\"inner\": [[2]]}"), std::string::npos) << text.str();
}

TEST(Json, BytesThatAreNotUtf8AreReplaced) {
    std::ostringstream text;
    JsonWriter out(text);
    out.value(std::string_view("caf\xe9"));
    EXPECT_EQ(nlohmann::json::parse(text.str()), "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace mobbscope
