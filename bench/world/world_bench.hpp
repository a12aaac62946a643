// SPDX-License-Identifier: MIT
// burin bench world: how long it takes from the text of a VRML world to its triangles, beside Coin.
//
// The world is made here, or is a file: a thousand named nodes of 487 triangles each, in groups that are moved and
// turned, as exporters write them. The text is in memory; reading a disk is not measured. Coin reads the same file in a
// program of its own (bench/peers/coin_reader.cpp) right after each of ours, so that both meet the same machine:
// foreign files crash it, and burin does not depend on it. Times are CPU times of one thread: other work on the machine
// does not count.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"

namespace burin::bench {

struct WorldBenchTask {
    std::string world;                              // a .wrl; empty: one is made
    std::string folder;                             // where that is written for Coin, and removed again
    std::string coin;                               // the program that has Coin read a file; empty: none
    unsigned objects = 1000, triangles_each = 487;  // of the made world
    unsigned runs = 9;
};

struct CoinFigures {
    std::string version;
    std::size_t triangles = 0;
    std::vector<double> total_s;  // of each run
};

struct WorldBenchFigures {
    std::string world;
    std::size_t bytes = 0, nodes = 0, names = 0, triangles = 0;
    unsigned runs = 0;
    std::vector<double> read_s, shapes_s, total_s;  // of each run: to the syntax tree, from there to triangles, both
    std::optional<CoinFigures> coin;
    std::string without_coin;  // why there is none
};

// Returns the text of the made world.
[[nodiscard]] std::string made_world(unsigned objects, unsigned triangles_each);

// Returns the program that has Coin read a file, which is built beside burin where Coin is installed; empty: none.
[[nodiscard]] std::string coin_reader_beside_burin();

[[nodiscard]] Result<WorldBenchFigures> measure_world(const WorldBenchTask& task);
[[nodiscard]] std::string world_bench_table(const WorldBenchFigures& figures);
[[nodiscard]] Json world_bench_json(const WorldBenchFigures& figures);

}  // namespace burin::bench
