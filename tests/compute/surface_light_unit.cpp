// SPDX-License-Identifier: MIT
// The light on carved surfaces against closed forms, and against rays that are cut with the shapes themselves.
#include "compute/light/surface_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "compute/engine/engine.hpp"
#include "compute/tools/apply.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

constexpr Lamp kOverhead{{0.1, 0.2, 1.0}, 0.1};

// A solid on the lattice cells 0 .. n, in units of a cell: inside(node) says what is material. Rays have their ends
// half-way between nodes, so every plane lies at a half-numbered height.
Solid solid_of(const std::array<int, 3>& cells, const std::function<bool(int, int, int)>& inside) {
    Solid solid;
    solid.lattice.cells = cells;
    solid.materials = {{"stuff", {}}};
    for (int axis = 0; axis < 3; ++axis) {
        DexelSet& set = solid.sets[static_cast<std::size_t>(axis)];
        set = DexelSet(solid.lattice.rays_u(axis), solid.lattice.rays_v(axis));
        for (int v = 0; v < set.rays_v(); ++v)
            for (int u = 0; u < set.rays_u(); ++u) {
                std::vector<shared::DexelEnd> ends;
                bool before = false;
                for (int s = 0; s <= cells[static_cast<std::size_t>(axis)]; ++s) {
                    const std::array<int, 3> node = axis == 0   ? std::array{s, u, v}
                                                    : axis == 1 ? std::array{v, s, u}
                                                                : std::array{u, v, s};
                    const bool now = inside(node[0], node[1], node[2]);
                    if (now != before) {
                        const int depth = s * shared::kUnitsPerCell - shared::kUnitsPerCell / 2;
                        ends.push_back(shared::make_end(depth, 0, shared::axis_normal(axis, !now)));
                    }
                    before = now;
                }
                set.replace(u, v, ends);
            }
    }
    return solid;
}

struct Lit {
    Surface surface;
    SurfaceLight light;

    Lit(const Solid& solid, const Lamp& lamp, WorkerPool& pool) : surface(solid.lattice), light(solid.lattice, lamp) {
        surface.mesh_all(solid, pool);
        light.follow(solid, surface, pool);
        light.step(Vec3(0.0), surface.tile_count(), pool);
    }
    // f(position in cells, normal, light)
    template <typename F>
    void for_each(F&& f) const {
        const double spacing = surface.lattice().spacing_m;
        for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
            const TileMesh& mesh = surface.tile(t);
            for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
                const shared::SurfaceVertex& v = mesh.vertices[i];
                const shared::Direction n = shared::decode_normal(v.normal);
                f(Vec3(v.x, v.y, v.z) / spacing, Vec3(n.x, n.y, n.z), light.shared_light(t)->vertices[i]);
            }
        }
    }
};

// The openness of a place, by many directions cut with the shape itself: distance(direction) in cells to the first
// material.
double openness(const Vec3& normal, const std::function<double(const Vec3&)>& distance) {
    double open = 0.0, all = 0.0;
    constexpr int kDirections = 20000;
    for (int i = 0; i < kDirections; ++i) {
        const double height = 1.0 - (2.0 * i + 1.0) / kDirections, radius = std::sqrt(1.0 - height * height);
        const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const Vec3 direction(radius * std::cos(turn), radius * std::sin(turn), height);
        const double cosine = glm::dot(direction, normal);
        if (cosine <= 0.0) continue;
        all += cosine;
        open += cosine * (1.0 - open_fade(static_cast<float>(std::min(distance(direction), 1e6))));
    }
    return open / all;
}

