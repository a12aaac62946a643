// SPDX-License-Identifier: MIT
#include "activities/train/ended_stage.hpp"

#include "base/text.hpp"
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

std::string outcome_text(const study::Stage& stage, const study::StageState& end) {
    if (stage.kind != study::StageKind::trial) {
        if (end.result == study::StageResult::stopped) return stage.name + " ended by stop: it is not done again";
        return stage.name + ": " + study::name_of(end.result);
    }
    const std::string trial = "trial " + stage.name;
    if (end.result == study::StageResult::valid_exit)
        return trial + formatted(": valid exit after %.4f s", study::trial_time_s(end));
    std::string how = end.result == study::StageResult::stopped ? std::string(" ended by stop")
                                                                : std::string(" ended, ") + study::name_of(end.result);
    if (end.last_failure != study::Failure::none)
        how += std::string(" (the last attempt: ") + study::name_of(end.last_failure) + ")";
    return trial + how + ": counts as ended without a valid exit";
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
