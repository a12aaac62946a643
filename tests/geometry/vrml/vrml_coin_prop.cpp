// SPDX-License-Identifier: MIT
// Coin, which shares no code with ours, makes the same triangles of the same worlds: as many of each colour, in the
// same box. Round shapes are left aside, since each program cuts them in its own way. With the environment's variable
// BURIN_WORLDS, a folder, the sound worlds in it are compared as well.
#include <gtest/gtest.h>

#include "tests/geometry/vrml/vrml_samples.hpp"

#ifdef BURIN_WITH_COIN
#include <Inventor/SbLinear.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoPrimitiveVertex.h>
#include <Inventor/VRMLnodes/SoVRMLGroup.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/nodes/SoShape.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/text.hpp"
#include "tests/geometry/mesh_samples.hpp"
#endif

namespace burin::geometry::test {

#ifndef BURIN_WITH_COIN

TEST(VrmlAgainstCoin, MakesTheSameTriangles) {
    GTEST_SKIP() << "built without Coin (libcoin-dev, which scripts/setup installs)";
}

#else
namespace {

struct ColouredTriangles {
    std::map<VrmlColour, std::size_t> of_colour;
    Box bounds;
};

void keep_triangle(void* to, SoCallbackAction* action, const SoPrimitiveVertex* a, const SoPrimitiveVertex* b,
                   const SoPrimitiveVertex* c) {
    auto& triangles = *static_cast<ColouredTriangles*>(to);
    for (const SoPrimitiveVertex* v : {a, b, c}) {
        SbVec3f p;
        action->getModelMatrix().multVecMatrix(v->getPoint(), p);
        triangles.bounds.include(Vec3(p[0], p[1], p[2]));
    }
    SbColor ambient, diffuse, specular, emission;
    float shininess = 0.0f, transparency = 0.0f;
    action->getMaterial(ambient, diffuse, specular, emission, shininess, transparency, a->getMaterialIndex());
    const auto byte = [&](int k) { return static_cast<std::uint8_t>(std::lround(255.0f * diffuse[k])); };
    ++triangles.of_colour[{byte(0), byte(1), byte(2)}];
}

// Returns nothing where Coin cannot read the text.
std::optional<ColouredTriangles> coins_triangles(const std::string& text) {
    static const bool ready = [] {
        SoDB::init();
        SoReadError::setHandlerCallback([](const SoError*, void*) {}, nullptr);
        return true;
    }();
    static_cast<void>(ready);
    SoInput in;
    in.setBuffer(text.data(), text.size());
    SoVRMLGroup* const root = SoDB::readAllVRML(&in);
    if (root == nullptr) return std::nullopt;
    root->ref();
    ColouredTriangles triangles;
    SoCallbackAction action;
    action.addTriangleCallback(SoShape::getClassTypeId(), keep_triangle, &triangles);
    action.apply(root);
    root->unref();
    return triangles;
}

ColouredTriangles our_triangles(const VrmlWorld& world) {
    ColouredTriangles triangles;
    for (const VrmlShape& shape : world.shapes) {
        const TriangleMesh mesh = mesh_in_world(shape);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t v : mesh.triangles[t]) triangles.bounds.include(mesh.positions_m[v]);
            const auto& corners = shape.surface->corner_colours;
            ++triangles.of_colour[corners.empty() ? shape.colour : corners[t][0]];
        }
    }
    return triangles;
}

// Coin computes in single precision.
bool same_box(const Box& a, const Box& b) {
    if (a.empty() || b.empty()) return a.empty() && b.empty();
    const double size = 1e-5 * (glm::length(a.extent()) + glm::length(a.center()));
    return glm::length(a.lo - b.lo) <= size && glm::length(a.hi - b.hi) <= size;
}

std::string described(const ColouredTriangles& triangles) {
    std::string text;
    for (const auto& [colour, count] : triangles.of_colour)
        text += formatted("%02x%02x%02x: %zu, ", colour[0], colour[1], colour[2], count);
    const Box& b = triangles.bounds;
    return text + formatted("%g %g %g to %g %g %g", b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z);
}

