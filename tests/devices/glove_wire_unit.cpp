// SPDX-License-Identifier: MIT
// The line of a glove byte by byte, with frames written out by hand from docs/glove.md, and what a host sends over it
// turn by turn: which finger gets what, no more than a piston may give, and a stop wherever the program falls silent
// or ends.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <thread>
#include <utility>
#include <vector>

#include "devices/emulators/glove_wire.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/gloves/glove_link.hpp"
#include "tests/devices/bare_glove.hpp"
#include "tests/devices/hand_written_bytes.hpp"
#include "tests/devices/opened_glove.hpp"
#include "tests/support/uneven_poses.hpp"

namespace burin::devices {
namespace {

std::vector<std::byte> written(const GloveBytes& frame) { return {frame.view().begin(), frame.view().end()}; }

template <typename Frame>
Frame only_one_in(const std::vector<std::byte>& bytes) {
    GloveFrameReader<Frame> reader;
    std::vector<Frame> frames;
    for (const std::byte byte : bytes)
        if (const auto frame = reader.take(byte)) frames.push_back(*frame);
    EXPECT_EQ(frames.size(), 1u);
    EXPECT_EQ(reader.counts().dropped_bytes, 0u);
    return frames.empty() ? Frame{} : frames.front();
}

HeardGloveFrame only_one_heard(const std::vector<std::byte>& bytes) {
    GloveControllerEar ear;
    std::vector<HeardGloveFrame> frames;
    for (const std::byte byte : bytes)
        if (auto frame = ear.take(byte)) frames.push_back(std::move(*frame));
    EXPECT_EQ(frames.size(), 1u);
    return frames.empty() ? HeardGloveFrame{} : frames.front();
}

// Angles of the steps 0x123, 0x456, 0x789, 0xabc ... that the frames below have; 0 is -90 degrees and 4095 is 180.
GloveJoints joints_by_hand() {
    const auto angle_rad = [](unsigned steps) { return (-90.0 + 270.0 * steps / 4095.0) * std::numbers::pi / 180.0; };
    return {{{angle_rad(0x123), angle_rad(0x456), angle_rad(0x789), angle_rad(0xabc)},
             {angle_rad(0x0de), angle_rad(0xf01), angle_rad(0x234), angle_rad(0x567)},
             {angle_rad(0x89a), angle_rad(0xbcd), angle_rad(0xef0), angle_rad(0x135)},
             {angle_rad(0x246), angle_rad(0x357), angle_rad(0x468), angle_rad(0x579)}}};
}

void expect_same(const GloveSet& read, const GloveSet& said) {
    EXPECT_EQ(read.number, said.number);
    EXPECT_EQ(read.motors_on, said.motors_on);
    EXPECT_EQ(read.fault, said.fault);
    EXPECT_EQ(read.is_local, said.is_local);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
        for (std::size_t joint = 0; joint < kFingerJoints; ++joint)
            EXPECT_NEAR(read.joints[finger][joint], said.joints[finger][joint], 1e-12) << finger << " " << joint;
    ASSERT_EQ(read.forces_N.has_value(), said.forces_N.has_value());
    for (std::size_t finger = 0; said.forces_N && finger < kGloveFingers; ++finger)
        EXPECT_NEAR((*read.forces_N)[finger], (*said.forces_N)[finger], 1e-12) << finger;
}

void expect_same(const DriveLaw& read, const DriveLaw& said) {
    EXPECT_EQ(read.holds, said.holds);
    EXPECT_NEAR(read.spring_N_per_m, said.spring_N_per_m, 1e-9);
    EXPECT_NEAR(read.damping_Ns_per_m, said.damping_Ns_per_m, 1e-9);
    EXPECT_NEAR(read.friction_N, said.friction_N, 1e-9);
    EXPECT_NEAR(read.start_m, said.start_m, 1e-9);
    EXPECT_NEAR(read.most_N, said.most_N, 1e-9);
}

void expect_same(const GloveCommand& read, const GloveCommand& said) {
    EXPECT_EQ(read.number, said.number);
    EXPECT_EQ(read.stop, said.stop);
    EXPECT_EQ(read.local, said.local);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger)
        EXPECT_NEAR(read.forces_N[finger], said.forces_N[finger], 1e-12) << finger;
    ASSERT_EQ(read.law.has_value(), said.law.has_value());
    if (!said.law) return;
    EXPECT_EQ(read.law->finger, said.law->finger);
    expect_same(read.law->law, said.law->law);
}

// Another law for each finger, no number of which is another's; whole steps of the line, and less than a piston's most.
DriveLaw law_of(std::size_t finger) {
    const auto i = static_cast<double>(finger);
    return {.holds = true,
            .spring_N_per_m = 210.0 + 37.5 * i,
            .damping_Ns_per_m = 1.15 + 0.35 * i,
            .friction_N = 0.2 + 0.15 * i,
            .start_m = 0.0612 + 0.0071 * i,
            .most_N = 3.35 + 1.25 * i};
}

// Another for each finger; whole steps.
constexpr GloveForces kForces_N{0.65, 2.15, 4.8, 7.25};

std::unique_ptr<GloveLink> linked(BareGlove& glove) {
    glove.say(healthy_set(1));
    auto link = GloveLink::open(glove.name(), glove.clock());
    EXPECT_TRUE(link) << link.error().line();
    EXPECT_TRUE(glove.heard_turn().back().command.stop) << "nobody has asked for a force yet";
    return link ? std::move(*link) : nullptr;
}

}  // namespace

