#include "core/json.h"
#include "core/error.h"
#include "core/json_types.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <fstream>
#include <limits>

namespace {

std::string message(const auto& action) {
    try {
        action();
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST(Json, SyntaxErrorsNameLineAndColumn) {
    const auto file = std::filesystem::temp_directory_path() / "json_test.json";
    std::ofstream(file) << "{\n  \"a\": 1,\n  \"b\" 2\n}\n";
    EXPECT_NE(message([&] { read_json(file); }).find(file.string() + ":3:7: not valid JSON"), std::string::npos)
        << message([&] { read_json(file); });
    std::filesystem::remove(file);
}

TEST(Json, SyntaxErrorsNameALikelyCause) {
    const auto of = [](const std::string& text) { return message([&] { parse_json(text, "file"); }); };
    const char *missing = "(is a comma missing before it?)", *additional = "(the comma before it is one too many)";
    const std::pair<const char*, const char*> causes[] = {{R"({"a": 1 "b": 2})", missing},
                                                          {"[1 2]", missing},
                                                          {R"([{"a": 1} {"b": 2}])", missing},
                                                          {"[1, 2,]", additional},
                                                          {"{\"a\": 1,\n}", additional},
                                                          {"{'a': 1}", "(JSON texts stand in double quotes)"},
                                                          {R"({"a": 'b'})", "(JSON texts stand in double quotes)"},
                                                          {"{a: 1}", "(JSON keys stand in double quotes)"}};
    for (const auto& [text, cause] : causes) EXPECT_TRUE(of(text).ends_with(cause)) << of(text);
    for (const char* text : {R"({"a": [1, 2})", R"({"a": })", R"({"a" 1})", R"({"a": 1)", R"({"a": ])",
                             R"({"a": 0x10})", R"({"a": 1.5f, "b": 2})", "{\"a\": 1, // c\n}", ""})
        EXPECT_FALSE(of(text).ends_with(")")) << of(text);
}

TEST(Json, EveryKeyMustBeKnownAndInRange) {
    const auto json = nlohmann::json::parse(R"({"width": 20, "hieght": 3})");
    JsonObject object(json, "config.json");
    EXPECT_EQ(object.integer("width", 1, 100), 20);
    EXPECT_EQ(object.integer("height", 1, 100, 5), 5);
    EXPECT_EQ(message([&] { object.finish(); }), "config.json: unknown key 'hieght'; did you mean 'height'?");
    EXPECT_EQ(message([&] { object.integer("width", 1, 10); }), "config.json: 'width' = 20 is outside [1, 10]");
}

TEST(Json, KeysThatComeTwiceAreNamed) {
    EXPECT_EQ(message([] { parse_json(R"({"shots": [{}, {"scene": "a", "frames": [1], "scene": "b"}]})", "c.json"); }),
              "c.json: shots[1]: the key 'scene' comes twice in one object");
    EXPECT_EQ(message([] { parse_json(R"({"a": 1, "b": 2, "a": 3})", "c.json"); }),
              "c.json: the key 'a' comes twice in one object");
    EXPECT_EQ(message([] { parse_json(R"([{"a": {"a": 1}}, {"a": 2}])", "c.json"); }), "no error");
}

TEST(Json, ReadsWhatTheLibraryReads) {
    const std::string text =
        R"({"a": [1, -2, 3.5, 1e300, true, false, null, "x\u00e4", [], {}, [[{"b": [18446744073709551615]}]]], "c": {}})";
    EXPECT_EQ(parse_json(text, "c.json"), nlohmann::json::parse(text));
    EXPECT_EQ(parse_json("// why\n7 /* as said */", "c.json", true), 7);
    EXPECT_NE(message([] { parse_json("// why\n7", "c.json"); }), "no error");
    EXPECT_NE(message([] { parse_json("7 8", "c.json"); }), "no error");
    EXPECT_NE(message([] { parse_json("", "c.json"); }), "no error");
}

TEST(Json, NestsAsDeepAsItMayAndNoDeeper) {
    const auto nested = [](size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); };
    EXPECT_EQ(message([&] { parse_json(nested(max_json_depth), "c.json"); }), "no error");
    // Without a bound the last one ends in the stack.
    for (const size_t levels : {max_json_depth + 1, size_t(300'000)}) {
        EXPECT_EQ(message([&] { parse_json(nested(levels), "c.json"); }),
                  "c.json: its JSON nests more than 100 levels");
        std::string objects;
        for (size_t i = 0; i < levels; ++i) objects += "{\"a\":";
        EXPECT_EQ(message([&] { parse_json(objects, "c.json"); }), "c.json: its JSON nests more than 100 levels");
    }
}

TEST(Json, NumbersBeyondAllRangesAreNamed) {
    EXPECT_EQ(message([] { parse_json("{\"a\": [{}, {\"b\": [2,\n 1e400]}]}", "c.json"); }),
              "c.json:2:6: a[1]: b[1]: the number 1e400 is beyond what float64 can hold");
    const auto json = parse_json(R"({"a": 1e39, "v": [0, -1e39, 0], "huge": 18446744073709551615})", "c.json");
    JsonObject object(json, "c.json");
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(message([&] { object.number("a", 0, infinity); }), "c.json: 'a' = 1e+39 is outside [0, inf]");
    EXPECT_EQ(
        message([&] { object.vector("v"); }),
        "c.json: 'v' has the number -1e+39 outside of [-3.4028235e+38, 3.4028235e+38], all that float32 can hold");
    EXPECT_NE(message([&] { object.integer("huge", 0, 10); }), "no error");
}

// RFC 8259, section 6: 3, 3.0 and 3e0 are one number; JSON Schema's "integer" holds each.
TEST(Json, WholeNumbersMayBeWrittenWithAPointOrAnExponent) {
    const auto json =
        parse_json(R"({"a": 3.0, "b": 3e2, "c": -0.0, "d": 2.5, "e": 1e300, "huge": 18446744073709551615})", "c.json");
    JsonObject object(json, "c.json");
    EXPECT_EQ(object.integer("a", 0, 10), 3);
    EXPECT_EQ(object.integer("b", 0, 1000), 300);
    EXPECT_EQ(object.integer("c", 0, 10), 0);
    EXPECT_EQ(message([&] { object.integer("a", 4, 10); }), "c.json: 'a' = 3.0 is outside [4, 10]");
    EXPECT_EQ(message([&] { object.integer("d", 0, 10); }), "c.json: 'd' must be a whole number, not 2.5");
    EXPECT_NE(message([&] { object.integer("e", 0, 10); }), "no error");
    EXPECT_NE(message([&] { object.integer("huge", -10, 10); }), "no error");  // -1 as 64 bits with a sign
    EXPECT_EQ(with_whole_as_integer(json["b"]).dump(), "300");
    EXPECT_EQ(with_whole_as_integer(json["d"]).dump(), "2.5");
}

// A byte order mark need not be refused (RFC 8259, section 8.1), and Windows' editors write one, and lines with \r\n.
TEST(Json, TextsOfOtherSystems) {
    EXPECT_EQ(parse_json("\xEF\xBB\xBF{\r\n\"a\": 1\r\n}\r\n", "c.json")["a"], 1);
    EXPECT_NE(message([] { parse_json("\xEF\xBB\xBF{\r\n\"a\" 1}", "c.json"); }).find("c.json:2:"), std::string::npos);
    using namespace std::string_literals;
    EXPECT_NE(message([] { parse_json("\xFF\xFE{\0}\0"s, "c.json"); }).find("UTF-16"), std::string::npos);
}

TEST(Json, MessagesHaveAsManyDigitsAsNumbersNeed) {
    const auto json = parse_json(R"({"angle": 1.5707964})", "c.json");
    JsonObject object(json, "c.json");
    EXPECT_EQ(message([&] { object.number("angle", 0, 1.5707963f); }),
              "c.json: 'angle' = 1.5707964 is outside [0, 1.5707963]");
    const auto said = [](auto value) { return message([&] { fail(value); }); };
    EXPECT_EQ(said(0.1), "0.1");
    EXPECT_EQ(said(0.1f), "0.1");
    EXPECT_EQ(said(1e6f), "1e+06");  // as streams write it
    EXPECT_EQ(said(100000.0), "100000");
    EXPECT_EQ(said(1.0 + 0x1p-52), "1.0000000000000002");
    EXPECT_EQ(said(std::numeric_limits<float>::infinity()), "inf");
}

TEST(Json, MessagesStayShort) {
    const std::string text = "{\"" + std::string(300'000, 'a') + "\": \"" + std::string(300'000, 'b') + "\"}";
    const auto json = parse_json(text, "c.json");
    JsonObject object(json, "c.json");
    EXPECT_LT(message([&] { object.finish(); }).size(), 500u);
    EXPECT_LT(message([&] { object.integer(std::string(300'000, 'a'), 0, 1); }).size(), 301'000u);
    EXPECT_LT(message([&] { parse_json("{\"a\": " + text.substr(1), "c.json"); }).size(), 500u);
}

TEST(Json, TypesNameThePlaceOfWhatIsWrong) {
    const auto types = nlohmann::json::parse(R"({"a": "count", "b?": ["text"], "c??": {"*": "number"}})");
    const auto of = [&](const char* text, OtherMembers others = OtherMembers::refused) {
        return message([&] { require_type(nlohmann::json::parse(text), types, "f.json", others); });
    };
    EXPECT_EQ(of(R"({"a": 1, "b": ["x"], "c": {"y": 0.5}})"), "no error");
    EXPECT_EQ(of(R"({"a": 1, "c": null})"), "no error");
    EXPECT_EQ(of(R"({"a": -1})"), "f.json: a must be a whole number from 0, not -1");
    EXPECT_EQ(of(R"({"a": 4294967296})"), "f.json: a must be a whole number from 0, not 4294967296");
    EXPECT_EQ(of(R"({"a": 1, "b": null})"), "f.json: b must be an array, not null");
    EXPECT_EQ(of(R"({"a": 1, "b": ["x", 2]})"), "f.json: b[1] must be a text, not 2");
    EXPECT_EQ(of(R"({"a": 1, "c": {"y": "z"}})"), "f.json: c: y must be a number, not \"z\"");
    EXPECT_EQ(of("{}"), "f.json lacks 'a'");
    EXPECT_EQ(of(R"({"a": 1, "d": 2})"), "f.json: 'd' is not known");
    EXPECT_EQ(of(R"({"a": 1, "d": 2})", OtherMembers::allowed), "no error");
}
