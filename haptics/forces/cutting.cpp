// SPDX-License-Identifier: MIT
#include "haptics/forces/cutting.hpp"

namespace burin {

CuttingStep cut(const CuttingState&, const CuttingInput& input, const TouchMaterial&) noexcept {
    CuttingStep step;
    step.bearing_object_m = input.proxy_object_m;
    return step;
}

}  // namespace burin
