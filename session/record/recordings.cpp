// SPDX-License-Identifier: MIT
#include "session/record/recordings.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "devices/haptic/mouse_arm.hpp"
#include "devices/haptic/wand_description.hpp"
#include "devices/registry/device_registry.hpp"
#include "record/export/table_export.hpp"
#include "record/motion.hpp"
#include "session/record/session_file.hpp"
#include "session/state/session_settings.hpp"

namespace burin::session {
namespace {

constexpr const char* kSession = "name a session that was recorded with --record FILE.session";

// The hands of a recording, and what each was.
Result<std::vector<NamedDevice>> hands_in(const record::RecordReader& reader) {
    const auto fact = [&](const char* key) {
        const auto at = reader.facts().find(key);
        return at == reader.facts().end() ? std::string() : at->second;
    };
    if (fact(kActivityFact) != kLiveActivity || reader.hands().empty())
        return fail(reader.path(), "is no recording of a live session", kSession);
    auto hands = hands_on(settings_on(fact(record::kLogHeaderFact)));
    // Where its workspace lies and when it touches is the way of the mouse, which no device tells.
    if (hands && std::ranges::find(*hands, devices::kMouseArm, &NamedDevice::device) != hands->end())
        return fail(reader.path(), "has the hand of a mouse on a surface, which is more than a device",
                    "do its session again with burin replay, or burin sculpt --input " + reader.path());
    if (!hands) return fail(reader.path(), hands.error().where + " " + hands.error().what, kSession);
    return hands;
}

// The tables of a hand's parts: those that bear its name, "right" or "right index"; all of the only hand.
std::vector<std::size_t> tables_of(const record::RecordReader& reader, const std::string& hand) {
    std::vector<std::size_t> tables;
    for (std::size_t table = 0; table < reader.hands().size(); ++table) {
        const std::string& name = reader.hands()[table].name;
        if (hand.empty() || name == hand || name.starts_with(hand + " ")) tables.push_back(table);
    }
    return tables;
}

Result<NamedDevice> chosen_hand(const record::RecordReader& reader, const std::string& hand) {
    const auto hands = hands_in(reader);
    if (!hands) return std::unexpected(hands.error());
    if (hand.empty()) return hands->front();
    const auto found = std::ranges::find(*hands, hand, &NamedDevice::hand);
    if (found != hands->end()) return *found;
    std::string names;
    for (const NamedDevice& one : *hands) names += (names.empty() ? "" : ", ") + one.hand;
    return fail(
        reader.path(), "has no hand " + hand,
        names.empty() ? "it has one hand, without a name: write recorded:" + reader.path() : "its hands are " + names);
}

Result<std::vector<devices::RecordedSample>> samples_of(record::RecordReader& reader, std::size_t table) {
    const record::HandRecord& of = reader.table(table);
    if (of.rows() == 0) return fail(reader.path(), "has no ticks of " + of.name, kSession);
    if (of.rows() > devices::Recordings::kMostTicks)
        return fail(reader.path(),
                    "has " + std::to_string(of.rows()) + " ticks, and at most " +
                        std::to_string(devices::Recordings::kMostTicks) + " are played",
                    "record a shorter session");
    BURIN_TRY(columns, record::MotionColumns::find(reader, table));
    std::vector<devices::RecordedSample> samples;
    samples.reserve(of.rows());
    Nanoseconds first_ns = 0;
    record::RowWalk walk(reader, table);
    for (Result<bool> more = walk.next();; more = walk.next()) {
        if (!more) return std::unexpected(more.error());
        if (!*more) break;
        const record::RecordedTick tick = columns.at(walk.block(), walk.row());
        const Nanoseconds due_ns = tick.time_ns - tick.lateness_ns;  // the deadline that it was for
        if (samples.empty()) first_ns = due_ns;
        if (!samples.empty() && due_ns - first_ns <= samples.back().due_ns)
            return fail(reader.path(), "goes back in time at tick " + std::to_string(tick.tick) + " of " + of.name,
                        "burin session check tells what is damaged");
        samples.push_back({due_ns - first_ns, tick.sample});
        samples.back().sample.time_ns -= tick.time_ns;  // its age
    }
    return samples;
}

class SessionRecordings final : public devices::Recordings {
public:
    Result<std::string> device_of(const std::string& file, const std::string& hand) const override {
        BURIN_TRY(reader, record::RecordReader::open(file));
        BURIN_TRY(chosen, chosen_hand(reader, hand));
        return std::move(chosen.device);
    }

    Result<devices::RecordedHand> hand_of(const std::string& file, const std::string& hand) const override {
        BURIN_TRY(reader, record::RecordReader::open(file));
        BURIN_TRY(chosen, chosen_hand(reader, hand));
        devices::RecordedHand played{chosen.device, {}};
        for (const std::size_t table : tables_of(reader, chosen.hand)) {
            BURIN_TRY(samples, samples_of(reader, table));
            const std::string& name = reader.hands()[table].name;
            const std::size_t blank = chosen.hand.empty() ? std::string::npos : chosen.hand.size();
            std::string own = blank == std::string::npos ? name : name.substr(std::min(name.size(), blank + 1));
            played.parts.push_back({std::move(own), std::move(samples)});
        }
        if (played.parts.empty()) return fail(file, "has no ticks of hand " + chosen.hand, kSession);
        if (played.parts.size() == 1) played.parts.front().name.clear();
        return played;
    }
};

}  // namespace

const devices::Recordings& session_recordings() {
    static const SessionRecordings recordings;
    return recordings;
}

}  // namespace burin::session
