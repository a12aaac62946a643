// SPDX-License-Identifier: MIT
// The device memory of the Vulkan engine: the solid as the device holds it, and buffers that it shares with the host.
// Thread and failure: as gpu::Device and gpu::Buffer.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compute/rays/solid.hpp"
#include "gpu/commands.hpp"

namespace burin::compute {

// A buffer that shaders use and that the host writes, reads, or both. The host accesses device memory directly where it
// is mapped; otherwise there is a copy in host memory, which send and fetch transfer.
class SharedBuffer {
public:
    // in_place: shaders write into the host's memory, so that only what is written crosses over.
    enum class Traffic { to_device, from_device, both, none, in_place };
    SharedBuffer(std::string name, Traffic traffic) : name_(std::move(name)), traffic_(traffic) {}

    // Enlarges the buffer to at least size_bytes. When it has to grow, its contents are lost.
    [[nodiscard]] Result<void> reserve(gpu::Device& device, std::uint64_t size_bytes);
    [[nodiscard]] const gpu::Buffer& buffer() const { return device_side_; }
    [[nodiscard]] std::uint64_t size_bytes() const { return device_side_.size_bytes(); }

    // Host view of the buffer. to_device is to be written before the commands of send are submitted, from_device read
    // after those of fetch are done.
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

// Copies values to the front of what the host writes of a buffer.
template <typename T>
void copy_to(const SharedBuffer& buffer, std::span<const T> values) {
    std::ranges::copy(values, buffer.to_device<T>().begin());
}

// All rays of the three axes in one table (x, then y, then z) and all their ends in one store, so that one dispatch and
// one counter serve all. The table takes 96 MiB at the finest resolution. The larger store is accessed by its address,
// so the limit of a binding does not apply: it may be as large as what the device allocates at once, which is at least
// 1 GiB everywhere. Each ray has space for a power of two of ends; one that needs more is moved to the end of the
// store.
class DeviceSolid {
public:
    struct Spare {
        // Numbers of free ends: required, and wanted where the device's largest buffer allows it.
        std::size_t least, wished;
    };
    // Packs the solid into new buffers, with spare ends behind those of the last ray. Fails when the device cannot
    // allocate at least spare.least of them at once; the former buffers are then kept.
    [[nodiscard]] Result<void> upload(gpu::Device& device, const Solid& solid, Spare spare);
    // Makes space behind the first `used` ends. They move on the device alone, with the gaps that rays have left which
    // were moved to larger ranges: these are less than what the rays hold now, as each range is twice the one before.
    // Where the device cannot allocate that, fetches the solid, packs it without gaps and sends it back; no other work
    // may be in progress.
    [[nodiscard]] Result<void> make_space(gpu::Device& device, std::uint32_t used, Spare spare);

    [[nodiscard]] const gpu::Buffer& rays() const { return rays_; }
    [[nodiscard]] const gpu::Buffer& store() const { return store_; }
    [[nodiscard]] std::uint32_t store_size() const { return store_size_; }    // ends
    [[nodiscard]] std::uint32_t packed_size() const { return packed_size_; }  // ends in use after that
    [[nodiscard]] std::uint32_t longest_ray() const { return longest_; }      // most ends of a ray after packing
    [[nodiscard]] const std::array<std::uint32_t, 3>& first_ray() const { return first_ray_; }
    [[nodiscard]] std::uint64_t bytes() const { return rays_.size_bytes() + store_.size_bytes(); }

private:
    [[nodiscard]] static std::size_t most_ends(const gpu::Device& device);
    [[nodiscard]] Result<void> repack(gpu::Device& device, Spare spare);
    template <typename EndsOf>
    [[nodiscard]] Result<void> pack(gpu::Device& device, std::size_t ray_count, EndsOf&& ends_of, Spare spare);

    gpu::Buffer rays_, store_;
    std::uint32_t store_size_ = 0, packed_size_ = 0, longest_ = 0;
    std::array<std::uint32_t, 3> first_ray_{};
    int resolution_ = 0;  // cells along the solid's longest side, for error messages
};

}  // namespace burin::compute
