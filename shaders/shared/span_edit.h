// SPDX-License-Identifier: MIT
// Empties or fills a span of one ray.
//
// A span lo..hi stands for the depths lo <= d < hi, as an interval of material does. After the edit all its depths are
// `inside` (1: filled, 0: emptied); nothing else changes. An end of the right kind that lies exactly on the span's
// border stays, with its normal and material; intervals that come to touch are merged.
//
// Included inside a C++ struct or at the top level of a shader that provides, for the ray at hand,
//   DexelEnd load_end(uint index);   (within the ray)

// The edit of a ray's ends: those from `from` to `to` - 1 are removed, and in their place come a new end at span.lo if
// insert_lo is 1 and one at span.hi if insert_hi is 1. The ends removed and inserted are even in number together.
struct SpanEdit {
    uint from;
    uint to;
    uint insert_lo;
    uint insert_hi;
    int changed_lo;  // range of depths in which the ray differs afterwards
    int changed_hi;
};

BURIN_FN bool changes_anything(SpanEdit edit) { return edit.to > edit.from || edit.insert_lo > uint(0); }
BURIN_FN uint count_after(uint count, SpanEdit edit) {
    return count - (edit.to - edit.from) + edit.insert_lo + edit.insert_hi;
}

BURIN_FN SpanEdit plan_span(uint count, RaySpan span, uint inside) {
    SpanEdit edit;
    edit.from = uint(0);
    edit.insert_lo = uint(0);
    edit.insert_hi = uint(0);
    edit.changed_lo = span.lo;
    edit.changed_hi = span.hi;
    if (span.lo >= span.hi) {  // empty, or a touch at a single depth
        edit.to = uint(0);
        return edit;
    }
    while (edit.from < count && depth_of(load_end(edit.from)) < span.lo) edit.from += uint(1);
    edit.to = edit.from;
    while (edit.to < count && depth_of(load_end(edit.to)) <= span.hi) edit.to += uint(1);
    // An odd number of ends below a depth means that the depth is inside.
    if ((edit.from & uint(1)) != inside) {
        if (edit.from < edit.to && depth_of(load_end(edit.from)) == span.lo) {
            edit.from += uint(1);
        } else {
            edit.insert_lo = uint(1);
        }
    }
    if ((edit.to & uint(1)) != inside) {
        if (edit.from < edit.to && depth_of(load_end(edit.to - uint(1))) == span.hi) {
            edit.to -= uint(1);
        } else {
            edit.insert_hi = uint(1);
        }
    }
    if (edit.from < edit.to) {
        if (edit.insert_lo == uint(0)) edit.changed_lo = depth_of(load_end(edit.from));
        if (edit.insert_hi == uint(0)) edit.changed_hi = depth_of(load_end(edit.to - uint(1)));
    }
    return edit;
}
