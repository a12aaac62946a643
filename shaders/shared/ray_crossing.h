// SPDX-License-Identifier: MIT
// Reads a ray against the lattice: which of its nodes are inside, and where the surface crosses its edges.
//
// Rays of different directions may disagree about a node (each was cut at its own rounded depth). The rays along z
// decide every sign; an edge along x or y takes the nearest end of the right kind, or else its midpoint and its own
// direction.
//
// Included inside a C++ struct or at the top level of a shader, after mesh_tile.h and octahedral.h, that provides, for
// the ray at hand,
//   DexelEnd load_end(uint index);   (within the ray)

// Returns a bit for each of the nodes first_node - 1 .. first_node + kMeshNodes - 2 that is inside, from bit 0 on. A
// node at depth d is inside when lo <= d < hi.
BURIN_FN uint node_bits(uint count, int first_node) {
    uint bits = 0u;
    for (uint i = 0u; i < count; i += 2u) {
        // The lowest nodes at or above the interval's ends.
        int from = (depth_of(load_end(i)) + kUnitsPerCell - 1) / kUnitsPerCell - (first_node - 1);
        int to = (depth_of(load_end(i + 1u)) + kUnitsPerCell - 1) / kUnitsPerCell - (first_node - 1);
        from = max(from, 0);
        to = min(to, kMeshNodes);
        if (from >= kMeshNodes) break;
        if (from < to) bits |= ((1u << uint(to)) - 1u) & ~((1u << uint(from)) - 1u);
    }
    return bits;
}

// Returns the index of the end that makes the crossing of the edge between nodes `lower` and `lower + 1`, or kNoEnd.
// Along an edge whose lower node is inside, the ray leaves the material at an upper end (odd index); otherwise it
// enters at a lower end.
BURIN_HOT_FN uint crossing_end(uint count, int lower, bool lower_inside) {
    int edge_lo = lower * kUnitsPerCell;
    int edge_hi = edge_lo + kUnitsPerCell;
    uint best = kNoEnd;
    int best_distance = kNearEdge;
    for (uint i = lower_inside ? 1u : 0u; i < count; i += 2u) {
        int depth = depth_of(load_end(i));
        if (depth >= edge_hi + kNearEdge) break;
        int distance = depth <= edge_lo ? edge_lo - depth + 1 : max(depth - edge_hi, 0);
        // Of several ends on the edge itself, takes the one next to the inside node: the first one to leave by, the
        // last one to enter by.
        if (distance < best_distance || (distance == 0 && best_distance == 0 && !lower_inside)) {
            best = i;
            best_distance = distance;
        }
    }
    return best;
}

// The crossing of an edge.
struct EdgeCrossing {
    float along;  // 0 at the lower node, 1 at the upper
    uint normal;  // octahedral.h
    uint material;
    bool disagrees;  // the edge's own ray does not hold this crossing
};

BURIN_HOT_FN EdgeCrossing edge_crossing(uint count, int axis, int lower, bool lower_inside) {
    EdgeCrossing crossing;
    crossing.along = 0.5f;
    crossing.material = 0u;
    crossing.disagrees = true;
    uint chosen = crossing_end(count, lower, lower_inside);
    if (chosen == kNoEnd) {
        crossing.normal = axis_normal(axis, lower_inside);
    } else {
        DexelEnd end = load_end(chosen);
        int offset = depth_of(end) - lower * kUnitsPerCell;
        crossing.along = exact_quotient(float(clamp(offset, 0, kUnitsPerCell)), float(kUnitsPerCell));
        crossing.normal = end.normal;
        crossing.material = material_of(end);
        crossing.disagrees = offset <= 0 || offset > kUnitsPerCell;
    }
    return crossing;
}
