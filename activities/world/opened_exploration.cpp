// SPDX-License-Identifier: MIT
#include "activities/world/opened_exploration.hpp"

#include <algorithm>
#include <bit>

#include "base/try.hpp"
#include "record/columns.hpp"
#include "scene/world_file.hpp"
#include "session/drive/headless_session.hpp"
#include "session/record/session_recording.hpp"

namespace burin::activities {

std::string name_in(const scene::World& world, scene::ObjectId id) {
    const auto at = std::ranges::find(world.objects, id, &scene::SceneObject::id);
    return at != world.objects.end() ? at->name : std::string();
}

Result<std::unique_ptr<OpenedExploration>> open_exploration(const ExploredWorld& world,
                                                            const ExplorationSettings& settings,
                                                            session::BroughtHand hand, FeltBy felt_by,
                                                            Nanoseconds begins_ns) {
    if (!world.record.empty() && !session::is_session_file(world.record))
        return fail(world.record, "is no name of a session file", "record an exploration into FILE.session");
    auto opened = std::make_unique<OpenedExploration>();
    opened->clock.sleep_until(begins_ns);
    opened->activity = std::make_shared<Exploration>(settings, std::move(hand), std::move(felt_by));
    session::SessionSetup options;
    options.scene.world = world.file;
    options.scene.given = world.scene;
    options.scene.no_workpiece = true;
    options.hands.tool.shape =
        "ball:" + record::text_of(std::bit_cast<record::Word>(settings.tool_radius_m), record::ColumnType::f64);
    options.activity = opened->activity;
    options.hands.points = world.points;
    options.hands.device = world.device;
    options.record.path = world.record;
    BURIN_TRY(session, session::Session::create(options, opened->clock));
    opened->session = std::move(session);
    return opened;
}

Result<void> OpenedExploration::run(double lasts_s, std::vector<std::pair<std::string, std::string>> facts) {
    const auto ended = [this] { return activity->outcome(); };
    return session::run_headless(*session, clock,
                                 {.lasts_ns = nanoseconds(lasts_s), .facts = std::move(facts), .after_frame = ended});
}

}  // namespace burin::activities
