// SPDX-License-Identifier: MIT
#include "haptics/forces/engagement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/contact/local_surface_search.hpp"

namespace burin::haptics {
namespace {

// Longest edge of a piece, of the tool's size, and longer by this share of its distance from the tool; the most parts
// into which an edge is cut.
constexpr float kPiece = 0.12f, kLonger = 0.3f;
constexpr std::uint32_t kMostParts = 48;
// A coarser look has longer pieces first, up to twice as long and so a quarter as many, and then fewer triangles.
constexpr std::uint32_t kByLength = 4, kEvenly = 8;
// A piece belongs to a sample no farther to its side than this, of the sample's half width.
constexpr float kBeside = 2.0f;
// The surface around a sample fits it where both normals are opposite by so much, and turn alike from the sample to so
// many of those beside it: on a plane, where a ball's alone turn, to none; at the rim of a bed to half of them.
constexpr float kNotOpposite = 0.9f, kOpposite = 0.98f;
constexpr float kNoneAlike = 0.15f, kEnoughAlike = 0.4f;
// Between samples whose normals have this cosine at least what they have too much is shared, in so many rounds.
constexpr float kAlikeSamples = 0.7f, kLeastCovered = 0.6f, kLeastIfCoarse = 0.25f;
constexpr int kSurplusRounds = 3;
// From this stride on a look goes less far, down to this share of its reach: what is far off is most of what is looked
// at, and the next look comes long before the tool is there.
constexpr double kFarStride = 64.0, kLeastReach = 0.25;
// Of the tool's size: how far a look for bearing goes.
constexpr double kBearingReach = 0.25;
// Turns by less than this, in radians, are none.
constexpr float kFlat = 0.05f;

// Rows of the matrix that turns the object's axes into the tool's.
struct Turn {
    explicit Turn(const Quat& object_from_tool) {
        const Quat tool_from_object = glm::conjugate(object_from_tool);
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 unit(0.0);
            unit[axis] = 1.0;
            columns[axis] = Vec3f(tool_from_object * unit);
        }
    }
    [[nodiscard]] Vec3f operator()(const Vec3f& v) const {
        return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
    }
    Vec3f columns[3];
};

// Sums over the pieces of each sample, in the tool's frame.
class Pieces {
public:
    Pieces(const ToolSurface& tool, std::uint32_t stride, float weight, std::uint32_t most)
        : tool_(tool),
          weight_(weight),
          longest_m_(kPiece * std::sqrt(static_cast<float>(std::min(stride, kByLength))) *
                     static_cast<float>(tool.size_m)),
          left_(most),
          most_(most) {}

    // Adds a triangle, counter-clockwise seen from outside; false when no more pieces are allowed.
    bool add(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
        const Vec3f u = b - a, v = c - a, w = c - b;
        const Vec3f area = 0.5f * glm::cross(u, v);
        const float longest2 = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
        const Vec3f middle = (a + b + c) / 3.0f;
        if (longest2 <= longest_m_ * longest_m_) return add_piece(middle, area);
        const float edge_m = std::sqrt(longest2);
        const float piece_m = longest_m_ + kLonger * std::max(0.0f, distance_m(middle) - edge_m);
        const auto parts =
            static_cast<std::uint32_t>(std::min(std::ceil(edge_m / piece_m), static_cast<float>(kMostParts)));
        const float share = 1.0f / static_cast<float>(parts);
        const Vec3f piece = area * (share * share);
        for (std::uint32_t j = 0; j < parts; ++j)
            for (std::uint32_t i = 0; i + j < parts; ++i) {
                const Vec3f corner = a + share * (static_cast<float>(i) * u + static_cast<float>(j) * v);
                if (!add_piece(corner + (u + v) * (share / 3.0f), piece)) return false;
                if (i + j + 1 < parts && !add_piece(corner + (u + v) * (share * 2.0f / 3.0f), piece)) return false;
            }
        return true;
    }
    // Adds a vertex that stands for the triangles around it; false when no more are allowed.
    bool add_vertex(const Vec3f& place_m, const Vec3f& normal) {
        if (left_ == 0) return false;
        --left_;
        const std::uint8_t nearest = owner_of(place_m, normal);
        if (nearest == ToolSurface::kNone) return true;
        Sum& sum = sums_[nearest];
        sum.normal += normal;
        sum.offset += glm::dot(normal, place_m);
        ++sum.vertices;
        return true;
    }
    // Where vertices are as dense as on average before the samples that have any, they cover the sample.
    void spread_vertices() {
        float own_m2 = 0.0f, vertices = 0.0f;
        for (std::uint32_t i = 0; i < tool_.count; ++i)
            if (sums_[i].vertices > 0) own_m2 += tool_.samples[i].area_m2, vertices += vertices_of(i);
        if (!(vertices > 0.0f)) return;
        for (std::uint32_t i = 0; i < tool_.count; ++i) sums_[i].covered_m2 += vertices_of(i) * own_m2 / vertices;
    }
    // Pieces are given whole to one sample, and the coarser the look the fewer they are: what one sample has too much
    // another beside it lacks. Without this their areas, each at most its own, add up to less than the tool's.
    void share_surplus() {
        for (int round = 0; round < kSurplusRounds; ++round)
            for (std::uint32_t i = 0; i < tool_.count; ++i) share_surplus_of(i);
    }
    [[nodiscard]] std::uint32_t used() const { return most_ - left_; }

