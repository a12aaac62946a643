// SPDX-License-Identifier: MIT
#include "session/hands/session_hands.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/hand/steered_hand.hpp"
#include "devices/haptic/opened_device.hpp"
#include "devices/haptic/recorded_device.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "devices/registry/device_registry.hpp"
#include "devices/registry/haptic_host.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "session/activity/brought_hand.hpp"
#include "session/record/recordings.hpp"

namespace burin::session {
namespace {

devices::AnyHand leading(const HandToOpen& wanted, devices::SteeredHand steered) {
    if (wanted.brought != nullptr && wanted.brought->leads) return *wanted.brought->leads;
    return steered;
}

// Opens a device by its name, or the wand that an activity describes.
Result<devices::OpenedDevice> open_device(const HandToOpen& wanted, devices::HapticHost host) {
    if (wanted.brought == nullptr || !wanted.brought->handle)
        return devices::open_haptic_device(wanted.device, std::move(host));
    auto wand = std::make_unique<devices::SimulatedWand>(std::move(host.hand), *wanted.brought->handle, &host.clock);
    devices::Amplifiers* const amplifiers = wand.get();
    return devices::of_one_part(std::move(wand), amplifiers);
}

}  // namespace

Error of_hand(const std::string& name, Error error) {
    if (!name.empty()) error.where = "hand " + name + ": " + error.where;
    return error;
}

struct SessionHands::Hand {
    std::string name;
    devices::HandSteering steering;
    devices::OpenedDevice device;
    std::string given;            // what it was opened by
    devices::SteeredTarget told;  // the last target published
    std::size_t first_part = 0;
};

struct SessionHands::Part {
    Part(PartOfHand of_hand, const Rings& rings) : of(of_hand), channels(rings.ticks, rings.records) {}
    PartOfHand of;
    haptics::HapticChannels channels;
    std::uint64_t parameter_sequence = 0;
};

SessionHands::SessionHands(const Rings& rings, double pace) : rings_(rings), pace_(pace) {}

SessionHands::~SessionHands() = default;

PartOfHand SessionHands::part_of_hand(std::size_t part) const { return parts_[part]->of; }

std::size_t SessionHands::first_part(std::size_t hand) const { return hands_[hand]->first_part; }

std::size_t SessionHands::parts_of(std::size_t hand) const { return hands_[hand]->device.parts.size(); }

const std::string& SessionHands::name_of_hand(std::size_t hand) const { return hands_[hand]->name; }

const std::string& SessionHands::name_in_hand(std::size_t part) const {
    return hands_[parts_[part]->of.hand]->device.parts[parts_[part]->of.part].name;
}

haptics::HapticChannels& SessionHands::channels(std::size_t part) { return parts_[part]->channels; }

const haptics::ToolState& SessionHands::newest_tool(std::size_t part) { return channels(part).tool.newest(); }

const devices::DeviceDescription& SessionHands::device(std::size_t part) const {
    const PartOfHand of = parts_[part]->of;
    return hands_[of.hand]->device.parts[of.part].device->description();
}

const devices::HapticDevice& SessionHands::opened(std::size_t part) const {
    const PartOfHand of = parts_[part]->of;
    return *hands_[of.hand]->device.parts[of.part].device;
}

Result<void> SessionHands::open(std::span<const HandToOpen> wanted, Clock& clock, bool stands_in) {
    for (const HandToOpen& one : wanted) BURIN_TRY_DO(open_one(one, clock, stands_in));
    std::vector<haptics::LoopPart> parts;
    const double rate_Hz = device(0).rate_Hz;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const PartOfHand of = parts_[i]->of;
        if (device(i).rate_Hz != rate_Hz)
            return fail("--device " + hands_[of.hand]->name + "=" + device(i).name,
                        formatted("ticks %g times a second, and %s=%s %g times", device(i).rate_Hz,
                                  hands_.front()->name.c_str(), device(0).name, rate_Hz),
                        "take devices of one rate: one loop drives both");
        parts.push_back({*hands_[of.hand]->device.parts[of.part].device, parts_[i]->channels, of.hand});
    }
    loop_ = std::make_unique<haptics::HapticLoop>(parts, clock);
    return {};
}

