// SPDX-License-Identifier: MIT
#include "bodies/mesh/tetrahedra.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <span>

#include "base/text.hpp"

namespace burin::bodies {
namespace {

using Cell = Tetrahedra::Cell;

double quality_of(const std::array<Vec3, 4>& p) {
    double squared = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) squared += glm::dot(p[i] - p[j], p[i] - p[j]) / 6.0;
    constexpr double kRegular = 8.48528137423857;  // 6 sqrt 2
    return kRegular * volume_m3(p[0], p[1], p[2], p[3]) / (squared * std::sqrt(squared));
}

std::array<Vec3, 4> corners_of(const Tetrahedra& body, const Cell& cell) {
    return {body.places_m[cell[0]], body.places_m[cell[1]], body.places_m[cell[2]], body.places_m[cell[3]]};
}

// Stuffs the solid where |p / half axes| < 1 with what the lattice's tetrahedra leave of themselves inside it.
class Stuffing {
public:
    Stuffing(const Vec3& half_axes_m, double spacing_m) : half_(half_axes_m), spacing_m_(spacing_m) {
        for (int axis = 0; axis < 3; ++axis)
            reach_[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(half_[axis] / spacing_m)) + 1;
    }
    Tetrahedra stuffed() {
        std::vector<Cell> lattice = lattice_cells();
        warp(lattice);
        for (const Cell& cell : lattice) cut(cell);
        return compacted();
    }

private:
    // Lattice points by twice their coordinates over the spacing: corners are even, middles odd.
    std::uint32_t point(int x, int y, int z) {
        const auto [at, is_new] = numbers_.try_emplace({x, y, z}, static_cast<std::uint32_t>(places_.size()));
        if (is_new) {
            places_.push_back(0.5 * spacing_m_ * Vec3(x, y, z));
            levels_.push_back(level(places_.back()));
        }
        return at->second;
    }
    // Below 0 inside.
    [[nodiscard]] double level(const Vec3& p) const { return glm::length(p / half_) - 1.0; }

    // Each face between two cubes' middles is shared by four tetrahedra, one for each of its edges.
    std::vector<Cell> lattice_cells() {
        std::vector<Cell> cells;
        for (int z = -reach_[2]; z < reach_[2]; ++z)
            for (int y = -reach_[1]; y < reach_[1]; ++y)
                for (int x = -reach_[0]; x < reach_[0]; ++x)
                    for (int axis = 0; axis < 3; ++axis) add_around_face(cells, {2 * x, 2 * y, 2 * z}, axis);
        return cells;
    }
    void add_around_face(std::vector<Cell>& cells, const std::array<int, 3>& corner, int axis) {
        const auto a = static_cast<std::size_t>(axis), b = (a + 1) % 3, c = (a + 2) % 3;
        const auto at = [&](int da, int db, int dc) {
            std::array<int, 3> p = corner;
            p[a] += da;
            p[b] += db;
            p[c] += dc;
            return point(p[0], p[1], p[2]);
        };
        const std::uint32_t below = at(-1, 1, 1), above = at(1, 1, 1);
        const std::array<std::uint32_t, 4> ring{at(0, 0, 0), at(0, 2, 0), at(0, 2, 2), at(0, 0, 2)};
        for (std::size_t i = 0; i < 4; ++i) cells.push_back(upright({ring[i], ring[(i + 1) % 4], below, above}));
    }
    [[nodiscard]] Cell upright(Cell cell) const {
        const double v = volume_m3(places_[cell[0]], places_[cell[1]], places_[cell[2]], places_[cell[3]]);
        if (v < 0.0) std::swap(cell[2], cell[3]);
        return cell;
    }

