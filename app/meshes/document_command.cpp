// SPDX-License-Identifier: MIT
#include "app/meshes/document_command.hpp"

#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/output_files.hpp"
#include "app/meshes/convert_placing.hpp"
#include "base/length_unit.hpp"
#include "base/try.hpp"
#include "document/document_reader.hpp"
#include "sculpt/finishing.hpp"
#include "session/record/input_files.hpp"
#include "session/work/opened_work.hpp"
#include "workpiece/saved_solid.hpp"

namespace burin::app {
namespace {

std::string kilobytes(std::uint64_t bytes) { return std::to_string((bytes + 999) / 1000) + " kB"; }

// Refuses what only a mesh file can be asked for.
Result<void> check_for_a_document(const ConvertOptions& options) {
    constexpr const char* kRemedy = "leave it out: a document's solid is closed, and its unit is known";
    if (options.units) return fail("--units", "is for mesh files", kRemedy);
    if (options.close_holes) return fail("--close-holes", "is for mesh files", kRemedy);
    if (options.weld_m) return fail("--weld", "is for mesh files", kRemedy);
    return {};
}

Json part_json(const document::PartPlace& part, const scene::Pages& pages) {
    Json json{{"kind", part.kind}, {"pages", part.pages}, {"bytes", part.bytes}, {"bytes_in_file", part.data_bytes}};
    json["damaged"] = Json::array();
    for (const scene::PageName& name : pages.damaged)
        json["damaged"].push_back({{"kind", name.kind}, {"number", name.number}});
    return json;
}

void print_part(const document::PartPlace& part, const scene::Pages& pages) {
    std::printf("%s: %zu pages, %s, %s in the file\n", part.kind.c_str(), static_cast<std::size_t>(part.pages),
                kilobytes(part.bytes).c_str(), kilobytes(part.data_bytes).c_str());
    for (const scene::PageName& name : pages.damaged)
        std::printf("  page %lld of %s is damaged\n", static_cast<long long>(name.number), name.kind.c_str());
}

// Adds how many steps of a part undo takes back and redo repeats.
void tell_steps(document::DocumentReader& reader, const document::PartPlace& part, bool prints, Json& json) {
    const Result<std::optional<scene::Steps>> steps = reader.steps(part);
    if (!steps || !*steps) return;
    const std::int64_t back = (*steps)->done + 1 - (*steps)->first, forward = (*steps)->last - (*steps)->done;
    json["undo"] = {{"back", back}, {"forward", forward}};
    if (!prints) return;
    const bool strokes = part.kind == workpiece::kSolidPart;
    const std::string what = std::string(strokes ? "stroke" : "step") + (back == 1 ? "" : "s");
    std::printf("  undo: %lld %s back, %lld forward\n", static_cast<long long>(back), what.c_str(),
                static_cast<long long>(forward));
}

struct InfoOptions {
    std::string file;
    std::string json;  // a file for all of it; empty: none
};

Result<void> document_info(const InfoOptions& options) {
    BURIN_TRY_DO(check_places(std::array{options.json}, std::array{options.file}));
    BURIN_TRY(reader, document::DocumentReader::open(options.file));
    const bool prints = options.json != kStandardOutput;
    Json json{{"file", options.file}, {"facts", Json::object()}, {"commands", reader.commands()}};
    for (const auto& [key, value] : reader.facts()) json["facts"][key] = value;
    if (prints) std::printf("%s: a document\n", options.file.c_str());
    for (const auto& [key, value] : reader.facts())
        if (prints) std::printf("  %-20s %s\n", key.c_str(), value.c_str());
    for (const std::string& command : reader.commands())
        if (prints) std::printf("  %-20s %s\n", "command", command.c_str());
    for (const document::PartPlace& part : reader.parts()) {
        BURIN_TRY(pages, reader.pages(part));
        if (prints) print_part(part, pages);
        Json& told = json["parts"].emplace_back(part_json(part, pages));
        tell_steps(reader, part, prints, told);
    }
    // Missing pages show only when the work is made of all of them.
    const Result<session::OpenedWork> opened =
        session::open_document(options.file, compute::History::kDefaultBudget_bytes);
    const std::string recovered = opened ? opened->recovered : "", lost = opened ? opened->lost : opened.error().line();
    if (opened && opened->workpiece) {
        const Vec3& size_m = opened->workpiece->size_m;
        json["size_m"] = {size_m.x, size_m.y, size_m.z};
        if (prints) std::printf("  %-20s %s\n", "size", in_millimetres(size_m).c_str());
    }
    json["unsaved"] = recovered;
    json["lost"] = lost;
    if (prints && !recovered.empty()) std::printf("  %s\n", recovered.c_str());
    if (!options.json.empty()) BURIN_TRY_DO(write_output(options.json, json_text(json)));
    std::fflush(stdout);
    if (!opened) return std::unexpected(opened.error());
    if (lost.empty()) return {};
    return fail(options.file, lost.substr(options.file.size() + 2), "the rest opens; an earlier copy has it");
}

CommandAction add_info(Command command) {
    const auto options = std::make_shared<InfoOptions>();
    command.option("FILE", options->file, "A document that burin has saved, .burin").required();
    command.option("--json", options->json, "A file for all of it; - for standard output");
    return action([options] { return document_info(*options); });
}

}  // namespace

CommandRow info_row() { return {"info", "What is in a document, and from where it came", add_info}; }

Result<void> convert_document(const ConvertOptions& options) {
    BURIN_TRY_DO(check_for_a_document(options));
    BURIN_TRY_DO(sculpt::check_simplification(options.simplify_m));
    BURIN_TRY(placing, placing_of(options));
    const std::vector<std::string> inputs = session::InputFiles().mesh(options.in).list();
    for (const std::string& file : inputs)
        if (file != options.in && session::is_same_file(options.out, file))
            return fail(options.out, "is the mesh of which " + options.in + " was made, and would be overwritten",
                        "choose another place, or remove it first");
    BURIN_TRY_DO(check_overwrites_none(options.out, inputs));
    BURIN_TRY_DO(check_outputs(std::array{options.out}, "", inputs));
    WorkerPool pool;
    BURIN_TRY(opened, session::open_workpiece_of(options.in));
    compute::Solid& solid = opened.workpiece->solid;
    std::printf("%s\n", opened.workpiece->size.c_str());
    if (!opened.lost.empty()) std::fprintf(stderr, "burin: %s\n", opened.lost.c_str());
    const LengthUnit unit = options.export_units.value_or(opened.workpiece->unit);
    BURIN_TRY_DO(place_solid(solid, placing, unit, pool));
    BURIN_TRY_DO(sculpt::check_precision(options.out, solid.lattice));
    compute::Surface surface(solid.lattice);
    surface.mesh_all(solid, pool);
    constexpr double kAllCrumbs_m = 0.0;  // what a document holds is converted whole
    BURIN_TRY(finished, sculpt::finish_mesh(surface, solid, unit, options.simplify_m, kAllCrumbs_m, pool));
    if (finished.mesh.triangles.empty())
        return fail(options.in,
                    finished.too_thin.empty() ? "has been carved away altogether, so there is nothing to convert"
                                              : "has nothing to convert: " + finished.too_thin,
                    "open it, and undo some strokes");
    if (placing.mirrors()) mirror(finished.mesh);
    BURIN_TRY_DO(sculpt::export_finished(finished, options.out));
    std::printf("%s: %zu triangles, in %s\n", options.out.c_str(), finished.mesh.triangles.size(),
                descriptor_of(unit).plural);
    if (sculpt::loses_colours(finished.mesh, options.out)) std::printf("  %s\n", sculpt::kColoursLeftOut);
    return {};
}

}  // namespace burin::app
