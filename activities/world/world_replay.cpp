// SPDX-License-Identifier: MIT
#include "activities/world/world_replay.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <utility>

#include "activities/world/world_recorder.hpp"
#include "activities/world/world_touch.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/haptic_loop.hpp"

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

Result<devices::SimulatedHand> still_hand() { return devices::SimulatedHand::create({devices::HandPose{}}); }

// Checks that the recording has one hand, of the device that can be had without hardware.
Result<void> check_hand(const record::RecordReader& reader) {
    if (reader.hands().size() != 1)
        return fail(reader.path(), "has " + std::to_string(reader.hands().size()) + " hands",
                    "replay a recording of one hand");
    Result<devices::SimulatedHand> hand = still_hand();
    if (!hand) return std::unexpected(hand.error());
    const devices::SimulatedOmni omni(std::move(*hand));
    if (reader.hands()[0].name != omni.description().name)
        return fail(reader.path(), "was recorded with " + reader.hands()[0].name + ", whose figures are not in it",
                    "replay a recording of a " + std::string(omni.description().name));
    return {};
}

// Checks what a file may claim of a tick: times that can be subtracted from each other, and a mapping that is one.
Result<void> check_tick(const record::RecordReader& reader, const record::RecordedTick& tick) {
    constexpr Nanoseconds kMost_ns = Nanoseconds{1} << 60;
    const auto is_time = [](Nanoseconds t_ns) { return t_ns >= -kMost_ns && t_ns <= kMost_ns; };
    const Similarity& map = tick.object_from_device;
    const Quat& q = map.orientation;
    const bool is_map = finite(map.position_m) && haptics::is_felt_at(map.scale) &&
                        std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1.0) <= 1e-6;
    if (is_time(tick.time_ns) && is_time(tick.sample.time_ns) && is_time(tick.lateness_ns) && is_map) return {};
    return fail(reader.path(), "tick " + std::to_string(tick.tick) + " has a time or a mapping that no tick has",
                "burin session check tells what is damaged");
}

Result<WorldSettings> settings_of(const record::RecordReader& reader) {
    const auto& facts = reader.facts();
    const auto activity = facts.find(kActivityFact), settings = facts.find(kSettingsFact);
    if (activity == facts.end() || activity->second != kWorldActivity || settings == facts.end())
        return fail(reader.path(), "does not hold the settings of an exploration",
                    "replay a recording that burin world --record has written");
    return read_settings(settings->second, reader.path());
}

// The loop of a hand that nobody moves, for its ticks to be repeated.
struct StillHand {
    SimulatedClock clock;
    devices::SimulatedOmni omni;
    haptics::HapticLoop loop;

    StillHand(devices::SimulatedHand hand, haptics::HapticChannels& channels)
        : omni(std::move(hand), {}, nullptr), loop(omni, clock, channels) {}
};

haptics::TickRecord repeated(StillHand& hand, WorldTouch& touch, const record::RecordedTick& tick) {
    haptics::HapticChannels& channels = touch.channels();
    const haptics::TickRecord record = hand.loop.repeat(tick.sample, channels.surface.newest(),
                                                        channels.parameters.newest(), tick.time_ns, tick.lateness_ns);
    haptics::TickRecord unread;
    while (channels.records.pop(unread)) {
    }
    return record;
}

// ---- The same world

