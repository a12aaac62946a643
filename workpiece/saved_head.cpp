// SPDX-License-Identifier: MIT
#include "workpiece/saved_head.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/json.hpp"
#include "compute/rays/ray_batch.hpp"

namespace burin::workpiece {
namespace {

// What any workpiece has (compute/rays/lattice.cpp) lies within these.
constexpr double kSmallestSpacing_m = 1e-14, kLargestSpacing_m = 1e9, kFarthestOrigin_cells = 0x1p40;

bool is_number(const Json& json) { return json.is_number() && std::isfinite(json.get<double>()); }

bool are_numbers(const Json* list, std::size_t count) {
    return list != nullptr && list->is_array() && list->size() == count && std::ranges::all_of(*list, is_number);
}

std::optional<compute::Lattice> lattice_in(const Json& head) {
    const Json *origin = find_value(head, "/origin_m"), *cells = find_value(head, "/cells"),
               *spacing = find_value(head, "/spacing_m");
    if (!are_numbers(origin, 3) || !are_numbers(cells, 3) || spacing == nullptr || !is_number(*spacing)) return {};
    compute::Lattice lattice;
    lattice.spacing_m = spacing->get<double>();
    if (!(lattice.spacing_m >= kSmallestSpacing_m && lattice.spacing_m <= kLargestSpacing_m)) return {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        lattice.origin_object[static_cast<int>(axis)] = (*origin)[axis].get<double>();
        const double along = (*cells)[axis].get<double>();
        if (!(along >= 1.0 && along <= shared::kMaxCells)) return {};
        lattice.cells[axis] = static_cast<int>(along);
    }
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(lattice.origin_object[axis]) <= kFarthestOrigin_cells * lattice.spacing_m)) return {};
    return lattice;
}

std::optional<std::vector<geometry::Material>> materials_in(const Json& head) {
    const Json* list = find_value(head, "/materials");
    if (list == nullptr || !list->is_array() || list->empty() || list->size() > kMostMaterials) return {};
    std::vector<geometry::Material> materials;
    for (const Json& one : *list) {
        const Json *name = find_value(one, "/name"), *colour = find_value(one, "/colour");
        if (name == nullptr || !name->is_string() || !are_numbers(colour, 3)) return {};
        geometry::Material material{name->get<std::string>()};
        for (std::size_t k = 0; k < 3; ++k) {
            const double part = (*colour)[k].get<double>();
            if (!(part >= 0.0 && part <= 255.0)) return {};
            material.colour[k] = static_cast<std::uint8_t>(part);
        }
        materials.push_back(std::move(material));
    }
    return materials;
}

}  // namespace

std::vector<std::byte> head_bytes(const compute::Solid& solid, int page_side) {
    const compute::Lattice& lattice = solid.lattice;
    const Vec3& origin = lattice.origin_object;
    Json materials = Json::array();
    for (const geometry::Material& material : solid.materials)
        materials.push_back(
            {{"name", material.name}, {"colour", {material.colour[0], material.colour[1], material.colour[2]}}});
    const Json head = {{"origin_m", Json::array({origin.x, origin.y, origin.z})},
                       {"spacing_m", lattice.spacing_m},
                       {"cells", Json::array({lattice.cells[0], lattice.cells[1], lattice.cells[2]})},
                       {"units_per_cell", shared::kUnitsPerCell},
                       {"page_side", page_side},
                       {"materials", materials}};
    const std::string text = json_text(head);
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

std::optional<SavedHead> head_in(std::span<const std::byte> bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const Json json = Json::parse(text, text + bytes.size(), nullptr, false);
    if (json.is_discarded()) return {};
    const auto lattice = lattice_in(json);
    auto materials = materials_in(json);
    const Json* side = find_value(json, "/page_side");
    if (!lattice || !materials || side == nullptr || !is_number(*side)) return {};
    const double page_side = side->get<double>();
    if (!(page_side >= 1.0 && page_side <= shared::kMaxCells)) return {};
    return SavedHead{*lattice, std::move(*materials), static_cast<int>(page_side)};
}

bool is_sound(std::span<const shared::DexelEnd> ends, int most_depth, std::size_t materials) {
    int previous = -1;
    for (const shared::DexelEnd& end : ends) {
        if (shared::depth_of(end) <= previous || shared::material_of(end) >= materials) return false;
        previous = shared::depth_of(end);
    }
    return ends.size() % 2 == 0 && previous <= most_depth;
}

const geometry::Material& lost_material() {
    static const geometry::Material lost{"lost and made again", {200, 40, 40}};
    return lost;
}

}  // namespace burin::workpiece
