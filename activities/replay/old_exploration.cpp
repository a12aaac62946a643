// SPDX-License-Identifier: MIT
#include "activities/replay/old_exploration.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "activities/replay/device_as_recorded.hpp"
#include "activities/wand/wand_facts.hpp"
#include "activities/wand/wand_run.hpp"
#include "activities/wand/wand_stroke.hpp"
#include "activities/world/exploration.hpp"
#include "activities/world/opened_world.hpp"
#include "activities/world/repeated_hand.hpp"
#include "base/try.hpp"
#include "record/motion.hpp"
#include "record/touched_columns.hpp"
#include "scene/scene_service.hpp"
#include "session/record/session_recording.hpp"

namespace burin::activities {
namespace {

// ---- What the recording says

struct RecordedUpdate {
    Nanoseconds time_ns = 0;
    std::uint64_t last_tick = 0;  // the last one whose sample it read
};

constexpr Nanoseconds kMostUpdate_ns = Nanoseconds{1} << 60;
constexpr std::string_view kUpdateLine = "update ";

Result<std::vector<RecordedUpdate>> updates_in(record::RecordReader& reader) {
    std::vector<RecordedUpdate> updates;
    const auto read = reader.each_line([&](std::int64_t time_ns, const std::string& text) {
        RecordedUpdate update{std::clamp(time_ns, -kMostUpdate_ns, kMostUpdate_ns), 0};
        if (!text.starts_with(kUpdateLine)) return;
        std::from_chars(text.data() + kUpdateLine.size(), text.data() + text.size(), update.last_tick);
        updates.push_back(update);
    });
    if (!read) return std::unexpected(read.error());
    return updates;
}

// The settings of a stroke with a wand, whose hand begins where the first tick has it.
Result<ExplorationSettings> wand_settings(const record::RecordReader& reader, const DeviceAsRecorded& device,
                                          const record::RecordedTick& first) {
    BURIN_TRY(stroke, recorded_wand_stroke(reader));
    WandOptions options;
    options.wand = device.wand.value_or(devices::WandDescription{});
    options.points = device.points;
    options.radius_m = stroke.radius_m;
    options.scene_from_device = first.object_from_device;
    return settings_of(options, {first.sample.position_device_m, first.sample.orientation_device});
}

// ---- The same world

// Brings the scene to the state in which a tick was computed: its surface has this number.
class RecordedUpdates {
public:
    // first_ns: of an update of which no line tells.
    RecordedUpdates(std::vector<RecordedUpdate> updates, Nanoseconds first_ns, std::string path)
        : updates_(std::move(updates)), are_told_(!updates_.empty()), last_{first_ns, 0}, path_(std::move(path)) {}

