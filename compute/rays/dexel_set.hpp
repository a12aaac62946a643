// SPDX-License-Identifier: MIT
// The rays of one axis and their ends, any number of them a ray.
//
// Rays lie in rows (v) of places (u). kPageRays neighbours of a row share a page: one block of memory with the ends of all of
// them, ray after ray without gaps, behind a table of where each ray's begin. A page whose rays are all empty is not there.
// So a ray costs 4 bytes and 8 an end, and little else; a ray that needs more moves the rest of its page up, a few hundred
// bytes, and a page that is full gets a larger block. Nothing is ever dropped for want of room.
// Threads: pages may be read and written from several threads as long as each page is touched by one. The rest is for one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shaders/shared/dexel.h"

namespace burin {

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
    // By index u + v * rays_u().
    [[nodiscard]] std::span<const shared::DexelEnd> ends(std::size_t ray) const {
        const auto width = static_cast<std::size_t>(rays_u_);
        return ends(static_cast<int>(ray % width), static_cast<int>(ray / width));
    }
    // The rays (u, v), (u + 1, v) ... as far as they lie in one page, for walking along a row.
    struct Run {
        const std::uint32_t* first;  // ray i has the ends first[i] .. first[i + 1]
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
    // To change ends without changing their number.
    [[nodiscard]] std::span<shared::DexelEnd> ends_to_change(int u, int v) {
        const auto held = ends(u, v);
        return {const_cast<shared::DexelEnd*>(held.data()), held.size()};
    }

    // Puts `inserted` in the place of `removed` ends of a ray from the given one on.
    void splice(int u, int v, std::uint32_t from, std::uint32_t removed, std::span<const shared::DexelEnd> inserted);
    // All of a ray's ends.
    void replace(int u, int v, std::span<const shared::DexelEnd> ends) {
        splice(u, v, 0, static_cast<std::uint32_t>(this->ends(u, v).size()), ends);
    }
    void replace(std::size_t ray, std::span<const shared::DexelEnd> ends) {
        const auto width = static_cast<std::size_t>(rays_u_);
        replace(static_cast<int>(ray % width), static_cast<int>(ray / width), ends);
    }
    // All rays: counts[r] ends each, taken from `ends` one ray after the other.
    void assign(std::span<const std::uint32_t> counts, std::span<const shared::DexelEnd> ends);

    // Whether any ray of u's page in row v has ends: false is a quick answer for all of them.
    [[nodiscard]] bool page_held(int u, int v) const { return pages_[page_index(u, v)] != nullptr; }
    [[nodiscard]] std::size_t end_count() const;
    // All bookkeeping included, and what the allocator adds to a block.
    [[nodiscard]] std::size_t bytes() const;
    // Same intervals, normals and materials on every ray.
    [[nodiscard]] bool same_content(const DexelSet& other) const;

private:
    struct Page {
        std::uint32_t capacity = 0;                        // ends
        std::array<std::uint32_t, kPageRays + 1> first{};  // of each ray; the last one: how many in all
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

}  // namespace burin
