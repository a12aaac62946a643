// SPDX-License-Identifier: MIT
// The hands of a session: for each the opened device, what steers it, and the channels of each of its parts. One haptic
// loop drives all parts of all hands in one turn, so that they share a period's budget (haptics/haptic_loop.hpp); their
// devices must have one rate.
//
// Parts are numbered through, those of the first hand first: the number of a part is its number in the scene
// (scene/scene_service.hpp), in the loop and in a session file. The loop runs on a thread of its own, or is stepped by
// whoever drives the session; all other functions are the frame's thread's.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/space.hpp"
#include "devices/haptic/amplifiers.hpp"
#include "scene/contact_events.hpp"

namespace burin::devices {
struct DeviceDescription;  // devices/haptic/haptic_device.hpp
struct HandTarget;         // devices/hand/hand_target.hpp
class HapticDevice;        // devices/haptic/haptic_device.hpp
struct SteeredTarget;
}  // namespace burin::devices

namespace burin::haptics {
class HapticLoop;       // haptics/haptic_loop.hpp
struct HapticChannels;  // haptics/channels.hpp
struct TickParameters;  // haptics/tick_parameters.hpp
struct ToolState;       // haptics/tool_state.hpp
}  // namespace burin::haptics

namespace burin::session {

struct BroughtHand;  // session/activity/brought_hand.hpp

// Which device is whose, and where a simulated hand rests in it.
struct HandToOpen {
    std::string name;    // "right"; empty for the only hand
    std::string device;  // by its name (devices/registry/device_registry.hpp)
    Pose rest_device;
    const BroughtHand* brought = nullptr;  // leads it in place of what the session tells; null: nobody
};

using scene::PartOfHand;

// Says whose device an Error is about, where hands have names.
[[nodiscard]] Error of_hand(const std::string& name, Error error);

class SessionHands {
public:
    // Ticks that the rings of each part hold, for the scene and for the recording.
    struct Rings {
        std::size_t ticks, records;
    };
    // pace: of the machine (haptics::WorkSettings).
    SessionHands(const Rings& rings, double pace);
    ~SessionHands();
    SessionHands(const SessionHands&) = delete;
    SessionHands& operator=(const SessionHands&) = delete;

    // Opens a device for each hand, simulated ones with their hand at rest. Fails, and names the hand, where one does
    // not open, or where they do not tick at one rate. stands_in: of a recording that is done again (HapticHost). The
    // clock must outlive them.
    [[nodiscard]] Result<void> open(std::span<const HandToOpen> wanted, Clock& clock, bool stands_in = false);

    [[nodiscard]] std::size_t hands() const { return hands_.size(); }
    [[nodiscard]] std::size_t parts() const { return parts_.size(); }
    [[nodiscard]] PartOfHand part_of_hand(std::size_t part) const;
    // Returns the number of the hand's first part, by which it is drawn and reported.
    [[nodiscard]] std::size_t first_part(std::size_t hand) const;
    [[nodiscard]] std::size_t parts_of(std::size_t hand) const;
    // Returns the names that make it up: the hand's, "right", and the part's within it, "index"; each may be empty.
    [[nodiscard]] const std::string& name_of_hand(std::size_t hand) const;
    [[nodiscard]] const std::string& name_in_hand(std::size_t part) const;
    // Returns the number of a part, by which the scene knows it; nothing where there is none.
    [[nodiscard]] std::optional<std::size_t> number_of(PartOfHand of) const {
        return of.hand < hands() && of.part < parts_of(of.hand) ? std::optional(first_part(of.hand) + of.part)
                                                                : std::nullopt;
    }
    // Returns a hand's device as --device names it, with what was found when it was opened (devices::OpenedDevice).
    [[nodiscard]] const std::string& settled_device(std::size_t hand) const;
    // Names a part for people: "right", "left index"; the device's name for the only part of the only hand.
    [[nodiscard]] std::string name_of(std::size_t part) const;

    // Tells what a gap between two targets means. On a path the hand moves evenly through it. A mouse reports many
    // times a second while it moves, so a gap is a rest; a hand that played it as a slow motion would lag by the gap.
    enum class Source : std::uint8_t { path, mouse };
    // A gap from which on a mouse has rested, and how long before the target behind it the rest has ended.
    static constexpr Nanoseconds kMouseRests_ns = 60'000'000, kMouseSetsOut_ns = 10'000'000;
    // Publishes where a hand is to go, for its device's next ticks: through the targets of the way, each at its own
    // time, to where it is to be at time_ns if the way does not end there. All times are session time.
    void move_hand(std::size_t hand, std::span<const devices::SteeredTarget> way, Nanoseconds time_ns,
                   const devices::HandTarget& end, Source source = Source::path);
    // Returns the number of targets that were lost to a full channel, of all hands.
    [[nodiscard]] std::uint64_t lost_targets() const;
    // Publishes other parameters of a part's ticks; numbers them, and gives them the machine's pace.
    void publish(std::size_t part, haptics::TickParameters parameters);
    // Switches the amplifiers of a hand's device; nothing where it has none that can be switched from here.
    [[nodiscard]] std::optional<devices::AmplifierAnswer> switch_amplifiers(std::size_t hand, bool on);
    // Returns what the devices have said since the last call, each with its hand's name.
    [[nodiscard]] std::vector<std::string> take_messages();
    // Returns the commands that the devices' keys have given since the last call: "undo".
    [[nodiscard]] std::vector<std::string> take_commands();
    // Returns the newest tool state that the loop has published for a part.
    [[nodiscard]] const haptics::ToolState& newest_tool(std::size_t part);

    [[nodiscard]] double pace() const { return pace_; }
    [[nodiscard]] haptics::HapticLoop& loop() { return *loop_; }
    [[nodiscard]] const haptics::HapticLoop& loop() const { return *loop_; }
    [[nodiscard]] haptics::HapticChannels& channels(std::size_t part);
    // Returns the channels of all parts, in their order.
    [[nodiscard]] std::vector<haptics::HapticChannels*> channels_of_parts();
    [[nodiscard]] const devices::DeviceDescription& device(std::size_t part) const;
    // Returns a part's device itself, for what one kind alone counts.
    [[nodiscard]] const devices::HapticDevice& opened(std::size_t part) const;
    // Returns whether a person's hand feels any of the devices.
    [[nodiscard]] bool felt_by_person() const;

private:
    struct Hand;  // its name, its opened device, and what steers that
    struct Part;  // its channels, and whose it is
    [[nodiscard]] Result<void> open_one(const HandToOpen& wanted, Clock& clock, bool stands_in);

    Rings rings_;
    double pace_;
    std::vector<std::unique_ptr<Hand>> hands_;
    std::vector<std::unique_ptr<Part>> parts_;
    std::unique_ptr<haptics::HapticLoop> loop_;  // after what it ticks
};

}  // namespace burin::session
