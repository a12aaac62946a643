// SPDX-License-Identifier: MIT
// Makes the engine that --engine names: on a Vulkan device, or on the processor. Any thread.
#pragma once

#include <functional>
#include <memory>

#include "compute/engine/chosen_engine.hpp"
#include "compute/vulkan/offered_device.hpp"
#include "gpu/device.hpp"

namespace burin::compute {

// Gives the device that is to carve: one that is opened for it, or a lane of one that is there already and draws. It is
// called only where a device may carve, at most once for each engine.
using DeviceSource = std::function<Result<gpu::Device>()>;
[[nodiscard]] Result<gpu::Device> own_device();

// Makes the engine. Automatic takes a Vulkan device that is hardware, else native code: on a software device compute
// shaders cost many times the native code. Where the device that is taken, or was asked for, cannot carve the solid,
// the processor does, and the engine's notices say so. offered: where an engine that has lost its device looks for
// another; null: nowhere. The pool must outlive the engine.
[[nodiscard]] ChosenEngine choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool,
                                         const DeviceSource& device = own_device,
                                         const std::shared_ptr<OfferedDevice>& offered = nullptr);
// Returns what makes it so, on a device of its own.
[[nodiscard]] EngineMaker engine_maker(EngineChoice choice);
// Returns what makes one engine, on the device that the source gives now, on this thread. The maker may be called on
// another; one that is called again opens a device of its own, so that it holds none that its engine has given up.
[[nodiscard]] EngineMaker engine_maker(EngineChoice choice, const DeviceSource& device,
                                       std::shared_ptr<OfferedDevice> offered);

}  // namespace burin::compute
