// SPDX-License-Identifier: MIT
// Words of commands and of acts, checked by the kinds of their arguments.
#include "session/input/command_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "session/activity/activity.hpp"
#include "session/state/command_table.hpp"

namespace burin::session {
namespace {

constexpr std::array<std::string_view, 3> kShapes{"ball", "cube", "octahedron"};
constexpr std::array kShapedActs{Act{"apart", "METRES", "Lay beads so far apart", {number_within(0.001, 0.02, "m")}},
                                 Act{"shape", "NAME", "What a bead is", {name_of_these(kShapes)}},
                                 Act{"colour", "R,G,B", "Colour of the beads", {colour_word()}},
                                 Act{"put", "NAME METRES", "Put one there", {ArgumentKind{}, number_within(-1.0, 1.0)}},
                                 Act{"note", "TEXT...", "Keep a note"},
                                 Act{"size", "[METRES]", "Set the size", {number_within(0.0, 1.0)}}};

class Shaped final : public Activity {
public:
    [[nodiscard]] std::string settings() const override { return "shaped"; }
    [[nodiscard]] std::span<const Act> acts() const override { return kShapedActs; }
    [[nodiscard]] Result<void> act(std::span<const std::string>, ActivityOrders&) override { return {}; }
    void step(const ActivityView&, ActivityOrders&) override {}
    [[nodiscard]] ActivityPanel panel() const override { return {}; }
};

// Returns what is wrong with the words behind `do`; empty: nothing.
std::string wrong_with(const std::vector<std::string>& words) {
    const Shaped shaped;
    const auto checked = check_act(&shaped, words);
    return checked ? std::string() : checked.error().line();
}

}  // namespace

TEST(Acts, AreCheckedByTheKindsOfTheirArguments) {
    for (const std::vector<std::string>& right : std::vector<std::vector<std::string>>{{"apart", "0.001"},
                                                                                       {"apart", "0.02"},
                                                                                       {"apart", "4e-3"},
                                                                                       {"shape", "cube"},
                                                                                       {"colour", "0,0.5,1"},
                                                                                       {"put", "anywhere", "-1"},
                                                                                       {"note", "two", "words"},
                                                                                       {"size"},
                                                                                       {"size", "0.5"}})
        EXPECT_EQ(wrong_with(right), "") << right[0];
    const std::string range = "write a number from 0.001 to 0.02, in m";
    for (const char* const word : {"nan", "-nan", "inf", "-inf", "1e999", "4mm", "0.004 ", " 0.004", "", "0x1", "four"})
        EXPECT_EQ(wrong_with({"apart", word}), "command do apart " + std::string(word) + ": is not a number; " + range);
    for (const char* const word : {"0.00099", "0.0201", "-0.004", "0", "1e300"})
        EXPECT_EQ(wrong_with({"apart", word}),
                  "command do apart " + std::string(word) + ": is out of bounds; " + range);
    EXPECT_EQ(wrong_with({"shape", "cubes"}),
              "command do shape cubes: is not known; did you mean cube? There are ball, cube, octahedron");
    EXPECT_EQ(wrong_with({"shape", "nonsense"}),
              "command do shape nonsense: is not known; There are ball, cube, octahedron");
    for (const char* const word : {"1,0", "1,0,0,0", "1,0,nan", "red", ",,", "", "1,0,"})
        EXPECT_TRUE(wrong_with({"colour", word}).contains("is no colour; write red,green,blue from 0 to 1")) << word;
    EXPECT_TRUE(wrong_with({"colour", "1,0,1.01"}).contains("is out of bounds"));
    EXPECT_TRUE(wrong_with({"put", "there", "2"}).contains("write a number from -1 to 1"));
    EXPECT_TRUE(wrong_with({"size", "2"}).contains("is out of bounds"));
}

TEST(Acts, SayWhatWouldBeRightWhereAWordIsMissingOrOneTooMany) {
    EXPECT_EQ(wrong_with({"apart"}),
              "command do apart: lacks its argument; write do apart METRES (a number from 0.001 to 0.02, in m)");
    EXPECT_EQ(wrong_with({"put", "there"}),
              "command do put: lacks an argument; write do put NAME METRES (a number from -1 to 1)");
    EXPECT_TRUE(wrong_with({"apart", "0.004", "0.005"}).contains("is given one word too many: 0.005"));
    const std::string unknown = wrong_with({"appart", "0.004"});
    EXPECT_TRUE(unknown.contains("did you mean apart?")) << unknown;
    EXPECT_TRUE(unknown.contains("shape NAME (one of ball, cube, octahedron)")) << unknown;
    EXPECT_TRUE(wrong_with({}).contains("There are apart METRES"));
}

// What a panel writes is what an activity reads, to the bit: a replay has the words alone.
TEST(Acts, NumbersOfTheirWordsReadBackToTheBit) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 2000; ++i) {
        const double value = std::uniform_real_distribution(0.001, 0.02)(random);
        const std::string word = exact_word(value);
        ASSERT_EQ(number_of(word), value) << word;
        ASSERT_EQ(wrong_with({"apart", word}), "");
    }
    const std::array<double, 3> srgb{0.1, 1.0 / 3.0, 1.0};
    const auto read = read_colour(exact_word(srgb), "colour");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(*read, srgb);
}

// A table's kinds and its parsers are one: what the kinds let through is never refused as a word of another kind.
TEST(Commands, AreCheckedByTheSameFormsAsActs) {
    std::size_t with_kinds = 0;
    for (const CommandSpec& command : commands()) {
        const ArgumentKind& kind = command.kinds[0];
        if (kind.what == ArgumentKind::What::text) continue;
        ++with_kinds;
        std::vector<std::string> right{"0.5,0.5,0.5"};
        if (kind.what == ArgumentKind::What::number) right = {exact_word(kind.least), exact_word(kind.most)};
        if (kind.what == ArgumentKind::What::name) right.assign(kind.names.begin(), kind.names.end());
        for (const std::string& word : right) {
            const auto parsed = parse_command({std::string(command.name), {word}});
            EXPECT_TRUE(parsed) << parsed.error().line();
        }
        for (const char* const word : {"nonsense", "nan"}) {
            const auto parsed = parse_command({std::string(command.name), {word}});
            ASSERT_FALSE(parsed) << command.name << " " << word;
            EXPECT_EQ(parsed.error().where, "command " + std::string(command.name) + " " + word);
        }
    }
    EXPECT_GE(with_kinds, 15u);
}

}  // namespace burin::session
