// SPDX-License-Identifier: MIT
// The carving engine on a Vulkan device.
//
// Data flow of an update: sweeps -> stages (flight.hpp): balls as capsules and work groups (vulkan_engine_tasks.hpp),
// other convex tools as pieces (covered_rays.hpp), what smooths as balls (smooth_passes.hpp) -> begin() submits work
// that changes the rays on the device and writes those that change, with their new ends, into the host's memory ->
// take() puts these into the host's solid, once the device has done all. Rays that found no space in the store, or used
// up their share of one pass, are continued in further submissions; usually there are none. One flight is under way at
// a time; updates that come meanwhile wait, and are carried out as one if the device is late. So nobody waits for the
// device, and the host's solid lags behind by as many updates as were not taken.
// What the device has no shader for, the host does when the update is taken (compute/tools/apply.hpp); so it does with
// rays that are assigned. The device is sent them before it is used again.
//
// The change of a ray is recorded once a stage, and once a ball that smooths, between the lowest and the highest depth
// that changed. After an Error, the next update sends the host's solid to the device anew.
//
// Cost on the device: one invocation a ray. Memory: vulkan_engine_memory.hpp.
// Thread: one, as gpu::Device.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compute/engine/engine.hpp"
#include "compute/vulkan/cell_maker.hpp"
#include "compute/vulkan/covered_rays.hpp"
#include "compute/vulkan/flight.hpp"
#include "compute/vulkan/vulkan_engine_memory.hpp"
#include "compute/vulkan/vulkan_engine_tasks.hpp"
#include "gpu/device.hpp"

namespace burin::compute {

// Initial sizes; all of them grow when needed. Tests choose small ones so that growth happens.
struct VulkanEngineOptions {
    // Free ends behind the solid's in the store; a fine solid gets more, and 0 means none.
    std::size_t spare_ends = 65536;
    std::uint32_t export_per_ray = 4;    // space for the ends of changed rays, per ray visited
    std::uint32_t tasks_a_pass = 16384;  // work groups of 64 rays
    std::uint32_t spans_a_ray = 1;       // space for what a tool covers, per ray visited; 0: for one span in all
    CellMakerOptions cells = {};
    std::uint32_t smooth_percent = 100;  // space for what smooths, of what a ball usually takes
    // The divisions and roots that tell whether the device rounds as the processor does; for tests.
    std::vector<CheckedRounding> roundings = hard_roundings();
};

// Ends of changed rays that one submission brings home; the rays beyond wait for the next.
constexpr std::uint64_t kMostExported = std::uint64_t{1} << 22;

// Work done since the engine was made.
struct VulkanEngineCounts {
    std::uint64_t cuts = 0;  // flights that reached the lattice
    std::uint64_t submissions = 0;
    std::uint64_t store_rebuilds = 0;  // because a ray found no space
    std::uint64_t balls_smoothed = 0;  // by the device
};

class VulkanEngine final : public CarvingEngine {
public:
    // Makes the engine and sends the solid to the device. Fails on a device without 64-bit integers, doubles or buffer
    // addresses in shaders, or without space for the solid, which then stays the caller's.
    // The pool must outlive the engine.
    [[nodiscard]] static Result<std::unique_ptr<VulkanEngine>> create(Solid&& solid, const gpu::Device& device,
                                                                      WorkerPool& pool,
                                                                      const VulkanEngineOptions& options = {});

    [[nodiscard]] const char* name() const override { return "vulkan"; }
    [[nodiscard]] Result<Ticket> begin(std::span<const ToolSweep> sweeps) override;
    [[nodiscard]] Result<Ticket> begin(RayBatch rays) override;
    [[nodiscard]] Result<std::optional<Delta>> take(Wait wait) override;
    [[nodiscard]] std::size_t under_way() const override { return static_cast<std::size_t>(begun_ - taken_); }
    [[nodiscard]] const Solid& solid() const override { return solid_; }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return burin::compute::add_material(solid_, material);
    }
    void make_cells() override;
    [[nodiscard]] std::vector<std::string> take_notices() override { return std::exchange(notices_, {}); }
    [[nodiscard]] std::optional<DeviceTraffic> traffic() const override {
        const gpu::WorkAsked asked = device_.asked();
        return DeviceTraffic{asked.submissions,       asked.blocking_waits,
                             asked.bytes_to_device,   asked.bytes_to_host + asked.bytes_written_to_host,
                             asked.most_memory_bytes, asked.bytes_written_to_host};
    }
    // Hands over the host's solid; afterwards the engine may only be destroyed.
    [[nodiscard]] Solid give_solid() { return std::move(solid_); }

    [[nodiscard]] const VulkanEngineCounts& counts() const { return counts_; }
    // Returns what has been made of the surface; nothing without make_cells().
    [[nodiscard]] CellMakerCounts made_cells() const { return maker_ ? maker_->counts() : CellMakerCounts{}; }

    [[nodiscard]] gpu::Device& device() { return device_; }
    // Sends the host's solid to the device if the device does not hold it, or the rays that were assigned since.
    [[nodiscard]] Result<void> synchronize();

private:
    // An update that waits; `rays` are assigned where there are no sweeps.
    struct Update {
        std::vector<ToolSweep> sweeps;
        RayBatch rays;
    };
    VulkanEngine(Solid solid, const gpu::Device& device, WorkerPool& pool, const VulkanEngineOptions& options);

