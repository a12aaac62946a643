// SPDX-License-Identifier: MIT
// Opens a session: workpiece, world, tool, hands and the scene that they touch.
#include <cstdio>
#include <filesystem>

#include "base/text.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "devices/registry/device_registry.hpp"
#include "sculpt/workpiece.hpp"
#include "session/live/live_session.hpp"
#include "session/record/input_files.hpp"
#include "session/record/session_recording.hpp"

namespace burin::session {
namespace {

// Ticks that the recording's ring holds. A text log's is read by the frame's thread, which may stall for so many; a
// session file's by its writer, which waits for the disk.
constexpr std::size_t kTicksToLog = 8192;

// The ball that explores a world where no tool is given: its radius as a share of the world's longest side.
constexpr double kExploringBall = 0.015;

std::size_t ring_for(const std::string& recording) {
    if (recording.empty()) return haptics::HapticChannels::kRecords;
    return is_session_file(recording) ? record::kRingTicks : kTicksToLog;
}

Room room_of(const SessionWall& wall) {
    Room room;
    room.wall = wall;
    const Pose fallback = wall.setup.fallback_head_tracker;
    room.desk.home_head_world = {wall.setup.world_from_tracker * fallback.position_m,
                                 wall.setup.world_from_tracker.orientation * fallback.orientation};
    if (wall.desk) room.desk.head_world = {{-2.0, 0.4, 0.3}, {2.0, 2.4, 6.0}};
    return room;
}

// Has the desk steer a handle over a workspace of its own size.
void steer_over(HandRoom& room, const Vec3& workspace_device_m) {
    constexpr double kDepthPerWheelStep = 0.025;  // of the workspace's longest side, about as a stylus'
    room.workspace_device_m = room.desk.workspace_m = workspace_device_m;
    room.desk.depth_per_wheel_step_m = kDepthPerWheelStep * sculpt::longest_side_m({Vec3(0.0), workspace_device_m});
}

}  // namespace

LiveSession::LiveSession(Clock& clock, const SculptOptions& options, double pace)
    : clock_(clock),
      pool_(options.threads),
      hands_(ring_for(options.live.record), pace, options.activity != nullptr),
      activity_(options.activity),
      outputs_(options.live, inputs_of(options).list()),
      log_name_(options.live.input) {}

Result<std::unique_ptr<LiveSession>> LiveSession::create(const SculptOptions& options, const SessionWall& wall,
                                                         Clock& clock, double pace) {
    auto session = std::unique_ptr<LiveSession>(new LiveSession(clock, options, pace));
    if (const auto loaded = session->load(options, wall); !loaded) return std::unexpected(loaded.error());
    if (const auto taken = session->take_up_tool(options); !taken) return std::unexpected(taken.error());
    return session;
}

Result<void> LiveSession::load(const SculptOptions& options, const SessionWall& wall) {
    room_ = room_of(wall);
    if (const auto held = hold_handles(options); !held) return held;
    const bool has_world = options.scene || !options.world.empty();
    if (!options.no_workpiece || !has_world)
        if (const auto loaded = load_workpiece(options); !loaded) return loaded;
    if (has_world)
        if (const auto loaded = load_world(options); !loaded) return loaded;
    const double longest_side_m = sculpt::longest_side_m(room_.workpiece_object);
    tool_options_ = options.tool;
    if (!carving_ && tool_options_.shape.empty())
        tool_options_.shape = formatted("ball:%.2g", kExploringBall * longest_side_m);
    tool_options_ = sculpt::with_tool(tool_options_, longest_side_m);
    if (!options.from_before_units) tool_sizes_ = tool_sizes_for(longest_side_m);
    warns_of_misfit_ = !options.from_before_units && carving_;
    return {};
}

// Fits the room to the devices of all hands, and makes the handles ready whose points touch.
Result<void> LiveSession::hold_handles(const SculptOptions& options) {
    const std::vector<NamedDevice> hands = devices_of(options.live);
    room_.others.assign(hands.size() - 1, room_);
    handles_.assign(hands.size(), nullptr);
    for (std::size_t i = 0; i < hands.size(); ++i) {
        HandRoom& room = i == 0 ? room_ : room_.others[i - 1];
        Result<devices::DeviceNature> nature = devices::nature_of_device(hands[i].device);
        if (!nature) return std::unexpected(of_hand(hands[i].hand, nature.error()));
        if (nature->is_upright) {
            room.desk.rest_device = {1.0, 0.0, 0.0, 0.0};
            room.desk.leans_sideways = true;
        }
        if (!nature->handle) continue;
        steer_over(room, devices::device_of(*nature->handle).workspace_m);
        if (options.points.empty()) continue;
        auto points = devices::points_named(*nature->handle, options.points);
        if (!points) return std::unexpected(points.error());
        handles_[i] = std::make_shared<const HeldHandle>(std::move(*nature->handle), std::move(*points));
    }
    return {};
}

Result<void> LiveSession::load_workpiece(const SculptOptions& options) {
    Result<sculpt::LoadedWorkpiece> workpiece = sculpt::load_workpiece(options.workpiece, pool_);
    if (!workpiece) return std::unexpected(workpiece.error());
    std::fprintf(stderr, "burin: %s\n", workpiece->size.c_str());
    unit_ = workpiece->unit;
    room_.workpiece_object = sculpt::workpiece_bounds(workpiece->solid.lattice);
    Result<sculpt::ChosenEngine> chosen = sculpt::choose_engine(options.engine, std::move(workpiece->solid), pool_);
    if (!chosen) return std::unexpected(chosen.error());
    carving_ = std::make_unique<sculpt::Sculpture>(std::move(chosen->engine), pool_);
    workpiece_ = {
        .name = std::filesystem::path(options.workpiece.source).filename().string(),
        .size = in_millimetres(workpiece->size_m) + ", " + std::to_string(options.workpiece.resolution) + " cells"};
    return {};
}

Result<void> LiveSession::load_world(const SculptOptions& options) {
    Result<scene::World> read = options.scene ? *options.scene : read_sound_world(options.world);
    if (!read) return std::unexpected(read.error());
    const std::size_t count = read->objects.size();
    Result<std::unique_ptr<WorldSide>> made = WorldSide::create(std::move(*read));
    if (!made) return std::unexpected(made.error());
    world_ = std::move(*made);
    const Box seen = world_->drawn().bounds_scene();
    Box& all = room_.workpiece_object;
    if (!seen.empty()) {
        all.include(seen.lo);
        all.include(seen.hi);
    }
    if (all.empty()) all = {Vec3(-0.05), Vec3(0.05)};  // of a world in which nothing is seen
    room_.covers_depth = true;
    const std::string objects = std::to_string(count) + (count == 1 ? " object" : " objects");
    if (!carving_)
        workpiece_ = {
            .name = options.scene ? options.scene->name : std::filesystem::path(options.world).filename().string(),
            .size = in_millimetres(all.extent()) + ", " + objects};
    return {};
}

Result<void> LiveSession::take_up_tool(const SculptOptions& options) {
    wall::OutputSettings output = room_.wall.screens[room_.wall.main].shown;
    output.swap_eyes = output.swap_eyes != options.live.swap_eyes;
    if (!options.live.stereo.empty()) {
        const auto mode = wall::parse_stereo_mode(options.live.stereo);
        if (!mode) return std::unexpected(mode.error());
        output.mode = *mode;
    }
    const auto tool = sculpt::parse_tool_settings(tool_options_);
    if (!tool) return std::unexpected(tool.error());
    auto meshes = std::make_shared<ToolMeshes>();
    if (const auto read = meshes->read(tool->shape); !read) return read;
    for (const sculpt::ToolSpec& other : options.live.tools_of_input)
        if (const auto read = meshes->read(other); !read) return read;
    const auto feel = sculpt::parse_feel_settings(options.feel);
    if (!feel) return std::unexpected(feel.error());
    std::vector<std::string> names;
    for (const NamedDevice& hand : options.live.hands) names.push_back(hand.hand);
    state_ = begin_session(room_, *tool, *feel, output, std::move(meshes), handles_, names);
    state_.export_unit = options.export_units.value_or(unit_);
    state_.carves = carving_ != nullptr;
    if (world_) state_.world = world_->objects();
    const Result<sculpt::UseTool> use = tool_of(state_);
    if (!use) return std::unexpected(use.error());
    warn_of_misfit(use->tool);

    start_ns_ = clock_.now_ns();
    if (const auto opened = open_hands(options); !opened) return opened;
    publish_parameters();
    return make_scene(*use, options.undo_memory_MiB << 20);
}

Result<void> LiveSession::open_hands(const SculptOptions& options) {
    std::vector<HandToOpen> wanted;
    for (const NamedDevice& hand : devices_of(options.live)) {
        const std::size_t i = wanted.size();
        const Vec3& rest_device_m =
            i == state_.hand ? state_.desk.target_device_m : state_.hands[i].target.position_device_m;
        wanted.push_back({hand.hand, hand.device, {rest_device_m, room_.of(i).desk.rest_device}});
    }
    if (const auto opened = hands_.open(wanted, clock_, options.live.stands_in); !opened) return opened;
    tools_.resize(hands_.parts());
    return {};
}

// Returns where a hand's tool is before the first tick.
Vec3 LiveSession::place_at_rest(std::size_t hand) const {
    const Vec3& rest_device_m =
        hand == state_.hand ? state_.desk.target_device_m : state_.hands[hand].target.position_device_m;
    const Vec3 first_device_m =
        handles_[hand] ? handles_[hand]->first_point_device({rest_device_m, room_.of(hand).desk.rest_device})
                       : rest_device_m;
    return inverse(state_.world_from_object) * (hand_of(state_, hand).world_from_device * first_device_m);
}

Result<void> LiveSession::make_scene(const sculpt::UseTool& use, std::size_t undo_bytes) {
    std::vector<scene::ScenePart*> parts;
    if (carving_) {
        carved_.emplace(*carving_, use.tool, use.hardness_Ns_per_m3, undo_bytes);
        for (std::size_t part = 0; part < hands_.parts(); ++part) carved_->order(use, part);
        parts.push_back(&*carved_);
    }
    tools_around_m_.assign(hands_.hands(), sculpt::around_m(use.tool));
    if (world_) {
        for (std::size_t part = 0; part < hands_.parts(); ++part)
            world_->part().grip_with(part, kGrips, tools_around_m_[hands_.part_of_hand(part).hand]);
        parts.push_back(&world_->part());
    }
    if (activity_.tap() != nullptr) parts.push_back(activity_.tap());
    std::vector<scene::SceneHand> touched;
    for (std::size_t part = 0; part < hands_.parts(); ++part) {
        const std::size_t hand = hands_.part_of_hand(part).hand;
        // Far enough for the fastest hand to stay inside the known ball until the next update: 1 m/s for 12 ms; the
        // ends of a handle are swung as well, at 6 rad/s.
        const double scale = parameters_of(state_, room_, hand).workspace.object_from_device.scale;
        const double reach_m = (handles_[hand] ? 0.02 : 0.012) * scale + 2.0 * spacing_m();
        if (part == hands_.first_part(hand)) spreads_m_.push_back(spread_of(hand));
        touched.push_back({&hands_.channels(part), place_at_rest(hand), tools_around_m_[hand] + spreads_m_[hand],
                           reach_m, hands_.part_of_hand(part)});
    }
    scene_.emplace(std::move(parts), std::move(touched));
    news_.report_of(carved_ ? &*carved_ : nullptr, world_ ? &world_->part() : nullptr,
                    world_ ? &world_->materials() : nullptr, activity_.tap());
    return scene_->update(start_ns_);
}

}  // namespace burin::session
