// SPDX-License-Identifier: MIT
#include "bench/measure/rough_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "bench/measure/split_mix.hpp"

namespace burin::bench {
namespace {

using geometry::TriangleMesh;

// ---- Noise

// Returns a number from -1 to 1 for each point of the whole numbers.
double at_node(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
    const auto mixed = static_cast<std::uint64_t>(x) * 0x8da6b343u ^ static_cast<std::uint64_t>(y) * 0xd8163841u ^
                       static_cast<std::uint64_t>(z) * 0xcb1ab31fu;
    return SplitMix(mixed * 0x9e3779b97f4a7c15u + seed).signed_unit();
}

// Interpolates between the points of the whole numbers; its slope is continuous.
double noise(const Vec3& p, std::uint64_t seed) {
    const Vec3 low = glm::floor(p), f = p - low, w = f * f * (3.0 - 2.0 * f);
    const auto x = static_cast<std::int64_t>(low.x), y = static_cast<std::int64_t>(low.y),
               z = static_cast<std::int64_t>(low.z);
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const int i = k & 1, j = k >> 1 & 1, l = k >> 2;
        const double weight = (i ? w.x : 1.0 - w.x) * (j ? w.y : 1.0 - w.y) * (l ? w.z : 1.0 - w.z);
        sum += weight * at_node(x + i, y + j, z + l, seed);
    }
    return sum;
}

class RoughHeight {
public:
    RoughHeight(const Roughness& roughness, double mean_edge_m)
        : roughness_(roughness), jitter_(roughness.seed ^ 0x51ed270bu), mean_edge_m_(mean_edge_m) {
        if (roughness_.shortest_m <= 0.0) roughness_.shortest_m = 3.0 * mean_edge_m;
    }
    // Returns a different number for the same place each time, because of the jitter.
    double at(const Vec3& p_m) {
        double height = roughness_.jitter * mean_edge_m_ * jitter_.signed_unit();
        std::uint64_t octave = 0;
        for (double wave_m = roughness_.longest_m; wave_m >= roughness_.shortest_m; wave_m *= 0.5, ++octave) {
            const double value = noise(2.0 / wave_m * p_m, roughness_.seed + octave);
            const bool ridged = octave % 2 == 1;
            height += roughness_.slope * wave_m * (ridged ? 0.5 - 2.0 * std::abs(value) : value);
        }
        return height;
    }

private:
    Roughness roughness_;
    SplitMix jitter_;
    double mean_edge_m_;
};

// ---- Balls and plates

// Spreads the points of a cube's surface evenly over the sphere, without a trigonometric function (P. Nowell 2005).
Vec3 on_unit_sphere(const Vec3& c) {
    const Vec3 s = c * c;
    return {c.x * std::sqrt(1.0 - 0.5 * (s.y + s.z) + s.y * s.z / 3.0),
            c.y * std::sqrt(1.0 - 0.5 * (s.z + s.x) + s.z * s.x / 3.0),
            c.z * std::sqrt(1.0 - 0.5 * (s.x + s.y) + s.x * s.y / 3.0)};
}

// A rectangular grid of vertices from `first` on, row after row, as two triangles a square; `up` turns them to +z.
void add_grid(TriangleMesh& mesh, std::uint32_t first, std::uint32_t columns, std::uint32_t rows, bool up) {
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            const std::uint32_t a = first + j * columns + i, b = a + 1, d = a + columns, c = d + 1;
            if (up) {
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({a, c, d});
            } else {
                mesh.triangles.push_back({a, c, b});
                mesh.triangles.push_back({a, d, c});
            }
        }
}

// Makes a plate of two grids over the same places, height(column, row, side) above and below the middle, and its walls.
TriangleMesh plate_of(const std::vector<double>& xs, const std::vector<double>& ys,
                      const std::function<double(std::size_t column, std::size_t row, int side)>& height) {
    TriangleMesh mesh;
    const auto columns = static_cast<std::uint32_t>(xs.size()), rows = static_cast<std::uint32_t>(ys.size());
    for (const int side : {0, 1})
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                mesh.positions_m.emplace_back(xs[i], ys[j], (side == 0 ? 1.0 : -1.0) * height(i, j, side));
    const std::uint32_t below = columns * rows;
    add_grid(mesh, 0, columns, rows, true);
    add_grid(mesh, below, columns, rows, false);
    const auto wall = [&](std::uint32_t a, std::uint32_t b) {  // a to b as the upper side's border runs
        mesh.triangles.push_back({b, a, below + a});
        mesh.triangles.push_back({b, below + a, below + b});
    };
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
        wall(i, i + 1);
        wall((rows - 1) * columns + i + 1, (rows - 1) * columns + i);
    }
    for (std::uint32_t j = 0; j + 1 < rows; ++j) {
        wall((j + 1) * columns, j * columns);
        wall(j * columns + columns - 1, (j + 1) * columns + columns - 1);
    }
    return mesh;
}

