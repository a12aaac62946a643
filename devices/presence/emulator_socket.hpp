// SPDX-License-Identifier: MIT
// The socket between a driver and an emulated device, in place of its cable: a UNIX socket of messages (SOCK_SEQPACKET)
// in the abstract namespace, named after the kind of device, the user and the emulator. It is gone with its process,
// however that ends, and leaves no file. Only processes of the same user are spoken with.
// An emulator has one cable: the host that it takes gets a greeting, and finds the connection closed where another one
// has it. Names of emulators begin with "emulated", so that a device's place and an emulator's name cannot be confused.
// Any thread.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "devices/presence/owned_file.hpp"

namespace burin::devices {

// Begins the name of every emulated device.
inline constexpr std::string_view kEmulatedName = "emulated";

// Listens for hosts, without waiting for one. `kind` is the device's, as --device spells it: "falcon". Fails where the
// name is none, and where another emulator of it runs.
[[nodiscard]] Result<OwnedFile> listen_as_emulator(const std::string& kind, const std::string& name);
// Returns the connection of a host that has come, of this user; none: nobody has.
[[nodiscard]] OwnedFile accept_host(const OwnedFile& listener);

// Connects to an emulator and waits for its greeting, whose first bytes are in `greeting`; later reads do not wait.
// `where` names the device in an Error, which says that no emulator runs by the name, or that another program has it.
struct EmulatorConnection {
    OwnedFile socket;
    std::string greeting;
};
[[nodiscard]] Result<EmulatorConnection> connect_to_emulator(const std::string& where, const std::string& kind,
                                                             const std::string& name);
// Returns the names of the emulators of a kind that run now, in order.
[[nodiscard]] std::vector<std::string> running_emulators(const std::string& kind);

}  // namespace burin::devices
