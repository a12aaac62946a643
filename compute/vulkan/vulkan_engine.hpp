// SPDX-License-Identifier: MIT
// The carving engine on a Vulkan device.
//
// Data flow of a cut: sweeps -> capsules and work groups (vulkan_engine_tasks.hpp) -> one submission that cuts the rays
// on the device and lists the changed ones with their new ends -> only those are read back into the host's solid and
// recorded. Rays that found no space in the store, or used up their share of one pass, are continued in further
// submissions; usually there are none.
//
// The host's solid changes only when all passes are done: an Error leaves it unchanged, and the next cut sends it to
// the device anew. The change of a ray is recorded once, between the lowest and the highest depth that changed.
//
// A cut can also be deferred: recorded into the caller's commands, without a wait. The host's solid then lags behind
// the device's until read_back fetches the rays that differ; the device keeps a list of them, each once.
// Cost on the device: one invocation a ray. Memory: vulkan_engine_memory.hpp.
// Thread: one, as gpu::Device.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "compute/rays/engine.hpp"
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
};

// Work done since the engine was made.
struct VulkanEngineCounts {
    std::uint64_t cuts = 0;            // calls of carve and defer that reached the lattice
    std::uint64_t submissions = 0;     // each is waited for once
    std::uint64_t store_rebuilds = 0;  // because a ray found no space
};

class VulkanEngine final : public CarvingEngine {
public:
    // Makes the engine and sends the solid to the device. Fails on a device without 64-bit integers, doubles or buffer
    // addresses in shaders, or without space for the solid, which then stays the caller's.
    [[nodiscard]] static Result<std::unique_ptr<VulkanEngine>> create(Solid&& solid, const gpu::Device& device,
                                                                      const VulkanEngineOptions& options = {});

    [[nodiscard]] const char* name() const override { return "vulkan"; }
    [[nodiscard]] Result<CarveStats> carve(std::span<const BallSweep> sweeps) override;
    // Assigns the batch's rays, on the host alone. The device is sent them before it is used again: each once, in one
    // submission for all batches since, or more when the store is full.
    [[nodiscard]] Result<CarveStats> assign(const RayBatch& rays) override;
    // Returns the host's solid, which lags behind the device's after deferred cuts, until read_back.
    [[nodiscard]] const Solid& solid() const override { return solid_; }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return burin::compute::add_material(solid_, material);
    }
    [[nodiscard]] Changes take_changes() override { return changes_.take(); }
    [[nodiscard]] std::optional<DeviceTraffic> traffic() const override {
        const gpu::WorkAsked asked = device_.asked();
        return DeviceTraffic{asked.submissions, asked.blocking_waits, asked.bytes_to_device, asked.bytes_to_host,
                             asked.most_memory_bytes};
    }
    // Hands over the host's solid; afterwards the engine may only be destroyed.
    [[nodiscard]] Solid give_solid() { return std::move(solid_); }

    [[nodiscard]] const VulkanEngineCounts& counts() const { return counts_; }

    // A deferred cut, for callers that record commands of their own (device_surface.hpp). Call defer; then, while
    // deferred_left(): record_pass into commands, submit them and wait at any later time, end_pass. After each pass,
    // changed_rays() holds the rays that it finished; `changed` in counters() is their number, at most passed_rays().
    // Nothing else may be called on the engine in between. An Error loses the cuts deferred since the last read_back:
    // the next call sends the host's solid anew.
    [[nodiscard]] Result<void> defer(std::span<const BallSweep> sweeps);
    [[nodiscard]] bool deferred_left() const { return pending_ > 0 || next_task_ < deferred_tasks_.size(); }
    void record_pass(gpu::Commands& commands);
    [[nodiscard]] Result<void> end_pass();
    [[nodiscard]] const CarveStats& deferred_stats() const { return deferred_stats_; }  // since the last defer
    // Updates solid() from the device and records the changes, each ray at most once. Does nothing when nothing was
    // deferred.
    [[nodiscard]] Result<void> read_back();
    [[nodiscard]] std::uint32_t stale_rays() const { return stale_count_; }
    [[nodiscard]] const DeviceSolid& device_solid() const { return device_solid_; }
    [[nodiscard]] const gpu::Buffer& changed_rays() const { return changed_.buffer(); }
    [[nodiscard]] const gpu::Buffer& counters() const { return counters_.buffer(); }
    [[nodiscard]] std::uint32_t passed_rays() const { return passed_rays_; }
    [[nodiscard]] gpu::Device& device() { return device_; }
    // Sends the host's solid to the device if the device does not hold it, or the rays that were assigned since.
    [[nodiscard]] Result<void> synchronize();

