// SPDX-License-Identifier: MIT
#include "compute/vulkan/vulkan_engine_memory.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/try.hpp"
#include "gpu/core.hpp"

namespace burin::compute {
namespace {

using shared::DexelEnd;
using shared::RayRef;

Result<void> send_all(gpu::Device& device, const gpu::Buffer& buffer, std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    if (buffer.mapped().empty()) return gpu::write(device, buffer, 0, bytes);
    std::memcpy(buffer.mapped().data(), bytes.data(), bytes.size());
    return {};
}

template <typename T>
Result<std::vector<T>> fetch_all(gpu::Device& device, const gpu::Buffer& buffer) {
    std::vector<T> values(buffer.size_bytes() / sizeof(T));
    if (buffer.mapped().empty()) {
        BURIN_TRY(bytes, gpu::read(device, buffer, 0, values.size() * sizeof(T)));
        std::memcpy(values.data(), bytes.data(), bytes.size());
    } else {
        std::memcpy(values.data(), buffer.mapped().data(), values.size() * sizeof(T));
    }
    return values;
}

// Returns a RayRef's count_room for `count` ends: the number in the low bits, log2 of the space reserved in the high
// ones.
std::uint32_t count_room(std::uint32_t count) {
    const std::uint32_t log2_room = count <= 1 ? 0 : static_cast<std::uint32_t>(std::bit_width(count - 1));
    return count | (log2_room << 24);
}

// Returns the error for a store that is too large for the device. Names the resolution that would fit: the number of
// ends grows about with its square.
std::unexpected<Error> too_large(const gpu::Device& device, std::size_t ends, int resolution) {
    const double limit = static_cast<double>(device.core()->max_allocation_bytes);
    const double needed = static_cast<double>(ends * sizeof(DexelEnd));
    const int fits = static_cast<int>(0.98 * static_cast<double>(resolution) * std::sqrt(limit / needed));
    return fail("Vulkan engine",
                "the solid's " + std::to_string(ends) +
                    " interval ends do not fit into what can be allocated at once on " + device.info().name + " (" +
                    std::to_string(static_cast<std::uint64_t>(limit) >> 20) + " MiB)",
                "use --engine cpu, or a resolution of about " + std::to_string(fits) + " or less");
}

}  // namespace

Result<void> SharedBuffer::reserve(gpu::Device& device, std::uint64_t size_bytes) {
    if (size_bytes <= device_side_.size_bytes()) return {};
    const std::uint64_t limit = device.capabilities().max_storage_buffer_bytes;
    const std::uint64_t grown = std::max(size_bytes, std::min(size_bytes + size_bytes / 2, limit));
    const auto use = traffic_ == Traffic::in_place ? gpu::BufferUse::host_storage : gpu::BufferUse::device_storage;
    BURIN_TRY(made, gpu::Buffer::create(device, use, grown, name_));
    gpu::Buffer upload, readback;
    if (made.mapped().empty()) {
        if (traffic_ == Traffic::to_device || traffic_ == Traffic::both) {
            BURIN_TRY(host, gpu::Buffer::create(device, gpu::BufferUse::upload, grown, name_));
            upload = std::move(host);
        }
        if (traffic_ == Traffic::from_device || traffic_ == Traffic::both) {
            BURIN_TRY(host, gpu::Buffer::create(device, gpu::BufferUse::readback, grown, name_));
            readback = std::move(host);
        }
    }
    device_side_ = std::move(made);
    upload_ = std::move(upload);
    readback_ = std::move(readback);
    return {};
}

void SharedBuffer::send(gpu::Commands& commands, std::uint64_t size_bytes) const {
    if (!mapped()) commands.copy(upload_, 0, device_side_, 0, size_bytes);
}

void SharedBuffer::fetch(gpu::Commands& commands, std::uint64_t size_bytes) const {
    if (!mapped()) commands.copy(device_side_, 0, readback_, 0, size_bytes);
}

Result<void> DeviceSolid::upload(gpu::Device& device, const Solid& solid, Spare spare) {
    const std::array<std::size_t, 3> counts{solid.sets[0].ray_count(), solid.sets[1].ray_count(),
                                            solid.sets[2].ray_count()};
    first_ray_ = {0, static_cast<std::uint32_t>(counts[0]), static_cast<std::uint32_t>(counts[0] + counts[1])};
    resolution_ = *std::ranges::max_element(solid.lattice.cells) - 2;  // without the empty cell on either side
    const auto ends_of = [&](std::size_t ray) {
        if (ray < first_ray_[1]) return solid.sets[0].ends(ray);
        return ray < first_ray_[2] ? solid.sets[1].ends(ray - first_ray_[1]) : solid.sets[2].ends(ray - first_ray_[2]);
    };
    return pack(device, counts[0] + counts[1] + counts[2], ends_of, spare);
}

// Returns the most ends of a store.
std::size_t DeviceSolid::most_ends(const gpu::Device& device) {
    return static_cast<std::size_t>(
        std::min<std::uint64_t>(device.core()->max_allocation_bytes / sizeof(DexelEnd), 1u << 30));
}

Result<void> DeviceSolid::make_space(gpu::Device& device, std::uint32_t used, Spare spare) {
    const std::size_t size = std::min(used + std::max(spare.least, spare.wished), most_ends(device));
    if (size < used + spare.least) return repack(device, spare);
    auto larger = gpu::Buffer::create(device, gpu::BufferUse::addressed, size * sizeof(DexelEnd), "interval ends");
    if (!larger) return repack(device, spare);
    BURIN_TRY(commands, gpu::Commands::begin(device));
    commands.copy(store_, 0, *larger, 0, std::uint64_t{used} * sizeof(DexelEnd));
    commands.keep_alive(std::exchange(store_, std::move(*larger)));
    BURIN_TRY_DO(std::move(commands).submit());
    store_size_ = static_cast<std::uint32_t>(size);
    packed_size_ = used;
    return {};
}

Result<void> DeviceSolid::repack(gpu::Device& device, Spare spare) {
    BURIN_TRY(rays, fetch_all<RayRef>(device, rays_));
    BURIN_TRY(store, fetch_all<DexelEnd>(device, store_));
    const auto ends_of = [&](std::size_t ray) {
        return std::span<const DexelEnd>(store).subspan(rays[ray].first, shared::count_of(rays[ray]));
    };
    return pack(device, rays.size(), ends_of, spare);
}

template <typename EndsOf>
Result<void> DeviceSolid::pack(gpu::Device& device, std::size_t ray_count, EndsOf&& ends_of, Spare spare) {
    std::size_t room = 0, longest = 0;
    for (std::size_t r = 0; r < ray_count; ++r) {
        const std::size_t count = ends_of(r).size();
        longest = std::max(longest, count);
        if (count > 0) room += shared::room_of({0, count_room(static_cast<std::uint32_t>(count))});
    }
    const std::size_t limit = most_ends(device);
    if (room + spare.least > limit) return too_large(device, room + spare.least, resolution_);
    const std::size_t size = std::max<std::size_t>(std::min(room + std::max(spare.least, spare.wished), limit), 1);

    std::vector<RayRef> rays;
    rays.reserve(ray_count);
    std::vector<DexelEnd> store(size);
    std::size_t place = 0;
    for (std::size_t r = 0; r < ray_count; ++r) {
        const std::span<const DexelEnd> ends = ends_of(r);
        RayRef to{0, 0};
        if (!ends.empty()) {
            to = {static_cast<std::uint32_t>(place), count_room(static_cast<std::uint32_t>(ends.size()))};
            std::ranges::copy(ends, store.begin() + static_cast<std::ptrdiff_t>(place));
            place += shared::room_of(to);
        }
        rays.push_back(to);
    }
    BURIN_TRY(new_rays,
              gpu::Buffer::create(device, gpu::BufferUse::device_storage, ray_count * sizeof(RayRef), "rays"));
    BURIN_TRY(new_store,
              gpu::Buffer::create(device, gpu::BufferUse::addressed, size * sizeof(DexelEnd), "interval ends"));
    BURIN_TRY_DO(send_all(device, new_rays, std::as_bytes(std::span(rays))));
    BURIN_TRY_DO(send_all(device, new_store, std::as_bytes(std::span(store))));
    rays_ = std::move(new_rays);
    store_ = std::move(new_store);
    store_size_ = static_cast<std::uint32_t>(size);
    packed_size_ = static_cast<std::uint32_t>(place);
    longest_ = static_cast<std::uint32_t>(longest);
    return {};
}

}  // namespace burin::compute