TEST(SurfaceLight, LeavesAllOfItToEveryVertexOfAConvexBody) {
    WorkerPool pool(2);
    const auto expect_all_open = [&](const Solid& solid, const Lamp& lamp, const char* what) {
        const Lit lit(solid, lamp, pool);
        const Vec3 towards = lit.light.lamp().direction_object;
        std::size_t dark = 0, vertices = 0;
        lit.for_each([&](const Vec3&, const Vec3& normal, const geometry::VertexLight& light) {
            ++vertices;
            if (light.open != 255) ++dark;
            if (glm::dot(normal, towards) > lamp.tangent + 1e-3 && light.sun != 255) ++dark;
            if (glm::dot(normal, towards) < -lamp.tangent - 1e-3) {
                EXPECT_EQ(light.sun, 0) << what;
            }
        });
        EXPECT_GT(vertices, 1000u);
        EXPECT_EQ(dark, 0u) << what;
    };
    expect_all_open(*make_block(Vec3(1.0, 0.7, 0.4), 64, {"block", {}}), kOverhead, "block");
    expect_all_open(*make_ball(1.0, 50, {"ball", {}}), {{1.0, 2.0, -0.4}, 0.05}, "ball");
    // A block cut by a slanted plane: all material on one side of it.
    for (const Vec3 slope : {Vec3(0.31, 0.17, 1.0), Vec3(1.0, 1.0, 1.0), Vec3(0.05, 0.9, 0.6)}) {
        const auto engine = make_cpu_engine(*make_ball(1.0, 40, {"ball", {}}), pool);
        const Vec3 n = glm::normalize(slope);
        const Vec3 axis = glm::normalize(glm::cross(Vec3(0.0, 1.0, 0.0), n));
        const Quat turn = glm::angleAxis(std::acos(n.y), axis);  // the box' upper side towards n
        const ToolSweep cut{BoxTool{Vec3(2.0, 1.0, 2.0)}, {n * 1.3, turn}, {n * 1.3, turn}};
        ASSERT_TRUE(engine->carve(std::span(&cut, 1)).has_value());
        expect_all_open(engine->solid(), {n, 0.05}, "slanted");
    }
}

// A plate of 2 cells' thickness above a floor; its edge runs along y. Away from the edge by x the disc is seen by the
// share of it that passes the edge.
TEST(SurfaceLight, ShadowsHaveThePenumbraOfTheLampsDisc) {
    WorkerPool pool(2);
    constexpr double kFloor = 4.5, kUnder = 30.5, kEdge = 31.5;
    const Solid solid = solid_of({64, 64, 40}, [](int x, int y, int z) {
        const bool within = x > 0 && y > 0 && z > 0 && x < 64 && y < 64;
        return within && (z <= 4 || (x <= 31 && (z == 31 || z == 32)) || (x < 2 && z < 32));
    });
    const double tangent = 0.15;
    const Lit lit(solid, {{0.0, 0.0, 1.0}, tangent}, pool);
    const double half_width = tangent * (kUnder - kFloor);  // in cells
    int in_penumbra = 0;
    lit.for_each([&](const Vec3& p, const Vec3& n, const geometry::VertexLight& light) {
        if (n.z < 0.99 || std::abs(p.z - kFloor) > 0.1 || p.y < 16 || p.y > 48 || p.x < 8 || p.x > 56) return;
        const auto share = [&](double x) {  // of a disc, right of a chord
            const double c = std::clamp((x - kEdge) / half_width, -1.0, 1.0);
            return 0.5 + (c * std::sqrt(1.0 - c * c) + std::asin(c)) / std::numbers::pi;
        };
        // As if it lay up to a cell beside, and a code.
        EXPECT_GE(light.sun, 255.0 * share(p.x - 1.0) - 8.0) << p.x;
        EXPECT_LE(light.sun, 255.0 * share(p.x + 1.0) + 8.0) << p.x;
        if (light.sun > 0 && light.sun < 255) ++in_penumbra;
    });
    EXPECT_GT(in_penumbra, 100);
}

