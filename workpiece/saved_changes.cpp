// SPDX-License-Identifier: MIT
#include "workpiece/saved_changes.hpp"

#include <algorithm>
#include <cstring>
#include <span>

#include "workpiece/saved_head.hpp"
#include "workpiece/saved_solid.hpp"

namespace burin::workpiece {
namespace {

using compute::DexelSet, compute::HistoryStep, compute::RayBatch;
using shared::DexelEnd;

constexpr const char *kRaysPage = "rays", *kStepPage = "step";

std::string rays_page(std::size_t index) {
    return index == 0 ? std::string(kRaysPage) : kRaysPage + (" " + std::to_string(index + 1));
}

std::size_t bytes_of(const RayBatch& batch) { return 8 * (batch.rays.size() + batch.ends.size()); }

// Returns some of a batch's rays as bytes.
std::vector<std::byte> bytes_of(const RayBatch& batch, std::span<const RayBatch::Ray> rays) {
    std::vector<std::uint32_t> words{static_cast<std::uint32_t>(rays.size())};
    for (const RayBatch::Ray& ray : rays) words.push_back(ray.code);
    for (const RayBatch::Ray& ray : rays) words.push_back(ray.count);
    for (const RayBatch::Ray& ray : rays)
        for (const DexelEnd& end : batch.ends_of(ray)) words.push_back(end.depth_material);
    for (const RayBatch::Ray& ray : rays)
        for (const DexelEnd& end : batch.ends_of(ray)) words.push_back(end.normal);
    const auto bytes = std::as_bytes(std::span(words));
    return {bytes.begin(), bytes.end()};
}

// Puts a batch's rays into as many pages of this number as they need.
void put_rays(const RayBatch& batch, std::int64_t number, std::map<scene::PageName, std::vector<std::byte>>& pages) {
    std::size_t from = 0, page = 0;
    do {
        std::size_t to = from, bytes = 0;
        for (; to < batch.rays.size() && bytes < kMostRayBytes; ++to)
            bytes += 8 + 8 * std::size_t{batch.rays[to].count};
        pages[{rays_page(page++), number}] = bytes_of(batch, std::span(batch.rays).subspan(from, to - from));
        from = to;
    } while (from < batch.rays.size());
}

// Reads the rays of a page; nothing where the bytes are none of this lattice.
std::optional<RayBatch> batch_in(std::span<const std::byte> bytes, const compute::Lattice& lattice,
                                 std::size_t materials) {
    if (bytes.empty() || bytes.size() % 4 != 0) return {};
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    const std::uint64_t rays = words[0];
    if (words.size() < 1 + 2 * rays) return {};
    const auto counts = std::span(words).subspan(1 + rays, rays);
    std::uint64_t all = 0;
    for (const std::uint32_t count : counts) all += count;
    if (words.size() != 1 + 2 * rays + 2 * all) return {};
    RayBatch batch;
    std::size_t at = 1 + 2 * rays;
    std::vector<DexelEnd> ends;
    for (std::size_t ray = 0; ray < rays; ++ray) {
        const compute::RayPlace place = compute::place_of(words[1 + ray]);
        if (place.axis < 0 || place.axis > 2 || place.u < 0 || place.v < 0 || place.u >= lattice.rays_u(place.axis) ||
            place.v >= lattice.rays_v(place.axis))
            return {};
        ends.clear();
        for (std::uint32_t end = 0; end < counts[ray]; ++end, ++at) ends.push_back({words[at], words[at + all]});
        const int most_depth = lattice.cells[static_cast<std::size_t>(place.axis)] * shared::kUnitsPerCell;
        if (!is_sound(ends, most_depth, materials)) return {};
        batch.add(words[1 + ray], ends);
    }
    return batch;
}

// Reads the rays of all pages, each numbered 0.
std::optional<RayBatch> batch_in(const scene::Pages& pages, const compute::Lattice& lattice, std::size_t materials) {
    std::optional<RayBatch> all;
    for (std::size_t page = 0;; ++page) {
        const std::vector<std::byte>* bytes = pages.find({rays_page(page), 0});
        if (bytes == nullptr) return all;
        std::optional<RayBatch> some = batch_in(*bytes, lattice, materials);
        if (!some) return {};
        if (!all) {
            all = std::move(some);
            continue;
        }
        for (const RayBatch::Ray& ray : some->rays) all->add(ray.code, some->ends_of(ray));
    }
}

bool is_lost_material(const geometry::Material& material) {
    return material.name == lost_material().name && material.colour == lost_material().colour;
}

void replace_material(compute::Solid& solid, std::uint32_t from, std::uint32_t to) {
    for (DexelSet& set : solid.sets) {
        for (int v = 0; v < set.rays_v(); ++v) {
            for (int u = 0; u < set.rays_u(); ++u) {
                const std::span<const DexelEnd> held = set.ends(u, v);
                const auto is_from = [&](const DexelEnd& end) { return shared::material_of(end) == from; };
                if (std::ranges::none_of(held, is_from)) continue;
                std::vector<DexelEnd> ends(held.begin(), held.end());
                for (DexelEnd& end : ends)
                    if (is_from(end)) end = {shared::make_end(shared::depth_of(end), to, 0).depth_material, end.normal};
                set.replace(u, v, ends);
            }
        }
    }
}

// Takes over the table of materials of a change, which goes on from the solid's. What was lost and made again is not
// known there: its material, the last, goes behind those of the change. Returns false, and changes nothing, where the
// table is none of this solid.
bool take_materials(compute::Solid& solid, std::vector<geometry::Material> materials) {
    std::vector<geometry::Material>& held = solid.materials;
    const bool knows_all = materials.size() >= held.size() && (held.empty() || !is_lost_material(held.back()) ||
                                                               is_lost_material(materials[held.size() - 1]));
    if (!knows_all) {
        if (held.empty() || !is_lost_material(held.back()) || materials.size() + 1 < held.size()) return false;
        const std::size_t last = held.size() - 1, place = std::min(materials.size(), kMostMaterials - 1);
        if (place == materials.size()) materials.push_back(lost_material());
        if (place != last) replace_material(solid, static_cast<std::uint32_t>(last), static_cast<std::uint32_t>(place));
    }
    held = std::move(materials);
    return true;
}

// Returns what these rays hold now.
RayBatch held_by(const compute::Solid& solid, std::span<const RayBatch::Ray> rays) {
    RayBatch held;
    for (const RayBatch::Ray& ray : rays) {
        const compute::RayPlace place = compute::place_of(ray.code);
        held.add(ray.code, solid.sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v));
    }
    return held;
}

// A change of a program that said nothing of steps is one of its own.
std::optional<HistoryStep> step_of(const scene::Pages& change) {
    const std::vector<std::byte>* bytes = change.find({kStepPage, 0});
    if (bytes == nullptr) return HistoryStep::stroke;
    std::uint32_t step = 0;
    if (bytes->size() != sizeof step) return {};
    std::memcpy(&step, bytes->data(), sizeof step);
    if (step > static_cast<std::uint32_t>(HistoryStep::redo)) return {};
    return static_cast<HistoryStep>(step);
}

}  // namespace

