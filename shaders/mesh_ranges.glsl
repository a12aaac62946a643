// SPDX-License-Identifier: MIT
// Allocation of ranges in the two pools, 0: vertices, 1: indices. Each size class has a list of free ranges. A range
// that finds its list full is lost until the pools are laid out again.

// Returns the smallest class that holds `size` entries; kNoClass for none at all.
uint class_for(uint size) {
    if (size == 0u) return kNoClass;
    return uint(max(findMSB(size - 1u) + 1, 6) - 6);  // findMSB(0) is -1
}

uint list_of(uint pool, uint range_class) { return pool * uint(kRangeClasses) + range_class; }
uint places_of(uint list) { return 2u * uint(kRangeClasses) + list * parameters.most_free; }

void give_back(uint pool, uint range_class, uint place) {
    if (range_class == kNoClass) return;
    uint list = list_of(pool, range_class);
    uint at = atomicAdd(free_places[list], 1u);
    if (at < parameters.most_free) {
        free_places[places_of(list) + at] = place;
    } else {
        atomicAdd(free_places[list], 0xffffffffu);
    }
}

const uint kNoPlace = 0xffffffffu;

uint take(uint pool, uint range_class) {
    uint list = list_of(pool, range_class);
    int left = int(atomicAdd(free_places[list], 0xffffffffu));
    if (left > 0) return free_places[places_of(list) + uint(left) - 1u];
    atomicAdd(free_places[list], 1u);
    uint size = class_size(range_class);
    uint place = pool == 0u ? atomicAdd(counters.vertices_used, size) : atomicAdd(counters.indices_used, size);
    return place + size <= (pool == 0u ? parameters.most_vertices : parameters.most_indices) ? place : kNoPlace;
}
