// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_export.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/mesh/distinct_positions.hpp"
#include "geometry/mesh/vertex_weld.hpp"

namespace burin::geometry {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are written as the machine's own numbers");

class Bytes {
public:
    template <typename T>
    void put(const T& value) {
        const auto* raw = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), raw, raw + sizeof(T));
    }
    void put_text(std::string_view text) {
        const auto* raw = reinterpret_cast<const std::byte*>(text.data());
        bytes_.insert(bytes_.end(), raw, raw + text.size());
    }
    template <typename Number>
    void put_number(Number value) {  // shortest text that reads back as the same value
        std::array<char, 32> digits;
        const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
        put_text({digits.data(), static_cast<std::size_t>(end - digits.data())});
    }
    void put_point(const Vec3f& p) {
        for (int k = 0; k < 3; ++k) put(p[k]);
    }
    void reserve(std::size_t n) { bytes_.reserve(n); }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

Result<void> check(const TriangleMesh& mesh, MeshFormat format, const std::string& name, LengthUnit unit) {
    if (format == MeshFormat::off) return fail(name, "OFF is read but not written", "name it .stl, .ply or .obj");
    if (mesh.triangles.empty()) return fail(name, "there are no triangles to write", "nothing was written");
    if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
        return fail(name, "there are more triangles than the format can count", "choose a lower resolution");
    }
    for (const auto& t : mesh.triangles) {
        if (std::ranges::any_of(t, [&](std::uint32_t v) { return v >= mesh.positions_m.size(); })) {
            return fail(name, "the mesh has a triangle without its vertices", "report this fault; nothing was written");
        }
    }
    const double limit =
        format == MeshFormat::obj ? std::numeric_limits<double>::max() : double{std::numeric_limits<float>::max()};
    for (const Vec3& p : mesh.positions_m) {
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(from_metres(p[k], unit)) <= limit)) {
                return fail(name, "the mesh has a coordinate that the format cannot hold", "nothing was written");
            }
        }
    }
    return {};
}

// Returns the unit normal, or zero for a triangle without area, as the format asks.
Vec3f normal_of(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = glm::cross(b - a, c - a);
    const double length = glm::length(n);
    return length > 0.0 && std::isfinite(length) ? Vec3f(n / length) : Vec3f(0.0f);
}

std::vector<std::byte> encode_stl(const TriangleMesh& mesh, LengthUnit unit) {
    Bytes out;
    out.reserve(84 + 50 * mesh.triangles.size());
    std::array<char, 80> header{};  // must not begin with "solid", or readers take it for text
    const std::string title = std::string("binary STL by Burin, UNITS=") + name_of(unit);
    std::ranges::copy(title, header.begin());
    out.put(header);
    out.put(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& t : mesh.triangles) {
        const Vec3 &a = mesh.positions_m[t[0]], &b = mesh.positions_m[t[1]], &c = mesh.positions_m[t[2]];
        out.put_point(normal_of(a, b, c));
        for (const Vec3* p : {&a, &b, &c}) out.put_point(Vec3f(*p));
        out.put(std::uint16_t{0});
    }
    return out.take();
}

std::vector<std::byte> encode_ply(const TriangleMesh& mesh, LengthUnit unit, const FileColours& colours) {
    const bool of_vertices = !colours.of_vertices.empty(), of_faces = !colours.of_faces.empty();
    constexpr std::string_view kColourProperties = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    Bytes out;
    out.reserve(512 + 15 * mesh.positions_m.size() + 16 * mesh.triangles.size());
    out.put_text("ply\nformat binary_little_endian 1.0\ncomment by Burin\ncomment " + comment_of(unit) +
                 "\nelement vertex ");
    out.put_number(mesh.positions_m.size());
    out.put_text("\nproperty float x\nproperty float y\nproperty float z\n");
    if (of_vertices) out.put_text(kColourProperties);
    out.put_text("element face ");
    out.put_number(mesh.triangles.size());
    out.put_text("\nproperty list uchar int vertex_indices\n");
    if (of_faces) out.put_text(kColourProperties);
    out.put_text("end_header\n");
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
        out.put_point(Vec3f(mesh.positions_m[v]));
        if (of_vertices) out.put(colours.of_vertices[v]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        out.put(std::uint8_t{3});
        out.put(mesh.triangles[t]);
        if (of_faces) out.put(colours.of_faces[t]);
    }
    return out.take();
}

