// SPDX-License-Identifier: MIT
#include "workpiece/saved_solid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <span>
#include <utility>

#include "base/length_unit.hpp"
#include "base/try.hpp"
#include "compute/rays/memory_need.hpp"
#include "compute/rays/normal_code.hpp"
#include "workpiece/saved_head.hpp"

namespace burin::workpiece {
namespace {

using compute::DexelSet;
using shared::DexelEnd;

static_assert(std::endian::native == std::endian::little, "ends are copied as they lie in memory");

constexpr std::array<const char*, 3> kRaysAlong{"rays x", "rays y", "rays z"};

int columns_of(const compute::Lattice& lattice, int axis) { return (lattice.rays_u(axis) + kPageSide - 1) / kPageSide; }

std::size_t pages_of(const compute::Lattice& lattice, int axis) {
    const int rows = (lattice.rays_v(axis) + kPageSide - 1) / kPageSide;
    return static_cast<std::size_t>(columns_of(lattice, axis)) * static_cast<std::size_t>(rows);
}

// The rays of a page: from .. to, excluding to.
struct PageRays {
    int u_from = 0, u_to = 0, v_from = 0, v_to = 0;
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(u_to - u_from) * static_cast<std::size_t>(v_to - v_from);
    }
};

PageRays rays_of(const compute::Lattice& lattice, int axis, std::size_t page) {
    const auto columns = static_cast<std::size_t>(columns_of(lattice, axis));
    const int u = static_cast<int>(page % columns) * kPageSide, v = static_cast<int>(page / columns) * kPageSide;
    return {u, std::min(u + kPageSide, lattice.rays_u(axis)), v, std::min(v + kPageSide, lattice.rays_v(axis))};
}

template <typename Visit>
void each_ray(const PageRays& rays, Visit visit) {
    for (int v = rays.v_from; v < rays.v_to; ++v)
        for (int u = rays.u_from; u < rays.u_to; ++u) visit(u, v);
}

// ---- To bytes

std::vector<std::byte> page_bytes(const DexelSet& set, const PageRays& rays) {
    std::size_t ends = 0;
    each_ray(rays, [&](int u, int v) { ends += set.ends(u, v).size(); });
    std::vector<std::byte> bytes(4 * (rays.count() + 2 * ends));
    std::byte *count = bytes.data(), *depth = count + 4 * rays.count(), *normal = depth + 4 * ends;
    const auto put = [](std::byte*& to, std::uint32_t value) {
        std::memcpy(to, &value, sizeof value);
        to += sizeof value;
    };
    each_ray(rays, [&](int u, int v) {
        const std::span<const DexelEnd> held = set.ends(u, v);
        put(count, static_cast<std::uint32_t>(held.size()));
        for (const DexelEnd& end : held) {
            put(depth, end.depth_material);
            put(normal, end.normal);
        }
    });
    return bytes;
}

// ---- From bytes

Result<compute::Solid> empty_solid(const scene::Pages& pages, const std::string& where) {
    const auto damaged = [&] {
        return fail(where, "what it says of the whole solid is damaged", "open an earlier copy of the file");
    };
    const std::vector<std::byte>* bytes = pages.find({kHead, 0});
    std::optional<SavedHead> head = bytes != nullptr ? head_in(*bytes) : std::nullopt;
    if (!head || head->page_side != kPageSide) return damaged();
    const compute::Lattice& lattice = head->lattice;
    BURIN_TRY_DO(compute::check_memory(lattice, compute::memory_available()));
    compute::Solid solid{lattice, {}, std::move(head->materials)};
    for (int axis = 0; axis < 3; ++axis)
        solid.sets[static_cast<std::size_t>(axis)] = DexelSet(lattice.rays_u(axis), lattice.rays_v(axis));
    return solid;
}

// A page that has been read: of each ray the number of its ends, and all ends, ray after ray.
struct ReadPage {
    std::vector<std::uint32_t> counts;
    std::vector<DexelEnd> ends;
};

// Reads a page's rays; nothing where the bytes are no such page.
std::optional<ReadPage> page_in(std::span<const std::byte> bytes, std::size_t rays, int most_depth,
                                std::size_t materials) {
    if (bytes.size() % 4 != 0 || bytes.size() < 4 * rays) return {};
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    ReadPage page{{words.begin(), words.begin() + static_cast<std::ptrdiff_t>(rays)}, {}};
    std::uint64_t ends = 0;
    for (const std::uint32_t count : page.counts) ends += count;
    if (rays + 2 * ends != words.size()) return {};
    page.ends.reserve(ends);
    for (std::size_t end = rays; end < rays + ends; ++end) page.ends.push_back({words[end], words[end + ends]});
    std::size_t first = 0;
    for (const std::uint32_t count : page.counts) {
        if (!is_sound(std::span(page.ends).subspan(first, count), most_depth, materials)) return {};
        first += count;
    }
    return page;
}

// Puts the pages of a set into it, by their numbers; where there is none the rays stay empty.
void put_pages(const std::vector<std::optional<ReadPage>>& pages, const compute::Lattice& lattice, int axis,
               DexelSet& set) {
    const auto row = static_cast<std::size_t>(set.rays_u());
    std::vector<std::uint32_t> counts(set.ray_count(), 0);
    const auto each_row = [&](auto visit) {  // (first ray of the set, rays, first ray of the page, page)
        for (std::size_t number = 0; number < pages.size(); ++number) {
            if (!pages[number]) continue;
            const PageRays rays = rays_of(lattice, axis, number);
            const auto across = static_cast<std::size_t>(rays.u_to - rays.u_from);
            for (int v = rays.v_from; v < rays.v_to; ++v)
                visit(static_cast<std::size_t>(v) * row + static_cast<std::size_t>(rays.u_from), across,
                      static_cast<std::size_t>(v - rays.v_from) * across, *pages[number]);
        }
    };
    each_row([&](std::size_t ray, std::size_t across, std::size_t of_page, const ReadPage& page) {
        std::copy_n(page.counts.begin() + static_cast<std::ptrdiff_t>(of_page), across,
                    counts.begin() + static_cast<std::ptrdiff_t>(ray));
    });
    std::vector<std::size_t> first(counts.size() + 1, 0);
    for (std::size_t ray = 0; ray < counts.size(); ++ray) first[ray + 1] = first[ray] + counts[ray];
    std::vector<DexelEnd> ends(first.back());
    const ReadPage* last = nullptr;
    std::size_t taken = 0;  // of the page
    each_row([&](std::size_t ray, std::size_t across, std::size_t, const ReadPage& page) {
        if (std::exchange(last, &page) != &page) taken = 0;
        const std::size_t count = first[ray + across] - first[ray];
        std::copy_n(page.ends.begin() + static_cast<std::ptrdiff_t>(taken), count,
                    ends.begin() + static_cast<std::ptrdiff_t>(first[ray]));
        taken += count;
    });
    set.assign(counts, ends);
}

// ---- What is lost

// By axis and page.
using LostPages = std::array<std::vector<bool>, 3>;

std::size_t page_of(const compute::Lattice& lattice, int axis, int u, int v) {
    return static_cast<std::size_t>(u / kPageSide + v / kPageSide * columns_of(lattice, axis));
}

// Returns whether a node is inside as the rays of another set say; nothing where they are lost as well.
std::optional<bool> inside(const compute::Solid& solid, const std::array<int, 3>& node, int not_axis,
                           const LostPages& lost) {
    for (int axis = 2; axis >= 0; --axis) {
        const auto s = static_cast<std::size_t>(axis);
        const int u = node[(s + 1) % 3], v = node[(s + 2) % 3];
        if (axis == not_axis || lost[s][page_of(solid.lattice, axis, u, v)]) continue;
        bool in = false;
        for (const DexelEnd& end : solid.sets[s].ends(u, v)) {
            if (shared::depth_of(end) > node[s] * shared::kUnitsPerCell) break;
            in = !in;
        }
        return in;
    }
    return std::nullopt;
}

// Where lost rays were made again, and where they could not be, for no direction tells what was there.
struct MadeAgain {
    Box surface, unknown;
};

// Makes a ray of which nodes are inside: its ends lie in the middle between two nodes.
std::vector<DexelEnd> ray_through(const compute::Solid& solid, int axis, int u, int v, const LostPages& lost,
                                  std::uint32_t material, MadeAgain& where) {
    const auto s = static_cast<std::size_t>(axis);
    std::vector<DexelEnd> ends;
    std::array<int, 3> node{};
    node[(s + 1) % 3] = u;
    node[(s + 2) % 3] = v;
    bool before = false;
    for (int along = 0; along <= solid.lattice.cells[s]; ++along) {
        node[s] = along;
        const std::optional<bool> told = inside(solid, node, axis, lost);
        if (!told)
            where.unknown.include(
                solid.lattice.object_from_units(Vec3(node[0], node[1], node[2]) * double{shared::kUnitsPerCell}));
        const bool now = told.value_or(false);
        const int between = along * shared::kUnitsPerCell - shared::kUnitsPerCell / 2;
        if (now != before)
            ends.push_back(shared::make_end(std::max(between, 0), material, shared::axis_normal(axis, before)));
        before = now;
    }
    if (before)
        ends.push_back(shared::make_end(solid.lattice.cells[s] * shared::kUnitsPerCell, material,
                                        shared::axis_normal(axis, true)));
    return ends;
}

// Makes the rays of a lost page again from those of the other sets; the box takes in where their ends are.
void make_again(compute::Solid& solid, int axis, std::size_t page, const LostPages& lost, std::uint32_t material,
                MadeAgain& where) {
    const auto s = static_cast<std::size_t>(axis);
    each_ray(rays_of(solid.lattice, axis, page), [&](int u, int v) {
        const std::vector<DexelEnd> ends = ray_through(solid, axis, u, v, lost, material, where);
        solid.sets[s].replace(u, v, ends);
        for (const DexelEnd& end : ends) {
            Vec3 units(0.0);
            units[axis] = shared::depth_of(end);
            units[(axis + 1) % 3] = u * shared::kUnitsPerCell;
            units[(axis + 2) % 3] = v * shared::kUnitsPerCell;
            where.surface.include(solid.lattice.object_from_units(units));
        }
    });
}

// Makes all that is lost again; says in words what that is.
std::string make_again(compute::Solid& solid, const LostPages& lost) {
    const std::uint32_t material = compute::add_material(solid, lost_material()).value_or(0);
    MadeAgain where;
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t page = 0; page < pages_of(solid.lattice, axis); ++page) {
            if (!lost[static_cast<std::size_t>(axis)][page]) continue;
            make_again(solid, axis, page, lost, material, where);
            ++count;
        }
    }
    const std::string pages = std::to_string(count) + (count == 1 ? " page is" : " pages are");
    const std::string spacing = in_millimetres(solid.lattice.spacing_m);
    std::string told = pages + " damaged";
    if (!where.surface.empty())
        told += ": the surface there, about " + in_millimetres(where.surface.extent()) + ", was made again, exact to " +
                spacing + ", and is red";
    if (!where.unknown.empty())
        return told + (where.surface.empty() ? ": " : "; ") + "what was in about " +
               in_millimetres(where.unknown.extent()) + " is lost, and is empty now";
    return where.surface.empty() ? told + ", where there was no surface" : told;
}

}  // namespace

