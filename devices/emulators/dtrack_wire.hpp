// SPDX-License-Identifier: MIT
// The datagrams that ART's controller sends, as it writes them: places in millimetres with three decimals, angles with
// four, rotations column by column with six, zeros for a body that is not seen. Written from the sample and the text of
// DTrackSDK (github.com/ar-tracking/DTrackSDK, 110f7e5) and without any of the driver's code
// (devices/trackers/dtrack_protocol.hpp), so that a fault in one of the two shows where they meet. Only the types of
// what is said are common. Pure; any thread.
#pragma once

#include <string>

#include "devices/trackers/dtrack_protocol.hpp"

namespace burin::devices {

// Writes the lines fr, 6df2, 6di and 6d: the number where there is one, flysticks in the newer form, hybrid bodies
// where there are any, and bodies.
[[nodiscard]] std::string controller_datagram(const DTrackFrame& frame);

}  // namespace burin::devices
