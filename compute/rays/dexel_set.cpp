// SPDX-License-Identifier: MIT
#include "compute/rays/dexel_set.hpp"

#include <algorithm>
#include <cstring>
#include <new>

#include "base/error.hpp"

namespace burin::compute {

using shared::DexelEnd;

namespace {

// Capacities are multiples of kGrowth ends. The step is small because a page holds 128 ends and more, and a solid has a
// page for every 64 rays.
constexpr std::uint32_t kGrowth = 8;
constexpr std::size_t kAllocatorBytes = 16;  // estimated heap overhead of a block, including rounding

}  // namespace

DexelSet::DexelSet(int rays_u, int rays_v)
    : rays_u_(rays_u), rays_v_(rays_v), pages_a_row_(static_cast<std::size_t>((rays_u + kPageRays - 1) / kPageRays)) {
    pages_.resize(pages_a_row_ * static_cast<std::size_t>(rays_v));
}

DexelSet::DexelSet(const DexelSet& other) { *this = other; }

DexelSet& DexelSet::operator=(const DexelSet& other) {
    if (this == &other) return *this;
    rays_u_ = other.rays_u_;
    rays_v_ = other.rays_v_;
    pages_a_row_ = other.pages_a_row_;
    pages_.clear();
    pages_.resize(other.pages_.size());
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        if (other.pages_[i]) pages_[i] = copy_page(*other.pages_[i], other.pages_[i]->first.back());
    }
    return *this;
}

DexelSet::PageOwner DexelSet::make_page(std::uint32_t at_least) {
    const std::uint32_t capacity = (at_least + kGrowth - 1) / kGrowth * kGrowth;
    void* memory = ::operator new(sizeof(Page) + capacity * sizeof(DexelEnd));
    PageOwner page(new (memory) Page);
    page->capacity = capacity;
    return page;
}

DexelSet::PageOwner DexelSet::copy_page(const Page& page, std::uint32_t at_least) {
    PageOwner copy = make_page(at_least);
    copy->first = page.first;
    std::copy_n(page.ends(), page.first.back(), copy->ends());
    return copy;
}

void DexelSet::splice(int u, int v, std::uint32_t from, std::uint32_t removed, std::span<const DexelEnd> inserted) {
    PageOwner& owner = pages_[page_index(u, v)];
    const auto added = static_cast<std::uint32_t>(inserted.size());
    if (!owner) {
        if (added == 0) return;
        owner = make_page(added);
    }
    const auto ray = static_cast<std::size_t>(u % kPageRays);
    if (removed == 1 && added == 1) {  // one end is replaced: the most frequent case in a stroke
        owner->ends()[owner->first[ray] + from] = inserted.front();
        return;
    }
    const std::uint32_t count = owner->first.back();
    const std::uint32_t new_count = count + added - removed;
    if (new_count > owner->capacity) {
        // Rays that grow usually grow again, so a large page gets an eighth of its size in addition.
        owner = copy_page(*owner, new_count + (new_count > 256 ? new_count / 8 : 0));
    }
    DexelEnd* at = owner->ends() + owner->first[ray] + from;
    if (added != removed) {
        std::memmove(at + added, at + removed,
                     static_cast<std::size_t>(owner->ends() + count - (at + removed)) * sizeof(DexelEnd));
        for (std::size_t r = ray + 1; r < owner->first.size(); ++r) owner->first[r] += added - removed;
    }
    std::copy(inserted.begin(), inserted.end(), at);
    if (new_count == 0) owner.reset();
}

void DexelSet::assign(std::span<const std::uint32_t> counts, std::span<const DexelEnd> ends) {
    BURIN_CHECK(counts.size() == ray_count());
    const std::uint32_t* count = counts.data();
    const DexelEnd* end = ends.data();
    for (int v = 0; v < rays_v_; ++v) {
        for (int u = 0; u < rays_u_; u += kPageRays) {
            const int rays = std::min(kPageRays, rays_u_ - u);
            std::array<std::uint32_t, kPageRays + 1> first{};
            for (std::size_t r = 0; r < kPageRays; ++r) {
                first[r + 1] = first[r] + (static_cast<int>(r) < rays ? *count++ : 0);
            }
            PageOwner& page = pages_[page_index(u, v)];
            page.reset();
            if (first.back() == 0) continue;
            page = make_page(first.back());
            page->first = first;
            std::copy_n(end, first.back(), page->ends());
            end += first.back();
        }
    }
}

std::size_t DexelSet::end_count() const {
    std::size_t count = 0;
    for (const PageOwner& page : pages_) count += page ? page->first.back() : 0;
    return count;
}

std::size_t DexelSet::bytes() const {
    std::size_t bytes = pages_.size() * sizeof(PageOwner);
    for (const PageOwner& page : pages_) {
        if (page) bytes += sizeof(Page) + page->capacity * sizeof(DexelEnd) + kAllocatorBytes;
    }
    return bytes;
}

bool DexelSet::same_content(const DexelSet& other) const {
    if (rays_u_ != other.rays_u_ || rays_v_ != other.rays_v_) return false;
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        const Page* a = pages_[i].get();
        const Page* b = other.pages_[i].get();
        if ((a == nullptr) != (b == nullptr)) return false;
        if (a != nullptr &&
            (a->first != b->first || std::memcmp(a->ends(), b->ends(), a->first.back() * sizeof(DexelEnd)) != 0)) {
            return false;
        }
    }
    return true;
}

}  // namespace burin::compute
