// SPDX-License-Identifier: MIT
#include "compute/scan_convert.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <unordered_map>

#include "shaders/shared/octahedral.h"

namespace burin {
namespace {

using Whole3 = std::array<std::int64_t, 3>;  // a vertex in lattice units

struct Crossing {
    std::uint32_t ray;
    std::int32_t depth;
    std::uint32_t triangle;
    std::int8_t enters;  // +1 into the material, -1 out of it
};

struct Input {
    const TriangleMesh& mesh;
    std::vector<Whole3> vertices;
    std::vector<std::uint32_t> normals;  // a code for each triangle
};

std::uint32_t normal_code(const Vec3& normal) {
    const double longest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!(longest > 0.0)) return shared::encode_normal({0, 0, 0});
    const auto whole = [&](double x) { return std::llround(x / longest * 0x1p40); };
    return shared::encode_normal({whole(normal.x), whole(normal.y), whole(normal.z)});
}

Input prepare(const TriangleMesh& mesh, const Lattice& lattice) {
    Input input{mesh, {}, {}};
    input.vertices.reserve(mesh.positions_m.size());
    for (const Vec3& p : mesh.positions_m) {
        const Vec3 units = lattice.units_from_object(p);
        input.vertices.push_back({std::llround(units.x), std::llround(units.y), std::llround(units.z)});
    }
    input.normals.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) {
        // In lattice units: the products of very small or large metres would leave the range of doubles.
        const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
        input.normals.push_back(normal_code(glm::cross((b - a) / lattice.unit_m(), (c - a) / lattice.unit_m())));
    }
    return input;
}

// On which side of the edge a -> b the ray lies: above zero to the left. Exactly on it, the ray moved by (e, e^2) decides.
struct Side {
    std::int64_t area;  // twice the triangle's area with the ray
    bool left;
};

Side side_of(std::int64_t au, std::int64_t av, std::int64_t bu, std::int64_t bv, std::int64_t u, std::int64_t v) {
    const std::int64_t area = (bu - au) * (v - av) - (bv - av) * (u - au);
    if (area != 0) return {area, area > 0};
    if (bv != av) return {0, bv < av};
    return {0, bu > au};
}

std::int64_t first_ray(std::int64_t lowest) {
    return lowest <= 0 ? 0 : (lowest + shared::kUnitsPerCell - 1) / shared::kUnitsPerCell;
}

void cross_triangle(const Input& input, const Lattice& lattice, int axis, std::uint32_t index,
                    std::vector<Crossing>& out) {
    const auto s = static_cast<std::size_t>(axis), u = (s + 1) % 3, v = (s + 2) % 3;
    const auto& t = input.mesh.triangles[index];
    const Whole3 &a = input.vertices[t[0]], &b = input.vertices[t[1]], &c = input.vertices[t[2]];
    const std::int64_t whole = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
    if (whole == 0) return;  // seen edge-on; the moved ray passes beside it
    const auto [u_min, u_max] = std::minmax({a[u], b[u], c[u]});
    const auto [v_min, v_max] = std::minmax({a[v], b[v], c[v]});
    const auto [s_min, s_max] = std::minmax({a[s], b[s], c[s]});
    const std::int64_t u_last = std::min<std::int64_t>(u_max / shared::kUnitsPerCell, lattice.rays_u(axis) - 1);
    const std::int64_t v_last = std::min<std::int64_t>(v_max / shared::kUnitsPerCell, lattice.rays_v(axis) - 1);
    for (std::int64_t rv = first_ray(v_min); rv <= v_last; ++rv) {
        for (std::int64_t ru = first_ray(u_min); ru <= u_last; ++ru) {
            const std::int64_t pu = ru * shared::kUnitsPerCell, pv = rv * shared::kUnitsPerCell;
            const Side ab = side_of(a[u], a[v], b[u], b[v], pu, pv), bc = side_of(b[u], b[v], c[u], c[v], pu, pv),
                       ca = side_of(c[u], c[v], a[u], a[v], pu, pv);
            if (ab.left != bc.left || bc.left != ca.left) continue;
            const double depth = (static_cast<double>(bc.area) * static_cast<double>(a[s]) +
                                  static_cast<double>(ca.area) * static_cast<double>(b[s]) +
                                  static_cast<double>(ab.area) * static_cast<double>(c[s])) /
                                 static_cast<double>(whole);
            out.push_back(
                {static_cast<std::uint32_t>(rv * lattice.rays_u(axis) + ru),
                 static_cast<std::int32_t>(std::clamp<std::int64_t>(std::llround(depth), s_min, s_max)), index,
                 // Counter-clockwise seen from +s: the normal points up, the ray going up leaves the material.
                 static_cast<std::int8_t>(ab.left ? -1 : 1)});
        }
    }
}

