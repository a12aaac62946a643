// SPDX-License-Identifier: MIT
// Extrusion (ISO/IEC 14772-1:1997, 6.18): a cross-section is swept along a spine, scaled and turned at each point.
//
// The frame of each spine point (the "spine-aligned cross-section plane") has the spine's direction as Y and the normal
// of the bend as Z. What the standard leaves open, or what it calls undefined, is done so:
//   points that repeat the one before have its frame; a spine of equal points keeps the cross-section's own plane
//   a spine that turns back on itself keeps, at that point, the direction in which it came
//   where the first and last rings of a closed spine lie in the same places, they are joined, and there are no caps
//   triangles that a scale of 0 leaves without area are not made
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/mesh/polygon.hpp"
#include "geometry/vrml/vrml_geometry.hpp"

namespace burin::geometry {
namespace {

constexpr double kStraight = 1e-9;  // sine of the bend below which three points count as one line

struct SpineFrame {
    Vec3 x{1.0, 0.0, 0.0}, y{0.0, 1.0, 0.0}, z{0.0, 0.0, 1.0};
};

Vec3 unit_or_zero(const Vec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : Vec3(0.0);
}

// Returns the rotation of +Y into the direction of a straight spine.
SpineFrame straight_frame(const Vec3& direction) {
    const Vec3 up(0.0, 1.0, 0.0);
    const Vec3 axis = glm::cross(up, direction);
    const double sine = glm::length(axis), cosine = glm::dot(up, direction);
    // Straight down there is no shortest way; about X, as good as any other axis.
    const Quat turn = sine > 0.0 ? glm::angleAxis(std::atan2(sine, cosine), axis / sine)
                                 : glm::angleAxis(cosine < 0.0 ? std::numbers::pi : 0.0, Vec3(1.0, 0.0, 0.0));
    return {turn * Vec3(1.0, 0.0, 0.0), direction, turn * Vec3(0.0, 0.0, 1.0)};
}

// The frames of a spine whose neighbours differ.
class SpineFrames {
public:
    explicit SpineFrames(const std::vector<Vec3>& spine)
        : spine_(spine), closed_(spine.size() > 2 && spine.front() == spine.back()) {}

    std::vector<SpineFrame> all() const {
        if (spine_.size() < 2) return std::vector<SpineFrame>(spine_.size());
        std::vector<Vec3> normals(spine_.size());
        for (std::size_t i = 0; i < spine_.size(); ++i) normals[i] = bend(i);
        const auto bent = [](const Vec3& n) { return n != Vec3(0.0); };
        const auto first = std::ranges::find_if(normals, bent);
        if (first == normals.end()) {
            const SpineFrame same = straight_frame(unit_or_zero(spine_[1] - spine_[0]));
            return std::vector<SpineFrame>(spine_.size(), same);
        }
        std::fill(normals.begin(), first, *first);
        std::vector<SpineFrame> frames;
        for (std::size_t i = 0; i < spine_.size(); ++i) {
            Vec3 z = bent(normals[i]) ? normals[i] : normals[i - 1];
            if (i > 0 && glm::dot(z, normals[i - 1]) < 0.0) z = -z;
            normals[i] = z;
            frames.push_back(frame(direction(i), z));
        }
        return frames;
    }

private:
    [[nodiscard]] bool is_end(std::size_t i) const { return i == 0 || i + 1 == spine_.size(); }
    [[nodiscard]] const Vec3& before(std::size_t i) const {
        return is_end(i) ? spine_[spine_.size() - 2] : spine_[i - 1];
    }
    [[nodiscard]] const Vec3& after(std::size_t i) const { return is_end(i) ? spine_[1] : spine_[i + 1]; }

