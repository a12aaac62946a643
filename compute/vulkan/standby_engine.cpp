// SPDX-License-Identifier: MIT
#include "compute/vulkan/standby_engine.hpp"

#include <algorithm>
#include <utility>

#include "compute/tools/sweep_units.hpp"
#include "compute/vulkan/device_surface.hpp"

namespace burin::compute {

StandbyEngine::StandbyEngine(Solid solid, const gpu::Device& device, WorkerPool& pool,
                             const VulkanEngineOptions& options)
    : pool_(pool) {
    auto made = VulkanEngine::create(std::move(solid), device, options);
    if (!made) {
        let_the_processor_carve(std::move(solid), made.error());
        return;
    }
    on_device_ = made->get();
    engine_ = std::move(*made);
}

StandbyEngine::StandbyEngine(Solid solid, const Error& why, WorkerPool& pool) : pool_(pool) {
    let_the_processor_carve(std::move(solid), why);
}

void StandbyEngine::hear_offers(std::shared_ptr<OfferedDevice> offered) {
    offered_ = std::move(offered);
    if (offered_) offered_->hear(losses_ < kMostLosses);
}

Result<CarveStats> StandbyEngine::carve(std::span<const BallSweep> sweeps) {
    take_an_offer();
    if (on_device_ != nullptr) {
        const auto carved = on_device_->carve(sweeps);
        if (carved || !capsules_in_units(solid(), sweeps)) return carved;  // what is invalid is so for either engine
        give_up_device(carved.error());
    }
    return engine_->carve(sweeps);
}

Result<CarveStats> StandbyEngine::assign(const RayBatch& rays) {
    take_an_offer();
    if (on_device_ != nullptr) {
        const auto assigned = on_device_->assign(rays);
        if (assigned) return assigned;
        give_up_device(assigned.error());
    }
    return engine_->assign(rays);
}

Changes StandbyEngine::take_changes() {
    if (before_.empty()) return engine_->take_changes();
    Changes all = std::exchange(before_, {});
    all.append(engine_->take_changes());
    return all;
}

std::vector<std::string> StandbyEngine::take_notices() { return std::exchange(notices_, {}); }

std::unique_ptr<MeshingDevice> StandbyEngine::mesh_on_device() {
    // A device without this layout still carves, and the host meshes.
    if (on_device_ == nullptr || !on_device_->device().capabilities().scalar_block_layout) return nullptr;
    auto made = DeviceSurface::create(*on_device_);
    if (made) return std::move(*made);
    give_up_device(made.error());
    return nullptr;
}

void StandbyEngine::give_up_device(const Error& why) {
    if (on_device_ == nullptr) return;
    before_.append(on_device_->take_changes());
    last_traffic_ = traffic();
    ++losses_;
    if (offered_) offered_->hear(losses_ < kMostLosses);
    Solid solid = on_device_->give_solid();
    on_device_ = nullptr;
    engine_.reset();  // frees the device's memory first, which may be the host's
    let_the_processor_carve(std::move(solid), why);
}

void StandbyEngine::let_the_processor_carve(Solid solid, const Error& why) {
    engine_ = make_cpu_engine(std::move(solid), pool_);
    // A remedy is told only if it would bring the device back: to choose the processor is what happens anyway.
    const bool brings_it_back = !why.remedy.empty() && !why.remedy.contains("--engine cpu");
    notices_.push_back(Error{why.what, why.where, brings_it_back ? why.remedy : ""}.line() +
                       "; the processor carves instead, and nothing is lost");
}

std::optional<DeviceTraffic> StandbyEngine::traffic() const {
    if (on_device_ == nullptr) return last_traffic_;
    const auto now = on_device_->traffic();
    if (!now || !last_traffic_) return now;
    return DeviceTraffic{
        now->submissions + last_traffic_->submissions, now->blocking_waits + last_traffic_->blocking_waits,
        now->bytes_to_device + last_traffic_->bytes_to_device, now->bytes_to_host + last_traffic_->bytes_to_host,
        std::max(now->most_memory_bytes, last_traffic_->most_memory_bytes)};
}

// The device gets a copy of the solid, so that the processor goes on with its own where that fails.
void StandbyEngine::take_an_offer() {
    if (!offered_ || on_device_ != nullptr) return;
    const std::optional<gpu::Device> lane = offered_->take();
    if (!lane) return;
    auto made = VulkanEngine::create(Solid(engine_->solid()), *lane);
    if (!made) {
        notices_.push_back(Error{made.error().what, made.error().where, ""}.line() + "; the processor goes on");
        return;
    }
    before_.append(engine_->take_changes());
    on_device_ = made->get();
    engine_ = std::move(*made);
    notices_.push_back(lane->info().name + " carves again");
}

}  // namespace burin::compute
