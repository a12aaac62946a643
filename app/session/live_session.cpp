// SPDX-License-Identifier: MIT
#include "app/session/live_session.hpp"

#include <cstdio>
#include <filesystem>

#include "app/engine_choice.hpp"
#include "renderer/frame_setup.hpp"

namespace burin {
namespace {

constexpr double kShadowsFollow = 0.1;  // of a radian

// The frame's thread takes ticks to the recording: it may stall for so many.
constexpr std::size_t kTicksToRecord = 8192;

Room room_of(const Lattice& lattice, const SessionWall& wall) {
    Room room;
    room.workpiece_object = workpiece_bounds(lattice);
    room.wall = wall;
    const Pose fallback = wall.setup.fallback_head_tracker;
    room.desk.home_head_world = {wall.setup.world_from_tracker * fallback.position_m,
                                 wall.setup.world_from_tracker.orientation * fallback.orientation};
    if (wall.desk) room.desk.head_world = {{-2.0, 0.4, 0.3}, {2.0, 2.4, 6.0}};
    return room;
}

}  // namespace

LiveSession::LiveSession(Clock& clock, const SculptOptions& options)
    : clock_(clock),
      pool_(options.threads),
      channels_(HapticChannels::kStrokes, options.live.record.empty() ? HapticChannels::kRecords : kTicksToRecord) {}

Result<std::unique_ptr<LiveSession>> LiveSession::create(const SculptOptions& options, const SessionWall& wall,
                                                         Clock& clock) {
    auto session = std::unique_ptr<LiveSession>(new LiveSession(clock, options));
    if (const auto loaded = session->load(options, wall); !loaded) return std::unexpected(loaded.error());
    if (const auto taken = session->take_up_tool(options); !taken) return std::unexpected(taken.error());
    return session;
}

Result<void> LiveSession::load(const SculptOptions& options, const SessionWall& wall) {
    Result<LoadedWorkpiece> workpiece = load_workpiece(options.workpiece, pool_);
    if (!workpiece) return std::unexpected(workpiece.error());
    room_ = room_of(workpiece->solid.lattice, wall);
    Result<ChosenEngine> chosen = choose_engine(options.engine, std::move(workpiece->solid), pool_);
    if (!chosen) return std::unexpected(chosen.error());
    carving_ = std::make_unique<Carving>(std::move(chosen->engine), pool_);
    screenshot_folder_ = options.live.screenshots;
    workpiece_name_ = std::filesystem::path(options.workpiece.source).filename().string() + ", " +
                      std::to_string(options.workpiece.resolution) + " cells";
    return {};
}

Result<void> LiveSession::take_up_tool(const SculptOptions& options) {
    OutputSettings output = room_.wall.screens[room_.wall.main].shown;
    output.swap_eyes = output.swap_eyes != options.live.swap_eyes;
    if (!options.live.stereo.empty()) {
        const auto mode = parse_stereo_mode(options.live.stereo);
        if (!mode) return std::unexpected(mode.error());
        output.mode = *mode;
    }
    if (const auto feel = parse_feel(options.feel); !feel) return std::unexpected(feel.error());
    state_ = begin_session(room_, options.tool, options.feel, output);
    const Result<UseTool> use = tool_of(state_);
    if (!use) return std::unexpected(use.error());

    start_ns_ = clock_.now_ns();
    HandTarget rest;
    rest.position_device_m = state_.desk.target_device_m;
    Result<SteeredHand> hand = SteeredHand::create(&steering_, rest);
    if (!hand) return std::unexpected(hand.error());
    omni_.emplace(std::move(*hand), OmniModel{}, &clock_);
    loop_.emplace(*omni_, clock_, channels_);
    publish_parameters();
    // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms.
    const double reach_m = 0.012 * parameters_of(state_, room_).workspace.object_from_device.scale +
                           2.0 * carving_->surface().lattice().spacing_m;
    desk_.emplace(*carving_, channels_, pool_, use->tool, use->hardness_Ns_per_m3, reach_m,
                  options.undo_memory_MiB << 20);
    desk_->order(*use);
    desk_->start_at(inverse(state_.world_from_object) * (state_.world_from_device * rest.position_device_m));
    return desk_->update(start_ns_);
}

void LiveSession::publish_parameters() {
    TickParameters& parameters = channels_.parameters.draft();
    parameters = parameters_of(state_, room_);
    parameters.sequence = ++parameter_sequence_;
    channels_.parameters.publish();
}

void LiveSession::step(const FrameInput& input, const OutputPlace& output, const ToolState& tool, const Carve& carve) {
    if (output.size.width > 0 && output.size.height > 0) output_ = output;  // minimised: as it was
    fit_desk_screen(room_.wall, main_eye());
    tool_ = tool;
    times_.sampled(start_ns_ + head_sampled_ns(input), tool_.time_ns);
    const double dt_s = seconds(std::max<Nanoseconds>(input.time_ns - last_step_ns_, 0));
    last_step_ns_ = input.time_ns;
    const Captured captured = feed_panel(input);
    SessionStep step = step_session(state_, room_, input.events, {dt_s, input.display_ns, main_eye(), tool_, captured});
    state_ = std::move(step.state);
    for (const CommandInput& action : panel_actions_) {
        if (const auto done = run_command(state_, step.orders, action); !done)
            step.orders.messages.push_back(done.error().line());
    }
    fit_desk_screen(room_.wall, main_eye());  // the mode may be another
    SteeredTarget& hand = steering_.draft();
    hand = {++hand_sequence_, input.time_ns, step.hand.position_device_m, step.hand.orientation_device,
            step.hand.buttons};
    steering_.publish();
    if (step.orders.parameters) publish_parameters();
    for (CarvingOrder& order : step.orders.carving) carve(std::move(order));
    if (const auto lamp = other_lamp()) carve(LightFrom{*lamp});
    for (const std::string& message : step.orders.messages) say(message);
    for (std::string& name : step.orders.screenshots) screenshots_.push_back(std::move(name));
    exchange_full_screen_ = exchange_full_screen_ || step.orders.full_screen;
    watch_comfort();
    watch_tracker(input.time_ns);
}

// Said once when it begins: a message a frame would help nobody.
void LiveSession::watch_comfort() {
    if (needs_of(state_.output.mode).one_eye_point) return;
    const ComfortFinding finding = comfort_of(state_, room_, tool_);
    const bool strains = finding.crossed_too_much || finding.uncrossed_too_much;
    if (strains && !strained_) say(warning_of(finding, room_.wall.setup.budget));
    strained_ = strains;
}

void LiveSession::watch_tracker(Nanoseconds time_ns) {
    if (!state_.head.tracked) return;
    const HeadSettings settings = head_settings(room_.wall.setup);
    const TrackerState before = tracker_.state;
    tracker_ = report(settings, state_.head.track, time_ns);
    if (tracker_.state == before) return;
    if (tracker_.state == TrackerState::ok) {
        if (before != TrackerState::waiting) say("the tracker sees the head again");
    } else if (before == TrackerState::ok || before == TrackerState::waiting) {
        say("head tracker: " + tracker_.cause);  // what comes of it until it is well again is no news
    }
}

// The lamp hangs in the room: a workpiece that turns is lit from elsewhere. While it turns its shadows follow in steps.
std::optional<Lamp> LiveSession::other_lamp() {
    const Vec3 direction = inverse(state_.world_from_object.orientation) * direction_to_light();
    const bool turning = state_.desk.drag.has_value();
    const double change = glm::length(direction - lamp_direction_object_);
    if (change <= (turning ? kShadowsFollow : 1e-9)) return std::nullopt;
    lamp_direction_object_ = direction;
    return Lamp{direction, kLightHalfAngleTangent};
}

void LiveSession::take(SurfaceNews news) {
    for (const std::string& message : news.messages) say(message);
    undoable_ = news.undoable;
    redoable_ = news.redoable;
    times_.cut(news.cut_ns);
    export_progress_ = news.export_progress;
    news_.push_back(std::move(news));
}

void LiveSession::say(const std::string& message) {
    message_ = message;
    std::fprintf(stderr, "burin: %s\n", message.c_str());
}

void LiveSession::hear(const std::string& message) {
    if (!follows_recording_) message_ = message;
    std::fprintf(stderr, "burin: %s\n", message.c_str());
    outside_.heard.push_back(message);
}

void LiveSession::hear_again(std::span<const std::string> recorded) {
    follows_recording_ = true;
    if (!recorded.empty()) message_ = recorded.back();
}

void LiveSession::give_news(std::span<SessionPicture* const> pictures) {
    for (const SurfaceNews& news : news_)
        for (SessionPicture* picture : pictures) picture->take(news, carving_->surface().lattice().origin_object);
    news_.clear();
}

Result<void> LiveSession::draw(gpu::Commands& commands, std::size_t screen, SessionPicture& picture, ImageSize size) {
    const auto scene = scene_of(state_, room_, screen, carving_->surface().lattice().origin_object, tool_);
    if (const auto painted = paint_panel(commands, screen, picture); !painted) return painted;
    picture.draw_in_full(wants_screenshots());
    if (const auto drawn = picture.draw(commands, scene, size, output_on(screen)); !drawn) return drawn;
    if (screen == room_.wall.main) render_stats_ = picture.stats();
    return {};
}

void LiveSession::refuse_mode(StereoMode working, const Error& error) {
    state_.output.mode = working;
    outside_.refused = working;
    hear(error.line());
}

std::vector<std::filesystem::path> LiveSession::take_screenshots() {
    std::vector<std::filesystem::path> paths;
    for (const std::string& name : std::exchange(screenshots_, {}))
        paths.push_back(std::filesystem::path(screenshot_folder_) / name);
    return paths;
}

}  // namespace burin
