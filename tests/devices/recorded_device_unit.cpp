// SPDX-License-Identifier: MIT
// A recorded hand as a device: which sample each turn has. Recordings of sessions are in
// tests/desk/recorded_device_unit.cpp.
#include "devices/haptic/recorded_device.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "devices/haptic/steered_fingers.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"

namespace burin::devices {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

// Samples whose x is the number of their tick in millimetres; the button is down in every second one.
RecordedSample sample_of(std::uint64_t tick) {
    RecordedSample sample{static_cast<Nanoseconds>(tick) * kMs, {}};
    sample.sample.position_device_m.x = 0.001 * static_cast<double>(tick);
    sample.sample.buttons = tick % 2 == 0 ? 1u : 0u;
    sample.sample.time_ns = -7;
    return sample;
}

// Recordings that need no files: "s" of a stylus, "f" of fingers, "r" of itself.
class MadeUp final : public Recordings {
public:
    explicit MadeUp(std::vector<std::uint64_t> ticks) : ticks_(std::move(ticks)) {}
    Result<std::string> device_of(const std::string& file, const std::string& hand) const override {
        if (!hand.empty() && hand != "right") return fail(file, "has no hand " + hand);
        if (file == "r.session") return "recorded:r.session";
        return file == "f.session" ? std::string(kSimulatedFingers) : std::string(kDefaultHapticDevice);
    }
    Result<RecordedHand> hand_of(const std::string& file, const std::string& hand) const override {
        auto device = device_of(file, hand);
        if (!device) return std::unexpected(device.error());
        RecordedHand made{std::move(*device), {}};
        for (int part = 0; part < (file == "f.session" ? 2 : 1); ++part) {
            made.parts.emplace_back();
            for (const std::uint64_t tick : ticks_) made.parts.back().samples.push_back(sample_of(tick));
        }
        return made;
    }

private:
    std::vector<std::uint64_t> ticks_;
};

HapticHost host_of(Clock& clock, const Recordings* recordings) {
    return {clock, *SimulatedHand::create({{0.0, Vec3(0.0)}, {1.0, Vec3(0.0)}}), false, recordings};
}

// The numbers of the samples that turns at these times have.
std::vector<long> played(const std::string& device, const Recordings& recordings,
                         const std::vector<Nanoseconds>& times_ns) {
    SimulatedClock clock;
    auto opened = open_haptic_device(device, host_of(clock, &recordings));
    EXPECT_TRUE(opened) << opened.error().line();
    std::vector<long> numbers;
    for (const Nanoseconds time_ns : times_ns) {
        clock.sleep_until(time_ns);
        const DeviceSample sample = opened->parts[0].device->read();
        opened->parts[0].device->write({Vec3(1.0), Vec3(1.0)});
        numbers.push_back(std::lround(1000.0 * sample.position_device_m.x));
    }
    return numbers;
}

std::string refused_by(const std::string& device, const Recordings* recordings) {
    SimulatedClock clock;
    const auto opened = open_haptic_device(device, host_of(clock, recordings));
    return opened ? "nothing" : opened.error().line();
}

}  // namespace

TEST(RecordedDevice, GivesEachTurnTheSampleOfItsTick) {
    const MadeUp six({0, 1, 2, 3, 4, 5});
    EXPECT_EQ(played("recorded:s.session", six, {5 * kMs, 6 * kMs, 7 * kMs, 8 * kMs}), (std::vector<long>{0, 1, 2, 3}));
    EXPECT_EQ(played("recorded:s.session", six, {5 * kMs + 900'000, 6 * kMs, 7 * kMs + 999'999, 8 * kMs}),
              (std::vector<long>{0, 1, 2, 3}))
        << "late turns repeat nothing and leave nothing out";
    EXPECT_EQ(played("recorded:s.session", six, {5 * kMs, 7 * kMs + 200'000, 7 * kMs + 300'000, 8 * kMs}),
              (std::vector<long>{0, 1, 2, 3}))
        << "a turn that is late by more than a period, and the next ones, which make up for it";
    EXPECT_EQ(played("recorded:s.session", six, {5 * kMs, 6 * kMs, 9 * kMs, 10 * kMs}), (std::vector<long>{0, 1, 4, 5}))
        << "missed deadlines";
    EXPECT_EQ(played("recorded:s.session:right", MadeUp({0, 1, 4, 5}), {0, kMs, 2 * kMs, 3 * kMs, 4 * kMs, 5 * kMs}),
              (std::vector<long>{0, 1, 1, 1, 4, 5}))
        << "the recording's own gap";
}

