// SPDX-License-Identifier: MIT
// Goes along a ray of the ball as the host does (append_ray in compute/tools/smooth.cpp). Include after
// smooth_buffers.glsl and after declaring what is done on the way:
//   void keep_ends(uint from, uint to);   ends that stay as they are
//   void move_ends(SmoothEdge edge, uint from, uint to, bool low_inside);   the ends of an edge, which are to be moved
//   void make_end_on(SmoothEdge edge, bool low_inside);   an edge that gets one end in place of those that it has
//   void drop_ends();                                     an edge that loses all that it has
void walk_ray(SmoothTask task, uint code, RayRef ray) {
    int axis = axis_of(code);
    uint count = count_of(ray);
    uint next = 0u;
    // Side of the lower node: by the ray's own ends where the tool does not reach the node, else by the field.
    bool low_inside = false;
    ivec3 lowest = node_on_ray(axis, u_of(code), v_of(code), task.lo[axis] - 1);
    uint below = nodes[index_of_node(task, lowest.x, lowest.y, lowest.z)].flags;
    for (int k = task.lo[axis] - 1; k <= task.hi[axis]; ++k) {
        ivec3 high = node_on_ray(axis, u_of(code), v_of(code), k + 1);
        uint above = nodes[index_of_node(task, high.x, high.y, high.z)].flags;
        if (((below | above) & kWeighs) != 0u) {
            uint kept = next;
            while (next < count && depth_of(store.at[ray.first + next]) <= k * kUnitsPerCell) ++next;
            if (next > kept) keep_ends(kept, next);
            uint last = next;
            while (last < count && depth_of(store.at[ray.first + last]) <= (k + 1) * kUnitsPerCell) ++last;
            if ((below & kWeighs) == 0u) low_inside = (next & 1u) != 0u;
            bool high_inside = (above & kWeighs) != 0u ? (above & kIsInside) != 0u : (last & 1u) != 0u;
            bool is_crossed = low_inside != high_inside;
            bool is_same_way = ((next & 1u) != 0u) == low_inside;
            SmoothEdge edge = SmoothEdge(axis, u_of(code), v_of(code), k);
            if (is_same_way && (((last - next) & 1u) != 0u) == is_crossed) {
                if (last > next) move_ends(edge, next, last, low_inside);
            } else if (is_crossed) {
                make_end_on(edge, low_inside);
            } else {
                drop_ends();
            }
            next = last;
            low_inside = high_inside;
        }
        below = above;
    }
    if (next < count) keep_ends(next, count);
}
