// SPDX-License-Identifier: MIT
// Who makes a session's workpiece, for options that carry it. What it makes: workpiece/workpiece.hpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "compute/engine/chosen_engine.hpp"

namespace burin::workpiece {

class Workpiece;          // workpiece/workpiece.hpp
struct EarlierWork;       // workpiece/workpiece.hpp
struct LoadWatch;         // workpiece/loaded_workpiece.hpp
struct WorkpieceOptions;  // workpiece/workpiece_options.hpp

// Makes a workpiece: of earlier work, or as the options name it. threads: of its pool, as WorkerPool counts them.
// Any thread; what is made belongs to one thread at a time.
using WorkpieceMaker = std::function<Result<std::unique_ptr<Workpiece>>(
    const WorkpieceOptions& options, std::optional<EarlierWork> earlier, const compute::EngineMaker& make_engine,
    unsigned threads, const LoadWatch& watch)>;

}  // namespace burin::workpiece
