// SPDX-License-Identifier: MIT
// The search in a touched mesh against looking at every triangle, and a mesh that was edited against one made anew.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/contact/touch_layout.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "tests/geometry/touch_samples.hpp"

namespace burin::geometry::test {
namespace {

TriangleMesh any_mesh(std::mt19937& random) {
    switch (random() % 4) {
        case 0: return ball(1 + static_cast<int>(random() % 14), 0.05, random_vector(random, 2.0));
        case 1: return scattered(random, 1 + static_cast<int>(random() % 1500), random_vector(random, 10.0));
        case 2: {  // a fine ball on a floor of two triangles
            TriangleMesh mesh = ball(9, 0.01);
            const auto first = static_cast<std::uint32_t>(mesh.positions_m.size());
            mesh.positions_m.insert(mesh.positions_m.end(),
                                    {{-5, -0.01, -5}, {-5, -0.01, 5}, {5, -0.01, 5}, {5, -0.01, -5}});
            mesh.triangles.push_back({first, first + 1, first + 2});
            mesh.triangles.push_back({first, first + 2, first + 3});
            return mesh;
        }
        default: {  // a fan: a thousand triangles at one vertex
            TriangleMesh mesh;
            mesh.positions_m.push_back(Vec3(0.0, 0.3, 0.0));
            for (int i = 0; i < 1000; ++i)
                mesh.positions_m.push_back({std::cos(i / 159.1), 0.01 * (i % 7), std::sin(i / 159.1)});
            for (std::uint32_t i = 1; i < 1000; ++i) mesh.triangles.push_back({0, i + 1, i});
            return mesh;
        }
    }
}

RC_GTEST_PROP(TouchSearch, FindsEveryTriangleWithinReachOfAPoint, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    TouchMesh mesh = std::move(TouchMesh::create(any_mesh(random)).value());
    LocalSurface surface;
    surface.meshes.push_back({mesh.snapshot(), 0});
    surface.origin_object = random_vector(random, 5.0);
    std::uniform_real_distribution<double> exponent(-7.0, 0.5);
    for (int i = 0; i < 20; ++i) {
        const Triangle near_it = surface.triangle(static_cast<std::uint32_t>(random() % surface.triangles()));
        const double reach = std::pow(10.0, exponent(random));
        const Vec3 p = near_it.a + random_vector(random, 1.2 * reach);
        std::set<std::uint32_t> found;
        Near near{p, p, reach};
        RC_ASSERT(for_each_triangle_near(surface, near, [&](std::uint32_t id, const Triangle&) {
            return found.insert(id).second;  // each once
        }));
        for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
            const Triangle t = surface.triangle(id);
            const double distance = glm::length(p - nearest_point({t.a, t.b, t.c}, p));
            if (distance <= reach) RC_ASSERT(found.contains(id));
        }
    }
}

RC_GTEST_PROP(TouchSearch, FindsEveryTriangleThatMeetsABoxAndNoneFarFromIt, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    TouchMesh mesh = std::move(TouchMesh::create(any_mesh(random)).value());
    LocalSurface surface;
    surface.meshes.push_back({mesh.snapshot(), 0});
    const Box all = bounds(surface);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < 20; ++i) {
        const Vec3 at = all.lo + all.extent() * Vec3(part(random), part(random), part(random));
        const Vec3 half = 0.5 * all.extent() * std::pow(10.0, -3.0 * part(random));
        Near near{at - half, at + half, 0.1 * part(random) * half.x};
        std::set<std::uint32_t> found;
        for_each_triangle_near(surface, near,
                               [&](std::uint32_t id, const Triangle&) { return found.insert(id).second; });
        const auto outside = [&](const Vec3& lo, const Vec3& hi) {
            return glm::length(glm::max(glm::max(lo - near.hi, near.lo - hi), Vec3(0.0)));
        };
        for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
            const Triangle t = surface.triangle(id);
            for (const Vec3& p : {t.a, t.b, t.c, (t.a + t.b + t.c) / 3.0, 0.5 * (t.a + t.b)})
                if (outside(p, p) <= near.reach_m) RC_ASSERT(found.contains(id));
            const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c), hi = glm::max(glm::max(t.a, t.b), t.c);
            if (found.contains(id)) RC_ASSERT(outside(lo, hi) <= near.reach_m * 1.001 + 1e-5);
        }
    }
}

