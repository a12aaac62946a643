// SPDX-License-Identifier: MIT
// --engine auto|cpu|vulkan: which carving engine works on the solid.
#pragma once

#include <memory>
#include <string>

#include "app/sculpt.hpp"
#include "compute/engine.hpp"

namespace burin {

struct ChosenEngine {
    std::unique_ptr<CarvingEngine> engine;
    std::string device;  // the Vulkan device, or how many threads
    std::string reason;  // why automatic chose it; empty when asked for
};

// automatic takes Vulkan on a hardware device that has what the engine needs, else the native engine: compute shaders on a
// software device cost many times the native code. The pool must outlive the engine.
[[nodiscard]] Result<ChosenEngine> choose_engine(EngineChoice choice, Solid solid, WorkerPool& pool);

}  // namespace burin
