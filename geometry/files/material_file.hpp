// SPDX-License-Identifier: MIT
// Reads the material file of an OBJ (MTL): the diffuse colours (Kd) and their pictures (map_Kd). A fault in it never
// stops an import, since the shape does not depend on it: it becomes a remark, and the material keeps the plain colour.
// Kd numbers run from 0 to 1, or as colour_scale.hpp says, and are taken as sRGB, as most programs write them. Internal
// to geometry/files/. Pure; any thread.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/files/colour_scale.hpp"
#include "geometry/files/mesh_pictures.hpp"

namespace burin::geometry {

struct ObjMaterial {
    Colour colour = kPlainColour;
    PictureUse picture = {};  // without names: none
};

using ObjMaterials = std::map<std::string, ObjMaterial, std::less<>>;

struct MaterialLibrary {
    ObjMaterials materials;
    std::vector<std::string> remarks;
};

// `name` stands for the file in remarks.
[[nodiscard]] MaterialLibrary read_mtl(std::string_view text, const std::string& name);

// Materials by their names without what may be a comment behind them; null where several are called so. Filled when it
// is first asked of a library with so many materials.
struct MaterialsByBase {
    std::size_t materials = 0;
    std::map<std::string, const ObjMaterial*, std::less<>> found;
};

// Finds the material of a usemtl statement; a comment may follow its name there, or in the library. Null: none.
[[nodiscard]] const ObjMaterial* material_named(const ObjMaterials& materials, MaterialsByBase& by_base,
                                                std::string_view statement);

}  // namespace burin::geometry
