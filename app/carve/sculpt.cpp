// SPDX-License-Identifier: MIT
#include "app/carve/sculpt.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "activities/carve/felt_stroke.hpp"
#include "activities/carve/stroke_pictures.hpp"
#include "app/carve/report.hpp"
#include "app/cli/output_files.hpp"
#include "app/recordings/felt_recording.hpp"
#include "base/file_io.hpp"
#include "base/longest_side.hpp"
#include "base/try.hpp"
#include "compute/tools/apply.hpp"
#include "compute/vulkan/engine_choice.hpp"
#include "desk/draw/picture_folder.hpp"
#include "desk/input/desk_input.hpp"
#include "geometry/files/mesh_import.hpp"
#include "record/record_writer.hpp"
#include "sculpt/finishing.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/stroke_file.hpp"
#include "session/felt/felt_figures.hpp"
#include "session/record/input_files.hpp"
#include "session/work/opened_work.hpp"
#include "toolbox/tool_mesh.hpp"

namespace burin::app {
namespace {

namespace fs = std::filesystem;

session::Staging staging_of(const sculpt::Stroke& stroke, const toolbox::Tool& tool,
                            const std::optional<session::FeltFigures>& felt) {
    session::Staging staging;
    staging.tool_radius_object_m = toolbox::size_of(tool.shape);
    staging.tool_visible = !stroke.empty();
    if (!stroke.empty()) {
        staging.tool_center_object = stroke.back().position_object_m;
        staging.tool_orientation_object = stroke.back().orientation_object;
    }
    if (tool.turns()) staging.held = session::take_up(toolbox::ToolSpec{}, tool.shape);
    if (felt) {
        staging.tool_center_object = felt->last_tool.proxy_object_m;
        staging.tool_orientation_object = felt->last_tool.tool_orientation_object;
        staging.object_from_device = felt->object_from_device;
        staging.workspace_device_m = felt->workspace_device_m;
        staging.box_visible = true;
    }
    // A ball's orientation changes nothing, so strokes leave it out: its pen is drawn as a hand at a desk holds it.
    if (!tool.turns()) staging.tool_orientation_object = session::pen_at_rest();
    return staging;
}

// Writes the plots of the felt stroke beside the report, and their names into it.
Result<void> write_plots(const std::string& report_path, const session::FeltFigures& felt, Json& report) {
    const std::string figure = session::felt_figure_path(report_path), table = session::felt_table_path(report_path);
    BURIN_TRY_DO(write_text(figure, session::felt_figure(felt)));
    BURIN_TRY_DO(write_text(table, session::felt_table(felt)));
    report["feel"]["plots"] = {fs::path(figure).filename().string(), fs::path(table).filename().string()};
    return {};
}

// Checks all places of outputs; the plots' too, where a report is wanted of a stroke that is felt.
Result<void> check_all_outputs(const session::SessionSetup& options) {
    const std::vector<std::string> inputs = session::inputs_of(options).list();
    BURIN_TRY_DO(check_outputs(options.carve.exports.files, options.carve.stroke.report, inputs));
    if (options.carve.stroke.file.empty() || options.carve.stroke.hand != session::HandChoice::simulated) return {};
    return check_felt_report(options.carve.stroke.report, inputs);
}

// Refuses what only a session does: it would be left undone without a word.
Result<void> check_for_a_stroke(const session::SessionSetup& options) {
    constexpr const char* kRemedy = "leave it out, or lead a session with --live or --input";
    if (!options.scene.world.empty())
        return fail("--world", "belongs to a session and not to carving by itself", kRemedy);
    if (options.scene.no_workpiece) return fail("--no-workpiece", "leaves nothing to carve", kRemedy);
    if (!options.hands.points.empty()) return fail("--points", "belongs to a session with a wand", kRemedy);
    if (!options.hands.named.empty())
        return fail("--device", "gives several hands, which belong to a session and not to carving by itself", kRemedy);
    if (options.hands.device != devices::kDefaultHapticDevice)
        return fail("--device " + options.hands.device, "belongs to a session and not to carving by itself", kRemedy);
    return {};
}

void say_that_nothing_was_touched(const Box& box, bool smooths) {
    if (smooths) {
        std::fputs("burin: smoothing has changed nothing: what it reached is smooth already, or nothing lies there\n",
                   stderr);
        return;
    }
    std::fprintf(stderr,
                 "burin: the tool has touched nothing; the workpiece lies between (%g, %g, %g) and (%g, %g, %g) mm, "
                 "and the stroke's file is in metres\n",
                 1e3 * box.lo.x, 1e3 * box.lo.y, 1e3 * box.lo.z, 1e3 * box.hi.x, 1e3 * box.hi.y, 1e3 * box.hi.z);
}

// Says how large the mesh of a tool's file is, and in which unit it was read.
Result<std::string> size_of_file(const toolbox::ToolSpec& tool) {
    BURIN_TRY(read, geometry::import_mesh(tool.file, tool.units));
    return geometry::describe_size(tool.file, read.report.size_m, read.report.unit);
}

struct ChosenTool {
    toolbox::ToolOptions options;  // with the tool that was taken where none was given
    toolbox::ToolSettings settings;
    toolbox::Tool tool;
};

// Makes the tool. Where none is given the workpiece's longest side decides; before it is known a ball stands in.
Result<ChosenTool> choose_tool(const session::SessionSetup& options, std::optional<double> longest_side_m) {
    toolbox::ToolOptions wanted = options.hands.tool;
    wanted.units = options.carve.workpiece.units;
    if (longest_side_m) wanted = toolbox::with_tool(wanted, *longest_side_m);
    BURIN_TRY(settings, toolbox::parse_tool_settings(wanted));
    BURIN_TRY(tool, toolbox::make_tool(settings));
    const bool is_a_file = settings.shape.kind == toolbox::ToolKind::mesh;
    BURIN_TRY_DO(workpiece::check_units(options.carve.workpiece, is_a_file));
    return ChosenTool{std::move(wanted), std::move(settings), std::move(tool)};
}

// Prints the notices of the carving, such as that the processor goes on for a device, and returns them for the report.
std::vector<std::string> tell_notices(sculpt::Sculpture& carving) {
    std::vector<std::string> notices = carving.take_notices();
    for (const std::string& notice : notices) std::fprintf(stderr, "burin: %s\n", notice.c_str());
    return notices;
}

// Undoes the last strokes and describes what was undone for the report.
Result<Json> take_back(sculpt::Sculpture& carving, std::size_t strokes) {
    carving.end_stroke();
    const std::size_t kept = carving.history()->undoable();
    BURIN_TRY(undone, carving.undo(strokes));
    if (undone < strokes) {
        std::fprintf(stderr, "burin: %zu strokes could be undone, not %zu\n", undone, strokes);
    }
    return Json{
        {"strokes_kept", kept}, {"strokes_undone", undone}, {"strokes_dropped", carving.history()->dropped_strokes()}};
}

// What a session file says of the program and the settings that it comes from. Digests are of files that are read.
std::vector<std::pair<std::string, std::string>> facts_of(const session::SessionSetup& options,
                                                          const toolbox::ToolOptions& tool, const std::string& engine) {
    std::vector<std::pair<std::string, std::string>> facts{
        {"program", "burin"},
        {"version", BURIN_VERSION},
        {"compiler", __VERSION__},
        {"command", "sculpt --hand simulated"},
        {"workpiece", options.carve.workpiece.source},
        {"stroke", options.carve.stroke.file},
        {"time", options.carve.stroke.real_time ? "real" : "simulated"},
        {"activity", kFeltActivity},
        {"settings", felt_settings(options, tool, engine)}};
    const std::string tool_file = tool.shape.starts_with("mesh:") ? tool.shape.substr(5) : std::string();
    for (const auto& [fact, path] :
         {std::pair("workpiece sha256", options.carve.workpiece.source),
          std::pair("stroke sha256", options.carve.stroke.file), std::pair("tool sha256", tool_file)}) {
        std::error_code ignored;
        if (!fs::is_regular_file(path, ignored)) continue;
        if (const auto digest = file_digest(path)) facts.emplace_back(fact, *digest);
    }
    return facts;
}

// Gives the workpiece the material of the surface that the tool leaves. Fails where it cannot be carved with the tool.
Result<geometry::Material> take_up(workpiece::LoadedWorkpiece& workpiece, ChosenTool& chosen) {
    const geometry::Material material = toolbox::material_of(chosen.settings);
    chosen.tool.material = static_cast<std::uint8_t>(workpiece.solid.materials.size());
    workpiece.solid.materials.push_back(material);
    BURIN_TRY_DO(compute::check_tool(workpiece.solid, chosen.tool.sweep(Pose{}, Pose{})));
    return material;
}

// Gathers what is known before the first long step.
struct StrokeInputs {
    ChosenTool chosen;  // a ball that stands in where no tool is given
    toolbox::Feel feel;
    sculpt::Stroke stroke;
};

// Finds everything that can be wrong with the input before the first long step.
Result<StrokeInputs> read_inputs(const session::SessionSetup& options) {
    BURIN_TRY_DO(check_for_a_stroke(options));
    BURIN_TRY(chosen, choose_tool(options, std::nullopt));
    BURIN_TRY(feel, toolbox::parse_feel(options.carve.feel));
    BURIN_TRY_DO(check_all_outputs(options));
    BURIN_TRY_DO(record::check_new_place(options.record.path));
    BURIN_TRY_DO(sculpt::check_simplification(options.carve.exports.simplify_m));
    BURIN_TRY_DO(geometry::check_crumbs(options.carve.exports.crumbs_m));
    if (options.carve.stroke.file.empty()) return StrokeInputs{std::move(chosen), std::move(feel), {}};
    BURIN_TRY(stroke, sculpt::read_stroke(options.carve.stroke.file));
    return StrokeInputs{std::move(chosen), std::move(feel), std::move(stroke)};
}

// Opens the workpiece, whatever its source is.
Result<session::OpenedWork> open_work(const workpiece::WorkpieceOptions& options, WorkerPool& pool) {
    if (session::is_document(options)) return session::open_workpiece_of(options.source);
    BURIN_TRY(workpiece, sculpt::load_workpiece(options, pool));
    return session::OpenedWork{.workpiece = std::move(workpiece), .version = {}};
}

// A workpiece and the tool that suits it.
struct TakenUp {
    workpiece::LoadedWorkpiece workpiece;
    ChosenTool chosen;
    geometry::Material material;  // of the surface that the tool leaves
    double longest_side_m;
};

Result<TakenUp> take_up_workpiece(const session::SessionSetup& options, const ChosenTool& stand_in, WorkerPool& pool) {
    BURIN_TRY(opened, open_work(options.carve.workpiece, pool));
    if (!opened.lost.empty()) std::fprintf(stderr, "burin: %s\n", opened.lost.c_str());
    for (const std::string& path : options.carve.exports.files)
        BURIN_TRY_DO(sculpt::check_precision(path, opened.workpiece->solid.lattice));
    const double longest_side_m = burin::longest_side_m(opened.workpiece->bounds_object);
    BURIN_TRY(chosen, options.hands.tool.shape.empty() ? choose_tool(options, longest_side_m) : stand_in);
    BURIN_TRY(material, take_up(*opened.workpiece, chosen));
    return TakenUp{std::move(*opened.workpiece), std::move(chosen), material, longest_side_m};
}

// Tells the user what the tool's file was read as, and whether a tool that is used suits the workpiece, unless a
// session will; returns the tool's part of the report.
Result<Json> introduce(const TakenUp& taken_up, double cell_m, const session::StrokeOptions& stroke) {
    const ChosenTool& chosen = taken_up.chosen;
    Json report = toolbox::describe_tool(chosen.options, taken_up.material);
    if (chosen.settings.shape.kind == toolbox::ToolKind::mesh) {
        BURIN_TRY(size, size_of_file(chosen.settings.shape));
        report["size"] = size;
        std::printf("%s\n", size.c_str());
    }
    const auto misfit = toolbox::misfit(chosen.settings, chosen.tool, taken_up.longest_side_m, cell_m);
    if (stroke.file.empty() || !misfit) return report;
    if (stroke.hand == session::HandChoice::rigid) std::fprintf(stderr, "burin: %s\n", misfit->c_str());
    report["misfit"] = *misfit;
    return report;
}

// Opens the folder of the pictures; none where none are asked for.
Result<std::optional<activities::StrokePictures>> open_pictures(const std::string& folder, const Box& bounds_object) {
    if (folder.empty()) return std::optional<activities::StrokePictures>();
    BURIN_TRY_DO(session::make_picture_folder(folder, "--pictures"));
    BURIN_TRY(opened, activities::StrokePictures::create(folder, bounds_object));
    return std::optional<activities::StrokePictures>(std::move(opened));
}

// Returns what a session needs to know of a workpiece that it has not loaded. Its size is told already.
sculpt::MadeWorkpiece made_of(std::unique_ptr<sculpt::Sculpture> carving, const workpiece::LoadedWorkpiece& workpiece) {
    workpiece::LoadedWorkpiece loaded;
    loaded.unit = workpiece.unit;
    loaded.size_m = workpiece.size_m;
    loaded.bounds_object = workpiece.bounds_object;
    const compute::Lattice lattice = carving->surface().lattice();
    return {nullptr, std::move(loaded), lattice, std::move(carving)};
}

// Holds the workpiece, and the results of its carving.
struct CarvedStroke {
    std::unique_ptr<sculpt::Sculpture> rigidly;         // carved exactly; null: a session holds it
    std::unique_ptr<activities::OpenedStroke> by_feel;  // of a simulated hand
    std::optional<session::FeltFigures> felt;           // likewise
    std::vector<std::string> notices;
    Json undone;  // null: nothing was to be taken back
};

// Has a simulated hand feel its way along the stroke.
Result<CarvedStroke> carve_by_feel(std::unique_ptr<sculpt::Sculpture> carving, const session::SessionSetup& options,
                                   const StrokeInputs& inputs, const TakenUp& taken_up) {
    session::SessionSetup setup = options;
    setup.hands.tool = taken_up.chosen.options;
    std::vector<std::pair<std::string, std::string>> facts;
    if (!options.record.path.empty()) facts = facts_of(options, setup.hands.tool, carving->engine().name());
    BURIN_TRY(opened,
              activities::OpenedStroke::create(made_of(std::move(carving), taken_up.workpiece), inputs.stroke, setup));
    BURIN_TRY(felt, opened->run(std::move(facts)));
    if (!options.record.path.empty())
        std::printf("%s: %s ticks recorded\n", options.record.path.c_str(), std::to_string(felt.ticks).c_str());
    std::vector<std::string> notices = opened->messages();
    return CarvedStroke{nullptr, std::move(opened), std::move(felt), std::move(notices), {}};
}

// Leads the tool exactly along the stroke.
Result<CarvedStroke> carve_rigidly(std::unique_ptr<sculpt::Sculpture> carving, const session::SessionSetup& options,
                                   const StrokeInputs& inputs, const toolbox::Tool& tool) {
    carving->mirror(options.carve.mirror);
    if (options.carve.stroke.undo > 0) carving->keep_history(options.carve.undo_memory_MiB << 20);
    if (!inputs.stroke.empty())
        BURIN_TRY_DO(sculpt::carve_rigidly(*carving, inputs.stroke, tool, options.carve.stroke.merge_rows));
    std::vector<std::string> notices = tell_notices(*carving);
    return CarvedStroke{std::move(carving), nullptr, std::nullopt, std::move(notices), {}};
}

// Carves along the stroke, and takes back what is asked.
Result<CarvedStroke> carve(std::unique_ptr<sculpt::Sculpture> carving, const session::SessionSetup& options,
                           const StrokeInputs& inputs, const TakenUp& taken_up) {
    sculpt::Sculpture& workpiece = *carving;
    const bool is_felt = !inputs.stroke.empty() && options.carve.stroke.hand == session::HandChoice::simulated;
    BURIN_TRY(carved, is_felt ? carve_by_feel(std::move(carving), options, inputs, taken_up)
                              : carve_rigidly(std::move(carving), options, inputs, taken_up.chosen.tool));
    if (options.carve.stroke.undo == 0) return std::move(carved);
    BURIN_TRY(taken_back, take_back(workpiece, options.carve.stroke.undo));
    carved.undone = std::move(taken_back);
    return std::move(carved);
}

// Describes the mesh and what finishing has changed of it.
void describe_finished(Json& report, const sculpt::FinishedMesh& finished, LengthUnit export_unit) {
    report["mesh"] = describe_mesh(finished.mesh, export_unit);
    report["mesh"]["self_intersections"] = finished.self_intersections;
    report["mesh"]["crumbs"] = {{"dropped", finished.crumbs.count}, {"below_m", finished.crumbs.below_m}};
    if (finished.crumbs.count > 0) std::printf("  %s\n", geometry::in_words(finished.crumbs).c_str());
    report["slivers"] = finished.slivers;
    if (!finished.simplification.is_null()) report["simplification"] = finished.simplification;
}

// Writes the exports, and their names into the report.
Result<void> export_all(const session::SessionSetup& options, const sculpt::FinishedMesh& finished,
                        LengthUnit export_unit, Json& report) {
    if (options.carve.exports.files.empty()) return {};
    if (finished.mesh.triangles.empty() && !finished.too_thin.empty())
        return fail(options.carve.workpiece.source, "has nothing to export: " + finished.too_thin,
                    "raise --resolution, or make it thicker");
    if (finished.mesh.triangles.empty())
        return fail(options.carve.workpiece.source, "has been carved away altogether, so there is nothing to export",
                    "use a smaller tool or a shorter stroke");
    for (const std::string& path : options.carve.exports.files) {
        BURIN_TRY_DO(sculpt::export_finished(finished, path));
        report["exports"].push_back(fs::path(path).filename().string());
        std::printf("%s: written in %s\n", path.c_str(), descriptor_of(export_unit).plural);
        if (sculpt::loses_colours(finished.mesh, path)) std::printf("  %s\n", sculpt::kColoursLeftOut);
    }
    report["export_unit"] = name_of(export_unit);
    return {};
}

// Writes the report, with plots of what was felt beside it; nothing where none is asked for.
Result<void> write_sculpt_report(const std::string& path, const std::optional<session::FeltFigures>& felt,
                                 Json& report) {
    if (path.empty()) return {};
    if (felt) BURIN_TRY_DO(write_plots(path, *felt, report));
    return write_report(path, report);
}

}  // namespace

bool records_a_felt_stroke(const session::SessionSetup& options) {
    const bool is_live = options.desk.live || options.desk.offscreen || !options.desk.wall.empty() ||
                         !options.record.input.empty() || !options.work.outputs.empty() ||
                         session::wants_streams(options.record);
    return !options.record.path.empty() && !is_live && !options.carve.stroke.file.empty() &&
           options.carve.stroke.hand == session::HandChoice::simulated;
}

Result<void> sculpt(const session::SessionSetup& options) {
    BURIN_TRY(inputs, read_inputs(options));
    WorkerPool pool(options.threads);
    BURIN_TRY(taken_up, take_up_workpiece(options, inputs.chosen, pool));
    const ChosenTool& tool = taken_up.chosen;
    const Box bounds_object = taken_up.workpiece.bounds_object;
    BURIN_TRY(pictures, open_pictures(options.carve.stroke.pictures, bounds_object));
    // One device draws and carves, where both are asked for.
    const compute::DeviceSource device = [&pictures] { return pictures ? pictures->lane() : compute::own_device(); };
    compute::ChosenEngine engine =
        compute::choose_engine(options.carve.engine, std::move(taken_up.workpiece.solid), pool, device);
    auto uncarved = std::make_unique<sculpt::Sculpture>(std::move(engine.engine), pool);
    sculpt::Sculpture& carving = *uncarved;
    if (pictures) BURIN_TRY_DO((pictures)->take_before(carving));
    const double cell_m = carving.surface().lattice().spacing_m;
    BURIN_TRY(tool_report, introduce(taken_up, cell_m, options.carve.stroke));
    std::printf("%s\n", taken_up.workpiece.size.c_str());
    BURIN_TRY(carved, carve(std::move(uncarved), options, inputs, taken_up));

    const LengthUnit export_unit = options.carve.exports.units.value_or(taken_up.workpiece.unit);
    BURIN_TRY(finished, sculpt::finish_mesh(
                            carving.surface(), carving.engine().solid(), export_unit, options.carve.exports.simplify_m,
                            options.carve.exports.crumbs_m.value_or(geometry::kCrumbCells * cell_m), pool));
    Json report = {{"burin", BURIN_VERSION}, {"workpiece", taken_up.workpiece.report}};
    report["tool"] = std::move(tool_report);
    report["engine"] = {
        {"name", carving.engine().name()}, {"device", engine.device}, {"chosen_because", engine.reason}};
    if (!carved.notices.empty()) report["notices"] = carved.notices;
    if (const auto traffic = carving.engine().traffic()) report["engine"]["traffic"] = describe_traffic(*traffic);
    report["carving"] = describe_carving(carving);
    if (!inputs.stroke.empty() && report["carving"]["rays_touched"] == 0)
        say_that_nothing_was_touched(bounds_object, tool.tool.operation == compute::Operation::smooth);
    describe_finished(report, finished, export_unit);
    if (!carved.undone.is_null()) report["undo"] = carved.undone;
    const std::optional<session::FeltFigures>& felt = carved.felt;
    if (felt) report["feel"] = describe_feel(*felt, inputs.feel);
    report["timing"] = describe_timing(carving, felt ? &*felt : nullptr);
    BURIN_TRY_DO(export_all(options, finished, export_unit, report));
    if (pictures) {
        const auto taken = (pictures)->take_after(carving, staging_of(inputs.stroke, tool.tool, felt));
        if (!taken) return taken;
        report["pictures"] = {{"device", (pictures)->device_name()}, {"scene_scale", (pictures)->scene_scale()}};
    }
    BURIN_TRY_DO(write_sculpt_report(options.carve.stroke.report, felt, report));
    print_table(report);
    return {};
}

Result<void> record_again(const session::SessionSetup& options) {
    BURIN_TRY(stroke, sculpt::read_stroke(options.carve.stroke.file));
    WorkerPool pool(options.threads);
    BURIN_TRY(opened, open_work(options.carve.workpiece, pool));
    workpiece::LoadedWorkpiece* const workpiece = &*opened.workpiece;
    BURIN_TRY(chosen_tool, choose_tool(options, std::nullopt));
    BURIN_TRY_DO(take_up(*workpiece, chosen_tool));
    compute::ChosenEngine chosen = compute::choose_engine(options.carve.engine, std::move(workpiece->solid), pool);
    auto carving = std::make_unique<sculpt::Sculpture>(std::move(chosen.engine), pool);
    session::SessionSetup setup = options;
    setup.hands.tool = chosen_tool.options;
    BURIN_TRY(opened_stroke, activities::OpenedStroke::create(made_of(std::move(carving), *workpiece), stroke, setup));
    BURIN_TRY_DO(opened_stroke->run({}));
    return {};
}

}  // namespace burin::app
