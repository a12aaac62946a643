// SPDX-License-Identifier: MIT
// A participant's visit as a session's recording keeps it, and the visit done again: the settings name the group and
// the stages, and the protocol's text is a fact of the recording. Neither says whose visit it was. Pure; any thread.
#pragma once

#include <string>
#include <vector>

#include "activities/train/study_activity.hpp"
#include "session/activity/recorded_activity.hpp"

namespace burin::activities {

inline constexpr std::string_view kVisitName = "study";
// The fact that holds the protocol's text.
inline constexpr const char* kProtocolTextFact = "study protocol";

// Returns StudyActivity::settings() of a visit. The places are of one day.
[[nodiscard]] std::string visit_settings(const std::string& protocol_digest, const study::Group& group,
                                         const std::vector<study::StagePlace>& places);

// Makes the activity of a recorded visit anew, which keeps nothing. Fails where the recording's protocol is not the one
// that the settings name.
[[nodiscard]] Result<session::MadeActivity> visit_as_recorded(const std::string& settings,
                                                              const session::RecordedFact& fact);

}  // namespace burin::activities
