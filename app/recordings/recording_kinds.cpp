// SPDX-License-Identifier: MIT
#include "app/recordings/recording_kinds.hpp"

#include <algorithm>
#include <array>

#include "activities/replay/old_exploration.hpp"
#include "app/recordings/felt_recording.hpp"
#include "base/try.hpp"
#include "session/record/session_recording.hpp"

namespace burin::app {
namespace {

Result<LiveReplayed> replay_session(record::RecordReader& reader, const ReplayAsked& asked) {
    if (!asked.stroke.empty())
        return fail("--stroke", "belongs to a felt stroke, and this is a session", "leave it out");
    return replay_live(reader, asked.how, asked.range);
}

Result<std::optional<double>> ball_of_session(const record::RecordReader& reader) { return live_ball_radius_m(reader); }

// Fails on what only a session can have; remedy: where settings are changed.
Result<void> check_is_not_of_a_session(const record::RecordReader& reader, const LiveReplay& how, bool sets,
                                       const std::string& remedy) {
    const std::string what = "is for live sessions, and " + reader.path() + " is of another kind";
    if (!how.pictures.empty()) return fail("--pictures", what, "leave it out");
    if (sets) return fail("--set", what, remedy);
    return {};
}

Result<LiveReplayed> replay_exploration(record::RecordReader& reader, const ReplayAsked& asked) {
    BURIN_TRY_DO(check_is_not_of_a_session(reader, asked.how, !asked.how.sets.empty(), "leave it out"));
    BURIN_TRY(found, activities::replay_old_exploration(reader, asked.how.world, asked.range));
    return LiveReplayed{found};
}

Result<std::optional<double>> ball_of_exploration(const record::RecordReader& reader) {
    BURIN_TRY(radius_m, activities::radius_of_old_exploration(reader));
    return std::optional(radius_m);
}

Result<LiveReplayed> replay_felt_stroke(record::RecordReader& reader, const ReplayAsked& asked) {
    const std::vector<std::string>& sets = asked.how.sets;
    std::optional<compute::EngineChoice> engine;
    if (sets == std::vector<std::string>{"engine=cpu"}) engine = compute::EngineChoice::cpu;
    if (sets == std::vector<std::string>{"engine=vulkan"}) engine = compute::EngineChoice::vulkan;
    BURIN_TRY_DO(check_is_not_of_a_session(reader, asked.how, !sets.empty() && !engine,
                                           "leave it out, or give --set engine=cpu or engine=vulkan alone"));
    BURIN_TRY(found, replay_felt(reader, {asked.stroke, asked.how.workpiece, engine}, asked.range));
    return LiveReplayed{found};
}

Result<std::optional<double>> ball_of_felt_stroke(const record::RecordReader& reader) {
    return felt_ball_radius_m(reader.fact(activities::kSettingsFact));
}

constexpr std::array kRecordingKinds{
    RecordingKind{session::kLiveActivity, replay_session, ball_of_session},
    RecordingKind{kFeltActivity, replay_felt_stroke, ball_of_felt_stroke},
    RecordingKind{activities::kWorldActivity, replay_exploration, ball_of_exploration},
    RecordingKind{activities::kWandActivity, replay_exploration, ball_of_exploration},
};

}  // namespace

Result<const RecordingKind*> kind_of(const record::RecordReader& reader) {
    const std::string activity = reader.fact(session::kActivityFact);
    const auto kind = std::ranges::find(kRecordingKinds, activity, &RecordingKind::activity);
    if (kind != kRecordingKinds.end()) return &*kind;
    return fail(reader.path(), "does not hold what a replay needs",
                "replay what burin world --record or burin sculpt --record has written; other motions can be felt "
                "--through a world");
}

}  // namespace burin::app
