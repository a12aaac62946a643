// SPDX-License-Identifier: MIT
#include "activities/train/participant_session.hpp"

#include <utility>

#include "base/try.hpp"
#include "devices/haptic/wand_choice.hpp"

namespace burin::activities {

session::SessionSetup participant_session(const session::SessionSetup& setup, std::shared_ptr<StudyActivity> activity) {
    session::SessionSetup session = setup;
    session.scene = {};
    session.scene.given = activity->scene();
    session.scene.no_workpiece = true;
    session.activity = std::move(activity);
    session.hands.tool.shape = "ball:0.001";  // a point, as far as a session's tool can be one
    session.desk.panel_window = true;
    return session;
}

session::SessionSetup unseen_session(std::shared_ptr<StudyActivity> activity) {
    session::SessionSetup setup;
    setup.hands.device = devices::kSimulatedWand;
    setup.work.journal = "none";
    setup.desk.unseen = true;
    return participant_session(setup, std::move(activity));
}

Result<StudyDevice> led_wand(const devices::WandDescription& wand, devices::AnyHand leads, std::string participant) {
    BURIN_TRY(points, devices::points_named(wand, devices::usual_points(wand)));
    StudyDevice device{wand, std::move(participant), true};
    device.hand = session::BroughtHand{.leads = std::move(leads), .handle = wand, .points = std::move(points)};
    return device;
}

}  // namespace burin::activities
