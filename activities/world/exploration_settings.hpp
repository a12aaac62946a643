// SPDX-License-Identifier: MIT
// What decides the ticks of an exploration, besides the world and the motion of the hand: kept in the session file as
// JSON (docs/formats.md), so that a replay depends on no constant of the code. Pure; any thread.
// Frame: the scene's. Units: metres.
#pragma once

#include <string>

#include "base/error.hpp"
#include "base/space.hpp"
#include "haptics/tick_parameters.hpp"

namespace burin::activities {

struct ExplorationSettings {
    double tool_radius_m = 0.004;  // of the ball that touches
    Similarity scene_from_device;
    Vec3 start_scene_m{0.0};  // where the tool is before the first tick
    double reach_m = 0.014;   // how far it may move until the next update of the scene

    // Of the tick (haptics/channels.hpp); what is not named here is the default.
    double clearance_ratio = 0.02, position_noise_m = 0.000055, max_surface_age_s = 0.5;
    bool shading = true, limit_stiffness = true;
    haptics::GateLimits limits;
    haptics::PassivitySettings passivity;
};

// Returns the parameters of the tick, but for sequence and materials.
[[nodiscard]] haptics::TickParameters parameters_of(const ExplorationSettings& settings);

// Facts by which a session file says what it is of (table meta).
inline constexpr const char* kActivityFact = "activity";
inline constexpr const char* kSettingsFact = "settings";
inline constexpr const char* kWorldActivity = "world";

[[nodiscard]] std::string settings_text(const ExplorationSettings& settings);
// Reads what settings_text() has written. Fails on any other text, and on values that cannot be felt; `where` names the
// file.
[[nodiscard]] Result<ExplorationSettings> read_settings(const std::string& text, const std::string& where);

}  // namespace burin::activities
