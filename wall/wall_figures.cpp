// SPDX-License-Identifier: MIT
#include "wall/wall_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.hpp"
#include "wall/comfort.hpp"
#include "wall/projection.hpp"

namespace burin::wall {
namespace {

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

Json list(const Vec3& v) { return {v.x, v.y, v.z}; }

// The angle of a side seen from the eye, whose foot lies at at_m along the side, distance_m away.
double angle_deg(double at_m, double length_m, double distance_m) {
    return kDegreesPerRadian * (std::atan(at_m / distance_m) + std::atan((length_m - at_m) / distance_m));
}

void add_viewing(Json& out, const WallSetup& setup, const Screen& s, const Eyes& eyes, const Vec2& size_m) {
    const Vec3 middle = 0.5 * (eyes.left_world + eyes.right_world);
    const double distance_m = distance_in_front(s, middle), apart_m = glm::length(eyes.right_world - eyes.left_world);
    const Vec3 d = middle - s.lower_left_world;
    const double x_m = glm::dot(d, glm::normalize(s.lower_right_world - s.lower_left_world));
    const double y_m = glm::dot(d, glm::normalize(s.upper_left_world - s.lower_left_world));
    const ComfortRange range = comfort_range(setup.budget, apart_m, distance_m);
    const BudgetOnScreen budget = budget_on_screen(setup.budget, apart_m, distance_m);
    out["viewing_distance_m"] = distance_m;
    out["field_of_view_deg"] = {angle_deg(x_m, size_m.x, distance_m), angle_deg(y_m, size_m.y, distance_m)};
    out["crossed_budget_m"] = budget.crossed_m;
    out["uncrossed_budget_m"] = budget.uncrossed_m;
    out["nearest_comfortable_m"] = range.nearest_m;
    out["farthest_comfortable_m"] = range.farthest_m ? Json(*range.farthest_m) : Json(nullptr);
}

Json screen_figures(const WallSetup& setup, const WallScreen& screen, const Eyes& eyes) {
    const Screen s = screen_world(setup, screen);
    const Vec3 right = s.lower_right_world - s.lower_left_world, up = s.upper_left_world - s.lower_left_world;
    const Vec2 size_m{glm::length(right), glm::length(up)};
    const Vec3 across = glm::cross(right, up);
    const Vec3 normal = glm::length(across) > 0.0 ? glm::normalize(across) : Vec3(0.0);
    Json out{{"name", screen.name}};
    out["size_m"] = {size_m.x, size_m.y};
    out["pixels"] = screen.pixels;
    out["pixel_mm"] = {1e3 * size_m.x / screen.pixels[0], 1e3 * size_m.y / screen.pixels[1]};
    out["normal_world"] = list(normal);
    // Angle from upright: a floor leans back by 90 degrees, a ceiling forward.
    out["tilt_deg"] = kDegreesPerRadian * std::asin(std::clamp(normal.y, -1.0, 1.0)) + 0.0;  // + 0.0 turns -0 into 0
    out["lower_left_world_m"] = list(s.lower_left_world);
    out["lower_right_world_m"] = list(s.lower_right_world);
    out["upper_left_world_m"] = list(s.upper_left_world);
    out["output"] = screen.output;
    out["direct"] = screen.direct ? Json(name_of(*screen.direct)) : Json(nullptr);
    out["mode"] = screen.mode;
    out["swap_eyes"] = screen.swap_eyes;
    out["warped"] = screen.homography.has_value();
    out["blended"] = screen.blend.any();
    out["seen_from_fallback_head"] = can_be_seen(s, eyes);
    if (can_be_seen(s, eyes)) add_viewing(out, setup, s, eyes, size_m);
    return out;
}

std::string row(const char* name, const std::string& value) { return formatted("  %-30s ", name) + value + "\n"; }

std::string screen_table(const Json& s) {
    const auto at = [&](const char* key, std::size_t i) { return s[key][i].get<double>(); };
    std::string text = "screen " + s["name"].get<std::string>() + "\n";
    text += row("width, height", formatted("%.3f m, %.3f m", at("size_m", 0), at("size_m", 1)));
    text += row("pixels", formatted("%d by %d, each %.3f by %.3f mm", s["pixels"][0].get<int>(),
                                    s["pixels"][1].get<int>(), at("pixel_mm", 0), at("pixel_mm", 1)));
    text += row("normal in the world",
                formatted("%.3f, %.3f, %.3f", at("normal_world", 0), at("normal_world", 1), at("normal_world", 2)));
    text += row("leans back from upright", formatted("%.1f degrees", s["tilt_deg"].get<double>()));
    text +=
        row("output, mode", s["output"].get<std::string>() + ", " + s["mode"].get<std::string>() +
                                (s["direct"].is_null() ? "" : ", driven directly: " + s["direct"].get<std::string>()) +
                                (s["swap_eyes"].get<bool>() ? ", eyes swapped" : ""));
    if (!s["seen_from_fallback_head"].get<bool>()) return text + row("from the fallback head", "cannot be seen");
    const double distance_m = s["viewing_distance_m"].get<double>();
    const double nearest_m = s["nearest_comfortable_m"].get<double>();
    text += row("viewing distance", formatted("%.3f m", distance_m));
    text +=
        row("field of view", formatted("%.1f by %.1f degrees", at("field_of_view_deg", 0), at("field_of_view_deg", 1)));
    text +=
        row("parallax budget in front", formatted("%.1f mm on the screen", 1e3 * s["crossed_budget_m"].get<double>()));
    text +=
        row("parallax budget behind", formatted("%.1f mm on the screen", 1e3 * s["uncrossed_budget_m"].get<double>()));
    text += row("nearest comfortable content",
                formatted("%.2f m from the eyes, %.2f m in front", nearest_m, distance_m - nearest_m));
    return text + row("farthest comfortable content",
                      s["farthest_comfortable_m"].is_null()
                          ? "no limit"
                          : formatted("%.2f m from the eyes", s["farthest_comfortable_m"].get<double>()));
}

}  // namespace

Json wall_figures(const WallSetup& setup) {
    const Eyes eyes = eyes_world(setup, {setup.fallback_head_tracker, setup.fallback_head_tracker});
    Json out{{"name", setup.name}};
    out["eyes_apart_mm"] = 1e3 * glm::length(eyes.right_world - eyes.left_world);
    out["fallback_left_eye_world_m"] = list(eyes.left_world);
    out["fallback_right_eye_world_m"] = list(eyes.right_world);
    out["crossed_budget_deg"] = setup.budget.crossed_deg;
    out["uncrossed_budget_deg"] = setup.budget.uncrossed_deg;
    out["refresh_Hz"] = setup.timing.refresh_Hz;
    out["eye_order"] = name_of(setup.timing.eye_order);
    out["screens"] = Json::array();
    for (const WallScreen& s : setup.screens) out["screens"].push_back(screen_figures(setup, s, eyes));
    return out;
}

std::string wall_table(const Json& figures) {
    const std::string name = figures["name"].get<std::string>();
    std::string text = (name.empty() ? "wall" : name) + "\n";
    text += row("eyes apart", formatted("%.1f mm", figures["eyes_apart_mm"].get<double>()));
    text += row("fields, eye order",
                formatted("%.4g Hz, ", figures["refresh_Hz"].get<double>()) + figures["eye_order"].get<std::string>());
    text += row("parallax budget",
                formatted("%.2f degrees crossed, %.2f uncrossed", figures["crossed_budget_deg"].get<double>(),
                          figures["uncrossed_budget_deg"].get<double>()));
    for (const Json& s : figures["screens"]) text += screen_table(s);
    return text;
}

}  // namespace burin::wall
