// SPDX-License-Identifier: MIT
#include "devices/drivers/hd_api.hpp"

#include <dlfcn.h>

namespace burin::devices {
namespace {

// Finds one function; notes the first that is missing.
template <typename Function>
void find(void* library, const char* name, Function*& to, std::string& missing) {
    // POSIX: what dlsym returns can be taken for a function.
    to = reinterpret_cast<Function*>(::dlsym(library, name));
    if (to == nullptr && missing.empty()) missing = name;
}

}  // namespace

Result<HdApi> load_hd_api(const std::string& library) {
    void* const loaded = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (loaded == nullptr) {
        const char* const why = ::dlerror();
        return fail("haptic device omni", "the library " + library + " cannot be loaded: " + (why ? why : "no reason"),
                    "install OpenHaptics and the device's driver, or try an emulated one: burin devices emulate omni");
    }
    HdApi api;
    std::string missing;
    find(loaded, "hdInitDevice", api.init_device, missing);
    find(loaded, "hdDisableDevice", api.disable_device, missing);
    find(loaded, "hdMakeCurrentDevice", api.make_current, missing);
    find(loaded, "hdBeginFrame", api.begin_frame, missing);
    find(loaded, "hdEndFrame", api.end_frame, missing);
    find(loaded, "hdGetError", api.error, missing);
    find(loaded, "hdGetErrorString", api.error_text, missing);
    find(loaded, "hdEnable", api.enable, missing);
    find(loaded, "hdGetIntegerv", api.read_integers, missing);
    find(loaded, "hdGetDoublev", api.read_doubles, missing);
    find(loaded, "hdSetDoublev", api.write_doubles, missing);
    find(loaded, "hdGetString", api.read_string, missing);
    find(loaded, "hdCheckCalibration", api.check_calibration, missing);
    find(loaded, "hdUpdateCalibration", api.update_calibration, missing);
    find(loaded, "hdStartScheduler", api.start_scheduler, missing);
    find(loaded, "hdStopScheduler", api.stop_scheduler, missing);
    find(loaded, "hdScheduleAsynchronous", api.schedule, missing);
    find(loaded, "hdUnschedule", api.unschedule, missing);
    if (!missing.empty())
        return fail("haptic device omni", "the library " + library + " has no function " + missing,
                    "it is no HDAPI, or another version of it: install OpenHaptics 3");
    return api;
}

}  // namespace burin::devices
