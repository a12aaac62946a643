// SPDX-License-Identifier: MIT
// The rays of one axis and their ends: a table of RayRef and one store of DexelEnd that all rays share.
//
// Each ray has room for a power of two of ends. A ray that needs more gets a new place at the end of the store and leaves
// a gap; when the store is full it is rebuilt without gaps and with spare space. Any number of ends is kept.
// Threads: rays may be read and written from several threads as long as each ray is touched by one; claim() is thread-safe;
// everything else is for one thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin {

class DexelSet {
public:
    DexelSet() = default;
    explicit DexelSet(std::size_t ray_count) : rays_(ray_count, shared::RayRef{0, kNoRoom}) {}
    DexelSet(const DexelSet& other) : rays_(other.rays_), ends_(other.ends_), used_(other.used_.load()) {}
    DexelSet& operator=(const DexelSet& other) {
        rays_ = other.rays_;
        ends_ = other.ends_;
        used_ = other.used_.load();
        return *this;
    }
    // Moved, not copied: a large solid changes hands without a second one beside it. `other` is then empty.
    DexelSet(DexelSet&& other) noexcept
        : rays_(std::move(other.rays_)), ends_(std::move(other.ends_)), used_(other.used_.exchange(0)) {}
    DexelSet& operator=(DexelSet&& other) noexcept {
        rays_ = std::move(other.rays_);
        ends_ = std::move(other.ends_);
        used_ = other.used_.exchange(0);
        return *this;
    }

    [[nodiscard]] std::size_t ray_count() const { return rays_.size(); }
    [[nodiscard]] std::span<const shared::DexelEnd> ends(std::size_t ray) const {
        return {ends_.data() + rays_[ray].first, shared::count_of(rays_[ray])};
    }

    // Replaces all rays: counts[r] ends each, taken from `ends` one ray after the other.
    void assign(std::span<const std::uint32_t> counts, std::span<const shared::DexelEnd> ends);
    // Replaces one ray's ends, finding or making room. One thread.
    void replace(std::size_t ray, std::span<const shared::DexelEnd> ends);

    // For the engines: raw access, and room for one more ray of `count` ends from the spare space; kNoPlace when it is used
    // up (then call make_space and try again).
    static constexpr std::uint32_t kNoPlace = 0xffffffff;
    [[nodiscard]] std::uint32_t claim(std::uint32_t room) noexcept;
    // Rebuilds the store without gaps, with at least `spare` free ends behind it.
    void make_space(std::size_t spare);
    [[nodiscard]] std::span<shared::RayRef> rays() { return rays_; }
    [[nodiscard]] std::span<const shared::RayRef> rays() const { return rays_; }
    [[nodiscard]] std::span<shared::DexelEnd> store() { return ends_; }
    [[nodiscard]] std::span<const shared::DexelEnd> store() const { return ends_; }
    [[nodiscard]] std::size_t used() const { return used_.load(std::memory_order_relaxed); }

    // All bookkeeping included.
    [[nodiscard]] std::size_t bytes() const {
        return rays_.size() * sizeof(shared::RayRef) + ends_.size() * sizeof(shared::DexelEnd);
    }
    // Same intervals, normals and materials on every ray, wherever they are stored.
    [[nodiscard]] bool same_content(const DexelSet& other) const;

    // log2 of the room for `count` ends, in a RayRef's high bits, with the count in the low ones.
    [[nodiscard]] static std::uint32_t count_room(std::uint32_t count);

private:
    static constexpr std::uint32_t kNoRoom = 0;  // log2 room 0 and count 0: an empty ray has no place of its own
    std::vector<shared::RayRef> rays_;
    std::vector<shared::DexelEnd> ends_;
    std::atomic<std::size_t> used_{0};
};

}  // namespace burin
