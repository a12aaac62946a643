// SPDX-License-Identifier: MIT
// Opens a session: workpiece, world, tool, hands and the scene that they touch.
#include <cstdio>
#include <filesystem>

#include "base/text.hpp"
#include "sculpt/workpiece.hpp"
#include "session/live/live_session.hpp"
#include "session/live/opened_room.hpp"
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

Vec3 across(const wall::Screen& screen) { return screen.lower_right_world - screen.lower_left_world; }

// The share of a desktop window's picture beside the panel, in the mode that the session begins with.
double free_width_at_first(const LiveOptions& live, const Room& room) {
    if (!room.wall.desk || room.wall.has_panel_window()) return 1.0;
    const auto mode = live.stereo.empty() ? wall::StereoMode::mono
                                          : wall::parse_stereo_mode(live.stereo).value_or(wall::StereoMode::mono);
    const ImageSize size{static_cast<std::uint32_t>(live.width), static_cast<std::uint32_t>(live.height)};
    return beside_panel(room, wall::eye_size(mode, size), size);
}

}  // namespace

LiveSession::LiveSession(Clock& clock, const SculptOptions& options, double pace)
    : clock_(clock),
      pool_(options.threads),
      hands_(ring_for(options.live.record), pace),
      activity_(options.activity),
      files_(options, log_) {}

Result<std::unique_ptr<LiveSession>> LiveSession::create(const SculptOptions& options, const SessionWall& wall,
                                                         Clock& clock, double pace) {
    auto session = std::unique_ptr<LiveSession>(new LiveSession(clock, options, pace));
    if (const auto loaded = session->load(options, wall); !loaded) return std::unexpected(loaded.error());
    if (const auto taken = session->take_up_tool(options); !taken) return std::unexpected(taken.error());
    return session;
}

Result<void> LiveSession::load(const SculptOptions& options, const SessionWall& wall) {
    Result<OpenedRoom> opened = open_room(options, wall);
    if (!opened) return std::unexpected(opened.error());
    room_ = std::move(opened->room);
    room_.panel_scale = options.live.panel_scale.value_or(1.0);
    room_.first_steps = options.live.first_steps;
    room_.free_width = free_width_at_first(options.live, room_);
    // Before the middle of what the panel leaves free, so that nothing there is seen aslant.
    if (room_.wall.desk && room_.mouse == MouseMode::surface)
        room_.desk.home_head_world.position_m -= 0.5 * (1.0 - room_.free_width) * across(room_.screen());
    hands_.use(std::move(opened->handles));
    const bool has_world = options.scene || !options.world.empty();
    if (!options.no_workpiece || !has_world)
        if (const auto loaded = load_workpiece(options); !loaded) return loaded;
    if (has_world)
        if (const auto loaded = load_world(options); !loaded) return loaded;
    const double longest_side_m = sculpt::longest_side_m(room_.workpiece_object);
    tool_options_ = options.tool;
    const bool carves = scene_.workpiece() != nullptr;
    if (!carves && tool_options_.shape.empty())
        tool_options_.shape = formatted("ball:%.2g", kExploringBall * longest_side_m);
    tool_options_ = sculpt::with_tool(tool_options_, longest_side_m);
    if (!options.from_before_units) tool_sizes_ = tool_sizes_for(longest_side_m);
    misfit_.begin(options.from_before_units || !carves);
    return {};
}

Result<void> LiveSession::load_workpiece(const SculptOptions& options) {
    Result<sculpt::LoadedWorkpiece> workpiece = sculpt::load_workpiece(options.workpiece, pool_);
    if (!workpiece) return std::unexpected(workpiece.error());
    std::fprintf(stderr, "burin: %s\n", workpiece->size.c_str());
    if (!workpiece->closed.empty()) notify(workpiece->closed);
    unit_ = workpiece->unit;
    holes_closed_ = !workpiece->closed.empty();
    room_.workpiece_object = workpiece->bounds_object;
    room_.carved_object = room_.workpiece_object;
    room_.lattice_object = sculpt::lattice_bounds(workpiece->solid.lattice);
    Result<sculpt::ChosenEngine> chosen = sculpt::choose_engine(options.engine, std::move(workpiece->solid), pool_);
    if (!chosen) return std::unexpected(chosen.error());
    scene_.take(std::make_unique<sculpt::Sculpture>(std::move(chosen->engine), pool_));
    seen_ = SeenSurface(scene_.workpiece()->surface().lattice());
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
    const Box seen = (*made)->drawn().bounds_scene();
    scene_.take(std::move(*made));
    Box& all = room_.workpiece_object;
    if (!seen.empty()) {
        all.include(seen.lo);
        all.include(seen.hi);
    }
    if (all.empty()) all = {Vec3(-0.05), Vec3(0.05)};  // of a world in which nothing is seen
    room_.covers_depth = true;
    const std::string objects = std::to_string(count) + (count == 1 ? " object" : " objects");
    if (scene_.workpiece() == nullptr)
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
    state_ = begin_session(room_, *tool, *feel, output, std::move(meshes), hands_.handles(), names);
    state_.export_unit = options.export_units.value_or(unit_);
    state_.carves = scene_.workpiece() != nullptr;
    state_.mirror = options.mirror;
    if (scene_.world() != nullptr) state_.world = scene_.world()->objects();
    const Result<sculpt::UseTool> use = tool_of(state_);
    if (!use) return std::unexpected(use.error());
    watch_misfit(use->tool);

    start_ns_ = clock_.now_ns();
    if (const auto opened = hands_.open(options.live, state_, room_, clock_); !opened) return opened;
    tools_.resize(hands().parts());
    publish_parameters();
    const auto begun =
        scene_.begin(*use, options.undo_memory_MiB << 20, hands_.beginnings(state_, room_, scene_.spacing_m()),
                     activity_.scene_part(), activity_.tap(), start_ns_);
    if (begun && scene_.carved() != nullptr) scene_.carved()->order(sculpt::MirrorStrokes{state_.mirror});
    return begun;
}

SculptOptions LiveSession::settled(SculptOptions options) const {
    options.workpiece.units = unit_;
    options.workpiece.close_holes = options.workpiece.close_holes || holes_closed_;
    options.tool = tool_options_;
    return options;
}

}  // namespace burin::session