    [[nodiscard]] Nanoseconds first_ns() const { return are_told_ ? updates_.front().time_ns : last_.time_ns; }
    Result<void> bring_to(std::uint64_t surface, scene::SceneService& service) {
        while (service.published(0) < surface) {
            const std::uint64_t next = service.published(0);
            if (are_told_ && next >= updates_.size())
                return fail(path_, "update " + std::to_string(next + 1) + " of the scene is missing",
                            "replay with --to a tick before, or a recording that was closed");
            const RecordedUpdate& update = are_told_ ? updates_[next] : last_;
            BURIN_TRY_DO(service.repeat({update.time_ns, 0, {update.last_tick}, {}}));
        }
        return {};
    }
    // Takes a tick that has been done.
    void take(const record::RecordedTick& tick) { last_ = {tick.time_ns, static_cast<std::uint64_t>(tick.tick)}; }

private:
    std::vector<RecordedUpdate> updates_;
    bool are_told_;
    RecordedUpdate last_;  // as it would be after the last tick
    std::string path_;
};

// All that a tick is done again with.
struct Again {
    std::unique_ptr<RepeatedHand> hand;
    RecordedUpdates updates;
};

Result<Again> begin_again(record::RecordReader& reader, const ExploredWorld& world, const DeviceAsRecorded& device,
                          const record::RecordedTick& first) {
    const bool with_wand = reader.fact(kActivityFact) == kWandActivity;
    const auto settings = with_wand ? wand_settings(reader, device, first) : recorded_settings(reader);
    if (!settings) return std::unexpected(settings.error());
    BURIN_TRY(told, updates_in(reader));
    RecordedUpdates updates(std::move(told), first.time_ns - period_of(device), reader.path());
    BURIN_TRY(hand, RepeatedHand::create(world, *settings, device, updates.first_ns()));
    return Again{std::move(hand), std::move(updates)};
}

Result<void> check_follows(const record::RecordReader& reader, const record::RecordedTick& tick,
                           std::int64_t expected) {
    BURIN_TRY_DO(check_tick(reader, tick));
    if (tick.tick == expected) return {};
    return fail(reader.path(),
                "tick " + std::to_string(tick.tick) + " follows tick " + std::to_string(expected - 1) +
                    ": others were lost, and each depends on them",
                "replay with --to " + std::to_string(expected - 1) + " what is before");
}

// Returns the first column in which a tick differs from the row of the walk.
std::optional<record::Difference> difference_in(const record::HandRecord& hand, const record::RowWalk& walk,
                                                const haptics::TickRecord& again, const record::RowShape& shape) {
    const std::vector<record::Word> row = session::session_row(again, shape);
    for (std::size_t c = 0; c < hand.columns.size(); ++c)
        if (walk.at(c) != row[c])
            return record::difference_of(hand.name, hand.columns[c], static_cast<std::int64_t>(again.tick), walk.at(c),
                                         row[c]);
    return {};
}

}  // namespace

bool is_old_exploration(const std::string& activity) { return activity == kWorldActivity || activity == kWandActivity; }

Result<double> radius_of_old_exploration(const record::RecordReader& reader) {
    if (reader.fact(kActivityFact) == kWandActivity) {
        BURIN_TRY(stroke, recorded_wand_stroke(reader));
        return stroke.radius_m;
    }
    BURIN_TRY(settings, recorded_settings(reader));
    return settings.tool_radius_m;
}

Result<record::Comparison> repeat_exploration(record::RecordReader& reader, const ExploredWorld& world,
                                              const record::TickRange& range) {
    BURIN_TRY(device, device_as_recorded(reader));
    BURIN_TRY_DO(check_hand(reader, device));
    const record::HandRecord& recorded = reader.hands()[0];
    const record::RowShape shape = record::shape_of(device.description(), device.probe(1.0));
    if (!record::can_be_replayed(recorded.columns, shape))
        return fail(reader.path(), "has other columns than this program records of a world",
                    "replay it with the program that recorded it; its data can be read and converted");
    BURIN_TRY(motion, record::MotionColumns::find(reader, 0));
    std::optional<Again> again;
    record::Comparison result{0, recorded.columns.size(), {}};
    record::RowWalk walk(reader, 0);
    for (std::int64_t expected = 1;; ++expected) {
        BURIN_TRY(more, walk.next());
        if (!more) return result;
        const record::RecordedTick tick = motion.at(walk.block(), walk.row());
        if (tick.tick > range.to) return result;
        BURIN_TRY_DO(check_follows(reader, tick, expected));
        if (!again) {
            BURIN_TRY(begun, begin_again(reader, world, device, tick));
            again.emplace(std::move(begun));
        }
        BURIN_TRY_DO(again->updates.bring_to(tick.surface_sequence, again->hand->service()));
        const haptics::TickRecord done = again->hand->repeated(tick);
        again->updates.take(tick);
        if (tick.tick < range.from) continue;
        result.difference = difference_in(recorded, walk, done, shape);
        if (result.difference) return result;
        ++result.ticks;
    }
}

Result<record::Comparison> replay_old_exploration(record::RecordReader& reader, const std::string& given,
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
    return repeat_exploration(reader, {.file = path, .scene = world->scene}, range);
}

}  // namespace burin::activities
