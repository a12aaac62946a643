// SPDX-License-Identifier: MIT
// The surface of an engine's solid, followed twice: with the cells that its device has made, and with those that the
// processor makes of the same rays. Thread: one; the pool's threads work only within a call.
#pragma once

#include <cstdint>
#include <string>

#include "base/worker_pool.hpp"
#include "compute/engine/engine.hpp"
#include "compute/mesher/surface.hpp"

namespace burin::bench {

// Counts vertices and triangles of the tiles that an update has changed.
struct ComparedSurface {
    std::uint64_t elements = 0;
    std::uint64_t differ = 0;  // each element that one surface alone has, too
    std::string first;         // the first that differs; empty: there is none
};

class FollowedSurface {
public:
    FollowedSurface(const compute::Solid& solid, WorkerPool& pool);

    // Follows an update of the engine, whose solid is the one after it, and compares the tiles that it has changed.
    [[nodiscard]] ComparedSurface follow(const compute::Solid& solid, const compute::Delta& delta);
    // Follows changes that came outside of any update.
    void follow(const compute::Solid& solid, const compute::Changes& changes);

private:
    WorkerPool& pool_;
    compute::Surface by_device_, by_processor_;
};

}  // namespace burin::bench
