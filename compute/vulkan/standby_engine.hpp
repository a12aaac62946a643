// SPDX-License-Identifier: MIT
// The Vulkan engine with the processor's standing by: what a device cannot do, or can no longer do, the processor goes
// on with, from the host's solid.
//
// Data flow: an update goes to the Vulkan engine, and is kept until it is taken. When that engine fails, its host's
// solid is as after the last update that was taken (engine.hpp); the processor's engine takes this solid over and
// begins the updates again that were kept. Both give the same ends, so nothing shows of it but one notice for the user.
// Where another device is offered (hear_offers), the next update is begun there, with another notice; after kMostLosses
// devices the processor stays.
// Thread: that of the engines; the pool must outlive the engine.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <variant>
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
    // Returns the work of the devices that there have been, also after they were given up.
    [[nodiscard]] std::optional<DeviceTraffic> traffic() const override;

    void make_cells() override;

    // The device's engine; null while the processor carves.
    [[nodiscard]] VulkanEngine* on_device() { return on_device_; }

private:
    void give_up_device(const Error& why);
    void let_the_processor_carve(Solid solid, const Error& why);
    void take_an_offer();

    WorkerPool& pool_;
    std::unique_ptr<CarvingEngine> engine_;
    VulkanEngine* on_device_ = nullptr;  // engine_, while that is the device's
    // Updates that the device was given and that were not taken.
    std::deque<std::variant<std::vector<ToolSweep>, RayBatch>> kept_;
    Ticket begun_ = 0, taken_before_ = 0;        // in all; of engines before this one
    std::optional<DeviceTraffic> last_traffic_;  // of devices that were given up
    std::shared_ptr<OfferedDevice> offered_;     // null: none is
    int losses_ = 0;
    bool makes_cells_ = false;
    std::vector<std::string> notices_;
};

}  // namespace burin::compute
