// SPDX-License-Identifier: MIT
#include "gpu/commands.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "tests/gpu/add_shader.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::gpu {

using CommandsGpu = DeviceTest;

TEST_F(CommandsGpu, ADispatchComputesWhatTheShaderSays) {
    constexpr std::uint32_t kCount = 1000;
    auto add = make_add(device(), 5);
    ASSERT_TRUE(add) << add.error().line();
    const Buffer in = make(device(), BufferUse::device_storage, kCount);
    const Buffer out = make(device(), BufferUse::device_storage, kCount);
    std::vector<std::uint32_t> values(kCount);
    std::iota(values.begin(), values.end(), 0u);
    ASSERT_TRUE(write(device(), in, 0, std::as_bytes(std::span(values))));

    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->dispatch(*add, {in, out}, bytes_of(AddPush{kCount, 3}), groups_for(kCount));
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission) << submission.error().line();
    ASSERT_TRUE(submission->wait());

    const auto result = read(device(), out, 0, kCount * 4);
    ASSERT_TRUE(result);
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(words_of(*result)[i], i * 3 + 5) << "at " << i;
}

// 300 dispatches with changing buffers need more descriptor sets than one pool holds; each needs the result of the
// last.
TEST_F(CommandsGpu, AChainOfDispatchesWithBarriersRunsInOrder) {
    constexpr std::uint32_t kCount = 64;
    auto add = make_add(device(), 1);
    ASSERT_TRUE(add);
    const Buffer a = make(device(), BufferUse::device_storage, kCount);
    const Buffer b = make(device(), BufferUse::device_storage, kCount);
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->fill(a, 0, kCount * 4, 10);
    for (int i = 0; i < 150; ++i) {
        commands->barrier();
        commands->dispatch(*add, {a, b}, bytes_of(AddPush{kCount, 1}), groups_for(kCount));
        commands->barrier();
        commands->dispatch(*add, {b, a}, bytes_of(AddPush{kCount, 1}), groups_for(kCount));
    }
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    const auto result = read(device(), a, 0, kCount * 4);
    ASSERT_TRUE(result);
    EXPECT_EQ(words_of(*result), std::vector<std::uint32_t>(kCount, 310));
}

TEST_F(CommandsGpu, ARangeOfABufferIsWhatTheShaderSees) {
    const auto step =
        static_cast<std::uint32_t>(std::max<std::uint64_t>(device().capabilities().storage_offset_alignment, 256));
    auto add = make_add(device(), 0);
    ASSERT_TRUE(add);
    const Buffer in = make(device(), BufferUse::device_storage, step / 2);
    const Buffer out = make(device(), BufferUse::device_storage, 16);
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->fill(in, 0, step, 1);
    commands->fill(in, step, step, 2);
    commands->barrier();
    commands->dispatch(*add, {BufferRange(in, step, 64), out}, bytes_of(AddPush{16, 1}), {1, 1, 1});
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    const auto result = read(device(), out, 0, 64);
    ASSERT_TRUE(result);
    EXPECT_EQ(words_of(*result), std::vector<std::uint32_t>(16, 2));
}

TEST_F(CommandsGpu, AnIndirectDispatchTakesItsSizeFromTheBuffer) {
    auto add = make_add(device(), 9);
    ASSERT_TRUE(add);
    const Buffer in = make(device(), BufferUse::device_storage, 256);
    const Buffer out = make(device(), BufferUse::device_storage, 256);
    const Buffer arguments = make(device(), BufferUse::device_storage, 3);
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->fill(in, 0, 1024, 0);
    commands->fill(out, 0, 1024, 0);
    commands->upload(arguments, 0, bytes_of(std::array<std::uint32_t, 3>{2, 1, 1}));  // 2 groups of the 4 needed
    commands->barrier();
    const std::array<BufferRange, 2> buffers{in, out};
    commands->dispatch_indirect(*add, buffers, bytes_of(AddPush{256, 1}), arguments, 0);
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    const auto result = read(device(), out, 0, 1024);
    ASSERT_TRUE(result);
    std::vector<std::uint32_t> expected(256, 0);
    std::fill_n(expected.begin(), 128, 9u);
    EXPECT_EQ(words_of(*result), expected);
}

TEST_F(CommandsGpu, WhatTheGpuWroteIsSeenInMappedMemoryAfterWaiting) {
    const Buffer readback = make(device(), BufferUse::readback, 1024);
    const Buffer storage = make(device(), BufferUse::device_storage, 1024);
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    commands->fill(storage, 0, 4096, 0xabcdef01u);
    commands->barrier();
    commands->copy(storage, 0, readback, 0, 4096);
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    EXPECT_TRUE(submission->done());
    for (std::uint32_t word : readback.mapped_as<std::uint32_t>()) ASSERT_EQ(word, 0xabcdef01u);
}

TEST_F(CommandsGpu, BuffersMayBeDroppedWhileTheGpuStillUsesThem) {
    auto add = make_add(device(), 1);
    ASSERT_TRUE(add);
    const Buffer kept = make(device(), BufferUse::device_storage, 1 << 20);
    std::optional<Submission> last;
    for (int i = 0; i < 8; ++i) {
        const Buffer dropped = make(device(), BufferUse::device_storage, 1 << 20);
        auto commands = Commands::begin(device());
        ASSERT_TRUE(commands);
        commands->fill(dropped, 0, 4 << 20, static_cast<std::uint32_t>(i));
        commands->barrier();
        commands->dispatch(*add, {dropped, kept}, bytes_of(AddPush{1 << 20, 1}), groups_for(1 << 20));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission);
        last = std::move(*submission);
    }
    ASSERT_TRUE(last->wait());
    const auto result = read(device(), kept, 0, 4);
    ASSERT_TRUE(result);
    EXPECT_EQ(words_of(*result)[0], 8u);
}

