// SPDX-License-Identifier: MIT
// A wall as it stands in a room: its screens, its tracker, its viewer's eyes, how it shows the two eyes. Plain data.
//
// Units: metres, radians but where a name says deg or Hz. Frames: `tracker` is what the head tracker and the wand report in;
// `world` is the renderer's (base/space.hpp); `sensor` is the head sensor's own, wherever on the head it sits.
// Functions are pure, any thread; problems() and views_of() allocate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/display_choice.hpp"
#include "renderer/scene.hpp"

namespace burin {

// What a wall file writes its lengths in; everything here is in metres all the same.
enum class LengthUnit : std::uint8_t { m, cm, mm, inch, ft };
[[nodiscard]] const char* name_of(LengthUnit unit);  // "m", "cm", "mm", "in", "ft"
[[nodiscard]] std::optional<LengthUnit> length_unit(const std::string& name);
[[nodiscard]] double metres_in(LengthUnit unit);

// How a projector fades towards its edges where a neighbour's picture lies on top of it: over the given part of the
// picture's width (left, right) or height (top, bottom), 0 to 0.5. Light falls as x^gamma would have it look even.
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
    std::string output = "0";  // a monitor's name, or its index; with `direct` a display's, or a part of its name
    // Driven without a window system, and how that display separates the eyes; nothing: the output is a monitor of the desktop.
    std::optional<gpu::DisplayStereo> direct = std::nullopt;
    std::string mode = "mono";  // the name of a stereo mode; its meaning is the output stage's
    bool swap_eyes = false;
    // Where a point of the picture belongs on the projector's own: both in 0..1, x to the right, y downwards; rows.
    // out = (h0 . p, h1 . p) / h2 . p with p = (x, y, 1).
    std::optional<std::array<std::array<double, 3>, 3>> homography = std::nullopt;
    EdgeBlend blend{};
};

struct SensorEyes {
    Vec3 left_sensor{-0.0315, 0.0, 0.0};  // mean of adults 63 mm (Dodgson 2004)
    Vec3 right_sensor{0.0315, 0.0, 0.0};
};

// Eyes on the sensor's own X axis about a point.
[[nodiscard]] SensorEyes eyes_about(const Vec3& middle_sensor, double interpupillary_m);

// The largest parallax that content should have, as the angle by which it turns the eyes away from where they meet on the
// screen. What 84 % of 392 young adults still fused (Nagata 2002); the median's limits are 3.34 and 3.05. Comfort ends
// earlier: on far screens behind the screen first, on near ones in front of it (Shibata et al. 2011), so a wall may well ask
// for less.
struct ParallaxBudget {
    double crossed_deg = 1.84;    // in front of the screen
    double uncrossed_deg = 2.04;  // behind it; besides, parallax never exceeds the distance of the eyes
};

enum class EyeOrder : std::uint8_t { simultaneous, left_first, right_first };
[[nodiscard]] const char* name_of(EyeOrder order);  // "simultaneous", "left-first", "right-first"

struct DisplayTiming {
    double refresh_Hz = 60.0;  // fields a second: 120 for 60 an eye
    EyeOrder eye_order = EyeOrder::simultaneous;
};

struct WallSetup {
    std::string name;
    LengthUnit unit = LengthUnit::m;
    Pose world_from_tracker;
    std::vector<WallScreen> screens;
    SensorEyes eyes;
    Pose fallback_head_tracker{{0.0, 1.6, 2.0}, Quat{1.0, 0.0, 0.0, 0.0}};  // of the sensor, while tracking is lost
    ParallaxBudget budget;
    DisplayTiming timing;
};

// A screen as the renderer wants it.
[[nodiscard]] Screen screen_world(const WallSetup& setup, const WallScreen& screen);

// The head sensor in the tracker's frame, at the time when each eye's picture is shown (head.hpp).
struct HeadPoses {
    Pose left_tracker, right_tracker;
};

[[nodiscard]] Eyes eyes_world(const WallSetup& setup, const HeadPoses& head);

// What to draw for one screen: Scene::screen and, by viewer_with(eyes), Scene::viewer.
struct ScreenView {
    Screen screen;
    Eyes eyes;
    bool visible = false;  // can_be_seen(): false while an eye is not in front of this screen, which is then left dark
};

// In the order of setup.screens.
[[nodiscard]] std::vector<ScreenView> views_of(const WallSetup& setup, const HeadPoses& head);

// The viewer whose eyes_of() are these to within rounding, turned as little as possible away from `near`.
[[nodiscard]] Viewer viewer_with(const Eyes& eyes, const Quat& near = Quat{1.0, 0.0, 0.0, 0.0});

// What is wrong with a setup. An error is what cannot be drawn or would be drawn wrongly; a warning is what somebody
// may have meant.
struct WallProblem {
    bool error = false;
    std::string where;   // a screen's name, or what else is concerned
    std::string what;    // with numbers
    std::string remedy;  // never empty
};
[[nodiscard]] std::vector<WallProblem> check(const WallSetup& setup);
[[nodiscard]] std::string line_of(const WallProblem& problem);  // "error: screen front: ...; remedy"

}  // namespace burin