    // ---- Updates (vulkan_engine_updates.cpp)
    void start(Wait alone);
    [[nodiscard]] bool is_for_device(const ToolSweep& sweep) const;
    void tell_what_is_not_covered(std::span<const ToolSweep> sweeps);
    [[nodiscard]] std::size_t for_device(std::span<const ToolSweep> sweeps) const;
    [[nodiscard]] Result<void> prepare(std::vector<ToolSweep> sweeps);
    [[nodiscard]] Result<void> prepare_patches();
    [[nodiscard]] Result<bool> add_stage(std::size_t first_sweep, std::size_t end_sweep);
    [[nodiscard]] Result<bool> add_smoothing(std::size_t of_sweep);
    [[nodiscard]] Result<void> advance(Wait wait);
    [[nodiscard]] Result<void> submit_passes();
    [[nodiscard]] Result<void> reserve_passes(std::uint64_t rays, std::uint64_t tasks);
    [[nodiscard]] Result<void> record(gpu::Commands& commands, const Pass& pass, shared::CutParameters parameters);
    void record_smoothing(gpu::Commands& commands, const Pass& pass, std::uint32_t ball,
                          const shared::CutParameters& parameters);
    [[nodiscard]] Result<void> end_submission();
    void send_for_cells(gpu::Commands& commands);
    void take_cells(const shared::CutCounters& counters);
    void leave_cells_to_host(const Error& why);
    [[nodiscard]] Result<void> end_uncovered(std::size_t done);
    [[nodiscard]] Result<Delta> land();
    [[nodiscard]] Result<Delta> carry_out_on_host();
    [[nodiscard]] Result<CarveStats> carry_out(std::span<const ToolSweep> sweeps, std::size_t first_ball,
                                               Changes& changes);
    [[nodiscard]] Result<CarveStats> cut_now(std::span<const ToolSweep> sweeps, Changes& changes);
    [[nodiscard]] Result<CarveStats> apply_one(const ToolSweep& sweep, std::size_t first_ball, Changes& changes);
    [[nodiscard]] std::uint64_t assign_rays(const RayBatch& rays, Changes& changes);
    [[nodiscard]] std::unexpected<Error> taken_back(const Changes& changes, const Error& why);
    [[nodiscard]] Error forgotten(const Error& why);

    [[nodiscard]] Result<void> send_assigned();
    [[nodiscard]] RayBatch take_assigned();
    [[nodiscard]] Result<void> patch(const RayBatch& rays);
    [[nodiscard]] std::size_t most_patches() const;
    [[nodiscard]] std::size_t most_patch_ends() const;
    [[nodiscard]] Result<void> reserve_patches(std::size_t rays, std::size_t ends);
    void record_patches(gpu::Commands& commands, std::span<const shared::PatchRay> rays,
                        std::span<const shared::DexelEnd> ends);
    [[nodiscard]] Result<void> check_longest() const;
    [[nodiscard]] shared::CutParameters parameters() const;
    void send_counters(gpu::Commands& commands);
    [[nodiscard]] Result<shared::CutCounters> counted(gpu::Commands commands);
    [[nodiscard]] Result<void> make_room_for(const shared::CutCounters& counters);
    void collect(const shared::CutCounters& counters);
    void apply_changes(Changes& changes);

    Solid solid_;
    gpu::Device device_;
    WorkerPool& pool_;
    VulkanEngineOptions options_;
    VulkanEngineCounts counts_;
    gpu::ComputePipeline cut_rays_, cut_covered_, patch_rays_;
    std::optional<CoveredRays> covered_;  // nothing where the device rounds otherwise than the processor
    std::unique_ptr<CellMaker> maker_;    // null where the host makes all cells
    std::optional<SmoothPasses> smooth_;  // made by the first sweep that smooths
    bool smooths_ = false;                // else the host smooths
    DeviceSolid device_solid_;
    // Set while the device holds the same ends as solid_, but for assigned_ and what is under way.
    bool synchronized_ = false;
    std::vector<std::uint32_t> assigned_;  // codes of rays that the host has and the device has not; some several times
    // Number of ends that are taken in the device's store.
    std::uint32_t used_ = 0;
    // Upper bound of the number of ends of a ray.
    std::uint32_t longest_ = 0;
    SharedBuffer capsules_{"capsules", SharedBuffer::Traffic::to_device};
    SharedBuffer tasks_{"cut tasks", SharedBuffer::Traffic::to_device};
    SharedBuffer order_{"capsule order", SharedBuffer::Traffic::to_device};
    SharedBuffer counters_{"cut counters", SharedBuffer::Traffic::both};
    SharedBuffer changed_{"changed rays", SharedBuffer::Traffic::in_place};
    SharedBuffer exported_{"changed ends", SharedBuffer::Traffic::in_place};
    SharedBuffer pending_buffer_{"pending rays", SharedBuffer::Traffic::none};
    SharedBuffer continued_{"continued rays", SharedBuffer::Traffic::none};
    SharedBuffer patches_{"patched rays", SharedBuffer::Traffic::to_device};
    SharedBuffer patch_ends_{"patch ends", SharedBuffer::Traffic::to_device};
    // Updates that were begun and not taken: one on the device, then those that wait.
    std::deque<Update> waiting_;
    std::optional<Flight> flight_;
    Ticket begun_ = 0, taken_ = 0;
    std::vector<std::string> notices_;
    std::optional<Error> no_cover_;  // why covered_ is nothing, until the first sweep for which that matters
    std::optional<Error> failure_;   // of starting an update, for the next take()
    // Changed rays of all passes of one cut; a ChangedRay's `first` counts from the start of new_ends_.
    std::vector<shared::ChangedRay> changed_rays_;
    std::vector<shared::DexelEnd> new_ends_;
};

// Sorts codes of rays, and leaves each once.
void keep_each_once(std::vector<std::uint32_t>& ray_codes);

// Adds the other engine to the remedies of a failure of this one. Of gpu/ alone it is no remedy, since pictures are
// drawn by the GPU whichever engine carves.
[[nodiscard]] Error with_the_other_engine(Error failure);

}  // namespace burin::compute