TEST_F(CommandsGpu, ForgottenCommandsLeaveTheDeviceUsable) {
    const Buffer buffer = make(device(), BufferUse::device_storage, 16);
    {
        auto forgotten = Commands::begin(device());
        ASSERT_TRUE(forgotten);
        forgotten->fill(buffer, 0, 64, 1);
    }
    ASSERT_TRUE(write(device(), buffer, 0, bytes_of(std::array<std::uint32_t, 16>{})));
    const auto result = read(device(), buffer, 0, 64);
    ASSERT_TRUE(result);
    EXPECT_EQ(words_of(*result)[0], 0u);
}

TEST_F(CommandsGpu, LargeUploadsArriveWhole) {
    constexpr std::uint32_t kWords = 3u << 18;  // 3 MiB: more than a staging chunk
    const Buffer buffer = make(device(), BufferUse::device_storage, kWords);
    std::vector<std::uint32_t> values(kWords);
    for (std::uint32_t i = 0; i < kWords; ++i) values[i] = i * 2654435761u;
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    const auto bytes = std::as_bytes(std::span(values));
    for (std::size_t at = 0; at < bytes.size();) {  // in uneven pieces
        const std::size_t piece = std::min<std::size_t>(bytes.size() - at, 4 * (1 + at % 300007));
        commands->upload(buffer, at, bytes.subspan(at, piece));
        at += piece;
    }
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    const auto result = read(device(), buffer, 0, kWords * 4);
    ASSERT_TRUE(result);
    EXPECT_EQ(words_of(*result), values);
}

TEST_F(CommandsGpu, StampsMeasureTimeThatPasses) {
    if (!device().capabilities().timestamps) GTEST_SKIP() << "this device has no timestamps";
    const Buffer buffer = make(device(), BufferUse::device_storage, 1 << 20);
    auto commands = Commands::begin(device());
    ASSERT_TRUE(commands);
    const Stamp before = commands->stamp();
    commands->fill(buffer, 0, 4 << 20, 1);
    const Stamp after = commands->stamp();
    auto submission = std::move(*commands).submit();
    ASSERT_TRUE(submission);
    ASSERT_TRUE(submission->wait());
    const auto seconds = submission->seconds_between(before, after);
    ASSERT_TRUE(seconds);
    EXPECT_GT(*seconds, 0.0);
}

TEST_F(CommandsGpu, RefusesWhatIsNotSpirv) {
    const std::array<std::uint32_t, 8> rubbish{1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_FALSE(ComputePipeline::create(
        device(),
        {.spirv = rubbish, .storage_buffers = 1, .push_constant_bytes = 0, .constants = {}, .name = "rubbish"}));
}

// A frame that brings over as much as the one before asks the driver for no memory: a card's takes 0.1 ms and more.
TEST_F(CommandsGpu, UploadsUseTheirStagingMemoryAgainAsSoonAsTheDeviceHasReadIt) {
    constexpr std::uint32_t kWords = 300'000;  // more than one chunk of staging
    const Buffer to = make(device(), BufferUse::device_storage, kWords);
    std::vector<std::uint32_t> values(kWords);
    std::uint64_t after_first = 0;
    for (std::uint32_t frame = 0; frame < 20; ++frame) {
        std::iota(values.begin(), values.end(), 1000 * frame);
        auto commands = Commands::begin(device());
        ASSERT_TRUE(commands);
        constexpr std::uint32_t kPiece = 7001;
        for (std::uint32_t first = 0; first < kWords; first += kPiece)
            commands->upload(to, std::uint64_t{4} * first,
                             std::as_bytes(std::span(values).subspan(first, std::min(kPiece, kWords - first))));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission);
        ASSERT_TRUE(submission->wait());
        if (frame == 0) after_first = device().core()->allocations;
    }
    EXPECT_EQ(device().core()->allocations, after_first);
    const auto bytes = read(device(), to, 0, to.size_bytes());
    ASSERT_TRUE(bytes);
    EXPECT_EQ(words_of(*bytes), values);
}

// What the device has not read yet is not written over.
TEST_F(CommandsGpu, UploadsOfWorkThatIsUnderWayKeepTheirStagingMemory) {
    constexpr std::uint32_t kWords = 50'000, kFrames = 8;
    std::vector<Buffer> to;
    std::vector<Submission> under_way;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        to.push_back(make(device(), BufferUse::device_storage, kWords));
        auto commands = Commands::begin(device());
        ASSERT_TRUE(commands);
        const std::vector<std::uint32_t> values(kWords, frame + 1);
        commands->upload(to.back(), 0, std::as_bytes(std::span(values)));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission);
        under_way.push_back(std::move(*submission));
    }
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        const auto bytes = read(device(), to[frame], 0, to[frame].size_bytes());
        ASSERT_TRUE(bytes);
        EXPECT_EQ(words_of(*bytes), std::vector<std::uint32_t>(kWords, frame + 1));
    }
}

}  // namespace burin::gpu
