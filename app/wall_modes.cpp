// SPDX-License-Identifier: MIT
#include "app/wall_modes.hpp"

#include <optional>
#include <string>

#include "renderer/output/stereo_mode.hpp"

namespace burin {
namespace {

std::optional<WallProblem> contradiction(const WallScreen& screen, StereoMode mode) {
    if (!screen.direct) return std::nullopt;
    const std::string direct = gpu::name_of(*screen.direct);
    const ModeNeeds needs = needs_of(mode);
    if (needs.two_windows) {
        return WallProblem{true, screen.name,
                           "mode two_windows needs a window for the right eye, and it is driven without windows",
                           "choose another mode, or leave direct out"};
    }
    const bool separates = *screen.direct != gpu::DisplayStereo::none;
    if (needs.two_layers && !separates) {
        return WallProblem{true, screen.name,
                           "direct = \"plain\" gives the display one picture, mode two_layers has two",
                           "say how the display separates them: direct = \"hdmi-3d\", \"onboard-din\" or "
                           "\"inband-displayport\""};
    }
    if (separates && !needs.two_layers) {
        return WallProblem{true, screen.name,
                           "direct = \"" + direct + "\" separates two pictures, mode " + screen.mode + " has one",
                           "choose mode = \"two_layers\", or direct = \"plain\""};
    }
    return std::nullopt;
}

}  // namespace

std::vector<WallProblem> check_modes(const WallSetup& setup) {
    std::vector<WallProblem> problems;
    for (const WallScreen& screen : setup.screens) {
        const auto mode = parse_stereo_mode(screen.mode);
        if (!mode) {
            problems.push_back({true, screen.name, "mode: " + mode.error().what, mode.error().remedy});
        } else if (auto problem = contradiction(screen, *mode)) {
            problems.push_back(std::move(*problem));
        }
    }
    return problems;
}

}  // namespace burin
