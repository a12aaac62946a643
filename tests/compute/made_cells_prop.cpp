// SPDX-License-Identifier: MIT
// Surfaces that are put together from the cells that a device has made equal those that the host makes, in every field
// of every tile; and a device that sends wrong numbers does no harm.
#include <gtest/gtest.h>

#include <algorithm>

#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"
#include "tests/compute/device_cells.hpp"
#include "tests/compute/random_solids.hpp"
#include "tests/compute/same_tiles.hpp"

namespace burin::compute::test {
namespace {

// Places near the borders of tiles, and of the lattice, are the usual ones.
Vec3 random_place(const Lattice& lattice, Random& random) {
    Vec3 units;
    for (int a = 0; a < 3; ++a) {
        const int cells = lattice.cells[static_cast<std::size_t>(a)];
        const double border = kTileCells * random.small(0, cells / kTileCells) + random.between(-2.5, 2.5);
        units[a] = 4096.0 * (random.chance(0.6) ? border : random.between(0, cells));
    }
    return lattice.object_from_units(units);
}

std::vector<BallSweep> random_sweeps(const Lattice& lattice, Random& random) {
    std::vector<BallSweep> sweeps(static_cast<std::size_t>(random.small(1, 3)));
    for (BallSweep& s : sweeps) {
        s.start_object_m = s.end_object_m = random_place(lattice, random);
        if (random.chance(0.4)) {
            s.end_object_m +=
                Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) * (6.0 * lattice.spacing_m);
        }
        s.operation =
            std::array{Operation::cut, Operation::fill, Operation::paint}[static_cast<std::size_t>(random.small(0, 2))];
        s.material = static_cast<std::uint8_t>(random.small(0, 1));
        s.radius_m = lattice.spacing_m * (random.chance(0.5) ? random.between(0.05, 1.0) : random.between(1, 4));
        if (random.chance(0.05)) s.radius_m = 14.0 * lattice.spacing_m;  // empties or fills whole tiles
    }
    return sweeps;
}

// Rays of any direction hold new ends that no other ray knows of.
RayBatch random_rays(const Lattice& lattice, Random& random) {
    RayBatch batch;
    for (int i = random.small(1, 6); i > 0; --i) {
        const int axis = random.small(0, 2);
        const RayPlace place{axis, random.small(0, lattice.rays_u(axis) - 1),
                             random.small(0, lattice.rays_v(axis) - 1)};
        if (std::ranges::any_of(batch.rays, [&](const RayBatch::Ray& ray) { return ray.code == place.code(); })) {
            continue;
        }
        std::vector<int> depths(static_cast<std::size_t>(2 * random.small(0, 4)));
        for (int& depth : depths) depth = random.small(0, 4096 * lattice.cells[static_cast<std::size_t>(axis)]);
        std::ranges::sort(depths);
        if (std::ranges::adjacent_find(depths) != depths.end()) continue;
        std::vector<shared::DexelEnd> ends;
        for (const int depth : depths) {
            ends.push_back(
                shared::make_end(depth, random.chance(0.5) ? 1u : 0u, static_cast<std::uint32_t>(random.bits())));
        }
        batch.add(place.code(), ends);
    }
    return batch;
}

// A solid that changes at random, and two surfaces of it: the host's own, and the one that is composed.
struct Pair {
    Pair(Solid solid, WorkerPool& workers)
        : pool(workers),
          host(solid.lattice),
          composed(solid.lattice),
          engine(make_cpu_engine(std::move(solid), workers)) {
        host.mesh_all(engine->solid(), pool);
        composed.mesh_all(engine->solid(), pool);
    }
    [[nodiscard]] const Solid& solid() const { return engine->solid(); }

    [[nodiscard]] Changes change(Random& random) {
        const Lattice& lattice = solid().lattice;
        for (int i = random.small(1, 2); i > 0; --i) {
            if (random.chance(0.7)) {
                EXPECT_TRUE(engine->carve(random_sweeps(lattice, random)));
            } else {
                EXPECT_TRUE(engine->assign(random_rays(lattice, random)));
            }
        }
        return engine->take_changes();
    }

    // Updates both; names what differs.
    [[nodiscard]] std::string update(const Changes& changes, const MadeCells& made) {
        const RemeshStats by_host = host.update(solid(), changes, pool);
        const RemeshStats by_device = composed.update(solid(), changes, pool, &made);
        if (!std::ranges::equal(host.changed_tiles(), composed.changed_tiles())) return "changed tiles";
        if (by_host.tiles != by_device.tiles || by_host.cells != by_device.cells ||
            by_host.triangles != by_device.triangles) {
            return "statistics";
        }
        return first_difference(composed, host);
    }

    WorkerPool& pool;
    Surface host, composed;
    std::unique_ptr<CarvingEngine> engine;
};

Solid some_solid(int seed) {
    if (seed % 4 == 0) {
        Solid block = *make_block(Vec3(0.4, 0.22, 0.2), 32, {"block", {}});
        block.materials.push_back({"other", {0, 50, 250}});
        return block;
    }
    constexpr std::array<double, 3> kShares{0.6, 0.05, 0.97};
    return noise_solid({20, 17, 19}, kShares[static_cast<std::size_t>(seed / 4 % 3)], static_cast<Rays>(seed % 4 - 1),
                       static_cast<std::uint64_t>(seed));
}

}  // namespace

TEST(MadeCells, TilesComposedOfThemEqualTheHostsOwn) {
    WorkerPool pool(2);
    std::size_t composed = 0, left = 0;
    for (int seed = 0; seed < repeated(24); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        Pair pair(some_solid(seed), pool);
        for (int step = 0; step < 25; ++step) {
            const Changes changes = pair.change(random);
            MadeCells made = device_cells(pair.solid(), changes, pool);
            for (std::size_t i = made.tiles.size(); i > 1; --i) {
                std::swap(made.tiles[i - 1],
                          made.tiles[static_cast<std::size_t>(random.small(0, static_cast<int>(i) - 1))]);
            }
            for (shared::MadeTile& tile : made.tiles) {
                if (random.chance(0.05)) tile.left = 1;
                (tile.left != 0 ? left : composed) += 1;
            }
            ASSERT_EQ(pair.update(changes, made), "") << "seed " << seed << " step " << step;
        }
    }
    EXPECT_GT(composed, left / 4);
    EXPECT_GT(left, 0u);
}

}  // namespace burin::compute::test
