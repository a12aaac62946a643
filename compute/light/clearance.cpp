// SPDX-License-Identifier: MIT
// The distance transform is separable (Felzenszwalb and Huttenlocher 2012, "Distance transforms of sampled functions"):
// the square of the distance along z, then the minimum of that plus dy^2, then the minimum of that plus dx^2. With a
// short reach the minimum of 13 values is taken directly, a row of nodes in bytes at a time: squares up to the reach's,
// 36, and the value that stands for "farther" add up to less than 256.
#include "compute/light/clearance.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace burin::compute {
namespace {

constexpr int kReach = Clearance::kReach, kSide = kTileCells + 1;
// Nodes a side whose distances are needed: -1 .. kTileCells + 1.
constexpr int kExact = kSide + 2 * Clearance::kBlur;
constexpr int kMargin = kReach + Clearance::kBlur;
// Nodes a side that those depend on: -kMargin .. kTileCells + kMargin of a tile.
constexpr int kWindow = kSide + 2 * kMargin;
constexpr std::uint8_t kFarSquare = 100;  // squared distance along z when no node inside is within reach
constexpr std::uint8_t kFarCode = kReach * Clearance::kPerCell;
static_assert(kWindow <= 32 && kFarSquare + 2 * kReach * kReach < 256 && kFarSquare > kReach * kReach);

constexpr std::size_t kAll = kSide * kSide * kSide;
constexpr std::array<std::uint8_t, kAll> kInsideTile{};
constexpr std::array<std::uint8_t, kAll> kFarTile = [] {
    std::array<std::uint8_t, kAll> codes{};
    codes.fill(kFarCode);
    return codes;
}();

// The code for each squared distance.
const std::array<std::uint8_t, 256> kCode = [] {
    std::array<std::uint8_t, 256> codes{};
    for (int s = 0; s < 256; ++s) {
        const double cells = std::sqrt(std::min(s, kReach * kReach));
        codes[static_cast<std::size_t>(s)] = static_cast<std::uint8_t>(std::ceil(cells * Clearance::kPerCell));
    }
    return codes;
}();

// A row of nodes along z, padded so that it is processed in whole vectors.
struct alignas(16) Row {
    std::array<std::uint8_t, 32> squares;

    void lower_to(const Row& other, int plus) {
        const auto add = static_cast<std::uint8_t>(plus);
        for (std::size_t z = 0; z < squares.size(); ++z) {
            const auto sum = static_cast<std::uint8_t>(other.squares[z] + add);
            squares[z] = sum < squares[z] ? sum : squares[z];
        }
    }
};

// The inside bits of a tile's nodes and of those around it: bit z + kMargin of a column belongs to node z.
class Window {
public:
    Window(const Occupancy& occupancy, std::uint32_t tile) {
        const TileGrid& grid = occupancy.grid();
        const std::array<int, 3> at = grid.position(tile);
        for (int y = 0; y < kWindow; ++y)
            for (int x = 0; x < kWindow; ++x) {
                const int node_x = x - kMargin + kTileCells, node_y = y - kMargin + kTileCells;  // never below 0
                const int tile_x = at[0] + node_x / kTileCells - 1, tile_y = at[1] + node_y / kTileCells - 1;
                std::uint32_t bits = 0;
                if (tile_x >= 0 && tile_x < grid.tiles[0] && tile_y >= 0 && tile_y < grid.tiles[1]) {
                    const auto column = [&](int tile_z) -> std::uint32_t {
                        if (tile_z < 0 || tile_z >= grid.tiles[2]) return 0;
                        return occupancy.column(grid.index(tile_x, tile_y, tile_z), node_x % kTileCells,
                                                node_y % kTileCells);
                    };
                    bits = column(at[2] - 1) >> (kTileCells - kMargin) | column(at[2]) << kMargin |
                           column(at[2] + 1) << (kMargin + kTileCells);
                }
                bits &= kAllBits;
                columns_[static_cast<std::size_t>(x * kWindow + y)] = bits;
                any_ |= bits;
                all_ &= bits;
            }
    }
    [[nodiscard]] bool nothing_inside() const { return any_ == 0; }
    [[nodiscard]] bool all_inside() const { return all_ == kAllBits; }

    // Returns the squares of the distances along z of nodes -1 .. kTileCells + 1.
    [[nodiscard]] Row row(int x, int y) const {
        const std::uint32_t bits = columns_[static_cast<std::size_t>(x * kWindow + y)];
        Row row;
        row.squares.fill(kFarSquare);
        if (bits == 0) return row;
        for (int z = 0; z < kExact; ++z) {
            const int above = std::countr_zero(bits >> (z + kReach)),
                      below = std::countl_zero(bits << (31 - kReach - z));
            const int nearest = std::min(above, below);
            if (nearest <= kReach)
                row.squares[static_cast<std::size_t>(z)] = static_cast<std::uint8_t>(nearest * nearest);
        }
        return row;
    }

private:
    static constexpr std::uint32_t kAllBits = (1u << kWindow) - 1u;

