// SPDX-License-Identifier: MIT
#include "devices/drivers/hil_api.hpp"

#include <array>

#include "base/text.hpp"
#include "devices/drivers/loaded_library.hpp"

namespace burin::devices {
namespace {

constexpr std::uint16_t kLeastMajor = 2;  // the first that the public headers and examples are of

}  // namespace

Result<HilApi> load_hil_api(const std::string& library) {
    constexpr const char* kWhere = "haptic device wand";
    constexpr const char* kInstall = "install Quanser's HIL SDK or QUARC, version 2 or newer";
    LoadedLibrary loaded(library);
    if (!loaded.is_there() && library == kHilLibrary) loaded = LoadedLibrary(kHilFolder + library);
    if (!loaded.is_there())
        return fail(kWhere, "the library " + library + " cannot be loaded: " + loaded.why(),
                    std::string(kInstall) + ", or try an emulated wand: burin devices emulate wand");
    HilApi api;
    loaded.find("hil_get_version", api.version);
    loaded.find("hil_open", api.open);
    loaded.find("hil_close", api.close);
    loaded.find("hil_set_encoder_counts", api.set_encoder_counts);
    loaded.find("hil_set_digital_directions", api.set_digital_directions);
    loaded.find("hil_read_encoder", api.read_encoder);
    loaded.find("hil_write_analog", api.write_analog);
    loaded.find("hil_write_digital", api.write_digital);
    loaded.find("hil_watchdog_set_analog_expiration_state", api.watchdog_analog);
    loaded.find("hil_watchdog_set_digital_expiration_state", api.watchdog_digital);
    loaded.find("hil_watchdog_start", api.watchdog_start);
    loaded.find("hil_watchdog_reload", api.watchdog_reload);
    loaded.find("hil_watchdog_clear", api.watchdog_clear);
    loaded.find("hil_watchdog_stop", api.watchdog_stop);
    if (!loaded.missing().empty())
        return fail(kWhere, "the library " + library + " has no function " + loaded.missing(),
                    std::string("it is no HIL library, or another version of it: ") + kInstall);
    loaded.find_if_there("msg_get_error_messageA", api.error_text);
    HilVersion version;
    const HilError error = api.version(&version);
    if (error < 0 || version.major < kLeastMajor)
        return fail(kWhere,
                    "the library " + library + " is of version " +
                        formatted("%u.%u", unsigned{version.major}, unsigned{version.minor}) +
                        ", and Burin knows those from 2 on",
                    kInstall);
    return api;
}

std::string hil_error_text(const HilApi& api, HilError error) {
    std::array<char, 256> text{};
    if (api.error_text != nullptr) static_cast<void>(api.error_text(nullptr, error, text.data(), text.size() - 1));
    return text[0] == '\0' ? formatted("error %d", error) : text.data() + formatted(" (%d)", error);
}

}  // namespace burin::devices
