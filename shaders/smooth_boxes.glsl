// SPDX-License-Identifier: MIT
// How points of a level come into its boxes: each is counted in its box and row, and remembers its number there.
// Include after smooth_buffers.glsl.

// Adds a point as number `index` of its level.
void put_into_box(SmoothPoint point, SmoothTask task, int level, uint index) {
    SmoothBoxes grid = boxes_of_level(task, level, behind_counts());
    double box = double(1 << level);
    int x = int(floor((point.place_area.x - double(task.box_lo[0])) / box));
    int y = int(floor((point.place_area.y - double(task.box_lo[1])) / box));
    int z = int(floor((point.place_area.z - double(task.box_lo[2])) / box));
    uint row = uint(z * grid.y + y);
    point.key_box.y = row * uint(grid.x + 1) + uint(x);
    point.key_box.z = atomicAdd(boxes[point.key_box.y], 1u);
    atomicAdd(boxes[parameters.boxes + row], 1u);
    points[index] = point;
}
