// SPDX-License-Identifier: MIT
#include "geometry/files/material_file.hpp"

#include <cmath>
#include <optional>

#include "geometry/files/text_scanner.hpp"

namespace burin::geometry {
namespace {

// Reads the numbers of a Kd statement. A single number means grey.
std::optional<Vec3> diffuse(TextScanner& scan) {
    Vec3 colour;
    int count = 0;
    for (std::string_view word = scan.token_in_line('#'); !word.empty() && count < 3; word = scan.token_in_line('#')) {
        const auto value = number_from(word);
        if (!value || !std::isfinite(*value)) return std::nullopt;
        colour[count++] = *value;
    }
    if (count == 1) return Vec3(colour[0]);
    return count == 3 ? std::optional(colour) : std::nullopt;
}

// Counts what is wrong in one way, with the line of the first.
struct CountedLines {
    std::size_t count = 0;
    std::uint64_t first = 0;
    std::string what = {};

    void add(std::uint64_t line, std::string_view text = {}) {
        if (count++ > 0) return;
        first = line;
        what = text;
    }
};

class MaterialFileText {
public:
    MaterialFileText(std::string_view text, const std::string& name) : scan_(text), name_(name) {}

    MaterialLibrary read() {
        for (; !scan_.at_end(); scan_.next_line()) statement();
        for (const DiffuseColour& colour : found_) *colour.of = scale_.bytes_of(colour.numbers, colour.line);
        const std::string file = "of material file " + in_quotes(name_);
        for (std::string& remark : scale_.remarks("colours " + file)) library_.remarks.push_back(std::move(remark));
        if (faults_.count > 0)
            library_.remarks.push_back(std::to_string(faults_.count) + " colours " + file +
                                       " could not be understood, the first in line " + std::to_string(faults_.first));
        if (ignored_.count > 0)
            library_.remarks.push_back(std::to_string(ignored_.count) + " options of pictures " + file +
                                       " have no effect here, the first (" + in_quotes(ignored_.what) + ") in line " +
                                       std::to_string(ignored_.first));
        return std::move(library_);
    }

private:
    // A colour, with its material and its line.
    struct DiffuseColour {
        Colour* of = nullptr;
        Vec3 numbers{0.0};
        std::uint64_t line = 0;
    };

    void statement() {
        const std::string_view keyword = scan_.token_in_line('#');
        if (equals_ignoring_case(keyword, "newmtl")) {
            const std::string material(scan_.rest_of_line());
            current_ = &library_.materials.insert_or_assign(material, ObjMaterial{}).first->second;
        } else if (equals_ignoring_case(keyword, "map_kd") && current_ != nullptr) {
            current_->picture = picture_use(scan_.rest_of_line());
            for (const std::string& option : current_->picture.ignored) ignored_.add(scan_.line(), option);
        } else if (equals_ignoring_case(keyword, "kd")) {
            const auto colour = diffuse(scan_);
            if (!colour || current_ == nullptr) return faults_.add(scan_.line());
            scale_.see(*colour);
            found_.push_back({&current_->colour, *colour, scan_.line()});
        }
    }

    TextScanner scan_;
    const std::string& name_;
    MaterialLibrary library_;
    ObjMaterial* current_ = nullptr;
    ColourScale scale_;
    std::vector<DiffuseColour> found_;
    CountedLines faults_, ignored_;
};

// Returns the statement, and what is left of it where a # after a blank begins a comment, the longest first.
std::vector<std::string_view> readings_of(std::string_view statement) {
    std::vector<std::string_view> readings{statement};
    for (std::size_t hash = statement.rfind('#'); hash != std::string_view::npos && hash > 0;
         hash = statement.rfind('#', hash - 1)) {
        if (!is_blank(statement[hash - 1])) continue;
        std::string_view name = statement.substr(0, hash);
        while (!name.empty() && is_blank(name.back())) name.remove_suffix(1);
        readings.push_back(name);
    }
    return readings;
}

}  // namespace

MaterialLibrary read_mtl(std::string_view text, const std::string& name) { return MaterialFileText(text, name).read(); }

// "Material #25" is a name that one program gives to all its materials: what follows # is a comment only where no
// material is called so.
const ObjMaterial* material_named(const ObjMaterials& materials, MaterialsByBase& by_base, std::string_view statement) {
    const std::vector<std::string_view> readings = readings_of(statement);
    for (const std::string_view reading : readings)
        if (const auto known = materials.find(reading); known != materials.end()) return &known->second;
    if (by_base.materials != materials.size()) {
        by_base = {materials.size(), {}};
        for (const auto& [full, material] : materials) {
            const auto [at, is_new] = by_base.found.try_emplace(std::string(readings_of(full).back()), &material);
            if (!is_new) at->second = nullptr;
        }
    }
    const auto found = by_base.found.find(readings.back());
    return found == by_base.found.end() ? nullptr : found->second;
}

}  // namespace burin::geometry