    // Returns the unit normal of the bend at a point; zero where the spine is straight.
    [[nodiscard]] Vec3 bend(std::size_t i) const {
        if (!closed_ && spine_.size() < 3) return Vec3(0.0);
        if (!closed_ && i == 0) return bend(1);
        if (!closed_ && i + 1 == spine_.size()) return bend(i - 1);
        const Vec3 forth = unit_or_zero(after(i) - spine_[i]), back = unit_or_zero(before(i) - spine_[i]);
        const Vec3 normal = glm::cross(forth, back);
        return glm::length(normal) > kStraight ? glm::normalize(normal) : Vec3(0.0);
    }

    [[nodiscard]] Vec3 direction(std::size_t i) const {
        if (!closed_ && i == 0) return unit_or_zero(spine_[1] - spine_[0]);
        if (!closed_ && i + 1 == spine_.size()) return unit_or_zero(spine_[i] - spine_[i - 1]);
        const Vec3 along = unit_or_zero(after(i) - before(i));
        return along == Vec3(0.0) ? unit_or_zero(spine_[i] - before(i)) : along;
    }

    // The normal of a bend that has been carried on need not be square to the direction.
    static SpineFrame frame(const Vec3& y, const Vec3& z) {
        const Vec3 x = glm::cross(y, z);
        if (glm::length(x) <= kStraight) return straight_frame(y);
        const Vec3 square = glm::normalize(x);
        return {square, y, glm::cross(square, y)};
    }

    const std::vector<Vec3>& spine_;
    bool closed_;
};

std::vector<SpineFrame> frames_of(const std::vector<Vec3>& spine) {
    std::vector<Vec3> distinct;
    for (const Vec3& p : spine) {
        if (distinct.empty() || p != distinct.back()) distinct.push_back(p);
    }
    const std::vector<SpineFrame> of_distinct = SpineFrames(distinct).all();
    std::vector<SpineFrame> frames;
    std::size_t at = 0;
    for (std::size_t i = 0; i < spine.size(); ++i) {
        if (i > 0 && spine[i] != spine[i - 1]) ++at;
        frames.push_back(of_distinct[at]);
    }
    return frames;
}

template <typename Vector>
std::vector<Vector> vectors_of(const VrmlGeometryRequest& request, const char* name, std::vector<Vector> otherwise) {
    constexpr auto kSize = static_cast<std::size_t>(Vector::length());
    const VrmlNumbers numbers = request.fields.numbers(request.node, name, kSize);
    if (numbers.value.field == nullptr) return otherwise;
    std::vector<Vector> vectors(numbers.values.size() / kSize);
    for (std::size_t i = 0; i < numbers.values.size(); ++i)
        vectors[i / kSize][static_cast<glm::length_t>(i % kSize)] = numbers.values[i];
    return vectors;
}

// Reads a list with one entry for all spine points, or one for each; more are without effect.
template <typename Vector>
std::vector<Vector> for_each_point(const VrmlGeometryRequest& request, const char* name, const Vector& otherwise,
                                   std::size_t points) {
    std::vector<Vector> values = vectors_of<Vector>(request, name, {otherwise});
    if (values.size() != 1 && values.size() < points) {
        const auto value = request.fields.find(request.node, name);
        request.fields.fault({value->file, value->field->value_at},
                             std::string("'") + name + "' has " + std::to_string(values.size()) + " entries for " +
                                 std::to_string(points) + " spine points",
                             "give one for all, or one for each");
        return {};
    }
    if (values.size() == 1) values.resize(points, values.front());
    return values;
}

class Sweep {
public:
    Sweep(VrmlSurface& surface, std::vector<Vec2> section)
        : mesh_(surface.mesh), closed_section_(section.size() > 2 && section.front() == section.back()) {
        if (closed_section_) section.pop_back();
        section_ = std::move(section);
    }

    void add_ring(const Vec3& at, const SpineFrame& frame, const Vec2& scale, const Quat& turn) {
        for (const Vec2& p : section_) {
            const Vec3 q = turn * Vec3(scale.x * p.x, 0.0, scale.y * p.y);
            mesh_.positions_m.push_back(at + q.x * frame.x + q.y * frame.y + q.z * frame.z);
        }
        ++rings_;
    }

