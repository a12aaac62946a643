// SPDX-License-Identifier: MIT
// Makes the engine that --engine names: on a Vulkan device, or on the processor. Any thread.
#pragma once

#include "compute/rays/chosen_engine.hpp"

namespace burin::compute {

// Makes the engine. Automatic takes a Vulkan device that is hardware, else native code: on a software device compute
// shaders cost many times the native code. Where the device that is taken, or was asked for, cannot carve the solid,
// the processor does, and the engine's notices say so. The pool must outlive the engine.
[[nodiscard]] ChosenEngine choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool);
// Returns what makes it so.
[[nodiscard]] EngineMaker engine_maker(EngineChoice choice);

}  // namespace burin::compute
