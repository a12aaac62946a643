// SPDX-License-Identifier: MIT
#include "devices/registry/device_registry.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/file_io.hpp"
#include "base/near_name.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/drivers/dhd_device.hpp"
#include "devices/drivers/omni_device.hpp"
#include "devices/drivers/wand_device.hpp"
#include "devices/falcon/falcon_device.hpp"
#include "devices/gloves/glove_device.hpp"
#include "devices/haply/inverse3_device.hpp"
#include "devices/haptic/mouse_arm.hpp"
#include "devices/haptic/recorded_device.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/simulated_wand.hpp"
#include "devices/haptic/steered_fingers.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/haptic/wand_file.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/registry/device_nature.hpp"
#include "devices/registry/haptic_host.hpp"
#include "devices/registry/haptic_kinds.hpp"
#include "devices/sample/sample_device.hpp"
#include "devices/spacemouse/spacemouse_device.hpp"
#include "devices/trackers/tracker.hpp"

namespace burin::devices {
namespace {

Result<OpenedDevice> open_simulated_omni(HapticHost host, const std::string& /*text*/) {
    return of_one_part(std::make_unique<SimulatedOmni>(std::move(host.hand), OmniModel{}, &host.clock));
}

Result<OpenedDevice> open_mouse_arm(HapticHost host, const std::string& /*text*/) {
    if (auto* const steered = std::get_if<SteeredHand>(&host.hand)) {
        BURIN_TRY_DO(steered->hold_by(mouse_grip()));
        steered->press_within(kMousePressesWithin_m);
    }
    return of_one_part(std::make_unique<SimulatedOmni>(std::move(host.hand), mouse_arm(), &host.clock));
}

Result<WandDescription> wand_described(const std::string& file) {
    return file.empty() ? WandDescription{} : read_wand(file);
}

Result<OpenedDevice> open_simulated_wand(HapticHost host, const std::string& file) {
    BURIN_TRY(wand, wand_described(file));
    auto opened = std::make_unique<SimulatedWand>(std::move(host.hand), std::move(wand), &host.clock);
    Amplifiers* const amplifiers = opened.get();
    return of_one_part(std::move(opened), amplifiers);
}

Result<OpenedDevice> open_simulated_fingers(HapticHost host, const std::string& /*text*/) {
    return simulated_fingers(std::move(host.hand), host.clock);
}

Result<void> check_port(const std::string& port) {
    if (!port.empty() && !port.starts_with('@')) return {};
    return fail("haptic device " + std::string(kGlove), "names no port", "write one: glove:/dev/ttyUSB0");
}

// Accepts any text, or none at all: the check of a driver that refuses no text.
Result<void> any_text(const std::string& /*text*/) { return {}; }

Result<OpenedDevice> open_simulated_glove(HapticHost host, const std::string& shape) {
    const auto grip = shape.empty() ? GripShape::whole : grip_named(shape);
    if (!grip && shape.ends_with(kFingerCourseFiles)) {
        if (host.stands_in) return simulated_glove(GripShape::whole, std::move(host.hand), host.clock);
        BURIN_TRY(text, read_text_file(shape, kMostFingerCourseBytes));
        BURIN_TRY(course, parse_finger_course(text, shape));
        return simulated_glove(std::move(course), std::move(host.hand), host.clock);
    }
    if (!grip)
        return fail(
            "haptic device " + std::string(kSimulatedGlove), "closes in no way that is called " + shape,
            "write one of " + joined(kGripNames) + ", or a file of its fingers' course, FILE" + kFingerCourseFiles);
    return simulated_glove(*grip, std::move(host.hand), host.clock);
}

// Opens one that rests, of a driver that needs less for it than the row of the table hands on.
template <auto rests>
Result<OpenedDevice> at_rest(const std::string& text, AnyHand /*hand*/, Clock& clock) {
    if constexpr (requires { rests(text, clock); })
        return rests(text, clock);
    else
        return rests(clock);
}

// Opens what was recorded, to stand in for it, and has its samples played.
Result<OpenedDevice> open_recorded(HapticHost host, const std::string& text) {
    BURIN_TRY(choice, recorded_choice(text));
    if (host.recordings == nullptr)
        return fail("haptic device " + std::string(kRecordedDevice) + ":" + text, "cannot be played here",
                    "play it in a session: burin sculpt --device");
    Clock& clock = host.clock;
    BURIN_TRY(hand, host.recordings->hand_of(choice.file, choice.hand));
    host.stands_in = true;
    auto like = open_haptic_device(hand.device, std::move(host));
    if (!like) return like;
    if (like->parts.size() != hand.parts.size())
        return fail(choice.file,
                    "has " + std::to_string(hand.parts.size()) + " parts of " + hand.device + ", which has " +
                        std::to_string(like->parts.size()),
                    "play it with the program that recorded it");
    return recorded_device(std::move(hand), choice, std::move(*like), clock);
}

std::vector<DevicePresence> look_for_recordings() {
    return {{Presence::perhaps,
             std::string(kRecordedDevice) + ":FILE.session",
             "plays the hand of a session that was recorded with --record FILE.session",
             {}}};
}

constexpr std::array kHapticKinds{
    HapticKind{.name = kDefaultHapticDevice,
               .usage = "a PHANTOM Omni in a simulated hand",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::simulated(open_simulated_omni),
               .takes_text = false},
    HapticKind{.name = kMouseArm,
               .usage = "an arm without friction that goes where the mouse points, and that nobody feels",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::simulated(open_mouse_arm),
               .has_force = false,
               .takes_text = false},
    HapticKind{.name = kSimulatedWand,
               .usage = "a wand that is driven in three forces and two torques, in a simulated hand; "
                        "simulated-wand:FILE.toml as FILE describes it",
               .parts = 1,
               .is_upright = true,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = true,
               .handle = wand_described,
               .open = Opening::simulated(open_simulated_wand)},
    HapticKind{.name = kSimulatedFingers,
               .usage = "four fingertips of a simulated hand, each pushed by itself",
               .parts = kFingers,
               .is_upright = true,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::simulated(open_simulated_fingers),
               .takes_text = false},
    HapticKind{.name = kGlove,
               .usage = "a glove that pushes four fingertips, on a serial line: glove:PORT, such as glove:/dev/ttyUSB0",
               .parts = kGloveFingers,
               .is_upright = true,
               .is_worn = true,
               .felt_by_person = true,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::driver({.check = check_port,
                                        .open = open_glove,
                                        .at_rest = [](const std::string&, AnyHand hand,
                                                      Clock& clock) { return open_glove({}, std::move(hand), clock); },
                                        .look = look_for_gloves})},
    HapticKind{.name = kSimulatedGlove,
               .usage =
                   "the same without a line, in a simulated hand that the first button closes; "
                   "simulated-glove:pinch or simulated-glove:point as it closes, simulated-glove:FILE.fingers as a "
                   "file leads each finger",
               .parts = kGloveFingers,
               .is_upright = true,
               .is_worn = true,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::simulated(open_simulated_glove)},
    HapticKind{
        .name = kOmni,
        .usage =
            "a PHANTOM Omni or Touch by its maker's library (OpenHaptics); omni:NAME as the maker's setup "
            "calls it, omni:NAME@LIBRARY for a library elsewhere, omni:NAME,model=touch-x for a model that it does "
            "not say, omni:emulated by burin devices emulate",
        .parts = 1,
        .is_upright = false,
        .is_worn = false,
        .felt_by_person = true,
        .has_amplifiers = false,
        .handle = nullptr,
        .open = Opening::driver(
            {.check = check_omni, .open = open_omni, .at_rest = at_rest<omni_that_rests>, .look = look_for_omnis})},
    HapticKind{
        .name = kHilWand,
        .usage = "a Quanser 5-DOF wand by its maker's library (HIL); wand:IDENTIFIER of its card, "
                 "wand:FILE.toml as FILE describes it, wand:IDENTIFIER,FILE.toml, each with @LIBRARY for a "
                 "library elsewhere; wand:emulated by burin devices emulate",
        .parts = 1,
        .is_upright = true,
        .is_worn = false,
        .felt_by_person = true,
        .has_amplifiers = true,
        .handle = wand_at,
        .open = Opening::driver(
            {.check = check_wand, .open = open_wand, .at_rest = at_rest<wand_that_rests>, .look = look_for_wands}),
        .file_of = [](const std::string& text) { return wand_address(text).file; }},
    HapticKind{
        .name = kFalcon,
        .usage = "a Novint Falcon on USB; falcon:FIRMWARE to give it its firmware, falcon:PLACE or "
                 "falcon:PLACE@FIRMWARE where there are several, falcon:emulated by burin devices emulate",
        .parts = 1,
        .is_upright = false,
        .is_worn = false,
        .felt_by_person = true,
        .has_amplifiers = false,
        .handle = nullptr,
        .open = Opening::driver(
            {.check = any_text, .open = open_falcon, .at_rest = at_rest<falcon_that_rests>, .look = look_for_falcons})},
    HapticKind{.name = kDhd,
               .usage = "a Force Dimension omega, delta, sigma or lambda by its maker's library; dhd:INDEX as that "
                        "lists them, dhd:SERIAL, dhd:INDEX@LIBRARY for a library elsewhere, dhd:emulated by burin "
                        "devices emulate",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = true,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::driver(
                   {.check = check_dhd, .open = open_dhd, .at_rest = at_rest<dhd_that_rests>, .look = look_for_dhds})},
    HapticKind{.name = kInverse3,
               .usage = "a Haply Inverse3 by its maker's service; inverse3:ID as burin devices lists it, "
                        "inverse3:HOST:PORT or inverse3:ID@HOST:PORT for a service elsewhere, inverse3:emulated by "
                        "burin devices emulate",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = true,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::driver({.check = check_inverse3,
                                        .open = open_inverse3,
                                        .at_rest = at_rest<inverse3_that_rests>,
                                        .look = look_for_inverse3s})},
    HapticKind{.name = kSpaceMouse,
               .usage =
                   "a simulated stylus whose hand a 3Dconnexion SpaceMouse leads; spacemouse:PLACE as burin devices "
                   "lists it, settings after commas: speed=0.08 (m/s), turn=1.2 (rad/s), dead=0.1; "
                   "spacemouse:emulated by burin devices emulate",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::driver({.check = check_spacemouse,
                                        .open = open_spacemouse,
                                        .at_rest = at_rest<spacemouse_that_rests>,
                                        .look = look_for_spacemice}),
               .leads_itself = true,
               .has_force = false},
    HapticKind{.name = kSpaceMouseWand,
               .usage = "a simulated wand whose hand a SpaceMouse leads, likewise; and FILE.toml as FILE describes it",
               .parts = 1,
               .is_upright = true,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = true,
               .handle = spacemouse_wand_described,
               .open = Opening::driver({.check = check_spacemouse_wand,
                                        .open = open_spacemouse_wand,
                                        .at_rest = at_rest<spacemouse_wand_that_rests>,
                                        .look = look_for_spacemouse_wands}),
               .file_of = spacemouse_file_of,
               .leads_itself = true,
               .has_force = false},
    HapticKind{
        .name = kSample,
        .usage = "a driver to copy: an arm that is made up, that nobody holds, and that a thread of the driver's meets",
        .parts = 1,
        .is_upright = false,
        .is_worn = false,
        .felt_by_person = false,
        .has_amplifiers = false,
        .handle = nullptr,
        .open = Opening::driver(
            {.check = any_text, .open = open_sample, .at_rest = at_rest<sample_that_rests>, .look = look_for_samples}),
        .leads_itself = true,
        .takes_text = false},
    HapticKind{.name = kRecordedDevice,
               .usage = "the hand of a recorded session, played again: recorded:FILE.session, or "
                        "recorded:FILE.session:HAND of several, each with ,loop to begin anew at the end",
               .parts = 1,
               .is_upright = false,
               .is_worn = false,
               .felt_by_person = false,
               .has_amplifiers = false,
               .handle = nullptr,
               .open = Opening::simulated(open_recorded),
               .might_be_there = look_for_recordings,
               .has_force = false},
};

struct ChosenKind {
    const HapticKind* kind = nullptr;
    std::string file;
};

// Refuses what the kind does not take behind its name.
Result<void> check_text(const HapticKind& kind, const std::string& text) {
    if (kind.takes_text || text.empty()) return kind.open.check(text);
    return fail("haptic device " + std::string(kind.name), "takes no description: " + text,
                "write " + std::string(kind.name) + " alone");
}

// Returns how a name is written whose colon is missing: `rest` begins with what stands in its place. wand@LIBRARY is
// wand:@LIBRARY and omni,model=touch-x has all of that as its text, spacemouse,speed=1 not the comma, and of
// inverse3@HOST:PORT, where a device stands before the @, only the place is right.
std::string with_colon(const HapticKind& kind, std::string_view rest) {
    const std::string name(kind.name);
    const bool names_model = rest.starts_with(",model=");
    const bool keeps = names_model || (rest.starts_with('@') && kind.usage.contains('@'));
    const std::string kept(rest), bare(rest.substr(1));
    if (kind.takes_text && keeps) {
        const auto right = kind.open.check(kept);
        if (right) return "write " + name + ":" + kept;
        if (names_model) return right.error().remedy;
    }
    if (kind.takes_text && !bare.empty() && kind.open.check(bare)) return "write " + name + ":" + bare;
    return kind.open.check({}) ? "write " + name + " alone" : kind.open.check({}).error().remedy;
}

// Splits NAME:FILE. Fails where there is no device of the name.
Result<ChosenKind> chosen(std::string_view name) {
    const std::string_view kind_name = name.substr(0, name.find(':'));
    const auto kind = std::ranges::find(kHapticKinds, kind_name, &HapticKind::name);
    if (kind != kHapticKinds.end())
        return ChosenKind{&*kind, std::string(name.substr(std::min(name.size(), kind_name.size() + 1)))};
    const std::string where = "haptic device " + std::string(name);
    if (tracker_kind_of(name) != nullptr)
        return fail(where, "is a tracker, which has no force", "give it as --tracker " + std::string(name));
    // wand@LIBRARY, where wand:@LIBRARY is meant, and omni,model=touch-x.
    const std::size_t end = name.find_first_of("@,=");
    const auto meant = std::ranges::find(kHapticKinds, name.substr(0, end), &HapticKind::name);
    if (end != std::string_view::npos && meant != kHapticKinds.end())
        return fail(where,
                    meant->takes_text ? "has no colon behind the device's name"
                                      : "takes no description: " + std::string(name.substr(end)),
                    with_colon(*meant, name.substr(end)));
    std::array<std::string_view, kHapticKinds.size()> names;
    std::ranges::transform(kHapticKinds, names.begin(), &HapticKind::name);
    return fail(where, "is no device that Burin knows", meant_by(kind_name, names) + "There are: " + joined(names));
}

// Returns the device that a recorded one plays; any other name as it is.
Result<std::string> played_by(std::string_view name, const Recordings* recordings) {
    constexpr std::size_t kMostDepth = 8;  // a recording of a recording of ...
    std::string of(name);
    for (std::size_t depth = 0; depth < kMostDepth; ++depth) {
        const Result<ChosenKind> wanted = chosen(of);
        if (!wanted || wanted->kind->name != kRecordedDevice || recordings == nullptr) return of;
        BURIN_TRY(choice, recorded_choice(wanted->file));
        Result<std::string> inner = recordings->device_of(choice.file, choice.hand);
        if (!inner) return inner;
        of = std::move(*inner);
    }
    return fail("haptic device " + std::string(name), "plays a recording that plays itself", "name another recording");
}

// Whether a driver's device is one of burin devices emulate: by the name of the emulator, or, of a line, by a
// pseudo-terminal, which no cable ends in.
bool is_emulated(const ChosenKind& wanted) {
    if (!wanted.kind->open.is_driver()) return false;
    if (wanted.kind->name != kGlove) return wanted.file.starts_with(kEmulatedName);
    std::error_code ignored;
    return std::filesystem::weakly_canonical(wanted.file, ignored).string().starts_with("/dev/pts/");
}

DeviceNature nature_of(const ChosenKind& wanted) {
    const HapticKind& kind = *wanted.kind;
    const bool emulated = is_emulated(wanted);
    return {.parts = kind.parts,
            .is_upright = kind.is_upright,
            .is_worn = kind.is_worn,
            .felt_by_person = kind.felt_by_person && !emulated,
            .is_emulated = emulated,
            .has_force = kind.has_force,
            .has_amplifiers = kind.has_amplifiers,
            .is_played = kind.name == kRecordedDevice,
            .leads_itself = kind.leads_itself || kind.name == kRecordedDevice,
            .handle = {}};
}

}  // namespace

Result<OpenedDevice> Opening::operator()(std::string_view name, HapticHost host, const std::string& text) const {
    if (simulated_ != nullptr) return simulated_(std::move(host), text);
    if (host.stands_in) return driver_.at_rest(text, std::move(host.hand), host.clock);
    if (dynamic_cast<MonotonicClock*>(&host.clock) == nullptr)
        return fail("haptic device " + std::string(name), "is there in real time, and this session's time is simulated",
                    "run it in a window, or with --record FILE.session, which plays an --input in real time");
    return driver_.open(text, std::move(host.hand), host.clock);
}

std::span<const HapticKind> haptic_kinds() { return kHapticKinds; }

Result<OpenedDevice> open_haptic_device(std::string_view name, HapticHost host) {
    BURIN_TRY(wanted, chosen(name));
    if (!host.stands_in) BURIN_TRY_DO(check_text(*wanted.kind, wanted.file));
    return wanted.kind->open(wanted.kind->name, std::move(host), wanted.file);
}

Result<DeviceNature> nature_of_name(std::string_view name) {
    BURIN_TRY(wanted, chosen(name));
    return nature_of(wanted);
}

Result<DeviceNature> nature_of_device(std::string_view name, const Recordings* recordings) {
    BURIN_TRY(of, played_by(name, recordings));
    BURIN_TRY(wanted, chosen(of));
    const HapticKind& kind = *wanted.kind;
    DeviceNature nature = nature_of(wanted);
    nature.is_played = nature.is_played || name.starts_with(std::string(kRecordedDevice) + ":");
    if (nature.is_played) {
        nature.felt_by_person = nature.is_emulated = nature.has_amplifiers = nature.has_force = false;
        nature.leads_itself = true;
    }
    if (kind.handle == nullptr) return nature;
    BURIN_TRY(handle, kind.handle(wanted.file));
    nature.handle = std::move(handle);
    return nature;
}

bool has_handle(std::string_view name, const Recordings* recordings) {
    const Result<std::string> of = played_by(name, recordings);
    if (!of) return false;
    const Result<ChosenKind> wanted = chosen(*of);
    return wanted && wanted->kind->handle != nullptr;
}

std::string devices_with_handles() {
    std::vector<std::string_view> names;
    for (const HapticKind& kind : kHapticKinds)
        if (kind.handle != nullptr) names.push_back(kind.name);
    return joined(names);
}

std::string handle_file_of(std::string_view name) {
    const Result<ChosenKind> wanted = chosen(name);
    if (!wanted || wanted->kind->handle == nullptr) return {};
    return wanted->kind->file_of != nullptr ? wanted->kind->file_of(wanted->file) : wanted->file;
}

std::string haptic_usage() {
    std::string text;
    for (const HapticKind& kind : kHapticKinds) {
        if (!text.empty()) text += "; ";
        text += std::string(kind.name) + ": " + std::string(kind.usage);
    }
    return text;
}

}  // namespace burin::devices
