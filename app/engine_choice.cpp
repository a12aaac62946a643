// SPDX-License-Identifier: MIT
#include "app/engine_choice.hpp"

#include "gpu/device.hpp"

namespace burin {
namespace {

ChosenEngine native(Solid solid, WorkerPool& pool, std::string reason) {
    return {make_cpu_engine(std::move(solid), pool), std::to_string(pool.threads()) + " threads", std::move(reason)};
}

Result<ChosenEngine> on_vulkan(Solid solid, gpu::Device& device, std::string reason) {
    auto engine = make_vulkan_engine(std::move(solid), device);
    if (!engine) return std::unexpected(engine.error());
    return ChosenEngine{std::move(*engine), device.info().name, std::move(reason)};
}

}  // namespace

Result<ChosenEngine> choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool) {
    if (choice == EngineChoice::cpu) return native(std::move(solid), pool, "");
    Result<gpu::Device> device = gpu::Device::create();
    if (choice == EngineChoice::vulkan) {
        if (!device) return std::unexpected(device.error());
        return on_vulkan(std::move(solid), *device, "");
    }
    if (!device) return native(std::move(solid), pool, "no Vulkan device");
    if (device->info().is_software()) return native(std::move(solid), pool, "the only Vulkan device is a software one");
    const gpu::Capabilities& can = device->capabilities();
    if (!can.shader_int64 || !can.shader_float64) {
        return native(std::move(solid), pool, "the Vulkan device lacks 64-bit shader arithmetic");
    }
    return on_vulkan(std::move(solid), *device, "a hardware Vulkan device");
}

}  // namespace burin
