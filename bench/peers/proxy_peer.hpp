// SPDX-License-Identifier: MIT
// The proxy of another haptic library on the same mesh, for comparison: CHAI3D (version 3.3 is what it was written
// for), whose finger proxy moves by collisions of a swept ball with a tree of boxes. Built only with
// -DBURIN_CHAI3D=DIR, a folder of its sources in which its library has been built; without it opening fails with a
// message. Its headers are not included outside bench/peers/.
// Lengths in metres, in the mesh's frame. One thread.
#pragma once

#include <memory>

#include "base/error.hpp"
#include "geometry/mesh/triangle_mesh.hpp"

namespace burin::bench {

class ProxyPeer {
public:
    virtual ~ProxyPeer() = default;
    // Takes the proxy to the hand, through whatever is between.
    virtual void put(const Vec3& hip_m) = 0;
    // Moves the proxy towards the hand for one tick, and computes the force: what the library does in a tick but for
    // device and tool. Returns the proxy.
    virtual Vec3 step(const Vec3& hip_m) = 0;
};

struct ProxyPeerSettings {
    double radius_m = 0.0;
    double static_friction = 0.0, dynamic_friction = 0.0;
    // Its dynamic mode, which looks for collisions anew at the proxy itself, as its users are told to for what moves.
    bool dynamic = false;
};

[[nodiscard]] bool has_chai3d();

// Opens the library's finger proxy on the mesh, whose outer sides alone are felt. The mesh is copied.
[[nodiscard]] Result<std::unique_ptr<ProxyPeer>> open_chai3d(const geometry::TriangleMesh& mesh,
                                                             const ProxyPeerSettings& settings);

}  // namespace burin::bench
