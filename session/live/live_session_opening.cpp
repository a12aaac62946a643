// SPDX-License-Identifier: MIT
// Opens a session: workpiece, world, tool, hands and the scene that they touch.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "scene/rendered_material.hpp"
#include "sculpt/crumbs.hpp"
#include "session/live/live_session.hpp"
#include "session/live/opened_room.hpp"
#include "session/record/session_recording.hpp"
#include "session/work/journal_folder.hpp"

namespace burin::session {
namespace {

// Ticks that the recording's ring holds. A text log's is read by the frame's thread, which may stall for so many; a
// session file's by its writer, which waits for the disk.
constexpr std::size_t kTicksToLog = 8192;

// The ball that explores a world where no tool is given: its radius as a share of the world's longest side.
constexpr double kExploringBall = 0.015;

std::size_t ring_for(const LiveOptions& live) {
    if (live.record.empty()) return live.lsl ? kTicksToLog : haptics::HapticChannels::kRecords;
    return is_session_file(live.record) ? record::kRingTicks : kTicksToLog;
}

}  // namespace

LiveSession::LiveSession(Clock& clock, const SculptOptions& options, double pace)
    : clock_(clock),
      hands_(ring_for(options.live), pace),
      activity_(options.activity),
      files_(options, log_),
      options_(options) {}

Result<std::unique_ptr<LiveSession>> LiveSession::create(const SculptOptions& options, const SessionWall& wall,
                                                         Clock& clock, double pace,
                                                         std::optional<sculpt::MadeWorkpiece> made) {
    auto session = std::unique_ptr<LiveSession>(new LiveSession(clock, options, pace));
    if (const auto loaded = session->load(options, wall, std::move(made)); !loaded)
        return std::unexpected(loaded.error());
    if (const auto taken = session->take_up_tool(options); !taken) return std::unexpected(taken.error());
    return session;
}

Result<void> LiveSession::load(const SculptOptions& options, const SessionWall& wall,
                               std::optional<sculpt::MadeWorkpiece> made) {
    Result<OpenedRoom> opened = open_room(options, wall);
    if (!opened) return std::unexpected(opened.error());
    room_ = std::move(opened->room);
    hands_.use(std::move(opened->handles));
    if (const auto opened_here = open_saved(options); !opened_here) return opened_here;
    if (has_workpiece(options))
        if (const auto taken = take_workpiece(options, std::move(made)); !taken) return taken;
    if (has_world(options))
        if (const auto loaded = load_world(options); !loaded) return loaded;
    if (options.scene == nullptr) {
        document_.began_with(has_workpiece(options) ? options.workpiece.source : options.world);
        if (document_of(options).empty()) opened_.kept = unsaved_work_in(options.live.journal);
    }
    for (const std::string& line : opened_.kept) notify_of_event(line);
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

// Opens the document that the session goes on with.
Result<void> LiveSession::open_saved(const SculptOptions& options) {
    const std::string path = document_of(options);
    if (path.empty() || options.scene != nullptr) return {};
    Result<OpenedWork> opened = open_document_and_journal(path, options.live.journal, options.undo_memory_MiB << 20);
    if (!opened) return std::unexpected(opened.error());
    opened_ = std::move(*opened);
    if (!opened_.lost.empty()) notify(opened_.lost, MessageKind::error);
    if (!opened_.recovered.empty()) notify_of_event(opened_.recovered, MessageKind::warning);
    document_.came_from(opened_.origin);
    // A log's session leaves the file that it began with as it is; so does one that has more than what is in there.
    const bool has_all =
        opened_.workpiece.has_value() == has_workpiece(options) && opened_.world.has_value() == has_world(options);
    // A world of which something is lost is saved elsewhere, so that what may yet be saved of the file stays.
    const bool is_whole = !opened_.world || opened_.lost.empty();
    const bool is_own = opened_.version && options.live.input.empty() && has_all && is_whole;
    const auto holder = is_own ? document_.hold(options.live.journal, opened_.document) : std::nullopt;
    if (holder)
        notify_of_event(opened_.document + " is open in another window, " + text_of(*holder) +
                            ": it can be read here, and is saved under another name",
                        MessageKind::warning);
    else if (is_own)
        document_.opened(opened_.document, *opened_.version);
    return {};
}

// Takes the workpiece of a document, or makes it of a file or a shape.
Result<sculpt::MadeWorkpiece> LiveSession::make_workpiece(const SculptOptions& options) {
    if (!opened_.workpiece) return sculpt::make_workpiece(options.workpiece, options.engine, options.threads);
    auto made = sculpt::ready_to_carve(std::move(*opened_.workpiece), options.engine,
                                       std::make_unique<WorkerPool>(options.threads));
    if (!made) return made;
    if (opened_.history) made->carving->keep_history(std::move(*std::exchange(opened_.history, std::nullopt)));
    // What came from a journal, or was damaged, is in no document as it is here.
    if (opened_.journal.empty() && opened_.lost.empty()) made->carving->is_saved();
    return made;
}

Result<void> LiveSession::take_workpiece(const SculptOptions& options, std::optional<sculpt::MadeWorkpiece> made) {
    if (!made) {
        auto own = make_workpiece(options);
        if (!own) return std::unexpected(own.error());
        made = std::move(*own);
    }
    const sculpt::LoadedWorkpiece& workpiece = made->loaded;
    std::fprintf(stderr, "burin: %s\n", workpiece.size.c_str());
    if (!workpiece.closed.empty()) notify(workpiece.closed, MessageKind::info);
    unit_ = workpiece.unit;
    holes_closed_ = !workpiece.closed.empty();
    room_.workpiece_object = workpiece.bounds_object;
    room_.carved_object = room_.workpiece_object;
    room_.lattice_object = sculpt::lattice_bounds(made->lattice);
    const double cells = sculpt::longest_side_m(workpiece.bounds_object) / made->lattice.spacing_m;
    const auto resolution =
        is_document(options.workpiece) ? static_cast<int>(std::lround(cells)) : options.workpiece.resolution;
    pool_ = std::move(made->pool);
    scene_.take(std::move(made->carving));
    seen_ = SeenSurface(scene_.workpiece()->surface().lattice());
    workpiece_ = {.name = std::filesystem::path(options.workpiece.source).filename().string(),
                  .size = in_millimetres(workpiece.size_m) + ", " + std::to_string(resolution) + " cells"};
    return {};
}

Result<void> LiveSession::load_world(const SculptOptions& options) {
    const bool is_saved = opened_.world.has_value() && opened_.journal.empty() && opened_.lost.empty();
    Result<scene::World> read = options.scene   ? *options.scene
                                : opened_.world ? std::move(*std::exchange(opened_.world, std::nullopt))
                                                : read_sound_world(options.world, options.world_reading);
    if (!read) return std::unexpected(read.error());
    const std::size_t count = read->objects.size();
    Result<std::unique_ptr<WorldSide>> made = WorldSide::create(std::move(*read));
    if (!made) return std::unexpected(made.error());
    saved_world_.begin(*(*made)->objects(), is_saved);
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

// Once for each hand, before anything is touched.
void LiveSession::tell_what_is_not_rendered() {
    if (!state_.world || activity_.is_there()) return;
    std::vector<scene::SceneObject> objects;
    for (const auto& object : state_.world->objects) objects.push_back(*object);
    for (std::size_t hand = 0; hand < hands().hands(); ++hand) {
        const devices::DeviceDescription& device = hands().device(hands().first_part(hand));
        const std::string more = scene::more_than_rendered(objects, device, parameters_of(state_, room_, hand, device));
        if (!more.empty()) notify(more, MessageKind::info);
    }
}

Result<void> LiveSession::take_up_tool(const SculptOptions& options) {
    const Result<wall::OutputSettings> output = first_output(room_, options.live);
    if (!output) return std::unexpected(output.error());
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
    state_ = begin_session(room_, *tool, *feel, *output, std::move(meshes), hands_.handles(), names);
    state_.export_unit = options.export_units.value_or(unit_);
    const double usual_m = options.usual_crumbs ? sculpt::kCrumbCells * scene_.spacing_m() : 0.0;
    state_.crumbs_m = options.crumbs_m.value_or(usual_m);
    state_.carves = scene_.workpiece() != nullptr;
    state_.saves = options.scene == nullptr && !activity_.is_there();
    state_.mirror = options.mirror;
    state_.edge_comfort = options.live.edge_comfort;
    if (opened_.view) state_.world_from_object = *opened_.view;
    if (scene_.world() != nullptr) state_.world = scene_.world()->objects();
    const Result<sculpt::UseTool> use = tool_of(state_);
    if (!use) return std::unexpected(use.error());
    watch_misfit(use->tool);

    start_ns_ = clock_.now_ns();
    if (const auto opened = hands_.open(options.live, state_, room_, clock_); !opened) return opened;
    tools_.resize(hands().parts());
    publish_parameters();
    tell_what_is_not_rendered();
    const auto begun =
        scene_.begin(*use, options.undo_memory_MiB << 20, hands_.beginnings(state_, room_, scene_.spacing_m()),
                     activity_.scene_part(), activity_.tap(), start_ns_);
    if (begun && scene_.carved() != nullptr) scene_.carved()->order(sculpt::MirrorStrokes{state_.mirror});
    const bool keeps_journal = !options.live.journal.empty() && state_.saves;
    if (state_.saves && options.live.input.empty()) news_of_document_.begin(keeps_journal, !opened_.recovered.empty());
    const bool begins_at_once = scene_.carved() != nullptr || !opened_.journal.empty();
    if (begun && keeps_journal && begins_at_once) keep_journal(options.live.journal);
    begins_journal_ = keeps_journal && !begins_at_once;
    return begun;
}

SculptOptions LiveSession::settled(SculptOptions options) const {
    options.workpiece.units = unit_;
    options.workpiece.close_holes = options.workpiece.close_holes || holes_closed_;
    options.tool = tool_options_;
    if (state_.crumbs_m > 0.0) options.crumbs_m = state_.crumbs_m;
    options.live.device = hands().settled_device(0);
    for (std::size_t hand = 0; hand < options.live.hands.size(); ++hand)
        options.live.hands[hand].device = hands().settled_device(hand);
    return options;
}

}  // namespace burin::session