TEST(RecordedDevice, IsAsOldAsItWasAndOfTheDeviceThatWasRecorded) {
    const MadeUp two({0, 1});
    SimulatedClock clock;
    auto opened = open_haptic_device("recorded:f.session", host_of(clock, &two));
    // Fingers have four parts, and this recording two.
    ASSERT_FALSE(opened);
    EXPECT_TRUE(opened.error().line().contains("has 2 parts of simulated-fingers, which has 4"))
        << opened.error().line();
    opened = open_haptic_device("recorded:s.session", host_of(clock, &two));
    ASSERT_TRUE(opened);
    clock.sleep_until(77 * kMs);
    const DeviceSample sample = opened->parts[0].device->read();
    EXPECT_EQ(sample.time_ns, 77 * kMs - 7);
    EXPECT_EQ(sample.buttons, 1u);
    const DeviceDescription& description = opened->parts[0].device->description();
    EXPECT_STREQ(description.name, "recording of simulated PHANTOM Omni");
    EXPECT_EQ(description.max_force_N, OmniModel{}.max_force_N);
    EXPECT_FALSE(description.felt_by_person);
}

TEST(RecordedDevice, RestsAtItsEndWithNoButtonAndSaysSoOnce) {
    const MadeUp three({0, 1, 2});
    SimulatedClock clock;
    auto opened = open_haptic_device("recorded:s.session", host_of(clock, &three));
    ASSERT_TRUE(opened);
    HapticDevice& device = *opened->parts[0].device;
    for (int tick = 0; tick < 3; ++tick) {
        EXPECT_TRUE(opened->messages->take_messages().empty());
        static_cast<void>(device.read());
        clock.sleep_until(clock.now_ns() + kMs);
    }
    for (int tick = 0; tick < 3; ++tick) {
        const DeviceSample sample = device.read();
        EXPECT_EQ(sample.position_device_m.x, 0.002);
        EXPECT_EQ(sample.buttons, 0u) << "a stroke does not go on by itself";
        EXPECT_EQ(sample.time_ns, clock.now_ns());
        clock.sleep_until(clock.now_ns() + kMs);
    }
    const auto said = opened->messages->take_messages();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0], "the recording s.session has ended: the hand rests where it was last");
    EXPECT_TRUE(opened->messages->take_messages().empty());
}

// A loop must not throw the hand back within a tick.
TEST(RecordedDevice, LoopsByWayOfAGlide) {
    std::vector<std::uint64_t> ticks;
    for (std::uint64_t tick = 0; tick < 50; ++tick) ticks.push_back(tick);
    const MadeUp fifty(std::move(ticks));
    SimulatedClock clock;
    auto opened = open_haptic_device("recorded:s.session,loop", host_of(clock, &fifty));
    ASSERT_TRUE(opened) << opened.error().line();
    double before_m = 0.0, most_m = 0.0;
    int begun_anew = 0;
    for (int tick = 0; tick < 5000; ++tick) {
        const DeviceSample sample = opened->parts[0].device->read();
        const double x_m = sample.position_device_m.x;
        most_m = std::max(most_m, std::abs(x_m - before_m));
        begun_anew += before_m > 0.0 && x_m == 0.0 ? 1 : 0;
        before_m = x_m;
        clock.sleep_until(clock.now_ns() + kMs);
    }
    EXPECT_LE(most_m, 0.001 + 1e-12) << "no faster than the recording itself";
    EXPECT_EQ(begun_anew, 5000 / 1550);
    EXPECT_TRUE(opened->messages->take_messages().empty()) << "it does not end";
}

TEST(RecordedDevice, HasTheNatureOfWhatWasRecorded) {
    const MadeUp recordings({0});
    const auto nature = nature_of_device("recorded:f.session,loop", &recordings);
    ASSERT_TRUE(nature) << nature.error().line();
    EXPECT_EQ(nature->parts, 4u);
    EXPECT_TRUE(nature->is_upright);
    EXPECT_TRUE(nature->is_played);
    EXPECT_FALSE(nature_of_device("simulated", &recordings)->is_played);
    const auto itself = nature_of_device("recorded:r.session", &recordings);
    ASSERT_FALSE(itself);
    EXPECT_TRUE(itself.error().line().contains("plays itself")) << itself.error().line();
    EXPECT_FALSE(has_handle("recorded:s.session", &recordings));
}

TEST(RecordedDevice, SaysWhatIsWrongWithItsName) {
    const MadeUp recordings({0});
    EXPECT_TRUE(refused_by("recorded", &recordings).contains("names no recording"));
    EXPECT_TRUE(refused_by("recorded:", &recordings).contains("names no recording"));
    EXPECT_TRUE(refused_by("recorded:s.session,lop", &recordings).contains("an option that is not known: lop"));
    EXPECT_TRUE(refused_by("recorded:s.session:left", &recordings).contains("has no hand left"));
    EXPECT_TRUE(refused_by("recorded:s.session", nullptr).contains("cannot be played here"));
    const auto choice = recorded_choice("a:b/c,d.session:left,loop");
    ASSERT_TRUE(choice) << choice.error().line();
    EXPECT_EQ(choice->file, "a:b/c,d.session");
    EXPECT_EQ(choice->hand, "left");
    EXPECT_TRUE(choice->loops);
    EXPECT_EQ(recorded_choice("a:b/c,d.session")->file, "a:b/c,d.session");
}

}  // namespace burin::devices