private:
    VulkanEngine(Solid solid, const gpu::Device& device, const VulkanEngineOptions& options);
    [[nodiscard]] Result<void> send_assigned();
    [[nodiscard]] Result<void> patch(const RayBatch& rays);
    [[nodiscard]] Result<shared::CutCounters> fetch_stale(std::uint32_t first, std::uint32_t rays);
    [[nodiscard]] Result<CarveStats> cut_on_device(std::span<const shared::Capsule> capsules, const CutTasks& tasks);
    [[nodiscard]] Result<void> reserve(std::span<const shared::Capsule> capsules, const CutTasks& tasks);
    [[nodiscard]] Result<void> check_longest() const;
    [[nodiscard]] shared::CutParameters parameters() const;
    void send_counters(gpu::Commands& commands);
    [[nodiscard]] Result<shared::CutCounters> counted(gpu::Commands commands);
    void record_cut(gpu::Commands& commands, shared::CutParameters parameters, std::uint32_t task_count);
    [[nodiscard]] Result<shared::CutCounters> pass(std::uint32_t task_count, std::uint32_t pending);
    [[nodiscard]] std::uint32_t send_tasks(std::span<const shared::CutTask> tasks);
    [[nodiscard]] Result<void> make_room_for(const shared::CutCounters& counters);
    void collect(const shared::CutCounters& counters);
    void apply_changes();

    Solid solid_;
    gpu::Device device_;
    VulkanEngineOptions options_;
    VulkanEngineCounts counts_;
    gpu::ComputePipeline cut_rays_, patch_rays_, export_rays_;
    DeviceSolid device_solid_;
    // Set while the device holds the same ends as solid_, but for assigned_, or newer ones after deferred cuts.
    bool synchronized_ = false;
    std::vector<std::uint32_t> assigned_;  // codes of rays that the host has and the device has not; some several times
    // Number of ends that are taken in the device's store.
    std::uint32_t used_ = 0;
    // Upper bound of the number of ends of a ray.
    std::uint32_t longest_ = 0;
    // Bytes in use in the buffers below.
    std::size_t capsule_bytes_ = 0, task_bytes_ = 0, order_bytes_ = 0;
    SharedBuffer capsules_{"capsules", SharedBuffer::Traffic::to_device};
    SharedBuffer tasks_{"cut tasks", SharedBuffer::Traffic::to_device};
    SharedBuffer order_{"capsule order", SharedBuffer::Traffic::to_device};
    SharedBuffer counters_{"cut counters", SharedBuffer::Traffic::both};
    SharedBuffer changed_{"changed rays", SharedBuffer::Traffic::from_device};
    SharedBuffer exported_{"changed ends", SharedBuffer::Traffic::from_device};
    SharedBuffer pending_buffer_{"pending rays", SharedBuffer::Traffic::none};
    SharedBuffer continued_{"continued rays", SharedBuffer::Traffic::none};
    SharedBuffer stale_{"stale rays", SharedBuffer::Traffic::none};
    SharedBuffer patches_{"patched rays", SharedBuffer::Traffic::to_device};
    SharedBuffer patch_ends_{"patch ends", SharedBuffer::Traffic::to_device};
    // State of the deferred cut.
    std::vector<shared::CutTask> deferred_tasks_;
    std::size_t next_task_ = 0;
    std::uint32_t pending_ = 0, stale_count_ = 0, passed_rays_ = 0;
    CarveStats deferred_stats_;
    // Changed rays of all passes of one cut; a ChangedRay's `first` counts from the start of new_ends_.
    std::vector<shared::ChangedRay> changed_rays_;
    std::vector<shared::DexelEnd> new_ends_;
    Changes changes_;
};

// Adds the other engine to the remedies of a failure of this one. Of gpu/ alone it is no remedy, since pictures are
// drawn by the GPU whichever engine carves.
[[nodiscard]] Error with_the_other_engine(Error failure);

}  // namespace burin::compute