TEST(GloveWire, ASetIsTheBytesOfTheProtocol) {
    // Sync; positions, motors on; number 200; two angles in three bytes; check.
    const auto positions = hand_written({0x9d, 0x11, 0xc8,                    //
                                         0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc,  // thumb
                                         0x0d, 0xef, 0x01, 0x23, 0x45, 0x67,  // index
                                         0x89, 0xab, 0xcd, 0xef, 0x01, 0x35,  // middle
                                         0x24, 0x63, 0x57, 0x46, 0x85, 0x79, /* ring */ 0xb0});
    const GloveSet of_positions{.number = 200, .motors_on = true, .joints = joints_by_hand(), .forces_N = {}};
    expect_same(only_one_in<GloveSet>(positions), of_positions);
    EXPECT_EQ(controller_frame(of_positions), positions);
    EXPECT_EQ(written(frame_of(of_positions)), positions);
    // Positions and forces; a fault, and a finger that is rendered locally; number 201.
    const auto forces = hand_written({0x9d, 0x62, 0xc9,  //
                                      0x12, 0x34, 0x56, 0x78, 0x9a,
                                      0xbc,  // thumb
                                      0x0d, 0xef, 0x01, 0x23, 0x45,
                                      0x67,  // index
                                      0x89, 0xab, 0xcd, 0xef, 0x01,
                                      0x35,  // middle
                                      0x24, 0x63, 0x57, 0x46, 0x85,
                                      0x79,  // ring
                                      0x0b, 0x2a, 0x7d, 0xc8, /* 0.55, 2.1, 6.25, 10 N */ 0x56});
    const GloveSet of_forces{.number = 201,
                             .fault = true,
                             .is_local = true,
                             .joints = joints_by_hand(),
                             .forces_N = GloveForces{0.55, 2.1, 6.25, 10.0}};
    expect_same(only_one_in<GloveSet>(forces), of_forces);
    EXPECT_EQ(controller_frame(of_forces), forces);
    EXPECT_EQ(written(frame_of(of_forces)), forces);
}

