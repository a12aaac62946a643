// SPDX-License-Identifier: MIT
// The text that ART's DTrack sends, a datagram a measurement: lines with a word, a count and blocks in brackets.
//
//   fr 3823                                     number of the measurement
//   6d 1 [0 1.000][x y z a b c][nine numbers]   bodies: number, quality (-1: not seen); place, angles; rotation
//   6df 1 [0 1.000 9][...][...]                 flysticks of the older form: a third number has buttons and stick
//   6df2 2 1 [0 1.000 8 2][x y z][...][3 0.5 -0.2]   flysticks: how many there could be and are; how many buttons and
//                                               joysticks; their states, 32 buttons a number, sticks from -1 to 1
//   6di 1 [0 2 0.5][x y z][nine numbers]        hybrid bodies: number, state (0: not seen, 1: by its inertial sensor,
//                                               2: by the cameras, 3: by both), drift in degrees; place; rotation
// Millimetres; a rotation is column by column. Lines that begin with another word are left out, and so are numbers at
// a block's end that are not known here. Source: the parser of DTrackSDK (github.com/ar-tracking/DTrackSDK, 110f7e5).
// The controller's end is in devices/emulators/dtrack_wire.hpp and has no code in common with this. Pure; any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/space.hpp"

namespace burin::devices {

inline constexpr std::uint16_t kDTrackPort = 5000;
// Bounds of what a datagram may hold; what is beyond ends its line.
inline constexpr std::size_t kMostDTrackBodies = 100, kMostFlystickButtons = 32, kMostFlystickSticks = 8;

struct DTrackBody {
    std::int32_t number = 0;
    bool is_tracked = false;
    Pose pose;  // metres
};
struct DTrackFlystick {
    DTrackBody body;
    std::uint32_t button_count = 0, buttons = 0;  // bit i: button i
    std::vector<double> sticks;                   // x, y and others
};
struct DTrackFrame {
    std::optional<std::uint32_t> number;
    std::vector<DTrackBody> bodies, hybrids;
    std::vector<DTrackFlystick> flysticks;
    std::string fault;  // of the first line that cannot be read, which is left out; empty: none
};

// Reads a datagram. Numbers are as they come: a place may be infinite, a rotation none.
[[nodiscard]] DTrackFrame dtrack_frame(std::string_view datagram);

}  // namespace burin::devices
