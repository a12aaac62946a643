// SPDX-License-Identifier: MIT
#include "devices/drivers/hd_api.hpp"

#include "devices/drivers/loaded_library.hpp"

namespace burin::devices {
Result<HdApi> load_hd_api(const std::string& library) {
    LoadedLibrary loaded(library);
    if (!loaded.is_there())
        return fail("haptic device omni", "the library " + library + " cannot be loaded: " + loaded.why(),
                    "install OpenHaptics and the device's driver, or try an emulated one: burin devices emulate omni");
    HdApi api;
    loaded.find("hdInitDevice", api.init_device);
    loaded.find("hdDisableDevice", api.disable_device);
    loaded.find("hdMakeCurrentDevice", api.make_current);
    loaded.find("hdBeginFrame", api.begin_frame);
    loaded.find("hdEndFrame", api.end_frame);
    loaded.find("hdGetError", api.error);
    loaded.find("hdGetErrorString", api.error_text);
    loaded.find("hdEnable", api.enable);
    loaded.find("hdGetIntegerv", api.read_integers);
    loaded.find("hdGetDoublev", api.read_doubles);
    loaded.find("hdSetDoublev", api.write_doubles);
    loaded.find("hdGetString", api.read_string);
    loaded.find("hdCheckCalibration", api.check_calibration);
    loaded.find("hdUpdateCalibration", api.update_calibration);
    loaded.find("hdStartScheduler", api.start_scheduler);
    loaded.find("hdStopScheduler", api.stop_scheduler);
    loaded.find("hdScheduleAsynchronous", api.schedule);
    loaded.find("hdUnschedule", api.unschedule);
    if (!loaded.missing().empty())
        return fail("haptic device omni", "the library " + library + " has no function " + loaded.missing(),
                    "it is no HDAPI, or another version of it: install OpenHaptics 3");
    return api;
}

}  // namespace burin::devices