    // The share of the way from inside to outside at which the edge leaves the solid.
    [[nodiscard]] double crossing(const Vec3& inside, const Vec3& outside) const {
        const Vec3 p = inside / half_, d = (outside - inside) / half_;
        const double dd = glm::dot(d, d), pd = glm::dot(p, d), pp = glm::dot(p, p) - 1.0;
        return std::clamp((-pd + std::sqrt(std::max(pd * pd - dd * pp, 0.0))) / dd, 0.0, 1.0);
    }
    // Moves points onto the surface that are too near to a cut, each to its nearest.
    void warp(const std::vector<Cell>& lattice) {
        constexpr double kTooNear = 0.3;  // of an edge
        std::vector<double> nearest(places_.size(), kTooNear);
        std::vector<Vec3> moved = places_;
        std::vector<bool> on_surface(places_.size(), false);
        for (const Cell& cell : lattice)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < 4; ++j) {
                    const std::uint32_t in = cell[i], out = cell[j];
                    if (!(levels_[in] < 0.0) || levels_[out] < 0.0) continue;
                    const double t = crossing(places_[in], places_[out]);
                    const Vec3 cut = places_[in] + t * (places_[out] - places_[in]);
                    for (const auto& [at, share] : {std::pair(in, t), std::pair(out, 1.0 - t)})
                        if (share < nearest[at]) {
                            nearest[at] = share;
                            moved[at] = cut;
                            on_surface[at] = true;
                        }
                }
        places_ = std::move(moved);
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (on_surface[i]) levels_[i] = 0.0;
    }

    std::uint32_t cut_point(std::uint32_t in, std::uint32_t out) {
        const auto [at, is_new] = cuts_.try_emplace({in, out}, static_cast<std::uint32_t>(places_.size()));
        if (is_new) {
            places_.push_back(places_[in] + crossing(places_[in], places_[out]) * (places_[out] - places_[in]));
            levels_.push_back(0.0);
        }
        return at->second;
    }
    // Keeps the part of a tetrahedron within the surface: corners inside (i), on the surface (s), outside (o).
    void cut(const Cell& cell) {
        std::vector<std::uint32_t> i, s, o;
        for (const std::uint32_t corner : cell)
            (levels_[corner] < 0.0 ? i : levels_[corner] > 0.0 ? o : s).push_back(corner);
        if (i.empty()) return;
        if (o.empty()) return add(cell);
        if (i.size() == 1) {
            std::vector<std::uint32_t> left{i[0]};
            left.insert(left.end(), s.begin(), s.end());
            for (const std::uint32_t out : o) left.push_back(cut_point(i[0], out));
            return add({left[0], left[1], left[2], left[3]});
        }
        if (i.size() == 3) {
            const auto c = [&](std::size_t k) { return cut_point(i[k], o[0]); };
            return add_prism({i[0], i[1], i[2], c(0), c(1), c(2)});
        }
        if (o.size() == 2)
            return add_prism({i[0], cut_point(i[0], o[0]), cut_point(i[0], o[1]), i[1], cut_point(i[1], o[0]),
                              cut_point(i[1], o[1])});
        add_pyramid({i[0], i[1], cut_point(i[1], o[0]), cut_point(i[0], o[0])}, s[0]);
    }
    void add(const Cell& cell) { cells_.push_back(upright(cell)); }
    // A quadrilateral, its corners around it, and an apex.
    void add_pyramid(const std::array<std::uint32_t, 4>& base, std::uint32_t apex) {
        const auto least = static_cast<std::size_t>(std::ranges::min_element(base) - base.begin());
        const auto at = [&](std::size_t k) { return base[(least + k) % 4]; };
        add({at(0), at(1), at(2), apex});
        add({at(0), at(2), at(3), apex});
    }
    // Two triangles, corner by corner opposite: the least corner with the triangle and the quadrilateral that do not
    // meet it.
    void add_prism(const std::array<std::uint32_t, 6>& p) {
        const auto least = static_cast<std::size_t>(std::ranges::min_element(p) - p.begin());
        const std::size_t own = least / 3, k = least % 3, next = (k + 1) % 3, last = (k + 2) % 3;
        const auto here = [&](std::size_t corner) { return p[3 * own + corner]; };
        const auto there = [&](std::size_t corner) { return p[3 * (1 - own) + corner]; };
        add({here(k), there(k), there(next), there(last)});
        add_pyramid({here(next), here(last), there(last), there(next)}, here(k));
    }