std::size_t digits_of(double value) {
    std::array<char, 32> text;
    return static_cast<std::size_t>(std::to_chars(text.data(), text.data() + text.size(), value).ptr - text.data());
}

// Converts a length to a number of the file that reads back as the same bits, the one with the fewest digits; so a
// file's 12.3 mm are 12.3 again and not 12.300000000000002. Reading and writing round twice each, so such a number, if
// there is one, is at most the second beside the quotient; without one the quotient is as good.
double shortest_in_unit(double length_m, LengthUnit unit) {
    const double quotient = from_metres(length_m, unit);
    if (unit == LengthUnit::m || quotient == 0.0 || !std::isfinite(quotient)) return quotient;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::optional<double> best;
    double number = std::nextafter(std::nextafter(quotient, -kInfinity), -kInfinity);
    for (int i = 0; i < 5; ++i, number = std::nextafter(number, kInfinity)) {
        if (to_metres(number, unit) != length_m) continue;
        if (!best || digits_of(number) < digits_of(*best)) best = number;
    }
    return best.value_or(quotient);
}

// A number that is read as the same byte again.
float part_of_255(std::uint8_t channel) { return static_cast<float>(channel) / 255.0f; }

std::string material_name(const Colour& colour) {
    std::array<char, 16> name{};
    std::snprintf(name.data(), name.size(), "colour_%02x%02x%02x", colour[0], colour[1], colour[2]);
    return name.data();
}

std::string encode_materials(std::vector<Colour> colours) {
    std::ranges::sort(colours);
    const auto repeated = std::ranges::unique(colours);
    colours.erase(repeated.begin(), repeated.end());
    Bytes out;
    out.put_text("# by Burin\n");
    for (const Colour& colour : colours) {
        out.put_text("newmtl " + material_name(colour) + "\nKd");
        for (const std::uint8_t channel : colour) {
            out.put_text(" ");
            out.put_number(part_of_255(channel));
        }
        out.put_text("\n");
    }
    const std::vector<std::byte> bytes = out.take();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// `materials` names the file of the colours of faces.
std::vector<std::byte> encode_obj(const TriangleMesh& mesh, LengthUnit unit, const FileColours& colours,
                                  const std::string& materials) {
    Bytes out;
    out.put_text("# by Burin\n# " + comment_of(unit) + "\n");
    if (!colours.of_faces.empty()) out.put_text("mtllib " + materials + "\n");
    for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
        out.put_text("v");
        for (int k = 0; k < 3; ++k) {
            out.put_text(" ");
            out.put_number(mesh.positions_m[v][k]);
        }
        for (std::size_t k = 0; k < 3 && !colours.of_vertices.empty(); ++k) {
            out.put_text(" ");
            out.put_number(part_of_255(colours.of_vertices[v][k]));
        }
        out.put_text("\n");
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const bool has_colour = !colours.of_faces.empty();
        if (has_colour && (t == 0 || colours.of_faces[t] != colours.of_faces[t - 1]))
            out.put_text("usemtl " + material_name(colours.of_faces[t]) + "\n");
        out.put_text("f");
        for (const std::uint32_t v : mesh.triangles[t]) {
            out.put_text(" ");
            out.put_number(std::uint64_t{v} + 1);
        }
        out.put_text("\n");
    }
    return out.take();
}

