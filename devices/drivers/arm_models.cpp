// SPDX-License-Identifier: MIT
#include "devices/drivers/arm_models.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/text.hpp"

namespace burin::devices {
namespace {

constexpr std::string_view kModelSetting = ",model=";

OmniModel arm_figures(const Vec3& box_m, double force_N, double stiffness_N_per_m, double mass_kg) {
    return {.workspace_m = box_m,
            .resolution_m = 0.00005,
            .apparent_mass_kg = mass_kg,
            .friction_N = 0.2,
            .damping_Ns_per_m = 0.05,
            .max_force_N = force_N,
            .max_stiffness_N_per_m = stiffness_N_per_m,
            .watchdog_s = 0.0};
}

OmniModel of_force_dimension(const Vec3& box_m, double force_N, double stiffness_N_per_m) {
    OmniModel figures = arm_figures(box_m, force_N, stiffness_N_per_m, 0.2);
    figures.resolution_m = 0.00001;
    figures.damping_Ns_per_m = 0.2;
    return figures;
}

// Touch X: what CHAI3D has for the PHANTOM Desktop, as which it was sold before. Premiums: its 6DOF ones.
const std::array<ArmModel, 4>& hd_models() {
    static const std::array<ArmModel, 4> models{
        ArmModel{"omni", "PHANTOM Omni", OmniModel{}},
        ArmModel{"touch-x", "Touch X", arm_figures(Vec3(0.16, 0.12, 0.12), 7.9, 1000.0, 0.045)},
        ArmModel{"premium-1.5", "PHANTOM Premium 1.5", arm_figures(Vec3(0.24, 0.24, 0.16), 8.5, 800.0, 0.075)},
        ArmModel{"premium-3.0", "PHANTOM Premium 3.0", arm_figures(Vec3(0.5, 0.4, 0.3), 22.0, 1000.0, 0.16)},
    };
    return models;
}

// The unknown one has the lowest force and stiffness of all.
const std::array<ArmModel, 5>& dhd_models() {
    static const std::array<ArmModel, 5> models{
        ArmModel{"omega", "Force Dimension", of_force_dimension(Vec3(0.15, 0.15, 0.11), 12.0, 5000.0)},
        ArmModel{"delta", "Force Dimension delta", of_force_dimension(Vec3(0.2, 0.2, 0.16), 20.0, 5000.0)},
        ArmModel{"sigma", "Force Dimension sigma", of_force_dimension(Vec3(0.1, 0.1, 0.08), 12.0, 4000.0)},
        ArmModel{"falcon", "Falcon by DHD", of_force_dimension(Vec3(0.06, 0.06, 0.05), 8.0, 3000.0)},
        ArmModel{"unknown", "unknown by DHD", of_force_dimension(Vec3(0.1, 0.1, 0.08), 8.0, 3000.0)},
    };
    return models;
}

const ArmModel& model_called(std::span<const ArmModel> models, std::string_view key) {
    const auto found = std::ranges::find(models, key, &ArmModel::key);
    return found != models.end() ? *found : models.front();
}

// Returns the key of the model that the string names; nothing where it names none.
std::optional<std::string_view> hd_key(std::string_view said) {
    if (said.contains("Premium")) {
        if (said.contains("1.5")) return "premium-1.5";
        if (said.contains("3.0")) return "premium-3.0";
        return std::nullopt;
    }
    if (said.contains("Touch X") || said.contains("Desktop")) return "touch-x";
    if (said.contains("Omni") || said.contains("Touch")) return "omni";
    return std::nullopt;
}

std::string keys_of(std::span<const ArmModel> models) {
    std::vector<std::string_view> keys;
    for (const ArmModel& model : models) keys.push_back(model.key);
    return joined(keys);
}

}  // namespace

const ArmModel& hd_model(std::string_view said, double most_N) {
    const ArmModel& model = hd_model_called(hd_key(said).value_or("omni"));
    return most_N < model.figures.max_force_N ? hd_models().front() : model;
}

bool hd_knows(std::string_view said) { return hd_key(said).has_value(); }

const ArmModel& dhd_model(int type) {
    switch (type) {
        case 32:  // DHD_DEVICE_OMEGA
        case 33:  // DHD_DEVICE_OMEGA3
        case 34:  // DHD_DEVICE_OMEGA33
        case 36:  // its left one
        case 35:  // DHD_DEVICE_OMEGA331
        case 37:  // its left one
            return dhd_model_called("omega");
        case 31:  // DHD_DEVICE_3DOF
        case 61:  // DHD_DEVICE_6DOF
        case 62:  // DHD_DEVICE_6DOF_500
        case 63:  // DHD_DEVICE_DELTA3
        case 64:  // DHD_DEVICE_DELTA6
            return dhd_model_called("delta");
        case 102:  // DHD_DEVICE_SIGMA33
        case 103:  // its left one
        case 104:  // DHD_DEVICE_SIGMA331
        case 105:  // its left one
        case 106:  // DHD_DEVICE_SIGMA33P
        case 107:  // its left one
            return dhd_model_called("sigma");
        case 60:  // DHD_DEVICE_FALCON
            return dhd_model_called("falcon");
        default: return dhd_model_called("unknown");
    }
}

bool dhd_knows(int type) { return &dhd_model(type) != &dhd_model_called("unknown"); }

const ArmModel& hd_model_called(std::string_view key) { return model_called(hd_models(), key); }
const ArmModel& dhd_model_called(std::string_view key) { return model_called(dhd_models(), key); }
std::string hd_model_keys() { return keys_of(hd_models()); }
std::string dhd_model_keys() { return keys_of(dhd_models()); }

// By dhdc.h: omega.7, sigma.7 and lambda.7, each right and left.
bool dhd_has_gripper(int type) noexcept {
    return type == 35 || type == 37 || type == 104 || type == 105 || type == 108 || type == 109;
}

ModelledText without_model(const std::string& text) {
    const std::size_t at = text.find(kModelSetting);
    if (at == std::string::npos) return {text, {}};
    const std::size_t end = std::min(text.find('@', at), text.size());
    const std::size_t key = at + kModelSetting.size();
    return {text.substr(0, at) + text.substr(end), text.substr(key, end - key)};
}

std::string with_model(const std::string& text, std::string_view key) {
    const std::size_t at = std::min(text.find('@'), text.size());
    return text.substr(0, at) + std::string(kModelSetting) + std::string(key) + text.substr(at);
}

}  // namespace burin::devices
