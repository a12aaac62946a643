// SPDX-License-Identifier: MIT
#include "tests/geometry/polygon_samples.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace burin::geometry::test {
namespace {

constexpr double kRadius = 1e8;

LatticePoint on_lattice(double x, double y) {
    const auto rounded = [](double v) { return kLattice * std::llround(v / static_cast<double>(kLattice)); };
    return {rounded(x), rounded(y)};
}

LatticePoint polar(double radius, double angle) {
    return on_lattice(radius * std::cos(angle), radius * std::sin(angle));
}

std::size_t from_to(std::mt19937_64& random, std::size_t least, std::size_t most) {
    return least + random() % (most - least + 1);
}

// The space between two curves around the origin, run through on the outer one and back on the inner.
LatticePolygon band(std::size_t corners_on_a_side, double turned_by, const auto& outer, const auto& inner) {
    LatticePolygon p;
    const auto angle = [&](std::size_t i) {
        return turned_by * static_cast<double>(i) / static_cast<double>(corners_on_a_side - 1);
    };
    for (std::size_t i = 0; i < corners_on_a_side; ++i) p.push_back(polar(outer(angle(i)), angle(i)));
    for (std::size_t i = corners_on_a_side; i-- > 0;) p.push_back(polar(inner(angle(i)), angle(i)));
    return p;
}

int side_of(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    const std::int64_t area = twice_area(a, b, c);
    return (area > 0 ? 1 : 0) - (area < 0 ? 1 : 0);
}

bool meet(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& d) {
    return side_of(a, b, c) * side_of(a, b, d) <= 0 && side_of(c, d, a) * side_of(c, d, b) <= 0;
}

}  // namespace

