// SPDX-License-Identifier: MIT
#include "devices/spacemouse/spacemouse_port.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>

#include "base/try.hpp"
#include "devices/presence/emulator_socket.hpp"
#include "devices/presence/udev_rules.hpp"

namespace burin::devices {
namespace {

struct FoundSpaceMouse {
    std::string place;  // "hidraw3"
    std::filesystem::path file;
    SpaceMouseProduct product;
    std::string name;  // as the device calls itself
};

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Returns the value of a line KEY=VALUE.
std::string value_of(const std::string& text, const std::string& key) {
    const std::size_t at = ("\n" + text).find("\n" + key + "=");
    if (at == std::string::npos) return {};
    const std::size_t begin = at + key.size() + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
}

// Reads "0003:0000256F:0000C635": bus, vendor, product.
std::optional<SpaceMouseProduct> product_named(const std::string& hid_id) {
    unsigned int bus = 0, vendor = 0, product = 0;
    if (std::sscanf(hid_id.c_str(), "%x:%x:%x", &bus, &vendor, &product) != 3) return std::nullopt;  // NOLINT
    if (vendor > 0xffff || product > 0xffff) return std::nullopt;
    return spacemouse_product(static_cast<std::uint16_t>(vendor), static_cast<std::uint16_t>(product));
}

// hidraw2 before hidraw10.
bool is_before(const FoundSpaceMouse& a, const FoundSpaceMouse& b) {
    return a.place.size() != b.place.size() ? a.place.size() < b.place.size() : a.place < b.place;
}

std::vector<FoundSpaceMouse> spacemice_in(const HidrawPlaces& places) {
    std::vector<FoundSpaceMouse> found;
    std::error_code none;
    for (std::filesystem::directory_iterator at(places.devices, none), end; !none && at != end; at.increment(none)) {
        const std::filesystem::path device = at->path() / "device";
        const std::string uevent = text_of(device / "uevent"), descriptor = text_of(device / "report_descriptor");
        const auto product = product_named(value_of(uevent, "HID_ID"));
        if (!product || !is_multi_axis(std::as_bytes(std::span(descriptor)))) continue;
        const std::string place = at->path().filename().string();
        found.push_back({place, places.files / place, *product, value_of(uevent, "HID_NAME")});
    }
    std::ranges::sort(found, is_before);
    return found;
}

std::string named(const FoundSpaceMouse& one) {
    return std::string(one.product.name) + (one.name.empty() ? "" : " (" + one.name + ")") + " at " + one.file.string();
}

constexpr const char* kPlugIn =
    "plug it in, or switch it on; burin devices lists those that are there; or try an emulated one: burin devices "
    "emulate spacemouse";

Result<SpaceMousePort> open_emulated(const std::string& where, const std::string& name) {
    BURIN_TRY(connection, connect_to_emulator(where, kSpaceMouse, name));
    const std::string& said = connection.greeting;
    const auto number = [&](std::size_t at) {
        return static_cast<std::uint16_t>(static_cast<unsigned char>(said[at]) |
                                          static_cast<unsigned char>(said[at + 1]) << 8);
    };
    const auto product = said.size() == 4 ? spacemouse_product(number(0), number(2)) : std::nullopt;
    if (!product) return fail(where, "the emulator of this name is of another version", "start this version's");
    return SpaceMousePort{std::move(connection.socket), *product};
}

}  // namespace

Result<SpaceMousePort> open_spacemouse_port(const std::string& where, const std::string& place,
                                            const HidrawPlaces& places) {
    if (place.starts_with(kEmulatedName)) return open_emulated(where, place);
    const std::vector<FoundSpaceMouse> all = spacemice_in(places);
    const auto one =
        std::ranges::find_if(all, [&](const FoundSpaceMouse& found) { return place.empty() || found.place == place; });
    if (one == all.end()) return fail(where, place.empty() ? "there is none" : "there is none at " + place, kPlugIn);
    OwnedFile file(::open(one->file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file) return SpaceMousePort{std::move(file), one->product};
    if (errno == EACCES || errno == EPERM)
        return fail(where, one->file.string() + " may not be opened by this user", udev_remedy());
    return fail(where, one->file.string() + " cannot be opened: " + std::strerror(errno), "plug it in again");
}

std::vector<DevicePresence> look_for_spacemice(const HidrawPlaces& places) {
    std::vector<DevicePresence> found;
    for (const FoundSpaceMouse& one : spacemice_in(places)) {
        const std::string name = std::string(kSpaceMouse) + ":" + one.place;
        if (::faccessat(AT_FDCWD, one.file.c_str(), R_OK, AT_EACCESS) == 0)
            found.push_back({Presence::there, name, named(one), {}});
        else
            found.push_back({Presence::forbidden, name, named(one) + " may not be opened by this user", udev_remedy()});
    }
    if (found.empty())
        found.push_back({Presence::absent, kSpaceMouse, "there is no SpaceMouse among the HID devices", kPlugIn});
    for (const std::string& name : running_emulators(kSpaceMouse))
        found.push_back({Presence::there, std::string(kSpaceMouse) + ":" + name, "an emulated one", {}});
    return found;
}

std::string spacemouse_greeting(const SpaceMouseProduct& product) {
    return {static_cast<char>(product.vendor & 0xff), static_cast<char>(product.vendor >> 8),
            static_cast<char>(product.product & 0xff), static_cast<char>(product.product >> 8)};
}

}  // namespace burin::devices
