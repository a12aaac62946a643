// SPDX-License-Identifier: MIT
#include "devices/emulators/emulator_registry.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"
#include "base/try.hpp"
#include "devices/emulators/emulated_dhd.hpp"
#include "devices/emulators/emulated_dtrack.hpp"
#include "devices/emulators/emulated_falcon.hpp"
#include "devices/emulators/emulated_glove.hpp"
#include "devices/emulators/emulated_inverse3.hpp"
#include "devices/emulators/emulated_omni.hpp"
#include "devices/emulators/emulated_spacemouse.hpp"
#include "devices/emulators/emulated_vrpn.hpp"
#include "devices/emulators/emulated_wand.hpp"
#include "devices/trackers/dtrack_protocol.hpp"
#include "devices/trackers/vrpn_protocol.hpp"

namespace burin::devices {
namespace {

Result<void> run_glove(const EmulatorOptions& options) {
    if (!options.at.empty())
        return fail("emulated glove", "takes no address: " + options.at, "it says on which port it is");
    BURIN_TRY(port, GlovePort::create());
    options.is_there("--device glove:" + port.name());
    port.run({.silent_from_s = options.silence.from_s, .silent_for_s = options.silence.for_s}, options.ends);
    return {};
}

Result<void> run_vrpn(const EmulatorOptions& options) {
    const auto at = network_address(options.at, {"127.0.0.1", kVrpnPort});
    if (!at) return fail("emulated VRPN server", "has no address " + options.at, "write HOST, PORT or HOST:PORT");
    BURIN_TRY(server, EmulatedVrpn::create(*at));
    options.is_there("--tracker vrpn:" + server.address().text());
    server.run({.silence = options.silence}, options.ends);
    return {};
}

Result<void> run_omni(const EmulatorOptions& options) {
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto omni = EmulatedOmni::create(name, {.script = {}, .silence = options.silence});
    if (!omni) return std::unexpected(omni.error());
    options.is_there("--device omni:" + name);
    omni->run(options.ends);
    return {};
}

Result<void> run_falcon(const EmulatorOptions& options) {
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto falcon = EmulatedFalcon::create(name, {.script = {}, .silence = options.silence});
    if (!falcon) return std::unexpected(falcon.error());
    options.is_there("--device falcon:" + name);
    falcon->run(options.ends);
    return {};
}

Result<void> run_dhd(const EmulatorOptions& options) {
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto dhd = EmulatedDhd::create(name, {.script = {}, .silence = options.silence});
    if (!dhd) return std::unexpected(dhd.error());
    options.is_there("--device dhd:" + name);
    dhd->run(options.ends);
    return {};
}

Result<void> run_inverse3(const EmulatorOptions& options) {
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto inverse3 = EmulatedInverse3::create(name, {.script = {}, .silence = options.silence});
    if (!inverse3) return std::unexpected(inverse3.error());
    options.is_there("--device inverse3:" + name);
    inverse3->run(options.ends);
    return {};
}

Result<void> run_wand(const EmulatorOptions& options) {
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto wand = EmulatedWand::create(name, {.script = {}, .silence = options.silence});
    if (!wand) return std::unexpected(wand.error());
    options.is_there("--device wand:" + name);
    wand->run(options.ends);
    return {};
}

Result<void> run_spacemouse(const EmulatorOptions& options) {
    if (!options.layout.empty() && options.layout != "split" && options.layout != "joined")
        return fail("emulated spacemouse", "has no layout " + options.layout,
                    "write split, with the turn in a report of its own, or joined");
    const std::string name = options.at.empty() ? "emulated" : options.at;
    auto spacemouse =
        EmulatedSpaceMouse::create(name, {.joined = options.layout != "split", .silence = options.silence});
    if (!spacemouse) return std::unexpected(spacemouse.error());
    options.is_there("--device spacemouse:" + name);
    spacemouse->run(options.ends);
    return {};
}

Result<void> run_dtrack(const EmulatorOptions& options) {
    const auto to = network_address(options.at, {"127.0.0.1", kDTrackPort});
    if (!to) return fail("emulated DTrack", "has no address " + options.at, "write HOST, PORT or HOST:PORT");
    options.is_there("--tracker dtrack:" + std::to_string(to->port));
    return run_emulated_dtrack(*to, options.silence, options.ends);
}

constexpr std::array kEmulators{
    EmulatorKind{"glove", "a force-feedback glove on a serial line, whose fingers close and open", run_glove},
    EmulatorKind{"omni", "a PHANTOM Omni whose hand circles with its button down; --at emulated-2 for a second one",
                 run_omni},
    EmulatorKind{"falcon", "a Novint Falcon in the same hand, at the far end of its USB cable; --at as for the omni",
                 run_falcon},
    EmulatorKind{"dhd", "a Force Dimension omega.3 in the same hand; --at as for the omni", run_dhd},
    EmulatorKind{"inverse3", "Haply's service with an Inverse3 in the same hand; --at as for the omni", run_inverse3},
    EmulatorKind{"wand", "a Quanser wand that a hand takes out of its jig and circles; --at as for the omni", run_wand},
    EmulatorKind{
        "spacemouse",
        "a 3Dconnexion SpaceMouse whose cap circles with its first button down, as --device or --tracker; --at "
        "as for the omni, --layout split or joined",
        run_spacemouse, true},
    EmulatorKind{"dtrack", "ART's DTrack with a head and a flystick that sway, which sends to 127.0.0.1:5000",
                 run_dtrack},
    EmulatorKind{"vrpn", "a VRPN server with a head and a wand that sway, at 127.0.0.1:3883", run_vrpn},
};

}  // namespace

std::span<const EmulatorKind> emulator_kinds() { return kEmulators; }

Result<void> run_emulator(std::string_view name, const EmulatorOptions& options) {
    const auto kind = std::ranges::find(kEmulators, name, &EmulatorKind::name);
    if (kind != kEmulators.end() && !kind->has_layouts && !options.layout.empty())
        return fail("emulated " + std::string(name), "has no layouts: " + options.layout, "leave --layout out");
    if (kind != kEmulators.end()) return kind->run(options);
    std::array<std::string_view, kEmulators.size()> names;
    std::ranges::transform(kEmulators, names.begin(), &EmulatorKind::name);
    return fail("emulator " + std::string(name), "is none that Burin has",
                "did you mean " + std::string(nearest_name(name, names)) + "? There are: " + joined(names));
}

std::string emulator_usage() {
    std::string text;
    for (const EmulatorKind& kind : kEmulators)
        text += (text.empty() ? "" : "; ") + std::string(kind.name) + ": " + std::string(kind.usage);
    return text;
}

}  // namespace burin::devices
