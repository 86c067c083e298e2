// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>
#include <limits>

#include "corpus/json.h"
#include "solver/problem/check.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;

constexpr double kEndless = std::numeric_limits<double>::infinity(),
                 kNan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("JSON text: bytes that are no UTF-8 become U+FFFD, in texts and in keys") {
  const std::string mark = "\xEF\xBF\xBD";
  CHECK(JsonText(Json("a\xFFz")) == "\"a" + mark + "z\"");
  CHECK(JsonText(Json{{"a\xFE", {1, "\xC3"}}}) == "{\"a" + mark + "\":[1,\"" + mark + "\"]}");
  CHECK(JsonText(Json("\xC3\xA9 \xE2\x82\xAC")) == "\"\xC3\xA9 \xE2\x82\xAC\"");  // which is UTF-8
  for (int byte = 0; byte < 256; ++byte) {
    const std::string text = {'x', static_cast<char>(byte), '"', static_cast<char>(255 - byte)};
    CHECK(Json::accept(JsonText(Json{{text, {text, {{text, nullptr}}}}}, 2)));
  }
}

TEST_CASE("JSON text: numbers that are not finite become words, at any depth") {
  const Json value = {1.5, kEndless, {{"x", -kEndless}, {"y", {kNan, -kNan}}}};
  CHECK(JsonText(value) == R"([1.5,"inf",{"x":"-inf","y":["nan","nan"]}])");
  CHECK(JsonText(kEndless) == "\"inf\"");
  CHECK(value[1].is_number());  // and the value stays what it is
}

TEST_CASE("JSON text: what is read again is not written where its text says something else") {
  CHECK_NOTHROW(RequireWritable(Json{{"x", {1, 0.1, -5e-324, "\xC3\xA9"}}}));
  CHECK_THROWS_AS(RequireWritable(Json{{"x", {kEndless}}}), InternalError);
  CHECK_THROWS_AS(RequireWritable(Json{{"\xFF", 1}}), InternalError);
  CHECK(IsUtf8("\xC3\xA9"));
  CHECK(!IsUtf8(Json{{"x", {"\xA9"}}}));
}

TEST_CASE("JSON: a number that is not 0 and has no double but 0, or none at all, is refused with its place") {
  for (const std::string literal :
       {"1e-400", "-1e-400", "2.4e-324", "0.001e-330", "1e-99999999999999999999", "1E-5000"}) {
    CAPTURE(literal);
    CHECK_THROWS_WITH(ParseJson(R"({"x": [0, )" + literal + "]}", "f"),
                      Contains("f: x[1]: found " + literal + ", which is no double but 0") &&
                          Contains("as a string, \"" + literal + "\", it is exact"));
  }
  for (const std::string literal : {"1e400", "-1e309", "1e99999999999999999999"}) {
    CAPTURE(literal);
    CHECK_THROWS_WITH(ParseJson(R"({"x": [0, )" + literal + "]}", "f"),
                      Contains("f: x[1]: found " + literal + ", expected a number in the range of doubles"));
  }
  for (const std::string literal :
       {"0", "-0.0", "0e-400", "0.000e-99999", "0e999", "5e-324", "2.5e-324", "1.7e308"})
    CHECK_NOTHROW(ParseJson("[" + literal + "]", "f"));
}

TEST_CASE("JSON: a value that is handed on is shared, and changed in one place only") {
  SharedJson one = {{"a", 1}, {"b", "text"}, {"c", std::vector<std::string>{"x"}}, {"d", true}, {"e", 0.5}};
  const SharedJson other = one;
  one.Add({{"b", SharedJson{{"in", "it"}}}, {"f", 2}});
  CHECK(JsonText(one) == R"({"a":1,"b":{"in":"it"},"c":["x"],"d":true,"e":0.5,"f":2})");
  CHECK(JsonText(other) == R"({"a":1,"b":"text","c":["x"],"d":true,"e":0.5})");
  SharedJson none;
  CHECK(!none);
  none.Add({{"a", 1}});
  CHECK(*none == Json{{"a", 1}});
  CHECK(Json{{"in", none}}["in"]["a"] == 1);
  CHECK(JsonText(SharedJson::Object()) == "{}");
  const std::vector<SharedJson> list = {
      other, SharedJson(), SharedJson(std::string("text")), SharedJson(0.5), {{"g", 2}}};
  CHECK(JsonText(SharedJson(list)) == "[" + JsonText(other) + R"(,null,"text",0.5,{"g":2}])");
  CHECK(JsonText(SharedJson{{"all", list}, {"none", std::vector<SharedJson>()}}) ==
        R"({"all":)" + JsonText(SharedJson(list)) + R"(,"none":[]})");
  CHECK(JsonText(SharedJson{{"n", std::size_t{18446744073709551615u}}, {"x", std::vector<double>{1, 0.5}}}) ==
        R"({"n":18446744073709551615,"x":[1.0,0.5]})");
}

TEST_CASE("JSON: the places of a text keep it, and refuse what is not asked for") {
  const std::string source = "f";
  const JsonPlace root(R"({"format": "stiction-x", "version": 1, "yes": true, "x": [0.5, null]})", source);
  CHECK(root.HasFormat("stiction-x"));
  CHECK_FALSE(root.HasFormat("stiction-y", true));
  CHECK_NOTHROW(root.RequireFormat("stiction-x"));
  CHECK_THROWS_WITH(root.RequireFormat("y"), "f: format: found \"stiction-x\", expected \"y\"");
  CHECK(root.Members()[2].second.Truth());
  const JsonPlace x = root.Required("x", "a list");
  CHECK(x[0].Number("a number") == 0.5);
  CHECK(x[1].IsNull());
  CHECK_THROWS_WITH(x[1].Truth(), "f: x[1]: found null, expected true or false");
  CHECK(JsonPlace("{}", source).HasFormat("any", true));
  CHECK(PlainValue(Json{1000, "a", {2}}, true, "; ") == "1,000; a; 2");
  CHECK(PlainValues(Json{{"k", {1, "b"}}})[0] == std::pair<std::string, std::string>("k", "1, b"));
}

}  // namespace
}  // namespace stiction
