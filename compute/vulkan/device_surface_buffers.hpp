// SPDX-License-Identifier: MIT
// Helpers shared by the parts of DeviceSurface (device_surface*.cpp): create, fill and read whole buffers, waiting for
// the device.
#pragma once

#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"

namespace burin::compute {

template <typename T>
Result<void> fill_buffer(gpu::Device& device, const gpu::Buffer& buffer, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    if (bytes.empty()) return {};
    if (buffer.mapped().empty()) return gpu::write(device, buffer, 0, bytes);
    std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());
    return {};
}

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

}  // namespace burin::compute