    // The samples that something faces, relative to the tool's place, in the object's axes.
    void collect(const Quat& object_from_tool, Engagement& engagement) const {
        for (std::uint32_t i = 0; i < tool_.count && engagement.count < Engagement::kMost; ++i) {
            const Sum& sum = sums_[i];
            const float length = std::sqrt(glm::dot(sum.normal, sum.normal));
            if (!(length > 0.0f)) continue;
            EngagedSample& s = engagement.samples[engagement.count++];
            s.normal = Vec3f(object_from_tool * Vec3(sum.normal / length));
            s.offset_m = sum.offset / length;
            s.area_m2 = std::min(tool_.samples[i].area_m2, sum.covered_m2);
            s.fit = fit_of(i);
            s.sample = i;
        }
    }

private:
    // About how far a place is from the tool.
    [[nodiscard]] float distance_m(const Vec3f& place_m) const {
        const std::uint8_t nearest = tool_.nearest(place_m);
        if (nearest == ToolSurface::kNone) return static_cast<float>(tool_.reach_m);
        const Vec3f way = place_m - tool_.samples[nearest].position_m;
        return std::sqrt(glm::dot(way, way));
    }
    // The surface's unit normal as seen by a sample; zero where it sees none.
    [[nodiscard]] Vec3f out_of(std::uint32_t i) const {
        const float length = std::sqrt(glm::dot(sums_[i].normal, sums_[i].normal));
        return length > 0.0f ? sums_[i].normal / length : Vec3f(0.0f);
    }
    [[nodiscard]] float fit_of(std::uint32_t own) const {
        const ToolSample& sample = tool_.samples[own];
        const Vec3f out = out_of(own);
        float alike = 0.0f, count = 0.0f;
        for (const std::uint8_t i : sample.beside) {
            const Vec3f beside = out_of(i);
            if (beside == Vec3f(0.0f)) continue;
            const Vec3f turn = tool_.samples[i].normal - sample.normal;
            const float both = glm::dot(out - beside, turn) + kFlat * kFlat;
            alike += std::clamp(both / (glm::dot(turn, turn) + kFlat * kFlat), 0.0f, 1.0f);
            count += 1.0f;
        }
        if (count == 0.0f) return 0.0f;
        const float opposite = (-glm::dot(out, sample.normal) - kNotOpposite) / (kOpposite - kNotOpposite);
        const float enough = (alike / count - kNoneAlike) / (kEnoughAlike - kNoneAlike);
        return std::clamp(opposite, 0.0f, 1.0f) * std::clamp(enough, 0.0f, 1.0f);
    }

