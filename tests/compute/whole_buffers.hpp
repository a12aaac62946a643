// SPDX-License-Identifier: MIT
// Creates and reads whole buffers of a device, waiting for it.
#pragma once

#include <cstring>
#include <utility>
#include <vector>

#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"

namespace burin::compute::test {

template <typename T>
Result<std::vector<T>> read_buffer(gpu::Device& device, const gpu::Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    if (count == 0) return values;
    if (!buffer.mapped().empty()) {
        std::memcpy(values.data(), buffer.mapped().data(), count * sizeof(T));
        return values;
    }
    const auto bytes = gpu::read(device, buffer, 0, count * sizeof(T));
    if (!bytes) return std::unexpected(bytes.error());
    std::memcpy(values.data(), bytes->data(), bytes->size());
    return values;
}

inline Result<void> create_into(gpu::Buffer& to, gpu::Device& device, gpu::BufferUse use, std::uint64_t size_bytes,
                                const char* name) {
    auto made = gpu::Buffer::create(device, use, size_bytes, name);
    if (!made) return std::unexpected(made.error());
    to = std::move(*made);
    return {};
}

}  // namespace burin::compute::test
