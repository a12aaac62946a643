// SPDX-License-Identifier: MIT
#include "activities/train/ended_stage.hpp"

#include "base/text.hpp"
#include "base/try.hpp"
#include "study/felt/repeated_stage.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::activities {

EndedStage ended_stage(const study::Protocol& protocol, const study::Stage& stage, const study::FeltWorld& world,
                       const study::StageSession& session) {
    EndedStage ended{session.state(), session.events(), {}, session.ticks(), session.time_s(), session.forces()};
    if (stage.kind == study::StageKind::trial) {
        ended.record = study::trial_record(world.world(), session.state(), session.events(),
                                           study::touch_by_model(protocol, stage, world, session.attempt()));
    } else {
        ended.record = study::forces_record(session.forces());
    }
    return ended;
}

std::optional<std::string> deviation_of(const study::StagePlace& at, const EndedStage& ended) {
    const bool training = at.stage->kind != study::StageKind::page && at.stage->kind != study::StageKind::trial;
    const std::string which = formatted("%s (day %zu, stage %zu)", at.stage->name.c_str(), at.day, at.place);
    std::string what;
    if (training && ended.forces.faults > 0)
        what = formatted(" had %llu of its %llu ticks without force (the last: %s)",
                         static_cast<unsigned long long>(ended.forces.faults),
                         static_cast<unsigned long long>(ended.forces.ticks), haptics::text(ended.forces.cause));
    if (ended.end.result == study::StageResult::stopped)
        what += formatted("%s was ended by stop after %.1f s", what.empty() ? "" : "; it", ended.duration_s);
    return what.empty() ? std::nullopt : std::optional(which + what);
}

Json failures_of(const study::Stage& stage, const EndedStage& ended) {
    if (stage.kind != study::StageKind::trial) return {};
    Json failures;
    bool touched = false;
    for (const study::StageEvent& event : ended.events) {
        touched = touched || event.kind == study::StageEventKind::start_touched;
        if (event.kind != study::StageEventKind::attempt_failed) continue;
        const char* name = study::name_of(event.failure);
        failures[name] = failures.contains(name) ? failures[name].get<std::size_t>() + 1 : std::size_t{1};
    }
    if (!touched) failures[study::kNeverTouched] = std::size_t{1};
    return failures;
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
        BURIN_TRY(felt, study::FeltWorld::create(world));
        worlds[world.name] = std::move(felt);
    }
    return worlds;
}

}  // namespace burin::activities
