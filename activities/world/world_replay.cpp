// SPDX-License-Identifier: MIT
#include "activities/world/world_replay.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <system_error>
#include <utility>

#include "activities/world/opened_world.hpp"
#include "activities/world/repeated_hand.hpp"
#include "activities/world/world_recorder.hpp"
#include "activities/world/world_touch.hpp"
#include "base/try.hpp"
#include "record/motion.hpp"
#include "record/touched_columns.hpp"

namespace burin::activities {
namespace {

// ---- What the recording says

struct RecordedUpdate {
    Nanoseconds time_ns = 0;
    std::uint64_t last_tick = 0;  // the last one whose sample it read
};

constexpr Nanoseconds kMostUpdate_ns = Nanoseconds{1} << 60;

Result<std::vector<RecordedUpdate>> updates_in(record::RecordReader& reader) {
    std::vector<RecordedUpdate> updates;
    const std::string_view begin = kUpdateLine;
    const auto read = reader.each_line([&](std::int64_t time_ns, const std::string& text) {
        RecordedUpdate update{std::clamp(time_ns, -kMostUpdate_ns, kMostUpdate_ns), 0};
        if (!text.starts_with(begin)) return;
        std::from_chars(text.data() + begin.size(), text.data() + text.size(), update.last_tick);
        updates.push_back(update);
    });
    if (!read) return std::unexpected(read.error());
    return updates;
}

// ---- The same world

// Brings the scene to the state in which the tick was computed: its surface has this number.
class RecordedUpdates {
public:
    static Result<RecordedUpdates> of(record::RecordReader& reader) {
        BURIN_TRY(updates, updates_in(reader));
        return RecordedUpdates(std::move(updates), reader.path());
    }
    Result<void> bring_to(std::uint64_t surface, scene::SceneService& service) {
        while (service.published(0) < surface) {
            if (next_ >= updates_.size())
                return fail(path_, "update " + std::to_string(service.published(0) + 1) + " of the scene is missing",
                            "replay with --to a tick before, or a recording that was closed");
            const RecordedUpdate& update = updates_[next_++];
            const scene::SceneUpdate seen{update.time_ns, 0, {update.last_tick}, {}};
            BURIN_TRY_DO(service.repeat(seen));
        }
        return {};
    }

private:
    RecordedUpdates(std::vector<RecordedUpdate> updates, std::string path)
        : updates_(std::move(updates)), path_(std::move(path)) {}
    std::vector<RecordedUpdate> updates_;
    std::size_t next_ = 0;
    std::string path_;
};

}  // namespace

Result<ExplorationSettings> recorded_settings(const record::RecordReader& reader) {
    const auto& facts = reader.facts();
    const auto activity = facts.find(kActivityFact), settings = facts.find(kSettingsFact);
    if (activity == facts.end() || activity->second != kWorldActivity || settings == facts.end())
        return fail(reader.path(), "does not hold the settings of an exploration",
                    "replay a recording that burin world --record has written");
    return read_settings(settings->second, reader.path());
}

Result<record::Comparison> repeat_world(record::RecordReader& reader, scene::MeshPart& part,
                                        const scene::MaterialTable& materials, const record::TickRange& range) {
    const DeviceAsRecorded omni;
    BURIN_TRY_DO(check_hand(reader, omni));
    BURIN_TRY(settings, recorded_settings(reader));
    WorldTouch touch(part, materials, settings);
    BURIN_TRY(hand, RepeatedHand::create(omni, touch.channels()));
    const std::vector<record::Column>& columns = reader.hands()[0].columns;
    constexpr record::RowShape kOneBall{0, 1};
    if (!record::can_be_replayed(columns, kOneBall))
        return fail(reader.path(), "has other columns than this program records of a world",
                    "replay it with the program that recorded it; its data can be read and converted");
    BURIN_TRY(updates, RecordedUpdates::of(reader));
    BURIN_TRY(motion, record::MotionColumns::find(reader, 0));

    record::Comparison result{0, columns.size(), {}};
    record::RowWalk walk(reader, 0);
    for (std::int64_t expected = 1;; ++expected) {
        BURIN_TRY(more, walk.next());
        if (!more) return result;
        const record::RecordedTick tick = motion.at(walk.block(), walk.row());
        if (tick.tick > range.to) return result;
        BURIN_TRY_DO(check_tick(reader, tick));
        if (tick.tick != expected)
            return fail(reader.path(),
                        "tick " + std::to_string(tick.tick) + " follows tick " + std::to_string(expected - 1) +
                            ": others were lost, and each depends on them",
                        "replay with --to " + std::to_string(expected - 1) + " what is before");
        BURIN_TRY_DO(updates.bring_to(tick.surface_sequence, touch.service()));
        const haptics::TickRecord again = hand->repeated(tick);
        if (tick.tick < range.from) continue;
        std::vector<record::Word> row = record::row_of(again, kOneBall);
        record::append_touched(again, kOneBall, row);
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (walk.at(c) == row[c]) continue;
            result.difference =
                record::difference_of(reader.hands()[0].name, columns[c], tick.tick, walk.at(c), row[c]);
            return result;
        }
        ++result.ticks;
    }
}

Result<record::Comparison> replay_world(record::RecordReader& reader, const std::string& given,
                                        const record::TickRange& range) {
    const std::string path = given.empty() ? reader.fact("world") : given;
    if (path.empty()) return fail(reader.path(), "does not name its world", "name it by --world FILE");
    if (std::error_code ignored; !std::filesystem::exists(path, ignored))
        return fail(path, "is the world of the recording, and is not there", "say where it is now by --world FILE");
    BURIN_TRY(world, open_world(path, {}));
    const std::string recorded = reader.fact(record::kWorldDigestFact);
    if (world->digest != recorded)
        return fail(path,
                    "is another world than the one that was recorded: SHA-256 " + world->digest +
                        ", recorded: " + (recorded.empty() ? "none" : recorded),
                    "name the same world by --world, or feel the motion in this one by --through");
    return repeat_world(reader, *world->part, world->materials, range);
}

}  // namespace burin::activities
