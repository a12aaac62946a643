// SPDX-License-Identifier: MIT
// The Vulkan engine with the processor's standing by: what a device cannot do, or can no longer do, the processor goes
// on with, from the host's solid.
//
// Data flow: carve, assign -> the Vulkan engine. When that fails its host's solid is as it was before the call
// (engine.hpp); the processor's engine takes this solid over and does the call again. Both give the same ends, so
// nothing shows of it but one notice for the user. Where another device is offered (hear_offers), the next call is done
// there, with another notice; after kMostLosses devices the processor stays.
// The host's solid lacks deferred cuts that were not read back (device_surface.hpp): whoever defers cuts has to do them
// again after give_up_device().
// Thread: that of the engines; the pool must outlive the engine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compute/vulkan/offered_device.hpp"
#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute {

class StandbyEngine final : public CarvingEngine {
public:
    static constexpr int kMostLosses = 3;

    // Carves on the device from the beginning, or, where that cannot hold the solid, on the processor, with a notice.
    StandbyEngine(Solid solid, const gpu::Device& device, WorkerPool& pool, const VulkanEngineOptions& options = {});
    // Carves on the processor from the beginning, and says why no device does.
    StandbyEngine(Solid solid, const Error& why, WorkerPool& pool);

    // Has an engine that has lost its device go on with what is offered there; null: with the processor.
    void hear_offers(std::shared_ptr<OfferedDevice> offered);

    // "cpu" while the processor carves.
    [[nodiscard]] const char* name() const override { return engine_->name(); }
    [[nodiscard]] Result<CarveStats> carve(std::span<const BallSweep> sweeps) override;
    [[nodiscard]] Result<CarveStats> assign(const RayBatch& rays) override;
    [[nodiscard]] const Solid& solid() const override { return engine_->solid(); }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return engine_->add_material(material);
    }
    [[nodiscard]] Changes take_changes() override;
    [[nodiscard]] std::vector<std::string> take_notices() override;
    // Returns the work of the devices that there have been, also after they were given up.
    [[nodiscard]] std::optional<DeviceTraffic> traffic() const override;

    // Has no effect while the processor carves.
    [[nodiscard]] std::unique_ptr<MeshingDevice> mesh_on_device() override;
    void give_up_device(const Error& why) override;

    // The device's engine; null while the processor carves.
    [[nodiscard]] VulkanEngine* on_device() { return on_device_; }

private:
    void let_the_processor_carve(Solid solid, const Error& why);
    void take_an_offer();

    WorkerPool& pool_;
    std::unique_ptr<CarvingEngine> engine_;
    VulkanEngine* on_device_ = nullptr;          // engine_, while that is the device's
    Changes before_;                             // of engines before this one, not taken when they ended
    std::optional<DeviceTraffic> last_traffic_;  // of devices that were given up
    std::shared_ptr<OfferedDevice> offered_;     // null: none is
    int losses_ = 0;
    std::vector<std::string> notices_;
};

}  // namespace burin::compute