Result<void> SessionHands::open_one(const HandToOpen& wanted, Clock& clock, bool stands_in) {
    auto hand = std::make_unique<Hand>();
    hand->name = wanted.name;
    hand->first_part = parts_.size();
    devices::HandTarget rest;
    rest.position_device_m = wanted.rest_device.position_m;
    rest.orientation_device = wanted.rest_device.orientation;
    BURIN_TRY(steered, devices::SteeredHand::create(&hand->steering, rest));
    hand->told.position_device_m = rest.position_device_m;
    hand->told.orientation_device = rest.orientation_device;
    auto opened = open_device(wanted, {clock, leading(wanted, std::move(steered)), stands_in, &session_recordings()});
    if (!opened) return std::unexpected(of_hand(wanted.name, opened.error()));
    const bool is_read = wanted.brought == nullptr || !wanted.brought->samples;
    hand->device = is_read ? std::move(*opened)
                           : devices::recorded_device(*wanted.brought->samples, {}, std::move(*opened), clock);
    hand->given = wanted.device;
    for (std::size_t i = 0; i < hand->device.parts.size(); ++i)
        parts_.push_back(std::make_unique<Part>(PartOfHand{hands_.size(), i}, rings_));
    hands_.push_back(std::move(hand));
    return {};
}

const std::string& SessionHands::settled_device(std::size_t hand) const {
    const std::string& settled = hands_[hand]->device.settled;
    return settled.empty() ? hands_[hand]->given : settled;
}

std::string SessionHands::name_of(std::size_t part) const {
    const PartOfHand of = parts_[part]->of;
    const Hand& hand = *hands_[of.hand];
    const std::string& own = hand.device.parts[of.part].name;
    if (hand.name.empty() && own.empty()) return device(part).name;
    return hand.name + (hand.name.empty() || own.empty() ? "" : " ") + own;
}

void SessionHands::move_hand(std::size_t hand, std::span<const devices::SteeredTarget> way, Nanoseconds time_ns,
                             const devices::HandTarget& end, Source source) {
    Hand& own = *hands_[hand];
    const auto tell = [&](const devices::SteeredTarget& target) {
        if (source == Source::mouse && target.time_ns - own.told.time_ns > kMouseRests_ns) {
            devices::SteeredTarget rested = own.told;
            rested.time_ns = target.time_ns - kMouseSetsOut_ns;
            static_cast<void>(own.steering.push(rested));
        }
        if (own.steering.push(target)) own.told = target;  // else the next frame tells the end again
    };
    for (const devices::SteeredTarget& target : way) tell(target);
    const bool is_there = end.position_device_m == own.told.position_device_m && end.buttons == own.told.buttons &&
                          end.orientation_device == own.told.orientation_device;
    if (!is_there) tell({time_ns, end.position_device_m, end.orientation_device, end.buttons});
}

std::uint64_t SessionHands::lost_targets() const {
    std::uint64_t lost = 0;
    for (const auto& hand : hands_) lost += hand->steering.lost();
    return lost;
}

void SessionHands::publish(std::size_t part, haptics::TickParameters parameters) {
    Part& own = *parts_[part];
    parameters.sequence = ++own.parameter_sequence;
    parameters.work.pace = pace_;
    own.channels.parameters.draft() = std::move(parameters);
    own.channels.parameters.publish();
}

std::optional<devices::AmplifierAnswer> SessionHands::switch_amplifiers(std::size_t hand, bool on) {
    devices::Amplifiers* const amplifiers = hands_[hand]->device.amplifiers;
    return amplifiers != nullptr ? std::optional(amplifiers->switch_amplifiers(on)) : std::nullopt;
}

std::vector<std::string> SessionHands::take_messages() {
    std::vector<std::string> all;
    for (const auto& hand : hands_) {
        if (hand->device.messages == nullptr) continue;
        for (const std::string& message : hand->device.messages->take_messages())
            all.push_back(hand->name.empty() ? message : hand->name + ": " + message);
    }
    return all;
}

std::vector<std::string> SessionHands::take_commands() {
    std::vector<std::string> all;
    for (const auto& hand : hands_) {
        if (hand->device.messages == nullptr) continue;
        for (std::string& command : hand->device.messages->take_commands()) all.push_back(std::move(command));
    }
    return all;
}

std::vector<haptics::HapticChannels*> SessionHands::channels_of_parts() {
    std::vector<haptics::HapticChannels*> channels;
    for (const auto& part : parts_) channels.push_back(&part->channels);
    return channels;
}

bool SessionHands::felt_by_person() const {
    for (std::size_t i = 0; i < parts_.size(); ++i)
        if (device(i).felt_by_person) return true;
    return false;
}

}  // namespace burin::session
