// SPDX-License-Identifier: MIT
// The frames of a glove's line: written, read back, and found again behind whatever else was on the line.
#include "devices/gloves/glove_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace burin::devices {
namespace {

constexpr double kAngleStep_rad = kAngleRange_rad / 4095;

GloveSet set_with(std::uint8_t number, double angle_rad, bool with_forces) {
    GloveSet set{.number = number, .motors_on = true, .fault = false, .joints = {}, .forces_N = {}};
    for (std::size_t i = 0; i < kGloveFingers; ++i)
        for (std::size_t k = 0; k < kFingerJoints; ++k)
            set.joints[i][k] = angle_rad + 0.1 * static_cast<double>(i) - 0.05 * static_cast<double>(k);
    if (with_forces) set.forces_N = GloveForces{0.0, 1.0, 5.55, 10.0};
    return set;
}

std::vector<std::byte> bytes_of(const GloveBytes& frame) { return {frame.view().begin(), frame.view().end()}; }

template <typename Frame>
std::vector<Frame> read_all(GloveFrameReader<Frame>& reader, const std::vector<std::byte>& bytes) {
    std::vector<Frame> frames;
    for (const std::byte byte : bytes)
        if (const auto frame = reader.take(byte)) frames.push_back(*frame);
    return frames;
}

void append(std::vector<std::byte>& to, const std::vector<std::byte>& more) {
    to.insert(to.end(), more.begin(), more.end());
}

}  // namespace

TEST(GloveFrames, G2ALawReadsBackWithinHalfAStep) {
    const DriveLaw law{.holds = true,
                       .spring_N_per_m = 456.78,
                       .damping_Ns_per_m = 1.23,
                       .friction_N = 0.41,
                       .start_m = 0.098765,
                       .most_N = 9.9};
    GloveFrameReader<GloveCommand> reader;
    std::vector<std::byte> line = bytes_of(frame_of(GloveCommand{.number = 7, .law = GloveCommand::Law{3, law}}));
    EXPECT_EQ(line.size(), kLawBytes);
    append(line, bytes_of(frame_of(GloveCommand{.number = 8, .forces_N = {1, 2, 3, 4}, .local = 0b1010})));
    const auto read = read_all(reader, line);
    ASSERT_EQ(read.size(), 2u);
    ASSERT_TRUE(read[0].law);
    EXPECT_EQ(read[0].law->finger, 3);
    EXPECT_TRUE(read[0].law->law.holds);
    EXPECT_NEAR(read[0].law->law.spring_N_per_m, 456.78, 0.5001 * kSpringStep_N_per_m);
    EXPECT_NEAR(read[0].law->law.damping_Ns_per_m, 1.23, 0.5001 * kDampingStep_Ns_per_m);
    EXPECT_NEAR(read[0].law->law.friction_N, 0.41, 0.5001 * kForceStep_N);
    EXPECT_NEAR(read[0].law->law.start_m, 0.098765, 0.5001 * kStartStep_m);
    EXPECT_NEAR(read[0].law->law.most_N, 9.9, 0.5001 * kForceStep_N);
    EXPECT_EQ(read[1].local, 0b1010);
    EXPECT_FALSE(read[1].law);
    EXPECT_EQ(read[1].forces_N, (GloveForces{1, 2, 3, 4}));
    EXPECT_EQ(reader.counts().missed, 0u);
}

TEST(GloveFrames, G1HaveTheSizesOfThePapersAndReadBackWithinHalfAStep) {
    for (const bool with_forces : {false, true}) {
        const GloveSet set = set_with(200, 0.4, with_forces);
        const GloveBytes frame = frame_of(set);
        EXPECT_EQ(frame.count, with_forces ? 32u : 28u);
        GloveFrameReader<GloveSet> reader;
        const auto read = read_all(reader, bytes_of(frame));
        ASSERT_EQ(read.size(), 1u);
        EXPECT_EQ(read[0].number, 200);
        EXPECT_TRUE(read[0].motors_on);
        EXPECT_EQ(read[0].forces_N.has_value(), with_forces);
        for (std::size_t i = 0; i < kGloveFingers; ++i) {
            for (std::size_t k = 0; k < kFingerJoints; ++k)
                EXPECT_NEAR(read[0].joints[i][k], set.joints[i][k], 0.5001 * kAngleStep_rad);
            if (!with_forces) continue;
            EXPECT_NEAR((*read[0].forces_N)[i], (*set.forces_N)[i], 0.5001 * kForceStep_N);
        }
        EXPECT_EQ(frame_of(read[0]).bytes, frame.bytes) << "what was read is written as it was";
    }
}

TEST(GloveFrames, HoldWhatIsBeyondThemAtTheirEndsAndNoNumbersAtTheirLeast) {
    GloveSet set = set_with(0, 0.0, true);
    set.joints[0] = {-5.0, 9.0, std::nan(""), INFINITY};
    set.forces_N = GloveForces{-3.0, 99.0, std::nan(""), INFINITY};
    GloveFrameReader<GloveSet> reader;
    const GloveSet read = read_all(reader, bytes_of(frame_of(set))).at(0);
    EXPECT_DOUBLE_EQ(read.joints[0][0], kLeastAngle_rad);
    EXPECT_NEAR(read.joints[0][1], kLeastAngle_rad + kAngleRange_rad, 1e-12);
    EXPECT_DOUBLE_EQ((*read.forces_N)[0], 0.0);
    EXPECT_DOUBLE_EQ((*read.forces_N)[1], kMostFrameForce_N);
    EXPECT_DOUBLE_EQ((*read.forces_N)[2], 0.0);
}

