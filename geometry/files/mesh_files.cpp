// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_files.hpp"

#include "base/file_io.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/obj_pictures.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {

std::vector<std::string_view> material_file_names(std::string_view names) {
    std::vector<std::string_view> words;
    TextScanner scan(names);
    for (auto word = scan.token_in_line(); !word.empty(); word = scan.token_in_line()) words.push_back(word);
    return words;
}

namespace {

// Adds the pictures that a material file names, as the reader looks for them.
void add_pictures(const std::filesystem::path& materials, const std::filesystem::path& folder,
                  std::vector<std::filesystem::path>& files) {
    const Result<std::string> text = read_text_file(materials);
    if (!text) return;
    for (TextScanner scan(*text); !scan.at_end(); scan.next_line()) {
        if (!equals_ignoring_case(scan.token_in_line(), "map_kd")) continue;
        const std::filesystem::path name = picture_named(scan.rest_of_line());
        if (name.empty()) continue;
        files.push_back(folder / name);
        files.push_back(folder / name.filename());
    }
}

}  // namespace

std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    if (mesh_format_of(path) != MeshFormat::obj) return files;
    const Result<std::string> text = read_text_file(path);
    if (!text) return files;
    for (TextScanner scan(*text); !scan.at_end(); scan.next_line()) {
        if (!equals_ignoring_case(scan.token_in_line(), "mtllib")) continue;
        const std::string_view names = scan.rest_of_line();
        if (names.empty()) continue;
        files.push_back(path.parent_path() / names);
        const std::vector<std::string_view> words = material_file_names(names);
        if (words.size() < 2) continue;
        for (const std::string_view word : words) files.push_back(path.parent_path() / word);
    }
    const std::vector<std::filesystem::path> materials(files.begin() + 1, files.end());
    for (const std::filesystem::path& file : materials) add_pictures(file, path.parent_path(), files);
    return files;
}

}  // namespace burin::geometry
