// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_import.hpp"

#include <algorithm>

#include "base/file_io.hpp"
#include "base/try.hpp"
#include "geometry/files/mesh_files.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/named_file.hpp"
#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

constexpr std::uint64_t kMostPictureBytes = 256 << 20;

Result<MeshSoup> read(std::span<const std::byte> bytes, MeshFormat format, const std::string& name,
                      const MaterialFileReader& material_files, const MaterialFileReader& pictures) {
    if (format == MeshFormat::stl) return read_stl(bytes, name);            // tells itself whether it is text
    if (format == MeshFormat::ply) return read_ply(bytes, name, pictures);  // begins with text
    BURIN_TRY(text, utf8_text(text_of(bytes), name));
    return format == MeshFormat::obj ? read_obj(text, name, material_files, pictures) : read_off(text, name);
}

// Holds the format that a file's content looks like, whatever its name says.
struct Likeness {
    MeshFormat format;
    const char *what, *extension;
};

std::optional<Likeness> looks_like(std::span<const std::byte> bytes) {
    if (is_binary_stl(bytes)) return Likeness{MeshFormat::stl, "binary STL", ".stl"};
    TextScanner scan(text_of(bytes).substr(0, 512));
    const std::string_view first = scan.token('#');
    const std::string_view second = scan.token('#');
    if (equals_ignoring_case(first, "ply")) return Likeness{MeshFormat::ply, "PLY", ".ply"};
    if (equals_ignoring_case(first, "solid")) return Likeness{MeshFormat::stl, "ASCII STL", ".stl"};
    if (first.size() >= 3 && equals_ignoring_case(first.substr(first.size() - 3), "off") && first.size() <= 7)
        return Likeness{MeshFormat::off, "OFF", ".off"};
    const bool is_obj =
        equals_ignoring_case(first, "mtllib") || (equals_ignoring_case(first, "v") && number_from(second).has_value());
    return is_obj ? std::optional(Likeness{MeshFormat::obj, "OBJ", ".obj"}) : std::nullopt;
}

MaterialFileReader files_beside(const std::filesystem::path& obj) {
    return [folder = obj.parent_path()](std::string_view name) -> Result<std::string> {
        const std::filesystem::path named(name);
        Result<std::string> text = read_text_file(file_named(folder, named), kMaxMaterialFileBytes);
        if (text || named.filename() == named || named.filename().empty()) return text;
        // The path may be one of another machine.
        Result<std::string> beside = read_text_file(file_named(folder, named.filename()), kMaxMaterialFileBytes);
        return beside ? std::move(beside) : std::move(text);
    };
}

// Reads pictures of the mesh's folder and below it, through no link that leads out: the file may be a stranger's.
MaterialFileReader pictures_below(const std::filesystem::path& mesh) {
    return [folder = mesh.parent_path()](std::string_view name) -> Result<std::string> {
        constexpr const char* kRemedy = "copy that file into the mesh's folder and name it without a path";
        const std::filesystem::path below = std::filesystem::path(name).lexically_normal();
        if (below.empty() || below.is_absolute() || *below.begin() == "..")
            return fail(std::string(name), "is not in the mesh's folder", kRemedy);
        std::error_code code;
        const auto top = std::filesystem::canonical(folder.empty() ? std::filesystem::path(".") : folder, code);
        const std::filesystem::path found = file_named(top, below);
        const auto real = std::filesystem::weakly_canonical(found, code);
        if (std::ranges::mismatch(top, real).in1 != top.end())
            return fail(std::string(name), "is a link that leads out of the mesh's folder", kRemedy);
        const Result<std::vector<std::byte>> bytes = read_file(found, kMostPictureBytes);
        if (!bytes) return fail(std::string(name), bytes.error().what, bytes.error().remedy);
        return std::string(text_of(*bytes));
    };
}

}  // namespace

std::optional<MeshFormat> mesh_format_of(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (equals_ignoring_case(extension, ".stl")) return MeshFormat::stl;
    if (equals_ignoring_case(extension, ".obj")) return MeshFormat::obj;
    if (equals_ignoring_case(extension, ".ply")) return MeshFormat::ply;
    if (equals_ignoring_case(extension, ".off")) return MeshFormat::off;
    return std::nullopt;
}

Result<ImportedMesh> import_mesh(const std::filesystem::path& path, std::optional<LengthUnit> given_unit,
                                 MeshOrigin origin) {
    const std::string name = path.string();
    const auto format = mesh_format_of(path);
    if (name.empty()) return fail("\"\"", "names no file", "name one, or leave the option out");
    if (!format) {
        // Reports a folder or a missing file rather than a wrong extension.
        std::error_code ignored;
        if (std::filesystem::is_directory(path, ignored)) return fail(name, "is a folder", "name a file inside it");
        if (!std::filesystem::exists(path, ignored)) return fail(name, "does not exist", "check the path");
        return fail(name, "has an extension that is not a mesh format", "convert it to .stl, .obj, .ply or .off");
    }
    BURIN_TRY(bytes, read_file(path));
    return import_mesh(bytes, *format, name, files_beside(path), given_unit, pictures_below(path), origin);
}

Result<ImportedMesh> import_mesh(std::span<const std::byte> bytes, MeshFormat format, const std::string& name,
                                 const MaterialFileReader& material_files, std::optional<LengthUnit> given_unit,
                                 const MaterialFileReader& pictures, MeshOrigin origin) {
    if (bytes.empty()) return fail(name, "is empty", "export it again");
    Result<MeshSoup> soup = read(bytes, format, name, material_files, pictures);
    Result<ImportedMesh> mesh = soup ? finished(std::move(*soup), name, given_unit, origin)
                                     : Result<ImportedMesh>(std::unexpected(soup.error()));
    if (mesh) return mesh;
    const std::optional<Likeness> other = looks_like(bytes);
    if (!other || other->format == format) return mesh;
    return fail(name, std::string("is ") + other->what + " by another name",
                std::string("rename it to end in ") + other->extension);
}

}  // namespace burin::geometry