TEST(SurfaceLight, MiddleOfAGrooveIsAsOpenAsItsWallsLeaveIt) {
    WorkerPool pool(2);
    for (const auto& [width, depth] : {std::pair(8, 4), std::pair(12, 12), std::pair(16, 8), std::pair(6, 12)}) {
        const int lo = 32 - width / 2, hi = 32 + width / 2, floor = 20 - depth;  // air: lo < x < hi, above the floor
        const Solid solid = solid_of({64, 96, 24}, [&](int x, int y, int z) {
            const bool within = x > 0 && y > 0 && z > 0 && x < 64 && y < 96;
            return within && z <= 20 && !(x > lo && x < hi && z > floor);
        });
        const Lit lit(solid, kOverhead, pool);
        const double half = 0.5 * (hi - lo - 1) + 0.0, deep = depth;
        const double reference = openness(Vec3(0, 0, 1), [&](const Vec3& d) {
            const double t = half / std::max(std::abs(d.x), 1e-12);
            return d.z * t < deep ? t : 1e9;
        });
        // Without fading the sky's view factor from the middle of an endless groove is sin(atan(half / deep)): fading
        // only adds.
        EXPECT_GT(reference, 1.0 / std::sqrt(1.0 + deep * deep / (half * half)) - 1e-3);
        double sum = 0.0;
        int count = 0;
        lit.for_each([&](const Vec3& p, const Vec3& n, const geometry::VertexLight& light) {
            if (n.z < 0.99 || std::abs(p.z - floor - 0.5) > 0.1 || std::abs(p.x - 32.0) > 0.6 || p.y < 32 || p.y > 64)
                return;
            sum += light.open / 255.0;
            ++count;
        });
        ASSERT_GT(count, 20);
        EXPECT_NEAR(sum / count, reference, 0.06) << "width " << width << " depth " << depth;
    }
}

// Anywhere in a hemispherical bowl the sky is seen through the rim; at its bottom the rim stands at 0 degrees above
// nothing: it is the reference by rays that tells.
TEST(SurfaceLight, BowlIsAsOpenAsRaysToItsWallFind) {
    WorkerPool pool(2);
    const double radius = 0.25;
    const int resolution = 64;
    const auto engine = make_cpu_engine(*make_block(Vec3(1.0, 1.0, 0.5), resolution, {"block", {}}), pool);
    const Vec3 center(0.5, 0.5, 0.5);
    const BallSweep cut{center, center, radius, 0};
    ASSERT_TRUE(engine->carve(std::span(&cut, 1)).has_value());
    const Lit lit(engine->solid(), kOverhead, pool);
    const double h = lit.surface.lattice().spacing_m;
    const Vec3 origin = lit.surface.lattice().origin_object;
    double worst = 0.0, sum = 0.0;
    int count = 0, number = 0;
    lit.for_each([&](const Vec3& p_cells, const Vec3& n, const geometry::VertexLight& light) {
        const Vec3 from_center = origin + p_cells * h - center;
        if (from_center.z > -0.03 || std::abs(glm::length(from_center) - radius) > 0.1 * h || ++number % 17 != 0)
            return;
        const Vec3 p = from_center * (1.0 - 1e-9);
        const double reference = openness(glm::normalize(-from_center), [&](const Vec3& d) {
            const double along = glm::dot(p, d),
                         t = -along + std::sqrt(along * along + radius * radius - glm::dot(p, p));
            return p.z + t * d.z < 0.0 ? t / h : 1e9;
        });
        const double error = light.open / 255.0 - reference;
        worst = std::max(worst, std::abs(error));
        sum += error;
        ++count;
        EXPECT_GT(glm::dot(n, glm::normalize(-from_center)), 0.98);
    });
    ASSERT_GT(count, 50);
    EXPECT_LT(worst, 0.12);
    EXPECT_LT(std::abs(sum / count), 0.06);
}

