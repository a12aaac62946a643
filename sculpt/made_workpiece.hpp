// SPDX-License-Identifier: MIT
// A workpiece from its options to where it can be carved: read, checked, converted, meshed. Lengths in metres, object
// frame. Any thread; what is made belongs to one thread at a time.
#pragma once

#include <memory>
#include <string>

#include "sculpt/sculpture.hpp"
#include "sculpt/workpiece.hpp"

namespace burin::sculpt {

struct MadeWorkpiece {
    std::unique_ptr<WorkerPool> pool;  // of the carving, which works with it
    LoadedWorkpiece loaded;            // its solid is the carving's
    compute::Lattice lattice;
    std::unique_ptr<Sculpture> carving;
};

// Makes the workpiece ready; threads: of the pool, as WorkerPool counts them.
[[nodiscard]] Result<MadeWorkpiece> make_workpiece(const WorkpieceOptions& options, EngineChoice engine,
                                                   unsigned threads, const LoadWatch& watch = {});

}  // namespace burin::sculpt
