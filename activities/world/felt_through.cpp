// SPDX-License-Identifier: MIT
#include "activities/world/felt_through.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "activities/world/exploration.hpp"
#include "activities/world/nearest_object.hpp"
#include "base/try.hpp"
#include "haptics/tick_record.hpp"
#include "scene/scene_service.hpp"
#include "scene/world_file.hpp"

namespace burin::activities {
namespace {

// Until the next update, at the device: 1 m/s for more than a period; the ends of a wand are swung as well, at 6 rad/s.
constexpr double kReachAtDevice_m = 0.014, kWandReachAtDevice_m = 0.02;

// ---- What was recorded

// The recorded values from which a tick in another world deviates. A point that was not there is not a number.
class RecordedTouch {
public:
    static Result<RecordedTouch> find(const record::RecordReader& reader, const DeviceAsRecorded& device) {
        RecordedTouch touch;
        std::string missing;
        const auto vector = [&](const std::string& before, const char* unit) {
            for (const char* axis : {"x_", "y_", "z_"}) {
                const std::string name = before + axis + unit;
                touch.columns_.push_back(record::find_column(reader.hands()[0], name, record::ColumnType::f64));
                if (touch.columns_.back() == reader.hands()[0].columns.size() && missing.empty()) missing = name;
            }
        };
        vector("commanded_force_device_", "N");
        for (std::uint32_t i = 0; i < device.point_count(); ++i) vector(proxy_column(i), "m");
        touch.torque_ = touch.columns_.size();
        if (device.wand) vector("commanded_torque_device_", "Nm");
        if (!missing.empty())
            return fail(reader.path(), "has no column " + missing, "replay a recording that has all columns");
        const std::string beyond = proxy_column(device.point_count()) + "x_m";
        if (record::find_column(reader.hands()[0], beyond, record::ColumnType::f64) != reader.hands()[0].columns.size())
            return fail(reader.path(), "has more points than it names: column " + beyond,
                        "replay a recording whose settings were not changed");
        return touch;
    }
    [[nodiscard]] Vec3 force_N(const record::RowWalk& walk) const { return vector(walk, 0); }
    [[nodiscard]] Vec3 proxy_m(const record::RowWalk& walk, std::uint32_t point) const {
        return vector(walk, 3 + 3 * std::size_t{point});
    }
    // Only a wand's recording has it.
    [[nodiscard]] Vec3 torque_Nm(const record::RowWalk& walk) const { return vector(walk, torque_); }

private:
    static std::string proxy_column(std::uint32_t point) { return "proxy" + std::to_string(point) + "_object_"; }
    [[nodiscard]] Vec3 vector(const record::RowWalk& walk, std::size_t first) const {
        const auto at = [&](std::size_t i) { return std::bit_cast<double>(walk.at(columns_[first + i])); };
        return {at(0), at(1), at(2)};
    }
    std::vector<std::size_t> columns_;
    std::size_t torque_ = 0;  // where in columns_ those of the torque begin
};

// ---- A tick in the other world

struct PointThrough {
    haptics::PointRecord felt;  // not numbers where the tick did not have the point
    double deviation_m = 0.0;
};

struct TickThrough {
    record::RecordedTick recorded;
    haptics::TickRecord felt;
    std::array<PointThrough, haptics::kMostProbePoints> points{};
    double force_deviation_N = 0.0, torque_deviation_Nm = 0.0;
};

haptics::PointRecord absent_point() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    haptics::PointRecord absent;
    absent.hip_object_m = absent.proxy_object_m = absent.normal_object = absent.force_device_N = Vec3(kNone);
    absent.penetration_m = kNone;
    return absent;
}

TickThrough tick_through(const record::RecordedTick& recorded, const haptics::TickRecord& felt,
                         const RecordedTouch& was, const record::RowWalk& walk, const DeviceAsRecorded& device) {
    TickThrough tick{recorded, felt};
    for (std::uint32_t i = 0; i < device.point_count(); ++i) {
        PointThrough& point = tick.points[i];
        point.felt = i < felt.contact.point_count ? felt.contact.points[i] : absent_point();
        point.deviation_m = glm::length(point.felt.proxy_object_m - was.proxy_m(walk, i));
    }
    tick.force_deviation_N = glm::length(felt.gate.given.force_device_N - was.force_N(walk));
    if (device.wand) tick.torque_deviation_Nm = glm::length(felt.gate.given.torque_device_Nm - was.torque_Nm(walk));
    return tick;
}

// ---- The table: names and values from one list

// A column's name in pieces, put together only where names are asked for.
struct PieceOfName {
    const char* before;
    int number = -1;  // between the two; -1: none
    const char* after = "";

