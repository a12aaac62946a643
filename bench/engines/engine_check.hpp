// SPDX-License-Identifier: MIT
// burin bench engines: whether a Vulkan device carves what the processor carves, to the last bit.
//
// A seeded sequence of updates is carved by both engines, each with an undo history of its own: all tools and
// operations, stamps, straight and turning moves, undo and redo. A part of the updates is begun on the device several
// at once, so that it carries them out as one. After each update the rays that either engine has changed are compared;
// each solid ends with a comparison of all rays, and again when every stroke is undone. The device's rays that differ
// are then given the processor's ends, so that a fault counts for the tool that made it and not for those that follow.
// So are vertices and triangles of the surface that the device's cells make, with those of the processor's cells of the
// same rays (followed_surface.hpp).
// Thread: the caller's; the processor's engine carves on all cores.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/worker_pool.hpp"
#include "compute/engine/engine.hpp"

namespace burin::bench {

struct EngineCheckOptions {
    std::uint64_t seed = 1;
    std::size_t operations = 1000;        // updates, undo and redo
    int resolution = 64;                  // cells along the longest side of each solid
    unsigned threads = 0;                 // of the processor's engine; 0: one a core
    std::optional<unsigned> device = {};  // by its number in burin --version; none: the one that a session takes
};

// Counts what was compared after one kind of work, and how much of it differs.
struct ComparedWork {
    std::string name;  // "cone"
    std::uint64_t operations = 0;
    std::uint64_t submissions = 0;  // to the device; none where the host does this work for it
    std::uint64_t rays = 0, ends = 0;
    std::uint64_t ends_that_differ = 0;  // in depth, material or normal; each end that one engine alone has
    std::uint64_t elements = 0, elements_that_differ = 0;  // vertices and triangles of the tiles that changed
    ComparedWork& operator+=(const ComparedWork& other);
};

struct EngineCheck {
    EngineCheckOptions options;
    std::string device, driver;
    bool software_device = false;
    unsigned threads = 0;
    std::size_t solids = 0;                  // blocks and balls that were carved, one after the other
    std::vector<ComparedWork> work;          // the most differing ends, then elements, first
    ComparedWork all;                        // sum of work
    std::string first_difference;            // of ends; empty: there is none
    std::string first_element_that_differs;  // likewise
    std::vector<std::string> notices;        // of the device's engine, each once
    compute::DeviceTraffic traffic;          // of the whole run
};

// Makes the engine that is compared with the processor's, for each solid anew.
using MakeCompared = std::function<Result<std::unique_ptr<compute::CarvingEngine>>(compute::Solid, WorkerPool&)>;

// Fails where one of the engines fails. Leaves device and driver empty.
[[nodiscard]] Result<EngineCheck> compare_engines(const EngineCheckOptions& options, const MakeCompared& make);
// Compares the engine of a Vulkan device. Fails where there is none that can carve.
[[nodiscard]] Result<EngineCheck> check_device(const EngineCheckOptions& options);

// A line for each kind of work, and how it ends: that no end differs, or which is the first that does.
[[nodiscard]] std::string engine_check_table(const EngineCheck& check);
[[nodiscard]] Json engine_check_json(const EngineCheck& check);

}  // namespace burin::bench
