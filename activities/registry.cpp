// SPDX-License-Identifier: MIT
#include "activities/registry.hpp"

#include <algorithm>
#include <array>

#include "activities/grasp/grasp.hpp"
#include "activities/rehab/exercise_kinds.hpp"
#include "activities/rehab/rehab.hpp"
#include "activities/seek/seek.hpp"
#include "activities/train/recorded_visit.hpp"
#include "activities/world/exploration.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

Result<session::MadeActivity> seek_as_recorded(const std::string& settings, const session::RecordedFact& /*fact*/) {
    BURIN_TRY(options, seek_options_of(settings));
    return session::MadeActivity{std::make_shared<Seek>(options), nullptr};
}

Result<session::MadeActivity> grasp_as_recorded(const std::string& settings, const session::RecordedFact& /*fact*/) {
    BURIN_TRY(options, grasp_options_of(settings));
    return session::MadeActivity{std::make_shared<Grasp>(options), nullptr};
}

Result<session::MadeActivity> rehab_as_recorded(const std::string& settings, const session::RecordedFact& /*fact*/) {
    BURIN_TRY(exercise, exercise_of(settings));
    return session::MadeActivity{std::make_shared<Rehab>(std::move(exercise)), nullptr};
}

constexpr std::array kActivityKinds{
    ActivityKind{Exploration::kName, "A world is explored along a stroke by a simulated hand", exploration_as_recorded},
    ActivityKind{"seek", "Objects of a world are touched as they are named", seek_as_recorded},
    ActivityKind{"hand", "A hand in a glove grasps and carries the objects of a world", grasp_as_recorded},
    ActivityKind{"rehab", "An exercise for a hand in a glove: what its hand does is counted", rehab_as_recorded},
    ActivityKind{kVisitName, "A participant goes through the stages of a study", visit_as_recorded},
};

}  // namespace

std::span<const ActivityKind> activity_kinds() { return kActivityKinds; }

Result<session::MadeActivity> activity_as_recorded(const std::string& settings, const session::RecordedFact& fact) {
    if (settings.empty()) return session::MadeActivity{};
    const std::string name = settings.substr(0, settings.find(' '));
    const auto kind = std::ranges::find(kActivityKinds, name, &ActivityKind::name);
    if (kind != kActivityKinds.end()) return kind->make(settings, fact);
    std::string known;
    for (const ActivityKind& one : kActivityKinds) known += (known.empty() ? "" : ", ") + std::string(one.name);
    return fail("the recording", "is of the activity '" + name + "', and this program has " + known,
                "replay it with the program that recorded it");
}

}  // namespace burin::activities
