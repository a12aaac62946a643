// SPDX-License-Identifier: MIT
// The devices of several hands by themselves: those of other rates are refused wherever they stand, and what each
// hand's channel loses is counted.
#include "session/hands/session_hands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "session/live/activity_side.hpp"
#include "session/objects/world_objects.hpp"
#include "session/state/session_orders.hpp"
#include "session/state/session_state.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::session {
namespace {

// Returns what opening these devices says, "opened" where they do.
std::string opening(const std::vector<std::string>& devices) {
    SimulatedClock clock;
    SessionHands hands({4096, 16}, 1.0);
    std::vector<HandToOpen> wanted;
    for (std::size_t i = 0; i < devices.size(); ++i) wanted.push_back({"hand" + std::to_string(i), devices[i], {}});
    const auto opened = hands.open(wanted, clock);
    return opened ? "opened" : opened.error().line();
}

// Takes hold of the one object that there is.
class TakesHold final : public Activity {
public:
    explicit TakesHold(std::vector<PartOfHand> by) : by_(std::move(by)) {}
    [[nodiscard]] std::string settings() const override { return {}; }
    [[nodiscard]] Result<void> act(std::span<const std::string>, ActivityOrders&) override { return {}; }
    void step(const ActivityView&, ActivityOrders& orders) override { orders.holds.push_back({"thing", by_, true}); }
    [[nodiscard]] ActivityPanel panel() const override { return {.title = ""}; }

private:
    std::vector<PartOfHand> by_;
};

}  // namespace

TEST(SessionDevices, OfTwoRatesAreRefusedInEachPlaceWithBothNamesAndRates) {
    const Workplace at;
    at.write("slow.toml", "rate = 500\n");
    const std::string slow = "simulated-wand:" + (at / "slow.toml").string();
    EXPECT_EQ(opening({slow, slow}), "opened") << "of one rate, whatever that is";
    EXPECT_EQ(opening({"simulated", "simulated-wand", "simulated-fingers"}), "opened");
    for (std::size_t count = 2; count <= 4; ++count)
        for (std::size_t other = 0; other < count; ++other) {
            std::vector<std::string> devices(count, "simulated");
            devices[other] = slow;
            const std::string said = opening(devices);
            EXPECT_TRUE(said.contains("ticks ") && said.contains("500 times") && said.contains("1000"))
                << other << " of " << count << ": " << said;
            // Named are the first hand and the first one whose rate is another.
            const std::size_t named = std::max<std::size_t>(other, 1);
            EXPECT_TRUE(said.contains("hand" + std::to_string(named) + "=") && said.contains("hand0=")) << said;
            EXPECT_TRUE(said.contains("one loop drives")) << said;
        }
    // A hand of four parts before it, and after it.
    EXPECT_TRUE(opening({"simulated-fingers", slow}).contains("hand1="));
    EXPECT_TRUE(opening({slow, "simulated-fingers"}).contains("hand1="));
}

TEST(SessionDevices, TheTargetsThatEachHandsChannelLosesAreCounted) {
    constexpr std::size_t kHands = 3, kMore = 7;
    for (std::size_t flooded = 0; flooded < kHands; ++flooded) {
        SimulatedClock clock;
        SessionHands hands({4096, 16}, 1.0);
        std::vector<HandToOpen> wanted;
        for (std::size_t i = 0; i < kHands; ++i) wanted.push_back({"hand" + std::to_string(i), "simulated", {}});
        ASSERT_TRUE(hands.open(wanted, clock));
        EXPECT_EQ(hands.lost_targets(), 0u);
        // Nobody ticks, so that the channel keeps what it holds.
        std::uint64_t lost = 0;
        Nanoseconds time_ns = 0;
        const auto push = [&](std::size_t hand) {
            time_ns += 1'000'000;
            const Vec3 place_m = uneven_offset(static_cast<std::size_t>(time_ns / 1'000'000));
            const std::vector<devices::SteeredTarget> way{{time_ns, place_m, {1.0, 0.0, 0.0, 0.0}, 0}};
            hands.move_hand(hand, way, time_ns, {.position_device_m = place_m});
        };
        while (lost == 0 && time_ns < 10 * kNanosecondsPerSecond) {
            push(flooded);
            lost = hands.lost_targets();
        }
        ASSERT_GT(lost, 0u) << flooded;
        const std::uint64_t begun = lost;
        for (std::size_t i = 0; i < kMore; ++i) push(flooded);
        const std::uint64_t each = hands.lost_targets() - begun;
        EXPECT_GE(each, kMore) << flooded;
        for (std::size_t other = 0; other < kHands; ++other)
            if (other != flooded) push(other);
        EXPECT_EQ(hands.lost_targets() - begun, each) << "the others' channels have room";
        // A second one that overflows is added to the first.
        const std::size_t second = (flooded + 1) % kHands;
        const std::uint64_t before = hands.lost_targets();
        for (int i = 0; i < 10'000 && hands.lost_targets() == before; ++i) push(second);
        EXPECT_GT(hands.lost_targets(), before) << second;
    }
}

// An activity names a hand and a part of it; the scene counts the parts of all hands.
TEST(SessionDevices, AnActivityTakesHoldByThePartsOfTheHandsThatItNames) {
    for (const std::vector<std::string>& devices : {std::vector<std::string>{"simulated", "simulated-fingers"},
                                                    {"simulated-fingers", "simulated"},
                                                    {"simulated", "simulated", "simulated-fingers"}}) {
        SimulatedClock clock;
        SessionHands hands({4096, 16}, 1.0);
        std::vector<HandToOpen> wanted;
        for (std::size_t i = 0; i < devices.size(); ++i) wanted.push_back({"hand" + std::to_string(i), devices[i], {}});
        ASSERT_TRUE(hands.open(wanted, clock));
        const std::vector<haptics::ToolState> tools(hands.parts());
        SessionState state;
        WorldObjects world;
        scene::SceneObject thing;
        thing.id = 1;
        thing.name = "thing";
        world.objects.push_back(std::make_shared<const scene::SceneObject>(thing));
        state.world = std::make_shared<const WorldObjects>(world);
        const auto holds_by = [&](std::vector<PartOfHand> by) {
            ActivitySide side(std::make_shared<TakesHold>(std::move(by)));
            SessionOrders orders;
            Leader nobody;
            side.step(state, orders, 0, hands, tools, nobody);
            EXPECT_EQ(orders.holds.size() + orders.messages.size(), 1u);
            return orders.holds.empty() ? std::vector<std::size_t>{} : orders.holds[0].parts;
        };
        std::vector<PartOfHand> all;
        std::vector<std::size_t> numbers;
        for (std::size_t hand = 0; hand < devices.size(); ++hand) {
            const std::size_t parts = devices[hand] == "simulated" ? 1 : 4;
            for (std::size_t part = 0; part < parts; ++part) {
                EXPECT_EQ(holds_by({{hand, part}}), (std::vector{numbers.size()})) << hand << " " << part;
                all.push_back({hand, part});
                numbers.push_back(numbers.size());
            }
            EXPECT_EQ(holds_by({{hand, parts}}), std::vector<std::size_t>{}) << "there is none";
        }
        EXPECT_EQ(holds_by(all), numbers);
        EXPECT_EQ(holds_by({{devices.size(), 0}}), std::vector<std::size_t>{}) << "there is no such hand";
    }
}

}  // namespace burin::session
