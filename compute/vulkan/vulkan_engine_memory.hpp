// SPDX-License-Identifier: MIT
// The device memory of the Vulkan engine: the solid as the device holds it, and buffers that the host shares with it.
// Thread and failure: as gpu::Device and gpu::Buffer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compute/solid.hpp"
#include "gpu/commands.hpp"

namespace burin {

// A buffer that shaders use and the host writes, reads, or both. Where device memory is mapped the host works in it
// directly; elsewhere there is a copy of it on the host's side, carried over by send and fetch.
class SharedBuffer {
public:
    enum class Traffic { to_device, from_device, both, none };
    SharedBuffer(std::string name, Traffic traffic) : name_(std::move(name)), traffic_(traffic) {}

    // At least so large afterwards; when it has to grow, its contents are lost.
    [[nodiscard]] Result<void> reserve(gpu::Device& device, std::uint64_t size_bytes);
    [[nodiscard]] const gpu::Buffer& buffer() const { return device_side_; }
    [[nodiscard]] std::uint64_t size_bytes() const { return device_side_.size_bytes(); }

    // What the host sees. Written before send is submitted, read after fetch is done.
    template <typename T>
    [[nodiscard]] std::span<T> to_device() const {
        return (mapped() ? device_side_ : upload_).mapped_as<T>();
    }
    template <typename T>
    [[nodiscard]] std::span<const T> from_device() const {
        return (mapped() ? device_side_ : readback_).mapped_as<T>();
    }
    void send(gpu::Commands& commands, std::uint64_t size_bytes) const;
    void fetch(gpu::Commands& commands, std::uint64_t size_bytes) const;

private:
    [[nodiscard]] bool mapped() const { return !device_side_.mapped().empty(); }
    std::string name_;
    Traffic traffic_;
    gpu::Buffer device_side_, upload_, readback_;
};

// All rays of the three axes in one table (x, then y, then z) and all their ends in one store, so that one dispatch and one
// counter serve all. The table takes 96 MiB at the finest resolution. The store, larger, is reached by its address and may be
// as large as what the device allocates at once, at least 1 GiB everywhere, however little a binding may show. Each ray has room for a power of two of ends; one that needs more moves to the end of the store.
class DeviceSolid {
public:
    struct Spare {
        std::size_t least, wished;  // ends; as many as wished where the device's largest buffer allows it
    };
    // Packs the solid into new buffers, with spare ends behind the last ray's. Fails when the device cannot allocate the least
    // of them at once; what was held before then stays.
    [[nodiscard]] Result<void> upload(gpu::Device& device, const Solid& solid, Spare spare);
    // Fetches what the device holds, packs it without gaps and sends it back. Nothing else may be under way.
    [[nodiscard]] Result<void> make_space(gpu::Device& device, Spare spare);

    [[nodiscard]] const gpu::Buffer& rays() const { return rays_; }
    [[nodiscard]] const gpu::Buffer& store() const { return store_; }
    [[nodiscard]] std::uint32_t store_size() const { return store_size_; }    // ends
    [[nodiscard]] std::uint32_t packed_size() const { return packed_size_; }  // ends in use when it was packed
    [[nodiscard]] std::uint32_t longest_ray() const { return longest_; }      // most ends of a ray when it was packed
    [[nodiscard]] const std::array<std::uint32_t, 3>& first_ray() const { return first_ray_; }
    [[nodiscard]] std::uint64_t bytes() const { return rays_.size_bytes() + store_.size_bytes(); }

private:
    template <typename EndsOf>
    [[nodiscard]] Result<void> pack(gpu::Device& device, std::size_t ray_count, EndsOf&& ends_of, Spare spare);

    gpu::Buffer rays_, store_;
    std::uint32_t store_size_ = 0, packed_size_ = 0, longest_ = 0;
    std::array<std::uint32_t, 3> first_ray_{};
    int resolution_ = 0;  // cells along the solid's longest side, for messages
};

}  // namespace burin
