// SPDX-License-Identifier: MIT
#include "session/live/hand_side.hpp"

#include <algorithm>
#include <utility>

#include "base/try.hpp"
#include "haptics/channels.hpp"
#include "haptics/tick_parameters.hpp"
#include "record/record_writer.hpp"
#include "scene/rendered_material.hpp"
#include "session/held/held_handle.hpp"
#include "session/record/session_file.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {
namespace {

constexpr std::size_t kTicksToLog = 8192;  // the frame's thread, which reads them for a text log, may stall for so many
// Ticks that the scene's ring holds in a session whose scene is updated step by step, some ten ticks at a time.
constexpr std::size_t kTicksUnseen = 64;

// Returns how many ticks the ring of a recording holds.
std::size_t records_of(const RecordSetup& record) {
    if (record.path.empty()) return record.lsl ? kTicksToLog : haptics::HapticChannels::kRecords;
    return is_session_file(record.path) ? burin::record::kRingTicks : kTicksToLog;
}

SessionHands::Rings rings_of(const SessionSetup& setup) {
    if (setup.desk.unseen && setup.record.path.empty()) return {kTicksUnseen, 1};
    return {haptics::HapticChannels::kTicks, records_of(setup.record)};
}

}  // namespace

HandSide::HandSide(const SessionSetup& setup, double pace) : hands_(rings_of(setup), pace) {}

Result<void> HandSide::open(const SessionSetup& setup, const SessionState& state, const Room& room,
                            const BroughtHand* brought, Clock& clock) {
    std::vector<HandToOpen> wanted;
    for (const NamedDevice& hand : devices_of(setup.hands)) {
        const std::size_t i = wanted.size();
        wanted.push_back({hand.hand,
                          hand.device,
                          {state.hands[i].target.position_device_m, room.hands[i].rest_device},
                          i == 0 ? brought : nullptr});
    }
    BURIN_TRY_DO(hands_.open(wanted, clock, setup.record.stands_in));
    tools_.resize(hands_.parts());
    return {};
}

std::vector<haptics::ToolState> HandSide::tools_of_hands() const {
    std::vector<haptics::ToolState> first;
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) first.push_back(tool_of(hand));
    return first;
}

std::vector<SceneSide::Beginning> HandSide::beginnings(const SessionState& state, const Room& room, double spacing_m,
                                                       double known_m) const {
    std::vector<SceneSide::Beginning> all;
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) {
        // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms; the
        // ends of a handle are swung as well, at 6 rad/s.
        const double scale = parameters_of(state, room, hand).workspace.object_from_device.scale;
        const double usual_m = (handles_[hand] ? 0.02 : 0.012) * scale + 2.0 * spacing_m;
        const auto& placed = room.hands[hand].placed;
        const double reach_m = std::max(placed ? placed->reach_m : usual_m, known_m);
        all.push_back({place_at_rest(hand, state, room), reach_m, spread_of(hand, state, room)});
    }
    return all;
}

std::vector<std::string> HandSide::more_than_rendered(const SessionState& state, const Room& room) const {
    std::vector<std::string> told;
    if (!state.world) return told;
    std::vector<scene::SceneObject> objects;
    for (const auto& object : state.world->objects) objects.push_back(*object);
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) {
        const devices::DeviceDescription& device = hands_.device(hands_.first_part(hand));
        std::string more = scene::more_than_rendered(objects, device, parameters_of(state, room, hand, device));
        if (!more.empty()) told.push_back(std::move(more));
    }
    return told;
}

HandSide::Switched HandSide::switch_amplifiers(std::size_t hand, bool on) {
    const std::optional<devices::AmplifierAnswer> answer = hands_.switch_amplifiers(hand, on);
    if (answer == devices::AmplifierAnswer::done)
        return {true, on ? "the amplifiers are on; the force comes back from zero"
                         : "the amplifiers are off: no force until they are enabled again"};
    const std::string why = answer ? "they stay off, since what tripped them is not over; see to the device first"
                                   : "those of " + std::string(hands_.device(hands_.first_part(hand)).name) +
                                         " cannot be switched from here";
    return {false, "amplifiers: " + why};
}

void HandSide::publish_parameters(const SessionState& state, const Room& room, const ActivitySide& activity) {
    for (std::size_t part = 0; part < hands_.parts(); ++part) {
        const PartOfHand of = hands_.part_of_hand(part);
        haptics::TickParameters parameters = parameters_of(state, room, of.hand, hands_.device(part));
        activity.adjust(of, parameters);
        hands_.publish(part, std::move(parameters));
    }
}

void HandSide::spread(const SessionState& state, const Room& room, SceneSide& scene,
                      const SceneSide::Give& give) const {
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) scene.spread(hand, spread_of(hand, state, room), give);
}

// How far a handle's points are from the first of them, in the scene as large as it is shown now.
double HandSide::spread_of(std::size_t hand, const SessionState& state, const Room& room) const {
    return handles_[hand]
               ? handles_[hand]->spread_m() * parameters_of(state, room, hand).workspace.object_from_device.scale
               : 0.0;
}

// Returns where a hand's tool is before the first tick.
Vec3 HandSide::place_at_rest(std::size_t hand, const SessionState& state, const Room& room) const {
    if (const auto& placed = room.hands[hand].placed) return placed->begins_scene_m;
    const Vec3& rest_device_m = state.hands[hand].target.position_device_m;
    const Vec3 first_device_m = handles_[hand]
                                    ? handles_[hand]->first_point_device({rest_device_m, room.hands[hand].rest_device})
                                    : rest_device_m;
    if (hand == state.hand && state.mouse == MouseMode::surface)
        return parameters_of(state, room, hand).workspace.object_from_device * first_device_m;
    return inverse(state.world_from_object) * (state.hands[hand].world_from_device * first_device_m);
}

void HandSide::settle(HandsSetup& setup) const {
    setup.device = hands_.settled_device(0);
    for (std::size_t hand = 0; hand < setup.named.size(); ++hand)
        setup.named[hand].device = hands_.settled_device(hand);
}

}  // namespace burin::session
