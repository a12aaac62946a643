// SPDX-License-Identifier: MIT
#include "compute/vulkan/standby_engine.hpp"

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

Result<CarveStats> StandbyEngine::carve(std::span<const BallSweep> sweeps) {
    if (on_device_ != nullptr) {
        const auto carved = on_device_->carve(sweeps);
        if (carved || !capsules_in_units(solid(), sweeps)) return carved;  // what is invalid is so for either engine
        give_up_device(carved.error());
    }
    return engine_->carve(sweeps);
}

Result<CarveStats> StandbyEngine::assign(const RayBatch& rays) {
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
    before_ = on_device_->take_changes();
    last_traffic_ = on_device_->traffic();
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

}  // namespace burin::compute
