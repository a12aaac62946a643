// SPDX-License-Identifier: MIT
#include "app/output_files.hpp"

#include <unistd.h>

#include <filesystem>

#include "geometry/file_io.hpp"
#include "geometry/mesh_export.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

Result<void> check_outputs(std::span<const std::string> exports, const std::string& report) {
    for (const std::string& path : exports) {
        const auto format = mesh_format_of(path);
        if (!format || *format == MeshFormat::off) {
            return fail(path, "has no extension that Burin exports", "name it .stl, .ply or .obj");
        }
        if (const auto ok = check_output(path); !ok) return ok;
    }
    if (!report.empty()) return check_output(report);
    return {};
}

Result<void> check_precision(std::span<const std::string> exports, const Lattice& lattice) {
    for (const std::string& path : exports) {
        if (lattice.fits_floats() || mesh_format_of(path) == MeshFormat::obj) continue;
        return fail(path,
                    "would hold single-precision numbers, which cannot tell the workpiece's details apart so far from "
                    "its origin",
                    "move the workpiece nearer to its origin, or export .obj");
    }
    return {};
}

Result<void> write_text(const std::string& path, const std::string& text) {
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<void> write_report(const std::string& path, const Json& report) {
    return write_text(path, report.dump(2) + "\n");
}

}  // namespace burin
