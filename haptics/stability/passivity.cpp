// SPDX-License-Identifier: MIT
#include "haptics/stability/passivity.hpp"

namespace burin {

PassivityStep keep_passive(const PassivityState& state, const Vec3& position_device_m,
                           const Vec3& wanted_force_device_N, bool, const PassivitySettings&, double) noexcept {
    PassivityStep step;
    step.next = state;
    step.next.position_device_m = position_device_m;
    step.force_device_N = wanted_force_device_N;
    return step;
}

PassivityState told(PassivityState state, const Vec3& force_device_N) noexcept {
    state.force_device_N = force_device_N;
    return state;
}

}  // namespace burin