std::vector<Crossing> sorted_crossings(const Input& input, const Lattice& lattice, int axis, WorkerPool& pool) {
    const std::size_t triangles = input.mesh.triangles.size();
    const std::size_t chunks = std::min<std::size_t>(triangles, pool.threads() * 8u);
    std::vector<std::vector<Crossing>> found(chunks);
    pool.run(chunks, [&](std::size_t i) {
        for (std::size_t t = triangles * i / chunks; t < triangles * (i + 1) / chunks; ++t) {
            cross_triangle(input, lattice, axis, static_cast<std::uint32_t>(t), found[i]);
        }
    });
    // Counting sort by ray, then each ray by depth; at one depth the surface is entered first, so that touching shells unite.
    std::vector<std::uint32_t> first(lattice.rays(axis) + 1, 0);
    for (const auto& chunk : found)
        for (const Crossing& c : chunk) ++first[c.ray + 1];
    for (std::size_t r = 1; r < first.size(); ++r) first[r] += first[r - 1];
    std::vector<Crossing> sorted(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (const auto& chunk : found)
        for (const Crossing& c : chunk) sorted[next[c.ray]++] = c;
    constexpr std::size_t kRaysATask = 4096;
    pool.run((lattice.rays(axis) + kRaysATask - 1) / kRaysATask, [&](std::size_t i) {
        const std::size_t last = std::min(lattice.rays(axis), (i + 1) * kRaysATask);
        for (std::size_t r = i * kRaysATask; r < last; ++r) {
            std::sort(
                sorted.begin() + first[r], sorted.begin() + first[r + 1], [](const Crossing& a, const Crossing& b) {
                    return std::tuple(a.depth, -a.enters, a.triangle) < std::tuple(b.depth, -b.enters, b.triangle);
                });
        }
    });
    return sorted;
}

// Turns sorted crossings into intervals.
class RayBuilder {
public:
    RayBuilder(const Input& input, bool by_parity, ScanConversion& result)
        : input_(input), by_parity_(by_parity), result_(result) {}

    void build(std::span<const Crossing> crossings, DexelSet& set) {
        std::vector<std::uint32_t> counts(set.ray_count(), 0);
        std::vector<shared::DexelEnd> ends;
        for (std::size_t from = 0, to = 0; from < crossings.size(); from = to) {
            while (to < crossings.size() && crossings[to].ray == crossings[from].ray) ++to;
            counts[crossings[from].ray] = add_ray(crossings.subspan(from, to - from), ends);
        }
        result_.crossings += crossings.size();
        set.assign(counts, ends);
    }

private:
    std::uint32_t add_ray(std::span<const Crossing> crossings, std::vector<shared::DexelEnd>& ends) {
        const std::size_t before = ends.size();
        int winding = 0;
        for (const Crossing& c : crossings) {
            const int next = by_parity_ ? 1 - winding : winding + c.enters;
            if (winding <= 0 && next > 0) open(c, before, ends);
            if (winding > 0 && next <= 0) close(c, ends);
            winding = next;
        }
        if (winding != 0) {
            ++result_.unmatched_rays;
            if ((ends.size() - before) % 2 != 0) ends.pop_back();
        }
        return static_cast<std::uint32_t>(ends.size() - before);
    }

    void open(const Crossing& c, std::size_t before, std::vector<shared::DexelEnd>& ends) const {
        const bool goes_on = ends.size() > before && depth_of(ends.back()) == c.depth;
        if (goes_on) {
            ends.pop_back();  // two intervals that share an end are one
        } else {
            ends.push_back(end_at(c));
        }
    }

    void close(const Crossing& c, std::vector<shared::DexelEnd>& ends) const {
        if (depth_of(ends.back()) == c.depth) {
            ends.pop_back();  // no thickness
        } else {
            ends.push_back(end_at(c));
        }
    }

    [[nodiscard]] shared::DexelEnd end_at(const Crossing& c) const {
        const auto& materials = input_.mesh.triangle_materials;
        return shared::make_end(c.depth, materials.empty() ? 0u : materials[c.triangle], input_.normals[c.triangle]);
    }

    const Input& input_;
    bool by_parity_;
    ScanConversion& result_;
};

enum class Orientation { open, mixed, consistent };

// Every edge must be used an even number of times, and for winding numbers as often one way as the other.
Orientation orientation_of(const TriangleMesh& mesh) {
    struct Use {
        std::uint32_t count = 0;
        std::int32_t forward = 0;
    };
    std::unordered_map<std::uint64_t, Use> uses;
    uses.reserve(mesh.triangles.size() * 2);
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t a = t[k], b = t[(k + 1) % 3];
            if (a == b) continue;
            Use& use = uses[std::min(a, b) << 32 | std::max(a, b)];
            ++use.count;
            use.forward += a < b ? 1 : -1;
        }
    }
    Orientation result = Orientation::consistent;
    for (const auto& [edge, use] : uses) {
        if (use.count % 2 != 0) return Orientation::open;
        if (use.forward != 0) result = Orientation::mixed;
    }
    return result;
}

}  // namespace

