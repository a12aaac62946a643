// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_files.hpp"

#include <algorithm>
#include <string_view>

#include "base/file_io.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

// Returns the name behind `mtllib`; empty where the line is another.
std::string_view material_file_on(std::string_view line) {
    constexpr std::string_view kKeyword = "mtllib", kBlanks = " \t";
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (line.size() <= kKeyword.size() || !equals_ignoring_case(line.substr(0, kKeyword.size()), kKeyword)) return {};
    line.remove_prefix(kKeyword.size());
    const std::size_t begin = line.find_first_not_of(kBlanks);
    if (begin == 0 || begin == std::string_view::npos) return {};
    return line.substr(begin, line.find_last_not_of(kBlanks) - begin + 1);
}

}  // namespace

std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    if (mesh_format_of(path) != MeshFormat::obj) return files;
    const Result<std::string> text = read_text_file(path);
    if (!text) return files;
    for (std::size_t at = 0; at < text->size();) {
        const std::size_t end = std::min(text->find('\n', at), text->size());
        if (const auto name = material_file_on(std::string_view(*text).substr(at, end - at)); !name.empty())
            files.push_back(path.parent_path() / name);
        at = end + 1;
    }
    return files;
}

}  // namespace burin::geometry
