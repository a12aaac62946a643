// SPDX-License-Identifier: MIT
// Replaces CHAI3D in a build without it.
#include "bench/peers/proxy_peer.hpp"

namespace burin::bench {

bool has_chai3d() { return false; }

Result<std::unique_ptr<ProxyPeer>> open_chai3d(const geometry::TriangleMesh& /*mesh*/,
                                               const ProxyPeerSettings& /*settings*/) {
    return fail("CHAI3D", "is not built into this program",
                "build its library and configure with -DBURIN_CHAI3D=DIR, the folder of its sources");
}

}  // namespace burin::bench