Result<ScanConversion> scan_convert(const TriangleMesh& mesh, int resolution, WorkerPool& pool) {
    Box bounds;
    for (const Vec3& p : mesh.positions_m) {
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return fail("mesh", "has a coordinate that is not finite", "repair the file");
        }
    }
    if (!mesh.triangle_materials.empty() && mesh.triangle_materials.size() != mesh.triangles.size()) {
        return fail("mesh", "names a material for some triangles only", "give every triangle a material, or none");
    }
    const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
    for (const std::uint8_t m : mesh.triangle_materials) {
        if (m >= materials)
            return fail("mesh", "uses material " + std::to_string(m) + ", which it lacks", "repair the file");
    }
    for (const auto& t : mesh.triangles) {
        if (std::ranges::max(t) >= mesh.positions_m.size()) {
            return fail("mesh", "has a triangle with a vertex that does not exist", "repair the file");
        }
    }
    // Only what triangles use counts: a stray vertex must not stretch the lattice.
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t i : t) bounds.include(mesh.positions_m[i]);
    if (mesh.triangles.empty()) return fail("mesh", "has no triangles", "give a mesh with a closed surface");
    const Orientation orientation = orientation_of(mesh);
    if (orientation == Orientation::open) {
        return fail("mesh", "has holes, so inside and outside are not defined", "close it, or pass --close-holes");
    }
    const Result<Lattice> lattice = lattice_around(bounds, resolution);
    if (!lattice) return std::unexpected(lattice.error());

    ScanConversion result;
    result.by_parity = orientation == Orientation::mixed;
    result.solid.lattice = *lattice;
    result.solid.materials =
        mesh.materials.empty() ? std::vector<Material>{{"workpiece", {200, 200, 200}}} : mesh.materials;
    const Input input = prepare(mesh, *lattice);
    std::size_t ends_held = 0;
    for (int axis = 0; axis < 3; ++axis) {
        DexelSet& set = result.solid.sets[static_cast<std::size_t>(axis)];
        set = DexelSet(lattice->rays(axis));
        RayBuilder(input, result.by_parity, result).build(sorted_crossings(input, *lattice, axis, pool), set);
        ends_held += set.used();
    }
    if (ends_held == 0) {
        return fail("mesh", "encloses no material at resolution " + std::to_string(resolution),
                    "raise --resolution, or check that the mesh's triangles face outwards");
    }
    return result;
}

}  // namespace burin
