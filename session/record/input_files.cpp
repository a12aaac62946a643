// SPDX-License-Identifier: MIT
#include "session/record/input_files.hpp"

#include "base/places.hpp"
#include "document/document_reader.hpp"
#include "geometry/files/mesh_files.hpp"
#include "geometry/files/mesh_import.hpp"
#include "scene/world_inputs.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/input_log.hpp"
#include "session/record/log_outputs.hpp"
#include "session/record/session_log.hpp"

namespace burin::session {
namespace {

// Returns the mesh of which a document was made: it is not read again, but nobody means to lose it. Where it lay then
// is a path from the folder of that session: this one's, or the document's.
std::vector<std::string> made_from(const std::string& document) {
    const Result<document::DocumentReader> reader = document::DocumentReader::open(document);
    const std::string source = reader ? reader->fact("source") : "";
    if (source.empty() || !geometry::mesh_format_of(source)) return {};
    return {source, (std::filesystem::path(document).parent_path() / source).string()};
}

}  // namespace

InputFiles& InputFiles::file(const std::string& path) {
    if (!path.empty()) list_.push_back(path);
    return *this;
}

InputFiles& InputFiles::mesh(const std::string& path) {
    if (path.empty()) return *this;
    for (const std::filesystem::path& file : geometry::files_of_mesh(path)) list_.push_back(file.string());
    if (document::is_document_name(path))
        for (const std::string& file : made_from(path)) list_.push_back(file);
    return *this;
}

InputFiles& InputFiles::world(const std::string& path) {
    if (path.empty()) return *this;
    for (const std::filesystem::path& file : scene::files_of_world(path)) list_.push_back(file.string());
    return *this;
}

InputFiles& InputFiles::tool(const std::string& tool) {
    constexpr std::string_view kOfAFile = "mesh:";
    return tool.starts_with(kOfAFile) ? mesh(tool.substr(kOfAFile.size())) : *this;
}

InputFiles& InputFiles::device(const std::string& name) {
    const std::size_t colon = name.find(':');
    return colon == std::string::npos ? *this : file(name.substr(colon + 1));
}

InputFiles& InputFiles::script(const std::string& path) {
    file(path);
    if (path.empty() || is_database(path)) return *this;
    if (const Result<InputLog> log = read_input_log(path))
        for (const toolbox::ToolSpec& tool : tools_in(*log)) mesh(tool.file);
    return *this;
}

InputFiles inputs_of(const SessionSetup& options) {
    InputFiles inputs;
    const std::string& workpiece = options.carve.workpiece.source;
    const bool is_a_shape = workpiece.starts_with("block:") || workpiece.starts_with("ball:");
    if (!options.scene.no_workpiece && !is_a_shape) inputs.mesh(workpiece);
    inputs.world(options.scene.world).tool(options.hands.tool.shape).file(options.carve.stroke.file);
    inputs.script(options.record.input).file(options.record.path).file(options.desk.wall).device(options.hands.device);
    for (const NamedDevice& hand : options.hands.named) inputs.device(hand.device);
    for (const toolbox::ToolSpec& tool : options.record.tools_of_input) inputs.mesh(tool.file);
    return inputs;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    if (a.empty() || b.empty()) return false;
    std::error_code ignored;
    if (std::filesystem::equivalent(a, b, ignored)) return true;
    const auto place_a = resolved_path(a), place_b = resolved_path(b);
    return place_a && place_b && *place_a == *place_b;
}

}  // namespace burin::session
