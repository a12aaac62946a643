// SPDX-License-Identifier: MIT
// DHD, the haptic half of the Force Dimension SDK, as far as Burin uses it: its functions, found in the maker's library
// when the program runs, and the numbers that go with them. Nothing of it is needed to build.
//
// Values and signatures are those of dhdc.h of version 3.7 (public in github.com/WPI-AIM/ambf, external/DHD), which are
// those of 3.3 to 3.17 as far as they are used. In C the header's default arguments do not exist: the last argument is
// always the device. Status has 16 numbers in older versions and 17 in newer ones: it is read into more than either.
// Lengths are metres, forces newtons; a matrix has its rows one after the other. Axes: +x to the user, +y to the right,
// +z up, about the middle of the workspace.
#pragma once

#include <string>

#include "base/error.hpp"

namespace burin::devices {

// A function returns 0, one of these two, or -1 where it has failed.
inline constexpr int kDhdTimeGuard = 1;  // asked for again too soon: the values are the last ones
inline constexpr int kDhdSaturated = 2;  // a motor gives less than it is asked for

// Errors.
inline constexpr int kDhdCommunication = 2, kDhdBusy = 3, kDhdNoDevice = 5, kDhdTimeOut = 7, kDhdNotExpert = 9,
                     kDhdInUse = 20;
// Kinds of device.
inline constexpr int kDhdOmega3 = 33, kDhdFalcon = 60;
// Places in the status.
inline constexpr std::size_t kDhdStatusPower = 0, kDhdStatusConnected = 1, kDhdStatusReset = 3, kDhdStatusForce = 5,
                             kDhdStatusForceOff = 14, kDhdStatusRoom = 64;
// Why the force is off.
inline constexpr int kDhdOffByButton = 1, kDhdOffByVelocity = 2, kDhdOffByWatchdog = 3, kDhdOffBySoftware = 4,
                     kDhdOffByCable = 5, kDhdOffByDeadMan = 6;

struct DhdApi {
    void (*sdk_version)(int* major, int* minor, int* release, int* revision) = nullptr;
    int (*device_count)() = nullptr;
    int (*open_by_index)(char index) = nullptr;  // the device's ID, or -1
    int (*open_by_serial)(int serial) = nullptr;
    int (*close)(char device) = nullptr;
    int (*enable_force)(unsigned char on, char device) = nullptr;
    int (*system_type)(char device) = nullptr;
    const char* (*system_name)(char device) = nullptr;
    int (*status)(int* status, char device) = nullptr;
    unsigned int (*buttons)(char device) = nullptr;
    int (*read_pose)(double* x, double* y, double* z, double (*turn)[3], char device) = nullptr;
    // Force, torque, force of the gripper.
    int (*write_force)(double, double, double, double, double, double, double, char device) = nullptr;
    int (*last_error)() = nullptr;
    const char* (*error_text)(int error) = nullptr;
    // Stand in the header's expert section: its functions fail with kDhdNotExpert until enable_expert_mode. Null: the
    // library has none. The watchdog takes the force off a device that gets no command for so many steps of 125 us.
    int (*enable_expert_mode)() = nullptr;
    int (*set_watchdog)(unsigned char steps, char device) = nullptr;
    // Has a gripper press the first button. Null: the library is of before there was one.
    int (*emulate_button)(unsigned char on, char device) = nullptr;
};

// Loads the library; of several names the first that the system's loader finds. It stays loaded. An Error says that
// there is none, which function it lacks, or that it is of another version than 3.
[[nodiscard]] Result<DhdApi> load_dhd_api(const std::string& library);
// Where no library is named: libdhd.so.3, libdhd.so or libdrd.so.3.
[[nodiscard]] Result<DhdApi> load_usual_dhd_api();

}  // namespace burin::devices