    [[nodiscard]] Tetrahedra compacted() const {
        constexpr std::uint32_t kUnused = 0xffffffffu;
        std::vector<std::uint32_t> number(places_.size(), kUnused);
        Tetrahedra body;
        for (const Cell& cell : cells_) {
            Cell renumbered{};
            for (std::size_t c = 0; c < 4; ++c) {
                if (number[cell[c]] == kUnused) {
                    number[cell[c]] = static_cast<std::uint32_t>(body.places_m.size());
                    body.places_m.push_back(places_[cell[c]]);
                }
                renumbered[c] = number[cell[c]];
            }
            body.cells.push_back(renumbered);
        }
        return body;
    }

    Vec3 half_;
    double spacing_m_;
    std::array<int, 3> reach_{};
    std::map<std::array<int, 3>, std::uint32_t> numbers_;
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> cuts_;
    std::vector<Vec3> places_;
    std::vector<double> levels_;
    std::vector<Cell> cells_;
};

// Moves points towards the middle of their neighbours, on the surface along it, where the worst element around gains.
void smooth(Tetrahedra& body, const Vec3& half_axes_m) {
    constexpr int kPasses = 8;
    std::vector<std::vector<std::uint32_t>> around(body.places_m.size());
    for (std::uint32_t c = 0; c < body.cells.size(); ++c)
        for (const std::uint32_t corner : body.cells[c]) around[corner].push_back(c);
    const auto worst_around = [&](std::uint32_t point) {
        double worst = 1.0;
        for (const std::uint32_t c : around[point])
            worst = std::min(worst, quality_of(corners_of(body, body.cells[c])));
        return worst;
    };
    for (int pass = 0; pass < kPasses; ++pass)
        for (std::uint32_t point = 0; point < body.places_m.size(); ++point) {
            const Vec3 before = body.places_m[point];
            const bool on_surface = std::abs(glm::length(before / half_axes_m) - 1.0) < 1e-9;
            Vec3 sum(0.0);
            double count = 0.0;
            for (const std::uint32_t c : around[point])
                for (const std::uint32_t other : body.cells[c]) {
                    const bool counts =
                        !on_surface || std::abs(glm::length(body.places_m[other] / half_axes_m) - 1.0) < 1e-9;
                    if (other == point || !counts) continue;
                    sum += body.places_m[other];
                    count += 1.0;
                }
            if (count == 0.0) continue;
            const double worst = worst_around(point);
            Vec3 moved = 0.5 * (before + sum / count);
            if (on_surface) moved /= glm::length(moved / half_axes_m);
            body.places_m[point] = moved;
            if (worst_around(point) < worst) body.places_m[point] = before;
        }
}

}  // namespace

double volume_m3(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return glm::dot(glm::cross(b - a, c - a), d - a) / 6.0;
}

double volume_m3(const Tetrahedra& body) {
    double sum = 0.0;
    for (const Cell& cell : body.cells) {
        const auto p = corners_of(body, cell);
        sum += volume_m3(p[0], p[1], p[2], p[3]);
    }
    return sum;
}

double worst_quality(const Tetrahedra& body) {
    double worst = 1.0;
    for (const Cell& cell : body.cells) worst = std::min(worst, quality_of(corners_of(body, cell)));
    return worst;
}

Result<Tetrahedra> ellipsoid(const Vec3& half_axes_m, double spacing_m) {
    for (int axis = 0; axis < 3; ++axis) {
        const double cells = half_axes_m[axis] / spacing_m;
        if (!(half_axes_m[axis] > 0.0) || !(spacing_m > 0.0) || !(cells >= 3.0 && cells <= 40.0))
            return fail("body", formatted("has a half axis of %g m in elements of %g m", half_axes_m[axis], spacing_m),
                        "give 3 to 40 elements along each half axis");
    }
    Tetrahedra body = Stuffing(half_axes_m, spacing_m).stuffed();
    smooth(body, half_axes_m);
    const double wanted_m3 = 4.0 / 3.0 * std::numbers::pi * half_axes_m.x * half_axes_m.y * half_axes_m.z;
    const double grown = std::cbrt(wanted_m3 / volume_m3(body));
    for (Vec3& place : body.places_m) place *= grown;
    return body;
}

}  // namespace burin::bodies
