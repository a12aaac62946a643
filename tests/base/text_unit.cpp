// SPDX-License-Identifier: MIT
// The name that a mistyped one may have meant, and figures of measured values.
#include "base/text.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/near_name.hpp"
#include "base/statistics.hpp"

namespace burin {
namespace {

TEST(Text, TheEditDistanceIsAMetric) {
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // Levenshtein's k -> s, e -> i, and a g more
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", ""), 3u);
    EXPECT_EQ(edit_distance("pixles", "pixels"), 2u) << "exchanged letters are two replacements";
    std::mt19937 random(1);
    const auto word = [&] {
        std::string text(random() % 8, ' ');
        for (char& c : text) c = static_cast<char>('a' + random() % 3);
        return text;
    };
    for (int i = 0; i < 2000; ++i) {
        const std::string a = word(), b = word(), c = word();
        EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
        EXPECT_EQ(edit_distance(a, b) == 0, a == b);
        EXPECT_LE(edit_distance(a, c), edit_distance(a, b) + edit_distance(b, c));
        EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
    }
}

TEST(Text, TheNearestNameIsTheOneWithTheFewestEdits) {
    const std::vector<std::string_view> names = {"kitten", "mouse", "command"};
    EXPECT_EQ(nearest_name("sitting", names), "kitten");  // 3 edits
    EXPECT_EQ(nearest_name("moose", names), "mouse");
    EXPECT_EQ(nearest_name("comand", names), "command");
    EXPECT_EQ(nearest_name("mouse" + std::string(10000000, 'x'), names), "mouse");  // cut off, not slow
    const std::vector<std::string_view> alike = {"bat", "cat"};
    EXPECT_EQ(nearest_name("at", alike), "bat") << "the first of equals";
}

TEST(Text, NamesAreJoinedAndNumbersFormatted) {
    const std::vector<std::string_view> names = {"cut", "fill"};
    EXPECT_EQ(joined(names), "cut, fill");
    EXPECT_EQ(joined({}), "");
    EXPECT_EQ(formatted("%d of %.2f %s", 3, 0.5, "m"), "3 of 0.50 m");
    const volatile int wide = 1000;  // volatile: a compiler that sees the width warns of what is tested here
    EXPECT_EQ(formatted("%*d", int{wide}, 1).size(), 399u) << "cut off, not overrun";
}

TEST(Statistics, QuantilesAreByNearestRank) {
    EXPECT_EQ(median({3, 1, 2}), 2.0);
    EXPECT_EQ(median({4, 1, 2, 3}), 2.0);
    EXPECT_EQ(quantile({5, 4, 3, 2, 1}, 0.0), 1.0);
    EXPECT_EQ(quantile({5, 4, 3, 2, 1}, 0.99), 5.0);
    EXPECT_EQ(quantile({3.0}, 0.999), 3.0);
    EXPECT_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
}

TEST(Statistics, MeanSumAndExtremesAreThoseOfTheValues) {
    EXPECT_EQ(sum({1.0, 2.5, -0.5}), 3.0);
    EXPECT_EQ(mean({1.0, 2.5, -0.5}), 1.0);
    EXPECT_EQ(least({1.0, 2.5, -0.5}), -0.5);
    EXPECT_EQ(most({1.0, 2.5, -0.5}), 2.5);
    for (const double nothing : {median({}), quantile({}, 0.5), sum({}), mean({}), least({}), most({})})
        EXPECT_EQ(nothing, 0.0);
}

}  // namespace
// frobnicate was taken for force, fit for quit and panel for hand.
TEST(Text, GuessesNoNameThatIsFarFromTheWord) {
    const std::vector<std::string_view> names{"force", "quit", "hand", "mouse", "oak", "start"};
    for (const std::string_view far : {"frobnicate", "fit", "panel", "xyzzy", ""}) {
        EXPECT_EQ(near_name(far, names), "") << far;
        EXPECT_EQ(meant_by(far, names), "") << far;
    }
    EXPECT_EQ(near_name("mose", names), "mouse");
    EXPECT_EQ(near_name("oka", names), "oak") << "exchanged letters are one slip";
    EXPECT_EQ(near_name("strat", names), "start");
    EXPECT_EQ(meant_by("quti", names), "did you mean quit? ");
    EXPECT_EQ(near_name("mouse" + std::string(10000000, 'x'), names), "") << "cut off, not slow";
    EXPECT_EQ(near_name("mouse", {}), "");
}

}  // namespace burin
