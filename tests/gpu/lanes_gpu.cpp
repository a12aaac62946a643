// SPDX-License-Identifier: MIT
// Lanes of one device: two threads use it at once, each with objects, counts and memory of its own. The validation
// layer sees which thread calls what, and the thread sanitizer what they share.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <latch>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "gpu/core.hpp"
#include "tests/gpu/add_shader.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::gpu {
namespace {

class LanesGpu : public DeviceTest {
protected:
    // Opens another lane of the test's device.
    Device other() {
        auto lane = device().lane();
        EXPECT_TRUE(lane) << lane.error().line();
        return std::move(*lane);
    }
};

// Uploads one word everywhere, multiplies by three, adds one, and reads the words back, with new buffers each time.
// Returns how many of them are right.
std::size_t times_three_and_one(Device& lane, const ComputePipeline& add, std::uint32_t word, std::uint32_t count) {
    const Buffer in = make(lane, BufferUse::device_storage, count), out = make(lane, BufferUse::device_storage, count);
    const Buffer home = make(lane, BufferUse::readback, count);
    auto commands = Commands::begin(lane);
    if (!commands) return 0;
    const std::vector<std::uint32_t> words(count, word);
    commands->upload(in, 0, std::as_bytes(std::span(words)));
    commands->barrier();
    commands->dispatch(add, {in, out}, bytes_of(AddPush{count, 3}), groups_for(count));
    commands->barrier();
    commands->copy(out, 0, home, 0, out.size_bytes());
    auto submission = std::move(*commands).submit();
    if (!submission || !submission->wait()) return 0;
    return static_cast<std::size_t>(std::ranges::count(home.mapped_as<std::uint32_t>(), 3 * word + 1));
}

}  // namespace

TEST_F(LanesGpu, OfTwoThreadsSubmitAtOnceAndEachGetsItsOwn) {
    constexpr std::uint32_t kTurns = 60, kCount = 300;
    const std::uint64_t of_first = device().asked().submissions;
    std::latch begun(2);
    std::vector<std::size_t> right(2, 0);
    const auto work = [&](Device lane, std::size_t which) {
        const auto add = make_add(lane, 1);
        begun.arrive_and_wait();
        for (std::uint32_t turn = 0; add && turn < kTurns; ++turn)
            right[which] += times_three_and_one(lane, *add, static_cast<std::uint32_t>(1000 * which) + turn, kCount);
    };
    Device second = other();
    std::thread beside(work, second, std::size_t{1});
    work(device(), 0);
    beside.join();
    EXPECT_EQ(right, (std::vector<std::size_t>(2, std::size_t{kTurns} * kCount)));
    EXPECT_EQ(device().asked().submissions, of_first + kTurns);
    EXPECT_EQ(second.asked().submissions, kTurns);
    EXPECT_EQ(second.asked().blocking_waits, kTurns);
}

TEST_F(LanesGpu, AreOpenedAndEndedWhileAnotherWorks) {
    constexpr std::uint32_t kTurns = 30, kCount = 64;
    std::latch begun(2);
    std::thread beside([&, lane = other()]() mutable {
        begun.arrive_and_wait();
        for (std::uint32_t turn = 0; turn < kTurns; ++turn) {
            auto next = lane.lane();
            ASSERT_TRUE(next);
            lane = std::move(*next);  // the one before goes, with what it has under way
            const Buffer words = make(lane, BufferUse::device_storage, kCount);
            auto commands = Commands::begin(lane);
            ASSERT_TRUE(commands);
            commands->fill(words, 0, words.size_bytes(), turn);
            ASSERT_TRUE(std::move(*commands).submit());
        }
    });
    const auto add = make_add(device(), 1);
    begun.arrive_and_wait();
    std::size_t right = 0;
    for (std::uint32_t turn = 0; add && turn < kTurns; ++turn)
        right += times_three_and_one(device(), *add, turn, kCount);
    beside.join();
    EXPECT_EQ(right, std::size_t{kTurns} * kCount);
}

