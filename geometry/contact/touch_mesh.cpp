// SPDX-License-Identifier: MIT
#include "geometry/contact/touch_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/try.hpp"
#include "geometry/contact/touch_layout.hpp"
#include "geometry/contact/touch_patch_maker.hpp"
#include "geometry/contact/touch_surface.hpp"
#include "geometry/contact/touch_tree.hpp"

namespace burin::geometry {
namespace {

// Beyond this distance the squares of areas leave the range of float; no touched object is as large.
constexpr double kFarthest_m = 1e8;

constexpr const char* kWhere = "mesh to touch";

bool near_enough(const Vec3& p) {
    return std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m && std::abs(p.z) <= kFarthest_m;
}

Result<void> check_positions(std::span<const Vec3> positions, const Vec3& origin) {
    for (std::size_t i = 0; i < positions.size(); ++i)
        if (!near_enough(positions[i] - origin))
            return fail(kWhere, "position " + std::to_string(i) + " is not finite, or more than 1e8 m from the middle",
                        "give positions in metres");
    return {};
}

Result<void> check_triangles(std::span<const VertexTriple> triangles, std::size_t vertices) {
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t v : triangles[i])
            if (v >= vertices)
                return fail(kWhere,
                            "triangle " + std::to_string(i) + " names vertex " + std::to_string(v) + " of " +
                                std::to_string(vertices),
                            "number vertices from 0");
    return {};
}

Box box_of(std::span<const Vec3> positions) {
    Box box;
    for (const Vec3& p : positions) box.include(p);
    return box;
}

}  // namespace

// Numbering of vertices and triangles: see geometry/contact/touch_layout.hpp.
struct TouchMesh::Parts {
    Vec3 origin_object{0.0};
    TouchSurface surface;
    std::vector<std::uint32_t> own_of;      // own number of each vertex index
    std::vector<std::uint32_t> slot_of;     // slot of each triangle index
    std::vector<std::uint32_t> mesh_index;  // triangle index of each slot
    std::vector<std::uint32_t> empty_slots{};
    TouchTree tree{};
    TouchPatchMaker maker{};
    std::shared_ptr<const TouchSnapshot> newest{};  // null: something has changed since

    [[nodiscard]] Vec3f relative(const Vec3& position_object_m) const {
        return Vec3f(position_object_m - origin_object);
    }
    void place(std::uint32_t index, const Vec3& position_object_m) {
        surface.place(own_of[index], relative(position_object_m));
    }
    // Returns the patches that lose triangles; if none does, those that border on added triangles. They are to be
    // filled again.
    std::vector<std::uint32_t> patches_around(std::span<const std::uint32_t> slots,
                                              std::span<const VertexTriple> added) const;
    void remove(std::uint32_t slot);
    std::uint32_t put(const VertexTriple& triangle);
    void refill(std::span<const std::uint32_t> patches, std::span<const std::uint32_t> added_slots);
};

Result<TouchMesh> TouchMesh::create(const TriangleMesh& mesh) {
    if (mesh.triangles.empty()) return fail(kWhere, "there is no triangle", "give a mesh with triangles");
    if (mesh.triangles.size() >= TouchSurface::kNone / 4)
        return fail(kWhere, std::to_string(mesh.triangles.size()) + " triangles are too many", "part the mesh");
    BURIN_TRY_DO(check_triangles(mesh.triangles, mesh.positions_m.size()));
    BURIN_TRY_DO(check_positions(mesh.positions_m, Vec3(0.0)));
    const Vec3 origin = box_of(mesh.positions_m).center();
    std::vector<Vec3f> positions_m;
    positions_m.reserve(mesh.positions_m.size());
    for (const Vec3& p : mesh.positions_m) positions_m.push_back(Vec3f(p - origin));

    TouchLayout layout = lay_out(mesh.triangles, positions_m);
    const std::vector<std::span<const TouchItem>> groups(layout.classes.begin(), layout.classes.end());
    auto parts = std::make_unique<Parts>(Parts{.origin_object = origin,
                                               .surface = TouchSurface(layout.positions_m, layout.triangles),
                                               .own_of = std::move(layout.own_of),
                                               .slot_of = std::move(layout.slot_of),
                                               .mesh_index = std::move(layout.mesh_index)});
    parts->tree.build(groups);
    return TouchMesh(std::move(parts));
}

