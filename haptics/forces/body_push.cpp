// SPDX-License-Identifier: MIT
#include "haptics/forces/body_push.hpp"

#include <algorithm>

namespace burin::haptics {

BodyPush push_of(const geometry::LocalModel& model, const PushedPoint& point) noexcept {
    geometry::LocalModel felt = model;
    felt.stiffness_N_per_m = std::min(model.stiffness_N_per_m, point.most_stiffness_N_per_m);
    const double spring_N = felt.force_at(point.hip_object_m, point.now_ns);
    if (!(spring_N > 0.0)) return {};
    const double inwards = glm::dot(model.velocity_object_m_per_s - point.velocity_object_m_per_s, model.normal_object);
    const double damper_N = std::clamp(model.damping_Ns_per_m * inwards, -spring_N, spring_N);
    return {spring_N + damper_N, 0.5 * spring_N * spring_N / felt.stiffness_N_per_m, spring_N / model.surface_N_per_m};
}

}  // namespace burin::haptics
