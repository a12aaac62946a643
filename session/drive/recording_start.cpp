// SPDX-License-Identifier: MIT
#include "session/drive/recording_start.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "scene/mesh_part.hpp"
#include "session/drive/thread_recorder.hpp"
#include "session/live/session.hpp"
#include "session/record/input_log.hpp"
#include "session/record/session_recording.hpp"
#include "session/state/session_settings.hpp"

namespace burin::session {
namespace {

std::vector<std::pair<std::int64_t, std::string>> touchable_in(const Session& session) {
    std::vector<std::pair<std::int64_t, std::string>> objects;
    const scene::MeshPart* part = session.scene_side().objects();
    for (scene::ObjectId id = 1; part != nullptr && id <= part->size(); ++id)
        objects.emplace_back(static_cast<std::int64_t>(id), part->object(id).name);
    if (session.scene_side().surface() != nullptr) objects.emplace_back(std::int64_t{kWorkpieceObject}, "workpiece");
    return objects;
}

}  // namespace

Result<InputLogWriter> create_recording(const SessionSetup& options, const SessionFacts& facts, Session& session,
                                        record::OnRecord also) {
    const SessionSetup settled = session.settled(options);
    const std::string settings = settings_line(settled);
    SessionHands& hands = session.hands();
    if (!is_session_file(options.record.path)) {
        if (hands.parts() == 1) return InputLogWriter::create(options.record.path, settings);
        return fail(options.record.path, "is a log as text, which has the ticks of one hand with one part alone",
                    "record into a session file: --record FILE.session");
    }
    RecordingOf of;
    for (std::size_t part = 0; part < hands.parts(); ++part) {
        haptics::HapticChannels& channels = hands.channels(part);
        of.parts.push_back({hands.parts() > 1 ? hands.name_of(part) : "", hands.device(part),
                            channels.parameters.newest().probe, &channels.records});
    }
    of.clock = clock_of(session);
    of.settings = settings;
    of.facts = facts;
    if (options.activity) std::ranges::move(options.activity->facts(), std::back_inserter(of.facts));
    of.facts.emplace_back(kDeviceFact, settled.hands.device);
    of.objects = touchable_in(session);
    of.also = std::move(also);
    BURIN_TRY(recording, SessionRecording::create(options.record.path, std::move(of)));
    return InputLogWriter::into(std::move(recording));
}

}  // namespace burin::session
