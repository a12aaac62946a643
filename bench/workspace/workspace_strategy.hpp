// SPDX-License-Identifier: MIT
// Decides how the simulated hand uses each workspace technique: its next goal, and
// when it presses. It decides as people are thought to, intermittently: at the end
// of a movement once its result has been seen, or while it controls a rate.
//
//   fixed, scaling   to the target, then corrections
//   moving, taps     to the border on the side of the target, a series of presses as long as it seems to need, then to
//                    the target
//   moving, drag     to the border, hold until the box, as it will be when the finger is up, has the target within its
//                    inner 70 %
//   clutching        to the border, press, to the opposite border, release, and so on
//   bubble           beyond the ball as far as the desired speed asks for: the remaining distance in half a second
//   drift            to the border, and there to and fro by 50 mm until the target has come within the box
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "haptics/workspace/technique.hpp"

namespace burin::bench {

// A technique and the manner of its use.
struct Approach {
    std::string name;
    haptics::WorkspaceTechnique technique = haptics::WorkspaceTechnique::fixed;
    bool drags = false;  // moving: holds the button instead of tapping it
};

[[nodiscard]] std::vector<Approach> all_approaches();

// State that the hand knows: what it sees is old by the delay of vision, its own position it feels at once.
struct View {
    Vec3 target_object{0.0};
    Vec3 tool_object{0.0}, tool_before_object{0.0};  // as seen, and 50 ms before that
    Vec3 felt_device_m{0.0};                         // the hand's position at the time of what is seen
    Vec3 hand_device_m{0.0};                         // now
    Vec3 goal_device_m{0.0};                         // of its last movement
    bool button = false;
    double vision_s = 0.0, finger_s = 0.0;  // delay of vision; time for a press or a release
};

struct Decision {
    std::optional<Vec3> goal_device_m;  // a new movement
    std::optional<bool> button;         // the finger goes down or up
    double rest_s = 0.0;                // from the end of the movement until the next decision
    bool keeps_moving = false;          // decides again after rest_s, wherever the hand is by then
};

class Strategist {
public:
    Strategist(const Approach& approach, const haptics::WorkspaceSettings& settings);
    [[nodiscard]] Decision decide(const View& view);

private:
    [[nodiscard]] Vec3 in_device(const Vec3& difference_object_m) const;
    [[nodiscard]] Decision reach_directly(const View& view, const Vec3& needed) const;
    [[nodiscard]] Decision tap(const View& view);
    [[nodiscard]] Decision drag(const View& view);
    [[nodiscard]] Decision clutch(const View& view);
    [[nodiscard]] Decision glide(const View& view) const;
    [[nodiscard]] Decision stir(const View& view);
    [[nodiscard]] bool within_box(const Vec3& p, double share) const;
    [[nodiscard]] Vec3 border_towards(const Vec3& p) const;

    Approach approach_;
    haptics::WorkspaceSettings settings_;
    Similarity device_from_object_;  // for differences
    Vec3 half_m_;
    int taps_ = 0;           // remaining in the series
    bool returned_ = false;  // clutching: the hand has gone back
    double side_ = 1.0;      // drift: direction of the next stroke
};

}  // namespace burin::bench
