// SPDX-License-Identifier: MIT
// Which engine carves a solid, as --engine names it, and how one is made. Whoever opens a workpiece hands on an
// EngineMaker, so that what carves knows of no device. Any thread.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/worker_pool.hpp"
#include "compute/engine/engine.hpp"

namespace burin::compute {

enum class EngineChoice { automatic, cpu, vulkan };

struct ChosenEngine {
    std::unique_ptr<CarvingEngine> engine;
    std::string device;            // the Vulkan device, or the number of threads
    bool software_device = false;  // a Vulkan device without hardware
    std::string reason;            // why it was chosen; empty when it was asked for
};

// Makes the engine that carves this solid. The pool must outlive the engine.
using EngineMaker = std::function<ChosenEngine(Solid solid, WorkerPool& pool)>;

// Names the processor as a device: by its number of threads.
[[nodiscard]] std::string threads_of(const WorkerPool& pool);
// Makes the processor's engine. It is an EngineMaker, without its reason. Others are made by engine_maker()
// (compute/vulkan/engine_choice.hpp).
[[nodiscard]] ChosenEngine on_processor(Solid solid, WorkerPool& pool);

}  // namespace burin::compute
