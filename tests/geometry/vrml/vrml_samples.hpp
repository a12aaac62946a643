// SPDX-License-Identifier: MIT
// Worlds from text for the tests of geometry/vrml/.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "geometry/mesh/mesh_health.hpp"
#include "geometry/vrml/vrml_shapes.hpp"

namespace burin::geometry::test {

inline const std::string kVrmlHead = "#VRML V2.0 utf8\n";

// Reads a world of one text, whose first line is added, and of the files that it may inline. Fails the test on a fault.
inline VrmlWorld vrml_world(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    const VrmlOpener opener = [&](const std::string& name) -> Result<std::string> {
        const auto found = files.find(name);
        if (found == files.end()) return fail(name, "does not exist", "check the path");
        return found->second;
    };
    const auto file = read_vrml(kVrmlHead + text, "test.wrl", opener);
    EXPECT_TRUE(file) << file.error().line();
    if (!file) return {};
    auto world = shapes_of(*file);
    if (world) return std::move(*world);
    for (const Error& error : world.error()) ADD_FAILURE() << error.line();
    return {};
}

// Returns all faults of a text, one a line.
inline std::vector<std::string> vrml_faults(const std::string& text, const VrmlOpener& opener = {}) {
    const auto file = read_vrml(text, "test.wrl", opener);
    if (!file) return {file.error().line()};
    const auto world = shapes_of(*file);
    std::vector<std::string> lines;
    if (!world) {
        for (const Error& error : world.error()) lines.push_back(error.line());
    }
    return lines;
}

// Returns the triangles of a geometry node in a Shape of its own; empty where there are none.
inline VrmlSurface vrml_surface(const std::string& geometry) {
    const VrmlWorld world = vrml_world("Shape { geometry " + geometry + " }");
    EXPECT_LE(world.shapes.size(), 1u);
    return world.shapes.empty() ? VrmlSurface{} : *world.shapes[0].surface;
}

// Checks that a surface is closed and faces outwards without a fault, and returns its volume.
inline double closed_volume(const VrmlSurface& surface) {
    const MeshHealth health = examine(surface.mesh);
    EXPECT_TRUE(health.closed && health.manifold() && health.consistently_oriented);
    EXPECT_EQ(health.degenerate_triangles, 0u);
    return health.signed_volume_m3;
}

}  // namespace burin::geometry::test
