// SPDX-License-Identifier: MIT
// A display wall: its screens, its tracker, its viewer's eyes and how it shows the two eyes. Plain data.
//
// Units: metres, radians unless a name says deg or Hz. Frames: `tracker` is what the head tracker and the wand report
// in; `world` is the renderer's (base/space.hpp); `sensor` is the head sensor's own, wherever on the head it sits.
// Functions are pure, any thread; check() and views_of() allocate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/display_stereo.hpp"
#include "base/length_unit.hpp"
#include "wall/screen.hpp"

namespace burin::wall {

// The unit of lengths in a wall file; everything here is in metres all the same.
using burin::LengthUnit;

// Edge blending: a projector fades towards an edge that a neighbour's picture overlaps, over the given fraction of the
// picture's width (left, right) or height (top, bottom), 0 to 0.5. gamma is the projector's, so that the light adds up
// evenly.
struct EdgeBlend {
    double left = 0.0, right = 0.0, top = 0.0, bottom = 0.0;
    double gamma = 2.2;
    [[nodiscard]] bool any() const { return left > 0.0 || right > 0.0 || top > 0.0 || bottom > 0.0; }
};

// One flat rectangular screen. Corners as the viewer sees them.
struct WallScreen {
    std::string name;
    Vec3 lower_left_tracker{-1.524, 0.0, 0.0};
    Vec3 lower_right_tracker{1.524, 0.0, 0.0};
    Vec3 upper_left_tracker{-1.524, 2.286, 0.0};
    std::array<int, 2> pixels{1440, 1080};
    // A monitor's name or index; with `direct` a display's name or a part of it.
    std::string output = "0";
    // How a display that is driven without a window system separates the eyes; nothing: the output is a monitor of the
    // desktop.
    std::optional<DisplayStereo> direct = std::nullopt;
    std::string mode = "mono";  // the name of a stereo mode (wall/stereo_mode.hpp)
    bool swap_eyes = false;
    // Maps a point of the picture to the projector's own picture: both in 0..1, x to the right, y downwards; rows.
    // out = (h0 . p, h1 . p) / h2 . p with p = (x, y, 1).
    std::optional<std::array<std::array<double, 3>, 3>> homography = std::nullopt;
    EdgeBlend blend{};
};

struct SensorEyes {
    Vec3 left_sensor{-0.0315, 0.0, 0.0};  // mean of adults 63 mm (Dodgson 2004)
    Vec3 right_sensor{0.0315, 0.0, 0.0};
};

// Eyes on the sensor's own X axis, half the distance to each side of a point.
[[nodiscard]] SensorEyes eyes_about(const Vec3& middle_sensor, double interpupillary_m);

// The largest parallax that content should have, as the angle by which it turns the eyes away from where they meet on
// the screen. The defaults are what 84 % of 392 young adults still fused (Nagata 2002); the median's limits are 3.34
// and 3.05. Comfort ends earlier: on far screens behind the screen first, on near ones in front of it (Shibata et al.
// 2011), so a wall may well ask for less.
struct ParallaxBudget {
    double crossed_deg = 1.84;  // in front of the screen
    // Behind the screen; in addition, parallax never exceeds the distance of the eyes.
    double uncrossed_deg = 2.04;
};

enum class EyeOrder : std::uint8_t { simultaneous, left_first, right_first };
[[nodiscard]] const char* name_of(EyeOrder order);  // "simultaneous", "left-first", "right-first"

struct DisplayTiming {
    double refresh_Hz = 60.0;  // fields a second: 120 for 60 per eye
    EyeOrder eye_order = EyeOrder::simultaneous;
};

struct WallSetup {
    std::string name;
    LengthUnit unit = LengthUnit::m;
    Pose world_from_tracker;
    std::vector<WallScreen> screens;
    SensorEyes eyes;
    // Pose of the sensor while tracking is lost.
    Pose fallback_head_tracker{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};
    ParallaxBudget budget;
    DisplayTiming timing;
    // The table [tracker] of the file, as TOML: who hears trackers reads it (devices/trackers/tracker_file.hpp). Kept
    // so that a file that is written again has it. Empty: none.
    std::string tracker_toml;
};

// A screen in the world frame, as the renderer takes it.
[[nodiscard]] Screen screen_world(const WallSetup& setup, const WallScreen& screen);

// The head sensor in the tracker's frame, at the time when each eye's picture is shown (wall/head_prediction.hpp).
struct HeadPoses {
    Pose left_tracker, right_tracker;
};

[[nodiscard]] Eyes eyes_world(const WallSetup& setup, const HeadPoses& head);

// What the renderer needs for one screen: Scene::screen and, by viewer_with(eyes), Scene::viewer.
struct ScreenView {
    Screen screen;
    Eyes eyes;
    // can_be_seen(): false while an eye is not in front of this screen, which is then left dark.
    bool visible = false;
};

// The views of all screens, in the order of setup.screens.
[[nodiscard]] std::vector<ScreenView> views_of(const WallSetup& setup, const HeadPoses& head);

// A viewer whose eyes_of() are these to within rounding, turned as little as possible away from `near`.
[[nodiscard]] Viewer viewer_with(const Eyes& eyes, const Quat& near = Quat{1.0, 0.0, 0.0, 0.0});

// A problem of a setup. An error cannot be drawn or would be drawn wrongly; a warning may be intended.
struct WallProblem {
    bool error = false;
    std::string where;   // a screen's name, or another part of the setup
    std::string what;    // the problem, with numbers
    std::string remedy;  // never empty
};
// Checks geometry, pixels, blending, eyes, comfort and timing.
[[nodiscard]] std::vector<WallProblem> check(const WallSetup& setup);
// Checks the stereo modes: finds unknown ones, and those that do not suit the way in which a display is driven.
[[nodiscard]] std::vector<WallProblem> check_modes(const WallSetup& setup);
[[nodiscard]] std::string line_of(const WallProblem& problem);  // "error: screen front: ...; remedy"

}  // namespace burin::wall
