// SPDX-License-Identifier: MIT
#include "desk/view/session_screens.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>

#include "base/try.hpp"
#include "wall/output_settings.hpp"
#include "wall/wall.hpp"
#include "wall/wall_file.hpp"

namespace burin::session {
namespace {

// Height of the wall that a desktop window stands for; its width follows the window's shape.
constexpr double kDeskHeight_m = 2.286;

constexpr ImageSize kPanelScreen_px{340, 900};

ImageSize asked_size(const DeskOptions& options) {
    return {static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height)};
}

SessionWall desk_wall(const DeskOptions& options) {
    SessionWall wall;
    wall.setup.name = "desk";
    wall.setup.screens.emplace_back();
    wall.screens.push_back(
        {.name = {}, .monitor = options.full_screen, .direct = {}, .size = asked_size(options), .shown = {}});
    fit_desk_screen(wall, asked_size(options));
    return wall;
}

wall::EdgeFade fade_of(const wall::EdgeBlend& blend) {
    wall::EdgeFade fade;
    fade.left = blend.left;
    fade.right = blend.right;
    fade.top = blend.top;
    fade.bottom = blend.bottom;
    fade.gamma = blend.gamma;
    return fade;
}

// Returns the size shrunk as little as possible to fit into the requested one, keeping its shape.
ImageSize fitted(ImageSize size, ImageSize into) {
    const double by =
        std::min({1.0, static_cast<double>(into.width) / size.width, static_cast<double>(into.height) / size.height});
    const auto pixels = [&](std::uint32_t n) { return static_cast<std::uint32_t>(std::max(1L, std::lround(by * n))); };
    return {pixels(size.width), pixels(size.height)};
}

// Converts the refresh rate: the wall file gives fields per second, and a frame of HDMI 3D holds two.
gpu::DisplayChoice display_of(const wall::WallScreen& screen, const wall::DisplayTiming& timing) {
    gpu::DisplayChoice choice;
    choice.display = screen.output;
    choice.width = static_cast<std::uint32_t>(screen.pixels[0]);
    choice.height = static_cast<std::uint32_t>(screen.pixels[1]);
    choice.stereo = *screen.direct;
    choice.refresh_Hz = (choice.stereo == DisplayStereo::hdmi_3d ? 0.5 : 1.0) * timing.refresh_Hz;
    return choice;
}

Result<SessionScreen> screen_shown(const wall::WallScreen& screen, const wall::DisplayTiming& timing,
                                   const DeskOptions& options) {
    SessionScreen shown;
    shown.name = screen.name;
    const auto mode = wall::parse_stereo_mode(screen.mode);
    if (!mode) return fail(options.wall + ", screen " + screen.name, mode.error().what, mode.error().remedy);
    shown.shown.mode = *mode;
    shown.shown.swap_eyes = screen.swap_eyes;
    shown.shown.blend = fade_of(screen.blend);
    if (screen.homography) {
        BURIN_TRY(homography, wall::homography_from_rows(*screen.homography));
        shown.shown.homography = homography;
    }
    BURIN_TRY_DO(wall::check_output(shown.shown));
    shown.size = {static_cast<std::uint32_t>(screen.pixels[0]), static_cast<std::uint32_t>(screen.pixels[1])};
    if (options.windowed || options.offscreen) {
        shown.size = fitted(shown.size, asked_size(options));
    } else if (screen.direct) {
        shown.direct = display_of(screen, timing);
    } else {
        shown.monitor = screen.output;
    }
    return shown;
}

Vec3 out_of(const wall::Screen& s) {
    return glm::normalize(
        glm::cross(s.lower_right_world - s.lower_left_world, s.upper_left_world - s.lower_left_world));
}

// Returns the screen that the fallback head faces most squarely.
std::size_t faced_screen(const wall::WallSetup& setup) {
    const Vec3 back = setup.world_from_tracker.orientation * setup.fallback_head_tracker.orientation * Vec3(0, 0, 1);
    std::size_t best = 0;
    double most = -2.0;
    for (std::size_t i = 0; i < setup.screens.size(); ++i) {
        const double faces = glm::dot(out_of(wall::screen_world(setup, setup.screens[i])), back);
        if (faces <= most + 1e-6) continue;  // of two equal ones the first
        most = faces;
        best = i;
    }
    return best;
}

Result<SessionWall> wall_of_file(const DeskOptions& options) {
    SessionWall wall;
    wall.desk = false;
    BURIN_TRY(setup, wall::read_wall(options.wall));
    std::vector<wall::WallProblem> problems = wall::check(setup);
    for (wall::WallProblem& problem : wall::check_modes(setup)) problems.push_back(std::move(problem));
    for (const wall::WallProblem& problem : problems) {
        if (problem.error) return fail(options.wall + ", " + problem.where, problem.what, problem.remedy);
        std::fprintf(stderr, "burin: %s: %s\n", options.wall.c_str(), line_of(problem).c_str());
    }
    wall.setup = std::move(setup);
    for (const wall::WallScreen& screen : wall.setup.screens) {
        BURIN_TRY(shown, screen_shown(screen, wall.setup.timing, options));
        wall.screens.push_back(std::move(shown));
    }
    wall.main = faced_screen(wall.setup);
    return wall;
}

}  // namespace

Result<SessionWall> session_wall(const DeskOptions& options) {
    Result<SessionWall> wall = options.wall.empty() ? desk_wall(options) : wall_of_file(options);
    if (!wall || !options.panel_window) return wall;
    wall->screens.push_back({.name = "panel", .monitor = {}, .direct = {}, .size = kPanelScreen_px, .shown = {}});
    return wall;
}

void fit_desk_screen(SessionWall& wall, ImageSize eye) {
    if (!wall.desk || eye.width == 0 || eye.height == 0) return;
    const wall::Screen screen = wall::screen_of(wall::Wall{kDeskHeight_m * eye.width / eye.height, kDeskHeight_m});
    wall::WallScreen& desk = wall.setup.screens.front();
    desk.lower_left_tracker = screen.lower_left_world;
    desk.lower_right_tracker = screen.lower_right_world;
    desk.upper_left_tracker = screen.upper_left_world;
}

wall::OutputSettings output_on(const SessionWall& wall, std::size_t screen, const wall::OutputSettings& told) {
    if (wall.is_panel(screen)) return {};
    const wall::OutputSettings& main = wall.screens[wall.main].shown;
    wall::OutputSettings output = told;
    const wall::OutputSettings& own = wall.screens[screen].shown;
    if (told.mode == main.mode) output.mode = own.mode;
    output.swap_eyes = own.swap_eyes != (told.swap_eyes != main.swap_eyes);
    output.homography = own.homography;
    output.blend = own.blend;
    return output;
}

Quat world_from_screen(const wall::Screen& s) {
    const Vec3 right = glm::normalize(s.lower_right_world - s.lower_left_world);
    const Vec3 out = out_of(s);
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(out, right), out)));
}

}  // namespace burin::session
