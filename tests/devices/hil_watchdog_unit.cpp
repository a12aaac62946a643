// SPDX-License-Identifier: MIT
// The watchdog of a Quanser wand's card, as the comments of hil.h describe it for the Q8 series: what is left where the
// program dies, and what a program finds that comes after.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "devices/drivers/hil_wand.hpp"
#include "devices/drivers/wand_device.hpp"
#include "tests/devices/running_wand.hpp"
#include "tests/devices/told_clock.hpp"

namespace burin::devices {

// The card's watchdog is all that is left where the program dies, here by a thread that makes no turn any more.
TEST(HilWatchdog, ADriverThatStandsStillLeavesItsVoltsToTheCardsWatchdog) {
    RunningWand running(own_wand());
    const auto api = load_hil_api(library_of_tests(kEmulatedHilLibrary));
    ASSERT_TRUE(api) << api.error().line();
    auto told = std::make_unique<TurnsClock>();
    TurnsClock& clock = *told;
    const auto wand = HilWand::serve_card(*api, own_wand(), quanser_wand_of_maker(), std::move(told));
    ASSERT_TRUE(wand) << wand.error().line();
    for (int turn = 0; turn < 5000 && running.is_without_force(); ++turn) {
        (*wand)->exchange().command(kPresses, clock.now_ns());
        clock.take_turns(1);
    }
    EXPECT_TRUE(tried([&] { return running.is_without_force(); })) << "the last volts are still at the motors";
    EXPECT_TRUE((*wand)->take_messages().empty()) << "it has a watchdog";
    clock.let_go();
}

TEST(HilWatchdog, ACardThatADeadProgramLeftShutIsOpenedAgain) {
    RunningWand running(own_wand());
    const auto api = load_hil_api(library_of_tests(kEmulatedHilLibrary));
    ASSERT_TRUE(api) << api.error().line();
    HilCard card = nullptr;
    ASSERT_GE(api->open("q8", own_wand().c_str(), &card), 0);
    constexpr std::array<std::uint32_t, 2> kSome{0, 1};
    ASSERT_GE(api->watchdog_start(card, 0.001), 0);
    std::array<std::int32_t, 2> counts{};
    ASSERT_TRUE(tried([&] { return api->read_encoder(card, kSome.data(), 2, counts.data()) < 0; })) << "it is shut";
    EXPECT_GE(api->watchdog_stop(card), 0) << "which opens nothing";
    EXPECT_LT(api->read_encoder(card, kSome.data(), 2, counts.data()), 0);
    ASSERT_GE(api->close(card), 0);
    TickedWand wand(own_wand());
    EXPECT_TRUE(wand.is_well()) << wand.messages();
}

TEST(HilWatchdog, TheEmulatedCardTakesNoExpirationStateAloneAsAQ8TakesNone) {
    RunningWand running(own_wand());
    const auto api = load_hil_api(library_of_tests(kEmulatedHilLibrary));
    ASSERT_TRUE(api) << api.error().line();
    HilCard card = nullptr;
    ASSERT_GE(api->open("q8", own_wand().c_str(), &card), 0);
    constexpr std::array<std::uint32_t, 1> kFirst{0};
    constexpr std::array<double, 1> kZero{0.0}, kOther{1.0};
    EXPECT_LT(api->watchdog_analog(card, kFirst.data(), 1, kOther.data()), 0) << "0 V or nothing";
    EXPECT_GE(api->watchdog_analog(card, kFirst.data(), 1, kZero.data()), 0);
    EXPECT_LT(api->watchdog_start(card, 1.0), 0);
    EXPECT_GE(api->watchdog_digital(card, kFirst.data(), 1, &kHilTristate), 0);
    EXPECT_GE(api->watchdog_start(card, 1.0), 0);
    EXPECT_GE(api->close(card), 0);
}

}  // namespace burin::devices