std::int64_t twice_area(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::int64_t twice_area(const LatticePolygon& p) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const LatticePoint &a = p[i], &b = p[(i + 1) % p.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

LatticePolygon star(std::mt19937_64& random, std::size_t corners) {
    LatticePolygon p;
    for (std::size_t i = 0; i < corners; ++i) {
        const double radius = kRadius * static_cast<double>(from_to(random, 2, 100)) / 100.0;
        p.push_back(polar(radius, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners)));
    }
    return p;
}

LatticePolygon comb(std::mt19937_64& random, std::size_t teeth) {
    const std::int64_t width = kLattice * 512;
    const auto right = static_cast<std::int64_t>(2 * teeth) * width;
    LatticePolygon p{{-width, -width}, {right, -width}};
    for (std::size_t i = teeth; i-- > 0;) {
        const std::int64_t x = static_cast<std::int64_t>(2 * i) * width;
        const std::int64_t high = kLattice * static_cast<std::int64_t>(from_to(random, 1, 3) * 20000);
        p.insert(p.end(), {{x + width, 0}, {x + width, high}, {x, high}, {x, 0}});
    }
    p[1].x = right - width;
    p.push_back({-width, 0});
    return p;
}

LatticePolygon spiral(std::size_t corners_on_a_side, double turns) {
    const double all = 2 * std::numbers::pi * turns;
    return band(
        corners_on_a_side, all, [&](double a) { return kRadius * (0.1 + (0.85 * a + 2.0) / (all + 7.0)); },
        [&](double a) { return kRadius * (0.1 + 0.85 * a / (all + 7.0)); });
}

LatticePolygon letter_c(std::size_t corners_on_a_side) {
    return band(corners_on_a_side, 5.2, [](double) { return kRadius; }, [](double) { return 0.5 * kRadius; });
}

LatticePolygon gear(std::size_t teeth) {
    LatticePolygon p;
    for (std::size_t i = 0; i < 4 * teeth; ++i) {
        const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(4 * teeth);
        p.push_back(polar(i % 4 < 2 ? kRadius : 0.85 * kRadius, a));
    }
    return p;
}

LatticePolygon skyline(std::mt19937_64& random, std::size_t steps) {
    const std::int64_t unit = kLattice * 1024;
    LatticePolygon p;
    for (std::size_t i = 0; i <= steps; ++i) p.push_back({static_cast<std::int64_t>(i) * unit, 0});
    for (std::size_t i = steps; i-- > 0;) {
        const auto x = static_cast<std::int64_t>(i) * unit;
        const auto high = static_cast<std::int64_t>(from_to(random, 1, 4)) * unit;
        const bool level = p.back().y == high && p.back().x == x + unit;
        if (!level) p.push_back({x + unit, high});
        p.push_back({x, high});
    }
    return p;
}

LatticePolygon uncrossed(std::mt19937_64& random, std::size_t corners) {
    LatticePolygon p;
    for (std::size_t i = 0; i < corners; ++i) {
        const auto place = [&] { return kRadius * (static_cast<double>(random() % 2000001) / 1e6 - 1.0); };
        p.push_back(on_lattice(place(), place()));
    }
    const auto exchange_once = [&] {
        for (std::size_t i = 0; i + 2 < corners; ++i) {
            for (std::size_t k = i + 2; k < corners; ++k) {
                if ((k + 1) % corners == i || !meet(p[i], p[i + 1], p[k], p[(k + 1) % corners])) continue;
                const auto first = p.begin() + static_cast<std::ptrdiff_t>(i) + 1;
                std::reverse(first, first + static_cast<std::ptrdiff_t>(k - i));
                return true;
            }
        }
        return false;
    };
    while (exchange_once()) {
    }
    if (twice_area(p) < 0) std::ranges::reverse(p);
    return p;
}

LatticePolygon any_outline(std::mt19937_64& random) {
    switch (from_to(random, 0, 6)) {
        case 0: return star(random, from_to(random, 3, 100));
        case 1: return comb(random, from_to(random, 1, 40));
        case 2: return spiral(from_to(random, 40, 100), static_cast<double>(from_to(random, 1, 6)) / 2.0);
        case 3: return letter_c(from_to(random, 10, 100));
        case 4: return gear(from_to(random, 3, 40));
        case 5: return skyline(random, from_to(random, 1, 60));
        default: return uncrossed(random, from_to(random, 3, 30));
    }
}

LatticePolygon with_corners_on_edges(std::mt19937_64& random, LatticePolygon p) {
    for (std::size_t more = from_to(random, 0, 8); more > 0; --more) {
        const std::size_t i = random() % p.size(), next = (i + 1) % p.size();
        const LatticePoint middle{(p[i].x + p[next].x) / 2, (p[i].y + p[next].y) / 2};
        p.insert(p.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
    }
    return p;
}

LatticePolygon slit_ring(std::size_t corners_on_a_side) {
    return band(
        corners_on_a_side, 2 * std::numbers::pi, [](double) { return kRadius; }, [](double) { return 0.5 * kRadius; });
}

std::vector<Vec3> in_space(const LatticePolygon& polygon) {
    std::vector<Vec3> corners;
    for (const LatticePoint& p : polygon) corners.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y), 0.0);
    return corners;
}

std::string fault_of_edges(const SplitPolygon& split, std::size_t corners) {
    if (split.triangles.size() + 2 != corners) return "there are not two triangles less than corners";
    std::set<std::array<std::uint32_t, 2>> edges;
    for (const auto& t : split.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (!edges.insert({t[k], t[(k + 1) % 3]}).second) return "an edge has two triangles on one side";
        }
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % corners);
        if (edges.erase({i, next}) == 0) return "an edge of the polygon is no edge of a triangle";
    }
    for (const auto& [a, b] : edges) {
        if (!edges.contains({b, a})) return "an edge inside has a triangle on one side only";
    }
    return "";
}

std::string fault_of(const SplitPolygon& split, const LatticePolygon& polygon) {
    if (std::string fault = fault_of_edges(split, polygon.size()); !fault.empty()) return fault;
    const std::int64_t area = twice_area(polygon);
    std::int64_t sum = 0;
    for (const auto& [a, b, c] : split.triangles) {
        const std::int64_t part = twice_area(polygon[a], polygon[b], polygon[c]);
        if (part == 0) return "a triangle has no area";
        if ((part > 0) != (area > 0)) return "a triangle faces the other way";
        sum += part;
    }
    return sum == area ? "" : "the triangles' area is not the polygon's";
}

}  // namespace burin::geometry::test
