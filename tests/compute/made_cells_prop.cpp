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
        if (random.chance(0.12)) s.radius_m = 14.0 * lattice.spacing_m;  // empties or fills whole tiles
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
          hollow{solid.lattice, {}, solid.materials},
          engine(make_cpu_engine(std::move(solid), workers)) {
        for (int axis = 0; axis < 3; ++axis) {
            hollow.sets[static_cast<std::size_t>(axis)] =
                DexelSet(hollow.lattice.rays_u(axis), hollow.lattice.rays_v(axis));
        }
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

    [[nodiscard]] bool is_left(const shared::MadeTile& tile) const {
        return tile.left != 0 || composed.tile(tile.tile).has_twice_passed_faces;
    }

    // Updates both; names what differs. Where no tile is left to the host, the composed one is given no ray and no
    // change, so it must do without.
    [[nodiscard]] std::string update(const Changes& changes, const MadeCells& made) {
        const RemeshStats by_host = host.update(solid(), changes, pool);
        const bool any_left = std::ranges::any_of(made.tiles, [&](const auto& tile) { return is_left(tile); });
        return update_composed(any_left ? solid() : hollow, any_left ? changes : Changes{}, made, by_host);
    }

    [[nodiscard]] std::string update_composed(const Solid& from, const Changes& changes, const MadeCells& made,
                                              const RemeshStats& by_host) {
        const RemeshStats stats = composed.update(from, changes, pool, &made);
        if (!std::ranges::equal(host.changed_tiles(), composed.changed_tiles())) return "changed tiles";
        if (by_host.tiles != stats.tiles || by_host.cells != stats.cells || by_host.triangles != stats.triangles) {
            return "statistics";
        }
        return first_difference(composed, host);
    }

    WorkerPool& pool;
    Surface host, composed;
    Solid hollow;
    std::unique_ptr<CarvingEngine> engine;
};

Solid some_solid(int seed) {
    if (seed % 4 == 0) {
        Solid block = *make_block(Vec3(0.4, 0.22, 0.2), 32, {"block", {}});
        block.materials.push_back({"other", {0, 50, 250}});
        return block;
    }
    constexpr std::array<double, 3> kShares{0.02, 0.97, 0.6};
    return noise_solid({20, 17, 19}, kShares[static_cast<std::size_t>(seed / 4 % 3)], static_cast<Rays>(seed % 4 - 1),
                       static_cast<std::uint64_t>(seed));
}

// Counts what the tiles of the updates were, so that a test cannot pass because none was of the kind it is about.
struct Kinds {
    int composed = 0, left = 0, emptied = 0, first = 0;

    void count(const Pair& pair, const MadeCells& made, const std::vector<bool>& was_left,
               const std::vector<bool>& was_empty) {
        for (std::size_t i = 0; i < made.tiles.size(); ++i) {
            const bool empty = pair.composed.tile(made.tiles[i].tile).indices.empty();
            (was_left[i] ? left : composed) += 1;
            if (was_left[i]) continue;
            emptied += empty && !was_empty[i] ? 1 : 0;
            first += !empty && was_empty[i] ? 1 : 0;
        }
    }
};

// A wrong number that no device sends: `spoil` puts it into one tile's part, which has two cells and two edges at
// least.
struct Fault {
    const char* name;
    void (*spoil)(MadeCells& made, shared::MadeTile& tile);
};
constexpr std::uint32_t kHuge = 0xffffffffu;
shared::MadeCell& last_cell(MadeCells& made, const shared::MadeTile& tile) {
    return made.cells[tile.first_cell + tile.cells - 1];
}
shared::MadeEdge& last_edge(MadeCells& made, const shared::MadeTile& tile) {
    return made.edges[tile.first_edge + tile.edges - 1];
}
// Lets the first crossed edge of the last cell use the vertex.
void use_vertex(MadeCells& made, const shared::MadeTile& tile, std::uint32_t vertex) {
    std::uint32_t& word = last_cell(made, tile).of_edge_low;
    std::uint32_t& high = last_cell(made, tile).of_edge_high;
    for (int e = 0; e < 12; ++e) {
        std::uint32_t& half = e < 8 ? word : high;
        const int shift = 4 * (e % 8);
        if ((half >> shift & 0xfu) == 0xfu) continue;
        half = (half & ~(0xfu << shift)) | vertex << shift;
        return;
    }
}

