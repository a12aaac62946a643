// SPDX-License-Identifier: MIT
// Reads the diffuse colours (Kd) of an OBJ's material file. Internal to geometry/. A fault in the file never stops an
// import, since the shape does not depend on it: it becomes a remark and the material keeps the plain colour.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/files/mesh_soup.hpp"

namespace burin::geometry {

struct MaterialLibrary {
    std::map<std::string, Colour, std::less<>> colours;
    std::vector<std::string> remarks;
};

// Reads all materials. Kd numbers run from 0 to 1 and are taken as sRGB, as most programs write them.
[[nodiscard]] MaterialLibrary read_mtl(std::string_view text, const std::string& name);

}  // namespace burin::geometry
