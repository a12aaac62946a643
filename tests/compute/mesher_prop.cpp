// SPDX-License-Identifier: MIT
// The mesher's promises, tried on solids made to break them: closed, two-manifold, tile by tile, the same on any
// thread.
#include <gtest/gtest.h>

#include <set>

#include <map>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "shaders/shared/octahedral.h"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/same_tiles.hpp"

namespace burin::compute::test {
namespace {

void mesh_everything(Surface& surface, const Solid& solid, WorkerPool& pool) { surface.mesh_all(solid, pool); }

bool same_mesh(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
    return a.positions_m == b.positions_m && a.triangles == b.triangles && a.colours == b.colours;
}

// By the signs alone: a cell's volume share is not known, but a closed mesh around inner nodes is not empty.
void expect_manifold(const Solid& solid, WorkerPool& pool, const std::string& what) {
    Surface surface(solid.lattice);
    mesh_everything(surface, solid, pool);
    const geometry::TriangleMesh mesh = surface.welded();
    ASSERT_GT(mesh.triangles.size(), 0u) << what;
    const MeshTopology t = topology_of(mesh);
    ASSERT_EQ(t.open_edges, 0u) << what;
    ASSERT_EQ(t.non_manifold_edges, 0u) << what;
    ASSERT_EQ(t.misoriented_edges, 0u) << what;
    ASSERT_EQ(t.pinched_vertices, 0u) << what;
    ASSERT_EQ(t.degenerate_triangles, 0u) << what;
}

std::string name(double p, Rays rays, int seed) {
    return "p " + std::to_string(p) + " rays " + std::to_string(static_cast<int>(rays)) + " seed " +
           std::to_string(seed);
}

}  // namespace

TEST(Mesher, RandomNoiseIsTwoManifold) {
    WorkerPool pool(2);
    int seed = 0;
    for (const double p : {0.5, 0.3, 0.1, 0.7, 0.9}) {
        for (const Rays rays : {Rays::agree, Rays::disturbed, Rays::unrelated}) {
            for (int i = 0; i < repeated(4); ++i) {
                const std::array<int, 3> cells{33 + i % 4, 18 + i % 3, 20};
                const Solid solid = noise_solid(cells, p, rays, static_cast<std::uint64_t>(++seed));
                ASSERT_TRUE(well_formed(solid));
                ASSERT_NO_FATAL_FAILURE(expect_manifold(solid, pool, name(p, rays, seed)));
            }
        }
    }
}

TEST(Mesher, SmallNoiseOfEveryKindIsTwoManifold) {
    WorkerPool pool(1);
    for (int seed = 0; seed < repeated(4000); ++seed) {
        const double p = 0.15 + 0.7 * (seed % 97) / 97.0;
        const auto rays = static_cast<Rays>(seed % 3);
        const Solid solid = noise_solid({4 + seed % 3, 5, 4}, p, rays, static_cast<std::uint64_t>(1000 + seed));
        Surface surface(solid.lattice);
        mesh_everything(surface, solid, pool);
        ASSERT_EQ(topology_of(surface.welded()), MeshTopology{}) << name(p, rays, seed);
    }
}

// STL has no shared vertices: its readers take equal floats for one vertex. Sheets that touch there would become one.
TEST(Mesher, NoTwoVerticesShareAPlaceNotEvenInFloats) {
    WorkerPool pool(1);
    for (int seed = 0; seed < repeated(600); ++seed) {
        const auto rays = static_cast<Rays>(seed % 3);
        Solid solid = noise_solid({9, 8, 7}, 0.4, rays, static_cast<std::uint64_t>(9000 + seed));
        solid.lattice.spacing_m = 0.01;
        solid.lattice.origin_object = {3.0 + 0.1 * seed, -7.0, 0.001};  // some hundred lattices away
        ASSERT_TRUE(solid.lattice.fits_floats());
        Surface surface(solid.lattice);
        mesh_everything(surface, solid, pool);
        const geometry::TriangleMesh mesh = surface.welded();
        std::set<std::array<float, 3>> places;
        for (const Vec3& p : mesh.positions_m) {
            places.insert({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
        }
        ASSERT_EQ(places.size(), mesh.positions_m.size()) << "seed " << seed;
    }
}

// Two cells side by side with every pattern of their twelve nodes: each way a loop can pass the face between them.
TEST(Mesher, EveryPairOfNeighbouringCellsIsTwoManifold) {
    WorkerPool pool(1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (unsigned pattern = 1; pattern < 4096; pattern += kSanitized ? 7 : 1) {
            std::array<int, 3> cells{4, 4, 4};
            cells[axis] = 5;
            Solid solid{{Vec3(0.0), 1.0, cells}, {}, {{"one", {}}}};
            const auto node_inside = [&](const std::array<int, 3>& n) {
                const std::array<int, 3> p{n[axis] - 1, n[(axis + 1) % 3] - 1, n[(axis + 2) % 3] - 1};
                if (p[0] < 0 || p[0] > 2 || p[1] < 0 || p[1] > 1 || p[2] < 0 || p[2] > 1) return false;
                return (pattern >> (p[0] * 4 + p[1] * 2 + p[2]) & 1u) != 0;
            };
            for (int a = 0; a < 3; ++a) {
                const auto s = static_cast<std::size_t>(a);
                solid.sets[s] = DexelSet(solid.lattice.rays_u(a), solid.lattice.rays_v(a));
                for (int v = 0; v < solid.lattice.rays_v(a); ++v) {
                    for (int u = 0; u < solid.lattice.rays_u(a); ++u) {
                        std::vector<shared::DexelEnd> ends;
                        for (int d = 1; d <= cells[s]; ++d) {
                            std::array<int, 3> above{}, below{};
                            above[s] = d, below[s] = d - 1;
                            above[(s + 1) % 3] = below[(s + 1) % 3] = u;
                            above[(s + 2) % 3] = below[(s + 2) % 3] = v;
                            if (node_inside(above) == node_inside(below)) continue;
                            shared::IntVector n{0, 0, 0};
                            (a == 0 ? n.x : a == 1 ? n.y : n.z) = node_inside(above) ? -1 : 1;
                            ends.push_back(shared::make_end(d * 4096 - 2048, 0, shared::encode_normal(n)));
                        }
                        solid.sets[s].replace(static_cast<std::size_t>(v * solid.lattice.rays_u(a) + u), ends);
                    }
                }
            }
            Surface surface(solid.lattice);
            mesh_everything(surface, solid, pool);
            ASSERT_EQ(topology_of(surface.welded()), MeshTopology{}) << "axis " << axis << " pattern " << pattern;
            ASSERT_GT(surface.volume_m3(), 0.0);
        }
    }
}

// Tiles are drawn as they are: a vertex that two tiles share must lie at the same place in both, or light shines
// through.
TEST(Mesher, TilesShareTheirBorderVerticesToTheBit) {
    WorkerPool pool(2);
    for (int seed = 0; seed < repeated(16); ++seed) {
        const Solid solid =
            noise_solid({40, 37, 35}, 0.4, static_cast<Rays>(seed % 3), static_cast<std::uint64_t>(seed));
        Surface surface(solid.lattice);
        mesh_everything(surface, solid, pool);
        std::map<std::uint64_t, std::array<float, 3>> places;
        std::size_t shared_by_tiles = 0;
        for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
            const TileMesh& tile = surface.tile(t);
            const auto keys = vertex_keys(surface.lattice(), surface.grid().first_node(t), tile);
            ASSERT_EQ(keys.size(), tile.vertices.size());
            for (std::size_t i = 0; i < keys.size(); ++i) {
                const std::array<float, 3> at{tile.vertices[i].x, tile.vertices[i].y, tile.vertices[i].z};
                const auto [known, fresh] = places.try_emplace(keys[i], at);
                ASSERT_EQ(known->second, at) << "seed " << seed << " tile " << t;
                shared_by_tiles += fresh ? 0 : 1;
            }
        }
        EXPECT_GT(shared_by_tiles, 1000u);
    }
}

TEST(Mesher, ThreadsDoNotChangeTheMesh) {
    WorkerPool one(1), two(2), five(5);
    const Solid solid = noise_solid({50, 40, 34}, 0.4, Rays::disturbed, 5);
    Surface a(solid.lattice), b(solid.lattice), c(solid.lattice);
    mesh_everything(a, solid, one);
    mesh_everything(b, solid, two);
    mesh_everything(c, solid, five);
    EXPECT_EQ(first_difference(a, b), "");
    EXPECT_EQ(first_difference(a, c), "");
    EXPECT_TRUE(same_mesh(a.welded(), b.welded()));
}

// What is kept must be what meshing anew would give: small strokes, most of them near tile borders, in noise and in
// blocks.
TEST(Mesher, MeshingOnlyWhatChangedEqualsMeshingEverything) {
    WorkerPool pool(2);
    for (int seed = 0; seed < repeated(16); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        Solid solid = seed % 2 == 0 ? *make_block(Vec3(0.4, 0.22, 0.2), 32, {"block", {}})
                                    : noise_solid({20, 17, 19}, 0.6, static_cast<Rays>(seed / 2 % 3),
                                                  static_cast<std::uint64_t>(seed));
        const Lattice lattice = solid.lattice;
        const auto engine = make_cpu_engine(std::move(solid), pool);
        Surface kept(lattice);
        kept.mesh_all(engine->solid(), pool);
        for (int cut = 0; cut < 25; ++cut) {
            std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 3)));
            for (BallSweep& s : sweeps) {
                Vec3 units;
                for (int a = 0; a < 3; ++a) {
                    const int cells = lattice.cells[static_cast<std::size_t>(a)];
                    const double border = kTileCells * random.small(0, cells / kTileCells) + random.between(-2.5, 2.5);
                    units[a] = 4096.0 * (random.chance(0.7) ? border : random.between(0, cells));
                }
                s.start_object_m = lattice.object_from_units(units);
                s.end_object_m = s.start_object_m;
                if (random.chance(0.4)) {
                    s.end_object_m += Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) *
                                      (6.0 * lattice.spacing_m);
                }
                s.operation = std::array{Operation::cut, Operation::fill,
                                         Operation::paint}[static_cast<std::size_t>(random.small(0, 2))];
                s.radius_m =
                    lattice.spacing_m * (random.chance(0.5) ? random.between(0.05, 1.0) : random.between(1, 3));
            }
            ASSERT_TRUE(engine->carve(sweeps).has_value());
            kept.update(engine->solid(), engine->take_changes(), pool);
            Surface fresh(lattice);
            mesh_everything(fresh, engine->solid(), pool);
            ASSERT_EQ(first_difference(kept, fresh), "") << "seed " << seed << " cut " << cut;
        }
        ASSERT_TRUE(well_formed(engine->solid()));
        ASSERT_EQ(topology_of(kept.welded()), MeshTopology{}) << "seed " << seed;
    }
}

