// SPDX-License-Identifier: MIT
#include "tests/compute/test_meshes.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace burin::compute::test {
namespace {

// Gives every place one vertex.
class Builder {
public:
    explicit Builder(geometry::TriangleMesh& mesh) : mesh_(mesh) {}
    std::uint32_t vertex(const Vec3& p) {
        const auto [known, fresh] =
            index_.try_emplace(std::tuple(p.x, p.y, p.z), static_cast<std::uint32_t>(mesh_.positions_m.size()));
        if (fresh) mesh_.positions_m.push_back(p);
        return known->second;
    }
    void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
        mesh_.triangles.push_back({vertex(a), vertex(b), vertex(c)});
    }

private:
    geometry::TriangleMesh& mesh_;
    std::map<std::tuple<double, double, double>, std::uint32_t> index_;
};

void subdivide(Builder& builder, const Vec3& a, const Vec3& b, const Vec3& c, int levels, double radius) {
    if (levels == 0) {
        builder.triangle(a, b, c);
        return;
    }
    // a + b and not b + a in both neighbours: addition of two numbers does not depend on their order.
    const auto middle = [&](const Vec3& p, const Vec3& q) { return glm::normalize(p + q) * radius; };
    const Vec3 ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    subdivide(builder, a, ab, ca, levels - 1, radius);
    subdivide(builder, ab, b, bc, levels - 1, radius);
    subdivide(builder, ca, bc, c, levels - 1, radius);
    subdivide(builder, ab, bc, ca, levels - 1, radius);
}

}  // namespace

geometry::TriangleMesh box_mesh(const Vec3& lo, const Vec3& hi, int n) {
    geometry::TriangleMesh mesh;
    Builder builder(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            const auto at = [&](int i, int k) {
                Vec3 p;
                p[axis] = side == 0 ? lo[axis] : hi[axis];
                p[u] = i == n ? hi[u] : lo[u] + (hi[u] - lo[u]) * i / n;
                p[v] = k == n ? hi[v] : lo[v] + (hi[v] - lo[v]) * k / n;
                return p;
            };
            for (int i = 0; i < n; ++i) {
                for (int k = 0; k < n; ++k) {
                    const Vec3 a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
                    builder.triangle(a, side == 1 ? b : c, side == 1 ? c : b);
                    builder.triangle(a, side == 1 ? c : d, side == 1 ? d : c);
                }
            }
        }
    }
    return mesh;
}

geometry::TriangleMesh prism_mesh(int sides, double radius, double height) {
    geometry::TriangleMesh mesh;
    Builder builder(mesh);
    const auto at = [&](int i, double z) {
        const double angle = 2 * std::numbers::pi * (i % sides) / sides;
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    for (int i = 0; i < sides; ++i) {
        builder.triangle(at(i, 0), at(i + 1, 0), at(i + 1, height));
        builder.triangle(at(i, 0), at(i + 1, height), at(i, height));
        builder.triangle(Vec3(0, 0, height), at(i, height), at(i + 1, height));
        builder.triangle(Vec3(0), at(i + 1, 0), at(i, 0));
    }
    return mesh;
}

geometry::TriangleMesh ball_mesh(double radius, int levels) {
    geometry::TriangleMesh mesh;
    Builder builder(mesh);
    for (const double x : {-radius, radius})
        for (const double y : {-radius, radius})
            for (const double z : {-radius, radius}) {
                const Vec3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
                const bool outward = x * y * z > 0;
                subdivide(builder, a, outward ? b : c, outward ? c : b, levels, radius);
            }
    return mesh;
}

geometry::TriangleMesh joined(const geometry::TriangleMesh& a, const geometry::TriangleMesh& b) {
    geometry::TriangleMesh mesh = a;
    const auto first = static_cast<std::uint32_t>(a.positions_m.size());
    mesh.positions_m.insert(mesh.positions_m.end(), b.positions_m.begin(), b.positions_m.end());
    for (const auto& t : b.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return mesh;
}

geometry::TriangleMesh inverted(geometry::TriangleMesh mesh) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

geometry::TriangleMesh transformed(geometry::TriangleMesh mesh, const Quat& orientation, const Vec3& translation) {
    for (Vec3& p : mesh.positions_m) p = orientation * p + translation;
    return mesh;
}

double volume_of(const geometry::TriangleMesh& mesh) {
    double six = 0;
    for (const auto& t : mesh.triangles) {
        six += glm::dot(mesh.positions_m[t[0]], glm::cross(mesh.positions_m[t[1]], mesh.positions_m[t[2]]));
    }
    return six / 6;
}

double area_of(const geometry::TriangleMesh& mesh) {
    double twice = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3& a = mesh.positions_m[t[0]];
        twice += glm::length(glm::cross(mesh.positions_m[t[1]] - a, mesh.positions_m[t[2]] - a));
    }
    return twice / 2;
}

}  // namespace burin::compute::test
