// SPDX-License-Identifier: MIT
// The driver that is there to be copied, each of its parts by itself and the whole. A driver of yours wants the same
// tests, and its emulator besides (docs/writing-a-driver.md).
#include "devices/sample/sample_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "tests/devices/told_clock.hpp"

namespace burin::devices {
namespace {

// A cable that a test plays by hand: what it is sent is written down, what it answers is set.
class PlayedCable final : public SampleCable {
public:
    struct Record {
        std::vector<SampleCommandBytes> sent;
        std::vector<std::byte> answer;
    };
    explicit PlayedCable(Record& record) : record_(record) {}
    [[nodiscard]] std::span<const std::byte> exchange(const SampleCommandBytes& command) noexcept override {
        record_.sent.push_back(command);
        return record_.answer;
    }

private:
    Record& record_;
};

std::vector<std::byte> sample_bytes(std::initializer_list<int> values) {
    std::vector<std::byte> bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

// By hand from IEEE 754: 0.5 is 3f000000, -2 is c0000000, 0.25 is 3e800000; lowest byte first. No two axes are alike.
const std::vector<std::byte> kReportByHand = sample_bytes({0, 0, 0, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0x80, 0x3e, 2});

}  // namespace

TEST(SampleDevice, SaysAndReadsTheBytesThatAreWrittenDownByHand) {
    const SampleCommandBytes sent = sample_command_bytes({0.5, -2.0, 0.25});
    EXPECT_TRUE(std::ranges::equal(sent, std::span(kReportByHand).first(12)));
    const auto report = sample_report(kReportByHand);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->position_device_m, Vec3(0.5, -2.0, 0.25));
    EXPECT_EQ(report->buttons, 2u);
}

TEST(SampleDevice, ReadsNoPacketOfAnotherSizeAndNoNumberThatIsNone) {
    for (std::size_t size = 0; size < kReportByHand.size(); ++size)
        EXPECT_FALSE(sample_report(std::span(kReportByHand).first(size))) << size;
    std::vector<std::byte> spoilt = kReportByHand;
    spoilt.push_back({});
    EXPECT_FALSE(sample_report(spoilt));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        spoilt = kReportByHand;
        spoilt[4 * axis + 2] = static_cast<std::byte>(0xc0);
        spoilt[4 * axis + 3] = static_cast<std::byte>(0x7f);  // 7fc00000 is NaN
        EXPECT_FALSE(sample_report(spoilt)) << axis;
    }
}

TEST(SampleDevice, GivesAForceWithinItsLimitAsItIsAndAGreaterOneShortened) {
    EXPECT_EQ(sample_command_bytes({0.0, 8.0, 0.0}), sample_command_bytes({0.0, kSampleMost_N, 0.0}));
    EXPECT_NE(sample_command_bytes({0.0, 3.0, 0.0}), sample_command_bytes({0.0, kSampleMost_N, 0.0}));
}

TEST(SampleDevice, ATurnWithoutAnAnswerIsAFaultAndManyAreALostDeviceThatIsSaidOnce) {
    PlayedCable::Record record;
    SampleLine line([&]() -> Result<std::unique_ptr<SampleCable>> { return std::make_unique<PlayedCable>(record); });
    ASSERT_TRUE(line.open());
    record.answer = kReportByHand;
    ServedState state;
    state.fault = DeviceFault::none;
    ASSERT_TRUE(line.turn({Vec3(0.5, -2.0, 0.25), Vec3(0.0)}, state));
    EXPECT_EQ(state.pose_device.position_m, Vec3(0.5, -2.0, 0.25));
    EXPECT_EQ(state.fault, DeviceFault::none);
    EXPECT_EQ(record.sent.back(), sample_command_bytes({0.5, -2.0, 0.25}));
    record.answer.clear();
    for (int turn = 1; turn < kSampleSilent; ++turn) {
        ASSERT_TRUE(line.turn({}, state)) << turn;
        EXPECT_EQ(state.fault, DeviceFault::disconnected) << turn;
    }
    EXPECT_FALSE(line.turn({}, state)) << "it is gone";
    const LineNotice gone = line.notice();
    EXPECT_TRUE(line.words_for(gone).contains("has said nothing for 20 ms; look after its cable"));
    EXPECT_EQ(line.notice(), LineNotice{}) << "once";
    line.close();
    ASSERT_TRUE(line.open());
    EXPECT_TRUE(line.words_for(line.notice()).contains("is back"));
}

TEST(SampleDevice, ItsLastCommandIsNoForce) {
    PlayedCable::Record record;
    record.answer = kReportByHand;
    {
        auto clock = std::make_unique<TurnsClock>();
        TurnsClock& turns = *clock;
        auto servo = LineServo::open(std::make_unique<SampleLine>([&]() -> Result<std::unique_ptr<SampleCable>> {
                                         return std::make_unique<PlayedCable>(record);
                                     }),
                                     std::move(clock));
        ASSERT_TRUE(servo);
        turns.take_turns(2);
        (*servo)->exchange().command({Vec3(1.0, 2.0, 3.0), Vec3(0.0)}, turns.now_ns());
        turns.take_turns(4);
        turns.let_go();
    }
    ASSERT_GT(record.sent.size(), 4u);
    EXPECT_GT(std::ranges::count(record.sent, sample_command_bytes({1.0, 2.0, 3.0})), 0);
    EXPECT_EQ(record.sent.back(), SampleCommandBytes{});
}

TEST(SampleDevice, PushedWithTwoNewtonsItsArmGoesAsFarAsItsSpringGives) {
    auto cable = open_sample_cable();
    ASSERT_TRUE(cable);
    Vec3 at_m{0.0};
    for (int turn = 0; turn < 2000; ++turn)
        at_m = sample_report((*cable)->exchange(sample_command_bytes({0.0, 2.0, 0.0})))->position_device_m;
    EXPECT_NEAR(at_m.y, 2.0 / 200.0, 1e-6) << "2 N on 200 N/m, in floats";
}

TEST(SampleDevice, IsOpenedByItsNameIsThereAndTakesNoDescription) {
    MonotonicClock clock;
    const auto host = [&] { return HapticHost{clock, *SimulatedHand::create({{0.0, Vec3(0.0)}})}; };
    const auto opened = open_haptic_device(kSample, host());
    ASSERT_TRUE(opened) << opened.error().line();
    EXPECT_EQ(opened->parts.front().device->description().max_force_N, kSampleMost_N);
    const auto refused = open_haptic_device("sample:7", host());
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("write sample alone")) << refused.error().line();
    ASSERT_EQ(look_for_samples().size(), 1u);
    EXPECT_EQ(look_for_samples().front().presence, Presence::there);
}

}  // namespace burin::devices
