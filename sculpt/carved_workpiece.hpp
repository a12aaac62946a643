// SPDX-License-Identifier: MIT
// The workpiece that hands carve (workpiece/workpiece.hpp): a sculpture, the pool that it works with, and the part of
// the scene that it becomes. Whoever opens a session with a workpiece gives it this maker.
// Lengths in metres, object frame. Any thread; what is made belongs to one thread at a time.
#pragma once

#include <memory>
#include <optional>

#include "compute/engine/chosen_engine.hpp"
#include "workpiece/workpiece.hpp"
#include "workpiece/workpiece_options.hpp"

namespace burin::sculpt {

struct MadeWorkpiece;  // sculpt/made_workpiece.hpp

// A workpiece::WorkpieceMaker.
[[nodiscard]] Result<std::unique_ptr<workpiece::Workpiece>> make_carved_workpiece(
    const workpiece::WorkpieceOptions& options, std::optional<workpiece::EarlierWork> earlier,
    const compute::EngineMaker& make_engine, unsigned threads, const workpiece::LoadWatch& watch = {});

// Returns the workpiece of a sculpture that is there already, which keeps its place.
[[nodiscard]] std::unique_ptr<workpiece::Workpiece> as_workpiece(MadeWorkpiece made);

}  // namespace burin::sculpt
