// SPDX-License-Identifier: MIT
#include "session/live/live_session.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "base/text.hpp"
#include "devices/haptic/wand_choice.hpp"
#include "renderer/png.hpp"
#include "sculpt/workpiece.hpp"
#include "session/record/input_files.hpp"
#include "session/record/session_recording.hpp"
#include "session/state/governed.hpp"

namespace burin::session {
namespace {

// Ticks that the recording's ring holds. A text log's is read by the frame's thread, which may stall for so many; a
// session file's by its writer, which waits for the disk.
constexpr std::size_t kTicksToLog = 8192;
// The stylus' second button takes hold of an object.
constexpr std::uint32_t kGrips = 2;

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

// Has the desk steer a wand: upright where it rests, over a workspace of its own size.
void use_wand(HandRoom& room, const devices::WandDescription& wand) {
    constexpr double kDepthPerWheelStep = 0.025;  // of the workspace's longest side, about as a stylus'
    room.workspace_device_m = devices::device_of(wand).workspace_m;
    room.desk.workspace_m = room.workspace_device_m;
    room.desk.depth_per_wheel_step_m =
        kDepthPerWheelStep * sculpt::longest_side_m({Vec3(0.0), room.workspace_device_m});
    room.desk.rest_device = {1.0, 0.0, 0.0, 0.0};
    room.desk.leans_sideways = true;
}

// Returns the devices of all hands: one without a name where there is one.
std::vector<NamedDevice> hands_wanted(const LiveOptions& live) {
    return live.hands.empty() ? std::vector<NamedDevice>{{"", live.device}} : live.hands;
}

// Says on the terminal where a file lies, if the message does not, and that another one was there.
std::string where_it_lies(const std::string& message, const std::string& path, bool replaced) {
    const std::string place = message.ends_with(" " + path) ? "" : path;
    const std::string instead = replaced ? "in place of the file that was there" : "";
    if (place.empty() && instead.empty()) return {};
    return " (" + place + (place.empty() || instead.empty() ? "" : ", ") + instead + ")";
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
    if (const auto held = hold_wands(options); !held) return held;
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

// Fits the room to the devices of all hands, and makes the wands ready whose points touch.
Result<void> LiveSession::hold_wands(const SculptOptions& options) {
    const std::vector<NamedDevice> hands = hands_wanted(options.live);
    room_.others.assign(hands.size() - 1, room_);
    wands_.assign(hands.size(), nullptr);
    for (std::size_t i = 0; i < hands.size(); ++i) {
        HandRoom& room = i == 0 ? room_ : room_.others[i - 1];
        if (devices::parts_of_device(hands[i].device) > 1) {  // a hand, which is held upright and not as a pen is
            room.desk.rest_device = {1.0, 0.0, 0.0, 0.0};
            room.desk.leans_sideways = true;
        }
        if (!devices::is_wand(hands[i].device)) continue;
        Result<devices::WandDescription> wand = devices::wand_named(hands[i].device);
        if (!wand) return std::unexpected(wand.error());
        use_wand(room, *wand);
        if (options.points.empty()) continue;
        Result<std::vector<devices::WandPoint>> points = devices::points_named(*wand, options.points);
        if (!points) return std::unexpected(points.error());
        wands_[i] = std::make_shared<const HeldWand>(std::move(*wand), std::move(*points));
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
    state_ = begin_session(room_, *tool, *feel, output, std::move(meshes), wands_, names);
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
    for (const NamedDevice& hand : hands_wanted(options.live)) {
        const std::size_t i = wanted.size();
        const Vec3& rest_device_m =
            i == state_.hand ? state_.desk.target_device_m : state_.hands[i].target.position_device_m;
        wanted.push_back({hand.hand, hand.device, {rest_device_m, room_.of(i).desk.rest_device}});
    }
    if (const auto opened = hands_.open(wanted, clock_); !opened) return opened;
    tools_.resize(hands_.parts());
    return {};
}

// Returns where a hand's tool is before the first tick.
Vec3 LiveSession::place_at_rest(std::size_t hand) const {
    const Vec3& rest_device_m =
        hand == state_.hand ? state_.desk.target_device_m : state_.hands[hand].target.position_device_m;
    const Vec3 first_device_m = wands_[hand]
                                    ? wands_[hand]->first_point_device({rest_device_m, room_.of(hand).desk.rest_device})
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
        // ends of a wand are swung as well, at 6 rad/s.
        const double scale = parameters_of(state_, room_, hand).workspace.object_from_device.scale;
        const double reach_m = (wands_[hand] ? 0.02 : 0.012) * scale + 2.0 * spacing_m();
        if (part == hands_.first_part(hand)) spreads_m_.push_back(spread_of(hand));
        touched.push_back(
            {&hands_.channels(part), place_at_rest(hand), tools_around_m_[hand] + spreads_m_[hand], reach_m});
    }
    scene_.emplace(std::move(parts), std::move(touched));
    news_.report_of(carved_ ? &*carved_ : nullptr, world_ ? &world_->part() : nullptr,
                    world_ ? &world_->materials() : nullptr, activity_.tap());
    return scene_->update(start_ns_);
}

// ---- One step

void LiveSession::step(const FrameInput& input, const wall::OutputPlace& output,
                       std::span<const haptics::ToolState> tools, const Give& give, ImageSize panel_output) {
    // Each keeps its last size while it is minimised.
    if (!is_empty(output.size)) output_ = output;
    if (!is_empty(panel_output)) panel_output_ = panel_output;
    fit_desk_screen(room_.wall, main_eye());
    tools_.assign(tools.begin(), tools.end());
    std::vector<haptics::ToolState> of_hands;  // by the first part of each
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) of_hands.push_back(tools_[hands_.first_part(hand)]);
    const haptics::ToolState tool = tool_in_use();
    times_.sampled(start_ns_ + head_sampled_ns(input), tool.time_ns);
    const double dt_s = seconds(std::max<Nanoseconds>(input.time_ns - last_step_ns_, 0));
    last_step_ns_ = input.time_ns;
    if (!input.events.empty()) last_line_ = input.events.back().line;
    const SceneInput left = feed_panel(input);
    const auto before = activity_.governs() ? std::optional(state_) : std::nullopt;
    SessionStep step =
        step_session(state_, room_, left.events, {dt_s, input.display_ns, main_eye(), tool, left.captured, of_hands});
    state_ = std::move(step.state);
    step.orders.line = input.events.empty() ? 0 : input.events.back().line;
    for (const CommandInput& action : panel_.actions()) {
        if (const auto done = run_command(state_, step.orders, action); !done)
            step.orders.messages.push_back({done.error().line()});
    }
    if (before) hold_governed(*before, step.orders);
    activity_.step(state_, step.orders, input.time_ns, tool_in_use());
    news_.frames_for_ticks(activity_.is_running());
    fit_desk_screen(room_.wall, main_eye());  // a command may have changed the mode
    hands_.move_hand(step.led_hand, step.hand_way, input.time_ns, step.hand);
    carry_out(std::move(step.orders), give);
    watch(input.time_ns);
}

// A hand that goes on turning the scene is told once that it stays.
void LiveSession::hold_governed(const SessionState& before, SessionOrders& orders) {
    const std::size_t told = orders.messages.size();
    keep_governed(before, state_, orders);
    if (orders.messages.size() > told && orders.line == 0 && log_.newest() == kGovernedMessage)
        orders.messages.pop_back();
}

SceneInput LiveSession::feed_panel(const FrameInput& input) {
    auto left = panel_.feed(input,
                            {.state = state_,
                             .room = room_,
                             .tool = tool_in_use(),
                             .hands = hands_,
                             .tools = tools_,
                             .tracker = tracker_.report(),
                             .workpiece = workpiece_,
                             .tool_sizes = tool_sizes_,
                             .undoable = undoable_,
                             .redoable = redoable_,
                             .exporting = exporting_,
                             .activity = activity_.panel(),
                             .times = times_,
                             .tick_duration = hands_.loop().duration(),
                             .shown = output_on(room_.wall.main),
                             .output = output_,
                             .panel_output = panel_output_,
                             .acknowledged = acknowledged_,
                             .recording_ended = recording_ended_},
                            log_);
    for (const std::string& line : times_.take_new_warnings()) std::fprintf(stderr, "burin: %s\n", line.c_str());
    if (left) return std::move(*left);
    notify(left.error().line());
    state_.panel = false;
    return {{input.events.begin(), input.events.end()}, {}};
}

// A tool is the one of the hand in use.
scene::SceneThread::Order LiveSession::carving(sculpt::SculptOrder order) {
    return [this, order = std::move(order), hand = state_.hand, spread_m = spreads_m_[state_.hand]] {
        const std::size_t first = hands_.first_part(hand), parts = hands_.parts_of(hand);
        const auto* use = std::get_if<sculpt::UseTool>(&order);
        if (carved_ && use == nullptr) carved_->order(order);
        if (use == nullptr) return;
        for (std::size_t part = first; carved_ && part < first + parts; ++part) carved_->order(*use, part);
        tools_around_m_[hand] = carved_ ? carved_->around_m(first) : sculpt::around_m(use->tool);
        for (std::size_t part = first; part < first + parts; ++part) {
            scene_->use_probe(part, tools_around_m_[hand] + spread_m);
            if (world_) world_->part().grip_with(part, kGrips, tools_around_m_[hand]);
        }
    };
}

// How far a wand's points are from the first of them, in the scene as large as it is shown now.
double LiveSession::spread_of(std::size_t hand) const {
    return wands_[hand]
               ? wands_[hand]->spread_m() * parameters_of(state_, room_, hand).workspace.object_from_device.scale
               : 0.0;
}

// The scene has been scaled, or the motion: what is known around the first point has to reach the others.
void LiveSession::follow_spread(const Give& give) {
    for (std::size_t hand = 0; hand < hands_.hands(); ++hand) {
        const double spread_m = spread_of(hand);
        if (spread_m == spreads_m_[hand]) continue;
        spreads_m_[hand] = spread_m;
        give([this, hand, spread_m] {
            scene_->use_probe(hands_.first_part(hand), tools_around_m_[hand] + spread_m);  // a wand has one part
        });
    }
}

scene::SceneThread::Order LiveSession::editing(WorldOrder order) {
    return [this, order = std::move(order)] {
        if (const auto done = world_->part().edit(order.object, order.edit); !done) news_.notify(done.error().line());
    };
}

void LiveSession::publish_parameters() {
    for (std::size_t part = 0; part < hands_.parts(); ++part) {
        const std::size_t hand = hands_.part_of_hand(part).hand;
        haptics::TickParameters parameters = parameters_of(state_, room_, hand);
        // An activity guides the hand that it is told of.
        if (part == 0) activity_.adjust(parameters);
        hands_.publish(part, std::move(parameters));
    }
}

// What the device answers comes from outside the session: a replay has it from the recording, and the ticks with it.
void LiveSession::switch_amplifiers(const AskedAmplifiers& asked) {
    if (log_.follows_recording()) return;
    const std::optional<devices::AmplifierAnswer> answer = hands_.switch_amplifiers(state_.hand, asked.on);
    if (answer == devices::AmplifierAnswer::done)
        return log_.notify_of_event(asked.on ? "the amplifiers are on; the force comes back from zero"
                                             : "the amplifiers are off: no force until they are enabled again");
    const std::string why = answer ? "they stay off, since what tripped them is not over; see to the device first"
                                   : "those of " + std::string(hands_.device(hands_.first_part(state_.hand)).name) +
                                         " cannot be switched from here";
    log_.notify_of_event("amplifiers: " + why, {failed_on(asked.line), {}});
}

void LiveSession::carry_out(SessionOrders orders, const Give& give) {
    for (const AskedAmplifiers& asked : orders.amplifiers) switch_amplifiers(asked);
    if (orders.parameters) publish_parameters();
    if (orders.parameters) follow_spread(give);
    for (sculpt::SculptOrder& order : orders.carving) {
        if (const auto* use = std::get_if<sculpt::UseTool>(&order)) warn_of_misfit(use->tool);
        auto* wanted = std::get_if<sculpt::ExportSurface>(&order);
        if (wanted != nullptr && !outputs_.write()) continue;
        if (wanted != nullptr) place(*wanted);
        give(carving(std::move(order)));
    }
    for (WorldOrder& order : orders.world) give(editing(std::move(order)));
    if (const auto lamp = carving_ ? lamp_.look(state_) : std::nullopt) give(carving(sculpt::LightFrom{*lamp}));
    for (const Asked& message : orders.messages) {
        if (message.line == 0) {
            notify(message.text);
        } else {
            log_.notify(message.text, {failed_on(message.line), {}});
        }
    }
    if (outputs_.write()) std::ranges::move(orders.screenshots, std::back_inserter(screenshots_));
    exchange_full_screen_ = exchange_full_screen_ || orders.full_screen;
}

// Says once, until tool and workpiece suit one another again, that they do not.
void LiveSession::warn_of_misfit(const sculpt::Tool& tool) {
    if (!warns_of_misfit_) return;
    const auto misfit = sculpt::misfit(state_.tool, tool, sculpt::longest_side_m(room_.workpiece_object), spacing_m());
    if (misfit && !misfits_) notify(*misfit);
    misfits_ = misfit.has_value();
}

SculptOptions LiveSession::settled(SculptOptions options) const {
    options.workpiece.units = unit_;
    options.tool = tool_options_;
    return options;
}

void LiveSession::watch(Nanoseconds time_ns) {
    if (const auto strain = comfort_.look(state_, room_, tool_in_use())) notify(*strain);
    if (const auto change = tracker_.look(state_, room_, time_ns)) notify(*change);
}

void LiveSession::take_loaded() {
    if (!carved_) return;
    if (auto loaded = carved_->take_surface_update()) take(std::move(*loaded));
}

void LiveSession::take_news(std::uint64_t updates) {
    SceneNews::Taken news = news_.take(updates);
    if (news.surface) take(std::move(*news.surface));
    for (const std::string& message : news.messages) notify(message);
    activity_.take(std::move(news.ticks));
    if (!world_) return;
    world_->drawn().take(news.objects);
    state_.world = followed(std::move(state_.world), news.objects, news.materials ? &*news.materials : nullptr);
    if (news.materials) publish_parameters();
}

Vec3 LiveSession::lattice_origin_object() const {
    return carving_ ? carving_->surface().lattice().origin_object : Vec3(0.0);
}

std::optional<renderer::Scene> LiveSession::scene_on(std::size_t screen) const {
    if (room_.wall.is_panel(screen)) return std::nullopt;
    std::optional<renderer::Scene> scene = scene_of(state_, room_, screen, lattice_origin_object(), tool_in_use());
    for (std::size_t part = 0; scene && part < hands_.parts(); ++part)
        if (part != hands_.first_part(state_.hand))
            add_tool(*scene, state_, hands_.part_of_hand(part).hand, tools_[part]);
    if (scene && world_)
        std::ranges::move(world_->drawn().in_world(state_.world_from_object), std::back_inserter(scene->objects));
    if (scene) activity_.stage(*scene, screen);
    return scene;
}

void LiveSession::finish_scene() {
    scene_->finish();
    collect({});
    take_news(UINT64_MAX);
    // What the activity orders now has nobody to carry it out, but for its words.
    SessionOrders orders;
    activity_.step(state_, orders, last_step_ns_, tool_in_use());
    for (const Asked& message : orders.messages) notify(message.text);
    if (const auto done = activity_.finish(); !done) notify_of_loss(done.error().line());
}

void LiveSession::take(sculpt::SurfaceUpdate news) {
    for (const std::string& message : news.messages) notify(message);
    for (const sculpt::ExportOutcome& ended : news.exports) take(ended);
    undoable_ = news.undoable;
    redoable_ = news.redoable;
    exporting_ = news.exporting;
    times_.cut(news.cut_ns);
    updates_.push_back(std::move(news));
}

// ---- Files

// A refused export is ordered as well, since a recording counts the orders.
void LiveSession::place(sculpt::ExportSurface& wanted) const {
    const auto placed = outputs_.place_of(wanted.path, OutputKind::mesh);
    if (!placed) {
        wanted.refused = placed.error();
        return;
    }
    wanted.name = outputs_.shown(wanted.path, *placed);
    wanted.path = placed->string();
}

void LiveSession::take(const sculpt::ExportOutcome& ended) {
    if (ended.written) {
        log_.notify(ended.message, {{}, where_it_lies(ended.message, ended.path, ended.replaced)});
    } else if (outputs_.refuse_meshes()) {
        log_.notify(ended.message);
    } else {
        log_.notify(ended.message, {failed_on(ended.asked_by), {}});
    }
}

void LiveSession::keep_screenshot(const Asked& wanted, const Result<Image>& image) {
    const auto place = image ? outputs_.place_of(wanted.text, OutputKind::picture) : std::unexpected(image.error());
    std::error_code ignored;
    const bool was_there = place && std::filesystem::exists(*place, ignored);
    const auto written = place ? renderer::write_png(*place, *image) : std::unexpected(place.error());
    if (written) {
        const std::string message = "wrote " + outputs_.shown(wanted.text, *place);
        log_.notify_of_event(message, {{}, where_it_lies(message, place->string(), was_there)});
    } else {
        log_.notify_of_event(written.error().line(), {failed_on(wanted.line), {}});
    }
}

std::string LiveSession::failed_on(std::size_t line) {
    if (log_name_.empty()) return {};
    ++failures_;
    return line == 0 ? log_name_ + ": " : log_name_ + ":" + std::to_string(line) + ": ";
}

void LiveSession::notify_of_loss(const std::string& message) {
    const std::string where = failed_on(last_line_);
    if (where.empty()) ++failures_;
    log_.notify(message, {where, {}});
}

Result<void> LiveSession::outcome() const {
    if (failures_ == 0) return {};
    return fail(log_name_.empty() ? "the session" : log_name_,
                failures_ == 1 ? "one thing that was asked for is missing"
                               : std::to_string(failures_) + " things that were asked for are missing",
                "see above what, and why");
}

void LiveSession::refuse_mode(wall::StereoMode working, const Error& error) {
    state_.output.mode = working;
    refused_ = working;
    notify_of_event(error.line());
}

}  // namespace burin::session
