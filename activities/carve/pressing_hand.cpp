// SPDX-License-Identifier: MIT
#include "activities/carve/pressing_hand.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include "haptics/forces/engagement.hpp"
#include "sculpt/sculpture.hpp"
#include "toolbox/feel_options.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::activities {
namespace {

// Returns the unit vector into the material near a tool, both in the object frame; zero where there is no material.
using IntoMaterial = std::function<Vec3(const Pose&)>;

// Margin of the workspace that is kept free: the surface pushes the hand off its path.
constexpr double kBorder_m = 0.008;

// Returns the tool's speed at each row, from the row before.
std::vector<double> speeds_of(const sculpt::Stroke& stroke) {
    std::vector<double> speeds(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const double dt_s = stroke[i].time_s - stroke[i - 1].time_s;
        if (dt_s > 0.0) speeds[i] = glm::length(stroke[i].position_object_m - stroke[i - 1].position_object_m) / dt_s;
    }
    return speeds;
}

// Returns the median speed at which the tool works; 0 when it never moves while it does.
double middle_speed(const sculpt::Stroke& stroke, const std::vector<double>& speeds) {
    std::vector<double> working;
    for (std::size_t i = 1; i < stroke.size(); ++i)
        if (stroke[i].button && speeds[i] > 0.0) working.push_back(speeds[i]);
    if (working.empty()) return 0.0;
    const auto middle = working.begin() + static_cast<std::ptrdiff_t>(working.size() / 2);
    std::ranges::nth_element(working, middle);
    return *middle;
}

// Builds the hand's motion. While the button is pressed, the hand's target lies press_N / grip beyond the stroke, into
// the material: held on the stroke it would press with that force. The press is proportional to the speed, up to the
// median speed of the pressed rows, and eases where the hand rests: a tool that is pressed and not moved sinks.
Result<devices::SimulatedHand> script_along(const sculpt::Stroke& stroke, const Similarity& object_from_device,
                                            const toolbox::Feel& feel, const IntoMaterial& into_material) {
    const Similarity device_from_object = inverse(object_from_device);
    const std::vector<double> speeds = speeds_of(stroke);
    const double usual = middle_speed(stroke, speeds);
    const double press_object_m = feel.press_N / feel.grip.stiffness_N_per_m * object_from_device.scale;
    std::vector<devices::HandPose> script;
    script.reserve(stroke.size() + 1);
    const auto add = [&](const sculpt::StrokeRow& row, double time_s, double share) {
        Vec3 wanted = row.position_object_m;
        if (share > 0.0)
            wanted += share * press_object_m * into_material({row.position_object_m, row.orientation_object});
        script.push_back({time_s, device_from_object * wanted, row.orientation_object, row.button ? 1u : 0u});
    };
    add(stroke.front(), 0.0, 0.0);
    script.back().buttons = 0;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const bool presses = stroke[i].button && press_object_m > 0.0;
        // A stroke that never moves is a press at one point.
        const double share = !presses ? 0.0 : (usual > 0.0 ? std::min(1.0, speeds[i] / usual) : 1.0);
        add(stroke[i], stroke[i].time_s - stroke.front().time_s + kHandRests_s, share);
    }
    return devices::SimulatedHand::create(std::move(script), devices::HandPath::straight, feel.grip);
}

}  // namespace

Similarity fit_into_workspace(const sculpt::Stroke& stroke, const Vec3& workspace_m) {
    Box bounds;
    for (const sculpt::StrokeRow& row : stroke) bounds.include(row.position_object_m);
    const Vec3 needed = bounds.extent() / (workspace_m - Vec3(2.0 * kBorder_m));
    return {bounds.center(), Quat{1, 0, 0, 0}, std::max({1.0, needed.x, needed.y, needed.z})};
}

Result<devices::SimulatedHand> pressing_hand(const sculpt::Sculpture& carving, const sculpt::Stroke& stroke,
                                             const compute::ToolShape& tool, const haptics::ToolSurface& tool_surface,
                                             const toolbox::Feel& feel, const Similarity& object_from_device) {
    const double around_m = toolbox::reach_of(tool) + toolbox::size_of(tool);
    geometry::LocalSurface surface;
    // Seen from within the tool, for the tip of one lies in the surface that it touches; but not far up its shank.
    const Vec3 middle = 0.5 * (Vec3(tool_surface.lo_m) + Vec3(tool_surface.hi_m));
    const double up_m = glm::length(middle);
    const Vec3 within = up_m > tool_surface.size_m ? (tool_surface.size_m / up_m) * middle : middle;
    const auto into_material = [&](const Pose& pose) {
        const Vec3 place = pose * within;
        carving.local_surface(place, around_m, surface);
        return haptics::into_material(surface, place, around_m);
    };
    return script_along(stroke, object_from_device, feel, into_material);
}

}  // namespace burin::activities
