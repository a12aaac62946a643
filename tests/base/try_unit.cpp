// SPDX-License-Identifier: MIT
#include "base/try.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "base/error.hpp"

namespace burin {
namespace {

Result<std::unique_ptr<int>> number(bool there) {
    if (!there) return fail("number", "is not there", "write one");
    return std::make_unique<int>(7);
}
Result<void> odd(int value) {
    if (value % 2 == 0) return fail("number", "is even", "");
    return {};
}

Result<std::string> text_of(bool there, int more, int& reached) {
    BURIN_TRY(made, number(there));
    reached = 1;
    *made += more;
    BURIN_TRY_DO(odd(*made));
    reached = 2;
    BURIN_TRY(again, number(there));
    std::unique_ptr<int> owned = std::move(again);
    return std::to_string(*made) + "," + std::to_string(*owned);
}

TEST(Try, GivesTheValueOfWhatSucceeds) {
    int reached = 0;
    const Result<std::string> text = text_of(true, 2, reached);
    ASSERT_TRUE(text);
    EXPECT_EQ(*text, "9,7");
    EXPECT_EQ(reached, 2);
}

TEST(Try, HandsTheErrorOnAsItIs) {
    int reached = 0;
    const Result<std::string> missing = text_of(false, 0, reached);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().line(), number(false).error().line());
    EXPECT_EQ(reached, 0);
    const Result<std::string> even = text_of(true, 1, reached);
    ASSERT_FALSE(even);
    EXPECT_EQ(even.error().line(), odd(8).error().line());
    EXPECT_EQ(reached, 1);
}

TEST(Try, EvaluatesItsCallOnce) {
    int calls = 0;
    const auto once = [&]() -> Result<int> {
        const auto counted = [&]() -> Result<int> { return ++calls; };
        BURIN_TRY(value, counted());
        return value;
    };
    ASSERT_TRUE(once());
    EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace burin