    [[nodiscard]] std::string text() const {
        return number < 0 ? std::string(before) + after : before + std::to_string(number) + after;
    }
};

struct ThroughNames {
    std::vector<record::Column> columns;

    void f64(const PieceOfName& name, const char* unit, const char* frame, double) {
        columns.push_back({name.text(), unit, frame, record::ColumnType::f64});
    }
    void i64(const PieceOfName& name, const char* unit, std::int64_t) {
        columns.push_back({name.text(), unit, "", record::ColumnType::i64});
    }
    void u32(const PieceOfName& name, std::uint32_t) {
        columns.push_back({name.text(), "", "", record::ColumnType::u32});
    }
};

struct ThroughValues {
    std::vector<record::Word> words;

    void f64(const PieceOfName&, const char*, const char*, double value) {
        words.push_back(std::bit_cast<record::Word>(value));
    }
    void i64(const PieceOfName&, const char*, std::int64_t value) { words.push_back(static_cast<record::Word>(value)); }
    void u32(const PieceOfName&, std::uint32_t value) { words.push_back(value); }
};

template <typename Sink>
void visit_through(Sink& sink, const DeviceAsRecorded& device, const TickThrough& tick) {
    const auto vector = [&](const char* before, int number, const std::array<const char*, 3>& after, const char* unit,
                            const char* frame, const Vec3& v) {
        for (int i = 0; i < 3; ++i) sink.f64({before, number, after[static_cast<std::size_t>(i)]}, unit, frame, v[i]);
    };
    const std::array<const char*, 3> in_N{"_x_N", "_y_N", "_z_N"}, in_Nm{"_x_Nm", "_y_Nm", "_z_Nm"};
    const int points = static_cast<int>(device.point_count());
    const auto point = [&](int i) -> const PointThrough& { return tick.points[static_cast<std::size_t>(i)]; };
    sink.i64({"tick"}, "", tick.recorded.tick);
    sink.i64({"time_ns"}, "ns", tick.recorded.time_ns);
    for (int i = 0; i < points; ++i) {
        const haptics::PointRecord& felt = point(i).felt;
        vector("proxy", i, {"_object_x_m", "_object_y_m", "_object_z_m"}, "m", "object", felt.proxy_object_m);
        vector("force", i, {"_device_x_N", "_device_y_N", "_device_z_N"}, "N", "device", felt.force_device_N);
        sink.f64({"penetration", i, "_m"}, "m", "object", felt.penetration_m);
        sink.u32({"triangle", i}, felt.active_triangle);
        sink.u32({"object", i}, felt.object);
    }
    const devices::DeviceWrench &desired = tick.felt.wanted, &commanded = tick.felt.gate.given;
    vector("desired_force_device", -1, in_N, "N", "device", desired.force_device_N);
    if (device.wand) vector("desired_torque_device", -1, in_Nm, "Nm", "device", desired.torque_device_Nm);
    vector("commanded_force_device", -1, in_N, "N", "device", commanded.force_device_N);
    if (device.wand) vector("commanded_torque_device", -1, in_Nm, "Nm", "device", commanded.torque_device_Nm);
    sink.u32({"flags"}, tick.felt.flags);
    sink.u32({"cause"}, static_cast<std::uint32_t>(tick.felt.gate.cause));
    for (int i = 0; i < points; ++i) sink.f64({"proxy", i, "_deviation_m"}, "m", "object", point(i).deviation_m);
    sink.f64({"commanded_force_deviation_N"}, "N", "device", tick.force_deviation_N);
    if (device.wand) sink.f64({"commanded_torque_deviation_Nm"}, "Nm", "device", tick.torque_deviation_Nm);
}

// ---- Figures

// Notes where the proxies begin.
void note_beginning(ThroughFigures& figures, const TickThrough& first, const scene::MeshPart& part,
                    const NearestObject& objects, const ThroughProbe& probe) {
    figures.first_tick = first.recorded.tick;
    for (std::uint32_t i = 0; i < probe.device.point_count(); ++i) {
        const haptics::PointRecord& felt = first.points[i].felt;
        ThroughPoint point;
        if (!probe.device.points.empty()) point.name = probe.device.points[i].name;
        point.begins_scene_m = felt.hip_object_m;
        // Out of material a ball's middle is moved by more than its radius; against a surface by less.
        point.begins_inside =
            (first.felt.flags & haptics::kTickPushedOut) != 0 && felt.penetration_m > (1.0 - 1e-6) * probe.radius_m;
        if (const auto near = finite(felt.hip_object_m) ? objects.at(felt.hip_object_m) : std::nullopt) {
            point.nearest = part.object(near->id).name;
            point.nearest_m = near->distance_m - probe.radius_m;
        }
        figures.points.push_back(std::move(point));
    }
}

void note_point(ThroughPoint& figures, const PointThrough& point, std::int64_t tick, const scene::MeshPart& part) {
    figures.force_max_N = std::max(figures.force_max_N, glm::length(point.felt.force_device_N));
    figures.proxy_deviation_max_m = std::max(figures.proxy_deviation_max_m, point.deviation_m);
    if (point.felt.constraints == 0) return;
    ++figures.ticks_in_contact;
    if (figures.first_contact_tick) return;
    figures.first_contact_tick = tick;
    if (point.felt.object != 0 && part.has(point.felt.object))
        figures.first_contact = part.object(point.felt.object).name;
}

void note_tick(ThroughFigures& figures, const TickThrough& tick, const scene::MeshPart& part) {
    ++figures.ticks;
    if ((tick.felt.flags & haptics::kTickPushedOut) != 0) ++figures.ticks_pushed_out;
    if (tick.felt.in_contact()) ++figures.ticks_in_contact;
    const devices::DeviceWrench& given = tick.felt.gate.given;
    figures.force_max_N = std::max(figures.force_max_N, glm::length(given.force_device_N));
    figures.torque_max_Nm = std::max(figures.torque_max_Nm, glm::length(given.torque_device_Nm));
    figures.force_deviation_max_N = std::max(figures.force_deviation_max_N, tick.force_deviation_N);
    figures.torque_deviation_max_Nm = std::max(figures.torque_deviation_max_Nm, tick.torque_deviation_Nm);
    for (std::size_t i = 0; i < figures.points.size(); ++i)
        note_point(figures.points[i], tick.points[i], tick.recorded.tick, part);
}

// ---- The other world

// Notes how near the points come to surfaces that they have not touched. A look at all objects costs more than a tick,
// so that there is none where the way since the last one is too short for a nearer place.
class Approach {
public:
    Approach(const scene::MeshPart& part, std::span<const scene::ObjectId> ids, const ThroughProbe& probe)
        : part_(part), objects_(part, ids), radius_m_(probe.radius_m), seen_(probe.device.point_count()) {
        objects_move_ = std::ranges::any_of(
            ids, [&](scene::ObjectId id) { return std::holds_alternative<scene::PathMotion>(part.object(id).motion); });
    }
    [[nodiscard]] const NearestObject& objects() const { return objects_; }

