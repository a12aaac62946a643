// SPDX-License-Identifier: MIT
// Takes a span out of one ray's ends, in place.
//
// Included inside a C++ struct or at the top level of a shader that provides, for the set of rays at hand,
//   DexelEnd load_end(uint index);  void store_end(uint index, DexelEnd end);
// The caller makes sure of the room: a cut through the middle of an interval adds two ends and removes none.

// What a cut would do to a ray; nothing has been written yet.
struct CutPlan {
    uint first;      // index within the ray of the first end that goes
    uint removed;    // how many go, 0 when nothing changes
    uint kept_low;   // 1: a new end at span.lo closes what stays below
    uint kept_high;  // 1: a new end at span.hi opens what stays above
    int changed_lo;  // the depths whose material or boundary changes
    int changed_hi;
};

BURIN_FN CutPlan plan_cut(uint first_end, uint count, RaySpan span) {
    CutPlan plan;
    plan.first = uint(0);
    plan.removed = uint(0);
    plan.kept_low = uint(0);
    plan.kept_high = uint(0);
    plan.changed_lo = span.lo;
    plan.changed_hi = span.hi;
    if (span.lo >= span.hi) return plan;  // nothing, or a touch in a single depth
    uint i = uint(0);
    while (i < count && depth_of(load_end(first_end + i + uint(1))) <= span.lo) i += uint(2);
    if (i >= count) return plan;
    int interval_lo = depth_of(load_end(first_end + i));
    if (interval_lo >= span.hi) return plan;
    plan.first = i;
    plan.kept_low = interval_lo < span.lo ? uint(1) : uint(0);
    plan.changed_lo = interval_lo < span.lo ? span.lo : interval_lo;
    while (i < count && depth_of(load_end(first_end + i)) < span.hi) i += uint(2);
    int interval_hi = depth_of(load_end(first_end + i - uint(1)));
    plan.removed = i - plan.first;
    plan.kept_high = interval_hi > span.hi ? uint(1) : uint(0);
    plan.changed_hi = interval_hi > span.hi ? span.hi : interval_hi;
    return plan;
}

BURIN_FN uint count_after(uint count, CutPlan plan) {
    return count - plan.removed + uint(2) * (plan.kept_low + plan.kept_high);
}

// Carries the plan out on ends first_end .. first_end + count - 1. end_lo and end_hi are the new ends at the span's borders;
// only those that the plan keeps are used.
BURIN_FN void apply_cut(uint first_end, uint count, CutPlan plan, DexelEnd end_lo, DexelEnd end_hi) {
    uint new_count = count_after(count, plan);
    uint tail = plan.first + plan.removed;  // ends from here on stay and move
    if (new_count > count) {                // the only growing case: two more ends, the tail moves up by two
        for (uint i = count; i > tail; --i) store_end(first_end + i + uint(1), load_end(first_end + i - uint(1)));
        // The interval that is split keeps its own two ends outside the new ones.
        store_end(first_end + plan.first + uint(3), load_end(first_end + plan.first + uint(1)));
        store_end(first_end + plan.first + uint(1), end_lo);
        store_end(first_end + plan.first + uint(2), end_hi);
        return;
    }
    // The start of the first interval stays in place if kept; the end of the last one is moved behind the new ends.
    uint at = plan.first;
    DexelEnd last = load_end(first_end + tail - uint(1));
    if (plan.kept_low == uint(1)) {
        store_end(first_end + at + uint(1), end_lo);
        at += uint(2);
    }
    if (plan.kept_high == uint(1)) {
        store_end(first_end + at, end_hi);
        store_end(first_end + at + uint(1), last);
        at += uint(2);
    }
    if (at != tail) {
        for (uint i = tail; i < count; ++i) store_end(first_end + at + (i - tail), load_end(first_end + i));
    }
}
