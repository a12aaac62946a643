// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_files.hpp"

#include "base/file_io.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {

std::vector<std::string_view> material_file_names(std::string_view names) {
    std::vector<std::string_view> words;
    TextScanner scan(names);
    for (auto word = scan.token_in_line(); !word.empty(); word = scan.token_in_line()) words.push_back(word);
    return words;
}

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
    return files;
}

}  // namespace burin::geometry
