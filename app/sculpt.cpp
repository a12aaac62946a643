// SPDX-License-Identifier: MIT
#include "app/sculpt.hpp"

#include <unistd.h>

#include <filesystem>
#include <optional>

#include "app/engine_choice.hpp"
#include "app/felt_stroke.hpp"
#include "app/pictures.hpp"
#include "app/report.hpp"
#include "app/rigid_stroke.hpp"
#include "geometry/file_io.hpp"
#include "geometry/mesh_export.hpp"

namespace burin {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const Material kCutMaterial{"cut", {224, 142, 54}};  // a warm wood under whatever the skin is

Result<Tool> parse_tool(const std::string& text) {
    constexpr std::string_view kBall = "ball:";
    if (!text.starts_with(kBall))
        return fail("--tool " + text, "is not a tool", "write ball:R with the radius in metres");
    const auto radius = parse_numbers(std::string_view(text).substr(kBall.size()), 1, "--tool " + text);
    if (!radius) return std::unexpected(radius.error());
    if (!(radius->front() > 0.0)) return fail("--tool " + text, "has no size", "give a radius above zero, in metres");
    return Tool{radius->front(), 0};
}

// Whether a file can appear there, found out before hours of work and not after.
Result<void> check_output(const std::string& path) {
    const fs::path folder = fs::absolute(path).parent_path();
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        return fail(path, "cannot be written: there is no folder " + folder.string(),
                    "make the folder, or choose another place");
    }
    if (fs::is_directory(path, ignored)) return fail(path, "is a folder", "give the name of a file");
    if (access(folder.c_str(), W_OK) != 0) {
        return fail(path, "cannot be written: no permission in folder " + folder.string(), "choose another place");
    }
    return {};
}

Result<void> check_outputs(const SculptOptions& options) {
    for (const std::string& path : options.exports) {
        const auto format = mesh_format_of(path);
        if (!format || *format == MeshFormat::off) {
            return fail(path, "has no extension that Burin exports", "name it .stl, .ply or .obj");
        }
        if (const auto ok = check_output(path); !ok) return ok;
    }
    if (!options.report.empty()) return check_output(options.report);
    return {};
}

// Only a mesh's coordinates tell, so this is found out after loading it.
Result<void> check_precision(const SculptOptions& options, const Lattice& lattice) {
    for (const std::string& path : options.exports) {
        if (lattice.fits_floats() || mesh_format_of(path) == MeshFormat::obj) continue;
        return fail(path,
                    "would hold single-precision numbers, which cannot tell the workpiece's details apart so far from "
                    "its origin",
                    "move the workpiece nearer to its origin, or export .obj");
    }
    return {};
}

Box bounds_of(const Lattice& lattice) {
    // The lattice has about one and a half empty cells around the workpiece.
    const Vec3 inset(1.5 * lattice.spacing_m);
    const Vec3 size = Vec3(lattice.cells[0], lattice.cells[1], lattice.cells[2]) * lattice.spacing_m;
    return {lattice.origin_object + inset, lattice.origin_object + size - inset};
}

Staging staging_of(const Stroke& stroke, const Tool& tool, const std::optional<FeltFigures>& felt) {
    Staging staging;
    staging.tool_radius_object_m = tool.radius_m;
    staging.tool_visible = !stroke.empty();
    if (!stroke.empty()) staging.tool_center_object = stroke.back().position_object_m;
    if (felt) {
        staging.tool_center_object = felt->last_tool.proxy_object_m;
        staging.object_from_device = felt->object_from_device;
        staging.workspace_device_m = felt->workspace_device_m;
        staging.box_visible = true;
    }
    return staging;
}

Result<void> write_report(const std::string& path, const Json& report) {
    const std::string text = report.dump(2) + "\n";
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

Result<void> sculpt(const SculptOptions& options) {
    // Everything that can be wrong with the input is found before the first long step.
    Result<Tool> tool = parse_tool(options.tool);
    if (!tool) return std::unexpected(tool.error());
    if (const auto ok = check_outputs(options); !ok) return ok;
    Stroke stroke;
    if (!options.stroke.empty()) {
        Result<Stroke> read = read_stroke(options.stroke);
        if (!read) return std::unexpected(read.error());
        stroke = std::move(*read);
    }
    WorkerPool pool(options.threads);
    Result<Workpiece> workpiece = load_workpiece(options.workpiece, pool);
    if (!workpiece) return std::unexpected(workpiece.error());
    if (const auto ok = check_precision(options, workpiece->solid.lattice); !ok) return ok;
    tool->material = static_cast<std::uint8_t>(workpiece->solid.materials.size());
    workpiece->solid.materials.push_back(kCutMaterial);

    std::optional<Pictures> pictures;
    if (!options.pictures.empty()) {
        Result<Pictures> opened = Pictures::create(options.pictures, bounds_of(workpiece->solid.lattice));
        if (!opened) return std::unexpected(opened.error());
        pictures.emplace(std::move(*opened));
    }
    Result<ChosenEngine> chosen = choose_engine(options.engine, std::move(workpiece->solid), pool);
    if (!chosen) return std::unexpected(chosen.error());
    Carving carving(std::move(chosen->engine), pool);
    if (pictures) {
        if (const auto taken = pictures->take_before(carving); !taken) return taken;
    }

    std::optional<FeltFigures> felt;
    if (!stroke.empty() && options.hand == HandChoice::rigid) {
        if (const auto carved = carve_rigidly(carving, stroke, *tool); !carved) return carved;
    } else if (!stroke.empty()) {
        Result<FeltFigures> carved = carve_by_feel(carving, stroke, *tool, {options.real_time});
        if (!carved) return std::unexpected(carved.error());
        felt = std::move(*carved);
    }

    const TriangleMesh mesh = carving.surface().welded();
    Json report = {{"burin", BURIN_VERSION}, {"workpiece", workpiece->report}};
    report["engine"] = {
        {"name", carving.engine().name()}, {"device", chosen->device}, {"chosen_because", chosen->reason}};
    report["carving"] = describe_carving(carving);
    report["mesh"] = describe_mesh(mesh);
    if (felt) report["feel"] = describe_feel(*felt);
    report["timing"] = describe_timing(carving, felt ? &*felt : nullptr);
    if (mesh.triangles.empty() && !options.exports.empty()) {
        return fail(options.workpiece.source, "has been carved away altogether, so there is nothing to export",
                    "use a smaller tool or a shorter stroke");
    }
    for (const std::string& path : options.exports) {
        if (const auto written = export_mesh(mesh, path); !written) return written;
        report["exports"].push_back(fs::path(path).filename().string());
    }
    if (pictures) {
        if (const auto taken = pictures->take_after(carving, staging_of(stroke, *tool, felt)); !taken) return taken;
        report["pictures"] = {{"device", pictures->device_name()}, {"scene_scale", pictures->scene_scale()}};
    }
    if (!options.report.empty()) {
        if (const auto written = write_report(options.report, report); !written) return written;
    }
    print_table(report);
    return {};
}

}  // namespace burin