TouchMesh::TouchMesh(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
TouchMesh::~TouchMesh() = default;
TouchMesh::TouchMesh(TouchMesh&&) noexcept = default;
TouchMesh& TouchMesh::operator=(TouchMesh&&) noexcept = default;

std::size_t TouchMesh::triangles() const { return parts_->surface.slots() - parts_->empty_slots.size(); }
std::size_t TouchMesh::vertices() const { return parts_->own_of.size(); }
std::uint64_t TouchMesh::patches_made() const { return parts_->tree.patches_made(); }

Result<void> TouchMesh::move_vertices(std::span<const std::uint32_t> vertices,
                                      std::span<const Vec3> positions_object_m) {
    if (vertices.size() != positions_object_m.size())
        return fail(kWhere,
                    std::to_string(vertices.size()) + " vertices and " + std::to_string(positions_object_m.size()) +
                        " positions",
                    "give a position for each vertex");
    for (const std::uint32_t v : vertices)
        if (v >= parts_->own_of.size())
            return fail(kWhere,
                        "there is no vertex " + std::to_string(v) + " of " + std::to_string(parts_->own_of.size()),
                        "number vertices from 0");
    BURIN_TRY_DO(check_positions(positions_object_m, parts_->origin_object));
    for (std::size_t i = 0; i < vertices.size(); ++i) parts_->place(vertices[i], positions_object_m[i]);
    parts_->newest.reset();
    return {};
}

Result<void> TouchMesh::move_all(std::span<const Vec3> positions_object_m) {
    if (positions_object_m.size() != vertices())
        return fail(
            kWhere,
            std::to_string(positions_object_m.size()) + " positions for " + std::to_string(vertices()) + " vertices",
            "give a position for each vertex");
    BURIN_TRY_DO(check_positions(positions_object_m, parts_->origin_object));
    for (std::uint32_t i = 0; i < positions_object_m.size(); ++i) parts_->place(i, positions_object_m[i]);
    parts_->newest.reset();
    return {};
}

void TouchMesh::Parts::remove(std::uint32_t slot) {
    surface.remove(slot);
    tree.take_out(slot);
    empty_slots.push_back(slot);
}

std::uint32_t TouchMesh::Parts::put(const VertexTriple& triangle) {
    std::uint32_t slot = surface.slots();
    if (empty_slots.empty()) {
        slot_of.push_back(slot);  // a new slot has the same number as its triangle's index
        mesh_index.push_back(slot);
    } else {
        slot = empty_slots.back();
        empty_slots.pop_back();
    }
    surface.put(slot, triangle);
    return slot;
}

std::vector<std::uint32_t> TouchMesh::Parts::patches_around(std::span<const std::uint32_t> slots,
                                                            std::span<const VertexTriple> added) const {
    std::vector<std::uint32_t> patches;
    const auto take = [&](std::uint32_t slot) {
        const std::uint32_t patch = tree.patch_of(slot);
        if (patches.empty() || patches.back() != patch) patches.push_back(patch);
    };
    for (const std::uint32_t slot : slots) take(slot);
    for (std::size_t i = 0; patches.empty() && i < added.size(); ++i)
        for (const std::uint32_t v : added[i]) surface.for_each_at(v, take);
    std::ranges::sort(patches);
    const auto rest = std::ranges::unique(patches);
    patches.erase(rest.begin(), rest.end());
    return patches;
}

Result<std::vector<std::uint32_t>> TouchMesh::replace(std::span<const std::uint32_t> removed_triangles,
                                                      std::span<const VertexTriple> added,
                                                      std::span<const Vec3> new_positions_object_m) {
    Parts& parts = *parts_;
    std::vector<std::uint32_t> removed;
    for (const std::uint32_t index : removed_triangles) {
        if (index >= parts.slot_of.size() || !parts.surface.is_there(parts.slot_of[index]))
            return fail(kWhere, "there is no triangle " + std::to_string(index), "remove each triangle once");
        removed.push_back(parts.slot_of[index]);
    }
    std::ranges::sort(removed);
    if (std::ranges::adjacent_find(removed) != removed.end())
        return fail(kWhere, "a triangle is to be removed twice", "remove each triangle once");
    BURIN_TRY_DO(check_triangles(added, vertices() + new_positions_object_m.size()));
    BURIN_TRY_DO(check_positions(new_positions_object_m, parts.origin_object));

    for (const Vec3& p : new_positions_object_m) {
        parts.own_of.push_back(parts.surface.vertices());
        parts.surface.add_vertex(parts.relative(p));
    }
    std::vector<VertexTriple> own(added.begin(), added.end());
    for (VertexTriple& t : own)
        for (std::uint32_t& v : t) v = parts.own_of[v];
    const std::vector<std::uint32_t> patches = parts.patches_around(removed, own);
    for (const std::uint32_t slot : removed) parts.remove(slot);
    std::vector<std::uint32_t> slots, indices;
    for (const VertexTriple& t : own) {
        slots.push_back(parts.put(t));
        indices.push_back(parts.mesh_index[slots.back()]);
    }
    parts.refill(patches, slots);
    parts.newest.reset();
    return indices;
}

// Distributes the triangles left in these patches and the added ones anew, by size and nearness; adds or removes
// patches as needed.
void TouchMesh::Parts::refill(std::span<const std::uint32_t> patches, std::span<const std::uint32_t> added_slots) {
    std::vector<SizedItem> all;
    const auto take = [&](std::uint32_t slot) {
        const auto [a, b, c] = surface.triangle(slot);
        all.push_back(sized({surface.position_m(a), surface.position_m(b), surface.position_m(c)}, slot));
    };
    for (const std::uint32_t slot : added_slots) take(slot);
    for (const std::uint32_t patch : patches)
        for (const std::uint32_t slot : tree.slots(patch))
            if (tree.patch_of(slot) == patch) take(slot);

    std::size_t filled = 0;
    for (const std::vector<TouchItem>& items : in_classes(all)) {
        for (std::size_t at = 0; at < items.size(); at += TouchPatch::kMostTriangles) {
            const std::span<const TouchItem> some =
                std::span(items).subspan(at, std::min<std::size_t>(TouchPatch::kMostTriangles, items.size() - at));
            if (filled < patches.size()) {
                tree.refill(patches[filled++], some);
            } else {
                tree.insert(some, patches.empty() ? TouchTree::kNone : patches.front());
            }
        }
    }
    for (; filled < patches.size(); ++filled) tree.remove(patches[filled]);
}

std::shared_ptr<const TouchSnapshot> TouchMesh::snapshot() {
    if (parts_->newest) return parts_->newest;
    parts_->tree.mark_patches_of(parts_->surface.renew_normals());
    const auto make = [&](std::span<const std::uint32_t> slots) {
        return parts_->maker.make(parts_->surface, slots, parts_->mesh_index);
    };
    auto made = std::make_shared<TouchSnapshot>();
    made->origin_object = parts_->origin_object;
    made->root = parts_->tree.renew(make);
    parts_->newest = made;
    return parts_->newest;
}

}  // namespace burin::geometry
