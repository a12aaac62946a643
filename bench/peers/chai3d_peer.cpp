// SPDX-License-Identifier: MIT
#include <chai3d.h>

#include "bench/peers/proxy_peer.hpp"

namespace burin::bench {
namespace {

// The library's units: 100 mm are 1, about as large as the objects of its own examples. Its tolerances for points are
// lengths in these units; in metres they are so large that a point falls through a mesh whose edges are half a
// millimetre long.
constexpr double kUnits_per_m = 10.0;

chai3d::cVector3d of(const Vec3& p) { return {kUnits_per_m * p.x, kUnits_per_m * p.y, kUnits_per_m * p.z}; }
Vec3 of(const chai3d::cVector3d& p) { return Vec3(p.x(), p.y(), p.z()) / kUnits_per_m; }

class Chai3d final : public ProxyPeer {
public:
    Chai3d(const geometry::TriangleMesh& mesh, const ProxyPeerSettings& settings) {
        auto* touched = new chai3d::cMesh();  // the world deletes it
        world_.addChild(touched);
        for (const Vec3& p : mesh.positions_m) touched->newVertex(of(p));
        for (const auto& [a, b, c] : mesh.triangles) touched->newTriangle(a, b, c);
        touched->computeAllNormals();
        touched->m_material->setHapticTriangleSides(true, false);
        touched->setStiffness(600.0);
        touched->setFriction(settings.static_friction, settings.dynamic_friction);
        touched->m_material->setUseHapticFriction(settings.static_friction > 0.0);
        const double radius = kUnits_per_m * settings.radius_m;
        touched->createAABBCollisionDetector(radius);
        world_.computeGlobalPositions(true);
        proxy_.setProxyRadius(radius);
        proxy_.m_useDynamicProxy = settings.dynamic;
        proxy_.initialize(&world_, {0.0, 0.0, 0.0});
    }
    void put(const Vec3& hip_m) override { proxy_.initialize(&world_, of(hip_m)); }
    Vec3 step(const Vec3& hip_m) override {
        proxy_.computeForces(of(hip_m), {0.0, 0.0, 0.0});
        return of(proxy_.getProxyGlobalPosition());
    }

private:
    chai3d::cWorld world_;
    chai3d::cAlgorithmFingerProxy proxy_;
};

}  // namespace

bool has_chai3d() { return true; }

Result<std::unique_ptr<ProxyPeer>> open_chai3d(const geometry::TriangleMesh& mesh, const ProxyPeerSettings& settings) {
    return std::make_unique<Chai3d>(mesh, settings);
}

}  // namespace burin::bench
