// SPDX-License-Identifier: MIT
// Reads OBJ: v (with w, or with a colour: x y z r g b, and perhaps its alpha), f (and the old fo) with positive or
// negative indices, usemtl, mtllib, and vt where a material names a picture. A face may name a vertex that comes later.
// Normals, groups and smoothing are skipped silently, since they do not change the surface; lines, points, curves and
// free-form surfaces are counted in a remark. Of material files (MTL), of which a line may name several, see
// material_file.hpp. A comment near the beginning may state the unit.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "base/try.hpp"
#include "geometry/files/material_file.hpp"
#include "geometry/files/mesh_files.hpp"
#include "geometry/files/mesh_pictures.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/files/unit_statement.hpp"

namespace burin::geometry {
namespace {

constexpr char kObjComment = '#';
constexpr Vec2 kNoTexturePlace{std::numeric_limits<double>::quiet_NaN()};

// Keywords that do not change the surface's shape or colour.
constexpr std::string_view kSkipped[] = {"vt",     "vn",     "g",   "s",     "o",        "mg",
                                         "usemap", "maplib", "lod", "bevel", "c_interp", "d_interp"};

class ObjReader {
public:
    ObjReader(std::string_view text, const std::string& name, const MaterialFileReader& material_files,
              const MaterialFileReader& pictures)
        : text_(text), scan_(text), name_(name), material_files_(material_files), pictures_(pictures) {}

    Result<MeshSoup> read() {
        soup_.report.format = "OBJ";
        soup_.stated_unit = unit_in_comments(text_);
        for (; !scan_.at_end(); scan_.next_line()) {
            BURIN_TRY_DO(statement());
        }
        BURIN_TRY_DO(resolve_corners());
        BURIN_TRY_DO(resolve_colours());
        wear_materials();
        if (undefined_ > 0) {
            soup_.report.remarks.push_back(std::to_string(undefined_) +
                                           " materials are not defined and shown grey, the first is " +
                                           in_quotes(first_undefined_));
        }
        if (ignored_ > 0) {
            soup_.report.remarks.push_back(
                std::to_string(ignored_) + " statements other than polygons were ignored, the first (" +
                in_quotes(first_ignored_) + ") in line " + std::to_string(first_ignored_line_));
        }
        return std::move(soup_);
    }

private:
    using Done = Result<void>;

    std::unexpected<Error> wrong(const std::string& what,
                                 const char* remedy = "repair the file or export it again") const {
        return fail(at_line(name_, scan_.line()), what, remedy);
    }

    // Returns the next word of the statement. A backslash at the end of a line joins it with the next.
    std::string_view word() {
        for (;;) {
            std::string_view found = scan_.token_in_line(kObjComment);
            if (!found.ends_with('\\')) return found;
            found.remove_suffix(1);
            scan_.next_line();
            if (!found.empty() || scan_.at_end()) return found;
        }
    }

    Done statement() {
        const std::string_view keyword = word();
        if (keyword.empty()) return {};
        if (equals_ignoring_case(keyword, "v")) return vertex();
        if (equals_ignoring_case(keyword, "vt")) texture_place();
        if (equals_ignoring_case(keyword, "f") || equals_ignoring_case(keyword, "fo")) return face();
        if (equals_ignoring_case(keyword, "usemtl")) {
            use_material(scan_.rest_of_line());
        } else if (equals_ignoring_case(keyword, "mtllib")) {
            read_materials(scan_.rest_of_line());
        } else if (std::ranges::none_of(kSkipped, [&](auto known) { return equals_ignoring_case(keyword, known); })) {
            if (ignored_++ == 0) {
                first_ignored_ = keyword;
                first_ignored_line_ = scan_.line();
            }
        }
        while (!word().empty()) {
        }  // joined lines belong to the statement
        return {};
    }

    Done vertex() {
        std::array<double, 7> values{};
        std::size_t count = 0;
        for (std::string_view w = word(); !w.empty(); w = word()) {
            const auto value = number_from(w);
            if (!value) return wrong(in_quotes(w) + " is not a number");
            if (count < 3 && coordinate_fault(*value) == nullptr) soup_.precision.see(w, *value);
            if (count == values.size()) return wrong("a vertex has more than 7 numbers");
            values[count++] = *value;
        }
        if (count < 3) return wrong("a vertex has fewer than 3 coordinates", kTruncatedRemedy);
        add_vertex(soup_, {values[0], values[1], values[2]}, scan_.line());
        if (count == values.size() && with_alpha_++ == 0) first_alpha_line_ = scan_.line();
        if (count >= 6) vertex_colour({values[3], values[4], values[5]});
        return {};
    }

