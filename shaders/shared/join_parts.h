// SPDX-License-Identifier: MIT
// Collects the parts of a ray that the moves of a sweep cover (covered_part.h), joined as far as they touch.
//
// Included inside a C++ struct or at the top level of a shader that provides
//   int part_count;                              parts so far, 0 before the first
//   CoveredPart load_part(int i);
//   void store_part(int i, CoveredPart part);    i <= part_count
//   bool has_room_for_part();                    whether there is space for one part more

// Adds the part of the next move. Returns false if there is no space for it. No two parts that are kept touch, so one
// that touches neither the new part nor what it has been joined with so far touches nothing that it is joined with
// later: one pass is enough.
BURIN_FN bool add_part(CoveredPart part) {
    int i = 0;
    while (i < part_count) {
        CoveredPart other = load_part(i);
        if (touch(other, part)) {
            part = joined(other, part);
            part_count -= 1;
            if (i < part_count) store_part(i, load_part(part_count));
        } else {
            i += 1;
        }
    }
    if (!has_room_for_part()) return false;
    store_part(part_count, part);
    part_count += 1;
    return true;
}