std::vector<double> evenly(double from, double to, std::uint32_t parts) {
    std::vector<double> places(parts + 1);
    for (std::uint32_t i = 0; i <= parts; ++i) places[i] = from + (to - from) * i / parts;
    return places;
}

// ---- Plates of cells, each with a hole, a boss or a needle within a round or pointed outline

using Outline =
    std::vector<Vec2>;  // around the cell's middle, counter-clockwise, starting nearest to its corner (1, 1)

// Returns the points of the unit circle at `sides` nearly equal angles, from that at 45 degrees on.
Outline circle(std::uint32_t sides) {
    const std::uint32_t eighth = sides / 8;
    Outline first;  // from 0 to 45 degrees, by the rational form: x = (1 - t^2) / (1 + t^2), y = 2 t / (1 + t^2)
    for (std::uint32_t i = 0; i <= eighth; ++i) {
        const double t = (std::sqrt(2.0) - 1.0) * i / eighth;
        first.emplace_back((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    }
    Outline points;
    for (std::uint32_t i = eighth; i > 0; --i) points.emplace_back(first[i].y, first[i].x);         // 45 to 90
    for (std::uint32_t i = 0; i < eighth; ++i) points.emplace_back(-first[i].y, first[i].x);        // 90 to 135
    for (std::uint32_t i = 0; i < 2 * eighth; ++i) points.emplace_back(-points[i].y, points[i].x);  // 135 to 225
    for (std::uint32_t i = 0; i < 4 * eighth; ++i) points.emplace_back(-points[i].x, -points[i].y);
    return points;
}

Outline scaled(Outline outline, const Vec2& by) {
    for (Vec2& p : outline) p *= by;
    return outline;
}

// A circle drawn out along x: a slot with round ends.
Outline stadium(std::uint32_t sides, double radius, double straight) {
    Outline outline = scaled(circle(sides), Vec2(radius));
    for (Vec2& p : outline) p.x += p.x >= 0.0 ? 0.5 * straight : -0.5 * straight;
    return outline;
}

Outline rectangle(double x, double y) { return {{x, y}, {-x, y}, {-x, -y}, {x, -y}}; }

// One ring of a cell's profile: its outline times `scale`, at this height.
struct Ring {
    double scale, z_m;
};

struct Cell {
    Outline outline;          // none: the cell is plain
    std::vector<Ring> rings;  // from the plate's face on, the first of scale 1
    bool through = false;     // the last ring is the outline in the other face; else it is closed by a fan
    bool pointed = false;     // closed to a point at the last ring's height
};

// Builds a plate of cells over [0, x] by [0, y], from z = -thickness to 0, all features in its upper face.
class CellPlate {
public:
    CellPlate(std::uint32_t columns, std::uint32_t rows, const Vec2& cell_m, double thickness_m)
        : columns_(columns), rows_(rows), cell_m_(cell_m) {
        for (const double z : {0.0, -thickness_m})
            for (std::uint32_t j = 0; j <= rows; ++j)
                for (std::uint32_t i = 0; i <= columns; ++i)
                    mesh_.positions_m.emplace_back(i * cell_m.x, j * cell_m.y, z);
        for (std::uint32_t i = 0; i < columns; ++i) {
            wall(corner(i, 0), corner(i + 1, 0));
            wall(corner(i + 1, rows), corner(i, rows));
        }
        for (std::uint32_t j = 0; j < rows; ++j) {
            wall(corner(0, j + 1), corner(0, j));
            wall(corner(columns, j), corner(columns, j + 1));
        }
    }

    void put(std::uint32_t i, std::uint32_t j, const Cell& cell) {
        // From the corner (1, 1) around, as outlines begin.
        const std::array<std::uint32_t, 4> around{corner(i + 1, j + 1), corner(i, j + 1), corner(i, j),
                                                  corner(i + 1, j)};
        const Vec3 middle((i + 0.5) * cell_m_.x, (j + 0.5) * cell_m_.y, 0.0);
        if (cell.outline.empty()) {
            quad(around[0], around[1], around[2], around[3]);
        } else {
            std::uint32_t ring = add_ring(cell, cell.rings[0], middle);
            const auto sides = static_cast<std::uint32_t>(cell.outline.size());
            face(around, ring, sides, true);
            for (std::size_t k = 1; k < cell.rings.size(); ++k) {
                if (cell.pointed && k + 1 == cell.rings.size()) {
                    close_to(ring, sides, middle + Vec3(0.0, 0.0, cell.rings[k].z_m));
                    break;
                }
                const std::uint32_t next = add_ring(cell, cell.rings[k], middle);
                for (std::uint32_t s = 0; s < sides; ++s) {
                    const std::uint32_t t = (s + 1) % sides;
                    quad(ring + s, ring + t, next + t, next + s);
                }
                ring = next;
            }
            if (!cell.pointed && !cell.through)
                for (std::uint32_t s = 1; s + 1 < sides; ++s) add(ring, ring + s, ring + s + 1);
            if (cell.through) {
                face(below(around), ring, sides, false);
                return;
            }
        }
        const auto under = below(around);
        quad(under[3], under[2], under[1], under[0]);
    }
    [[nodiscard]] TriangleMesh mesh() && { return std::move(mesh_); }

private:
    [[nodiscard]] std::uint32_t corner(std::uint32_t i, std::uint32_t j) const { return j * (columns_ + 1) + i; }
    [[nodiscard]] std::uint32_t below(std::uint32_t corner) const { return corner + (columns_ + 1) * (rows_ + 1); }
    [[nodiscard]] std::array<std::uint32_t, 4> below(const std::array<std::uint32_t, 4>& around) const {
        return {below(around[0]), below(around[1]), below(around[2]), below(around[3])};
    }
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.push_back({a, b, c}); }
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        add(a, b, c);
        add(a, c, d);
    }
    void wall(std::uint32_t a, std::uint32_t b) { quad(b, a, below(a), below(b)); }

    std::uint32_t add_ring(const Cell& cell, const Ring& ring, const Vec3& middle) {
        const auto first = static_cast<std::uint32_t>(mesh_.positions_m.size());
        for (const Vec2& p : cell.outline) mesh_.positions_m.push_back(middle + Vec3(ring.scale * p, ring.z_m));
        return first;
    }
    void close_to(std::uint32_t ring, std::uint32_t sides, const Vec3& tip) {
        const auto at = static_cast<std::uint32_t>(mesh_.positions_m.size());
        mesh_.positions_m.push_back(tip);
        for (std::uint32_t s = 0; s < sides; ++s) add(ring + s, ring + (s + 1) % sides, at);
    }
    // Fills between the cell's corners and an outline: each quarter of the outline is a fan around a corner.
    void face(const std::array<std::uint32_t, 4>& around, std::uint32_t ring, std::uint32_t sides, bool up) {
        const std::uint32_t quarter = sides / 4;
        const auto put = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { up ? add(a, b, c) : add(a, c, b); };
        for (std::uint32_t k = 0; k < 4; ++k) {
            // The quarter from corner k on belongs half to it and half to the next corner.
            const std::uint32_t from = k * quarter, half = from + (quarter + 1) / 2, to = from + quarter;
            const auto at = [&](std::uint32_t s) { return ring + s % sides; };
            const std::uint32_t here = around[k], next = around[(k + 1) % 4];
            for (std::uint32_t s = from; s < half; ++s) put(here, at(s + 1), at(s));
            put(here, next, at(half));
            for (std::uint32_t s = half; s < to; ++s) put(next, at(s + 1), at(s));
        }
    }

    std::uint32_t columns_, rows_;
    Vec2 cell_m_;
    TriangleMesh mesh_;
};

}  // namespace

