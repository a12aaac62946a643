// SPDX-License-Identifier: MIT
// Ranges of the two pools, 0: vertices, 1: indices. Of each class of size there is a list of free places. A place that finds
// the list full is not remembered; it is won back when the pools are laid out anew.

// The smallest class that holds so many; kNoClass for none at all.
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
