// SPDX-License-Identifier: MIT
#include "scene/world_digest.hpp"

#include <map>

#include "base/json.hpp"
#include "base/sha256.hpp"

namespace burin::scene {
namespace {

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string mesh_digest(const geometry::TriangleMesh& mesh) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double), "no gaps, whose bytes would say nothing");
    return sha256(bytes_of(mesh.positions_m)) + sha256(bytes_of(mesh.triangles));
}

Json digested_pose(const Pose& pose) {
    const Vec3& p = pose.position_m;
    const Quat& q = pose.orientation;
    return Json::array({p.x, p.y, p.z, q.x, q.y, q.z, q.w});
}

Json digested_motion(const ObjectMotion& motion) {
    const auto* path = std::get_if<PathMotion>(&motion);
    if (path == nullptr) return Json(motion.index());  // a world's file has no hands that hold something
    Json keys = Json::array();
    for (const PathKey& key : path->keys) keys.push_back({key.time_s, digested_pose(key.pose)});
    Json json{{"keys", keys}, {"repeats", path->repeats}};
    if (path->about_m != Vec3(0.0)) json["about"] = Json::array({path->about_m.x, path->about_m.y, path->about_m.z});
    return json;
}

}  // namespace

std::string world_digest(std::span<const SceneObject> objects) {
    std::map<const geometry::TriangleMesh*, std::string> meshes;
    std::string all;
    for (const SceneObject& object : objects) {
        std::string& mesh = meshes[object.mesh.get()];
        if (mesh.empty() && object.mesh) mesh = mesh_digest(*object.mesh);
        const HapticMaterial& m = object.material;
        Json json{
            {"id", object.id},
            {"name", object.name},
            {"mesh", mesh},
            {"pose", digested_pose(object.pose)},
            {"scale", object.scale},
            {"seen", object.seen},
            {"felt", object.felt},
            {"colour", object.colour},
            {"material", Json::array({m.stiffness_N_per_m, m.damping_Ns_per_m, m.static_friction, m.dynamic_friction})},
            {"both_sides", object.both_sides},
            {"motion", digested_motion(object.motion)}};
        if (m.coulomb_velocity_m_per_s != 0.0) json["material"].push_back(m.coulomb_velocity_m_per_s);
        if (object.opacity != 1.0) json["opacity"] = object.opacity;  // recordings from before there was any stay equal
        all += json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
    }
    return sha256(all);
}

}  // namespace burin::scene