    // Keeps the colour as it is: only the whole file tells whether colours run to 1 or to 255.
    void vertex_colour(const Vec3& colour) {
        scale_.see(colour);
        colours_.push_back(colour);
        colour_lines_.push_back(scan_.line());
    }

    Done face() {
        std::uint32_t corners = 0;
        for (std::string_view w = word(); !w.empty(); w = word(), ++corners) {
            BURIN_TRY_DO(corner(w.substr(0, w.find('/'))));
            texture_corner(w);
        }
        if (corners < 3) return wrong("a face has fewer than 3 corners", kTruncatedRemedy);
        soup_.corner_counts.push_back(corners);
        remember_face_material();
        return {};
    }

    Done corner(std::string_view w) {
        const auto index = integer_from<std::int64_t>(w);
        if (!index) return wrong(in_quotes(w) + " is not a vertex index");
        const auto known = static_cast<std::int64_t>(soup_.positions.size());
        if (*index == 0) return wrong("a face names vertex 0; OBJ counts from 1");
        if (*index < -known || *index > std::numeric_limits<std::uint32_t>::max()) {
            return wrong("a face names vertex " + std::to_string(*index) + ", but only " + std::to_string(known) +
                         " come before it");
        }
        const auto corner = static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index);
        if (corner > farthest_corner_ || farthest_line_ == 0) {
            farthest_corner_ = corner;
            farthest_line_ = scan_.line();
        }
        soup_.corners.push_back(corner);
        return {};
    }

    // ---- Pictures
    // What is wrong with texture coordinates is no error: the surface does not depend on them.

    void texture_place() {
        Vec2 place(0.0);
        for (int k = 0; k < 2; ++k) {
            const auto value = number_from(word());
            if (value && std::isfinite(*value) && std::abs(*value) <= kMaxCoordinate) place[k] = *value;
        }
        texture_places_.push_back(place);
    }

    void texture_corner(std::string_view w) {
        const std::size_t slash = w.find('/');
        const std::string_view behind = slash == std::string_view::npos ? "" : w.substr(slash + 1);
        const auto index = integer_from<std::int64_t>(behind.substr(0, behind.find('/')));
        const auto known = static_cast<std::int64_t>(texture_places_.size());
        texture_corners_.push_back(!index ? -1 : *index > 0 ? *index - 1 : *index < -known ? -1 : known + *index);
    }

    // Gives the corners of faces whose materials have pictures the colours of these.
    void wear_materials() {
        if (soup_.face_materials.empty()) return;
        WornFaces worn;
        std::vector<std::uint32_t> use_of_material;
        for (const ObjMaterial& material : materials_) {
            use_of_material.push_back(kNoPicture);
            if (material.picture.names.empty()) continue;
            use_of_material.back() = static_cast<std::uint32_t>(worn.uses.size());
            worn.uses.push_back(material.picture);
        }
        if (worn.uses.empty()) return;
        for (const std::uint32_t material : soup_.face_materials) worn.use_of_face.push_back(use_of_material[material]);
        for (const std::int64_t at : texture_corners_) {
            const bool is_known = at >= 0 && at < std::ssize(texture_places_);
            worn.places.push_back(is_known ? texture_places_[static_cast<std::size_t>(at)] : kNoTexturePlace);
        }
        wear_pictures(soup_, worn, pictures_);
    }

    Done resolve_corners() {
        if (soup_.corners.empty() || farthest_corner_ < soup_.positions.size()) return {};
        return fail(at_line(name_, farthest_line_),
                    "a face names vertex " + std::to_string(std::uint64_t{farthest_corner_} + 1) +
                        ", but there are only " + std::to_string(soup_.positions.size()),
                    "repair the file or export it again");
    }

    Done resolve_colours() {
        if (colours_.empty()) return {};
        if (with_alpha_ > 0) {
            soup_.report.remarks.push_back(std::to_string(with_alpha_) +
                                           " vertices have 7 numbers, the first in line " +
                                           std::to_string(first_alpha_line_) +
                                           ": 4 to 6 were taken for a colour, and the last for its alpha, ignored");
        }
        if (colours_.size() != soup_.positions.size()) {
            soup_.report.remarks.push_back("vertex colours were ignored: only " + std::to_string(colours_.size()) +
                                           " of " + std::to_string(soup_.positions.size()) + " vertices have one");
            return {};
        }
        soup_.colours.reserve(colours_.size());
        for (std::size_t v = 0; v < colours_.size(); ++v)
            soup_.colours.push_back(scale_.bytes_of(colours_[v], colour_lines_[v]));
        std::ranges::move(scale_.remarks("vertex colours"), std::back_inserter(soup_.report.remarks));
        return {};
    }

