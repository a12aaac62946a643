// SPDX-License-Identifier: MIT
#include "session/live/opened_scene.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/longest_side.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "session/held/held_tool.hpp"
#include "session/state/session_room.hpp"

namespace burin::session {
namespace {

// The ball that explores a world where no tool is given: its radius as a share of the world's longest side.
constexpr double kExploringBall = 0.015;

}  // namespace

Result<std::unique_ptr<workpiece::Workpiece>> make_workpiece(const SessionSetup& options, OpenedWork& opened) {
    const CarveOptions& carve = options.carve;
    if (!carve.make_engine && carve.engine == compute::EngineChoice::vulkan)
        return fail("--engine vulkan", "this session was opened without a device that carves",
                    "take --engine cpu, or open it with engine_maker() of compute/vulkan/engine_choice.hpp");
    if (!carve.make_workpiece)
        return fail("workpiece " + carve.workpiece.source, "this session was opened without one who carves",
                    "open it with make_carved_workpiece() of sculpt/carved_workpiece.hpp");
    std::optional<workpiece::EarlierWork> earlier;
    // What came from a journal, or was damaged, is in no document as it is here.
    if (opened.workpiece)
        earlier = {std::move(*opened.workpiece), std::exchange(opened.history, std::nullopt),
                   opened.journal.empty() && opened.lost.empty()};
    return carve.make_workpiece(carve.workpiece, std::move(earlier),
                                carve.make_engine ? carve.make_engine : compute::on_processor, options.threads, {});
}

void note_workpiece(const workpiece::Workpiece& made, const SessionSetup& options, Room& room, FoundOut& found) {
    const workpiece::LoadedWorkpiece& workpiece = made.loaded();
    const compute::Lattice& lattice = made.surface().lattice();
    if (!workpiece.size.empty()) std::fprintf(stderr, "burin: %s\n", workpiece.size.c_str());
    found.unit = workpiece.unit;
    found.holes_closed = !workpiece.closed.empty();
    room.workpiece_object = workpiece.bounds_object;
    room.carved_object = room.workpiece_object;
    room.lattice_object = workpiece::lattice_bounds(lattice);
    const double cells = longest_side_m(workpiece.bounds_object) / lattice.spacing_m;
    const auto resolution = is_document(options.carve.workpiece) ? static_cast<int>(std::lround(cells))
                                                                 : options.carve.workpiece.resolution;
    found.name = std::filesystem::path(options.carve.workpiece.source).filename().string();
    found.size = in_millimetres(workpiece.size_m) + ", " + std::to_string(resolution) + " cells";
}

Result<std::unique_ptr<WorldSide>> open_world(const SessionSetup& options, OpenedWork& opened) {
    BURIN_TRY(read, options.scene.given ? Result<scene::World>(*options.scene.given)
                    : opened.world      ? Result<scene::World>(std::move(*std::exchange(opened.world, std::nullopt)))
                                        : read_sound_world(options.scene.world, options.scene.reading));
    return WorldSide::create(std::move(read), !options.desk.unseen);
}

void note_world(const WorldSide& world, const SessionSetup& options, Room& room, FoundOut& found) {
    const Box seen = world.drawn().bounds_scene();
    Box& all = room.workpiece_object;
    if (!seen.empty()) {
        all.include(seen.lo);
        all.include(seen.hi);
    }
    if (all.empty()) all = {Vec3(-0.05), Vec3(0.05)};  // of a world in which nothing is seen
    room.covers_depth = true;
    if (room.carved_object) return;
    const std::size_t count = world.objects()->objects.size();
    const std::string objects = std::to_string(count) + (count == 1 ? " object" : " objects");
    found.name = options.scene.given ? options.scene.given->name
                                     : std::filesystem::path(options.scene.world).filename().string();
    found.size = in_millimetres(all.extent()) + ", " + objects;
}

void note_tool(const SessionSetup& options, const Room& room, FoundOut& found) {
    const double longest_side_m = burin::longest_side_m(room.workpiece_object);
    found.tool_options = options.hands.tool;
    if (!room.carved_object && found.tool_options.shape.empty())
        found.tool_options.shape = formatted("ball:%.2g", kExploringBall * longest_side_m);
    found.tool_options = toolbox::with_tool(found.tool_options, longest_side_m);
}

Result<SessionState> first_state(const SessionSetup& options, const FoundOut& found, const Room& room,
                                 const HandSide::Handles& handles, const Similarity& placed) {
    BURIN_TRY(tool, toolbox::parse_tool_settings(found.tool_options));
    auto meshes = std::make_shared<ToolMeshes>();
    BURIN_TRY_DO(meshes->read(tool.shape));
    for (const toolbox::ToolSpec& other : options.record.tools_of_input) BURIN_TRY_DO(meshes->read(other));
    BURIN_TRY(feel, toolbox::parse_feel_settings(options.carve.feel));
    std::vector<std::string> names;
    for (const NamedDevice& hand : options.hands.named) names.push_back(hand.hand);
    SessionState state = begin_session(room, tool, feel, placed, std::move(meshes), handles, names);
    state.export_unit = options.carve.exports.units.value_or(found.unit);
    state.saves = options.scene.given == nullptr && options.activity == nullptr;
    state.mirror = options.carve.mirror;
    return state;
}

}  // namespace burin::session