RC_GTEST_PROP(TouchSearch, FindsTheNearestTriangleWithAReachThatShrinks, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    TouchMesh mesh = std::move(TouchMesh::create(any_mesh(random)).value());
    LocalSurface surface;
    surface.meshes.push_back({mesh.snapshot(), 0});
    for (int i = 0; i < 20; ++i) {
        const Vec3 p = bounds(surface).center() + random_vector(random, 1.0);
        double best = HUGE_VAL, truth = HUGE_VAL;
        Near near{p, p, 100.0};
        for_each_triangle_near(surface, near, [&](std::uint32_t, const Triangle& t) {
            best = std::min(best, glm::length(p - nearest_point({t.a, t.b, t.c}, p)));
            near.reach_m = best;
            return true;
        });
        for (std::uint32_t id = 0; id < surface.triangles(); ++id) {
            const Triangle t = surface.triangle(id);
            truth = std::min(truth, glm::length(p - nearest_point({t.a, t.b, t.c}, p)));
        }
        RC_ASSERT(best == truth);
    }
}

// A mesh as its owner thinks of it.
struct Expected {
    std::vector<Vec3> positions_m;
    std::map<std::uint32_t, VertexTriple> triangles;

    [[nodiscard]] TriangleMesh mesh() const {
        TriangleMesh plain;
        plain.positions_m = positions_m;
        for (const auto& [index, t] : triangles) plain.triangles.push_back(t);
        return plain;
    }
};

// The far corners, see below.
bool stays(const Vec3& p) { return glm::length(p) > 1.0; }

void edit(TouchMesh& mesh, Expected& expected, std::mt19937& random) {
    const auto some_vertex = [&] {
        const auto v = static_cast<std::uint32_t>(random() % expected.positions_m.size());
        return stays(expected.positions_m[v]) ? 0u : v;
    };
    switch (random() % 4) {
        case 0: {  // around a vertex
            std::vector<std::uint32_t> vertices;
            std::vector<Vec3> places;
            const Vec3 center = expected.positions_m[some_vertex()];
            for (std::uint32_t v = 0; v < expected.positions_m.size(); ++v)
                if (glm::length(expected.positions_m[v] - center) < 0.02) {
                    expected.positions_m[v] += random_vector(random, 0.01);
                    vertices.push_back(v);
                    places.push_back(expected.positions_m[v]);
                }
            RC_ASSERT(mesh.move_vertices(vertices, places).has_value());
            break;
        }
        case 1:
            for (Vec3& p : expected.positions_m)
                if (!stays(p)) p += random_vector(random, 0.001);
            RC_ASSERT(mesh.move_all(expected.positions_m).has_value());
            break;
        default: {  // some go, some come
            std::vector<std::uint32_t> removed;
            const Vec3 center = expected.positions_m[some_vertex()];
            for (const auto& [index, t] : expected.triangles)
                if (glm::length(expected.positions_m[t[0]] - center) < 0.02) removed.push_back(index);
            if (removed.size() == expected.triangles.size()) removed.pop_back();
            std::vector<Vec3> places;
            for (auto i = random() % 5; i > 0; --i) places.push_back(center + random_vector(random, 0.02));
            expected.positions_m.insert(expected.positions_m.end(), places.begin(), places.end());
            std::vector<VertexTriple> added;
            for (auto i = random() % 400; i > 0; --i) added.push_back({some_vertex(), some_vertex(), some_vertex()});
            const auto indices = mesh.replace(removed, added, places);
            RC_ASSERT(indices.has_value());
            for (const std::uint32_t index : removed) expected.triangles.erase(index);
            for (std::size_t i = 0; i < added.size(); ++i)
                RC_ASSERT(expected.triangles.emplace(indices->at(i), added[i]).second);
        }
    }
}

// Corners in nanometres.
using Felt = std::multiset<std::array<long, 9>>;

