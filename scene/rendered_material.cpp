// SPDX-License-Identifier: MIT
#include "scene/rendered_material.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "haptics/signals/filters.hpp"
#include "haptics/stability/rendered_wall.hpp"
#include "haptics/tick_parameters.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

RenderedMaterial rendered_material(const HapticMaterial& material, const devices::DeviceDescription& device,
                                   const haptics::TickParameters& parameters, std::uint32_t points) {
    const haptics::Probe& probe = parameters.probe;
    const std::uint32_t touching = std::clamp<std::uint32_t>(points, 1, probe.count);
    double shares = 0.0, squared_arms_m2 = 0.0;
    for (std::uint32_t i = 0; i < touching; ++i) {
        shares += probe.points[i].share;
        if (touching > 1) squared_arms_m2 += glm::dot(probe.points[i].offset_device_m, probe.points[i].offset_device_m);
    }
    const double share = probe.points[0].share > 0.0 ? probe.points[0].share : 1.0;
    haptics::WallDemand demand;
    demand.wall = {share * material.stiffness_N_per_m, share * material.damping_Ns_per_m};
    demand.coupling = parameters.coupling;
    demand.points = std::max(shares / share, 1.0);
    demand.squared_arms_m2 = squared_arms_m2;
    demand.period_s = device.rate_Hz > 0.0 ? 1.0 / device.rate_Hz : 0.001;
    demand.filter_lag_s = haptics::mean_lag_s(parameters.signals.force_alpha, demand.period_s);
    demand.limit = parameters.limit_stiffness;
    const haptics::RenderedWall wall = haptics::rendered(demand, device);
    return {touching, wall.wall.stiffness_N_per_m / share, wall.wall.damping_Ns_per_m / share, wall.bound};
}

std::string text_of(const RenderedMaterial& rendered) {
    if (rendered.bound == haptics::StiffnessBound::none) return "as asked";
    return formatted("%.4g N/m, %.2g N s/m (%s)", rendered.stiffness_N_per_m, rendered.damping_Ns_per_m,
                     haptics::short_text(rendered.bound));
}

std::string more_than_rendered(std::span<const SceneObject> objects, const devices::DeviceDescription& device,
                               const haptics::TickParameters& parameters) {
    std::size_t felt = 0, more = 0;
    std::string such;
    for (const SceneObject& object : objects) {
        if (!object.felt) continue;
        ++felt;
        if (object.material == HapticMaterial{}) continue;
        const RenderedMaterial rendered =
            rendered_material(object.material, device, parameters, parameters.probe.count);
        if (rendered.bound == haptics::StiffnessBound::none) continue;
        if (++more == 1)
            such = object.name +
                   formatted(": %g N/m, %g N s/m become ", object.material.stiffness_N_per_m,
                             object.material.damping_Ns_per_m) +
                   text_of(rendered);
    }
    if (more == 0) return "";
    return formatted("%zu of %zu objects %s for more than %s renders, such as ", more, felt, more == 1 ? "asks" : "ask",
                     device.name) +
           such;
}

}  // namespace burin::scene
