// SPDX-License-Identifier: MIT
#include "app/felt_hand.hpp"

#include <algorithm>
#include <vector>

namespace burin {
namespace {

constexpr double kBorder_m = 0.008;  // of the workspace, kept free: the surface pushes the hand off its path

// Of the tool at each row, from the row before.
std::vector<double> speeds_of(const Stroke& stroke) {
    std::vector<double> speeds(stroke.size(), 0.0);
    for (std::size_t i = 1; i < stroke.size(); ++i) {
        const double dt_s = stroke[i].time_s - stroke[i - 1].time_s;
        if (dt_s > 0.0) speeds[i] = glm::length(stroke[i].position_object_m - stroke[i - 1].position_object_m) / dt_s;
    }
    return speeds;
}

// The middle one of the speeds at which the tool works; 0 when it never moves while it does.
double middle_speed(const Stroke& stroke, const std::vector<double>& speeds) {
    std::vector<double> working;
    for (std::size_t i = 1; i < stroke.size(); ++i)
        if (stroke[i].button && speeds[i] > 0.0) working.push_back(speeds[i]);
    if (working.empty()) return 0.0;
    const auto middle = working.begin() + static_cast<std::ptrdiff_t>(working.size() / 2);
    std::ranges::nth_element(working, middle);
    return *middle;
}

}  // namespace

Similarity fit_into_workspace(const Stroke& stroke, const Vec3& workspace_m) {
    Box bounds;
    for (const StrokeRow& row : stroke) bounds.include(row.position_object_m);
    const Vec3 needed = bounds.extent() / (workspace_m - Vec3(2.0 * kBorder_m));
    return {bounds.center(), Quat{1, 0, 0, 0}, std::max({1.0, needed.x, needed.y, needed.z})};
}

Result<SimulatedHand> hand_along(const Stroke& stroke, const Similarity& object_from_device, const Feel& feel,
                                 const IntoMaterial& into_material) {
    const Similarity device_from_object = inverse(object_from_device);
    const std::vector<double> speeds = speeds_of(stroke);
    const double usual = middle_speed(stroke, speeds);
    const double press_object_m = feel.press_N / feel.grip.stiffness_N_per_m * object_from_device.scale;
    std::vector<HandPose> script;
    script.reserve(stroke.size() + 1);
    const auto add = [&](const StrokeRow& row, double time_s, double share) {
        Vec3 wanted = row.position_object_m;
        if (share > 0.0) wanted += share * press_object_m * into_material(row.position_object_m);
        script.push_back({time_s, device_from_object * wanted, row.orientation_object, row.button ? 1u : 0u});
    };
    add(stroke.front(), 0.0, 0.0);
    script.back().buttons = 0;
    for (std::size_t i = 0; i < stroke.size(); ++i) {
        const bool presses = stroke[i].button && press_object_m > 0.0;
        // A stroke that never moves is a press on the spot.
        const double share = !presses ? 0.0 : (usual > 0.0 ? std::min(1.0, speeds[i] / usual) : 1.0);
        add(stroke[i], stroke[i].time_s - stroke.front().time_s + kHandRests_s, share);
    }
    return SimulatedHand::create(std::move(script), HandPath::straight, feel.grip);
}

}  // namespace burin
