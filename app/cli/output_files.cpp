// SPDX-License-Identifier: MIT
#include "app/cli/output_files.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "app/cli/recorded_files.hpp"
#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_export.hpp"
#include "session/felt/felt_figures.hpp"
#include "session/record/input_files.hpp"

namespace burin::app {
namespace fs = std::filesystem;

Result<void> check_place(const std::string& path) {
    if (path.empty() || path == kStandardOutput) return {};
    return check_writable(path);
}

Result<void> make_folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    if (path == kStandardOutput || folder.empty()) return {};
    std::error_code error;
    fs::create_directories(folder, error);
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) return {};
    return fail(path, "cannot be written: folder " + folder.string() + " cannot be made (" + error.message() + ")",
                "choose another place");
}

namespace {

// A report that is written as a file, since others lie beside it or a table goes to standard output: "-" would become
// the name of one.
Result<void> check_is_a_file(const std::string& report) {
    if (report != kStandardOutput) return {};
    return fail("--report -", "cannot go to standard output, where a table goes", "name a file");
}

}  // namespace

Result<void> check_overwrites_none(const std::string& output, std::span<const std::string> inputs) {
    for (const std::string& input : inputs) {
        if (!session::is_same_file(output, input)) continue;
        const bool is_named_so = fs::path(output).lexically_normal() == fs::path(input).lexically_normal();
        return fail(output,
                    "is a file that this command reads, and would be overwritten" +
                        (is_named_so ? std::string() : ": " + input),
                    "choose another place");
    }
    for (const std::string& input : inputs)
        for (const std::string& named : files_named_by(input))
            if (session::is_same_file(output, named))
                return fail(output,
                            "is a file of the recording " + input + ", which could not be done again without it",
                            "choose another place");
    return {};
}

Result<void> check_places(std::span<const std::string> outputs, std::span<const std::string> inputs) {
    std::vector<std::string> before;
    for (const std::string& path : outputs) {
        if (path.empty() || path == kStandardOutput) continue;
        BURIN_TRY_DO(check_place(path));
        BURIN_TRY_DO(check_overwrites_none(path, inputs));
        for (const std::string& other : before)
            if (session::is_same_file(path, other))
                return fail(path, "is named for two outputs, of which one would overwrite the other",
                            "give each its own");
        before.push_back(path);
    }
    return {};
}

Result<void> check_outputs(std::span<const std::string> exports, const std::string& report,
                           std::span<const std::string> inputs) {
    for (const std::string& path : exports) {
        const auto format = geometry::mesh_format_of(path);
        if (!format || *format == geometry::MeshFormat::off) {
            return fail(path.empty() ? "\"\"" : path, "has no extension that Burin exports",
                        "name it .stl, .ply or .obj");
        }
    }
    BURIN_TRY_DO(check_is_a_file(report));
    std::vector<std::string> outputs(exports.begin(), exports.end());
    outputs.push_back(report);
    return check_places(outputs, inputs);
}

Result<void> check_felt_report(const std::string& report, std::span<const std::string> inputs) {
    if (report.empty()) return {};
    BURIN_TRY_DO(check_is_a_file(report));
    return check_places(std::array{report, session::felt_figure_path(report), session::felt_table_path(report),
                                   session::felt_depth_path(report)},
                        inputs);
}

Result<void> write_output(const std::string& path, const std::string& text) {
    if (path.empty()) return {};
    if (path != kStandardOutput) return write_text(path, text);
    std::fputs(text.c_str(), stdout);
    return {};
}

Result<void> write_text(const std::string& path, const std::string& text) {
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> write_report(const std::string& path, const Json& report) { return write_text(path, json_text(report)); }

}  // namespace burin::app