    void note(ThroughFigures& figures, const TickThrough& tick) {
        for (std::size_t i = 0; i < figures.points.size(); ++i) {
            const Vec3& at_m = tick.points[i].felt.hip_object_m;
            ThroughPoint& point = figures.points[i];
            if (point.first_contact_tick || !finite(at_m) || !may_be_nearer(seen_[i], point, at_m, tick)) continue;
            const auto near = objects_.at(at_m);
            if (!near) continue;
            seen_[i] = {.at_m = at_m, .time_ns = tick.recorded.time_ns, .near_m = near->distance_m - radius_m_};
            if (!point.came_nearest.empty() && seen_[i].near_m >= point.came_nearest_m) continue;
            point.came_nearest = part_.object(near->id).name;
            point.came_nearest_m = seen_[i].near_m;
        }
    }

private:
    struct Seen {
        Vec3 at_m{0.0};
        std::int64_t time_ns = 0;
        double near_m = 0.0;
    };
    [[nodiscard]] bool may_be_nearer(const Seen& seen, const ThroughPoint& point, const Vec3& at_m,
                                     const TickThrough& tick) const {
        if (point.came_nearest.empty()) return true;
        if (objects_move_ && tick.recorded.time_ns - seen.time_ns >= scene::SceneService::kHandsMove_ns) return true;
        return glm::distance(at_m, seen.at_m) > seen.near_m - point.came_nearest_m;
    }

    const scene::MeshPart& part_;
    NearestObject objects_;
    double radius_m_;
    bool objects_move_ = false;
    std::vector<Seen> seen_;  // of each point, at the last look
};

// Updates the scene every 10 ms, after the tick before.
class SteadyUpdates {
public:
    // The first update has been made at that time.
    explicit SteadyUpdates(Nanoseconds began_ns)
        : newest_ns_(began_ns), next_ns_(began_ns + scene::SceneService::kHandsMove_ns) {}