// ---- ChangedPages

ChangedPages::ChangedPages(const compute::Lattice& lattice) {
    for (int axis = 0; axis < 3; ++axis) {
        columns_[static_cast<std::size_t>(axis)] = columns_of(lattice, axis);
        changed_[static_cast<std::size_t>(axis)].assign(pages_of(lattice, axis), true);
    }
}

void ChangedPages::note(const compute::Changes& changes) {
    for (const shared::ChangedRay& ray : changes.rays) {
        const compute::RayPlace place = compute::place_of(ray.ray);
        const auto axis = static_cast<std::size_t>(place.axis);
        changed_[axis][static_cast<std::size_t>(place.u / kPageSide + place.v / kPageSide * columns_[axis])] = true;
    }
}

void ChangedPages::note_all() {
    for (std::vector<bool>& of_axis : changed_) of_axis.assign(of_axis.size(), true);
}

void ChangedPages::clear() {
    for (std::vector<bool>& of_axis : changed_) of_axis.assign(of_axis.size(), false);
}

// ---- Saving and loading

void save_solid(const compute::Solid& solid, const ChangedPages& changed, scene::Pages& pages) {
    pages.part = kSolidPart;
    pages.pages[{kHead, 0}] = head_bytes(solid, kPageSide);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (std::size_t page = 0; page < pages_of(solid.lattice, axis); ++page)
            if (changed.has(axis, page))
                pages.pages[{kRaysAlong[a], static_cast<std::int64_t>(page)}] =
                    page_bytes(solid.sets[a], rays_of(solid.lattice, axis, page));
    }
}

Result<LoadedSolid> load_solid(const scene::Pages& pages, const std::string& where) {
    BURIN_TRY(solid, empty_solid(pages, where));
    LostPages lost;
    std::size_t missing = 0, all = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const int most_depth = solid.lattice.cells[a] * shared::kUnitsPerCell;
        std::vector<std::optional<ReadPage>> read;
        for (std::size_t page = 0; page < pages_of(solid.lattice, axis); ++page, ++all) {
            const auto* bytes = pages.find({kRaysAlong[a], static_cast<std::int64_t>(page)});
            const std::size_t rays = rays_of(solid.lattice, axis, page).count();
            read.push_back(bytes ? page_in(*bytes, rays, most_depth, solid.materials.size()) : std::nullopt);
            lost[a].push_back(!read.back());
            missing += lost[a].back() ? 1 : 0;
        }
        put_pages(read, solid.lattice, axis, solid.sets[a]);
    }
    if (missing == 0) return LoadedSolid{std::move(solid)};
    if (missing == all) return fail(where, "none of its pages can be read", "open an earlier copy of the file");
    std::string told = make_again(solid, lost);
    return LoadedSolid{std::move(solid), std::move(told)};
}

}  // namespace burin::workpiece
