// SPDX-License-Identifier: MIT
#include "desk/live/desk.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "base/longest_side.hpp"
#include "base/try.hpp"
#include "compute/vulkan/engine_choice.hpp"
#include "desk/live/opened_desk.hpp"
#include "desk/viewer/view_cube.hpp"
#include "desk/viewer/viewed_picture.hpp"
#include "session/drive/thread_replay.hpp"

namespace burin::session {

// ---- Opening

Result<std::unique_ptr<Desk>> Desk::create(const SessionSetup& options, const SessionWall& wall, Clock& clock,
                                           double pace, std::unique_ptr<workpiece::Workpiece> made) {
    BURIN_TRY(output, first_output(wall, options.desk));
    auto desk = std::unique_ptr<Desk>(new Desk(clock, wall));
    const auto place = [&](const Room& room, const HeldHandle* held) {
        desk->room_ = open_desk(options, wall, room);
        desk->viewer_ = begin_viewer(desk->room_, output);
        desk->viewer_.edge_comfort = options.desk.edge_comfort;
        return placed_before(desk->viewer_, room, desk->room_, held);
    };
    SessionSetup with_device = options;
    if (!with_device.carve.make_engine) with_device.carve.make_engine = compute::engine_maker(options.carve.engine);
    BURIN_TRY(session, Session::create(with_device, clock, pace, std::move(made), place));
    desk->session_ = std::move(session);
    take_hand(desk->viewer_, desk->session_->state());
    desk->viewer_.seen_from = seen_from(desk->seen());
    if (!options.record.from_before_units)
        desk->tool_sizes_ = tool_sizes_for(longest_side_m(desk->session_->room().workpiece_object));
    if (const workpiece::Workpiece* workpiece = desk->session_->scene_side().workpiece())
        desk->surface_ = SeenSurface(workpiece->surface().lattice());
    return desk;
}

Result<std::unique_ptr<Desk>> Desk::create_as_recorded(const SessionSetup& options, const SessionWall& wall,
                                                       const ThreadLog& log, const std::string& name,
                                                       SimulatedClock& clock) {
    clock.sleep_until(log.clock.start_ns);
    BURIN_TRY(desk, create(options, wall, clock, log.clock.pace));
    BURIN_TRY_DO(check_rate(desk->session(), log, name));
    return std::move(desk);
}

// ---- One step

// The viewer, and what the panel's widgets have given.
class Desk::StepLead final : public ViewerLead {
public:
    StepLead(Desk& desk, const ViewerLook& look)
        : ViewerLead(desk.viewer_, desk.session_->room(), desk.room_, look),
          of_(desk),
          begun_in_(desk.output_on(desk.room_.wall.main).mode) {}

