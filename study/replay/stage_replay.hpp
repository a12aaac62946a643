// SPDX-License-Identifier: MIT
// Replay of a recorded stage (W18): the stored motion goes through the haptic tick and the stage's step again, and each
// value of each tick is compared, bit for bit, with what was stored. What a trial measures is computed from it anew.
//
// Bad input: a file that is damaged, of another protocol or world, or with other columns is an Error with its remedy;
// a difference is none, but is told. Memory: one block, and the ticks of the attempt that counts. One thread.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "record/compare.hpp"
#include "study/felt/repeated_stage.hpp"

namespace burin::study {

struct StageReplay {
    std::uint64_t ticks = 0;
    std::size_t columns = 0;
    std::optional<record::Difference> difference;  // the first, by tick; none: equal to the bit
    StageState end;
    std::vector<StageEvent> events;
    Json record;         // as simulate and run make it (recorded_trial.hpp)
    ModelTouch model;    // of a trial with a valid exit, for plots
    bool closed = true;  // false: its recording was interrupted
    // The ticks were a session's: they are taken as they are, and stage, trial and figures are computed from them
    // again.
    bool of_session = false;
};

// Called after each tick, for pictures of it.
using OnReplayedTick = std::function<void(const StageSession&, const haptics::TickRecord&)>;

// The protocol's digest is compared with the one that the file names.
[[nodiscard]] Result<StageReplay> replay_stage(const std::filesystem::path& file, const Protocol& protocol,
                                               const std::string& protocol_digest, const FeltWorld& world,
                                               const OnReplayedTick& on_tick = {});

}  // namespace burin::study