// As the first set above, of version 2: it begins otherwise and ends in a second check.
TEST(GloveWire, ASetOfVersion2IsTheBytesOfTheProtocol) {
    const auto bytes = hand_written({0x62, 0x11, 0xc8,                    //
                                     0x12, 0x34, 0x56, 0x78, 0x9a, 0xbc,  // thumb
                                     0x0d, 0xef, 0x01, 0x23, 0x45, 0x67,  // index
                                     0x89, 0xab, 0xcd, 0xef, 0x01, 0x35,  // middle
                                     0x24, 0x63, 0x57, 0x46, 0x85, 0x79,  // ring
                                     0x31, 0xfb});
    const GloveSet set{.number = 200, .motors_on = true, .joints = joints_by_hand(), .forces_N = {}, .version = 2};
    expect_same(only_one_in<GloveSet>(bytes), set);
    EXPECT_EQ(only_one_in<GloveSet>(bytes).version, 2);
    EXPECT_EQ(controller_frame(set), bytes);
    EXPECT_EQ(written(frame_of(set)), bytes);
    for (std::size_t bit = 0; bit < 16; ++bit) {
        auto damaged = bytes;
        damaged[27 + bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        damaged.resize(damaged.size() + 40);
        GloveFrameReader<GloveSet> reader;
        for (const std::byte byte : damaged) EXPECT_FALSE(reader.take(byte)) << "in either check, " << bit;
    }
}

TEST(GloveWire, EachFlagOfASetIsItsOwnBit) {
    constexpr std::array<unsigned, 3> kBits{0x10, 0x20, 0x40};
    for (std::size_t flag = 0; flag < kBits.size(); ++flag) {
        GloveSet set = healthy_set(9);
        set.motors_on = flag == 0, set.fault = flag == 1, set.is_local = flag == 2;
        const std::vector<std::byte> frame = controller_frame(set);
        EXPECT_EQ(std::to_integer<unsigned>(frame[1]), 2 + kBits[flag]);
        EXPECT_EQ(written(frame_of(set)), frame);
        const auto read = only_one_in<GloveSet>(frame);
        EXPECT_EQ(read.motors_on, flag == 0);
        EXPECT_EQ(read.fault, flag == 1);
        EXPECT_EQ(read.is_local, flag == 2);
    }
}

TEST(GloveWire, ACommandIsTheBytesOfTheProtocol) {
    // Sync; forces, and the fingers 0, 1 and 3 that are rendered locally; number; 1, 3.05, 6.1 and 9.85 N; check.
    const auto forces = hand_written({0x9e, 0xb3, 0x47, 0x14, 0x3d, 0x7a, 0xc5, 0x96});
    const GloveCommand of_forces{.number = 0x47, .forces_N = {1.0, 3.05, 6.1, 9.85}, .local = 0b1011};
    EXPECT_EQ(written(frame_of(of_forces)), forces);
    expect_same(only_one_heard(forces).command, of_forces);
    EXPECT_EQ(only_one_heard(forces).bytes, forces);
    expect_same(only_one_in<GloveCommand>(forces), of_forces);
    // Sync; stop; number; nothing; check.
    const auto stop = hand_written({0x9e, 0x04, 0x48, 0x00, 0x00, 0x00, 0x00, 0x0a});
    EXPECT_EQ(written(frame_of(GloveCommand{.number = 0x48, .stop = true, .forces_N = {1, 2, 3, 4}})), stop);
    expect_same(only_one_heard(stop).command, {.number = 0x48, .stop = true});
    expect_same(only_one_in<GloveCommand>(stop), {.number = 0x48, .stop = true});
}

TEST(GloveWire, ALawIsTheBytesOfTheProtocolForEachFinger) {
    constexpr std::array<unsigned, kGloveFingers> kChecks{0x3b, 0x8b, 0x10, 0xec};
    for (unsigned finger = 0; finger < kGloveFingers; ++finger) {
        // Sync; the finger and 5; number; spring 4660 steps; damping 86; friction 31; start 9995; most 166; check.
        const auto bytes = hand_written(
            {0x9e, finger << 4 | 5, 0x49 + finger, 0x12, 0x34, 0x56, 0x1f, 0x27, 0x0b, 0xa6, kChecks[finger]});
        const DriveLaw law{.holds = true,
                           .spring_N_per_m = 466.0,
                           .damping_Ns_per_m = 4.3,
                           .friction_N = 1.55,
                           .start_m = 0.09995,
                           .most_N = 8.3};
        const GloveCommand command{.number = static_cast<std::uint8_t>(0x49 + finger),
                                   .law = GloveCommand::Law{static_cast<std::uint8_t>(finger), law}};
        EXPECT_EQ(written(frame_of(command)), bytes) << finger;
        expect_same(only_one_heard(bytes).command, command);
        expect_same(only_one_in<GloveCommand>(bytes), command);
    }
}

TEST(GloveWire, TheControllersEarFindsFramesBehindRubbishAndTakesNoDamagedOne) {
    const auto stop = hand_written({0x9e, 0x04, 0x48, 0x00, 0x00, 0x00, 0x00, 0x0a});
    for (std::size_t bit = 0; bit < 8 * stop.size(); ++bit) {
        auto line = hand_written({0x9e, 0x9d, 0x9e, 0x45});
        line.insert(line.end(), stop.begin(), stop.end());
        auto damaged = stop;
        damaged[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        line.insert(line.end(), damaged.begin(), damaged.end());
        line.insert(line.end(), 12, std::byte{0});
        EXPECT_EQ(only_one_heard(line).bytes, stop) << bit;
    }
}

TEST(GloveLinks, SendNothingButStopsOnceTheProgramIsSilentAndForcesAgainWhenItSpeaks) {
    BareGlove glove;
    const auto link = linked(glove);
    ASSERT_TRUE(link);
    std::uint8_t last_number = 1;  // of the first stop
    // Twice: what was sent the first time must not count the second.
    for (int time = 0; time < 2; ++time) {
        GloveLaws laws{};
        for (std::size_t i = 0; i < kGloveFingers; ++i) laws[i] = law_of(i);
        link->command(kForces_N, laws);
        const Nanoseconds spoke_ns = glove.clock().now_ns();
        std::array<bool, kGloveFingers> was_sent{};
        int stops = 0;
        for (int turn = 0; turn < 25; ++turn) {
            const auto frames = glove.next_turn();
            const GloveCommand& end = frames.back().command;
            const bool is_silent = glove.clock().now_ns() - spoke_ns > GloveLink::kSilent_ns;
            EXPECT_EQ(end.stop, is_silent) << turn;
            EXPECT_EQ(frames.size(), is_silent ? 1u : 2u) << "a law, but none with a stop";
            stops += end.stop ? 1 : 0;
            for (std::size_t i = 0; i < kGloveFingers && !is_silent; ++i)
                EXPECT_NEAR(end.forces_N[i], kForces_N[i], 1e-9) << i;
            if (frames.front().command.law) was_sent[frames.front().command.law->finger] = true;
            for (std::size_t i = 0; i < kGloveFingers && !is_silent; ++i)
                EXPECT_EQ((end.local >> i & 1) != 0, was_sent[i]) << i << ": local when its law has been sent";
            for (const HeardGloveFrame& frame : frames)
                EXPECT_EQ(frame.command.number, last_number = static_cast<std::uint8_t>(last_number + 1)) << turn;
        }
        EXPECT_EQ(stops, 25 - static_cast<int>(GloveLink::kSilent_ns / GloveLink::kSend_ns));
    }
}

TEST(GloveLinks, SendAStopAsTheirLastFrameWhateverWasBefore) {
    for (const bool commands : {false, true})
        for (const bool with_laws : {false, true})
            for (const bool falls_silent : {false, true}) {
                BareGlove glove;
                auto link = linked(glove);
                ASSERT_TRUE(link);
                GloveLaws laws{};
                for (std::size_t i = 0; i < kGloveFingers && with_laws; ++i) laws[i] = law_of(i);
                if (commands) link->command(kForces_N, laws);
                EXPECT_EQ(glove.next_turn().back().command.stop, !commands);
                if (falls_silent) {
                    glove.clock().move_on(2 * GloveLink::kSilent_ns);
                    EXPECT_TRUE(glove.heard_turn().back().command.stop);
                }
                link.reset();
                const auto left = glove.left();
                ASSERT_FALSE(left.empty()) << commands << with_laws << falls_silent;
                EXPECT_TRUE(left.back().command.stop) << commands << with_laws << falls_silent;
            }
}

TEST(GloveWire, NoPistonIsToldToGiveMoreThanItMayOrToPull) {
    constexpr double kMost_N = 10.0;
    EXPECT_EQ(kMostPistonForce_N, kMost_N);
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    OpenedGlove opened;
    BareGlove& glove = opened.glove();
    const auto gets = [&](const GloveForces& asked_N, const GloveForces& given_N) {
        opened.tick(asked_N);
        const GloveCommand told = glove.next_turn().back().command;
        EXPECT_FALSE(told.stop);
        for (std::size_t i = 0; i < kGloveFingers; ++i) EXPECT_NEAR(told.forces_N[i], given_N[i], 1e-9) << i;
        glove.say(healthy_set(2));
    };
    gets(kForces_N, kForces_N);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger) {
        for (const auto& [asked_N, given_N] : {std::pair{50.0, kMost_N}, {10.4, kMost_N}, {-3.0, 0.0}, {kNone, 0.0}}) {
            GloveForces all_N = kForces_N, kept_N = kForces_N;
            all_N[finger] = asked_N;
            kept_N[finger] = given_N;
            gets(all_N, kept_N);
        }
    }
}

TEST(GloveWire, EachFingerIsToldItsOwnLawWithNoMoreThanItsPistonMayGive) {
    OpenedGlove opened;
    BareGlove& glove = opened.glove();
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger) {
        // It alone has a law; then all have.
        for (const bool all : {false, true}) {
            for (std::size_t i = 0; i < kGloveFingers; ++i)
                opened.offer(i, all || i == finger ? law_of(i) : DriveLaw{});
            for (int turn = 0; turn < 4; ++turn) {
                opened.tick(kForces_N);
                const auto frames = glove.next_turn();
                ASSERT_EQ(frames.size(), 2u);
                ASSERT_TRUE(frames.front().command.law);
                const auto& [told, law] = *frames.front().command.law;
                EXPECT_TRUE(all || told == finger) << int{told};
                EXPECT_TRUE(all || frames.back().command.local == 1u << finger) << finger;
                expect_same(law, law_of(told));
                glove.say(healthy_set(2));
            }
        }
        DriveLaw strong = law_of(finger);
        strong.most_N = 12.5;  // which the frame could carry
        for (std::size_t i = 0; i < kGloveFingers; ++i) opened.offer(i, i == finger ? strong : DriveLaw{});
        opened.tick(kForces_N);
        const auto frames = glove.next_turn();
        ASSERT_TRUE(frames.front().command.law);
        EXPECT_NEAR(frames.front().command.law->law.most_N, 10.0, 1e-9) << finger;
        for (std::size_t i = 0; i < kGloveFingers; ++i) opened.offer(i, {});
        opened.tick(kForces_N);
        const auto without = glove.next_turn();
        EXPECT_EQ(without.size(), 1u) << "no law holds";
        EXPECT_EQ(without.back().command.local, 0u);
    }
}

