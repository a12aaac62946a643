// SPDX-License-Identifier: MIT
#include "compute/vulkan/engine_choice.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "compute/vulkan/standby_engine.hpp"

namespace burin::compute {
namespace {

ChosenEngine native(Solid solid, WorkerPool& pool, std::string reason) {
    ChosenEngine chosen = on_processor(std::move(solid), pool);
    chosen.reason = std::move(reason);
    return chosen;
}

// Carves on the device, or on the processor with a notice of why not.
ChosenEngine on_vulkan(Solid solid, const gpu::Device& device, WorkerPool& pool,
                       const std::shared_ptr<OfferedDevice>& offered, std::string reason) {
    auto engine = std::make_unique<StandbyEngine>(std::move(solid), device, pool);
    engine->hear_offers(offered);
    if (engine->on_device() == nullptr)
        return {std::move(engine), threads_of(pool), false, "the Vulkan device cannot carve this solid"};
    return {std::move(engine), device.info().name, device.info().is_software(), std::move(reason)};
}

}  // namespace

Result<gpu::Device> own_device() { return gpu::Device::create(); }

ChosenEngine choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool, const DeviceSource& source,
                           const std::shared_ptr<OfferedDevice>& offered) {
    if (choice == EngineChoice::cpu) return native(std::move(solid), pool, "");
    const Result<gpu::Device> device = source();
    if (choice == EngineChoice::vulkan) {
        if (device) return on_vulkan(std::move(solid), *device, pool, offered, "");
        return {std::make_unique<StandbyEngine>(std::move(solid), device.error(), pool), threads_of(pool), false,
                "no Vulkan device"};
    }
    if (!device) return native(std::move(solid), pool, "no Vulkan device");
    if (device->info().is_software()) return native(std::move(solid), pool, "the only Vulkan device is a software one");
    return on_vulkan(std::move(solid), *device, pool, offered, "a hardware Vulkan device");
}

EngineMaker engine_maker(EngineChoice choice) {
    return [choice](Solid solid, WorkerPool& pool) { return choose_engine(choice, std::move(solid), pool); };
}

EngineMaker engine_maker(EngineChoice choice, const DeviceSource& device, std::shared_ptr<OfferedDevice> offered) {
    if (choice == EngineChoice::cpu) return engine_maker(choice);
    const auto given = std::make_shared<std::optional<Result<gpu::Device>>>(device());
    return [choice, given, offered = std::move(offered)](Solid solid, WorkerPool& pool) {
        const auto once = [&given]() -> Result<gpu::Device> {
            if (!*given) return own_device();
            return *std::exchange(*given, std::nullopt);
        };
        return choose_engine(choice, std::move(solid), pool, once, offered);
    };
}

}  // namespace burin::compute
