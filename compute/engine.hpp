// SPDX-License-Identifier: MIT
// The carving engine: holds a tri-dexel solid and changes its rays. Two kinds behind one interface: native code on all cores,
// and Vulkan compute. Both give the same ends on every ray, to the last bit.
//
// Data flow of a ball's sweep: segments of the stroke in metres -> capsules in lattice units -> each ray in a capsule's
// footprint loses, gains or recolours a span. Everything else a tool can do is worked out on the host, ray by ray
// (compute/apply.hpp), and assigned. Either way the engine keeps a record of the rays that changed and of what they held, from
// which the surface is brought up to date (surface.hpp) and strokes are undone (history.hpp).
// One thread calls an engine. Work it hands to other threads is finished when the call returns.
#pragma once

#include <memory>
#include <span>

#include "base/worker_pool.hpp"
#include "compute/ray_batch.hpp"
#include "compute/solid.hpp"
#include "compute/tool.hpp"

namespace burin {

namespace gpu {
class Device;
}

// A ball of radius_m that moves from start to end (object frame, metres); start == end is a stamp.
struct BallSweep {
    Vec3 start_object_m{0.0};
    Vec3 end_object_m{0.0};
    double radius_m = 0.0;
    std::uint8_t material = 0;             // what the surface it leaves is made of; an index into Solid::materials
    Operation operation = Operation::cut;  // cut, fill or paint
};

struct CarveStats {
    std::uint64_t rays_touched = 0;  // that the tool covers a part of, and that hold material if it does not fill
    std::uint64_t rays_changed = 0;  // whose ends are different afterwards
    CarveStats& operator+=(const CarveStats& other) {
        rays_touched += other.rays_touched;
        rays_changed += other.rays_changed;
        return *this;
    }
};

class CarvingEngine {
public:
    virtual ~CarvingEngine() = default;
    [[nodiscard]] virtual const char* name() const = 0;  // "cpu" or "vulkan"
    // Carries the sweeps out in order. Every sweep must be finite with a radius above zero; one that does not reach the
    // lattice does nothing; what is filled ends where the lattice ends. Fails on a sweep that cannot be, or when the device
    // does; the solid is then as before the call.
    [[nodiscard]] virtual Result<CarveStats> carve(std::span<const BallSweep> sweeps) = 0;
    // The rays of the batch hold its ends from now on. The ends must be well formed (solid.hpp) and lie within the lattice.
    [[nodiscard]] virtual Result<CarveStats> assign(const RayBatch& rays) = 0;
    // Up to date when a call returns.
    [[nodiscard]] virtual const Solid& solid() const = 0;
    // As add_material (solid.hpp), of the engine's solid. A DeviceSurface knows the materials that were there when it was made.
    [[nodiscard]] virtual Result<std::uint8_t> add_material(const Material& material) = 0;
    // What has changed since this was last called; nothing at the start.
    [[nodiscard]] virtual Changes take_changes() = 0;
};

// The pool must outlive the engine.
[[nodiscard]] std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool);
// Fails, with the remedy, where the device cannot run it: no 64-bit integers or doubles in shaders, or buffers too small for
// the solid. The engine keeps the device open; the device's thread is the engine's (vulkan_engine.hpp).
[[nodiscard]] Result<std::unique_ptr<CarvingEngine>> make_vulkan_engine(Solid solid, gpu::Device& device);

}  // namespace burin