    void share_surplus_of(std::uint32_t i) {
        const float surplus = sums_[i].covered_m2 - tool_.samples[i].area_m2;
        if (!(surplus > 0.0f)) return;
        // What lacks more lies at the rim of what is engaged.
        const float least = weight_ > 1.0f ? kLeastIfCoarse : kLeastCovered;
        const auto lack_of = [&](std::uint8_t k) {
            const bool alike = glm::dot(tool_.samples[k].normal, tool_.samples[i].normal) > kAlikeSamples;
            return alike && sums_[k].covered_m2 > least * tool_.samples[k].area_m2
                       ? std::max(tool_.samples[k].area_m2 - sums_[k].covered_m2, 0.0f)
                       : 0.0f;
        };
        float lacking = 0.0f;
        for (const std::uint8_t k : tool_.samples[i].beside) lacking += lack_of(k);
        if (!(lacking > 0.0f)) return;
        const float share = std::min(1.0f, surplus / lacking);
        for (const std::uint8_t k : tool_.samples[i].beside) {
            const float given = share * lack_of(k);
            sums_[k].covered_m2 += given;
            sums_[i].covered_m2 -= given;
        }
    }
    [[nodiscard]] float vertices_of(std::uint32_t i) const { return static_cast<float>(sums_[i].vertices); }
    // The sample that a piece of surface belongs to; kNone: none.
    [[nodiscard]] std::uint8_t owner_of(const Vec3f& place_m, const Vec3f& out_of_material) const {
        const std::uint8_t nearest = tool_.nearest_facing(place_m, out_of_material);
        if (nearest == ToolSurface::kNone) return nearest;
        const ToolSample& sample = tool_.samples[nearest];
        const Vec3f way = place_m - sample.position_m;
        const float out = glm::dot(way, sample.normal);
        const float beside2 = glm::dot(way, way) - out * out;
        const float most = kBeside * sample.half_width_m;
        return out > static_cast<float>(tool_.reach_m) || beside2 > most * most ? ToolSurface::kNone : nearest;
    }
    bool add_piece(const Vec3f& place_m, const Vec3f& area_m2) {
        if (left_ == 0) return false;
        --left_;
        const std::uint8_t nearest = owner_of(place_m, area_m2);
        if (nearest == ToolSurface::kNone) return true;
        const float facing = -glm::dot(area_m2, tool_.samples[nearest].normal);
        Sum& sum = sums_[nearest];
        sum.normal += weight_ * area_m2;
        sum.offset += weight_ * glm::dot(area_m2, place_m);
        sum.covered_m2 += weight_ * facing;
        return true;
    }

    struct Sum {
        Vec3f normal{0.0f};
        float offset = 0.0f, covered_m2 = 0.0f;
        std::uint32_t vertices = 0;
    };
    const ToolSurface& tool_;
    float weight_, longest_m_;
    std::uint32_t left_, most_;
    std::array<Sum, ToolSurface::kMost> sums_{};
};

// A box in the object's axes, relative to the tool's place, around the tool as it is turned.
Box around(const ToolSurface& tool, const Quat& object_from_tool) {
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.include(object_from_tool * Vec3((corner & 1) != 0 ? tool.hi_m.x : tool.lo_m.x,
                                            (corner & 2) != 0 ? tool.hi_m.y : tool.lo_m.y,
                                            (corner & 4) != 0 ? tool.hi_m.z : tool.lo_m.z));
    return box;
}

// The same tool by the segment along its longest side, near which vertices are looked for.
geometry::Near near_axis(const ToolSurface& tool, const Vec3& place, const Quat& object_from_tool, double reach_m) {
    Vec3 across = 0.5 * Vec3(tool.hi_m - tool.lo_m);
    const Vec3 middle = place + object_from_tool * (0.5 * Vec3(tool.hi_m + tool.lo_m));
    const int longest = across.x >= across.y && across.x >= across.z ? 0 : (across.y >= across.z ? 1 : 2);
    Vec3 half(0.0);
    std::swap(half[longest], across[longest]);
    const Vec3 from = middle - object_from_tool * half, to = middle + object_from_tool * half;
    return {.lo = glm::min(from, to),
            .hi = glm::max(from, to),
            .reach_m = glm::length(across) + reach_m,
            .by_way = true,
            .from = from,
            .to = to};
}

}  // namespace

