// SPDX-License-Identifier: MIT
#include "compute/vulkan/standby_engine.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/try.hpp"

namespace burin::compute {

StandbyEngine::StandbyEngine(Solid solid, const gpu::Device& device, WorkerPool& pool,
                             const VulkanEngineOptions& options)
    : pool_(pool) {
    auto made = VulkanEngine::create(std::move(solid), device, pool, options);
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

Result<Ticket> StandbyEngine::begin(std::span<const ToolSweep> sweeps) {
    take_an_offer();
    BURIN_TRY_DO(engine_->begin(sweeps));
    if (on_device_ != nullptr) kept_.emplace_back(std::vector(sweeps.begin(), sweeps.end()));
    return ++begun_;
}

Result<Ticket> StandbyEngine::begin(RayBatch rays) {
    take_an_offer();
    if (on_device_ != nullptr) kept_.emplace_back(rays);
    BURIN_TRY_DO(engine_->begin(std::move(rays)));
    return ++begun_;
}

Result<std::optional<Delta>> StandbyEngine::take(Wait wait) {
    auto taken = engine_->take(wait);
    if (!taken && on_device_ != nullptr) {
        give_up_device(taken.error());
        taken = engine_->take(wait);
    }
    while (kept_.size() > engine_->under_way()) kept_.pop_front();
    if (taken && *taken) (*taken)->ticket += taken_before_;
    return taken;
}

Changes StandbyEngine::take_changes() {
    gather(engine_->take_changes());
    return CarvingEngine::take_changes();
}

std::vector<std::string> StandbyEngine::take_notices() {
    std::vector<std::string> notices = std::exchange(notices_, {});
    std::ranges::move(engine_->take_notices(), std::back_inserter(notices));
    return notices;
}

void StandbyEngine::make_cells() {
    makes_cells_ = true;
    engine_->make_cells();
}

void StandbyEngine::give_up_device(const Error& why) {
    gather(on_device_->take_changes());
    std::ranges::move(on_device_->take_notices(), std::back_inserter(notices_));
    last_traffic_ = traffic();
    ++losses_;
    if (offered_) offered_->hear(losses_ < kMostLosses);
    Solid solid = on_device_->give_solid();
    on_device_ = nullptr;
    engine_.reset();  // frees the device's memory first, which may be the host's
    let_the_processor_carve(std::move(solid), why);
    taken_before_ = begun_ - kept_.size();
    // Cannot fail: the sweeps were checked when they came.
    for (auto& work : std::exchange(kept_, {})) {
        if (auto* const rays = std::get_if<RayBatch>(&work))
            static_cast<void>(engine_->begin(std::move(*rays)));
        else
            static_cast<void>(engine_->begin(std::get<std::vector<ToolSweep>>(work)));
    }
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
    return DeviceTraffic{now->submissions + last_traffic_->submissions,
                         now->blocking_waits + last_traffic_->blocking_waits,
                         now->bytes_to_device + last_traffic_->bytes_to_device,
                         now->bytes_to_host + last_traffic_->bytes_to_host,
                         std::max(now->most_memory_bytes, last_traffic_->most_memory_bytes),
                         now->bytes_written_to_host + last_traffic_->bytes_written_to_host};
}

// The device gets a copy of the solid, so that the processor goes on with its own where that fails.
void StandbyEngine::take_an_offer() {
    if (!offered_ || on_device_ != nullptr || engine_->under_way() > 0) return;
    const std::optional<gpu::Device> lane = offered_->take();
    if (!lane) return;
    auto made = VulkanEngine::create(Solid(engine_->solid()), *lane, pool_);
    if (!made) {
        notices_.push_back(Error{made.error().what, made.error().where, ""}.line() + "; the processor goes on");
        return;
    }
    gather(engine_->take_changes());
    taken_before_ = begun_;
    on_device_ = made->get();
    engine_ = std::move(*made);
    if (makes_cells_) engine_->make_cells();
    notices_.push_back(lane->info().name + " carves again");
}

}  // namespace burin::compute
