// SPDX-License-Identifier: MIT
// A GPU buffer, created by its intended use. Each buffer is one memory allocation: create few and large ones (drivers
// allow about 4000 allocations in all).
//
// Ownership: move-only; freed when the GPU no longer uses it. Thread and lifetime: as Device.
// Contents are undefined after creation. Limits are checked before anything is allocated: a buffer beyond
// capabilities().max_storage_buffer_bytes (128 MiB on the software driver) is refused with an Error. That limit holds
// for buffers bound through descriptors only, not for `addressed` ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "gpu/core.hpp"

namespace burin::gpu {

enum class BufferUse {
    device_storage,  // read and written by shaders, also indirect arguments; mapped only with unified memory
    upload,          // written by the CPU through mapped(), copied from
    readback,        // copied to, read by the CPU through mapped()
    host_storage,    // written by shaders and read by the CPU through mapped(): only what is written crosses over
    addressed,       // like device_storage, but reached by address(): up to the size of an allocation
    vertex,          // vertices; also a storage buffer, so that a compute shader can write it
    index,           // indices; also a storage buffer
    uniform          // small, written by the CPU through mapped()
};

class Buffer {
public:
    Buffer() = default;  // empty: size_bytes() is 0
    // Creates a buffer. name appears in error messages. size_bytes must not be 0.
    [[nodiscard]] static Result<Buffer> create(Device& device, BufferUse use, std::uint64_t size_bytes,
                                               const std::string& name);

    [[nodiscard]] std::uint64_t size_bytes() const { return size_bytes_; }
    // Returns the buffer's memory as the CPU sees it, valid as long as the buffer lives; empty when the CPU cannot see
    // it. Coherent: no flush is needed. Must not be accessed between submit() and the end of a submission that uses the
    // buffer.
    [[nodiscard]] std::span<std::byte> mapped() const { return mapped_; }
    template <typename T>
    [[nodiscard]] std::span<T> mapped_as() const {
        return {reinterpret_cast<T*>(mapped_.data()), mapped_.size() / sizeof(T)};
    }
    // Returns the device address of an `addressed` buffer for shaders; 0 for all others.
    [[nodiscard]] std::uint64_t address() const { return address_; }
    [[nodiscard]] VkBuffer raw() const { return buffer_.raw(); }

    // Gives the buffer and its memory up to the caller, who destroys them: for what Core keeps, which no Buffer can be,
    // since it holds Core.
    [[nodiscard]] StagingChunk give_up() &&;

private:
    MemoryHandle memory_;  // declared before the buffer, hence destroyed after it
    BufferHandle buffer_;
    std::uint64_t size_bytes_ = 0, address_ = 0;
    std::span<std::byte> mapped_;
};

// A part of a buffer as a shader sees it. The offset is a multiple of capabilities().storage_offset_alignment.
struct BufferRange {
    const Buffer* buffer = nullptr;
    std::uint64_t offset_bytes = 0;
    std::uint64_t size_bytes = VK_WHOLE_SIZE;

    // Implicit, so that whole buffers can be listed by name.
    BufferRange(const Buffer& whole) : buffer(&whole) {}  // NOLINT(google-explicit-constructor)
    BufferRange(const Buffer& part, std::uint64_t offset, std::uint64_t size)
        : buffer(&part), offset_bytes(offset), size_bytes(size) {}
};

// Returns the bytes of a plain value, as upload, push constants and write take them.
template <typename T>
[[nodiscard]] std::span<const std::byte> bytes_of(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return std::as_bytes(std::span<const T, 1>(&value, 1));
}

}  // namespace burin::gpu