    void use_material(std::string_view name) { material_in_use_ = std::string(name); }

    // Records the material of the last face. Materials are numbered in the order of their first use; faces before any
    // usemtl get a plain one.
    void remember_face_material() {
        if (!material_in_use_) {
            if (soup_.face_materials.empty()) return;
            material_in_use_.emplace();
        }
        while (soup_.face_materials.size() + 1 < soup_.corner_counts.size())
            soup_.face_materials.push_back(number_of(""));
        soup_.face_materials.push_back(number_of(*material_in_use_));
    }

    std::uint32_t number_of(const std::string& material) {
        if (last_number_ && last_name_ == material) return *last_number_;
        const auto [entry, is_new] = numbers_.try_emplace(material, static_cast<std::uint32_t>(soup_.materials.size()));
        if (is_new) {
            const ObjMaterial* const known = material_named(library_, by_base_, material);
            if (known == nullptr && !material.empty()) {
                if (undefined_++ == 0) first_undefined_ = material;
            }
            materials_.push_back(known == nullptr ? ObjMaterial{} : *known);
            soup_.materials.push_back({material, materials_.back().colour});
        }
        last_name_ = material;
        last_number_ = entry->second;
        return entry->second;
    }

    // Reads the material files of a line, each once, however often it is named.
    void read_materials(std::string_view names) {
        if (libraries_.contains(names)) return;
        if (libraries_.size() >= kMostMaterialFiles) {
            if (!too_many_libraries_) soup_.report.remarks.emplace_back("further material files were ignored");
            too_many_libraries_ = true;
            return;
        }
        libraries_.emplace(names);
        if (!material_files_) {
            soup_.report.remarks.push_back("material file " + in_quotes(names) + " was not read");
            return;
        }
        // A name may hold blanks, and blanks may stand between names: one file of the whole name comes first.
        const std::vector<std::string> readings = names_in(names);
        for (const std::string& reading : readings)
            if (const Result<std::string> text = material_files_(reading)) return add_materials(*text, reading);
        const std::vector<std::string> files = material_file_names(names);
        if (files.size() > 1) {
            for (const std::string& file : files) read_materials(file);
            return;
        }
        const std::string named = readings.empty() ? "" : readings.back();
        soup_.report.remarks.push_back("material file ignored: " + material_files_(named).error().line());
    }

    void add_materials(std::string_view text, std::string_view file) {
        MaterialLibrary read = read_mtl(text, std::string(file));
        for (auto& [name, material] : read.materials) library_.insert_or_assign(name, std::move(material));
        std::ranges::move(read.remarks, std::back_inserter(soup_.report.remarks));
    }

    std::string_view text_;
    TextScanner scan_;
    const std::string& name_;
    const MaterialFileReader& material_files_;
    const MaterialFileReader& pictures_;
    MeshSoup soup_;
    std::vector<Vec2> texture_places_;
    std::vector<std::int64_t> texture_corners_;  // into these, for each corner; below 0: none
    std::vector<ObjMaterial> materials_;         // that the file uses, as the soup numbers them
    std::vector<Vec3> colours_;
    std::vector<std::uint64_t> colour_lines_;
    ColourScale scale_;
    std::uint64_t with_alpha_ = 0, first_alpha_line_ = 0;
    std::uint32_t farthest_corner_ = 0;
    std::uint64_t farthest_line_ = 0;
    std::uint64_t ignored_ = 0, first_ignored_line_ = 0;
    std::string_view first_ignored_;
    std::optional<std::string> material_in_use_;
    std::string last_name_;
    std::optional<std::uint32_t> last_number_;
    std::map<std::string, std::uint32_t, std::less<>> numbers_;
    ObjMaterials library_;
    MaterialsByBase by_base_;  // of the library
    std::set<std::string, std::less<>> libraries_;
    bool too_many_libraries_ = false;
    std::uint64_t undefined_ = 0;
    std::string first_undefined_;
};

}  // namespace

Result<MeshSoup> read_obj(std::string_view text, const std::string& name, const MaterialFileReader& material_files,
                          const MaterialFileReader& pictures) {
    return ObjReader(text, name, material_files, pictures).read();
}

}  // namespace burin::geometry
