// SPDX-License-Identifier: MIT
// Has a program that a test starts see the software device as a card, or as one that fails (tests/tools/vulkan_layer).
#pragma once

#include <string>

#include "tests/support/places.hpp"

namespace burin {

// What stands before the command: the layer, a device that poses as a card, and what else it poses as, such as
// "BURIN_POSE_LOSE_SUBMIT=3".
[[nodiscard]] inline std::string posing_as(const std::string& what = "") {
    return "VK_ADD_LAYER_PATH='" + std::string(kPosingLayer) +
           "' VK_INSTANCE_LAYERS=VK_LAYER_BURIN_posing BURIN_POSE_CARD=1 " + what + " ";
}

}  // namespace burin