// Cells of one material go a short way, mixed ones the general one. On a large ball, whose normals hardly turn within a
// cell, two materials of one colour must make no difference.
TEST(Mesher, ASmoothSurfaceIsTheSameOnTheShortWayAndOnTheGeneralOne) {
    WorkerPool pool(2);
    auto ball = make_ball(1.0, 64, {"one", {90, 150, 210}});
    ASSERT_TRUE(ball);
    Solid mixed = *ball;
    mixed.materials.push_back({"other", {90, 150, 210}});
    for (DexelSet& set : mixed.sets) {
        for (int v = 0; v < set.rays_v(); ++v)
            for (int u = 0; u < set.rays_u(); ++u)
                for (shared::DexelEnd& end : set.ends_to_change(u, v)) {
                    end = shared::make_end(shared::depth_of(end), static_cast<shared::uint>((u + v) % 2), end.normal);
                }
    }
    Surface one(ball->lattice), two(ball->lattice);
    mesh_everything(one, *ball, pool);
    mesh_everything(two, mixed, pool);
    ASSERT_GT(one.triangles(), 10000u);
    EXPECT_EQ(first_difference(one, two), "");
}

// Two triangles of a quad are looked at together; they must count as they do one by one.
TEST(Mesher, TheBoundsOfATileAreThoseOfEachOfItsTriangles) {
    WorkerPool pool(1);
    std::size_t with_fans = 0, without = 0;
    for (int seed = 0; seed < repeated(48); ++seed) {
        const Solid solid = noise_solid({20, 18, 17}, std::array{0.02, 0.5, 0.98}[static_cast<std::size_t>(seed % 3)],
                                        Rays::disturbed, static_cast<std::uint64_t>(seed));
        Surface surface(solid.lattice);
        mesh_everything(surface, solid, pool);
        for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
            const TileMesh& tile = surface.tile(t);
            if (tile.indices.empty()) continue;
            (tile.only_quads() ? without : with_fans) += 1;
            const auto place = [&](std::size_t i) { return geometry::place_of(tile.vertices[tile.indices[i]]); };
            float longest2 = 0.0f;
            for (std::size_t i = 0; i < tile.indices.size(); ++i) {
                const Vec3f edge = place(i % 3 == 2 ? i - 2 : i + 1) - place(i);
                longest2 = std::max(longest2, glm::dot(edge, edge));
            }
            ASSERT_EQ(tile.longest_edge_m, std::sqrt(longest2)) << "seed " << seed << " tile " << t;
            const geometry::TriangleSlab slab = geometry::slab_around([&](auto&& visit) {
                for (std::size_t i = 0; i < tile.indices.size(); i += 3)
                    visit(geometry::Triangle{Vec3(place(i)), Vec3(place(i + 1)), Vec3(place(i + 2))});
            });
            ASSERT_EQ(tile.slab.normal, slab.normal) << "seed " << seed << " tile " << t;
            ASSERT_EQ(tile.slab.top_m, slab.top_m) << "seed " << seed << " tile " << t;
        }
    }
    EXPECT_GT(with_fans, 0u);
    EXPECT_GT(without, 0u);
}

TEST(Mesher, RaysThatDisagreeAreCounted) {
    WorkerPool pool(1);
    const auto disagreeing = [&](Rays rays) {
        const Solid solid = noise_solid({20, 20, 20}, 0.5, rays, 3);
        Surface surface(solid.lattice);
        mesh_everything(surface, solid, pool);
        return surface.disagreeing_edges();
    };
    EXPECT_EQ(disagreeing(Rays::agree), 0u);
    EXPECT_GT(disagreeing(Rays::disturbed), 100u);
    EXPECT_GT(disagreeing(Rays::unrelated), disagreeing(Rays::disturbed));
}

}  // namespace burin::compute::test
