// SPDX-License-Identifier: MIT
// The session that a participant's stages are gone through in: the same whether a person sees it or nobody does, with a
// device in a hand or with a simulated wand that a learner or a script leads. Thread: the caller's.
#pragma once

#include <memory>
#include <string>

#include "activities/train/study_activity.hpp"
#include "devices/hand/any_hand.hpp"
#include "session/options/session_setup.hpp"

namespace burin::activities {

// Gives the options of a participant's session: the study's worlds alone, touched with points; the operator's panel is
// in a window of its own, whatever the options say, so that the participant's picture has the page and no more.
[[nodiscard]] session::SessionSetup participant_session(const session::SessionSetup& setup,
                                                        std::shared_ptr<StudyActivity> activity);

// Gives those of one that nobody sees, whose activity brings its hand. It keeps nothing besides what the activity's
// keeper does.
[[nodiscard]] session::SessionSetup unseen_session(std::shared_ptr<StudyActivity> activity);

// Gives the simulated wand, as the protocol has it, for the activity of such a session: led by `leads`. Fails where
// none of its points can touch.
[[nodiscard]] Result<StudyDevice> led_wand(const devices::WandDescription& wand, devices::AnyHand leads,
                                           std::string participant);

// Frames after which the first ticks have been followed, and the surface around the hand is known: before, nothing is
// said in a session that nobody sees.
inline constexpr int kFirstFrames = 3;

// How often such a session makes a frame, as a display shows it.
inline constexpr std::int64_t kFramesASecond = 60;

}  // namespace burin::activities
