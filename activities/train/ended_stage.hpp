// SPDX-License-Identifier: MIT
// Collects what an ended stage leaves, simulated or live; opens the worlds of a protocol. Pure; any thread.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "study/felt/felt_forces.hpp"
#include "study/folder/study_folder.hpp"
#include "study/trial/stage_step.hpp"

namespace burin::study {
class FeltWorld;     // study/felt/felt_world.hpp
class StageSession;  // study/felt/stage_session.hpp
}  // namespace burin::study

namespace burin::activities {

struct EndedStage {
    study::StageState end;
    std::vector<study::StageEvent> events;
    Json record;  // of a trial, its metrics; of another stage with a world, the forces; null: nothing
    std::uint64_t ticks = 0;
    double duration_s = 0.0;
    study::FeltForces forces{};  // of a stage with a world
};
// Makes the end of a stage with a world, the same as study/replay/ makes of its recorded motion.
[[nodiscard]] EndedStage ended_stage(const study::Protocol& protocol, const study::Stage& stage,
                                     const study::FeltWorld& world, const study::StageSession& session);

// Returns what of a stage was not as the protocol has it, though it came to an end: training in which ticks had no
// force, or that was ended by stop. Nothing where there is nothing of the kind; of trials stage_step.hpp decides.
[[nodiscard]] std::optional<std::string> deviation_of(const study::StagePlace& at, const EndedStage& ended);

// Returns how often a trial's attempts failed, by the reason's name (study::name_of), and "start cap never touched": 1
// where nobody came into it; null where nothing failed, and for other stages.
[[nodiscard]] Json failures_of(const study::Stage& stage, const EndedStage& ended);

// Returns a line for the operator that says how a stage ended: "trial test: valid exit after 12.3456 s".
[[nodiscard]] std::string outcome_text(const study::Stage& stage, const study::StageState& end);

// By name. Fails where a world cannot be touched.
using FeltWorlds = std::map<std::string, std::unique_ptr<const study::FeltWorld>>;
[[nodiscard]] Result<FeltWorlds> felt_worlds(const study::Protocol& protocol);

}  // namespace burin::activities
