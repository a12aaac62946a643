// SPDX-License-Identifier: MIT
#include "devices/drivers/dhd_api.hpp"

#include "base/text.hpp"
#include "devices/drivers/loaded_library.hpp"

namespace burin::devices {
namespace {

constexpr const char* kDhdWhere = "haptic device dhd";

Result<DhdApi> dhd_functions(LoadedLibrary& loaded, const std::string& library) {
    DhdApi api;
    loaded.find("dhdGetSDKVersion", api.sdk_version);
    loaded.find("dhdGetDeviceCount", api.device_count);
    loaded.find("dhdOpenID", api.open_by_index);
    loaded.find("dhdOpenSerial", api.open_by_serial);
    loaded.find("dhdClose", api.close);
    loaded.find("dhdEnableForce", api.enable_force);
    loaded.find("dhdGetSystemType", api.system_type);
    loaded.find("dhdGetSystemName", api.system_name);
    loaded.find("dhdGetStatus", api.status);
    loaded.find("dhdGetButtonMask", api.buttons);
    loaded.find("dhdGetPositionAndOrientationFrame", api.read_pose);
    loaded.find("dhdSetForceAndTorqueAndGripperForce", api.write_force);
    loaded.find("dhdErrorGetLast", api.last_error);
    loaded.find("dhdErrorGetStr", api.error_text);
    loaded.find_if_there("dhdEnableExpertMode", api.enable_expert_mode);
    loaded.find_if_there("dhdSetWatchdog", api.set_watchdog);
    loaded.find_if_there("dhdEmulateButton", api.emulate_button);
    if (!loaded.missing().empty())
        return fail(kDhdWhere, "the library " + library + " has no function " + loaded.missing(),
                    "it is not Force Dimension's, or too old: install its SDK 3.3 or newer");
    int major = 0, minor = 0, release = 0, revision = 0;
    api.sdk_version(&major, &minor, &release, &revision);
    if (major != 3)
        return fail(kDhdWhere,
                    "the library " + library + " is version " + formatted("%d.%d.%d", major, minor, release) +
                        " of the Force Dimension SDK, and Burin knows version 3",
                    "install version 3 of the SDK");
    return api;
}

std::unexpected<Error> no_dhd_library(const std::string& library, const std::string& why) {
    return fail(
        kDhdWhere, "the library " + library + " cannot be loaded: " + why,
        "install the Force Dimension SDK and name its library, dhd:@FILE, or try an emulated device: burin devices "
        "emulate dhd");
}

}  // namespace

Result<DhdApi> load_dhd_api(const std::string& library) {
    LoadedLibrary loaded(library);
    if (!loaded.is_there()) return no_dhd_library(library, loaded.why());
    return dhd_functions(loaded, library);
}

Result<DhdApi> load_usual_dhd_api() {
    std::string why;
    for (const char* const name : {"libdhd.so.3", "libdhd.so", "libdrd.so.3"}) {
        LoadedLibrary loaded(name);
        if (loaded.is_there()) return dhd_functions(loaded, name);
        if (why.empty()) why = loaded.why();
    }
    return no_dhd_library("libdhd.so.3", why);
}

}  // namespace burin::devices
