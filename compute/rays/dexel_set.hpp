// SPDX-License-Identifier: MIT
// The rays of one axis of a solid and their interval ends, with no limit on the number of ends a ray.
//
// A ray is identified by its row v and its position u in the row. kPageRays neighbouring rays of a row share a page:
// one block of memory that holds the ends of all of them, ray after ray without gaps, behind a table of where each
// ray's ends begin. A page whose rays are all empty is not allocated. So a ray costs 4 bytes, each end costs 8, and
// there is little other overhead. A ray that gains ends shifts the rest of its page, a few hundred bytes; a full page
// is moved to a larger block. No end is ever dropped for lack of space.
// Threads: several threads may read and write pages as long as each page is used by only one of them. All other members
// are for one thread.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin::compute {

class DexelSet {
public:
    static constexpr int kPageRays = 64;

    DexelSet() = default;
    DexelSet(int rays_u, int rays_v);
    DexelSet(const DexelSet& other);
    DexelSet& operator=(const DexelSet& other);
    DexelSet(DexelSet&&) noexcept = default;
    DexelSet& operator=(DexelSet&&) noexcept = default;

    [[nodiscard]] int rays_u() const { return rays_u_; }
    [[nodiscard]] int rays_v() const { return rays_v_; }
    [[nodiscard]] std::size_t ray_count() const {
        return static_cast<std::size_t>(rays_u_) * static_cast<std::size_t>(rays_v_);
    }

    [[nodiscard]] std::span<const shared::DexelEnd> ends(int u, int v) const {
        const Page* page = pages_[page_index(u, v)].get();
        if (page == nullptr) return {};
        const auto ray = static_cast<std::size_t>(u % kPageRays);
        return {page->ends() + page->first[ray], page->first[ray + 1] - page->first[ray]};
    }
    // Returns the ends of the ray with index u + v * rays_u().
    [[nodiscard]] std::span<const shared::DexelEnd> ends(std::size_t ray) const {
        const auto width = static_cast<std::size_t>(rays_u_);
        return ends(static_cast<int>(ray % width), static_cast<int>(ray / width));
    }
    // The rays (u, v), (u + 1, v) ... up to the end of their page or row, for iterating along a row. Valid until the
    // page changes.
    struct Run {
        const std::uint32_t* first;  // ray i has ends[first[i] .. first[i + 1])
        const shared::DexelEnd* ends;
        int rays;
        [[nodiscard]] std::span<const shared::DexelEnd> ends_of(int i) const {
            return {ends + first[i], ends + first[i + 1]};
        }
    };
    [[nodiscard]] Run run(int u, int v) const {
        static constexpr std::array<std::uint32_t, kPageRays + 1> kNoEnds{};
        const Page* page = pages_[page_index(u, v)].get();
        const int in_page = u % kPageRays, left = rays_u_ - u;
        const int rays = left < kPageRays - in_page ? left : kPageRays - in_page;
        if (page == nullptr) return {kNoEnds.data(), nullptr, rays};
        return {page->first.data() + in_page, page->ends(), rays};
    }
    // Returns a ray's ends for writing. Only their values can change, not their number.
    [[nodiscard]] std::span<shared::DexelEnd> ends_to_change(int u, int v) {
        const auto held = ends(u, v);
        return {const_cast<shared::DexelEnd*>(held.data()), held.size()};
    }

    // Replaces `removed` ends of a ray, starting at index `from`, by `inserted`.
    void splice(int u, int v, std::uint32_t from, std::uint32_t removed, std::span<const shared::DexelEnd> inserted);
    // Replaces all ends of a ray.
    void replace(int u, int v, std::span<const shared::DexelEnd> ends) {
        splice(u, v, 0, static_cast<std::uint32_t>(this->ends(u, v).size()), ends);
    }
    void replace(std::size_t ray, std::span<const shared::DexelEnd> ends) {
        const auto width = static_cast<std::size_t>(rays_u_);
        replace(static_cast<int>(ray % width), static_cast<int>(ray / width), ends);
    }
    // Replaces the ends of all rays. Ray r gets the next counts[r] elements of `ends`.
    void assign(std::span<const std::uint32_t> counts, std::span<const shared::DexelEnd> ends);

    // Returns whether any ray of the page that holds (u, v) has ends. False means that all of them are empty.
    [[nodiscard]] bool page_held(int u, int v) const { return pages_[page_index(u, v)] != nullptr; }
    [[nodiscard]] std::size_t end_count() const;
    // Returns the memory in use, including page tables and an estimate of the allocator's overhead for each block.
    [[nodiscard]] std::size_t bytes() const;
    // Returns whether every ray has the same intervals, normals and materials as in `other`.
    [[nodiscard]] bool same_content(const DexelSet& other) const;

private:
    struct Page {
        std::uint32_t capacity = 0;  // in ends
        // Index of each ray's first end; the last entry is the number of ends in the page.
        std::array<std::uint32_t, kPageRays + 1> first{};
        [[nodiscard]] shared::DexelEnd* ends() { return reinterpret_cast<shared::DexelEnd*>(this + 1); }
        [[nodiscard]] const shared::DexelEnd* ends() const {
            return reinterpret_cast<const shared::DexelEnd*>(this + 1);
        }
    };
    static_assert(sizeof(Page) % alignof(shared::DexelEnd) == 0);
    struct FreePage {
        void operator()(Page* page) const { ::operator delete(page); }
    };
    using PageOwner = std::unique_ptr<Page, FreePage>;

    [[nodiscard]] static PageOwner make_page(std::uint32_t at_least);
    [[nodiscard]] static PageOwner copy_page(const Page& page, std::uint32_t at_least);
    [[nodiscard]] std::size_t page_index(int u, int v) const {
        return static_cast<std::size_t>(v) * pages_a_row_ + static_cast<std::size_t>(u / kPageRays);
    }

    int rays_u_ = 0, rays_v_ = 0;
    std::size_t pages_a_row_ = 0;
    std::vector<PageOwner> pages_;
};

}  // namespace burin::compute
