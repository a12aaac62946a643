// SPDX-License-Identifier: MIT
// A SpaceMouse that moves the scene: --tracker spacemouse, as one moves it in a drawing program. What the cap does, the
// scene does: pushed to the right it goes to the right, and it turns as the cap is turned.
//
// To the session it is a second wand that holds the scene while the cap is pushed: it takes hold where it stands, is
// led by the rates (devices/spacemouse/spacemouse_rates.hpp), and lets go. So it is recorded and done again as a wand
// is. The wand begins in the middle of a desktop's screen, about which the scene turns; it goes along with the scene,
// so that this point of it stays the one that it turns about. The second button brings the scene back to its start.
// Frame: world. Threads: as Tracker has it.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "devices/spacemouse/spacemouse_line.hpp"
#include "devices/spacemouse/spacemouse_rates.hpp"
#include "devices/trackers/tracker_inbox.hpp"

namespace burin::devices {

class SpaceMouseTracker final : public Tracker {
public:
    // The panel is pointed at by the first wand, so that it is the second.
    static constexpr std::uint32_t kWand = 1, kHoldButton = 0, kResetButton = 3;

    // where: spacemouse, or spacemouse:PLACE and settings.
    [[nodiscard]] static Result<std::unique_ptr<SpaceMouseTracker>> open(const std::string& where, TrackerHost host);

    [[nodiscard]] std::vector<TrackerSample> take() override { return inbox_.take(); }
    [[nodiscard]] std::vector<std::string> take_messages() override;
    [[nodiscard]] std::uint64_t refused() const override { return inbox_.refused() + line_->refused(); }

private:
    SpaceMouseTracker(SpaceMouseSettings settings, TrackerHost host)
        : settings_(std::move(settings)), host_(std::move(host)) {}
    void move_on(const SpaceMouseState& cap);
    void click(std::uint32_t button, bool pressed, Nanoseconds time_ns) {
        inbox_.push({time_ns, WandClick{kWand, button, pressed}});
    }

    SpaceMouseSettings settings_;
    TrackerHost host_;
    TrackerInbox inbox_;
    // Of the line's thread:
    Pose wand_world_;
    bool holds_ = false;
    std::uint32_t buttons_ = 0;
    Nanoseconds before_ns_ = 0;
    std::unique_ptr<SpaceMouseLine> line_;  // after what its thread uses
};

// SpaceMouseTracker::open() for the registry.
[[nodiscard]] Result<std::unique_ptr<Tracker>> open_spacemouse_tracker(const std::string& where, TrackerHost host);

}  // namespace burin::devices
