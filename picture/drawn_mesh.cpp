// SPDX-License-Identifier: MIT
#include "picture/drawn_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/mesh/vertex_weld.hpp"
#include "shaders/shared/octahedral.h"

namespace burin::picture {
namespace {

struct Face {
    std::array<std::uint32_t, 3> corners{};  // welded
    Vec3 area{0.0};                          // along the normal, as long as twice the area
    Vec3 normal{0.0};
    std::array<std::uint32_t, 3> colours{};
};

std::uint32_t normal_code(const Vec3& normal) {
    constexpr double kLength = 1 << 20;
    const Vec3 n = glm::normalize(normal) * kLength;
    return shared::encode_normal({std::llround(n.x), std::llround(n.y), std::llround(n.z)});
}

std::uint32_t colour_code(const std::array<std::uint8_t, 3>& c) {
    return 0xff000000u | std::uint32_t{c[2]} << 16 | std::uint32_t{c[1]} << 8 | c[0];
}

std::uint32_t material_code(const geometry::TriangleMesh& mesh, std::size_t triangle) {
    if (mesh.materials.empty()) return 0xffffffffu;
    const std::size_t index = mesh.triangle_materials.empty() ? 0 : mesh.triangle_materials[triangle];
    return colour_code(mesh.materials.at(index).colour);
}

std::vector<Face> faces_of(const geometry::TriangleMesh& mesh, std::span<const TriangleColours> colours,
                           std::vector<Vec3>& places) {
    geometry::VertexWeld weld(places);
    std::vector<Face> faces;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        const Vec3 &p = mesh.positions_m[a], &q = mesh.positions_m[b], &r = mesh.positions_m[c];
        Face face;
        face.area = glm::cross(q - p, r - p);
        const double twice_area = glm::length(face.area);
        if (!(twice_area > 0.0)) continue;
        face.normal = face.area / twice_area;
        face.corners = {weld.index_of(p), weld.index_of(q), weld.index_of(r)};
        for (std::size_t k = 0; k < 3; ++k)
            face.colours[k] = colours.empty() ? material_code(mesh, i) : colour_code(colours[i][k]);
        faces.push_back(face);
    }
    return faces;
}

// Lists the faces at each place.
class FacesAt {
public:
    FacesAt(const std::vector<Face>& faces, std::size_t places) : first_(places + 1, 0), faces_(3 * faces.size()) {
        for (const Face& face : faces)
            for (const std::uint32_t corner : face.corners) ++first_[corner + 1];
        for (std::size_t i = 0; i < places; ++i) first_[i + 1] += first_[i];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t f = 0; f < faces.size(); ++f)
            for (const std::uint32_t corner : faces[f].corners) faces_[next[corner]++] = f;
    }
    [[nodiscard]] std::span<const std::uint32_t> operator[](std::uint32_t place) const {
        return std::span(faces_).subspan(first_[place], first_[place + 1] - first_[place]);
    }

private:
    std::vector<std::uint32_t> first_, faces_;
};

// Sums up the faces around a place that are smooth with one of them: those of nearly its normal. Where very many meet,
// as in the middle of a disc that is a fan, faces of about one normal are summed up beforehand, so that the cost is not
// the square of their number.
class SmoothAreas {
public:
    SmoothAreas(const std::vector<Face>& faces, std::size_t places) : faces_(faces), at_(faces, places) {}

    Vec3 around(std::uint32_t place, const Vec3& normal) {
        Vec3 sum(0.0);
        const std::span<const std::uint32_t> faces = at_[place];
        if (faces.size() <= kMany) {
            for (const std::uint32_t face : faces)
                if (glm::dot(faces_[face].normal, normal) >= kCreaseCosine) sum += faces_[face].area;
            return sum;
        }
        auto& groups = groups_[place];
        if (groups.empty()) groups = groups_of(faces);
        for (const auto& [cell, area] : groups)
            if (glm::dot(area, normal) >= kCreaseCosine * glm::length(area)) sum += area;
        return sum == Vec3(0.0) ? normal : sum;
    }

private:
    static constexpr std::size_t kMany = 256;
    static constexpr double kCells = 16.0;  // for each unit of a normal: 3.6 degrees
    using Groups = std::map<std::tuple<long, long, long>, Vec3>;

    [[nodiscard]] Groups groups_of(std::span<const std::uint32_t> faces) const {
        Groups groups;
        for (const std::uint32_t face : faces) {
            const Vec3 cell = kCells * faces_[face].normal;
            groups[{std::lround(cell.x), std::lround(cell.y), std::lround(cell.z)}] += faces_[face].area;
        }
        return groups;
    }

    const std::vector<Face>& faces_;
    FacesAt at_;
    std::map<std::uint32_t, Groups> groups_;  // of the places where very many faces meet
};

}  // namespace

std::shared_ptr<const DrawnMesh> drawn_mesh(const geometry::TriangleMesh& mesh,
                                            std::span<const TriangleColours> colours) {
    std::vector<Vec3> places;
    const std::vector<Face> faces = faces_of(mesh, colours, places);
    SmoothAreas areas(faces, places.size());
    auto drawn = std::make_shared<DrawnMesh>();
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> known;  // place, normal, colour
    for (const Face& face : faces) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t place = face.corners[corner], colour = face.colours[corner];
            const std::uint32_t code = normal_code(areas.around(place, face.normal));
            const auto [at, is_new] =
                known.try_emplace({place, code, colour}, static_cast<std::uint32_t>(drawn->vertices.size()));
            if (is_new) {
                const Vec3& p = places[place];
                drawn->vertices.push_back(
                    {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), code, colour});
                drawn->bounds.include(p);
            }
            drawn->indices.push_back(at->second);
        }
    }
    return drawn;
}

std::shared_ptr<const DrawnMesh> smooth_mesh(std::span<const Vec3> places_m,
                                             std::span<const std::array<std::uint32_t, 3>> triangles,
                                             std::span<const std::uint32_t> colours,
                                             std::vector<geometry::VertexLight> lights) {
    std::vector<Vec3> areas(places_m.size(), Vec3(0.0));
    auto drawn = std::make_shared<DrawnMesh>();
    drawn->indices.reserve(3 * triangles.size());
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = glm::cross(places_m[b] - places_m[a], places_m[c] - places_m[a]);
        for (const std::uint32_t corner : {a, b, c}) {
            areas[corner] += area;
            drawn->indices.push_back(corner);
        }
    }
    drawn->vertices.reserve(places_m.size());
    for (std::size_t i = 0; i < places_m.size(); ++i) {
        const Vec3& p = places_m[i];
        const bool has_area = glm::length(areas[i]) > 0.0;
        drawn->vertices.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z),
                                   normal_code(has_area ? areas[i] : Vec3(0.0, 1.0, 0.0)),
                                   colours.empty() ? 0xffffffffu : colours[i]});
        drawn->bounds.include(p);
    }
    drawn->lights = std::move(lights);
    return drawn;
}

}  // namespace burin::picture
