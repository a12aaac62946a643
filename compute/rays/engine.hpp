// SPDX-License-Identifier: MIT
// Interface of the carving engines, which hold a tri-dexel solid and change its rays. There are two: one runs native
// code on all cores, the other Vulkan compute. Both give the same ends on every ray, to the last bit.
//
// Data flow of a ball's sweep: segments of the stroke in metres -> capsules in lattice units -> each ray in a capsule's
// footprint loses, gains or recolours a span. All other tools and operations are computed on the host, ray by ray
// (compute/tools/apply.hpp), and their result is assigned. In both cases the engine records which rays changed and what
// they held before; from this record the surface is updated (compute/mesher/surface.hpp) and strokes are undone
// (history.hpp).
// Thread: an engine is called from one thread. Work that it distributes to other threads is finished when the call
// returns.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/worker_pool.hpp"
#include "compute/rays/operation.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"

namespace burin::compute {

// A ball of radius_m that moves from start to end (object frame, metres); start == end is a stamp.
struct BallSweep {
    Vec3 start_object_m{0.0};
    Vec3 end_object_m{0.0};
    double radius_m = 0.0;
    // Material of the surface that the sweep leaves; an index into Solid::materials.
    std::uint8_t material = 0;
    Operation operation = Operation::cut;  // cut, fill or paint
};

struct CarveStats {
    // Number of rays of which the tool covers a part; except when filling, only rays that hold material count.
    std::uint64_t rays_touched = 0;
    std::uint64_t rays_changed = 0;  // number of rays whose ends differ afterwards
    CarveStats& operator+=(const CarveStats& other) {
        rays_touched += other.rays_touched;
        rays_changed += other.rays_changed;
        return *this;
    }
};

// Counts submissions, waits and copied bytes of an engine's device since it was opened, and the most of its memory that
// was held at once (gpu::WorkAsked).
struct DeviceTraffic {
    std::uint64_t submissions = 0, blocking_waits = 0, bytes_to_device = 0, bytes_to_host = 0, most_memory_bytes = 0;
};

class CarvingEngine {
public:
    virtual ~CarvingEngine() = default;
    [[nodiscard]] virtual const char* name() const = 0;  // "cpu" or "vulkan"
    // Carries out the sweeps in order. Every sweep must be finite and have a radius above zero; one that does not reach
    // the lattice has no effect, and filled material is clipped to the lattice. Fails on an invalid sweep or a device
    // error; the solid is then unchanged.
    [[nodiscard]] virtual Result<CarveStats> carve(std::span<const BallSweep> sweeps) = 0;
    // Replaces the ends of the batch's rays. The ends must be well formed (solid.hpp) and lie within the lattice.
    [[nodiscard]] virtual Result<CarveStats> assign(const RayBatch& rays) = 0;
    // Returns the solid, which is up to date after every call.
    [[nodiscard]] virtual const Solid& solid() const = 0;
    // Adds a material to the engine's solid, as add_material in solid.hpp does. A DeviceSurface knows only the
    // materials that existed when it was made.
    [[nodiscard]] virtual Result<std::uint8_t> add_material(const geometry::Material& material) = 0;
    // Returns what changed since the last call or, at the first call, since the engine was made.
    [[nodiscard]] virtual Changes take_changes() = 0;
    // Returns what the user should know of, since the last call: that the processor goes on for a device
    // (compute/vulkan/standby_engine.hpp).
    [[nodiscard]] virtual std::vector<std::string> take_notices() { return {}; }
    // Returns the work of the engine's device; nothing for an engine that never had one.
    [[nodiscard]] virtual std::optional<DeviceTraffic> traffic() const { return std::nullopt; }
};

// The pool must outlive the engine.
[[nodiscard]] std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool);
// Adds the other engine to the remedies of a failure of this one. Of gpu/ alone it is no remedy, since pictures are
// drawn by the GPU whichever engine carves.
[[nodiscard]] Error with_the_other_engine(Error failure);

}  // namespace burin::compute