TEST(GloveWire, EachFingersAnglesAndMeasuredForceAreItsOwn) {
    OpenedGlove opened;
    const GloveSet set = healthy_set(1);
    const auto samples = opened.read();
    ASSERT_EQ(samples.size(), kGloveFingers);
    const Pose palm = uneven_pose(0);
    for (std::size_t finger = 0; finger < kGloveFingers; ++finger) {
        EXPECT_EQ(samples[finger].fault, DeviceFault::none) << finger;
        EXPECT_NEAR(samples[finger].drive.measured_N, (*set.forces_N)[finger], 1e-9) << finger;
        for (std::size_t joint = 0; joint < kFingerJoints; ++joint)
            EXPECT_NEAR(samples[finger].joints[joint], set.joints[finger][joint], 0.0006) << finger << " " << joint;
        const FingertipPlace place = place_of(usual_hand()[finger], set.joints[finger]);
        EXPECT_LT(glm::distance(samples[finger].position_device_m, palm * place.hand_from_tip.position_m), 2e-4);
        EXPECT_LT(glm::distance(samples[finger].drive.along_device, palm.orientation * place.piston_hand), 2e-2);
    }
}

// Sets come eight ticks apart. Each tick sees an eighth of the way between two, and none of them a jump.
TEST(GloveWire, ATickSeesAMotionAndNoJumpsFromSetToSet) {
    OpenedGlove opened;
    BareGlove& glove = opened.glove();
    constexpr int kTicks = 8;
    constexpr double kTurns_rad = 0.02;
    GloveSet set = healthy_set(1);
    std::array<Vec3, kGloveFingers> last_m{};
    for (int number = 2; number < 14; ++number) {
        set.number = static_cast<std::uint8_t>(number);
        for (FingerAngles& finger : set.joints) finger[1] += kTurns_rad;
        (*set.forces_N)[0] = 0.05 * number;
        glove.say(set);
        // The set has come when its force is there; nobody's clock moves meanwhile.
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (std::abs(opened.read()[0].drive.measured_N - 0.05 * number) > 1e-9) {
            ASSERT_LT(std::chrono::steady_clock::now(), until) << "the set has not come for half a minute";
            std::this_thread::yield();
        }
        for (int tick = 0; tick < kTicks; ++tick) {
            glove.clock().move_on(GloveLink::kSend_ns / kTicks);
            const auto samples = opened.read();
            for (std::size_t i = 0; i < kGloveFingers; ++i) {
                EXPECT_EQ(samples[i].fault, DeviceFault::none);
                const double step_m = glm::distance(samples[i].position_device_m, last_m[i]);
                last_m[i] = samples[i].position_device_m;
                if (number < 5) continue;  // from the third set on the way before each is known
                // The tip's arm about the first joint is 4 to 12 cm; angles come in steps of 0.0012 rad.
                EXPECT_GT(step_m, 0.04 * 0.8 * kTurns_rad / kTicks) << i << " " << number << " " << tick;
                EXPECT_LT(step_m, 0.12 * 1.2 * kTurns_rad / kTicks) << i << " " << number << " " << tick;
            }
        }
    }
}

