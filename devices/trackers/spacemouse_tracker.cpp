// SPDX-License-Identifier: MIT
#include "devices/trackers/spacemouse_tracker.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <utility>

namespace burin::devices {
namespace {

// The scene is at arm's length and as large as a screen: it goes faster than a hand does.
constexpr double kSceneSpeed_m_per_s = 0.3;
// The middle of a desktop's screen, before the home of the head.
constexpr Vec3 kSceneMiddle_world{0.0, 1.6, 0.0};
// The longest that one report moves it on: reports are 8 to 16 ms apart, and looks 50 ms.
constexpr double kLongestStep_s = 0.05;

}  // namespace

Result<std::unique_ptr<SpaceMouseTracker>> SpaceMouseTracker::open(const std::string& where, TrackerHost host) {
    const std::string text = where.substr(std::min(where.size(), std::string_view(kSpaceMouse).size() + 1));
    SpaceMouseSettings usual;
    usual.speed_m_per_s = kSceneSpeed_m_per_s;
    BURIN_TRY(settings, spacemouse_settings("tracker " + where, text, usual));
    if (!settings.file.empty())
        return fail("tracker " + where, "takes no description: " + settings.file, "leave it out");
    if (host.described != nullptr)
        return fail("tracker " + where, "moves the scene, and has no bodies that a description could name",
                    "give it without one: --tracker " + where);
    std::unique_ptr<SpaceMouseTracker> tracker(new SpaceMouseTracker(std::move(settings), std::move(host)));
    tracker->wand_world_.position_m = kSceneMiddle_world;
    auto line = SpaceMouseLine::open("tracker " + where, tracker->settings_.place,
                                     [t = tracker.get()](const SpaceMouseState& cap) { t->move_on(cap); });
    if (!line) return std::unexpected(line.error());
    tracker->line_ = std::move(*line);
    return tracker;
}

std::vector<std::string> SpaceMouseTracker::take_messages() {
    std::vector<std::string> messages = inbox_.take_messages();
    for (std::string& message : line_->take_messages()) messages.push_back(std::move(message));
    return messages;
}

void SpaceMouseTracker::move_on(const SpaceMouseState& cap) {
    const Nanoseconds now_ns = host_.clock.now_ns();
    const double dt_s = std::min(seconds(now_ns - std::exchange(before_ns_, now_ns)), kLongestStep_s);
    const Vec3 velocity = spacemouse_rate(cap.push, settings_.dead_zone, settings_.speed_m_per_s);
    const Vec3 turning = spacemouse_rate(cap.turn, settings_.dead_zone, settings_.turning_rad_per_s);
    const bool moves = velocity != Vec3(0.0) || turning != Vec3(0.0);
    const bool was_reset = (buttons_ >> 1 & 1u) != 0, is_reset = (cap.buttons >> 1 & 1u) != 0;
    buttons_ = cap.buttons;
    if (!moves && !holds_ && was_reset == is_reset) return;
    if (was_reset != is_reset) click(kResetButton, is_reset, now_ns);
    if (moves && !std::exchange(holds_, true)) {
        inbox_.push({now_ns, WandInput{kWand, wand_world_, true}});
        click(kHoldButton, true, now_ns);
    } else if (holds_) {
        wand_world_.position_m += dt_s * velocity;
        wand_world_.orientation = turned(wand_world_.orientation, turning, dt_s);
        inbox_.push({now_ns, WandInput{kWand, wand_world_, true}});
        if (!moves) {
            holds_ = false;
            click(kHoldButton, false, now_ns);
        }
    }
    if (host_.on_sample) host_.on_sample();
}

Result<std::unique_ptr<Tracker>> open_spacemouse_tracker(const std::string& where, TrackerHost host) {
    return SpaceMouseTracker::open(where, std::move(host));
}

}  // namespace burin::devices