// Brings the scene to the state in which the tick was computed: its surface has this number.
class RecordedUpdates {
public:
    static Result<RecordedUpdates> of(record::RecordReader& reader) {
        Result<std::vector<RecordedUpdate>> updates = updates_in(reader);
        if (!updates) return std::unexpected(updates.error());
        return RecordedUpdates(std::move(*updates), reader.path());
    }
    Result<void> bring_to(std::uint64_t surface, scene::SceneService& service) {
        while (service.published(0) < surface) {
            if (next_ >= updates_.size())
                return fail(path_, "update " + std::to_string(service.published(0) + 1) + " of the scene is missing",
                            "replay with --to a tick before, or a recording that was closed");
            const RecordedUpdate& update = updates_[next_++];
            const scene::SceneUpdate seen{update.time_ns, 0, {update.last_tick}, {}};
            if (const auto done = service.repeat(seen); !done) return done;
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

std::vector<record::Column> columns_of_a_world() {
    std::vector<record::Column> columns = record::columns_for(record::RowShape{0, 1});
    const std::vector<record::Column> objects = object_columns(1);
    columns.insert(columns.end(), objects.begin(), objects.end());
    return columns;
}

// ---- Another world

constexpr double kReachAtDevice_m = 0.014;  // until the next update: 1 m/s for more than a period

// The recorded values from which a tick in another world deviates. A point that was not there is not a number.
class RecordedTouch {
public:
    static Result<RecordedTouch> find(const record::RecordReader& reader) {
        const record::HandRecord& hand = reader.hands()[0];
        RecordedTouch touch;
        for (const char* name :
             {"proxy0_object_x_m", "proxy0_object_y_m", "proxy0_object_z_m", "commanded_force_device_x_N",
              "commanded_force_device_y_N", "commanded_force_device_z_N"}) {
            touch.columns_.push_back(record::find_column(hand, name, record::ColumnType::f64));
            if (touch.columns_.back() == hand.columns.size())
                return fail(reader.path(), "has no column " + std::string(name),
                            "replay a recording that has all columns");
        }
        return touch;
    }
    [[nodiscard]] Vec3 proxy_m(const record::RowWalk& walk) const { return vector(walk, 0); }
    [[nodiscard]] Vec3 force_N(const record::RowWalk& walk) const { return vector(walk, 3); }

private:
    [[nodiscard]] Vec3 vector(const record::RowWalk& walk, std::size_t first) const {
        const auto at = [&](std::size_t i) { return std::bit_cast<double>(walk.at(columns_[first + i])); };
        return {at(0), at(1), at(2)};
    }
    std::vector<std::size_t> columns_;
};

struct Deviation {
    double proxy_m = 0.0, force_N = 0.0;
};

std::vector<record::Word> through_row(const record::RecordedTick& at, const haptics::TickRecord& tick,
                                      std::uint32_t object, const Deviation& deviation) {
    const haptics::PointRecord& point = tick.contact.points[0];
    std::vector<record::Word> row{static_cast<record::Word>(at.tick), static_cast<record::Word>(at.time_ns)};
    const auto number = [&](double value) { row.push_back(std::bit_cast<record::Word>(value)); };
    const auto vector = [&](const Vec3& v) { number(v.x), number(v.y), number(v.z); };
    vector(point.proxy_object_m);
    vector(point.force_device_N);
    number(point.penetration_m);
    row.push_back(point.active_triangle);
    row.push_back(object);
    vector(tick.wanted.force_device_N);
    vector(tick.gate.given.force_device_N);
    row.push_back(tick.flags);
    row.push_back(static_cast<record::Word>(tick.gate.cause));
    number(deviation.proxy_m);
    number(deviation.force_N);
    return row;
}

// Notes where the proxy begins.
void note_beginning(ThroughFigures& figures, const record::RecordedTick& first, const haptics::TickRecord& tick,
                    const scene::MeshPart& part, std::span<const scene::ObjectId> ids, double radius_m) {
    figures.first_tick = first.tick;
    figures.begins_scene_m = tick.contact.points[0].hip_object_m;
    figures.begins_inside = (tick.flags & haptics::kTickPushedOut) != 0;
    const auto near = NearestObject(part, ids).at(figures.begins_scene_m);
    if (!near) return;
    figures.nearest = part.object(near->id).name;
    figures.nearest_m = near->distance_m - radius_m;
}

void note_tick(ThroughFigures& figures, const record::RecordedTick& at, const haptics::TickRecord& tick,
               std::uint32_t object, const Deviation& deviation, const scene::MeshPart& part) {
    ++figures.ticks;
    if ((tick.flags & haptics::kTickPushedOut) != 0) ++figures.ticks_pushed_out;
    figures.force_max_N = std::max(figures.force_max_N, glm::length(tick.gate.given.force_device_N));
    figures.force_deviation_max_N = std::max(figures.force_deviation_max_N, deviation.force_N);
    figures.proxy_deviation_max_m = std::max(figures.proxy_deviation_max_m, deviation.proxy_m);
    if (!tick.in_contact()) return;
    ++figures.ticks_in_contact;
    if (figures.first_contact_tick) return;
    figures.first_contact_tick = at.tick;
    if (object != 0 && part.has(object)) figures.first_contact = part.object(object).name;
}

// Updates the scene every 10 ms, after the tick before.
class SteadyUpdates {
public:
    Result<void> before(const record::RecordedTick& tick, Nanoseconds period_ns, scene::SceneService& service) {
        if (!std::exchange(began_, true)) newest_ns_ = next_ns_ = tick.time_ns - period_ns;
        Result<void> done;
        if (newest_ns_ >= next_ns_) {
            done = service.update(newest_ns_);
            next_ns_ = newest_ns_ + scene::SceneService::kHandsMove_ns;
        }
        newest_ns_ = tick.time_ns;
        return done;
    }

private:
    bool began_ = false;
    Nanoseconds newest_ns_ = 0, next_ns_ = 0;
};

// Returns the settings with which the motion is felt: those of the exploration where it was one, so that its own world
// gives its own ticks.
WorldSettings settings_through(const record::RecordReader& reader, const record::RecordedTick& first,
                               double tool_radius_m) {
    WorldSettings settings;
    const Vec3 hand = first.object_from_device * first.sample.position_device_m;
    if (const auto own = settings_of(reader))
        settings = *own;
    else if (finite(hand))
        settings.start_scene_m = hand;
    settings.scene_from_device = first.object_from_device;
    settings.tool_radius_m = tool_radius_m;
    settings.reach_m = kReachAtDevice_m * first.object_from_device.scale;
    return settings;
}

bool same_mapping(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}

}  // namespace

Result<record::Comparison> repeat_world(record::RecordReader& reader, scene::MeshPart& part,
                                        const scene::MaterialTable& materials, const record::TickRange& range) {
    if (const auto ok = check_hand(reader); !ok) return std::unexpected(ok.error());
    const Result<WorldSettings> settings = settings_of(reader);
    if (!settings) return std::unexpected(settings.error());
    WorldTouch touch(part, materials, *settings);
    Result<devices::SimulatedHand> still = still_hand();
    if (!still) return std::unexpected(still.error());
    StillHand hand(std::move(*still), touch.channels());
    const std::vector<record::Column>& columns = reader.hands()[0].columns;
    if (columns != columns_of_a_world())
        return fail(reader.path(), "has other columns than this program records of a world",
                    "replay it with the program that recorded it; its data can be read and converted");
    Result<RecordedUpdates> updates = RecordedUpdates::of(reader);
    if (!updates) return std::unexpected(updates.error());
    const Result<record::MotionColumns> motion = record::MotionColumns::find(reader, 0);
    if (!motion) return std::unexpected(motion.error());

    record::Comparison result{0, columns.size(), {}};
    record::RowWalk walk(reader, 0);
    for (std::int64_t expected = 1;; ++expected) {
        const Result<bool> more = walk.next();
        if (!more) return std::unexpected(more.error());
        if (!*more) return result;
        const record::RecordedTick tick = motion->at(walk.block(), walk.row());
        if (tick.tick > range.to) return result;
        if (const auto ok = check_tick(reader, tick); !ok) return std::unexpected(ok.error());
        if (tick.tick != expected)
            return fail(reader.path(),
                        "tick " + std::to_string(tick.tick) + " follows tick " + std::to_string(expected - 1) +
                            ": others were lost, and each depends on them",
                        "replay with --to " + std::to_string(expected - 1) + " what is before");
        if (const auto ready = updates->bring_to(tick.surface_sequence, touch.service()); !ready)
            return std::unexpected(ready.error());
        const haptics::TickRecord again = repeated(hand, touch, tick);
        if (tick.tick < range.from) continue;
        std::vector<record::Word> row = record::row_of(again, {0, 1});
        row.push_back(touch.object_of(again, 0));
        for (std::size_t c = 0; c < row.size(); ++c) {
            if (walk.at(c) == row[c]) continue;
            result.difference =
                record::difference_of(reader.hands()[0].name, columns[c], tick.tick, walk.at(c), row[c]);
            return result;
        }
        ++result.ticks;
    }
}

std::vector<record::Column> through_columns() {
    using record::ColumnType;
    std::vector<record::Column> columns{{"tick", "", "", ColumnType::i64}, {"time_ns", "ns", "", ColumnType::i64}};
    const auto vector = [&](const std::string& before, const std::string& after, const char* unit, const char* frame) {
        for (const char* axis : {"x", "y", "z"})
            columns.push_back({before + axis + after, unit, frame, ColumnType::f64});
    };
    vector("proxy0_object_", "_m", "m", "object");
    vector("force0_device_", "_N", "N", "device");
    columns.push_back({"penetration0_m", "m", "object", ColumnType::f64});
    columns.push_back({"triangle0", "", "", ColumnType::u32});
    columns.push_back({"object0", "", "", ColumnType::u32});
    vector("desired_force_device_", "_N", "N", "device");
    vector("commanded_force_device_", "_N", "N", "device");
    columns.push_back({"flags", "", "", ColumnType::u32});
    columns.push_back({"cause", "", "", ColumnType::u32});
    columns.push_back({"proxy0_deviation_m", "m", "object", ColumnType::f64});
    columns.push_back({"commanded_force_deviation_N", "N", "device", ColumnType::f64});
    return columns;
}

Result<ThroughFigures> feel_through(record::RecordReader& reader, scene::MeshPart& part,
                                    std::span<const scene::ObjectId> ids, const scene::MaterialTable& materials,
                                    double tool_radius_m, const record::TickRange& range, const TakeRow& take) {
    if (const auto ok = check_hand(reader); !ok) return std::unexpected(ok.error());
    const Result<record::MotionColumns> motion = record::MotionColumns::find(reader, 0);
    const Result<RecordedTouch> recorded = RecordedTouch::find(reader);
    Result<devices::SimulatedHand> still = still_hand();
    if (!motion) return std::unexpected(motion.error());
    if (!recorded) return std::unexpected(recorded.error());
    if (!still) return std::unexpected(still.error());
    std::optional<WorldTouch> touch;
    std::optional<StillHand> hand;
    ThroughFigures figures;
    SteadyUpdates updates;
    Similarity mapping;
    record::RowWalk walk(reader, 0);
    for (;;) {
        const Result<bool> more = walk.next();
        if (!more) return std::unexpected(more.error());
        if (!*more) return figures;
        const record::RecordedTick tick = motion->at(walk.block(), walk.row());
        if (tick.tick < range.from) continue;
        if (tick.tick > range.to) return figures;
        if (const auto ok = check_tick(reader, tick); !ok) return std::unexpected(ok.error());
        const bool is_first = !touch;
        if (is_first) {
            touch.emplace(part, materials, settings_through(reader, tick, tool_radius_m));
            hand.emplace(std::move(*still), touch->channels());
            mapping = tick.object_from_device;
        }
        if (!same_mapping(mapping, tick.object_from_device)) touch->use_mapping(mapping = tick.object_from_device);
        const auto updated = updates.before(tick, hand->loop.period_ns(), touch->service());
        if (!updated) return std::unexpected(updated.error());
        const haptics::TickRecord felt = repeated(*hand, *touch, tick);
        const std::uint32_t object = touch->object_of(felt, 0);
        const Deviation deviation{glm::length(felt.contact.points[0].proxy_object_m - recorded->proxy_m(walk)),
                                  glm::length(felt.gate.given.force_device_N - recorded->force_N(walk))};
        if (is_first) note_beginning(figures, tick, felt, part, ids, tool_radius_m);
        note_tick(figures, tick, felt, object, deviation, part);
        if (const auto taken = take(tick, through_row(tick, felt, object, deviation)); !taken)
            return std::unexpected(taken.error());
    }
}

}  // namespace burin::activities