// ---- Changes

ChangedRays::ChangedRays(const compute::Lattice& lattice) : lattice_(lattice) {
    for (int axis = 0; axis < 3; ++axis) changed_[static_cast<std::size_t>(axis)].assign(lattice.rays(axis), false);
}

void ChangedRays::note(const compute::Changes& changes) {
    for (const shared::ChangedRay& ray : changes.rays) {
        const compute::RayPlace place = compute::place_of(ray.ray);
        auto changed = changed_[static_cast<std::size_t>(place.axis)][place.index(lattice_)];
        if (!changed) codes_.push_back(ray.ray);
        changed = true;
        open_ = true;
    }
}

void ChangedRays::take(const compute::Solid& solid, HistoryStep step, scene::Pages& pages) {
    RayBatch now;
    for (const std::uint32_t code : codes_) {
        const compute::RayPlace place = compute::place_of(code);
        const auto axis = static_cast<std::size_t>(place.axis);
        now.add(code, solid.sets[axis].ends(place.u, place.v));
        changed_[axis][place.index(lattice_)] = false;
    }
    codes_.clear();
    if (step != HistoryStep::goes_on) open_ = false;
    pages.part = kSolidPart;
    pages.pages[{kHead, 0}] = head_bytes(solid, kPageSide);
    put_rays(now, 0, pages.pages);
    const auto word = static_cast<std::uint32_t>(step);
    const auto bytes = std::as_bytes(std::span(&word, 1));
    pages.pages[{kStepPage, 0}] = {bytes.begin(), bytes.end()};
}

Result<void> apply_change(compute::Solid& solid, const scene::Pages& change, const std::string& where,
                          compute::History* history) {
    const auto damaged = [&] { return fail(where, "a change is damaged", "what came before it is there"); };
    const std::vector<std::byte>* bytes = change.find({kHead, 0});
    std::optional<SavedHead> head = bytes != nullptr ? head_in(*bytes) : std::nullopt;
    const std::optional<HistoryStep> step = step_of(change);
    if (!head || !step || head->lattice != solid.lattice) return damaged();
    const std::optional<RayBatch> batch = batch_in(change, solid.lattice, head->materials.size());
    if (!batch || !take_materials(solid, std::move(head->materials))) return damaged();
    if (history != nullptr) history->take_held(held_by(solid, batch->rays));
    for (const RayBatch::Ray& ray : batch->rays) {
        const compute::RayPlace place = compute::place_of(ray.code);
        solid.sets[static_cast<std::size_t>(place.axis)].replace(place.u, place.v, batch->ends_of(ray));
    }
    if (history != nullptr) history->take_step(*step);
    return {};
}

// ---- Steps

void save_steps(compute::History& history, scene::Pages& pages) {
    if (pages.whole) history.note_all_unsaved();
    pages.steps = {.first = history.first(), .done = history.done(), .last = history.last()};
    for (const std::int64_t number : history.take_unsaved())
        put_rays(history.stroke(number), number, pages.steps->pages);
}

void copy_steps(const compute::History& history, std::size_t most_bytes, scene::Pages& pages) {
    scene::Steps steps{.first = history.done() + 1, .done = history.done(), .last = history.done()};
    std::size_t bytes = 0;
    const auto put = [&](std::int64_t number) {
        bytes += bytes_of(history.stroke(number));
        if (bytes > most_bytes) return false;
        put_rays(history.stroke(number), number, steps.pages);
        return true;
    };
    while (steps.first > history.first() && put(steps.first - 1)) --steps.first;
    while (steps.last < history.last() && put(steps.last + 1)) ++steps.last;
    pages.steps = std::move(steps);
}

Result<RayBatch> step_in(const compute::Solid& solid, const scene::Pages& step, const std::string& where) {
    std::optional<RayBatch> batch = batch_in(step, solid.lattice, solid.materials.size());
    if (!batch) return fail(where, "a step of undo is damaged");
    std::vector<std::uint32_t> codes;
    for (const RayBatch::Ray& ray : batch->rays) codes.push_back(ray.code);
    std::ranges::sort(codes);
    if (std::ranges::adjacent_find(codes) != codes.end()) return fail(where, "a step of undo is damaged");
    return std::move(*batch);
}

}  // namespace burin::workpiece
