// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_files.hpp"

#include <fstream>
#include <set>

#include "base/file_io.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/mesh_pictures.hpp"
#include "geometry/files/named_file.hpp"
#include "geometry/files/ply_header.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {

std::vector<std::string> material_file_names(std::string_view names) {
    std::vector<std::string> found;
    while (!names.empty()) {
        const std::size_t begin = names.find_first_not_of(" \t");
        if (begin == std::string_view::npos || names[begin] == '#') break;
        const bool is_quoted = names[begin] == '"' && names.find('"', begin + 1) != std::string_view::npos;
        const std::size_t first = is_quoted ? begin + 1 : begin;
        const std::size_t end = std::min(names.find_first_of(is_quoted ? "\"" : " \t", first), names.size());
        found.emplace_back(names.substr(first, end - first));
        names.remove_prefix(std::min(is_quoted ? end + 1 : end, names.size()));
    }
    return found;
}

namespace {

namespace fs = std::filesystem;

// Adds the places in which a reader looks for a file of any of these names.
void add_places(const fs::path& folder, const std::vector<std::string>& names, std::vector<fs::path>& files) {
    for (const fs::path name : names) {
        files.push_back(file_named(folder, name));
        if (name.filename() != name && !name.filename().empty()) files.push_back(file_named(folder, name.filename()));
    }
}

// Adds the pictures that a material file names.
void add_pictures(const fs::path& materials, const fs::path& folder, std::vector<fs::path>& files) {
    const Result<std::string> text = read_text_file(materials, kMaxMaterialFileBytes);
    if (!text) return;
    for (TextScanner scan(*text); !scan.at_end(); scan.next_line())
        if (equals_ignoring_case(scan.token_in_line(), "map_kd"))
            add_places(folder, picture_use(scan.rest_of_line()).names, files);
}

void add_files_of_obj(const fs::path& path, std::vector<fs::path>& files) {
    const Result<std::string> text = read_text_file(path);
    if (!text) return;
    std::set<std::string_view> libraries;
    for (TextScanner scan(*text); !scan.at_end() && libraries.size() < kMostMaterialFiles; scan.next_line()) {
        if (!equals_ignoring_case(scan.token_in_line(), "mtllib")) continue;
        const std::string_view names = scan.rest_of_line();
        if (!libraries.insert(names).second) continue;
        add_places(path.parent_path(), names_in(names), files);
        const std::vector<std::string> words = material_file_names(names);
        if (words.size() > 1) add_places(path.parent_path(), words, files);
    }
    const std::set<fs::path> materials(files.begin() + 1, files.end());
    for (const fs::path& file : materials) add_pictures(file, path.parent_path(), files);
}

void add_files_of_ply(const fs::path& path, std::vector<fs::path>& files) {
    constexpr std::size_t kMostHeaderBytes = 64 << 10;
    std::string text(kMostHeaderBytes, '\0');
    std::ifstream in(path, std::ios::binary);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    const Result<PlyHeader> header = read_ply_header(text, path.string());
    if (!header) return;
    for (const std::string& statement : header->pictures) add_places(path.parent_path(), names_in(statement), files);
}

}  // namespace

std::vector<fs::path> files_of_mesh(const fs::path& path) {
    std::vector<fs::path> files{path};
    const auto format = mesh_format_of(path);
    if (format == MeshFormat::obj) add_files_of_obj(path, files);
    if (format == MeshFormat::ply) add_files_of_ply(path, files);
    return files;
}

}  // namespace burin::geometry
