// SPDX-License-Identifier: MIT
// A compute shader for tests of commands, and the buffers that it works on: out = in * factor + offset, word by word.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "add_comp.hpp"
#include "gpu/commands.hpp"

namespace burin::gpu {

struct AddPush {
    std::uint32_t count = 0;
    std::uint32_t factor = 0;
};

// Of each source that includes it, as the shader's words are.
[[maybe_unused]] static Result<ComputePipeline> make_add(Device& device, std::uint32_t offset) {
    const std::array constants{offset};
    return ComputePipeline::create(device, {.spirv = k_add_comp,
                                            .storage_buffers = 2,
                                            .push_constant_bytes = sizeof(AddPush),
                                            .constants = constants,
                                            .name = "add"});
}

inline Buffer make(Device& device, BufferUse use, std::uint64_t words) {
    auto buffer = Buffer::create(device, use, words * 4, "test");
    EXPECT_TRUE(buffer) << buffer.error().line();
    return buffer ? std::move(*buffer) : Buffer{};
}

inline std::vector<std::uint32_t> words_of(const std::vector<std::byte>& bytes) {
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
}

inline Groups groups_for(std::uint32_t count) { return {(count + 63) / 64, 1, 1}; }

}  // namespace burin::gpu