    std::array<std::uint32_t, kWindow * kWindow> columns_;
    std::uint32_t any_ = 0, all_ = ~0u;
};

// Squared distances of nodes -1 .. kTileCells + 1 of a tile: row x * kExact + y lies along z.
using Squares = std::array<Row, kExact * kExact>;

Squares squares_of(const Window& window) {
    std::array<Row, kWindow * kExact> least_zy;  // x * kExact + y
    for (int x = 0; x < kWindow; ++x) {
        std::array<Row, kWindow> along_z;
        for (int y = 0; y < kWindow; ++y) along_z[static_cast<std::size_t>(y)] = window.row(x, y);
        for (int y = 0; y < kExact; ++y) {
            Row least = along_z[static_cast<std::size_t>(y + kReach)];
            for (int d = 1; d <= kReach; ++d) {
                least.lower_to(along_z[static_cast<std::size_t>(y + kReach - d)], d * d);
                least.lower_to(along_z[static_cast<std::size_t>(y + kReach + d)], d * d);
            }
            least_zy[static_cast<std::size_t>(x * kExact + y)] = least;
        }
    }
    Squares squares;
    for (int x = 0; x < kExact; ++x)
        for (int y = 0; y < kExact; ++y) {
            const Row* const middle = &least_zy[static_cast<std::size_t>((x + kReach) * kExact + y)];
            Row least = *middle;
            for (int d = 1; d <= kReach; ++d) {
                least.lower_to(middle[-d * kExact], d * d);
                least.lower_to(middle[d * kExact], d * d);
            }
            squares[static_cast<std::size_t>(x * kExact + y)] = least;
        }
    return squares;
}

// A row of nodes along z, in sixty-fourths of a code.
struct alignas(16) Sums {
    std::array<std::uint16_t, 32> of;
};
// Mixes three neighbours in the ratio 1 : 2 : 1.
Sums mixed(const Sums& a, const Sums& b, const Sums& c) {
    Sums sums;
    for (std::size_t z = 0; z < sums.of.size(); ++z) {
        sums.of[z] = static_cast<std::uint16_t>(a.of[z] + 2 * b.of[z] + c.of[z]);
    }
    return sums;
}

std::array<std::uint8_t, kAll> blurred_codes(const Squares& squares) {
    std::array<Sums, kExact * kExact> along_z;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        std::array<std::uint16_t, kExact> code;
        for (std::size_t z = 0; z < kExact; ++z) code[z] = kCode[squares[i].squares[z]];
        along_z[i].of.fill(0);
        for (std::size_t z = 0; z < kSide; ++z) {
            along_z[i].of[z] = static_cast<std::uint16_t>(code[z] + 2 * code[z + 1] + code[z + 2]);
        }
    }
    std::array<Sums, kExact * kSide> along_zy;
    for (std::size_t x = 0; x < kExact; ++x)
        for (std::size_t y = 0; y < kSide; ++y) {
            const Sums* const from = &along_z[x * kExact + y];
            along_zy[x * kSide + y] = mixed(from[0], from[1], from[2]);
        }
    std::array<std::uint8_t, kAll> codes;
    std::uint8_t* out = codes.data();
    for (std::size_t x = 0; x < kSide; ++x)
        for (std::size_t y = 0; y < kSide; ++y, out += kSide) {
            const Sums* const from = &along_zy[x * kSide + y];
            const Sums sums = mixed(from[0], from[kSide], from[2 * kSide]);
            for (std::size_t z = 0; z < kSide; ++z) out[z] = static_cast<std::uint8_t>((sums.of[z] + 63) / 64);
        }
    return codes;
}

}  // namespace

Clearance::Clearance(const Lattice& lattice)
    : grid_(lattice),
      tiles_x_(static_cast<std::size_t>(grid_.tiles[0])),
      tiles_y_(static_cast<std::size_t>(grid_.tiles[1])),
      codes_(grid_.count(), kFarTile.data()),
      held_(grid_.count()),
      stale_(grid_.count(), false) {}

void Clearance::mark(const NodeBox& changed) {
    std::array<int, 3> from{}, to{};
    for (std::size_t a = 0; a < 3; ++a) {
        // A tile also holds the first nodes of the next one, hence the additional - 1.
        from[a] = std::max(changed.lo[a] - kMargin - 1, 0) / kTileCells;
        to[a] = std::min((changed.hi[a] + kMargin) / kTileCells, grid_.tiles[a] - 1);
    }
    for (int z = from[2]; z <= to[2]; ++z)
        for (int y = from[1]; y <= to[1]; ++y)
            for (int x = from[0]; x <= to[0]; ++x) stale_[grid_.index(x, y, z)] = true;
}

std::size_t Clearance::refresh(const Occupancy& occupancy, WorkerPool& pool) {
    to_do_.clear();
    for (std::uint32_t t = 0; t < stale_.size(); ++t) {
        if (stale_[t]) to_do_.push_back(t);
    }
    pool.run(to_do_.size(), [&](std::size_t i) { work_out(occupancy, to_do_[i]); });
    for (const std::uint32_t t : to_do_) stale_[t] = false;
    return to_do_.size();
}

void Clearance::work_out(const Occupancy& occupancy, std::uint32_t tile) {
    const Window window(occupancy, tile);
    if (window.nothing_inside() || window.all_inside()) {
        held_[tile].reset();
        codes_[tile] = window.nothing_inside() ? kFarTile.data() : kInsideTile.data();
        return;
    }
    held_[tile] = std::make_unique<Codes>(blurred_codes(squares_of(window)));
    codes_[tile] = held_[tile]->data();
}

std::size_t Clearance::bytes() const {
    const auto held = std::ranges::count_if(held_, [](const auto& codes) { return codes != nullptr; });
    return held_.size() * (2 * sizeof(void*) + 1) + static_cast<std::size_t>(held) * sizeof(Codes);
}

}  // namespace burin::compute