TEST(GloveFrames, G1AreFoundBehindGarbageHalvesOthersAndOnesWithinOnes) {
    const auto good = [&](std::uint8_t number) { return bytes_of(frame_of(set_with(number, 0.3, number % 2 == 0))); };
    std::vector<std::byte> line{std::byte{0x9d}, std::byte{0x9d}, std::byte{0x01},
                                std::byte{0xff}};  // begins of frames
    append(line, good(1));
    auto half = good(2);
    half.resize(17);
    append(line, half);
    append(line, good(3));
    append(line, bytes_of(frame_of(GloveCommand{.number = 9, .stop = false, .forces_N = {1.0, 2.0, 3.0, 4.0}})));
    auto broken = good(4);  // a frame lies in this one's angles
    const auto inner = good(5);
    std::copy(inner.begin(), inner.begin() + 20, broken.begin() + 4);
    append(line, broken);
    append(line, good(6));
    append(line, good(7));
    append(line, good(8));
    GloveFrameReader<GloveSet> reader;
    std::vector<unsigned> numbers;
    for (const GloveSet& set : read_all(reader, line)) numbers.push_back(set.number);
    // What stands behind a half or a broken one may be eaten with it, and no more: in step again within two frames.
    EXPECT_EQ(numbers.front(), 1u);
    EXPECT_EQ(std::vector<unsigned>(numbers.end() - 2, numbers.end()), (std::vector<unsigned>{7, 8}));
    EXPECT_NE(std::find(numbers.begin(), numbers.end(), 3u), numbers.end());
    EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 5u), 0) << "its end is missing";
    EXPECT_GT(reader.counts().dropped_bytes, 0u);
    EXPECT_GT(reader.counts().missed, 0u);
}

TEST(GloveFrames, G1ABitThatFlipsIsNoticedWhereverItIs) {
    const auto frame = bytes_of(frame_of(set_with(77, 0.9, true)));
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
        auto flipped = frame;
        flipped[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
        append(flipped, std::vector<std::byte>(40));
        GloveFrameReader<GloveSet> reader;
        EXPECT_TRUE(read_all(reader, flipped).empty()) << bit;
    }
}

TEST(GloveFrames, NoTwoBitsThatFlipPassTheChecksOfVersion2) {
    for (const bool with_forces : {false, true}) {
        GloveSet set = set_with(77, 0.9, with_forces);
        set.version = 2;
        const auto frame = bytes_of(frame_of(set));
        EXPECT_EQ(frame.size(), with_forces ? 33u : 29u);
        for (std::size_t a = 0; a < 8 * frame.size(); ++a)
            for (std::size_t b = a + 1; b < 8 * frame.size(); ++b) {
                auto flipped = frame;
                for (const std::size_t bit : {a, b}) flipped[bit / 8] ^= static_cast<std::byte>(1u << bit % 8);
                append(flipped, std::vector<std::byte>(40));
                GloveFrameReader<GloveSet> reader;
                ASSERT_TRUE(read_all(reader, flipped).empty()) << a << " " << b;
            }
    }
}

// A line may carry either; what stands within a damaged frame of version 2 is none of version 1.
TEST(GloveFrames, OfBothVersionsAreReadAndNoneWithinADamagedOne) {
    const auto good = [](std::uint8_t number, std::uint8_t version) {
        GloveSet set = set_with(number, 0.3, true);
        set.version = version;
        return bytes_of(frame_of(set));
    };
    GloveFrameReader<GloveSet> reader;
    std::vector<std::byte> line = good(1, 1);
    append(line, good(2, 2));
    const auto read = read_all(reader, line);
    ASSERT_EQ(read.size(), 2u);
    EXPECT_EQ(read[0].version, 1);
    EXPECT_EQ(read[1].version, 2);
    EXPECT_EQ(read[1].joints, read[0].joints);
    EXPECT_EQ(read[1].forces_N, read[0].forces_N);
    // The end of a damaged frame, whose beginning the noise has eaten, has a whole frame of version 1 in it.
    EXPECT_TRUE(read_all(reader, good(3, 1)).empty()) << "right behind one of version 2";
    EXPECT_EQ(read_all(reader, good(4, 2)).size(), 1u);
    // Whoever plugs in another glove is heard after a moment.
    std::vector<GloveSet> other;
    for (std::uint8_t number = 5; number < 12; ++number)
        for (const GloveSet& set : read_all(reader, good(number, 1))) other.push_back(set);
    ASSERT_FALSE(other.empty());
    EXPECT_EQ(other.back().number, 11);
}

TEST(GloveFrames, G1ReadersTakeAnyBytesAndComeIntoStepAgain) {
    std::mt19937 random(11);
    GloveFrameReader<GloveSet> sets;
    GloveFrameReader<GloveCommand> commands;
    for (int round = 0; round < 400; ++round) {
        std::vector<std::byte> noise(random() % 200);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random() % 4 == 0 ? 0x9d + random() % 2 : random());
        static_cast<void>(read_all(sets, noise));
        static_cast<void>(read_all(commands, noise));
        std::vector<std::byte> line;
        for (std::uint8_t i = 0; i < 3; ++i) append(line, bytes_of(frame_of(set_with(i, 0.2, true))));
        const auto read = read_all(sets, line);
        ASSERT_FALSE(read.empty()) << round;
        EXPECT_EQ(read.back().number, 2) << round;
        std::vector<std::byte> orders;
        for (std::uint8_t i = 0; i < 3; ++i)
            append(orders, bytes_of(frame_of(GloveCommand{.number = i, .stop = true})));
        const auto heard = read_all(commands, orders);
        ASSERT_FALSE(heard.empty()) << round;
        EXPECT_TRUE(heard.back().stop);
    }
}

}  // namespace burin::devices