geometry::TriangleMesh rough_ball(std::size_t triangles, const Roughness& roughness) {
    constexpr double kRadius_m = 0.05;
    const double squares = std::max(1.0, std::floor(std::sqrt(static_cast<double>(triangles) / 12.0) + 0.5));
    const auto n = static_cast<std::int64_t>(squares);
    RoughHeight height(roughness, kRadius_m * 1.8 / squares);  // a face of the cube spans some 90 degrees
    TriangleMesh mesh;
    std::map<std::array<std::int64_t, 3>, std::uint32_t> vertex_of;
    const auto vertex = [&](const std::array<std::int64_t, 3>& at) {
        const auto [known, is_new] = vertex_of.try_emplace(at, static_cast<std::uint32_t>(mesh.positions_m.size()));
        if (is_new) {
            const auto place = [&](std::int64_t i) { return 2.0 * static_cast<double>(i) / squares - 1.0; };
            const Vec3 direction = on_unit_sphere({place(at[0]), place(at[1]), place(at[2])});
            mesh.positions_m.push_back((kRadius_m + height.at(kRadius_m * direction)) * direction);
        }
        return known->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool far : {false, true})
            for (std::int64_t j = 0; j < n; ++j)
                for (std::int64_t i = 0; i < n; ++i) {
                    const auto corner = [&](std::int64_t u, std::int64_t v) {
                        std::array<std::int64_t, 3> at{};
                        at[axis] = far ? n : 0, at[(axis + 1) % 3] = u, at[(axis + 2) % 3] = far ? v : n - v;
                        return vertex(at);
                    };
                    const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                                        d = corner(i, j + 1);
                    mesh.triangles.push_back({a, b, c});
                    mesh.triangles.push_back({a, c, d});
                }
    return mesh;
}