Felt felt(const TouchSnapshot& snapshot) {
    Felt all;
    for (std::uint32_t i = 0; i < snapshot.triangles(); ++i) {
        const Corners corners = corners_of(snapshot.triangle(i));
        std::array<long, 9> steps{};
        for (std::size_t k = 0; k < 9; ++k)
            steps[k] = std::lround((corners[k / 3][k % 3] + snapshot.origin_object[static_cast<int>(k % 3)]) * 1e9);
        all.insert(steps);
    }
    return all;
}

RC_GTEST_PROP(TouchMesh, AfterEditsIsTheSameAsOneMadeAnew, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    TriangleMesh start = ball(6 + static_cast<int>(random() % 3), 0.05);
    // Two corners that stay where they are, far off: the origin stays too, and with it what float makes of places.
    start.positions_m.push_back(Vec3(-4.0));
    start.positions_m.push_back(Vec3(4.0));
    Expected expected{start.positions_m, {}};
    for (std::uint32_t i = 0; i < start.triangles.size(); ++i) expected.triangles[i] = start.triangles[i];
    TouchMesh mesh = std::move(TouchMesh::create(start).value());
    for (int i = 0; i < 6; ++i) {
        edit(mesh, expected, random);
        if (random() % 3 == 0) std::ignore = mesh.snapshot();
    }
    const auto edited = mesh.snapshot();
    TouchMesh anew = std::move(TouchMesh::create(expected.mesh()).value());
    RC_ASSERT(mesh.triangles() == expected.triangles.size());
    RC_ASSERT(felt(*edited) == felt(*anew.snapshot()));
    // Normals, and the whole tree: every triangle is found at its own place, with the same normals as in the new one.
    std::map<Corners, std::array<Vec3f, 3>> normals;
    const auto fresh = anew.snapshot();
    for (std::uint32_t i = 0; i < fresh->triangles(); ++i) {
        const Triangle t = fresh->triangle(i);
        normals[{{{t.a.x, t.a.y, t.a.z}, {t.b.x, t.b.y, t.b.z}, {t.c.x, t.c.y, t.c.z}}}] =
            fresh->corner_normals(i).normals;
    }
    for (std::uint32_t i = 0; i < edited->triangles(); i += 3) {
        const Triangle t = edited->triangle(i);
        const auto same = normals.find({{{t.a.x, t.a.y, t.a.z}, {t.b.x, t.b.y, t.b.z}, {t.c.x, t.c.y, t.c.z}}});
        if (same == normals.end()) continue;
        for (std::size_t k = 0; k < 3; ++k)
            RC_ASSERT(glm::length(edited->corner_normals(i).normals[k] - same->second[k]) < 1e-3f);
        bool found = false;
        Near near{t.a, t.a, 0.0};
        const auto note = [&](std::uint32_t number, const Triangle&) { return found = found || number == i, true; };
        for_each_near(*edited, near, TriangleVisitor{note});
        RC_ASSERT(found);
    }
}

RC_GTEST_PROP(TouchOrder, KeepsAllItemsAndFillsGroupsWithNeighbours, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const std::uint32_t side = 64;
    std::vector<TouchItem> items;
    for (std::uint32_t i = 0; i < side * side; ++i)
        items.push_back({Vec3f(static_cast<float>(i % side), static_cast<float>(i / side), 0.0f), i});
    std::ranges::shuffle(items, random);
    order_by_nearness(items);
    std::set<std::uint32_t> ids;
    float sum = 0.0f;
    for (std::size_t group = 0; group < items.size(); group += 16) {
        Vec3f lo(HUGE_VALF), hi(-HUGE_VALF);
        for (std::size_t i = group; i < group + 16; ++i) {
            ids.insert(items[i].id);
            lo = glm::min(lo, items[i].middle), hi = glm::max(hi, items[i].middle);
        }
        sum += (hi.x - lo.x) + (hi.y - lo.y);
    }
    RC_ASSERT(ids.size() == items.size());
    RC_ASSERT(sum / 256.0f <= 8.0f);  // a square of 4 by 4 has 6
}

}  // namespace
}  // namespace burin::geometry::test