constexpr Fault kFaults[] = {
    {"no tile of the surface", [](MadeCells&, auto& tile) { tile.tile = kHuge; }},
    {"a tile twice", [](MadeCells& made, auto& tile) { made.tiles.push_back(shared::MadeTile(tile)); }},
    {"cells from beyond", [](MadeCells&, auto& tile) { tile.first_cell = kHuge; }},
    {"cells to beyond", [](MadeCells&, auto& tile) { tile.cells = kHuge; }},
    {"one cell too many",
     [](MadeCells& made, auto& tile) {
         tile.cells = static_cast<std::uint32_t>(made.cells.size()) + 1u - tile.first_cell;
     }},
    {"edges from beyond", [](MadeCells&, auto& tile) { tile.first_edge = kHuge; }},
    {"edges to beyond", [](MadeCells&, auto& tile) { tile.edges = kHuge; }},
    {"no edges", [](MadeCells&, auto& tile) { tile.edges = 0; }},
    {"an edge is missing", [](MadeCells&, auto& tile) { --tile.edges; }},
    {"a node above the tile", [](MadeCells&, auto& tile) { tile.signs[100] |= 1u << 18; }},
    {"no signs", [](MadeCells&, auto& tile) { std::ranges::fill(tile.signs, 0u); }},
    {"all signs", [](MadeCells&, auto& tile) { std::ranges::fill(tile.signs, 0x3ffffu); }},
    {"a cell beyond the tile", [](MadeCells& made, auto& tile) { last_cell(made, tile).what |= 0xffffu; }},
    {"the cell after the last", [](MadeCells& made, auto& tile) { last_cell(made, tile).what = 4913u | 1u << 16; }},
    {"a cell twice",
     [](MadeCells& made, auto& tile) { last_cell(made, tile) = made.cells[tile.first_cell + tile.cells - 2]; }},
    {"cells out of order",
     [](MadeCells& made, auto& tile) { std::swap(last_cell(made, tile), made.cells[tile.first_cell]); }},
    {"a cell without surface",
     [](MadeCells& made, auto& tile) {
         last_cell(made, tile).what = (last_cell(made, tile).what & 0xffff0000u) | 4912u;
     }},
    {"a cell without vertices", [](MadeCells& made, auto& tile) { last_cell(made, tile).what &= 0xffffu; }},
    {"a cell with 13 vertices",
     [](MadeCells& made, auto& tile) {
         last_cell(made, tile).what = (last_cell(made, tile).what & 0xffffu) | 13u << 16;
     }},
    {"a cell with all vertices", [](MadeCells& made, auto& tile) { last_cell(made, tile).what |= 0xffff0000u; }},
    {"vertices from beyond", [](MadeCells& made, auto& tile) { last_cell(made, tile).first_vertex = kHuge; }},
    {"vertices to beyond",
     [](MadeCells& made, auto& tile) {
         last_cell(made, tile).first_vertex = static_cast<std::uint32_t>(made.vertices.size());
     }},
    {"a face passed twice", [](MadeCells& made, auto& tile) { last_cell(made, tile).of_edge_high |= 1u << 16; }},
    {"an edge without vertex", [](MadeCells& made, auto& tile) { use_vertex(made, tile, 15); }},
    {"an edge with another cell's vertex",
     [](MadeCells& made, auto& tile) { use_vertex(made, tile, last_cell(made, tile).what >> 16); }},
    {"no vertex at all", [](MadeCells& made, auto& tile) { last_cell(made, tile).of_edge_low = kHuge; }},
    {"vertices where nothing is crossed",
     [](MadeCells& made, auto& tile) { last_cell(made, tile).of_edge_low = last_cell(made, tile).of_edge_high = 0; }},
    {"an edge along a fourth axis", [](MadeCells& made, auto& tile) { last_edge(made, tile).what |= 0x3000u; }},
    {"an edge with another flag", [](MadeCells& made, auto& tile) { last_edge(made, tile).what |= 0x4000u; }},
    {"an edge twice",
     [](MadeCells& made, auto& tile) { last_edge(made, tile) = made.edges[tile.first_edge + tile.edges - 2]; }},
    {"edges out of order",
     [](MadeCells& made, auto& tile) { std::swap(last_edge(made, tile), made.edges[tile.first_edge]); }},
    {"another node inside", [](MadeCells& made, auto& tile) { last_edge(made, tile).what ^= 1u << 16; }},
};

// Tells whether every corner of every triangle is a vertex and every vertex has a key.
bool is_whole(const Surface& surface) {
    for (std::uint32_t t = 0; t < surface.tile_count(); ++t) {
        const TileMesh& tile = surface.tile(t);
        if (std::ranges::any_of(tile.indices, [&](std::uint32_t i) { return i >= tile.vertices.size(); })) return false;
        const auto keys = vertex_keys(surface.lattice(), surface.grid().first_node(t), tile);
        if (keys.size() != tile.vertices.size()) return false;
    }
    return true;
}