// Going away from a wall, each step of a cell changes openness by little and always in the one direction.
TEST(SurfaceLight, GrowsEvenlyAwayFromAWall) {
    WorkerPool pool(2);
    const Solid solid = solid_of({80, 80, 40}, [](int x, int y, int z) {
        const bool within = x > 0 && y > 0 && z > 0 && x < 80 && y < 80;
        return within && (z <= 4 || (x <= 20 && z <= 24));
    });
    const Lit lit(solid, kOverhead, pool);
    std::map<int, int> open;  // by place along x
    lit.for_each([&](const Vec3& p, const Vec3& n, const geometry::VertexLight& light) {
        if (n.z > 0.99 && std::abs(p.z - 4.5) < 0.1 && std::abs(p.y - 40.5) < 0.1)
            open[static_cast<int>(p.x)] = light.open;
    });
    ASSERT_GT(open.size(), 40u);
    int before = -1;
    for (const auto& [x, value] : open) {
        if (x > 21 && x < 70 && before >= 0) {
            EXPECT_GE(value, before - 1) << x;
            EXPECT_LE(value, before + 24) << x;
        }
        if (x >= 21) before = value;
    }
    EXPECT_EQ(open.at(60), 255);  // out of the range
}

TEST(SurfaceLight, RefusesALampWithoutDirectionOrWithAnAbsurdAngle) {
    SurfaceLight light(make_ball(1.0, 16, {"ball", {}})->lattice, kOverhead);
    const Lamp before = light.lamp();
    EXPECT_FALSE(light.set_lamp({Vec3(0.0), 0.1}).has_value());
    EXPECT_FALSE(light.set_lamp({Vec3(0.0, std::nan(""), 1.0), 0.1}).has_value());
    EXPECT_FALSE(light.set_lamp({Vec3(0.0, 0.0, 1.0), 0.6}).has_value());
    EXPECT_FALSE(light.set_lamp({Vec3(0.0, 0.0, 1.0), std::nan("")}).has_value());
    EXPECT_EQ(light.lamp(), before);
    EXPECT_TRUE(light.set_lamp({Vec3(0.0, 0.0, 2.0), 0.1}).has_value());
}

// Each node's distance to the nearest one inside, by looking at all of them, and the mean of the 27 around a node.
TEST(Clearance, IsTheBlurredDistanceToTheNearestNodeInside) {
    WorkerPool pool(2);
    Random random(7);
    std::vector<std::array<int, 3>> inside;
    for (int i = 0; i < 12; ++i) inside.push_back({random.small(1, 38), random.small(1, 38), random.small(1, 38)});
    const Solid solid = solid_of({40, 40, 40}, [&](int x, int y, int z) {
        return std::ranges::find(inside, std::array{x, y, z}) != inside.end();
    });
    const Lit lit(solid, kOverhead, pool);
    Clearance clearance(solid.lattice);
    clearance.mark_all();
    clearance.refresh(lit.light.occupancy(), pool);
    const auto distance = [&](const Vec3& place) {
        double nearest = Clearance::kReach;
        for (const auto& node : inside)
            nearest = std::min(nearest, glm::distance(place, Vec3(node[0], node[1], node[2])));
        return nearest;
    };
    for (int tried = 0; tried < repeated(4000); ++tried) {
        const Vec3 node(random.small(0, 39), random.small(0, 39), random.small(0, 39));
        double mean = 0.0;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    mean += distance(node + Vec3(x, y, z)) * (2 - x * x) * (2 - y * y) * (2 - z * z) / 64.0;
                }
        const double found = clearance.at(Vec3f(node));
        ASSERT_GE(found, mean - 1e-5);
        ASSERT_LE(found, mean + 2.0 / Clearance::kPerCell);  // rounded up twice
    }
}

TEST(InnerBoxes, OfABlockFillMostOfIt) {
    WorkerPool pool(2);
    const Lit lit(*make_block(Vec3(1.0), 128, {"block", {}}), kOverhead, pool);
    double volume = 0.0;
    for (const Box& box : lit.light.inner_boxes_object()) volume += box.extent().x * box.extent().y * box.extent().z;
    EXPECT_GT(volume, 0.5);
    EXPECT_LT(volume, 1.0);
}

}  // namespace
}  // namespace burin::compute::test
