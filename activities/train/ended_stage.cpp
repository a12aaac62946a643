// SPDX-License-Identifier: MIT
#include "activities/train/ended_stage.hpp"

#include "study/people/recorded_trial.hpp"

namespace burin::activities {

EndedStage ended_stage(const study::Protocol& protocol, const study::Stage& stage, const study::FeltWorld& world,
                       const study::StageSession& session) {
    EndedStage ended{session.state(), session.events(), {}, session.ticks(), session.time_s()};
    if (stage.kind == study::StageKind::trial) {
        ended.record = study::trial_record(world.world(), session.state(), session.events(),
                                           study::touch_by_model(protocol, stage, world, session.attempt()));
    } else {
        ended.record = study::forces_record(session.forces());
    }
    return ended;
}

Result<FeltWorlds> felt_worlds(const study::Protocol& protocol) {
    FeltWorlds worlds;
    for (const study::StudyWorld& world : protocol.worlds) {
        auto felt = study::FeltWorld::create(world);
        if (!felt) return std::unexpected(felt.error());
        worlds[world.name] = std::move(*felt);
    }
    return worlds;
}

}  // namespace burin::activities
