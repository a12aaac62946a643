// SPDX-License-Identifier: MIT
// Interface of the carving engines, which hold a tri-dexel solid and change its rays. There are two: one runs native
// code on all cores, the other Vulkan compute (compute/vulkan/). Both give the same ends on every ray, to the last bit.
//
// Data flow of an update: begin() is given sweeps of tools, or rays with the ends that they are to hold, and waits for
// nothing. take() gives what the oldest update that is done has changed, as a Delta: from it the surface is updated
// (compute/mesher/surface.hpp), strokes are undone (history.hpp) and documents saved. The processor works when it is
// asked for the result, and so always has it; a device works meanwhile. The solid on the host is always the one after
// the last update that was taken, so that how late updates are taken is all that tells the engines apart.
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
#include "compute/mesher/made_cells.hpp"
#include "compute/rays/carve_stats.hpp"
#include "compute/rays/ray_batch.hpp"
#include "compute/rays/solid.hpp"
#include "compute/tools/ball_sweep.hpp"
#include "compute/tools/tool.hpp"

namespace burin::compute {

// Counts submissions, waits and bytes that cross over, of an engine's device since it was opened, and the most of its
// memory that was held at once (gpu::WorkAsked).
struct DeviceTraffic {
    std::uint64_t submissions = 0, blocking_waits = 0, bytes_to_device = 0, bytes_to_host = 0, most_memory_bytes = 0;
    std::uint64_t bytes_written_to_host = 0;  // of those to the host: by shaders, without a copy
};

// Counts the updates of an engine: the first that was begun is 1.
using Ticket = std::uint64_t;

// Tells what an update has changed, or several that a device has carried out as one.
struct Delta {
    Ticket ticket = 0;  // of the last of them
    CarveStats stats;
    Changes changes;  // what the rays held before; solid() has what they hold now
    // The cells of the surface around these rays, where a device has made them (make_cells).
    std::optional<MadeCells> made;
};

// Says how long a device is waited for: not at all; as long as it usually takes, 2 ms at most; until it is done.
enum class Wait : std::uint8_t { no, briefly, yes };
constexpr std::uint64_t kBriefly_ns = 2'000'000;

class CarvingEngine {
public:
    virtual ~CarvingEngine() = default;
    [[nodiscard]] virtual const char* name() const = 0;  // "cpu" or "vulkan"

    // ---- Updates. An Error of a device forgets all updates that were not taken; solid() then is the one after the
    // last that was. StandbyEngine (compute/vulkan/standby_engine.hpp) begins them again, with the processor.

    // Begins to carry out the sweeps, in order. Fails, and begins nothing, where check_tool (compute/tools/apply.hpp)
    // refuses one of them. A sweep that does not reach the lattice has no effect, and filled material is clipped to the
    // lattice.
    [[nodiscard]] virtual Result<Ticket> begin(std::span<const ToolSweep> sweeps) = 0;
    // Begins to replace the ends of the batch's rays. The ends must be well formed (solid.hpp) and lie within the
    // lattice.
    [[nodiscard]] virtual Result<Ticket> begin(RayBatch rays) = 0;
    // Takes the oldest update, if it is done; a device that is late may have carried out some together. With Wait::yes
    // takes the oldest one alone. Returns nothing where none is done.
    [[nodiscard]] virtual Result<std::optional<Delta>> take(Wait wait) = 0;
    // Returns how many updates were begun and not taken.
    [[nodiscard]] virtual std::size_t under_way() const = 0;
    [[nodiscard]] virtual const Solid& solid() const = 0;

    // ---- Updates at once, for whoever has nothing else to do meanwhile. take_changes() returns what they have changed
    // since it was last called.

    [[nodiscard]] Result<CarveStats> carve(std::span<const ToolSweep> sweeps);
    [[nodiscard]] Result<CarveStats> carve(std::span<const BallSweep> sweeps);
    [[nodiscard]] Result<CarveStats> assign(const RayBatch& rays);
    [[nodiscard]] virtual Changes take_changes() { return gathered_.take(); }

    // Adds a material to the engine's solid, as add_material in solid.hpp does.
    [[nodiscard]] virtual Result<std::uint8_t> add_material(const geometry::Material& material) = 0;
    // Has the engine's device make the cells of the surface as well that updates can have altered, from the next one
    // on, where it can: take() gives them. Without a device whoever follows the updates makes them.
    virtual void make_cells() {}
    // Returns what the user should know of, since the last call: that the processor goes on for a device
    // (compute/vulkan/standby_engine.hpp).
    [[nodiscard]] virtual std::vector<std::string> take_notices() { return {}; }
    // Returns the work of the engine's device; nothing for an engine that never had one.
    [[nodiscard]] virtual std::optional<DeviceTraffic> traffic() const { return std::nullopt; }

protected:
    // Puts changes that came outside of any update before those of the next call of take_changes().
    void gather(const Changes& changes) { gathered_.append(changes); }

private:
    [[nodiscard]] Result<CarveStats> take_all();

    Changes gathered_;
};

// The pool must outlive the engine.
[[nodiscard]] std::unique_ptr<CarvingEngine> make_cpu_engine(Solid solid, WorkerPool& pool);

}  // namespace burin::compute