// Nodes that Coin cuts into other triangles, or that are not read here.
constexpr std::string_view kMadeOtherwise[] = {"Sphere", "Cone", "Cylinder", "Text "};

const char* const kWorlds[] = {
    "Shape { geometry Box { size 1 2 3 } }",
    "Transform { translation 1 2 3 center 0.5 -1 2 rotation 0 1 2 0.7 scale 2 3 0.5 scaleOrientation 1 0 1 0.4\n"
    "children Transform { scale -1 2 1 children Shape { geometry Box { } } } }",
    "DEF B Shape { appearance Appearance { material Material { diffuseColor 0 1 0 } } geometry Box { } }\n"
    "Transform { translation 5 0 0 rotation 1 0 0 1 children [ USE B Group { children USE B } ] }",
    "Switch { whichChoice 1 choice [ Shape { geometry Box { } } Shape { geometry Box { size 1 1 1 } } ] }",
    "Shape { geometry ElevationGrid { xDimension 3 zDimension 4 xSpacing 0.5 height [ 0 1 2 3 4 5 6 7 8 9 1 2 ] } }",
    "Shape { geometry IndexedFaceSet { convex FALSE coord Coordinate { point [ 0 0 0, 2 0 0, 2 1 0, 1 1 0, 1 2 0, 0 2 "
    "0, "
    "0 0 3 ] } coordIndex [ 0 1 2 3 4 5 -1 0 1 6 -1 1 2 6 ] } }",
    "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 2 0 0, 2 1 0, 0 3 0 ] } coordIndex [ 0 1 2 -1 "
    "0 2 "
    "3 ] colorPerVertex FALSE color Color { color [ 1 0 0, 0 0 1 ] } } }",
    "Shape { geometry Extrusion { spine [ 0 0 0, 0 2 0, 1 3 0, 3 3 1 ] scale [ 1 1, 0.5 1, 1 0.5, 2 2 ] } }",
    "Shape { geometry Extrusion { beginCap FALSE spine [ 0 0 0, 3 0 0 ] orientation [ 0 1 0 0, 0 1 0 1 ] } }",
};

}  // namespace

TEST(VrmlAgainstCoin, MakesTheSameTriangles) {
    for (const char* const text : kWorlds) {
        const auto theirs = coins_triangles(kVrmlHead + text);
        ASSERT_TRUE(theirs) << text;
        const ColouredTriangles ours = our_triangles(vrml_world(text));
        EXPECT_EQ(ours.of_colour, theirs->of_colour)
            << text << "\nours " << described(ours) << "\ntheirs " << described(*theirs);
        EXPECT_TRUE(same_box(ours.bounds, theirs->bounds))
            << text << "\nours " << described(ours) << "\ntheirs " << described(*theirs);
    }
}

TEST(VrmlAgainstCoin, MakesTheSameTrianglesOfOtherPeoplesWorlds) {
    const char* const folder = std::getenv("BURIN_WORLDS");
    if (folder == nullptr) GTEST_SKIP() << "BURIN_WORLDS names no folder of worlds";
    std::size_t compared = 0, unread = 0, aside = 0, other = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".wrl") continue;
        const auto file = read_vrml_file(entry.path());
        if (!file) continue;
        const auto world = shapes_of(*file);
        if (!world) continue;
        const std::string text = text_of_file(entry.path());
        if (std::ranges::any_of(kMadeOtherwise, [&](auto type) { return text.find(type) != std::string::npos; })) {
            ++aside;
            continue;
        }
        const auto theirs = coins_triangles(text);
        if (!theirs) {
            ++unread;
            continue;
        }
        ++compared;
        const ColouredTriangles ours = our_triangles(*world);
        if (same_box(ours.bounds, theirs->bounds) && ours.of_colour == theirs->of_colour) continue;
        ++other;
        std::printf("%s\n  ours   %s\n  theirs %s\n", entry.path().c_str(), described(ours).c_str(),
                    described(*theirs).c_str());
    }
    std::printf("%zu compared, %zu differ; %zu with round shapes or text, %zu that Coin does not read\n", compared,
                other, aside, unread);
    EXPECT_GT(compared, 0u);
    EXPECT_EQ(other, 0u);
}

#endif

}  // namespace burin::geometry::test
