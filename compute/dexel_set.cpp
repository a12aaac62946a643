// SPDX-License-Identifier: MIT
#include "compute/dexel_set.hpp"

#include <algorithm>
#include <bit>

#include "base/error.hpp"

namespace burin {

using shared::DexelEnd;
using shared::RayRef;

std::uint32_t DexelSet::count_room(std::uint32_t count) {
    const std::uint32_t log2_room = count <= 1 ? 0 : static_cast<std::uint32_t>(std::bit_width(count - 1));
    return count | (log2_room << 24);
}

void DexelSet::assign(std::span<const std::uint32_t> counts, std::span<const DexelEnd> ends) {
    BURIN_CHECK(counts.size() == rays_.size());
    std::size_t room = 0;
    for (const std::uint32_t count : counts) {
        if (count > 0) room += shared::room_of({0, count_room(count)});
    }
    ends_.assign(room + room / 8, DexelEnd{});
    std::size_t place = 0, from = 0;
    for (std::size_t r = 0; r < rays_.size(); ++r) {
        const std::uint32_t count = counts[r];
        if (count == 0) {
            rays_[r] = {0, kNoRoom};
            continue;
        }
        rays_[r] = {static_cast<std::uint32_t>(place), count_room(count)};
        std::copy_n(ends.begin() + static_cast<std::ptrdiff_t>(from), count,
                    ends_.begin() + static_cast<std::ptrdiff_t>(place));
        from += count;
        place += shared::room_of(rays_[r]);
    }
    used_.store(place, std::memory_order_relaxed);
}

std::uint32_t DexelSet::claim(std::uint32_t room) noexcept {
    // relaxed: the addition alone makes the place ours; the worker pool's join publishes what is written there.
    const std::size_t place = used_.fetch_add(room, std::memory_order_relaxed);
    return place + room <= ends_.size() ? static_cast<std::uint32_t>(place) : kNoPlace;
}

void DexelSet::make_space(std::size_t spare) {
    std::size_t room = 0;
    for (const RayRef& ray : rays_) {
        if (shared::count_of(ray) > 0) room += shared::room_of({0, count_room(shared::count_of(ray))});
    }
    std::vector<DexelEnd> packed(room + std::max(spare, room / 8));
    std::size_t place = 0;
    for (RayRef& ray : rays_) {
        const std::uint32_t count = shared::count_of(ray);
        if (count == 0) {
            ray = {0, kNoRoom};
            continue;
        }
        std::copy_n(ends_.begin() + ray.first, count, packed.begin() + static_cast<std::ptrdiff_t>(place));
        ray = {static_cast<std::uint32_t>(place), count_room(count)};
        place += shared::room_of(ray);
    }
    ends_ = std::move(packed);
    used_.store(place, std::memory_order_relaxed);
}

void DexelSet::replace(std::size_t r, std::span<const DexelEnd> ends) {
    const auto count = static_cast<std::uint32_t>(ends.size());
    RayRef& ray = rays_[r];
    const bool has_place = shared::count_of(ray) > 0;
    if (count == 0) {
        ray = {0, kNoRoom};
        return;
    }
    if (!has_place || count > shared::room_of(ray)) {
        const std::uint32_t wanted = count_room(count);
        const std::uint32_t room = shared::room_of({0, wanted});
        std::uint32_t place = claim(room);
        if (place == kNoPlace) {
            ray = {0, kNoRoom};  // its old ends go
            make_space(room);
            place = claim(room);
        }
        ray = {place, wanted};
    }
    std::copy(ends.begin(), ends.end(), ends_.begin() + ray.first);
    ray.count_room = (ray.count_room & 0xff000000u) | count;
}

bool DexelSet::same_content(const DexelSet& other) const {
    if (ray_count() != other.ray_count()) return false;
    for (std::size_t r = 0; r < ray_count(); ++r) {
        const auto a = ends(r), b = other.ends(r);
        if (!std::ranges::equal(a, b, [](const DexelEnd& x, const DexelEnd& y) {
                return x.depth_material == y.depth_material && x.normal == y.normal;
            })) {
            return false;
        }
    }
    return true;
}

}  // namespace burin
