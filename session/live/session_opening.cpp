// SPDX-License-Identifier: MIT
// Opens a session: workpiece, world, tool, hands and the scene that they touch.
#include <utility>
#include <vector>

#include "base/try.hpp"
#include "geometry/mesh/crumbs.hpp"
#include "session/live/opened_room.hpp"
#include "session/live/opened_scene.hpp"
#include "session/live/session.hpp"
#include "workpiece/workpiece.hpp"

namespace burin::session {
Session::Session(Clock& clock, const SessionSetup& options, double pace)
    : clock_(clock),
      options_(options),
      hands_(options, pace),
      activity_(options.activity),
      notices_(options),
      work_(options_, scene_, notices_.files(), notices_.log(), [this] { return saved_content(); }) {}

Result<std::unique_ptr<Session>> Session::create(const SessionSetup& options, Clock& clock, double pace,
                                                 std::unique_ptr<workpiece::Workpiece> made, const Place& place) {
    auto session = std::unique_ptr<Session>(new Session(clock, options, pace));
    BURIN_TRY_DO(session->load(std::move(made)));
    BURIN_TRY_DO(session->begin(place));
    return session;
}

Result<std::unique_ptr<Session>> Session::create(const SessionSetup& options, Clock& clock) {
    return create(options, clock, 1.0, nullptr, {});
}

Result<void> Session::load(std::unique_ptr<workpiece::Workpiece> made) {
    BURIN_TRY(opened, open_room(options_));
    room_ = std::move(opened.room);
    hands_.use(std::move(opened.handles));
    BURIN_TRY_DO(work_.open());
    if (has_workpiece(options_)) {
        if (!made) {
            BURIN_TRY(workpiece, make_workpiece(options_, work_.opened()));
            made = std::move(workpiece);
        }
        note_workpiece(*made, options_, room_, found_);
        if (const std::string& closed = made->loaded().closed; !closed.empty()) notify(closed, MessageKind::info);
        scene_.take(std::move(made));
    }
    if (has_world(options_)) {
        const bool is_saved = is_world_saved(work_.opened());
        BURIN_TRY(world, open_world(options_, work_.opened()));
        work_.world_has_begun(*world->objects(), is_saved);
        note_world(*world, options_, room_, found_);
        scene_.take(std::move(world));
    }
    work_.has_begun();
    note_tool(options_, room_, found_);
    notices_.begin(options_.record.from_before_units || scene_.workpiece() == nullptr);
    return {};
}

Result<void> Session::begin(const Place& place) {
    const Similarity placed = place ? place(room_, hands_.handles().front().get()) : Similarity{};
    BURIN_TRY(first, first_state(options_, found_, room_, hands_.handles(), placed));
    state_ = std::move(first);
    state_.carves = scene_.workpiece() != nullptr;
    if (scene_.world() != nullptr) state_.world = scene_.world()->objects();
    const ExportOptions& exports = options_.carve.exports;
    state_.crumbs_m =
        exports.crumbs_m.value_or(exports.usual_crumbs ? geometry::kCrumbCells * scene_.spacing_m() : 0.0);
    if (const auto& view = work_.opened().view) state_.world_from_object = *view;
    BURIN_TRY(use, tool_of(state_));
    notices_.look_at_tool(state_.led().tool, use.tool, room_.workpiece_object, scene_.spacing_m());
    time_.start_ns = clock_.now_ns();
    BURIN_TRY_DO(hands_.open(options_, state_, room_, activity_.brought_hand(), clock_));
    publish_parameters();
    if (!activity_.is_there())
        for (const std::string& more : hands_.more_than_rendered(state_, room_)) notify(more, MessageKind::info);
    BURIN_TRY_DO(scene_.begin(use, options_.carve.undo_memory_MiB << 20,
                              hands_.beginnings(state_, room_, scene_.spacing_m(), activity_.known_m()),
                              activity_.scene_part(), activity_.tap(), time_.start_ns));
    if (scene_.carved() != nullptr) scene_.carved()->order(workpiece::MirrorStrokes{state_.mirror});
    work_.begin_history(state_);
    work_.begin_journal(state_);
    return {};
}

}  // namespace burin::session