    Result<void> before(const record::RecordedTick& tick, scene::SceneService& service) {
        Result<void> done;
        if (newest_ns_ >= next_ns_) {
            done = service.update(newest_ns_);
            next_ns_ = newest_ns_ + scene::SceneService::kHandsMove_ns;
        }
        newest_ns_ = tick.time_ns;
        return done;
    }

private:
    Nanoseconds newest_ns_, next_ns_;
};

// Returns the settings with which the motion is felt: those of the exploration where it was one, so that its own world
// gives its own ticks; those of a wand where its points touch.
ExplorationSettings settings_through(const record::RecordReader& reader, const record::RecordedTick& first,
                                     const ThroughProbe& probe) {
    ExplorationSettings settings;
    const DeviceAsRecorded& device = probe.device;
    const Pose tool{first.sample.position_device_m, first.sample.orientation_device};
    const Vec3 hand = first.object_from_device * (tool * device.probe(probe.radius_m).points[0].offset_device_m);
    if (const auto own = recorded_settings(reader))
        settings = *own;
    else if (finite(hand))
        settings.start_scene_m = hand;
    if (device.wand && !device.points.empty()) {
        const devices::DeviceDescription described = devices::device_of(*device.wand);
        settings.clearance_ratio = 0.0;  // nothing is carved
        settings.position_noise_m = described.resolution_m;
        settings.limits.max_force_N = described.max_force_N;
    }
    settings.scene_from_device = first.object_from_device;
    settings.tool_radius_m = probe.radius_m;
    settings.reach_m = (device.wand ? kWandReachAtDevice_m : kReachAtDevice_m) * first.object_from_device.scale;
    return settings;
}

bool same_mapping(const Similarity& a, const Similarity& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.scale == b.scale;
}

// A world with the recorded hand in it.
struct OtherWorld {
    std::unique_ptr<RepeatedHand> hand;
    SteadyUpdates updates;
    Similarity mapping;
    Approach approach;

    Result<haptics::TickRecord> feel(const record::RecordedTick& tick) {
        if (!same_mapping(mapping, tick.object_from_device)) hand->use_mapping(mapping = tick.object_from_device);
        BURIN_TRY_DO(updates.before(tick, hand->service()));
        return hand->repeated(tick);
    }
};

Result<std::unique_ptr<OtherWorld>> begin_through(const record::RecordReader& reader, const record::RecordedTick& first,
                                                  const ExploredWorld& world, const ThroughProbe& probe) {
    const ExplorationSettings settings = settings_through(reader, first, probe);
    const Nanoseconds begins_ns = first.time_ns - period_of(probe.device);
    BURIN_TRY(hand, RepeatedHand::create(world, settings, probe.device, begins_ns));
    std::vector<scene::ObjectId> ids;
    for (const scene::SceneObject& object : world.scene->objects) ids.push_back(object.id);
    Approach approach(hand->objects(), ids, probe);
    return std::make_unique<OtherWorld>(std::move(hand), SteadyUpdates(begins_ns), settings.scene_from_device,
                                        std::move(approach));
}

}  // namespace

std::vector<record::Column> through_columns(const DeviceAsRecorded& device) {
    ThroughNames names;
    visit_through(names, device, {});
    return std::move(names.columns);
}

Result<ThroughFigures> feel_through(record::RecordReader& reader, const ExploredWorld& world, const ThroughProbe& probe,
                                    const record::TickRange& range, const TakeRow& take) {
    BURIN_TRY_DO(check_hand(reader, probe.device));
    const Result<record::MotionColumns> motion = record::MotionColumns::find(reader, 0);
    const Result<RecordedTouch> recorded = RecordedTouch::find(reader, probe.device);
    if (!motion) return std::unexpected(motion.error());
    if (!recorded) return std::unexpected(recorded.error());
    std::unique_ptr<OtherWorld> other;
    ThroughFigures figures;
    record::RowWalk walk(reader, 0);
    for (;;) {
        BURIN_TRY(more, walk.next());
        if (!more) return figures;
        const record::RecordedTick tick = motion->at(walk.block(), walk.row());
        if (tick.tick < range.from) continue;
        if (tick.tick > range.to) return figures;
        BURIN_TRY_DO(check_tick(reader, tick));
        const bool is_first = !other;
        if (is_first) {
            BURIN_TRY(begun, begin_through(reader, tick, world, probe));
            other = std::move(begun);
        }
        BURIN_TRY(felt, other->feel(tick));
        const scene::MeshPart& part = other->hand->objects();
        const TickThrough through = tick_through(tick, felt, *recorded, walk, probe.device);
        if (is_first) note_beginning(figures, through, part, other->approach.objects(), probe);
        note_tick(figures, through, part);
        other->approach.note(figures, through);
        ThroughValues values;
        values.words.reserve(64);
        visit_through(values, probe.device, through);
        BURIN_TRY_DO(take(tick, values.words));
    }
}

}  // namespace burin::activities
