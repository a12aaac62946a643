// SPDX-License-Identifier: MIT
// The guided check of a force-feedback device: what it finds of simulated ones that are well, and of ones that are not.
#include "bench/devices/device_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "devices/emulators/circling_hand.hpp"
#include "devices/haptic/simulated_omni.hpp"

namespace burin::bench {
namespace {

// An Omni in a circling hand, of which a test spoils what it says or what it is told.
class SpoiltOmni final : public devices::HapticDevice {
public:
    struct Ways {
        std::function<void(devices::DeviceSample&)> spoil_sample;
        std::function<Vec3(const Vec3&)> spoil_force;
        std::function<void(devices::DeviceDescription&)> spoil_description;
        Vec3 given_N{0.0};
        double most_N = 0.0;
    };
    SpoiltOmni(Clock& clock, Ways& ways)
        : omni_(devices::SimulatedHand::create(devices::circling_hand(), devices::HandPath::monotone_cubic).value(), {},
                &clock),
          ways_(ways),
          description_(omni_.description()) {
        if (ways.spoil_description) ways.spoil_description(description_);
    }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override {
        devices::DeviceSample sample = omni_.read();
        if (ways_.spoil_sample) ways_.spoil_sample(sample);
        return sample;
    }
    void write(const devices::DeviceWrench& wrench) noexcept override {
        ways_.given_N = wrench.force_device_N;
        ways_.most_N = std::max(ways_.most_N, glm::length(wrench.force_device_N));
        omni_.write({ways_.spoil_force ? ways_.spoil_force(wrench.force_device_N) : wrench.force_device_N, Vec3(0.0)});
    }

private:
    devices::SimulatedOmni omni_;
    Ways& ways_;
    devices::DeviceDescription description_;
};

class QuietGuide final : public CheckGuide {
public:
    std::function<CheckAnswers(Nanoseconds)> answer = [](Nanoseconds) { return CheckAnswers{}; };
    std::string said;
    void say(const std::string& line) override { said += line + "\n"; }
    void show(const std::string&) override {}
    CheckAnswers answers(Nanoseconds now_ns) override { return answer(now_ns); }
};

std::vector<CheckLine> checked(SpoiltOmni::Ways& ways, const CheckOptions& options = {.by_itself = true},
                               QuietGuide guide = {}) {
    SimulatedClock clock;
    clock.sleep_until(1'000'000'000);
    devices::OpenedDevice device = devices::of_one_part(std::make_unique<SpoiltOmni>(clock, ways));
    return check_device(device, clock, guide, options);
}

// Returns the verdicts by the beginnings of their names.
std::string verdict_of(const std::vector<CheckLine>& lines, const std::string& check) {
    for (const CheckLine& line : lines)
        if (line.check.starts_with(check)) return std::string(name_of(line.verdict)) + ": " + line.found;
    return "none";
}

}  // namespace

TEST(DeviceCheck, PassesADeviceThatIsWellWithAGentleForceAndNoneAtTheEnd) {
    SpoiltOmni::Ways ways;
    const auto lines = checked(ways);
    ASSERT_EQ(lines.size(), 7u);
    for (const CheckLine& line : lines) EXPECT_EQ(line.verdict, Verdict::passed) << line.check << ": " << line.found;
    EXPECT_GT(ways.most_N, 0.99);
    EXPECT_LE(ways.most_N, 1.0 + 1e-9);
    EXPECT_EQ(ways.given_N, Vec3(0.0));
    // The hand of 200 N/m gives way by 10 mm to two newtons, less twice the friction of 0.26 N, which also keeps the
    // handle from coming back by up to 1.3 mm.
    for (const CheckLine& line : lines) {
        if (!line.check.starts_with("force")) continue;
        EXPECT_NEAR(line.figures["gives_way_m"].get<double>(), 0.0068, 0.002);
    }
}

TEST(DeviceCheck, FindsAForceThatIsReversedMissingOrOfAnotherAxis) {
    SpoiltOmni::Ways ways;
    ways.spoil_force = [](const Vec3& force_N) { return Vec3(-force_N.x, 0.0, force_N.z); };
    const auto lines = checked(ways);
    EXPECT_TRUE(verdict_of(lines, "force to the right").contains("failed")) << verdict_of(lines, "force to the right");
    EXPECT_TRUE(verdict_of(lines, "force to the right").contains("against the force"));
    EXPECT_TRUE(verdict_of(lines, "force up").contains("does not feel the force")) << verdict_of(lines, "force up");
    EXPECT_TRUE(verdict_of(lines, "force to you").starts_with("passed"));
    ways.spoil_force = [](const Vec3& force_N) { return Vec3(force_N.y, force_N.x, force_N.z); };
    EXPECT_TRUE(verdict_of(checked(ways), "force up").starts_with("failed"));
}

TEST(DeviceCheck, FindsNoNumbersFaultsAndAHandleThatDoesNotMove) {
    SpoiltOmni::Ways ways;
    ways.spoil_sample = [](devices::DeviceSample& sample) { sample.position_device_m.y = std::nan(""); };
    auto lines = checked(ways);
    EXPECT_TRUE(verdict_of(lines, "answers").contains("failed: its position is no number"));
    EXPECT_EQ(ways.most_N, 0.0) << "nothing was tried";
    ways.spoil_sample = [](devices::DeviceSample& sample) { sample.fault = devices::DeviceFault::overheated; };
    EXPECT_TRUE(verdict_of(checked(ways), "answers").contains("failed: its motors are warm"));
    ways.spoil_sample = [](devices::DeviceSample& sample) {
        sample.position_device_m.x = 0.01;
        sample.buttons = 0;
    };
    lines = checked(ways);
    EXPECT_TRUE(verdict_of(lines, "position").contains("along some axis not at all")) << verdict_of(lines, "position");
    EXPECT_TRUE(verdict_of(lines, "buttons").contains("failed: none was seen"));
    ways.spoil_sample = [count = 0](devices::DeviceSample& sample) mutable {
        if (++count % 8 == 0) sample.fault = devices::DeviceFault::disconnected;
    };
    EXPECT_TRUE(verdict_of(checked(ways), "steadiness").starts_with("failed"))
        << verdict_of(checked(ways), "steadiness");
}

TEST(DeviceCheck, PushesOnlyWhileTheDeadMansKeyIsHeld) {
    SpoiltOmni::Ways ways;
    QuietGuide guide;
    double most_without_N = 0.0;
    Nanoseconds let_go_ns = 0;
    bool went_on = false;
    guide.answer = [&](Nanoseconds now_ns) {
        CheckAnswers answers;
        // Enter once a second; the key is held in three of every four seconds.
        answers.goes_on = now_ns / 1'000'000 % 1000 == 0;
        went_on = went_on || answers.goes_on;
        answers.holds = now_ns / 1'000'000'000 % 4 != 0;
        if (answers.holds) let_go_ns = now_ns;
        // A newton goes away in a twentieth of a second.
        if (now_ns - let_go_ns > 60'000'000) most_without_N = std::max(most_without_N, glm::length(ways.given_N));
        return answers;
    };
    const auto lines = checked(ways, {}, guide);
    EXPECT_EQ(most_without_N, 0.0);
    EXPECT_TRUE(went_on);
    EXPECT_GT(ways.most_N, 0.99);
    QuietGuide never;
    never.answer = [](Nanoseconds now_ns) { return CheckAnswers{.goes_on = now_ns / 1'000'000 % 1000 == 0}; };
    ways.most_N = 0.0;
    EXPECT_TRUE(verdict_of(checked(ways, {}, never), "force up").starts_with("failed: was not finished"));
    EXPECT_EQ(ways.most_N, 0.0);
}

TEST(DeviceCheck, EndsWhenItIsToldToAndTriesNoForceWhereNoneIsWanted) {
    SpoiltOmni::Ways ways;
    QuietGuide guide;
    guide.answer = [](Nanoseconds now_ns) { return CheckAnswers{.ends = now_ns > 1'500'000'000}; };
    const auto ended = checked(ways, {}, guide);
    EXPECT_TRUE(verdict_of(ended, "force up").contains("skipped")) << verdict_of(ended, "force up");
    EXPECT_EQ(ways.most_N, 0.0);
    const auto without = checked(ways, {.by_itself = true, .pushes = false});
    EXPECT_EQ(verdict_of(without, "force"), "none");
    EXPECT_EQ(ways.most_N, 0.0);
}

TEST(DeviceCheck, LeavesNoForceWhereverTheTapsAreEndedOrSkipped) {
    for (int ms = 0; ms < 1000; ms += 37) {
        SpoiltOmni::Ways ways;
        QuietGuide guide;
        Nanoseconds pushed_ns = 0;
        guide.answer = [&, ms](Nanoseconds now_ns) {
            if (pushed_ns == 0 && ways.most_N > 0.0) pushed_ns = now_ns;
            const bool is_time = pushed_ns > 0 && now_ns - pushed_ns >= ms * 1'000'000;
            return CheckAnswers{.skips = is_time && ms % 2 == 0, .ends = is_time && ms % 2 == 1};
        };
        const auto lines = checked(ways, {.by_itself = true}, guide);
        EXPECT_EQ(verdict_of(lines, "force to the right"), "skipped: skipped") << ms;
        EXPECT_GT(ways.most_N, 0.0);
        EXPECT_EQ(ways.given_N, Vec3(0.0)) << ms;
    }
}

TEST(DeviceCheck, SkipsWithItsReasonWhatADeviceDoesNotHave) {
    SpoiltOmni::Ways ways;
    ways.spoil_sample = [](devices::DeviceSample& sample) { sample.buttons = 0; };
    ways.spoil_description = [](devices::DeviceDescription& d) { d.has_buttons = false; };
    EXPECT_EQ(verdict_of(checked(ways), "buttons"), "skipped: it has none");
    ways.spoil_description = nullptr;
    EXPECT_EQ(verdict_of(checked(ways), "buttons"), "failed: none was seen") << "one that has some is to show it";
    ways.spoil_description = [](devices::DeviceDescription& d) { d.led_by = "a SpaceMouse"; };
    EXPECT_TRUE(verdict_of(checked(ways), "force").starts_with("skipped: nobody would feel it"));
    ways.spoil_description = [](devices::DeviceDescription& d) { d.gives_way = false; };
    EXPECT_TRUE(verdict_of(checked(ways), "force").starts_with("skipped: its simulated fingers hold"));
}

TEST(DeviceCheck, SaysWhichFaultInterruptedTheTaps) {
    SpoiltOmni::Ways ways;
    // Each tenth of a second it is gone for a tick, and the taps begin anew.
    ways.spoil_sample = [](devices::DeviceSample& sample) {
        if (sample.time_ns / 1'000'000 % 100 == 0) sample.fault = devices::DeviceFault::disconnected;
    };
    const std::string said = verdict_of(checked(ways), "force to");
    EXPECT_TRUE(said.contains("in between it does not answer")) << said;
    EXPECT_FALSE(said.contains("no fault")) << said;
}

}  // namespace burin::bench
