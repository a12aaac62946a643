// SPDX-License-Identifier: MIT
#include "app/cli/sculpt_options.hpp"

#include <string>
#include <utility>
#include <vector>

#include "app/cli/live_options.hpp"
#include "base/text.hpp"
#include "compute/rays/lattice.hpp"
#include "geometry/mesh/crumbs.hpp"
#include "session/options/option_bounds.hpp"

namespace burin::app {

void add_sculpt_options(Command command, session::SessionSetup& options) {
    command
        .option("WORKPIECE,--workpiece", options.carve.workpiece.source,
                "FILE (STL, OBJ, PLY, OFF, or a document .burin), block:X,Y,Z from the origin on, or ball:R about it, "
                "in metres")
        .asset(AssetRoom::workpieces)
        .show_default();
    command
        .option(
            "--world", options.scene.world,
            "Objects that stand with the workpiece, and are touched and not carved: .toml, .wrl, STL, OBJ, PLY, OFF")
        .asset(AssetRoom::worlds);
    command.flag("--no-workpiece", options.scene.no_workpiece,
                 "With --world: its objects alone, as burin world opens them");
    command.option("--points", options.hands.points,
                   "With a wand: which of its points touch, each with the tool's ball; else the tool is in its middle");
    add_carving_options(command, options);
}

namespace {

// Adds how a mesh is read, and what carves it.
void add_tool_options(Command command, session::SessionSetup& options) {
    command.unit("--units", options.carve.workpiece.units, kUnitsHelp);
    command.unit("--export-units", options.carve.exports.units,
                 "Unit of the numbers in exported files; else that of the workpiece's file, or m");
    command.flag("--close-holes", options.carve.workpiece.close_holes, "Fill the holes of a mesh that is not closed");
    command.option("--weld", options.carve.workpiece.weld_m, kWeldHelp).within(session::kWeldBounds);
    command
        .option("--tool", options.hands.tool.shape,
                alternatives(toolbox::tool_synopses()) +
                    ", in metres; else a ball whose radius is 5 % of the workpiece's longest side")
        .asset(AssetRoom::tools);
    std::vector<std::pair<std::string, compute::Operation>> operations;
    for (const toolbox::OperationDescriptor& known : toolbox::operations())
        operations.emplace_back(known.name, known.operation);
    command.choice("--operation", options.hands.tool.operation, alternatives(names_in(toolbox::operations())),
                   operations);
    command.option("--material", options.hands.tool.material, "R,G,B, the colour of the surface that the tool leaves");
    command
        .option("--sweep-tolerance", options.hands.tool.sweep_tolerance_cells,
                "Largest error of a swept surface that has no closed form, in lattice cells")
        .within(session::kSweepToleranceBounds)
        .show_default();
    command
        .option("--smooth-strength", options.hands.tool.smooth_strength,
                "With --operation smooth: 0 does nothing, 1 is most")
        .within(session::kSmoothStrengthBounds)
        .show_default();
    add_mirror_option(command, options);
}

// Adds along which stroke it is carved, and by what.
void add_stroke_options(Command command, session::SessionSetup& options) {
    command.flag("!--no-merge", options.carve.stroke.merge_rows,
                 "One update for each row of the stroke, instead of one for a straight run of rows");
    command.option("--stroke", options.carve.stroke.file, "CSV with the columns time_s,x_m,y_m,z_m,qx,qy,qz,qw,button")
        .asset(AssetRoom::strokes);
    command.option("--resolution", options.carve.workpiece.resolution, "Lattice cells along the longest side")
        .within(session::kResolutionBounds)
        .show_default();
    command
        .option(
            "--room", options.carve.workpiece.room,
            formatted("Empty room on every side of the workpiece for what is added, as a share of its longest side; "
                      "else %g for a person, and where a --stroke adds material, or 0",
                      workpiece::kUsualRoom))
        .within(session::kRoomBounds);
    add_engine_option(command, options.carve.engine);
}

// Adds how a simulated hand feels the workpiece.
void add_feel_options(Command command, session::SessionSetup& options) {
    command.choice("--hand", options.carve.stroke.hand,
                   "rigid: the tool follows the stroke exactly; simulated: a hand feels its way",
                   {{"rigid", session::HandChoice::rigid}, {"simulated", session::HandChoice::simulated}});
    command
        .option("--hardness", options.carve.feel.hardness,
                "With --hand simulated: soft, medium, hard, lime, maple, oak, mdf, beech-lvl, ptfe, or the pressure in "
                "kPa under which a millimetre of material a second goes away; 0 gives way, inf cannot be cut")
        .show_default();
    command.option("--yield", options.carve.feel.yield_kPa,
                   "With --hand simulated: the pressure in kPa below which nothing goes away; else the hardness' own");
    command.option("--grain", options.carve.feel.grain_mm,
                   "With --hand simulated: hard and soft rings across x with this spacing in mm; else none");
    command.option("--stiffness", options.carve.feel.stiffness_N_per_m,
                   "With --hand simulated: of the surface, N/m at the device; else the hardness' own");
    command.option("--friction", options.carve.feel.friction,
                   "With --hand simulated: Coulomb's coefficient; else the hardness' own");
    command
        .option("--press", options.carve.feel.press_N,
                "With --hand simulated: the force in N with which the hand presses beyond its stroke")
        .show_default();
    command
        .option("--grip", options.carve.feel.grip_N_per_m,
                "With --hand simulated: how firmly the hand holds the tool, N/m")
        .show_default();
    command.flag("--real-time", options.carve.stroke.real_time,
                 "With --hand simulated: a haptic thread at 1 kHz instead of simulated time");
}

// Adds what is left of the carving, and what of it can be taken back.
void add_result_options(Command command, session::SessionSetup& options) {
    command.option("--export", options.carve.exports.files,
                   "Where to write the carved mesh: .stl, .ply (with colour) or .obj; may be repeated");
    command.option("--simplify", options.carve.exports.simplify_m,
                   "Export fewer triangles: the surface moves at most this far, in metres");
    command.option("--crumbs", options.carve.exports.crumbs_m,
                   formatted("Export no loose pieces below this size, in metres; 0 keeps all; else %g cells",
                             geometry::kCrumbCells));
    command.option("--pictures", options.carve.stroke.pictures,
                   "A folder for before.png, after.png, left.png, right.png, stereo.png");
    command.option("--report", options.carve.stroke.report,
                   "A JSON file for all figures; plots of what was felt go beside it");
    command
        .option("--undo", options.carve.stroke.undo, "Take back the last so many strokes, each from press to release")
        .show_default();
    command.option("--undo-memory", options.carve.undo_memory_MiB, "MiB for strokes that can be taken back")
        .within(session::kUndoMemoryBounds)
        .show_default();
    command.option("--threads", options.threads, "How many threads carve; 0: one per core").within(0, 1024);
}

}  // namespace

void add_carving_options(Command command, session::SessionSetup& options) {
    add_tool_options(command, options);
    add_stroke_options(command, options);
    add_feel_options(command, options);
    add_result_options(command, options);
}

}  // namespace burin::app
