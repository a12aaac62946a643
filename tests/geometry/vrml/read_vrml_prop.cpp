// SPDX-License-Identifier: MIT
// Whatever is done to a world's text, reading ends in a world or in faults that name a place and a remedy.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>

#include "base/text.hpp"
#include "tests/geometry/mesh_samples.hpp"
#include "tests/geometry/vrml/vrml_samples.hpp"

namespace burin::geometry::test {
namespace {

void check_outcome(const std::string& text) {
    const VrmlOpener opener = [&](const std::string&) -> Result<std::string> { return text; };
    const auto file = read_vrml(text, "t.wrl", opener);
    if (!file) {
        RC_ASSERT(file.error().where.starts_with("t.wrl:") && !file.error().remedy.empty());
        return;
    }
    const auto world = shapes_of(*file);
    if (!world) {
        RC_ASSERT(!world.error().empty());
        for (const Error& error : world.error()) RC_ASSERT(!error.where.empty() && !error.remedy.empty());
        return;
    }
    for (const VrmlShape& shape : world->shapes) {
        for (const Vec3& p : mesh_in_world(shape).positions_m) RC_ASSERT(finite(p));
    }
}

// Words that mean something, in any order.
constexpr std::array kVrmlWords{
    "Group",       "{",    "}",     "[",     "]",   "children", "DEF A",   "USE A",  "Shape",
    "geometry",    "Box",  "size",  "1 2 3", "-1",  "IS",       "PROTO P", "P",      "field SFFloat x",
    "TRUE",        "NULL", "\"a\"", "\"",    "#\n", "Inline",   "url",     "Script", "ROUTE A.b TO A.c",
    "EXTERNPROTO", "0x",   "nan",   "1e999"};

}  // namespace

RC_GTEST_PROP(VrmlProperties, AnyWordsInAnyOrderEndInAWorldOrInFaults, ()) {
    std::string text = kVrmlHead;
    for (const std::size_t word :
         *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, kVrmlWords.size())))
        text += std::string(kVrmlWords[word]) + " ";
    check_outcome(text);
}

RC_GTEST_PROP(VrmlProperties, ADamagedWorldEndsInAWorldOrInFaults, ()) {
    static const std::string whole = text_of_file("assets/worlds/wand-cube.wrl");
    std::string text = whole;
    const auto at = [&] { return *rc::gen::inRange<std::size_t>(kVrmlHead.size(), text.size()); };
    for (int i = 0; i < 3; ++i) text.erase(at(), *rc::gen::inRange<std::size_t>(0, 8));
    text[at()] = *rc::gen::arbitrary<char>();
    check_outcome(text);
}

// A prism over any simple polygon about the origin, along any spine that is straight: the volume is that of the prism.
RC_GTEST_PROP(VrmlProperties, AStraightExtrusionOfAnyStarIsThePrism, ()) {
    const auto radii =
        *rc::gen::container<std::vector<int>>(*rc::gen::inRange<std::size_t>(4, 12), rc::gen::inRange(1, 20));
    std::string section;
    double area = 0.0;
    const auto corner = [&](std::size_t i) {
        const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(radii.size());
        return 0.1 * radii[i % radii.size()] * Vec2(std::cos(angle), std::sin(angle));
    };
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const Vec2 p = corner(i), q = corner(i + 1);
        area += 0.5 * (p.x * q.y - p.y * q.x);
        section += formatted("%.17g %.17g ", p.x, -p.y);  // counter-clockwise seen from +Y
    }
    section += formatted("%.17g %.17g", corner(0).x, -corner(0).y);
    const auto part = [] { return 0.1 * *rc::gen::inRange(-30, 31); };
    const Vec3 end(part(), part(), part());
    RC_PRE(end != Vec3(0.0));
    const VrmlSurface prism =
        vrml_surface(formatted("Extrusion { spine [ 0 0 0, %.17g %.17g %.17g ] ", end.x, end.y, end.z) +
                     "convex FALSE crossSection [ " + section + " ] }");
    const MeshHealth health = examine(prism.mesh);
    RC_ASSERT(health.closed && health.consistently_oriented);
    RC_ASSERT(std::abs(health.signed_volume_m3 - area * glm::length(end)) < 1e-10);
}

}  // namespace burin::geometry::test
