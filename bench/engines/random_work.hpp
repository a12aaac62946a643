// SPDX-License-Identifier: MIT
// Random tools and moves for a solid, the same on every machine for a seed. Tools lie in and around the lattice, often
// exactly on its nodes or half-way between them, where rays are tangent and faces coincide.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "bench/measure/split_mix.hpp"
#include "compute/rays/lattice.hpp"
#include "compute/rays/solid.hpp"
#include "compute/tools/tool.hpp"

namespace burin::bench {

// The tools, in the order of the alternatives of compute::ToolShape; a ball that smooths, which no device does; and
// steps through the history.
enum class RandomKind : std::uint8_t { ball, cylinder, cone, bullnose, box, mesh, smoothing, undo, redo };
inline constexpr std::size_t kRandomKinds = 9;
[[nodiscard]] std::string name_of(RandomKind kind);

// One step of the sequence: updates of one kind. More than one: they are begun without waiting.
struct RandomStep {
    RandomKind kind = RandomKind::ball;
    std::vector<std::vector<compute::ToolSweep>> updates;  // none of undo and redo
    bool ends_stroke = false;
};

class RandomWork {
public:
    explicit RandomWork(std::uint64_t seed) : numbers_(seed) {}
    // Makes a block or a ball with the materials 0 to 3. Fails on a resolution that is out of range.
    [[nodiscard]] Result<compute::Solid> solid(int resolution);
    // Fails where a mesh tool cannot be made, which is a fault of this class.
    [[nodiscard]] Result<RandomStep> step(const compute::Lattice& lattice);

private:
    [[nodiscard]] double between(double lo, double hi) { return lo + (hi - lo) * 0.5 * (numbers_.signed_unit() + 1.0); }
    [[nodiscard]] bool chance(double share) { return between(0.0, 1.0) < share; }
    [[nodiscard]] int whole(int lo, int hi) { return lo + static_cast<int>(between(0.0, hi - lo + 1)); }
    [[nodiscard]] RandomKind kind();
    [[nodiscard]] double size_m(const compute::Lattice& lattice);
    [[nodiscard]] Vec3 place(const compute::Lattice& lattice);
    [[nodiscard]] Quat orientation();
    [[nodiscard]] Result<compute::ToolShape> shape(RandomKind kind, double size_m);
    [[nodiscard]] Result<compute::ToolSweep> sweep(RandomKind kind, const compute::Lattice& lattice);

    SplitMix numbers_;
    RandomKind last_ = RandomKind::ball;
};

}  // namespace burin::bench
