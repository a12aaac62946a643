// SPDX-License-Identifier: MIT
#include "compute/vulkan/engine_choice.hpp"

#include <memory>
#include <string>
#include <utility>

#include "compute/vulkan/standby_engine.hpp"
#include "gpu/device.hpp"

namespace burin::compute {
namespace {

ChosenEngine native(Solid solid, WorkerPool& pool, std::string reason) {
    ChosenEngine chosen = on_processor(std::move(solid), pool);
    chosen.reason = std::move(reason);
    return chosen;
}

// Carves on the device, or on the processor with a notice of why not.
ChosenEngine on_vulkan(Solid solid, const gpu::Device& device, WorkerPool& pool, std::string reason) {
    auto engine = std::make_unique<StandbyEngine>(std::move(solid), device, pool);
    if (engine->on_device() == nullptr)
        return {std::move(engine), threads_of(pool), false, "the Vulkan device cannot carve this solid"};
    return {std::move(engine), device.info().name, device.info().is_software(), std::move(reason)};
}

}  // namespace

ChosenEngine choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool) {
    if (choice == EngineChoice::cpu) return native(std::move(solid), pool, "");
    const Result<gpu::Device> device = gpu::Device::create();
    if (choice == EngineChoice::vulkan) {
        if (device) return on_vulkan(std::move(solid), *device, pool, "");
        return {std::make_unique<StandbyEngine>(std::move(solid), device.error(), pool), threads_of(pool), false,
                "no Vulkan device"};
    }
    if (!device) return native(std::move(solid), pool, "no Vulkan device");
    if (device->info().is_software()) return native(std::move(solid), pool, "the only Vulkan device is a software one");
    return on_vulkan(std::move(solid), *device, pool, "a hardware Vulkan device");
}

EngineMaker engine_maker(EngineChoice choice) {
    return [choice](Solid solid, WorkerPool& pool) { return choose_engine(choice, std::move(solid), pool); };
}

}  // namespace burin::compute
