// SPDX-License-Identifier: MIT
#include "app/world/rendered_report.hpp"

#include <cstdio>

#include "base/text.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "haptics/tick_parameters.hpp"

namespace burin::app {
namespace {

std::string limited_by(const session::RenderedTally& wall) {
    const std::string bound = haptics::short_text(wall.bound());
    if (!wall.is_limited_by_energy()) return bound;
    return bound + (bound.empty() ? "" : ", ") + "the energy account";
}

Json wall_json(double stiffness_N_per_m, double damping_Ns_per_m) {
    return {{"stiffness_N_per_m", stiffness_N_per_m}, {"damping_Ns_per_m", damping_Ns_per_m}};
}

}  // namespace

std::string wall_text(const session::RenderedTally& wall) {
    const std::string by = limited_by(wall);
    return formatted("%.4g -> %.4g -> %.4g%s%s", wall.asked().stiffness_N_per_m, wall.rendered().stiffness_N_per_m,
                     wall.felt_N_per_m(), by.empty() ? "" : ", ", by.c_str());
}

void add_wall(Json& touch, const session::RenderedTally& wall) {
    touch["asked"] = wall_json(wall.asked().stiffness_N_per_m, wall.asked().damping_Ns_per_m);
    touch["rendered"] = wall_json(wall.rendered().stiffness_N_per_m, wall.rendered().damping_Ns_per_m);
    touch["limited_by"] = limited_by(wall);
    touch["felt_N_per_m"] = wall.felt_N_per_m();
    touch["energy_took"] = wall.energy_took();
}

haptics::Probe probe_of(const devices::WandDescription& wand, std::span<const devices::WandPoint> points) {
    haptics::Probe probe;
    probe.count = 0;
    for (const devices::WandPoint& point : points)
        probe.points[probe.count++].offset_device_m = devices::offset_device_m(wand, point);
    return probe;
}

void tell_what_is_not_rendered(const std::string& world, const std::vector<scene::SceneObject>& objects,
                               const devices::DeviceDescription& device, const haptics::Probe& probe) {
    haptics::TickParameters parameters;
    parameters.probe = probe;
    const std::string more = scene::more_than_rendered(objects, device, parameters);
    if (!more.empty()) std::fprintf(stderr, "burin: %s: %s\n", world.c_str(), more.c_str());
}

std::vector<RenderedOn> rendered_on_usual_devices(const scene::HapticMaterial& material) {
    haptics::TickParameters stylus;
    const devices::DeviceDescription omni = devices::description_of(devices::OmniModel{});
    const devices::WandDescription described = devices::WandDescription{};
    haptics::TickParameters wand;
    if (const auto points = devices::points_named(described, devices::usual_points(described)))
        wand.probe = probe_of(described, *points);
    const devices::DeviceDescription handle = devices::device_of(described);
    return {{"simulated", scene::rendered_material(material, omni, stylus, 1)},
            {"simulated-wand", scene::rendered_material(material, handle, wand, 1)},
            {"simulated-wand", scene::rendered_material(material, handle, wand, wand.probe.count)}};
}

std::string rendered_text(std::span<const RenderedOn> rendered) {
    std::string text;
    for (const RenderedOn& on : rendered) {
        if (on.rendered.bound == haptics::StiffnessBound::none) continue;
        text += formatted("; %s%s: %s", on.device, on.rendered.points > 1 ? ", each end of two" : "",
                          scene::text_of(on.rendered).c_str());
    }
    return text;
}

Json rendered_json(std::span<const RenderedOn> rendered) {
    Json list = Json::array();
    for (const RenderedOn& on : rendered) {
        Json entry = wall_json(on.rendered.stiffness_N_per_m, on.rendered.damping_Ns_per_m);
        entry["device"] = on.device;
        entry["points"] = on.rendered.points;
        entry["limited_by"] = haptics::short_text(on.rendered.bound);
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace burin::app
