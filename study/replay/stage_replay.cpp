// SPDX-License-Identifier: MIT
#include "study/replay/stage_replay.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "base/try.hpp"
#include "record/columns.hpp"
#include "record/record_reader.hpp"
#include "record/touched_columns.hpp"
#include "study/folder/stage_recording.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::study {
namespace {

constexpr std::array kInputs{"time_ns",
                             "sample_time_ns",
                             "position_device_x_m",
                             "position_device_y_m",
                             "position_device_z_m",
                             "orientation_device_qx",
                             "orientation_device_qy",
                             "orientation_device_qz",
                             "orientation_device_qw",
                             "buttons",
                             "fault"};

std::string fact_in(const record::RecordReader& reader, const char* key) {
    const auto found = reader.facts().find(key);
    return found != reader.facts().end() ? found->second : std::string();
}

// A tick's inputs as a block holds them.
class Inputs {
public:
    // Requires all columns.
    explicit Inputs(const std::vector<record::Column>& columns) {
        for (std::size_t i = 0; i < kInputs.size(); ++i) {
            const auto found = std::ranges::find(columns, kInputs[i], &record::Column::name);
            BURIN_CHECK(found != columns.end());
            at_[i] = static_cast<std::size_t>(found - columns.begin());
        }
    }
    [[nodiscard]] Nanoseconds now_ns(const record::Block& block, std::uint32_t row) const {
        return static_cast<Nanoseconds>(block.at(at_[0], row));
    }
    [[nodiscard]] devices::DeviceSample sample(const record::Block& block, std::uint32_t row) const {
        const auto real = [&](std::size_t i) { return std::bit_cast<double>(block.at(at_[i], row)); };
        devices::DeviceSample s;
        s.time_ns = static_cast<Nanoseconds>(block.at(at_[1], row));
        s.position_device_m = {real(2), real(3), real(4)};
        s.orientation_device = {real(8), real(5), real(6), real(7)};
        s.buttons = static_cast<std::uint32_t>(block.at(at_[9], row));
        s.fault = static_cast<devices::DeviceFault>(block.at(at_[10], row));
        return s;
    }

private:
    std::array<std::size_t, kInputs.size()> at_{};
};

// What the operator did, by the time of the tick.
Result<std::map<std::int64_t, OperatorAct>> acts_in(record::RecordReader& reader) {
    BURIN_TRY(events, reader.events());
    std::map<std::int64_t, OperatorAct> acts;
    for (const record::EventRecord& event : events) {
        if (event.name != kOperatorEvent) continue;
        const auto act = operator_act(event.value);
        if (!act)
            return fail(reader.path(), "has an act of the operator that nobody knows: " + event.value.substr(0, 40));
        acts[event.time_ns] = *act;
    }
    return acts;
}

// Puts a session's tick together again, as far as a stage goes by it, from the columns of its row.
class SessionTick {
public:
    // Requires the columns of a stage's recording.
    explicit SessionTick(const std::vector<record::Column>& columns) {
        for (std::size_t i = 0; i < columns.size(); ++i) at_[columns[i].name] = i;
    }
    [[nodiscard]] haptics::TickRecord record(const record::Block& block, std::uint32_t row,
                                             const devices::DeviceSample& sample, Nanoseconds now_ns) const {
        const auto word = [&](const std::string& name) { return block.at(at_.at(name), row); };
        const auto real = [&](const std::string& name) { return std::bit_cast<double>(word(name)); };
        const auto vector = [&](const std::string& name, const char* unit) {
            return Vec3(real(name + "_x" + unit), real(name + "_y" + unit), real(name + "_z" + unit));
        };
        haptics::TickRecord tick;
        tick.tick = word("tick");
        tick.time_ns = now_ns;
        tick.sample = sample;
        Similarity& map = tick.motion.object_from_device;
        map.position_m = vector("object_from_device", "_m");
        map.orientation = {real("object_from_device_qw"), real("object_from_device_qx"), real("object_from_device_qy"),
                           real("object_from_device_qz")};
        map.scale = real("object_from_device_scale");
        tick.contact.point_count = std::min(static_cast<std::uint32_t>(word("points")), kWandPoints);
        for (std::uint32_t i = 0; i < tick.contact.point_count; ++i) {
            haptics::PointRecord& point = tick.contact.points[i];
            const std::string number = std::to_string(i);
            point.hip_object_m = vector("hip" + number + "_object", "_m");
            point.active_triangle = static_cast<std::uint32_t>(word("triangle" + number));
            point.object = static_cast<std::uint32_t>(word("object" + number));
        }
        tick.gate.given = {vector("commanded_force_device", "_N"), vector("commanded_torque_device", "_Nm")};
        tick.gate.cause = static_cast<haptics::GateCause>(word("cause"));
        tick.flags = static_cast<std::uint32_t>(word("flags"));
        tick.gate.saturated = (tick.flags & haptics::kTickForceSaturated) != 0;
        return tick;
    }

private:
    std::map<std::string, std::size_t> at_;
};

struct Parts {
    const Group& group;
    const Stage& stage;
};

// The facts of the file against the study's protocol and the world as it is made today.
Result<Parts> check(const record::RecordReader& reader, const Protocol& protocol, const std::string& protocol_digest,
                    const FeltWorld& world) {
    const std::string& file = reader.path();
    if (fact_in(reader, kProtocolFact) != protocol_digest)
        return fail(file, "was recorded with another protocol", "put it back into the study that it belongs to");
    if (fact_in(reader, kWorldFact) != world.digest())
        return fail(file, "was felt in a world of other triangles than this program makes",
                    "replay it with the version that the study was run with");
    const Stage* stage = protocol.stage(fact_in(reader, kStageFact));
    const std::string code = fact_in(reader, kGroupFact);
    const auto group = std::ranges::find(protocol.groups, code, &Group::code);
    if (stage == nullptr || group == protocol.groups.end())
        return fail(file, "names a stage or a group that the protocol has not", "restore it from a copy");
    return Parts{*group, *stage};
}

}  // namespace

