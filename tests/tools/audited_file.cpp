// SPDX-License-Identifier: MIT
#include "tests/tools/audited_file.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mesh_audit {

namespace {

std::string lower_extension(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    std::string extension = dot == std::string::npos ? "" : path.substr(dot + 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension;
}

std::uint32_t little_endian_32(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

// Binary files may begin with "solid" as well; only the length tells.
bool has_binary_stl_length(std::string_view content) {
    return content.size() >= 84 && content.size() == 84 + std::uint64_t{50} * little_endian_32(content.data() + 80);
}

std::uint64_t hash_of(const Point& p) {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const double value : {p.x, p.y, p.z}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0xff51afd7ed558ccdu;
        hash ^= hash >> 32;
    }
    return hash;
}

bool same_bits(const Point& a, const Point& b) { return std::memcmp(&a, &b, sizeof(Point)) == 0; }

}  // namespace

bool append_face(Mesh& mesh, const std::vector<std::uint64_t>& corners) {
    for (const std::uint64_t corner : corners) {
        if (corner >= mesh.points.size()) return false;
    }
    for (std::size_t i = 2; i < corners.size(); ++i) {
        mesh.triangles.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[i - 1]),
                                  static_cast<std::uint32_t>(corners[i])});
    }
    return true;
}

void weld_by_bits(Mesh& mesh) {
    const std::vector<Point> soup = std::move(mesh.points);
    mesh.points.clear();
    mesh.triangles.assign(soup.size() / 3, Triangle{});
    constexpr std::uint32_t kFree = ~std::uint32_t{0};
    std::vector<std::uint32_t> table(std::bit_ceil(std::max<std::size_t>(16, soup.size())), kFree);
    const std::size_t mask = table.size() - 1;  // a closed mesh has six corners a point, so the table stays sparse
    for (std::size_t corner = 0; corner < soup.size(); ++corner) {
        std::size_t at = hash_of(soup[corner]) & mask;
        while (table[at] != kFree && !same_bits(mesh.points[table[at]], soup[corner])) at = (at + 1) & mask;
        if (table[at] == kFree) {
            table[at] = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(soup[corner]);
        }
        mesh.triangles[corner / 3][corner % 3] = table[at];
    }
}

Reading read_mesh(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return {{}, {"is not there, or not a file"}};
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) return {{}, {"cannot be read"}};
    std::string content(static_cast<std::size_t>(size), '\0');
    file.seekg(0);
    if (!file.read(content.data(), size)) return {{}, {"cannot be read"}};

    const std::string extension = lower_extension(path);
    Reading reading;
    if (extension == "stl") {
        reading = has_binary_stl_length(content) || !content.starts_with("solid") ? read_binary_stl(content)
                                                                                  : read_ascii_stl(content);
    } else if (extension == "ply") {
        reading = read_ply(content);
    } else if (extension == "obj") {
        reading = read_obj(content);
    } else if (extension == "off") {
        reading = read_off(content);
    } else {
        return {{}, {"has an unknown ending; known are .stl, .ply, .obj, .off"}};
    }
    if (reading.failure.message.empty() && reading.mesh.triangles.empty()) {
        reading.failure.message = "holds no triangle";
    }
    return reading;
}

}  // namespace mesh_audit
