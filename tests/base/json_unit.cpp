// SPDX-License-Identifier: MIT
// JSON values: what braces mean, what reports write, and that it reads back the same.
#include "base/json.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

namespace burin {

TEST(Json, BracedPairsAreAnObjectAndOtherBracesAnArray) {
    EXPECT_EQ((Json{{"a", 1}, {"b", {"x", "y"}}}).dump(), R"({"a":1,"b":["x","y"]})");
    EXPECT_EQ((Json{{"only", 0.5}}).dump(), R"({"only":0.5})");
    EXPECT_EQ((Json{1, 2.5, "three", true, nullptr}).dump(), R"([1,2.5,"three",true,null])");
    EXPECT_EQ((Json{{"a", 1}, {2, 3}}).dump(), R"([["a",1],[2,3]])");
    EXPECT_EQ(Json::array({0.1, 0.2}).dump(), "[0.1,0.2]");
    EXPECT_EQ(Json::array().dump(), "[]");
    EXPECT_EQ(Json::object().dump(), "{}");
    EXPECT_EQ(Json(std::vector<std::string>{"a", "b"}).dump(), R"(["a","b"])");
    EXPECT_EQ(Json(std::array{1, 2}).dump(), "[1,2]");
}

TEST(Json, KeepsTheOrderOfKeysAndIndents) {
    Json report{{"z", 1}, {"a", nullptr}};
    report["m"]["deep"] = false;
    report["list"].push_back("first");
    report["a"] = 2u;
    report.update({{"z", 3}, {"new", "\"quoted\"\n"}});
    EXPECT_EQ(json_text(report),
              "{\n  \"z\": 3,\n  \"a\": 2,\n  \"m\": {\n    \"deep\": false\n  },\n  \"list\": [\n    \"first\"\n  ],\n"
              "  \"new\": \"\\\"quoted\\\"\\n\"\n}\n");
}

TEST(Json, WritesNullForWhatIsNoNumberAndReplacesWhatIsNoText) {
    EXPECT_EQ(json_text(std::numeric_limits<double>::quiet_NaN()), "null\n");
    EXPECT_EQ(json_text(std::numeric_limits<double>::infinity()), "null\n");
    EXPECT_EQ(json_text("a\xff"), "\"a\xef\xbf\xbd\"\n") << "the replacement character instead of a torn byte";
}

TEST(Json, NumbersAreReadBackAsTheyWere) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 2000; ++i) {
        const double value = std::bit_cast<double>(random());
        if (!std::isfinite(value)) continue;
        EXPECT_EQ(Json::parse(Json(value).dump()).get<double>(), value);
    }
    for (const std::int64_t value : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1}, std::int64_t{7}})
        EXPECT_EQ(Json::parse(Json(value).dump()).get<std::int64_t>(), value);
    EXPECT_EQ(Json(std::numeric_limits<std::uint64_t>::max()).dump(), "18446744073709551615");
}

TEST(Json, FindsByKeyIndexAndPath) {
    const Json report{{"mesh", {{"triangles", 12}, {"sizes", {1, 2, 3}}}}, {"name", "cube"}};
    EXPECT_EQ(report["mesh"]["sizes"][2].get<int>(), 3);
    EXPECT_EQ(report["name"].get<std::string>(), "cube");
    ASSERT_NE(find_value(report, "/mesh/triangles"), nullptr);
    EXPECT_EQ(find_value(report, "/mesh/triangles")->get<double>(), 12.0);
    EXPECT_EQ(find_value(report, "/mesh/vertices"), nullptr);
    EXPECT_EQ(find_value(report, "/name/triangles"), nullptr);
    EXPECT_TRUE(report.contains("name"));
    EXPECT_FALSE(report["name"].contains("name"));
    EXPECT_THROW((void)report.at("none"), Json::out_of_range);
    EXPECT_THROW((void)report["mesh"]["sizes"].at(3), Json::out_of_range);
    EXPECT_THROW((void)report["name"].get<double>(), Json::type_error);
}

TEST(Json, ComparesNumbersByValueAndAllElseByKind) {
    EXPECT_EQ(Json(1), Json(1u));
    EXPECT_EQ(Json(1), Json(1.0));
    EXPECT_NE(Json(1), Json("1"));
    EXPECT_NE(Json(1), Json(true));
    EXPECT_EQ((Json{{"a", {1, 2}}}), (Json{{"a", {1.0, 2u}}}));
    EXPECT_NE((Json{{"a", 1}}), (Json{{"a", 2}}));
}

}  // namespace burin
