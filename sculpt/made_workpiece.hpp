// SPDX-License-Identifier: MIT
// A workpiece from its options to where it can be carved: read, checked, converted, meshed. Lengths in metres, object
// frame. Any thread; what is made belongs to one thread at a time.
#pragma once

#include <memory>
#include <string>

#include "compute/engine/chosen_engine.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"

namespace burin::sculpt {

struct MadeWorkpiece {
    std::unique_ptr<WorkerPool> pool;   // of the carving, which works with it
    workpiece::LoadedWorkpiece loaded;  // its solid is the carving's
    compute::Lattice lattice;
    std::unique_ptr<Sculpture> carving;
};

// Loads the workpiece and makes it ready; threads: of the pool, as WorkerPool counts them.
[[nodiscard]] Result<MadeWorkpiece> make_workpiece(const workpiece::WorkpieceOptions& options,
                                                   const compute::EngineMaker& make_engine, unsigned threads,
                                                   const workpiece::LoadWatch& watch = {});

// Makes a workpiece that is there ready; the pool is the one that it was loaded with, or another.
[[nodiscard]] Result<MadeWorkpiece> ready_to_carve(workpiece::LoadedWorkpiece loaded,
                                                   const compute::EngineMaker& make_engine,
                                                   std::unique_ptr<WorkerPool> pool,
                                                   const workpiece::LoadWatch& watch = {}, double from = 0.0);

}  // namespace burin::sculpt