EngagementLook look_around(const geometry::LocalSurface& surface, const ToolSurface& tool, const Vec3& place_object_m,
                           const Quat& orientation_object, std::uint32_t stride, const EngagementWork& most,
                           LookFor purpose) noexcept {
    const bool bearing = purpose == LookFor::bearing;
    EngagementLook look;
    look.engagement.place_object_m = place_object_m;
    look.engagement.orientation_object = orientation_object;
    look.engagement.surface_sequence = surface.sequence;
    look.engagement.stride = stride;
    look.engagement.for_bearing = bearing;
    if (tool.count == 0) return look;
    const Vec3 place = place_object_m - surface.origin_object;
    const Box box = around(tool, orientation_object);
    const double share = std::clamp(std::sqrt(kFarStride / static_cast<double>(stride)), kLeastReach, 1.0);
    geometry::Near near{place + box.lo, place + box.hi, share * tool.reach_m};
    near.looks_left = most.looks;
    const Turn turned(orientation_object);
    // Of the triangles each so manieth is taken, evenly; beyond kEvenly they are too many to be looked at, and pairs of
    // them are passed by. By an odd number: rows of a tile have 16 cells, and every 16th quad of a plane would be of
    // one column.
    const std::uint32_t wanted = std::max(1u, stride / kByLength);
    const std::uint32_t thin = wanted < 4 * kEvenly ? 1 : wanted / kEvenly - 1;
    const std::uint32_t evenly = thin == 1 ? wanted : kEvenly, each = thin * evenly;
    Pieces pieces(tool, stride, static_cast<float>(each), most.pieces);
    near.thin = thin;
    std::uint32_t visited = 0;
    const auto add_triangle = [&](std::uint32_t, const geometry::Triangle& t) {
        if (visited++ % evenly != 0) return true;
        return pieces.add(turned(Vec3f(t.a - place)), turned(Vec3f(t.b - place)), turned(Vec3f(t.c - place)));
    };
    if (bearing) {
        const auto add_vertex = [&](const geometry::SurfacePoint& point) {
            return pieces.add_vertex(turned(Vec3f(point.position - place)), turned(Vec3f(point.normal())));
        };
        near = near_axis(tool, place, orientation_object, kBearingReach * tool.size_m);
        near.looks_left = most.looks;
        near.thin = thin;
        look.complete = geometry::for_each_near(
            surface, near,
            geometry::MixedVisitor{add_triangle, add_vertex,
                                   geometry::Fineness{static_cast<double>(kPiece) * tool.size_m, each}});
        pieces.spread_vertices();
    } else {
        look.complete = geometry::for_each_triangle_near(surface, near, add_triangle);
        pieces.share_surplus();
    }
    look.work = {most.looks - near.looks_left, pieces.used()};
    pieces.collect(orientation_object, look.engagement);
    return look;
}

Vec3 into_material(const geometry::LocalSurface& surface, const Vec3& place_object_m, double reach_m) noexcept {
    const Vec3 place = place_object_m - surface.origin_object;
    Vec3 sum_m2(0.0), from_within_m2(0.0);
    geometry::Near near{place, place, reach_m};
    (void)geometry::for_each_triangle_near(surface, near, [&](std::uint32_t, const geometry::Triangle& t) {
        const Vec3 u = t.b - t.a, v = t.c - t.a;
        const Vec3 area = 0.5 * glm::cross(u, v);
        // A large triangle is looked at in parts, each of which counts where it is near.
        const double longest = std::sqrt(std::max(glm::dot(u, u), glm::dot(v, v)));
        const auto parts = static_cast<int>(std::clamp(std::ceil(3.0 * longest / reach_m), 1.0, 24.0));
        const double share = 1.0 / parts;
        const auto include = [&](const Vec3& middle) {
            const Vec3 way = middle - place;
            if (glm::dot(way, way) > reach_m * reach_m) return;
            (glm::dot(way, area) < 0.0 ? sum_m2 : from_within_m2) += area * (share * share);
        };
        for (int j = 0; j < parts; ++j)
            for (int i = 0; i + j < parts; ++i) {
                const Vec3 corner = t.a + share * (static_cast<double>(i) * u + static_cast<double>(j) * v);
                include(corner + (u + v) * (share / 3.0));
                if (i + j + 1 < parts) include(corner + (u + v) * (share * 2.0 / 3.0));
            }
        return true;
    });
    if (sum_m2 == Vec3(0.0)) sum_m2 = from_within_m2;
    const double length = std::sqrt(glm::dot(sum_m2, sum_m2));
    return length > 1e-9 * reach_m * reach_m ? -sum_m2 / length : Vec3(0.0);
}

}  // namespace burin::haptics
