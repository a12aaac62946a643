// SPDX-License-Identifier: MIT
#include "study/felt/felt_world.hpp"

#include <utility>

#include "base/sha256.hpp"
#include "base/try.hpp"
#include "haptics/forces/touch_force.hpp"
#include "study/felt/tube_mesh.hpp"

namespace burin::study {
namespace {

constexpr scene::Colour kTubeGreen{70, 170, 90}, kFunnelGrey{150, 160, 190}, kCapGrey{128, 128, 128};

scene::SceneObject object_of(scene::ObjectId id, const char* name, geometry::TriangleMesh mesh, bool felt,
                             scene::Colour colour) {
    scene::SceneObject object;
    object.id = id;
    object.name = name;
    object.mesh = std::make_shared<const geometry::TriangleMesh>(std::move(mesh));
    object.felt = felt;
    object.both_sides = felt;
    object.colour = colour;
    return object;
}

void add_bytes(std::string& text, const void* data, std::size_t size) {
    text.append(static_cast<const char*>(data), size);
}

// Of the bits of all numbers, in the machine's order of bytes.
std::string digest_of(const StudyWorld& world, const std::vector<scene::SceneObject>& objects) {
    std::string text = world.name;
    for (const double number : {world.tube_radius_m, world.cap_half_width_m, world.cap_depth_m,
                                world.funnel_half_width_m, world.wall_N_per_m, world.wall_Ns_per_m})
        add_bytes(text, &number, sizeof(number));
    add_bytes(text, world.spine_m.data(), world.spine_m.size() * sizeof(Vec3));
    for (const scene::SceneObject& object : objects) {
        if (!object.felt) continue;
        const geometry::TriangleMesh& mesh = *object.mesh;
        add_bytes(text, mesh.positions_m.data(), mesh.positions_m.size() * sizeof(Vec3));
        add_bytes(text, mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles.front()));
    }
    return sha256(text);
}

}  // namespace

Result<std::unique_ptr<const FeltWorld>> FeltWorld::create(const StudyWorld& world) {
    std::unique_ptr<FeltWorld> made(new FeltWorld(world));
    std::vector<scene::SceneObject> objects;
    objects.push_back(object_of(kTubeObject, "tube", tube_mesh(world), true, kTubeGreen));
    if (world.funnel_half_width_m > 0.0) {
        objects.push_back(
            object_of(kStartFunnelObject, "start funnel", funnel_mesh(world, WorldEnd::start), true, kFunnelGrey));
        objects.push_back(
            object_of(kEndFunnelObject, "end funnel", funnel_mesh(world, WorldEnd::end), true, kFunnelGrey));
    }
    objects.push_back(object_of(kStartCapObject, "start cap", cap_mesh(world, WorldEnd::start), false, kCapGrey));
    objects.push_back(object_of(kEndCapObject, "end cap", cap_mesh(world, WorldEnd::end), false, kCapGrey));
    objects.front().seen = false;
    objects.push_back(object_of(kSeenTubeObject, "seen tube", drawn_tube_mesh(world), false, kTubeGreen));
    made->digest_ = digest_of(world, objects);
    for (const scene::SceneObject& object : objects) {
        made->objects_.push_back(object.id);
        for (const Vec3& p : object.mesh->positions_m) made->bounds_.include(p);
    }
    auto part = scene::MeshPart::create(std::move(objects), made->materials_);
    if (!part) return fail("world " + world.name, "cannot be touched: " + part.error().what, part.error().remedy);
    made->part_ = std::move(*part);
    // Far more than a wand reaches: the surface is known wherever a tick asks.
    const double reach_m = 10.0 + glm::length(made->bounds_.extent());
    geometry::LocalSurface& surface = made->surface_;
    surface.center_object = surface.origin_object = made->bounds_.center();
    surface.radius_m = reach_m;
    BURIN_TRY_DO(made->part_->add_near({0, made->bounds_.center(), reach_m}, surface));
    // The tube comes first, as the objects are numbered.
    static_assert(kTubeMaterial < haptics::kMostMaterials && kFunnelMaterial < haptics::kMostMaterials);
    for (std::size_t i = 0; i < surface.meshes.size(); ++i)
        surface.meshes[i].material = i == 0 ? kTubeMaterial : kFunnelMaterial;
    surface.sequence = 1;
    return made;
}

}  // namespace burin::study
