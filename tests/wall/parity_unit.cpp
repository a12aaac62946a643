// SPDX-License-Identifier: MIT
// Whose turn it is, against a display that drops pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "wall/parity.hpp"

namespace burin::wall {

namespace {

// A display that shows in each refresh the picture it was given last; left's field is every even refresh.
struct Shown {
    std::vector<bool> wrong;  // of each refresh
    std::uint64_t repairs = 0, missed = 0;

    [[nodiscard]] long longest_wrong_run() const {
        long longest = 0, run = 0;
        for (const bool w : wrong) longest = std::max(longest, run = w ? run + 1 : 0);
        return longest;
    }
};

// choose(vblank) gives the eye. late(): the program was not ready for this refresh. slow(): what it handed over misses
// it.
template <typename Choose, typename Late, typename Slow>
Shown show(std::uint64_t refreshes, const Choose& choose, const Late& late, const Slow& slow) {
    Shown shown;
    Eye on_display = Eye::left;
    std::optional<Eye> delayed;
    for (std::uint64_t vblank = 0; vblank < refreshes; ++vblank) {
        // Between refresh `vblank` and the next: a program that is ready chooses; a delayed picture blocks the queue.
        std::optional<Eye> next = delayed;
        delayed.reset();
        if (!next && !late()) {
            const Eye eye = choose(vblank);
            if (slow()) {
                delayed = eye;
            } else {
                next = eye;
            }
        }
        if (next) on_display = *next;
        shown.wrong.push_back(on_display != ((vblank + 1) % 2 == 0 ? Eye::left : Eye::right));
    }
    return shown;
}

}  // namespace

TEST(FieldParity, TakesTurnsWhileNothingIsMissed) {
    FieldParity state;
    for (std::uint64_t vblank = 100; vblank < 200; ++vblank) {
        const FieldChoice choice = choose_field(state, vblank, Eye::left);
        EXPECT_EQ(choice.eye, (vblank + 1) % 2 == 0 ? Eye::left : Eye::right);
        EXPECT_FALSE(choice.repaired);
        state = choice.state;
    }
    EXPECT_EQ(state.repairs, 0u);
    EXPECT_EQ(state.missed, 0u);
    EXPECT_EQ(state.pictures, 100u);
}

TEST(FieldParity, CountsRepairsAndMissedRefreshes) {
    FieldParity state = choose_field({}, 10, Eye::left).state;
    const FieldChoice one_missed = choose_field(state, 12, Eye::left);
    EXPECT_TRUE(one_missed.repaired) << "refresh 11, then 13: the same eye again";
    EXPECT_EQ(one_missed.state.missed, 1u);
    const FieldChoice two_missed = choose_field(one_missed.state, 15, Eye::left);
    EXPECT_FALSE(two_missed.repaired) << "refresh 13, then 16: by turns all the same";
    EXPECT_EQ(two_missed.state.missed, 3u);
    const FieldChoice other_display = choose_field(two_missed.state, 0, Eye::left);
    EXPECT_EQ(other_display.eye, Eye::right);
    EXPECT_EQ(other_display.state.missed, 3u) << "a count that went back is not a miss";
}

TEST(FieldParity, NeverShowsAnEyeInTheOthersFieldTwiceOnEndWhenTheProgramIsLate) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        const auto late = [&] { return random() % 100 < 5 + seed; };
        FieldParity state;
        const auto choose = [&](std::uint64_t vblank) {
            const FieldChoice choice = choose_field(state, vblank, Eye::left);
            state = choice.state;
            return choice.eye;
        };
        Shown shown = show(5000, choose, late, [] { return false; });
        EXPECT_LE(shown.longest_wrong_run(), 1) << "seed " << seed;
        EXPECT_GT(state.repairs, 10u);
    }
}

TEST(FieldParity, IsRightAgainAfterTwoFieldsAtMostWhenPicturesComeLateThemselves) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        std::mt19937 random(seed);
        const auto sometimes = [&] { return random() % 100 < 5 + seed; };
        FieldParity state;
        const auto choose = [&](std::uint64_t vblank) {
            const FieldChoice choice = choose_field(state, vblank, Eye::left);
            state = choice.state;
            return choice.eye;
        };
        const Shown shown = show(5000, choose, sometimes, sometimes);
        EXPECT_LE(shown.longest_wrong_run(), 2) << "seed " << seed;
    }
}

// What the header warns of: the other eye than before, whatever the display does.
TEST(FieldParity, DoesWhatBlindTurnsCannot) {
    std::mt19937 random(1);
    Eye last = Eye::left;
    const auto blind = [&](std::uint64_t) { return last = other(last); };
    const Shown shown = show(5000, blind, [&] { return random() % 500 == 0; }, [] { return false; });
    EXPECT_GT(shown.longest_wrong_run(), 100) << "exchanged until the next miss";
}

}  // namespace burin::wall