geometry::TriangleMesh rough_plate(std::size_t triangles, const Roughness& roughness) {
    constexpr double kSide_m = 0.1, kHalf_m = 0.01;
    const double squares = std::max(1.0, std::floor(std::sqrt(static_cast<double>(triangles) / 4.0) + 0.5));
    const std::vector<double> places = evenly(0.0, kSide_m, static_cast<std::uint32_t>(squares));
    RoughHeight height(roughness, 1.1 * kSide_m / squares);
    return plate_of(places, places, [&](std::size_t i, std::size_t j, int side) {
        return std::max(kHalf_m + height.at({places[i], places[j], 0.5 * side}), 0.2 * kHalf_m);
    });
}

geometry::TriangleMesh file_plate(double pitch_m, double tooth_m) {
    constexpr double kSide_m = 0.1, kHalf_m = 0.003;
    std::vector<double> xs, saw, ys, notch;
    for (double x = 0.0; x < kSide_m; x += pitch_m) {
        xs.push_back(x), saw.push_back(0.0);
        xs.push_back(x + pitch_m * 11.0 / 12.0), saw.push_back(1.0);
    }
    xs.push_back(xs[xs.size() - 2] + pitch_m), saw.push_back(0.0);
    const double notches_m = 3.0 * pitch_m;
    for (double y = 0.0; y < kSide_m; y += notches_m) {
        ys.push_back(y), notch.push_back(0.5);
        ys.push_back(y + 0.2 * notches_m), notch.push_back(1.0);
        ys.push_back(y + 0.8 * notches_m), notch.push_back(1.0);
    }
    return plate_of(xs, ys,
                    [&](std::size_t i, std::size_t j, int /*side*/) { return kHalf_m + tooth_m * notch[j] * saw[i]; });
}

geometry::TriangleMesh machined_part(std::uint32_t sides) {
    constexpr double kDeep = -0.02;
    const Outline round = circle(sides);
    const std::vector<Cell> kinds{
        {scaled(round, Vec2(0.006)), {{1.0, 0.0}, {1.0, kDeep}}, true, false},                  // hole
        {scaled(round, Vec2(0.008)), {{1.0, 0.0}, {0.5, -0.004}, {0.5, kDeep}}, true, false},   // countersunk
        {stadium(sides, 0.003, 0.011), {{1.0, 0.0}, {1.0, -0.006}}, false, false},              // slot
        {scaled(round, Vec2(0.007)), {{1.0, 0.0}, {1.0, 0.009}, {0.9, 0.0097}}, false, false},  // chamfered boss
        {rectangle(0.009, 0.0006), {{1.0, 0.0}, {1.0, 0.008}}, false, false},                   // rib
        {rectangle(0.008, 0.0025), {{1.0, 0.0}, {1.0, -0.01}}, false, false},                   // groove
        {scaled(round, Vec2(0.009)), {{1.0, 0.0}, {0.9, -0.002}, {0.3, -0.002}, {0.25, 0.006}}, false, false},  // stud
        {{}, {}, false, false}};
    CellPlate plate(5, 3, Vec2(0.02), -kDeep);
    for (std::uint32_t j = 0; j < 3; ++j)
        for (std::uint32_t i = 0; i < 5; ++i) plate.put(i, j, kinds[(i + 5 * j + 2 * (j / 2)) % kinds.size()]);
    return std::move(plate).mesh();
}

geometry::TriangleMesh needle_comb(std::uint32_t needles) {
    constexpr double kSide_m = 0.1;
    const double cell_m = kSide_m / needles;
    const Cell needle{rectangle(0.3 * cell_m, 0.3 * cell_m), {{1.0, 0.0}, {0.0, 0.008}}, false, true};
    CellPlate plate(needles, needles, Vec2(cell_m), 0.01);
    for (std::uint32_t j = 0; j < needles; ++j)
        for (std::uint32_t i = 0; i < needles; ++i) plate.put(i, j, needle);
    return std::move(plate).mesh();
}

}  // namespace burin::bench
