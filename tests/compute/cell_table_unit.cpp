// SPDX-License-Identifier: MIT
#include "compute/mesher/cell_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace burin::compute::test {
namespace {

// Corner offsets of the ends of an edge, from the numbering in the header.
std::array<int, 2> ends_of_edge(int edge) {
    const int axis = edge / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int low = ((edge & 1) << u) | ((edge >> 1 & 1) << v);
    return {low, low | (1 << axis)};
}

std::vector<int> edges_of_face(int face) {
    const int axis = face / 2, side = face % 2;
    std::vector<int> edges;
    for (int e = 0; e < 12; ++e) {
        const auto ends = ends_of_edge(e);
        if ((ends[0] >> axis & 1) == side && (ends[1] >> axis & 1) == side) edges.push_back(e);
    }
    return edges;
}

bool inside(unsigned pattern, int corner) { return (pattern >> corner & 1u) != 0; }

bool crossed(unsigned pattern, int edge) {
    const auto ends = ends_of_edge(edge);
    return inside(pattern, ends[0]) != inside(pattern, ends[1]);
}

std::vector<int> crossed_edges_of_face(unsigned pattern, int face) {
    std::vector<int> result;
    for (const int e : edges_of_face(face)) {
        if (crossed(pattern, e)) result.push_back(e);
    }
    return result;
}

// The pairs that the header's rule joins on a face.
std::vector<std::array<int, 2>> joins_on_face(unsigned pattern, int face) {
    const auto edges = crossed_edges_of_face(pattern, face);
    if (edges.size() == 2) return {{edges[0], edges[1]}};
    std::vector<std::array<int, 2>> joins;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (std::size_t k = i + 1; k < edges.size(); ++k) {
            for (const int a : ends_of_edge(edges[i])) {
                for (const int b : ends_of_edge(edges[k])) {
                    if (a == b && inside(pattern, a)) joins.push_back({edges[i], edges[k]});
                }
            }
        }
    }
    return joins;
}

}  // namespace

TEST(CellTable, EveryCrossedEdgeIsInExactlyOneLoop) {
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const CellCase& c = cell_table()[pattern];
        ASSERT_LE(c.loops, 4);
        std::set<int> used;
        for (int e = 0; e < 12; ++e) {
            const std::uint8_t loop = c.loop_of_edge[static_cast<std::size_t>(e)];
            ASSERT_EQ(loop != kNotCrossed, crossed(pattern, e)) << pattern << " edge " << e;
            if (loop == kNotCrossed) continue;
            ASSERT_LT(loop, c.loops);
            used.insert(loop);
        }
        ASSERT_EQ(used.size(), c.loops) << pattern;
    }
    EXPECT_EQ(cell_table()[0].loops, 0);
    EXPECT_EQ(cell_table()[255].loops, 0);
}

// Walking from join to join returns to the start having seen exactly the loop's edges.
TEST(CellTable, LoopsCloseOverTheFaces) {
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const CellCase& c = cell_table()[pattern];
        std::map<int, std::vector<int>> neighbours;
        for (int face = 0; face < 6; ++face) {
            const auto joins = joins_on_face(pattern, face);
            ASSERT_EQ(joins.size() * 2, crossed_edges_of_face(pattern, face).size());
            for (const auto& [a, b] : joins) {
                neighbours[a].push_back(b);
                neighbours[b].push_back(a);
                ASSERT_EQ(c.loop_of_edge[static_cast<std::size_t>(a)], c.loop_of_edge[static_cast<std::size_t>(b)]);
            }
        }
        for (const auto& [edge, next] : neighbours) {
            ASSERT_EQ(next.size(), 2u);
            std::set<int> seen{edge};
            for (int before = edge, at = next[0]; at != edge;) {
                seen.insert(at);
                const auto& around = neighbours[at];
                const int to = around[0] == before ? around[1] : around[0];
                before = at;
                at = to;
            }
            std::set<int> loop;
            for (int e = 0; e < 12; ++e) {
                if (c.loop_of_edge[static_cast<std::size_t>(e)] == c.loop_of_edge[static_cast<std::size_t>(edge)])
                    loop.insert(e);
            }
            ASSERT_EQ(seen, loop) << pattern;
            ASSERT_GE(seen.size(), 3u);
        }
    }
}

TEST(CellTable, FacesPassedTwiceAreThoseWhoseFourEdgesShareALoop) {
    int twice = 0;
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const CellCase& c = cell_table()[pattern];
        for (int face = 0; face < 6; ++face) {
            const auto edges = crossed_edges_of_face(pattern, face);
            std::set<int> loops;
            for (const int e : edges) loops.insert(c.loop_of_edge[static_cast<std::size_t>(e)]);
            const bool expected = edges.size() == 4 && loops.size() == 1;
            ASSERT_EQ((c.twice_faces >> face & 1) != 0, expected) << pattern << " face " << face;
            twice += expected ? 1 : 0;
        }
    }
    EXPECT_GT(twice, 0);
}

// The complement crosses the same edges; without an ambiguous face it joins them alike.
TEST(CellTable, ComplementCrossesTheSameEdges) {
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const CellCase &c = cell_table()[pattern], &other = cell_table()[255 - pattern];
        bool ambiguous = false;
        for (int face = 0; face < 6; ++face) ambiguous = ambiguous || crossed_edges_of_face(pattern, face).size() == 4;
        for (std::size_t e = 0; e < 12; ++e) {
            ASSERT_EQ(c.loop_of_edge[e] == kNotCrossed, other.loop_of_edge[e] == kNotCrossed);
            ASSERT_TRUE(ambiguous || c.loop_of_edge[e] == other.loop_of_edge[e]) << pattern;
        }
    }
}

}  // namespace burin::compute::test
