// SPDX-License-Identifier: MIT
// A glove whose sets come two at a time: its ticks see the motion that the fingers made, and not that of the line.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

#include "tests/devices/opened_glove.hpp"

namespace burin::devices {
namespace {

constexpr double kTurns_rad = 0.02;  // of each first joint, from set to set

// Says sets as they come over a line, and has its ticks read them.
class PairedGlove {
public:
    // Says one more set, in which each first joint has turned on.
    void say(double beside_rad = 0.0) {
        GloveSet set = healthy_set(1);
        set.number = static_cast<std::uint8_t>(++number_);
        for (FingerAngles& finger : set.joints) finger[1] += kTurns_rad * number_;
        set.joints[1][1] += beside_rad;
        set.forces_N = GloveForces{};  // as much as they are told, but for a jitter that says that the set has come
        said_N_ = (*set.forces_N)[0] = 0.05 * (1 + number_ % 8);
        opened_.glove().say(set);
    }
    // Waits until the set that was said last has come; nobody's clock moves meanwhile.
    void await() {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::abs(read()[0].drive.measured_N - said_N_) > 1e-9) {
            ASSERT_LT(std::chrono::steady_clock::now(), until) << "the set has not come for half a minute";
            std::this_thread::yield();
        }
    }
    // Has so many ticks read, each a millisecond after the one before.
    template <typename Each>
    void tick(int ticks, Each each) {
        for (int i = 0; i < ticks; ++i) {
            opened_.glove().clock().move_on(1'000'000);
            each(read());
        }
    }
    // The rest of two periods, after 16 ticks of a millisecond.
    void fill_up() { opened_.glove().clock().move_on(2 * GloveLink::kSend_ns - 16'000'000); }

    // Returns how many reads have told that a set was left out.
    [[nodiscard]] int told() const { return told_; }

private:
    [[nodiscard]] std::vector<DeviceSample> read() {
        auto samples = opened_.read();
        told_ += (samples[2].drive.state & kDriveSetRejected) != 0 ? 1 : 0;
        return samples;
    }
    int told_ = 0;
    OpenedGlove opened_;
    int number_ = 1;
    double said_N_ = 0.0;
};

}  // namespace

TEST(GlovePairs, ATickSeesTheMotionOfTheFingersWhenSetsComeTwoAtATime) {
    PairedGlove glove;
    std::array<double, kGloveFingers> last_rad{};
    for (int pair = 0; pair < 30; ++pair) {
        glove.say();
        glove.say();
        glove.await();
        glove.tick(16, [&](const std::vector<DeviceSample>& samples) {
            for (std::size_t i = 0; i < kGloveFingers; ++i) {
                EXPECT_EQ(samples[i].fault, DeviceFault::none) << pair;
                const double step_rad = samples[i].joints[1] - std::exchange(last_rad[i], samples[i].joints[1]);
                if (pair < 12) continue;  // until it is as late as the pairs need
                // A set's turn over 8.3 ticks, where readings come in steps of 0.0012 rad.
                EXPECT_GT(step_rad, 0.7 * kTurns_rad / 8.33) << i << " " << pair;
                EXPECT_LT(step_rad, 1.4 * kTurns_rad / 8.33) << i << " " << pair;
            }
        });
        glove.fill_up();
        for (std::size_t i = 0; i < kGloveFingers; ++i) last_rad[i] += 0.667 * kTurns_rad / 8.33;
    }
}

// One damaged set among sound ones: left out, told in one tick, and no finger loses its force.
TEST(GlovePairs, ASetThatIsLeftOutIsToldOnceAndFaultsNoFinger) {
    PairedGlove glove;
    for (int set = 0; set < 30; ++set) {
        if (set == 20) glove.say(1.2);
        if (set != 20) glove.say();
        if (set != 20) glove.await();
        glove.tick(8, [&](const std::vector<DeviceSample>& samples) {
            for (const DeviceSample& sample : samples) EXPECT_EQ(sample.fault, DeviceFault::none) << set;
            EXPECT_LT(samples[1].joints[1], 0.9) << set;
        });
    }
    EXPECT_EQ(glove.told(), 1);
}

}  // namespace burin::devices