    [[nodiscard]] std::vector<CommandInput> later_commands(const SessionState& state) override {
        return of_.after(begun_in_, state);
    }
    [[nodiscard]] std::vector<std::string> watch(const SessionState& state, const haptics::ToolState& tool) override {
        fit_desk_screen(of_.room_.wall, of_.main_eye());  // a command may have changed the mode
        std::vector<std::string> told;
        for (auto news : {of_.comfort_.look(seen(state), tool),
                          of_.tracker_.look(viewer_, desk_, of_.session_->step_ns()), of_.wand_.look(viewer_.wands)})
            if (news) told.push_back(std::move(*news));
        return told;
    }

private:
    Desk& of_;
    wall::StereoMode begun_in_;
};

void Desk::step(const FrameInput& input, const wall::OutputPlace& output, std::span<const haptics::ToolState> tools,
                const Give& give, ImageSize panel_output) {
    // Each keeps its last size while it is minimised.
    if (!is_empty(output.size)) output_ = output;
    if (!is_empty(panel_output)) panel_output_ = panel_output;
    fit_desk_screen(room_.wall, main_eye());
    const std::size_t line = input.events.empty() ? 0 : input.events.back().line;
    session_->begin_step(input.time_ns, tools, line);
    note_times(input);
    const SceneInput left = feed_panel(input);
    room_.free_width = panel_.free_width(room_, main_eye(), output_.size);
    const ViewerLook look{input.display_ns, main_eye(), left.captured, output_, &surface_};
    StepLead leader(*this, look);
    session_->step({left.events, line, left.captured.keyboard}, leader, give);
}

void Desk::note_times(const FrameInput& input) {
    const Nanoseconds start_ns = session_->start_ns();
    const haptics::ToolState& tool = session_->tool_in_use();
    times_.sampled(start_ns + head_sampled_ns(input), tool.time_ns);
    if (tool.buttons != 0) times_.works();
    for (const InputEvent& event : input.events) {
        const auto* click = std::get_if<MouseClick>(&event.input);
        if (click != nullptr && click->pressed && click->button == MouseButton::left)
            times_.pressed(start_ns + event.time_ns);
    }
}

SceneInput Desk::feed_panel(const FrameInput& input) {
    laid_out_changes_ = session_->log().changes();
    auto left = panel_.feed(input,
                            {.seen = seen(),
                             .session = *session_,
                             .tracker = tracker_.report(),
                             .tool_sizes = tool_sizes_,
                             .times = times_,
                             .shown = output_on(room_.wall.main),
                             .output = output_,
                             .panel_output = panel_output_,
                             .acknowledged = acknowledged_,
                             .recording_ended = recording_ended_,
                             .tells_late_pictures = tells_late_pictures()},
                            session_->log());
    for (const std::string& line : times_.take_new_warnings())
        if (tells_late_pictures()) std::fprintf(stderr, "burin: %s\n", line.c_str());
    if (left) return std::move(*left);
    session_->notify(left.error().line());
    viewer_.panel = false;
    return {{input.events.begin(), input.events.end()}, {}};
}

// Two pictures side by side or one above the other leave each another shape: what filled one is cut off in the other.
// A mode that the step itself has come to is the next one's: screen and panel still have the shape of the one before.
std::vector<CommandInput> Desk::after(wall::StereoMode begun_in, const SessionState& state) {
    std::vector<CommandInput> commands;
    const wall::StereoMode before = std::exchange(framed_, begun_in).value_or(begun_in);
    const bool other_shape = wall::eye_size(begun_in, output_.size) != wall::eye_size(before, output_.size);
    const bool may_fit = room_.wall.desk && state.mouse == MouseMode::surface && !viewer_.desk.on_surface.pressed;
    if (other_shape && may_fit) commands.push_back({std::string(name_of(Action::fit_view)), {}});
    commands.insert(commands.end(), panel_.actions().begin(), panel_.actions().end());
    return commands;
}

// ---- What is new of the scene

void Desk::take_loaded() { take(session_->take_loaded()); }

void Desk::take_news(std::uint64_t updates) { take(session_->take_news(updates)); }

void Desk::take(std::optional<scene::SurfaceUpdate> news) {
    if (!news) return;
    times_.cut(news->cut_ns);
    surface_.take(*news);
    // Merged, because a session that draws rarely, as off screen, would keep every version of each tile.
    if (updates_.empty())
        updates_.push_back(std::move(*news));
    else
        scene::merge(updates_.back(), std::move(*news));
}

// ---- Pictures

std::optional<picture::Picture> Desk::scene_on(std::size_t screen) const {
    if (room_.wall.is_panel(screen)) return std::nullopt;
    const SessionState& state = session_->state();
    const ActivitySide& activity = session_->activity();
    const SessionHands& hands = session_->hands();
    const haptics::ToolState& tool = session_->tool_in_use();
    std::optional<picture::Picture> scene = scene_of(seen(), screen, lattice_origin_object(), tool);
    if (!scene) return scene;
    if (state.mouse == MouseMode::surface) stand_on_plinth(*scene);
    for (std::size_t part = 0; !activity.draws_hands() && part < hands.parts(); ++part)
        if (part != hands.first_part(state.hand))
            add_tool(*scene, state, hands.part_of_hand(part).hand, session_->tools()[part]);
    add_mirror(*scene, state, session_->room(), room_.mirror_panes, tool);
    if (screen == room_.wall.main) add_view_cube(*scene, seen());
    add_border(*scene, state, session_->room(), tool);
    if (const WorldSide* world = session_->scene_side().world())
        std::ranges::move(world->drawn().in_world(state.world_from_object), std::back_inserter(scene->objects));
    if (activity.draws_hands()) scene->tool.visible = false;
    activity.stage(*scene, screen);
    // What an activity shows is its own: a shadow would tell of a study's tube that nobody may see.
    if (!session_->options().desk.shadows || activity.is_there())
        for (picture::DrawnObject& object : scene->objects) object.casts_shadow = false;
    return scene;
}

// A part that was turned or cut touches its plinth with what is lowest of it now, and not with its box's corner.
void Desk::stand_on_plinth(picture::Picture& scene) const {
    const Similarity& pose = session_->state().world_from_object;
    const auto lowest_m = surface_.lowest_along_m(glm::conjugate(pose.orientation) * Vec3(0.0, 1.0, 0.0));
    if (!lowest_m) return;
    const PlinthPlace plinth =
        plinth_under(session_->room().workpiece_object, pose, middle_of(wall::eyes_of(scene.viewer)),
                     pose.position_m.y + pose.scale * *lowest_m);
    scene.pedestal.visible = plinth.visible;
    scene.pedestal.top_center_world = plinth.top_center_world;
    scene.pedestal.radius_m = plinth.radius_m;
}

void Desk::refuse_mode(wall::StereoMode working, const Error& error) {
    const std::string refused(wall::title_of(viewer_.output.mode)), goes_on(wall::title_of(working));
    viewer_.output.mode = working;
    refused_ = working;
    session_->notify_of_event("stereo mode " + refused + " is not shown, " + goes_on + " goes on: " + error.line(),
                              MessageKind::warning);
}

std::optional<Nanoseconds> Desk::changes_ns() const {
    if (std::as_const(session_->notices()).log().changes() != laid_out_changes_) return session_->step_ns();
    std::optional<Nanoseconds> next = panel_.changes_ns();
    if (const auto other = session_->changes_ns()) next = std::min(next.value_or(*other), *other);
    return next;
}

}  // namespace burin::session
