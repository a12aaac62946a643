// SPDX-License-Identifier: MIT
#include "haptics/forces/guidance.hpp"

namespace burin {

GuidanceStep guide(const GuidanceState&, const GuidanceInput&, const GuidanceCurve&, const GuidanceSettings&) noexcept {
    return {};
}

}  // namespace burin
