// SPDX-License-Identifier: MIT
#include "session/options/session_setup.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/haptic/mouse_arm.hpp"
#include "devices/registry/device_nature.hpp"

namespace burin::session {
namespace {

bool is_hand_name(const std::string& name) {
    constexpr const char* kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    return !name.empty() && name.size() <= 32 && name.find_first_not_of(kLetters) == std::string::npos;
}

// Returns where the = behind a hand's name is; npos: a device alone is named. That may have a = of its own behind a
// colon or, where the colon is missing, behind the comma of a setting: omni,model=touch-x.
std::size_t hand_ends_at(const std::string& text) {
    const std::size_t equals = text.find('=');
    return equals < text.find_first_of(":,@") ? equals : std::string::npos;
}

}  // namespace

Result<NamedDevice> parse_named_device(const std::string& text) {
    const std::size_t equals = hand_ends_at(text);
    NamedDevice named{text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1)};
    if (equals == std::string::npos)
        return fail("--device " + text, "does not say whose device it is, and there are several hands",
                    "write NAME=DEVICE for each, such as right=" + text);
    if (!is_hand_name(named.hand))
        return fail("--device " + text, "gives a hand a name with other than letters, digits, - and _",
                    "write such as right=simulated");
    if (named.device.empty())
        return fail("--device " + text, "names no device", "write such as " + named.hand + "=simulated");
    return named;
}

std::vector<NamedDevice> devices_of(const HandsSetup& hands) {
    return hands.named.empty() ? std::vector<NamedDevice>{{"", hands.device}} : hands.named;
}

Result<MouseMode> parse_mouse_mode(const std::string& text, const std::string& where) {
    const auto names = mouse_mode_names();
    const auto at = std::ranges::find(names, text);
    if (at == names.end())
        return fail(where, "is no way to lead a hand",
                    "did you mean " + std::string(nearest_name(text, names)) + "? There are free and surface");
    return static_cast<MouseMode>(at - names.begin());
}

std::optional<Error> no_surface(const SessionSetup& setup) {
    const std::string where = "--mouse surface";
    if (setup.activity != nullptr || setup.scene.no_workpiece || !setup.scene.world.empty() ||
        setup.scene.given != nullptr)
        return Error{"follows the surface of a workpiece alone, and the session has other things to touch", where,
                     "leave it out, and the mouse flies freely"};
    if (!setup.hands.named.empty())
        return Error{"leads one hand, and the session has several", where, "leave it out, and the mouse flies freely"};
    const Result<devices::DeviceNature> nature = devices::nature_of_device(setup.hands.device);
    if (!nature) return nature.error();
    if (nature->leads_itself)
        return Error{"leads the hand, and that of " + setup.hands.device + " leads itself", where,
                     "leave --mouse out, or --device"};
    if (nature->handle || nature->is_worn || nature->felt_by_person || nature->is_emulated || nature->parts != 1)
        return Error{"leads a tool that nobody holds, and the device is " + setup.hands.device, where,
                     "leave --device out, or --mouse"};
    return std::nullopt;
}

Result<void> settle_mouse(SessionSetup& setup) {
    const std::optional<Error> cannot = no_surface(setup);
    if (!setup.hands.mouse && setup.record.input.empty() && !cannot) setup.hands.mouse = MouseMode::surface;
    if (setup.hands.mouse != MouseMode::surface) return {};
    if (cannot) return std::unexpected(*cannot);
    if (!setup.hands.device_given) setup.hands.device = devices::kMouseArm;
    return {};
}

void settle_view(SessionSetup& setup) {
    const bool has_world = !setup.scene.world.empty() || setup.scene.given != nullptr;
    if (has_world && setup.record.input.empty() && setup.desk.wall.empty() && setup.activity == nullptr)
        setup.desk.frames_world = true;
}

void settle_room(SessionSetup& setup, bool in_session) {
    if (setup.carve.workpiece.room) return;
    const bool adds = in_session
                          ? setup.record.input.empty()
                          : !setup.carve.stroke.file.empty() && setup.hands.tool.operation == compute::Operation::fill;
    setup.carve.workpiece.room = adds ? workpiece::kUsualRoom : 0.0;
}

Result<void> set_devices(HandsSetup& hands, const std::vector<std::string>& given) {
    if (given.empty()) return {};
    hands.device_given = true;
    if (given.size() == 1 && hand_ends_at(given.front()) == std::string::npos) {
        hands.device = given.front();
        return {};
    }
    if (given.size() > kMostHands)
        return fail("--device", "is given " + std::to_string(given.size()) + " times",
                    "a session has " + std::to_string(kMostHands) + " hands at most");
    std::vector<NamedDevice> all;
    for (const std::string& text : given) {
        BURIN_TRY(named, parse_named_device(text));
        if (std::ranges::find(all, named.hand, &NamedDevice::hand) != all.end())
            return fail("--device " + text, "is a second device of one name", "give each hand a name of its own");
        all.push_back(std::move(named));
    }
    hands.device = all.front().device;
    hands.named = std::move(all);
    return {};
}

}  // namespace burin::session
