// SPDX-License-Identifier: MIT
// HDAPI, the low-level interface of OpenHaptics to a PHANTOM Omni or Touch, as far as Burin uses it: its functions,
// found in the maker's library when the program runs, and the numbers that go with them. Nothing of it is needed to
// build.
//
// Values and signatures are those of version 3.00.66, as its header files hdDefines, hdDevice and
// hdScheduler say (public in github.com/danepowell/openhaptics). HdError comes back by value, and its size is part of
// the call: declarations of two fields, which also circulate, break the stack. Lengths are millimetres, forces newtons;
// a transform is sixteen numbers, column by column, its place in the last column.
#pragma once

#include <string>

#include "base/error.hpp"

namespace burin::devices {

using HdHandle = unsigned int;
struct HdError {  // goes through a C function by value, and so has no initial values
    unsigned int code;
    int internal_code;  // the device's own
    HdHandle device;
};
static_assert(sizeof(HdError) == 12);

inline constexpr HdHandle kHdNoDevice = 0xffffffff;
inline constexpr unsigned int kHdCallAgain = 1;            // what a callback returns to be called in the next turn
inline constexpr unsigned short kHdUsualPriority = 32767;  // of 0 to 65535

// Values that are read and written.
inline constexpr unsigned int kHdButtons = 0x2000, kHdTransform = 0x2052, kHdForce = 0x2700, kHdVersion = 0x2500,
                              kHdModel = 0x2501, kHdUsableWorkspace = 0x2551, kHdCalibrationStyles = 0x2555,
                              kHdMostForce = 0x2603;
// Capabilities that are switched on.
inline constexpr unsigned int kHdForceOutput = 0x4000;
// Errors.
inline constexpr unsigned int kHdWarmMotors = 0x0200, kHdTooFast = 0x0203, kHdFirstForceError = 0x0200,
                              kHdLastForceError = 0x02ff, kHdDeviceFault = 0x0300, kHdAlreadyOpened = 0x0301,
                              kHdCommunication = 0x0302, kHdFirstDeviceError = 0x0300, kHdLastDeviceError = 0x03ff,
                              kHdNoLicence = 0x0600;
// Calibration: what is found, and ways of doing it, as bits.
inline constexpr unsigned int kHdCalibrated = 0x5000, kHdCalibrationNeedsUpdate = 0x5001,
                              kHdCalibrationNeedsHand = 0x5002;
inline constexpr unsigned int kHdByEncoderReset = 1, kHdByItself = 2, kHdByInkwell = 4;

struct HdApi {
    using Callback = unsigned int (*)(void*);
    HdHandle (*init_device)(const char*) = nullptr;
    void (*disable_device)(HdHandle) = nullptr;
    void (*make_current)(HdHandle) = nullptr;
    void (*begin_frame)(HdHandle) = nullptr;
    void (*end_frame)(HdHandle) = nullptr;
    HdError (*error)() = nullptr;  // the newest that has not been asked for; code 0: none
    const char* (*error_text)(unsigned int) = nullptr;
    void (*enable)(unsigned int) = nullptr;
    void (*read_integers)(unsigned int, int*) = nullptr;
    void (*read_doubles)(unsigned int, double*) = nullptr;
    void (*write_doubles)(unsigned int, const double*) = nullptr;
    const char* (*read_string)(unsigned int) = nullptr;
    unsigned int (*check_calibration)() = nullptr;
    void (*update_calibration)(unsigned int) = nullptr;
    void (*start_scheduler)() = nullptr;
    void (*stop_scheduler)() = nullptr;
    unsigned long (*schedule)(Callback, void*, unsigned short) = nullptr;
    void (*unschedule)(unsigned long) = nullptr;
};

inline constexpr const char* kHdLibrary = "libHD.so";

// Loads the library, which stays loaded: it has threads of its own. A path or a name that the system's loader finds. An
// Error says that there is none, or which function it lacks.
[[nodiscard]] Result<HdApi> load_hd_api(const std::string& library);

}  // namespace burin::devices
