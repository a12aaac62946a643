// SPDX-License-Identifier: MIT
// Grows rays: moves a ray to a larger range at the end of the store. Needs dexel_store.glsl and the CutCounters
// `counters`.

// Returns log2 of the room for `count` ends, in the high bits of a RayRef's count_room.
uint room_for(uint count) { return count <= 1u ? 0u : uint(findMSB(count - 1u) + 1) << 24; }

// Returns the ray with its ends moved to a range with room for `needed` ends; unchanged when the store is full.
RayRef with_larger_room(RayRef ray, uint needed) {
    uint larger = room_for(needed);
    uint room = 1u << (larger >> 24);
    uint place = atomicAdd(counters.used, room);
    if (place + room > parameters.store_size) {
        atomicAdd(counters.room_wanted, room);
        return ray;
    }
    uint count = count_of(ray);
    for (uint i = 0u; i < count; ++i) store.at[place + i] = store.at[ray.first + i];
    ray.first = place;
    ray.count_room = larger | count;
    return ray;
}
