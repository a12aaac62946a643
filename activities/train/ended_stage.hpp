// SPDX-License-Identifier: MIT
// What a stage leaves when it has ended, simulated or live; and the worlds of a protocol. Pure; any thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/felt/stage_session.hpp"

namespace burin::activities {

struct EndedStage {
    study::StageState end;
    std::vector<study::StageEvent> events;
    Json record;  // of a trial, its metrics; of another stage with a world, the forces; null: nothing
    std::uint64_t ticks = 0;
    double duration_s = 0.0;
};
// Of a stage with a world, as study/replay/ makes it of a recorded motion.
[[nodiscard]] EndedStage ended_stage(const study::Protocol& protocol, const study::Stage& stage,
                                     const study::FeltWorld& world, const study::StageSession& session);

// By name. Fails where a world cannot be touched.
using FeltWorlds = std::map<std::string, std::unique_ptr<const study::FeltWorld>>;
[[nodiscard]] Result<FeltWorlds> felt_worlds(const study::Protocol& protocol);

}  // namespace burin::activities