TEST(GloveWire, AFingerWhoseAnglesCannotBeHasAFaultOfItsOwnAndAFaultOfTheControllerIsOfAll) {
    for (std::size_t own = 0; own < kGloveFingers; ++own) {
        OpenedGlove opened;
        GloveSet set = healthy_set(1);
        const FingerAngles sound = set.joints[own];
        // A jump beyond its bounds: once is an error of the line, and left out; twice is what the finger reads.
        set.joints[own][1] = angle_bounds(own).highest[1] + 0.1;
        opened.glove().clock().move_on(GloveLink::kSend_ns);
        opened.glove().say(set);
        const auto beyond = opened.after(set, 2.0);
        set.joints[own] = sound;
        opened.glove().clock().move_on(GloveLink::kSend_ns);
        opened.glove().say(set);
        const auto back = opened.after(set, 2.5);
        std::vector<DeviceSample> well;
        for (int i = 0; i < 4; ++i) well = opened.after(set, 3.0 + 0.05 * i);
        set.fault = true;
        const auto broken = opened.after(set, 3.5);
        for (std::size_t i = 0; i < kGloveFingers; ++i) {
            EXPECT_EQ(beyond[i].fault, i == own ? DeviceFault::false_reading : DeviceFault::none) << own << " " << i;
            EXPECT_FALSE(beyond[i].fault_is_of_all);
            EXPECT_EQ(back[i].fault != DeviceFault::none, i == own) << own << " " << i;
            EXPECT_EQ(well[i].fault, DeviceFault::none) << own << " " << i;
            EXPECT_EQ(broken[i].fault, DeviceFault::other) << own << " " << i;
            EXPECT_TRUE(broken[i].fault_is_of_all);
        }
    }
}

