// SPDX-License-Identifier: MIT
// A tool in the groove that it cuts: it is let go, it sinks by the law, and it is never set inside material.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bench/haptics/carving_hand.hpp"
#include "bench/haptics/carving_scenes.hpp"
#include "tests/compute/effort.hpp"
#include "tests/support/property_cases.hpp"

namespace burin::haptics {
namespace {

struct GrooveCase {
    bench::CarvingTool tool;
    int resolution = 128;
    double speed_m_per_s = 0.0;

    [[nodiscard]] std::string name() const {
        return tool.name + ", N = " + std::to_string(resolution) + ", " + std::to_string(speed_m_per_s) + " m/s";
    }
};

// Of these, N = 128 at the last speed in every run, and of the others as many as there is time for.
std::vector<GrooveCase> groove_cases(const std::vector<double>& speeds) {
    std::vector<GrooveCase> cases, finer;
    for (const bench::CarvingTool& tool : bench::carving_tools())
        for (const double speed : speeds)
            for (const int resolution : {128, 256, 512})
                (resolution == 128 && speed == speeds.back() ? cases : finer).push_back({tool, resolution, speed});
    const auto wanted = static_cast<std::size_t>(test::costly_cases(static_cast<int>(finer.size())));
    for (std::size_t i = 0; i < wanted; ++i) cases.push_back(finer[i * finer.size() / wanted]);
    if (compute::test::kSanitized) cases.resize(1);  // each takes some ten seconds then
    return cases;
}

}  // namespace

TEST(CarvedGroove, LetsGoOfAToolThatIsLiftedOutOfIt) {
    for (const GrooveCase& one : groove_cases({0.02, 0.1, 0.3})) {
        const bench::Lifted lifted = bench::lift_out(one.tool.shape, one.resolution, one.speed_m_per_s);
        EXPECT_EQ(lifted.most_clear_N, 0.0) << one.name();
        EXPECT_EQ(lifted.held_clear, 0u) << one.name();
        EXPECT_EQ(lifted.let_go, 0u) << one.name();
        EXPECT_LE(lifted.limited, lifted.ticks / 33) << one.name();
    }
}

TEST(CarvedGroove, APressedToolSinksByTheLawAndHoldsStillBelowTheYield) {
    std::vector<std::pair<bench::CarvingTool, double>> cases, others;
    for (const bench::CarvingTool& tool : bench::carving_tools()) {
        (cases.size() < 3 ? cases : others).emplace_back(tool, 0.003);
        others.emplace_back(tool, 0.0005);
    }
    others.resize(static_cast<std::size_t>(test::costly_cases(static_cast<int>(others.size()))));
    cases.insert(cases.end(), others.begin(), others.end());
    if (compute::test::kSanitized) cases.resize(1);
    for (const auto& [tool, from_m] : cases) {
        const bench::Sunk sunk = bench::sink(tool.shape, 128, 1.5, from_m);
        // A bull-nose's rounding and a cone's tip have few samples, and what these lack counts threefold here.
        const double within = tool.name == "bull-nose" || tool.name == "cone" ? 0.2 : 0.1;
        EXPECT_NEAR(sunk.found_m_per_s / sunk.law_m_per_s, 1.0, within) << tool.name << ' ' << from_m;
        EXPECT_LT(bench::sink(tool.shape, 128, 0.9, from_m).found_m_per_s, 1e-5) << tool.name << ' ' << from_m;
    }
}

// What touches lay in the pit, held by friction on its wall, and the tool stood still a tool's length away from it.
TEST(CarvedGroove, AToolThatIsDrawnOutOfAPitGoesOn) {
    constexpr double kPit_m = 0.0019, kGroove_m = 0.0015, kTo_m = 0.006, kTick_m = 2e-5, kLeads_m = 0.0025;
    for (const bench::CarvingTool& tool : bench::carving_tools()) {
        bench::CarvingHand hand(tool.shape, {.resolution = 256});
        const auto lead = [&](double x, double y) {
            const Vec3 at = hand.cut_m();
            hand.go_to({std::min(x, at.x + kLeads_m), std::max(y, at.y - kLeads_m), 0.0}, true);
        };
        for (int i = 0; i < 150; ++i) hand.go_to({-kTo_m, 0.001 - 1e-5 * std::min(i, 110), 0.0}, false);
        for (int i = 0; i < 4000 && hand.cut_m().y > -kPit_m; ++i) lead(-kTo_m, -2.0 * kPit_m);
        ASSERT_LE(hand.cut_m().y, -kPit_m) << tool.name;
        for (double x = -kTo_m; x < -kTo_m + 0.002; x += kTick_m) lead(x, -kPit_m);
        for (double x = -kTo_m + 0.002; x < 2.0 * kTo_m; x += kTick_m) lead(x, -kGroove_m);
        EXPECT_GT(hand.cut_m().x, kTo_m) << tool.name;
    }
}

TEST(CarvedGroove, AToolThatIsPlungedIsNeverSetInsideMaterial) {
    std::vector<GrooveCase> cases = groove_cases({0.0});
    for (const GrooveCase& one : cases)
        for (const bool at_once : {false, true}) {
            const bench::Plunged plunged = bench::plunge(one.tool.shape, one.resolution, at_once);
            EXPECT_EQ(plunged.let_go, 0u) << one.name() << ' ' << at_once;
            EXPECT_EQ(plunged.without_force, 0u) << one.name() << ' ' << at_once;
            EXPECT_LE(plunged.most_cost_us, 340.0) << one.name() << ' ' << at_once;
        }
}

// A hand that goes anywhere at 5 to 500 mm/s and presses the button at will. It goes as deep as its tool cuts itself
// no roof, under which it would be held while the hand is above the block, and without friction, by which a wall would
// hold it. Clear is a hand that has been above for 60 ticks.
TEST(CarvedGroove, CarvingAtRandomIsBoundedAndHoldsNothingInFreeAir) {
    constexpr double kClear_m = 0.0005, kCostBound_us = 340.0, kNoForce_N = 0.01;
    constexpr int kClearTicks = 60, kLegs = 200;
    const int most = compute::test::kSanitized ? 1500 : test::costly_cases(100'000);
    std::mt19937_64 random(test::property_cases().seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int all_ticks = 0, all_in_contact = 0;  // of each tool alone there are few under sanitizers
    for (const bench::CarvingTool& tool : bench::carving_tools()) {
        bench::CarvingHand hand(tool.shape, {.resolution = 128});
        for (TouchMaterial& material : hand.parameters().materials)
            material.static_friction = material.dynamic_friction = 0.0;
        const double deep_m = tool.name == "ball" ? 0.0012 : tool.name == "box" ? 0.0024 : 0.004;
        Vec3 at(0.0, 0.005, 0.0);
        bool pressed = false;
        int ticks = 0, clear = 0, in_contact = 0;
        for (int leg = 0; leg < kLegs && ticks < most; ++leg) {
            const Vec3 from = at;
            const Vec3 to((any(random) - 0.5) * 0.044, -deep_m + any(random) * 2.0 * deep_m,
                          (any(random) - 0.5) * 0.034);
            const double speed_m_per_s = std::pow(10.0, -2.3 + 2.0 * any(random));
            if (any(random) < 0.5) pressed = !pressed;
            const int steps = std::max(1, static_cast<int>(glm::length(to - from) / (speed_m_per_s * 1e-3)));
            for (int i = 1; i <= steps && ticks < most; ++i, ++ticks) {
                at = from + (to - from) * (static_cast<double>(i) / steps);
                const TickRecord& record = hand.go_to(at, pressed);
                const double force_N = std::max(glm::length(record.gate.given.force_device_N),
                                                glm::length(record.contact.wrench.force_device_N));
                const std::string what = tool.name + ", tick " + std::to_string(ticks);
                ASSERT_TRUE(std::isfinite(force_N)) << what;
                ASSERT_LE(hand.cost_us(), kCostBound_us) << what;
                const bool cuts = at.y < 0.0 && (pressed || (record.flags & kTickCutting) != 0);
                ASSERT_FALSE(cuts && (record.flags & kTickLetGo) != 0) << what << ": set inside material";
                clear = at.y > kClear_m ? clear + 1 : 0;
                ASSERT_TRUE(clear <= kClearTicks || force_N <= kNoForce_N) << what << ": " << force_N << " N";
                in_contact += record.in_contact() ? 1 : 0;
            }
        }
        all_ticks += ticks;
        all_in_contact += in_contact;
    }
    EXPECT_GT(all_in_contact, all_ticks / 50);
}

}  // namespace burin::haptics