Result<StageReplay> replay_stage(const std::filesystem::path& file, const Protocol& protocol,
                                 const std::string& protocol_digest, const FeltWorld& world,
                                 const OnReplayedTick& on_tick) {
    BURIN_TRY(reader, record::RecordReader::open(file.string()));
    BURIN_TRY(parts, check(reader, protocol, protocol_digest, world));
    RepeatedStage repeated(protocol, parts.stage, parts.group, world);
    StageSession& session = repeated.session();
    const record::RowShape shape = record::shape_of(session.touch().device(), session.touch().parameters().probe);
    if (reader.hands().size() != 1 || !record::can_be_replayed(reader.hands().front().columns, shape))
        return fail(file.string(), "has other columns than a study's recording of this version",
                    "replay it with the version that the study was run with");
    const record::HandRecord& hand = reader.hands().front();
    BURIN_TRY(acts, acts_in(reader));
    const Inputs inputs(hand.columns);
    const SessionTick of_session(hand.columns);
    StageReplay replay;
    replay.columns = hand.columns.size();
    replay.closed = reader.is_closed();
    replay.of_session = fact_in(reader, kTicksFact) == kTicksOfSession;
    haptics::TickRecord followed;
    for (std::size_t b = 0; b < hand.blocks.size(); ++b) {
        BURIN_TRY(block, reader.block(0, b));
        for (std::uint32_t row = 0; row < block.rows(); ++row) {
            const Nanoseconds now_ns = inputs.now_ns(block, row);
            const auto act = acts.find(now_ns);
            const OperatorAct done = act != acts.end() ? act->second : OperatorAct::none;
            const devices::DeviceSample sample = inputs.sample(block, row);
            if (replay.of_session) {
                followed = of_session.record(block, row, sample, now_ns);
                session.follow(followed, done);
            }
            const haptics::TickRecord& tick = replay.of_session ? followed : repeated.take(sample, now_ns, done);
            ++replay.ticks;
            if (on_tick) on_tick(session, tick);
            if (replay.of_session || replay.difference) continue;
            std::vector<record::Word> again = stage_row(tick, shape);
            again.resize(hand.columns.size());  // without the walls, where there were none
            replay.difference = record::difference_in_row(hand, block, row, again);
        }
    }
    replay.end = session.state();
    replay.events = session.events();
    if (parts.stage.kind == StageKind::trial) {
        replay.model = touch_by_model(protocol, parts.stage, world, session.attempt());
        replay.record = trial_record(world.world(), session.state(), session.events(), replay.model);
    } else {
        replay.record = forces_record(session.forces());
    }
    return replay;
}

}  // namespace burin::study
