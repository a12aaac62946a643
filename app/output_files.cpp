// SPDX-License-Identifier: MIT
#include "app/output_files.hpp"

#include <cstdio>
#include <filesystem>
#include <set>
#include <vector>

#include "app/recorded_files.hpp"
#include "base/file_io.hpp"
#include "geometry/files/mesh_export.hpp"

namespace burin::app {
namespace fs = std::filesystem;
namespace {

// Returns whether both are one file, by whatever path; a file that is still to be made counts as well.
bool is_same_place(const std::string& output, const std::string& input) {
    std::error_code ignored;
    const bool same_name =
        !input.empty() && fs::weakly_canonical(output, ignored) == fs::weakly_canonical(input, ignored);
    return same_name || fs::equivalent(output, input, ignored);
}

}  // namespace

Result<void> check_place(const std::string& path) {
    if (path.empty() || path == kStandardOutput) return {};
    return check_writable(path);
}

Result<void> check_overwrites_none(const std::string& output, std::span<const std::string> inputs) {
    constexpr const char* kRemedy = "choose another place";
    for (const std::string& input : inputs)
        if (is_same_place(output, input))
            return fail(output, "is another file of this command, which it would overwrite", kRemedy);
    for (const std::string& input : inputs)
        for (const std::string& named : files_named_by(input))
            if (is_same_place(output, named))
                return fail(output,
                            "is a file of the recording " + input + ", which could not be done again without it",
                            kRemedy);
    return {};
}

Result<void> check_outputs(std::span<const std::string> exports, const std::string& report,
                           std::span<const std::string> inputs) {
    for (const std::string& path : exports) {
        const auto format = geometry::mesh_format_of(path);
        if (!format || *format == geometry::MeshFormat::off) {
            return fail(path, "has no extension that Burin exports", "name it .stl, .ply or .obj");
        }
        if (const auto ok = check_place(path); !ok) return ok;
    }
    if (const auto ok = check_place(report); !ok) return ok;
    std::vector<std::string> outputs(exports.begin(), exports.end());
    if (!report.empty()) outputs.push_back(report);
    std::set<fs::path> places;
    for (const std::string& path : outputs) {
        if (const auto ok = check_overwrites_none(path, inputs); !ok) return ok;
        if (!places.insert(fs::weakly_canonical(path)).second)
            return fail(path, "is named for two outputs, of which one would overwrite the other", "give each its own");
    }
    return {};
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