// Rounds the mesh's positions, of which equal ones stay equal and different ones different.
void round_to_floats(FileNumbers& numbers, LengthUnit unit) {
    std::vector<Vec3> different;
    std::vector<std::uint32_t> index;
    VertexWeld weld(different);
    for (const Vec3& p : numbers.mesh.positions_m) index.push_back(weld.index_of(p));
    std::vector<Vec3f> rounded;
    for (const Vec3& p : different) {
        rounded.emplace_back(from_metres(p, unit));
        numbers.is_rounded = numbers.is_rounded || Vec3(rounded.back()) != p;
    }
    const auto fall_together = [&](std::uint32_t a, std::uint32_t b) {
        return index[a] != index[b] && rounded[index[a]] == rounded[index[b]];
    };
    numbers.without_area = static_cast<std::size_t>(std::ranges::count_if(numbers.mesh.triangles, [&](const auto& t) {
        return fall_together(t[0], t[1]) || fall_together(t[1], t[2]) || fall_together(t[2], t[0]);
    }));
    numbers.steps_apart = make_distinct(rounded);
    for (std::size_t v = 0; v < index.size(); ++v) numbers.mesh.positions_m[v] = Vec3(rounded[index[v]]);
}

MeshFiles encode(const TriangleMesh& numbers, MeshFormat format, const std::filesystem::path& path, LengthUnit unit,
                 std::span<const TriangleColours> corners) {
    if (format == MeshFormat::stl) return {encode_stl(numbers, unit), {}};
    const FileColours colours = file_colours(numbers, corners);
    if (format == MeshFormat::ply) return {encode_ply(numbers, unit, colours), {}};
    const std::string materials = material_file_of(path).filename().string();
    return {encode_obj(numbers, unit, colours, materials),
            colours.of_faces.empty() ? std::string() : encode_materials(colours.of_faces)};
}

// The materials come first: an OBJ never names a file that is not there.
Result<void> write_files(const MeshFiles& files, const std::filesystem::path& path) {
    if (!files.materials.empty()) {
        const auto bytes = std::as_bytes(std::span(files.materials));
        BURIN_TRY_DO(write_file_atomically(material_file_of(path), bytes));
    }
    return write_file_atomically(path, files.mesh);
}

Result<MeshFormat> format_of(const std::filesystem::path& path) {
    const auto format = mesh_format_of(path);
    if (!format) return fail(path.string(), "has an extension that is not a mesh format", "name it .stl, .ply or .obj");
    return *format;
}

}  // namespace

FileNumbers numbers_of_file(const TriangleMesh& mesh_m, MeshFormat format, LengthUnit unit) {
    FileNumbers numbers{mesh_m};
    if (format != MeshFormat::obj) {
        round_to_floats(numbers, unit);
        return numbers;
    }
    for (Vec3& p : numbers.mesh.positions_m) {
        for (int k = 0; k < 3; ++k) p[k] = shortest_in_unit(p[k], unit);
    }
    numbers.is_rounded = unit != LengthUnit::m;
    return numbers;
}

std::filesystem::path material_file_of(const std::filesystem::path& obj) {
    return std::filesystem::path(obj).replace_extension(".mtl");
}

Result<MeshFiles> encode_mesh(const TriangleMesh& mesh, MeshFormat format, const std::string& name, LengthUnit unit,
                              std::span<const TriangleColours> corners) {
    BURIN_TRY_DO(check(mesh, format, name, unit));
    return encode(numbers_of_file(mesh, format, unit).mesh, format, name, unit, corners);
}

Result<void> export_numbers(const TriangleMesh& numbers, const std::filesystem::path& path, LengthUnit unit,
                            std::span<const TriangleColours> corners) {
    BURIN_TRY(format, format_of(path));
    BURIN_TRY_DO(check(numbers, format, path.string(), LengthUnit::m));
    return write_files(encode(numbers, format, path, unit, corners), path);
}

Result<void> export_mesh(const TriangleMesh& mesh, const std::filesystem::path& path, LengthUnit unit) {
    BURIN_TRY(format, format_of(path));
    BURIN_TRY(files, encode_mesh(mesh, format, path.string(), unit));
    return write_files(files, path);
}

}  // namespace burin::geometry