// Turns one bit of what the device has sent, anywhere.
void turn_bit(MadeCells& made, Random& random) {
    const auto turn = [&](auto& list) {
        if (list.empty()) return;
        auto* const bytes = reinterpret_cast<unsigned char*>(list.data());
        const auto last = static_cast<int>(list.size() * sizeof(list[0])) - 1;
        bytes[random.small(0, last)] ^= static_cast<unsigned char>(1u << random.small(0, 7));
    };
    switch (random.small(0, 3)) {
        case 0: return turn(made.tiles);
        case 1: return turn(made.cells);
        case 2: return turn(made.edges);
        default: return turn(made.vertices);
    }
}

void shuffle(std::vector<shared::MadeTile>& tiles, Random& random) {
    for (std::size_t i = tiles.size(); i > 1; --i) {
        std::swap(tiles[i - 1], tiles[static_cast<std::size_t>(random.small(0, static_cast<int>(i) - 1))]);
    }
}

}  // namespace

TEST(MadeCells, TilesComposedOfThemEqualTheHostsOwn) {
    WorkerPool pool(2);
    Kinds kinds;
    for (int seed = 0; seed < repeated(32); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        Pair pair(some_solid(seed), pool);
        for (int step = 0; step < 25; ++step) {
            const Changes changes = pair.change(random);
            MadeCells made = device_cells(pair.solid(), changes, pool);
            shuffle(made.tiles, random);
            std::vector<bool> was_left, was_empty;
            const bool leave = random.chance(0.3);
            for (shared::MadeTile& tile : made.tiles) {
                if (leave && random.chance(0.2)) tile.left = 1;
                was_left.push_back(pair.is_left(tile));
                was_empty.push_back(pair.composed.tile(tile.tile).indices.empty());
            }
            ASSERT_EQ(pair.update(changes, made), "") << "seed " << seed << " step " << step;
            kinds.count(pair, made, was_left, was_empty);
        }
    }
    EXPECT_GT(kinds.composed, repeated(1000));
    EXPECT_GT(kinds.left, repeated(500));
    EXPECT_GT(kinds.emptied, repeated(16));
    EXPECT_GT(kinds.first, repeated(16));
}

TEST(MadeCells, WrongNumbersAreMetByTheHostItself) {
    WorkerPool pool(2);
    int spoilt = 0;
    for (int seed = 0; seed < repeated(16); ++seed) {
        Random random(static_cast<std::uint64_t>(100 + seed));
        Pair pair(some_solid(seed), pool);
        for (int step = 0; step < 6; ++step) {
            const Changes changes = pair.change(random);
            const MadeCells made = device_cells(pair.solid(), changes, pool);
            const Surface before = pair.composed;
            const RemeshStats by_host = pair.host.update(pair.solid(), changes, pool);
            for (std::size_t i = 0; i < made.tiles.size(); ++i) {
                pair.composed = before;
                if (pair.is_left(made.tiles[i]) || made.tiles[i].cells < 2 || made.tiles[i].edges < 2) continue;
                for (const Fault& fault : kFaults) {
                    MadeCells wrong = made;
                    fault.spoil(wrong, wrong.tiles[i]);
                    pair.composed = before;
                    ASSERT_EQ(pair.update_composed(pair.solid(), changes, wrong, by_host), "")
                        << fault.name << ", seed " << seed << " step " << step;
                    ++spoilt;
                }
                break;
            }
            pair.composed = pair.host;
        }
    }
    EXPECT_GT(spoilt, repeated(1000));
}

// Such a surface may be wrong, as no one can tell a wrong place from the right one, but it can be drawn and felt.
TEST(MadeCells, AnyBitMayBeWrongWithoutACrash) {
    WorkerPool pool(2);
    for (int seed = 0; seed < repeated(16); ++seed) {
        Random random(static_cast<std::uint64_t>(200 + seed));
        Pair pair(some_solid(seed), pool);
        for (int step = 0; step < 10; ++step) {
            const Changes changes = pair.change(random);
            const MadeCells made = device_cells(pair.solid(), changes, pool);
            const Surface before = pair.composed;
            for (int i = 0; i < 40; ++i) {
                pair.composed = before;
                MadeCells wrong = made;
                for (int bits = random.small(1, 4); bits > 0; --bits) turn_bit(wrong, random);
                pair.composed.update(pair.solid(), changes, pool, &wrong);
                ASSERT_TRUE(is_whole(pair.composed)) << "seed " << seed << " step " << step;
            }
            pair.composed = before;
            ASSERT_EQ(pair.update(changes, made), "") << "seed " << seed << " step " << step;
        }
    }
}

}  // namespace burin::compute::test
