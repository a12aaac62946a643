// SPDX-License-Identifier: MIT
#include "activities/replay/device_as_recorded.hpp"

#include "activities/wand/wand_facts.hpp"
#include "activities/wand/wand_stroke.hpp"
#include "activities/world/exploration.hpp"
#include "base/sha256.hpp"
#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/device_registry.hpp"
#include "record/export/table_export.hpp"
#include "record/motion.hpp"
#include "session/record/recordings.hpp"
#include "session/record/session_recording.hpp"
#include "session/state/session_settings.hpp"

namespace burin::activities {
namespace {

constexpr const char* kPutBack = "put the file back, unchanged, where it was";

// The device's name and its points, as they were given on the command line.
struct DeviceWords {
    std::string device, points;
};

Result<DeviceWords> device_words_of(const record::RecordReader& reader) {
    const std::string activity = reader.fact(session::kActivityFact);
    if (activity == kWandActivity) {
        BURIN_TRY(stroke, recorded_wand_stroke(reader));
        return DeviceWords{stroke.device, stroke.points};
    }
    const std::string named = reader.fact(record::kWandPointsFact);
    const bool is_exploration = !reader.fact(kExplorationFact).empty();  // whose settings name the wand's file
    if (!named.empty() && !is_exploration) return DeviceWords{std::string(devices::kSimulatedWand), named};
    if (activity != session::kLiveActivity) return DeviceWords{};
    const std::string settings = live_settings_of(reader);
    const Result<std::string> device = session::option_on(settings, "--device");
    const Result<std::string> points = session::option_on(settings, "--points");
    if (!device) return std::unexpected(device.error());
    if (!points) return std::unexpected(points.error());
    return DeviceWords{*device, *points};
}

// Returns the description of a device that has a handle.
Result<devices::WandDescription> described_now(const std::string& device) {
    BURIN_TRY(nature, devices::nature_of_device(device, &session::session_recordings()));
    return nature.handle.value_or(devices::WandDescription{});
}

Result<devices::WandDescription> recorded_wand(const record::RecordReader& reader, const std::string& device) {
    const std::string file = wand_file_of(device);
    const std::string digest = reader.fact(record::kWandDigestFact);
    if (const std::string text = reader.fact(record::kWandTextFact); !text.empty()) {
        if (sha256(text) != digest)
            return fail(reader.path(), "holds another description of its wand than its digest says",
                        "read it from an unchanged copy of the recording");
        devices::WandOrProblems wand = devices::parse_wand(text, reader.path() + ": " + record::kWandTextFact);
        if (!wand) return std::unexpected(wand.error().front());
        return std::move(*wand);
    }
    if (file.empty()) return described_now(device);
    if (digest.empty())
        return fail(reader.path(), "does not hold the description of its wand, " + file,
                    "record the motion again: recordings of this version hold it");
    BURIN_TRY_DO(check_wand_file(reader, device, kPutBack));
    return described_now(device);
}

}  // namespace

std::string live_settings_of(const record::RecordReader& reader) {
    return session::settings_on(reader.fact(record::kLogHeaderFact));
}

Result<DeviceAsRecorded> device_as_recorded(const record::RecordReader& reader) {
    BURIN_TRY(words, device_words_of(reader));
    DeviceAsRecorded recorded;
    if (!devices::has_handle(words.device, &session::session_recordings())) return recorded;
    BURIN_TRY(wand, recorded_wand(reader, words.device));
    recorded.wand = std::move(wand);
    const bool is_stroke = reader.fact(session::kActivityFact) == kWandActivity;
    if (words.points.empty() && !is_stroke) return recorded;
    Result<std::vector<devices::WandPoint>> points = devices::points_named(
        *recorded.wand, words.points.empty() ? devices::usual_points(*recorded.wand) : words.points);
    if (!points) return fail(reader.path(), points.error().where + " " + points.error().what, points.error().remedy);
    recorded.points = std::move(*points);
    return recorded;
}

}  // namespace burin::activities