    // Joins the rings. Returns whether the last one lies on the first, which then stands for both.
    bool add_sides(bool closed_spine) {
        const bool joined = closed_spine && rings_ > 2 && last_on_first();
        if (joined) {
            mesh_.positions_m.resize(mesh_.positions_m.size() - section_.size());
        }
        for (std::size_t ring = 0; ring + 1 < rings_; ++ring) {
            const std::size_t next = joined && ring + 2 == rings_ ? 0 : ring + 1;
            for (std::size_t i = 0; i + (closed_section_ ? 0 : 1) < section_.size(); ++i) {
                const std::size_t j = (i + 1) % section_.size();
                add(vertex(ring, i), vertex(ring, j), vertex(next, j));
                add(vertex(ring, i), vertex(next, j), vertex(next, i));
            }
        }
        return joined;
    }

    void add_caps(bool begin, bool end) {
        if (section_.size() < 3 || !(begin || end)) return;
        std::vector<Vec3> polygon;
        for (const Vec2& p : section_) polygon.emplace_back(p.x, 0.0, p.y);
        for (const auto& [a, b, c] : split_polygon(polygon).triangles) {
            if (begin) add(vertex(0, a), vertex(0, c), vertex(0, b));
            if (end) add(vertex(rings_ - 1, a), vertex(rings_ - 1, b), vertex(rings_ - 1, c));
        }
    }

private:
    [[nodiscard]] std::uint32_t vertex(std::size_t ring, std::size_t i) const {
        return static_cast<std::uint32_t>(ring * section_.size() + i);
    }

    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& p = mesh_.positions_m;
        if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) mesh_.triangles.push_back({a, b, c});
    }

    [[nodiscard]] bool last_on_first() const {
        double size = 0.0, distance = 0.0;
        for (std::size_t i = 0; i < section_.size(); ++i) {
            const Vec3 &first = mesh_.positions_m[i], &last = mesh_.positions_m[vertex(rings_ - 1, i)];
            size = std::max(size, glm::length(first - mesh_.positions_m[0]));
            distance = std::max(distance, glm::length(first - last));
        }
        return distance <= kStraight * size;
    }

    TriangleMesh& mesh_;
    std::vector<Vec2> section_;
    bool closed_section_;
    std::size_t rings_ = 0;
};

}  // namespace

VrmlSurface vrml_extrusion(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    VrmlFields& fields = request.fields;
    const auto section = vectors_of<Vec2>(request, "crossSection", {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}});
    const auto spine = vectors_of<Vec3>(request, "spine", {{0, 0, 0}, {0, 1, 0}});
    if (section.size() < 2 || spine.size() < 2) {
        fields.remark(fields.place(request.node), "an Extrusion has fewer than two points in its spine or crossSection",
                      "nothing is made of it");
        return surface;
    }
    const auto scales = for_each_point<Vec2>(request, "scale", Vec2(1.0), spine.size());
    const auto turns = for_each_point<glm::dvec4>(request, "orientation", glm::dvec4(0, 0, 1, 0), spine.size());
    const double triangles = 2.0 * static_cast<double>(spine.size()) * static_cast<double>(section.size());
    if (scales.empty() || turns.empty() || !may_make(request, triangles)) return surface;
    const std::vector<SpineFrame> frames = frames_of(spine);
    Sweep sweep(surface, section);
    for (std::size_t i = 0; i < spine.size(); ++i)
        sweep.add_ring(spine[i], frames[i], scales[i], vrml_rotation(Vec3(turns[i]), turns[i].w));
    const bool joined = sweep.add_sides(spine.front() == spine.back());
    sweep.add_caps(!joined && fields.flag(request.node, "beginCap", true),
                   !joined && fields.flag(request.node, "endCap", true));
    apply_vrml_sides(request, surface);
    return surface;
}

}  // namespace burin::geometry
