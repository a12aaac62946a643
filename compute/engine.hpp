// SPDX-License-Identifier: MIT
// The carving engine: applies strokes to a tri-dexel solid. Two kinds behind one interface: native code on all cores, and
// Vulkan compute. Both give the same ends on every ray, to the last bit.
//
// Data flow of a cut: segments of the stroke in metres -> capsules in lattice units -> each ray in a capsule's footprint
// loses a span -> the tiles around the changed depths are marked for re-meshing (surface.hpp).
// One thread calls an engine. Work it hands to other threads is finished when the call returns.
#pragma once

#include <memory>
#include <span>

#include "base/worker_pool.hpp"
#include "compute/solid.hpp"
#include "compute/tile_grid.hpp"

namespace burin {

namespace gpu {
class Device;
}

// A ball of radius_m that moves from start to end (object frame, metres); start == end is a stamp.
struct BallSweep {
    Vec3 start_object_m{0.0};
    Vec3 end_object_m{0.0};
    double radius_m = 0.0;
    std::uint8_t material = 0;  // what the cut surface is made of; an index into Solid::materials
};

struct CutStats {
    std::uint64_t rays_touched = 0;  // in the footprint of a capsule
    std::uint64_t rays_changed = 0;  // whose ends are different afterwards
};

class CarvingEngine {
public:
    virtual ~CarvingEngine() = default;
    [[nodiscard]] virtual const char* name() const = 0;  // "cpu" or "vulkan"
    // Takes the material out of the sweeps, in order. Every sweep must be finite with a radius above zero; one that does not
    // reach the lattice does nothing. Fails only when the device does; the solid is then as before the call.
    [[nodiscard]] virtual Result<CutStats> cut(std::span<const BallSweep> sweeps) = 0;
    // Up to date when cut returns.
    [[nodiscard]] virtual const Solid& solid() const = 0;
    // Tiles changed since they were last taken. At the start all are marked.
    [[nodiscard]] virtual DirtyTiles& dirty_tiles() = 0;
};

// The pool must outlive the engine.
[[nodiscard]] std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool);
// Fails, with the remedy, where the device cannot run it: no 64-bit integers or doubles in shaders, or buffers too small for
// the solid. The engine keeps the device open; the device's thread is the engine's (vulkan_engine.hpp).
[[nodiscard]] Result<std::unique_ptr<CarvingEngine>> make_vulkan_engine(Solid solid, gpu::Device& device);

}  // namespace burin