TEST(GloveWire, AGloveThatIsLostIsToldNoForceAndNoLawInAnyTurn) {
    OpenedGlove opened;
    BareGlove& glove = opened.glove();
    for (std::size_t i = 0; i < kGloveFingers; ++i) opened.offer(i, law_of(i));
    opened.tick(kForces_N);
    EXPECT_NEAR(glove.next_turn().back().command.forces_N[2], kForces_N[2], 1e-9);
    for (const DeviceSample& sample : opened.read()) {
        EXPECT_EQ(sample.drive.state & (kDriveOn | kDriveMeasured), kDriveOn | kDriveMeasured);
        EXPECT_GT(sample.drive.measured_N, 0.0);
    }
    glove.clock().move_on(kGloveLost_ns);
    for (int turn = 0; turn < 30; ++turn) {
        for (const DeviceSample& sample : opened.read()) {
            EXPECT_EQ(sample.fault, DeviceFault::disconnected) << turn;
            EXPECT_EQ(sample.drive.state & (kDriveOn | kDriveMeasured | kDriveLocal), 0u) << "nobody knows: " << turn;
            EXPECT_EQ(sample.drive.measured_N, 0.0) << "what was measured last is no force of now: " << turn;
        }
        opened.tick(kForces_N);
        const auto frames = turn == 0 ? glove.heard_turn() : glove.next_turn();
        if (turn == 0) continue;  // it may have been under way before this tick
        EXPECT_EQ(frames.size(), 1u) << "no law: " << turn;
        EXPECT_EQ(frames.back().command.forces_N, GloveForces{}) << turn;
        EXPECT_EQ(frames.back().command.local, 0u) << turn;
    }
    opened.close();
    const auto left = glove.left();
    ASSERT_FALSE(left.empty());
    EXPECT_TRUE(left.back().command.stop);
}

}  // namespace burin::devices
