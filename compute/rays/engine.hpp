// SPDX-License-Identifier: MIT
// Interface of the carving engines, which hold a tri-dexel solid and change its rays. There are two: one runs native
// code on all cores, the other Vulkan compute (compute/vulkan/). Both give the same ends on every ray, to the last bit.
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

namespace burin::geometry {
struct LocalSurface;
}

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

// An engine's device that carves and meshes by itself, ahead of the host's solid: only the triangles near the tool come
// back with each cut (compute/vulkan/device_surface.hpp). After an Error of any call the device is to be given up, and
// what it has carved since the last read_back() to be carved again. Thread: that of the engine, which must outlive it
// and must not be called between carve() and finish().
class MeshingDevice {
public:
    // The ball around the tool whose triangles are gathered.
    struct Ball {
        Vec3 center_object{0.0};
        double radius_m = 0.0;
    };
    // Work done since the device began to mesh.
    struct Counts {
        std::uint64_t submissions = 0;
        std::uint64_t tiles = 0;      // tiles meshed
        std::uint64_t cells = 0;      // cells whose vertices were computed
        std::uint64_t triangles = 0;  // triangles made
        std::uint64_t growths = 0;    // enlarged buffers, because a tile had to wait
    };
    // Time spent on the device since the last carve, in seconds.
    struct Times {
        double cut_s = 0.0, mesh_s = 0.0, gather_s = 0.0;
    };

    virtual ~MeshingDevice() = default;
    // Carves and meshes, without waiting for the device, and gathers the triangles in `touched` in the same
    // submission: local_surface() will be called for them. Waits for the previous cut, if that is not finished.
    [[nodiscard]] virtual Result<void> carve(std::span<const BallSweep> sweeps, const std::optional<Ball>& touched) = 0;
    // Waits until the surface matches the device's solid.
    [[nodiscard]] virtual Result<void> finish() = 0;
    // Sets `out` to the triangles of the ball as loose triangles, ready for contact; finishes first. `sequence` and
    // `made_ns` of `out` are left unchanged.
    [[nodiscard]] virtual Result<void> local_surface(const Vec3& center_object, double radius_m,
                                                     geometry::LocalSurface& out) = 0;
    // Brings the engine's solid on the host up to date with the device's.
    [[nodiscard]] virtual Result<void> read_back() = 0;
    [[nodiscard]] virtual const Counts& counts() const = 0;
    // Returns nothing where the device cannot measure time.
    [[nodiscard]] virtual const std::optional<Times>& times() const = 0;
    // Returns the statistics of the last carve, once that is finished.
    [[nodiscard]] virtual const CarveStats& carved() const = 0;
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
    // Adds a material to the engine's solid, as add_material in solid.hpp does. A MeshingDevice knows only the
    // materials that existed when it was made.
    [[nodiscard]] virtual Result<std::uint8_t> add_material(const geometry::Material& material) = 0;
    // Returns what changed since the last call or, at the first call, since the engine was made.
    [[nodiscard]] virtual Changes take_changes() = 0;
    // Returns what the user should know of, since the last call: that the processor goes on for a device
    // (compute/vulkan/standby_engine.hpp).
    [[nodiscard]] virtual std::vector<std::string> take_notices() { return {}; }
    // Lets the engine's device mesh as well. Null where it has none, or one that cannot.
    [[nodiscard]] virtual std::unique_ptr<MeshingDevice> mesh_on_device() { return nullptr; }
    // Lets the processor go on from the host's solid where a device has carved so far, with a notice of why. The
    // MeshingDevice must be gone.
    virtual void give_up_device(const Error&) {}
    // Returns the work of the engine's device; nothing for an engine that never had one.
    [[nodiscard]] virtual std::optional<DeviceTraffic> traffic() const { return std::nullopt; }
};

// The pool must outlive the engine.
[[nodiscard]] std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool);

}  // namespace burin::compute