TEST_F(LanesGpu, CountWorkAndMemoryEachAndTheDeviceHasTheSum) {
    constexpr std::uint64_t kWords = 1 << 16;
    Device second = other();
    ASSERT_EQ(device().memory_bytes(), 0u);
    {
        const Buffer a = make(device(), BufferUse::device_storage, kWords);
        const Buffer b = make(second, BufferUse::device_storage, 3 * kWords);
        const std::uint64_t first_bytes = device().asked().most_memory_bytes;
        const std::uint64_t second_bytes = second.asked().most_memory_bytes;
        EXPECT_GE(first_bytes, 4 * kWords);
        EXPECT_LT(first_bytes, 8 * kWords);
        EXPECT_GE(second_bytes, 12 * kWords);
        EXPECT_LT(second_bytes, 16 * kWords);
        EXPECT_EQ(device().memory_bytes(), first_bytes + second_bytes);
        EXPECT_EQ(second.memory_bytes(), first_bytes + second_bytes);
        ASSERT_TRUE(write(second, b, 0, bytes_of(std::uint32_t{1})));
    }
    ASSERT_TRUE(second.wait_idle());
    EXPECT_EQ(device().asked().submissions, 0u);
    EXPECT_EQ(second.asked().submissions, 1u);
}

TEST_F(LanesGpu, GoOnFromEachOthersMoments) {
    constexpr std::uint32_t kCount = 256;
    Device second = other();
    const auto first_add = make_add(device(), 1), second_add = make_add(second, 1);
    ASSERT_TRUE(first_add && second_add);
    const Buffer a = make(device(), BufferUse::device_storage, kCount);
    const Buffer b = make(device(), BufferUse::device_storage, kCount);
    const Buffer c = make(second, BufferUse::device_storage, kCount);
    auto written = Commands::begin(device());
    ASSERT_TRUE(written);
    written->fill(a, 0, a.size_bytes(), 5);
    written->barrier();
    written->dispatch(*first_add, {a, b}, bytes_of(AddPush{kCount, 2}), groups_for(kCount));
    auto first = std::move(*written).submit();
    ASSERT_TRUE(first);
    std::vector<std::uint32_t> words;
    // The other thread is given a moment and the buffer, which waits where it is until that thread is done.
    std::thread beside([&, moment = first->moment()]() mutable {
        auto read_on = Commands::begin(second);
        ASSERT_TRUE(read_on);
        read_on->wait_for(std::move(moment));
        read_on->dispatch(*second_add, {b, c}, bytes_of(AddPush{kCount, 10}), groups_for(kCount));
        ASSERT_TRUE(std::move(*read_on).submit());
        const auto home = read(second, c, 0, c.size_bytes());
        ASSERT_TRUE(home);
        words = words_of(*home);
    });
    beside.join();
    EXPECT_EQ(words, std::vector<std::uint32_t>(kCount, 111));
}

TEST_F(LanesGpu, KeepATimelineThatAnotherWaitsForAfterItsLaneIsGone) {
    constexpr std::uint32_t kCount = 16;
    const Buffer words = make(device(), BufferUse::device_storage, kCount);
    std::optional<Moment> moment;
    {
        Device second = other();
        const Buffer own = make(second, BufferUse::device_storage, kCount);
        auto commands = Commands::begin(second);
        ASSERT_TRUE(commands);
        commands->fill(own, 0, own.size_bytes(), 1);
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission);
        moment = submission->moment();
    }
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->wait_for(*std::exchange(moment, std::nullopt));
    commands->fill(words, 0, words.size_bytes(), 7);
    ASSERT_TRUE(std::move(*commands).submit());
    const auto home = read(device(), words, 0, words.size_bytes());
    ASSERT_TRUE(home);
    EXPECT_EQ(words_of(*home), std::vector<std::uint32_t>(kCount, 7));
}

TEST_F(LanesGpu, AreAllLostWithTheDevice) {
    Device second = other();
    second.core()->lose_at_next_submit = true;
    EXPECT_FALSE(device().lost());
    auto lost = Commands::begin(second);
    ASSERT_TRUE(lost);
    EXPECT_FALSE(std::move(*lost).submit());
    EXPECT_TRUE(second.lost());
    EXPECT_TRUE(device().lost());
    auto refused = Commands::begin(device());
    ASSERT_TRUE(refused);
    EXPECT_FALSE(std::move(*refused).submit());
    EXPECT_FALSE(device().lane());
}

TEST_F(LanesGpu, LiveOnWithoutTheFirst) {
    auto first = Device::create({.validation = true});
    ASSERT_TRUE(first);
    auto second = first->lane();
    ASSERT_TRUE(second);
    first = std::unexpected(Error{});
    const auto add = make_add(*second, 1);
    ASSERT_TRUE(add);
    EXPECT_EQ(times_three_and_one(*second, *add, 4, 64), 64u);
}

}  // namespace burin::gpu
