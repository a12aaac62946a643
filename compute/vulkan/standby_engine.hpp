// SPDX-License-Identifier: MIT
// The Vulkan engine with the processor's standing by: what a device cannot do, or can no longer do, the processor goes
// on with, from the host's solid.
//
// Data flow: an update goes to the Vulkan engine, and is kept until it is taken. When that engine fails, its host's solid
// is as after the last update that was taken (engine.hpp); the processor's engine takes this solid over and begins the
// updates again that were kept. Both give the same ends, so nothing shows of it but one notice for the user. There is no
// way back to the device.
// The host's solid lacks deferred cuts that were not read back (device_surface.hpp): whoever defers cuts has to do them
// again after give_up_device().
// Thread: that of the engines; the pool must outlive the engine.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute {

class StandbyEngine final : public CarvingEngine {
public:
    // Carves on the device from the beginning, or, where that cannot hold the solid, on the processor, with a notice.
    StandbyEngine(Solid solid, const gpu::Device& device, WorkerPool& pool, const VulkanEngineOptions& options = {});
    // Carves on the processor from the beginning, and says why no device does.
    StandbyEngine(Solid solid, const Error& why, WorkerPool& pool);

    // "cpu" once the processor carves.
    [[nodiscard]] const char* name() const override { return engine_->name(); }
    [[nodiscard]] Result<Ticket> begin(std::span<const ToolSweep> sweeps) override;
    [[nodiscard]] Result<Ticket> begin(RayBatch rays) override;
    [[nodiscard]] Result<std::optional<Delta>> take(Wait wait) override;
    [[nodiscard]] std::size_t under_way() const override { return engine_->under_way(); }
    [[nodiscard]] const Solid& solid() const override { return engine_->solid(); }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return engine_->add_material(material);
    }
    [[nodiscard]] Changes take_changes() override;
    [[nodiscard]] std::vector<std::string> take_notices() override;
    // Returns the work of the device, also after it was given up.
    [[nodiscard]] std::optional<DeviceTraffic> traffic() const override {
        return on_device_ != nullptr ? on_device_->traffic() : last_traffic_;
    }

    // Has no effect once the processor carves.
    [[nodiscard]] std::unique_ptr<MeshingDevice> mesh_on_device() override;
    void give_up_device(const Error& why) override;

    // The device's engine; null once the processor carves.
    [[nodiscard]] VulkanEngine* on_device() { return on_device_; }

private:
    void let_the_processor_carve(Solid solid, const Error& why);

    WorkerPool& pool_;
    std::unique_ptr<CarvingEngine> engine_;
    VulkanEngine* on_device_ = nullptr;                                // engine_, while that is the device's
    std::deque<std::variant<std::vector<ToolSweep>, RayBatch>> kept_;  // that the device has and nobody has taken
    Ticket begun_ = 0;
    Ticket of_device_ = 0;  // the last update that was taken of the device, once the processor carves
    std::optional<DeviceTraffic> last_traffic_;
    std::vector<std::string> notices_;
};

}  // namespace burin::compute
